"""The gallery: each piece of `lutetia stage` is led by its script, and pieces from elsewhere reach nothing.

usage: test_gallery.py LUTETIA PIECES FOLDER PICTURE
"""
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import zlib

lutetia, pieces, folder = (os.path.abspath(a) for a in sys.argv[1:4])
shutil.rmtree(folder, ignore_errors=True)
os.makedirs(folder)
LOOK = ["--size", "96x64", "--fps", "10"]


def run(*words):
    return subprocess.run([lutetia, *words], cwd=folder, capture_output=True, timeout=100)


def must(good, what):
    if not good:
        sys.exit(f"test_gallery.py: {what}")


def still(name, *words, look=LOOK):
    done = run(*words, *look, "--still", name)
    must(done.returncode == 0, f"{words}: {done.stderr.decode()}")
    with open(os.path.join(folder, name), "rb") as file:
        return file.read()


def gallery():
    """Twelve pieces, each of at most a screen; with another script in its place each picture is another one."""
    names = sorted(name[:-4] for name in os.listdir(pieces) if name.endswith(".lua"))
    listed = run("stage", "--list").stdout.decode().splitlines()
    must([line.split()[0] for line in listed] == names and len(names) == 12, f"--list: {listed}")
    must(all(len(line) > 20 for line in listed), "a piece says nothing of itself")
    for name in names:
        with open(os.path.join(pieces, name + ".lua"), encoding="utf-8") as file:
            text = file.read()
        must(text.count("\n") <= 40, f"{name}: longer than a screen")
        must(run("stage", "--print", name).stdout.decode() == text, f"{name}: --print")
        head = "".join(line + "\n" for line in text.splitlines() if line.startswith("--"))
        with open(os.path.join(folder, "idle.lua"), "w", encoding="utf-8") as file:
            file.write(head + "function frame(time) end\n")
        moment = ["--seconds", "4.5"]
        led, again, idle = (still("a.png", "stage", name, *moment), still("b.png", "stage", name, *moment),
                            still("c.png", "stage", "idle.lua", *moment))
        must(led == again, f"{name}: not the same twice")
        must(led != idle, f"{name}: its script changes nothing")
        slow, fast = (still("a.png", "stage", name, "--seconds", "3", look=["--size", "96x64", "--fps", fps]) for fps in ("4", "60"))
        must(slow == fast, f"{name}: with few pictures a second it moves otherwise")


def png_rows(path):
    """The rows of an RGB picture of eight bits."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed, width = 8, b"", struct.unpack(">I", data[16:20])[0]
    must(data[24:26] == b"\x08\x02" and data[28] == 0, f"{path}: not RGB of eight bits")
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + length] if kind == b"IDAT" else b""
        at += 12 + length
    plain, rows, above = zlib.decompress(packed), [], bytearray(3 * width)
    for begin in range(0, len(plain), 3 * width + 1):
        how, row = plain[begin], bytearray(plain[begin + 1:begin + 1 + 3 * width])
        for i, value in enumerate(row):
            a, b, c = row[i - 3] if i > 2 else 0, above[i], above[i - 3] if i > 2 else 0
            near = min((a, b, c), key=lambda v: abs(a + b - c - v))
            row[i] = value + (0, a, b, (a + b) // 2, near)[how] & 255
        rows.append(bytes(row))
        above = row
    return rows


def documented(pictured):
    """The picture of all pieces in the documents shows them as they are now."""
    with open(os.path.join(os.path.dirname(pictured), "..", "stage.md"), encoding="utf-8") as file:
        said = file.read()
    names = re.search(r"at the left ([a-z, ]+), at the right ([a-z, ]+)\]\(images/stage-pieces.png", said)
    whole = png_rows(pictured)
    for column in (0, 1):
        for row, name in enumerate(names[column + 1].split(", ")):
            still("w.png", "stage", name, "--strip", "5x1", look=["--size", "700x112"])
            rows = png_rows(os.path.join(folder, "w.png"))
            other = [line[2100 * column:2100 * (column + 1)] for line in whole[112 * row:112 * (row + 1)]]
            far = sum(a != b for line, there in zip(rows, other) for a, b in zip(line, there)) / (112 * 2100)
            must(len(rows) == 112 and far < 0.02, f"{name}: {100 * far:.1f} % of its picture in the documents are otherwise")
    os.remove(os.path.join(folder, "w.png"))


def windows():
    """Without an option a piece is a window, which what it says of its films does not prevent: it lacks a display alone."""
    there = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    for line in run("stage", "--list").stdout.decode().splitlines():
        done = subprocess.run([lutetia, "stage", line.split()[0], "--silent"], cwd=folder, capture_output=True, timeout=100, env=there)
        must(done.returncode != 0 and b"run it where there is a desktop" in done.stderr, f"{line}: {done.stderr}")


def repeats():
    """All pieces but breakdown come back to what they were: what follows the loop is its beginning, to the bit or, where letters
    push each other along the floor, within a thousandth of an em."""
    near = {"dictionary", "moon", "wake"}
    for name in (line.split()[0] for line in run("stage", "--list").stdout.decode().splitlines()):
        with open(os.path.join(pieces, name + ".lua"), encoding="utf-8") as file:
            loop = re.search(r"^-- loop: --settle (\S+) --seconds (\S+)$", file.read(), re.M)
        must((loop is None) == (name == "breakdown"), f"{name}: {loop and loop[0]}")
        if not loop:
            continue
        settle, period = float(loop[1]), float(loop[2])
        pictures = []
        for when, seconds in enumerate((settle, settle + period, settle + 0.3 * period)):
            still(f"{when}.png", "stage", name, "--seconds", f"{seconds:g}", look=["--size", "240x160"])
            pictures.append(b"".join(png_rows(os.path.join(folder, f"{when}.png"))))
        begin, later, between = pictures
        far = max(abs(a - b) for a, b in zip(begin, later))
        must(far <= (24 if name in near else 0), f"{name}: it does not come back after {period} s ({far})")
        must(begin != between, f"{name}: it stands still")
    for name in ("0.png", "1.png", "2.png"):
        os.remove(os.path.join(folder, name))
    # --loop takes that turn, unless another one is asked for
    for words, count in (([], 48), (["--seconds", "1"], 10)):
        made = os.path.join(folder, "loop")
        done = run("stage", "score", "--loop", "0.1", "--frames", "loop", *LOOK, *words)
        must(done.returncode == 0 and len(os.listdir(made)) == count, f"score --loop {words}: {done.stderr} {len(os.listdir(made))} pictures")
        shutil.rmtree(made)


def breakdowns():
    """The preset breaks words of any length from three letters on, into pieces; not where other links are asked for."""
    for word, more, least, most in [(w, [], 2, 16) for w in (
            "cry", "iii", "mmm", "word", "iiii", "hello", "Zürich", "falling", "collapse", "breakdown", "an end of all things",
            "two words\nor three", "a word that goes on and on until nobody can say it")] + [("cry", ["--set", "link=210"], 0, 0)]:
        still("w.png", "spring", word, "--preset", "breakdown", "--seconds", "10", "--save", "b.springs", *more, look=["--size", "32x32"])
        with open(os.path.join(folder, "b.springs"), encoding="utf-8") as file:
            broken = sum(line.startswith("spring ") and line.endswith(" broken\n") for line in file)
        must(least <= broken <= most, f"{word!r}: {broken} springs are broken")
    for name in ("w.png", "b.springs"):
        os.remove(os.path.join(folder, name))


def refused(text, says):
    with open(os.path.join(folder, "piece.lua"), "w", encoding="utf-8") as file:
        file.write(text)
    done = run("stage", "piece.lua", *LOOK, "--still", "p.png")
    lines = done.stderr.decode().strip().splitlines()
    must(done.returncode in (1, 2) and len(lines) == 1 and says in lines[0], f"{text!r}: {done.returncode} {lines}")
    must(not os.path.exists(os.path.join(folder, "p.png")), f"{text!r}: a picture all the same")


def strangers():
    """security.md 35: a piece names no file, and its options are those of a list."""
    body = "function frame(t) end\n"
    for option in ("--video f.y4m", "--save f", "--network f", "--script f", "--session f", "--edits f", "--map f", "--osc 1", "--frames f",
                   "--theme ./f", "--font ../f", "-p jelly", "--wet"):
        refused(f"-- stage: spring a {option}\n{body}", "here (got" if "/" in option else "a piece begins with")
    refused(f"-- stage: keys a\n{body}", "must begin as")
    refused(f"-- stage: spring --preset jelly\n{body}", "must begin as")
    refused(f"-- stage: spring \"a\n{body}", "an open quote")
    for seconds in ("x", "-1", "4000", "nan", "1s"):
        refused(f"-- stage: spring a --seconds {seconds}\n{body}", "--seconds must be 0..3600")
    for loop in ("", "--settle 1", "--seconds 2 --settle 1", "--settle 1 --seconds 0", "--settle -1 --seconds 2", "--settle 1 --seconds 2 --video f"):
        refused(f"-- stage: spring a\n-- loop: {loop}\n{body}", "-- loop: --settle")
    refused("-- nothing\n" + body, "must begin as")
    refused("-- stage: spring a --set\n" + body, "a piece begins with")
    refused("-- stage: spring a\nio.open('f', 'w')\n", "attempt to index")
    refused("-- stage: spring a\nx = 1\n", "function message(m), osc(address, ...) or frame(time)")
    refused("-- stage: spring a\nfunction message(m) end\n", "frame(time)")
    must(sorted(os.listdir(folder)) == ["a.png", "b.png", "c.png", "idle.lua", "piece.lua"], f"left: {os.listdir(folder)}")
    done = run("stage", "nobody")
    must(done.returncode == 2 and b"there is no piece 'nobody'; there are apart, breakdown" in done.stderr, done.stderr)


def damaged():
    """Damaged beginnings: one line, and no crash."""
    chance = random.Random(7)
    seed = b"-- A piece.\n-- stage: spring \"a b\" --preset jelly --set gravity=3 --view -1,-1,4,4\nfunction frame(t) end\n"
    for _ in range(150):
        text = bytearray(seed)
        for _ in range(chance.randrange(1, 5)):
            at = chance.randrange(len(text))
            if chance.random() < 0.3:
                del text[at:at + chance.randrange(1, 20)]
            else:
                text[at:at + 1] = bytes([chance.choice(b"\"-\n\\n \x00\xff/a") for _ in range(chance.randrange(1, 4))])
        with open(os.path.join(folder, "piece.lua"), "wb") as file:
            file.write(text)
        done = run("stage", "--print", "piece.lua")
        lines = done.stderr.splitlines()
        must(done.returncode == 0 or (done.returncode in (1, 2) and len(lines) == 1), f"{bytes(text)!r}: {done.returncode} {lines}")


gallery()
documented(os.path.abspath(sys.argv[4]))
windows()
repeats()
breakdowns()
strangers()
damaged()
