"""Every option of verbs that make pictures is tried alone beside a base command: what comes out differs, or a line says why not.

usage: test_options_alone.py LUTETIA FOLDER
A new option needs a value in the table here: a value that ought to change something, or None where the base command has it already.
"""
import hashlib
import os
import re
import shutil
import struct
import subprocess
import sys

lutetia, folder = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])


def song_write(path):
    """Four notes on two channels, with aftertouch."""
    events = b""
    for delta, message in ((0, b"\x90\x3c\x60"), (40, b"\xd0\x50"), (40, b"\x80\x3c\x40"), (0, b"\x91\x40\x40"),
                           (60, b"\x81\x40\x40"), (0, b"\x90\x43\x7f"), (60, b"\x80\x43\x40")):
        events += bytes([delta]) + message
    events += b"\x00\xff\x2f\x00"
    with open(path, "wb") as out:
        out.write(b"MThd" + struct.pack(">IHHH", 6, 0, 1, 96) + b"MTrk" + struct.pack(">I", len(events)) + events)


def edits_make():
    """Edits of a font that no verb takes by itself."""
    at = folder + "-edits"
    shutil.rmtree(at, ignore_errors=True)
    subprocess.run([lutetia, "font", "DejaVuSans-Bold", "--glyph", "A", "--edits", at, "--write", "outline", "-o", at + ".png"], check=True,
                   stdout=subprocess.DEVNULL, timeout=100)
    return at


FILE, PICTURE, FILM, DIRECTORY, EDITS = "made.file", "made.png", "made.y4m", "made", edits_make()
VERBS = {
    "voice": (["--cry", "Aagh oh", "-o", "out.png", "--picture", "96x64"], {
        "poster": None, "cry": None, "picture": "160x64", "sheet": PICTURE, "envelope": PICTURE, "still": PICTURE, "at": "1",
        "frames": DIRECTORY, "video": FILM, "fps": "7", "microphone": "any", "seconds": "1", "transcript": "none.srt", "features": FILE, "screen": "7", "stream": "/dev/null", "osc-to": "9001",
        "map": "size=pitch", "font": "DejaVuSans", "axes": "wght=700", "size": "4,20", "rise": "1", "slant": "1",
        "second": "100", "line": "100", "edits": EDITS, "paper": "1,0,0", "inks": "0,0,1,0,1,0"}),
    "keys": (["song.mid", "-o", "out.png"], {
        "poster": None, "picture": "240x160", "text": "hat", "map": "letters", "knobs": "wheel.knobs", "osc": "9000", "osc-from": "127.0.0.1", "osc-to": "9001", "param": "a=1", "set": "step=1", "range": "c2-c6", "watch": "cue.txt", "cues": "n.cues", "stream": "/dev/null",
        "server": "/no/where", "device": "d", "filter": "channels=1", "screen": "7", "wet": "", "stock": "hot press", "pigment": "rose madder",
        "theme": "dark", "sheet": PICTURE, "still": PICTURE, "at": "1", "frames": DIRECTORY, "video": FILM, "silent": "",
        "sound": "made.wav", "fps": "7", "seconds": "0.5", "font": "DejaVuSans", "axes": "wght=700", "size": "2,20", "second": "60",
        "line": "100", "edits": EDITS, "step": "40", "attack": "2", "release": "9", "pressure": "0"}),
    "spring": (["Aa", "--still", "out.png", "--seconds", "0.3", "--size", "96x64"], {
        "still": None, "seconds": "0.6", "size": "64x96", "preset": "pendulum", "set": "gravity=0", "controls": "", "network": "n",
        "font": "EBGaramond12-Regular", "edits": EDITS, "at": "0,4", "turn": "30", "column": "0.5", "circle": "1", "script": "n", "map": "n.lua",
        "knobs": "n.knobs", "watch": "cue.txt", "osc": "9000", "osc-from": "127.0.0.1", "osc-to": "9001", "param": "a=1", "song": "song.mid", "server": "/no/where", "theme": "dark", "view": "0,0,9,9", "strip": "2x1",
        "video": FILM, "frames": DIRECTORY, "fps": "7", "screen": "7", "stream": "/dev/null", "cues": "n.cues", "loop": "0.1", "settle": "0.1", "way": "cuda", "wet": "", "pigment": "rose madder", "every": "1",
        "filter": "box", "sound": "made.wav", "silent": "", "save": FILE, "session": FILE, "replay": "n", "record": FILE,
        "play": "d"}),
    "midi render": (["song.mid", "-o", "out.wav"], {
        "output": None, "server": "/no/where", "device": "d", "filter": "channels=1", "count": "1", "seconds": "1", "tcp": "7777",
        "usual-priority": "", "may-sleep": "", "terminals-first": "", "soundfont": "none.sf2"}),
}
# What changes nothing by right: where the base command goes by the same way.
SAME = {("midi render", "server")}


def options_of(verb):
    """The long names in the help."""
    text = subprocess.run([lutetia, verb.split()[0], "--help"], capture_output=True, text=True, check=True).stdout
    return sorted(set(re.findall(r"^\s+(?:-\w, )?--([a-z-]+)", text, re.M)) - {"help"})


def made(verb, words):
    """Exit status, error lines, and a digest of all that came out."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    song_write(os.path.join(folder, "song.mid"))
    with open(os.path.join(folder, "letters"), "w") as out:
        out.write("c4 Q\n")
    done = subprocess.run([lutetia] + verb.split() + words, cwd=folder, capture_output=True, timeout=100,
                          env={name: value for name, value in os.environ.items()
                               if name not in ("LUTETIA_INTERPRET", "LUTETIA_BACKGROUND")})  # wet paper is interpreted at first
    digest = hashlib.sha256(done.stdout)
    for where, folders, files in os.walk(folder):
        folders.sort()
        for name in sorted(files):
            with open(os.path.join(where, name), "rb") as file:
                digest.update(name.encode() + hashlib.sha256(file.read()).digest())
    return done.returncode, done.stderr.decode(), digest.hexdigest()


wrong, tried = [], 0
for verb, (base, values) in VERBS.items():
    status, errors, usual = made(verb, base)
    if status != 0:
        if "FluidSynth" in errors or "SoundFont" in errors:
            continue
        wrong.append(f"{verb} {' '.join(base)}: {errors}")
        continue
    for option in options_of(verb):
        if option not in values:
            wrong.append(f"{verb} --{option}: this test has no value for it")
            continue
        value = values[option]
        if value is None:
            continue
        tried += 1
        status, errors, digest = made(verb, base + [f"--{option}"] + ([value] if value else []))
        if status != 0 and len(errors.strip().splitlines()) != 1:
            wrong.append(f"{verb} --{option} {value}: exit {status}, and not one line: {errors}")
        elif status == 0 and digest == usual and (verb, option) not in SAME:
            wrong.append(f"{verb} --{option} {value}: nothing differs, and no line says why")
for line in wrong:
    print(line)
print(f"{tried} options tried alone, {len(wrong)} wrong")
sys.exit(bool(wrong))
