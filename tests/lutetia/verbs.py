"""verbs.py - what the verbs read and write, for tests that try them all: command lines, by the names of the files in them.

The options come from the command's own table (`lutetia help --table`): options_of() gives those that name a file or a folder. A verb or
such an option that no row here knows is an error of the test that uses the rows, so that a new one cannot be forgotten.
"""
import re
import struct
import subprocess

SONG = b"MThd\0\0\0\6\0\0\0\1\0\x60MTrk\0\0\0\x0c\0\x90\x3c\x40\x60\x80\x3c\x40\0\xff\x2f\0"
SHEET = """
local p = paper{width = 24, height = 24}
p:put(ellipse(12, 12, 6), {water = 0.4})
for i = 1, 4 do p:step(2) end
p:frame("frame.png")
p:save("sheet.h5")
"""
PROGRAM = """
#include <cm/cmfb.h>
#include <stdio.h>
int main(void)
{
    int sizes[2] = {64, 64}, i;
    CM_field_id_t f, picture;
    CMFB_display_id_t display;
    CM_init();
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sizes, 2)));
    f = CM_allocate_heap_field(1);
    picture = CM_allocate_heap_field(8);
    display = CMFB_attach_display("");
    CMFB_initialize_display(display, 8, 64, 64);
    CM_set_context();
    for (i = 0; i < 60; i++) {
        CM_lognot_1_1L(f, 1);
        CM_latch_leds_always(f);
        CM_u_move_constant_1L(picture, 4 * i, 8);
        CMFB_write_news_always(display, 0, picture, 0, 0);
    }
    puts("ran");
    return 0;
}
"""
PICTURE = ["--picture", "96x64"]
FILM = [*PICTURE, "--fps", "8"]
LEDS = b"lutetia leds 1 4096\n" + b"".join(struct.pack("<Q", 50000 * i) + bytes([17 * i]) * 512 for i in range(4))



def display_piece(kind, us, x, y, more=b""):
    return struct.pack("<BBBBIQii", kind, 1, 0, 1, len(more), us, x, y) + more


DISPLAY = b"lutetia display 1\n" + display_piece(1, 0, 64, 48, b"title") + b"".join(
    display_piece(2, 50000 * i, 0, 0, struct.pack("<I", 64) + bytes([60 * i]) * 64 * 48) for i in range(4))

# What a command line writes: {name}. Files of one run are made together.
# (name, verb, options whose files these are, files or folders/, words, variables)
OUTPUTS = [
    ("paint", "paint", ["out"], ["out.png"], ["paint", "k", "--paper", "64x64", "--steps", "8", "-o", "out.png"], {}),
    ("paint frames", "paint", ["frames"], ["dry/"], ["paint", "k", "--paper", "64x64", "--steps", "8", "--frames", "dry", "-o", "p.png"], {}),
    ("type png", "type", ["out"], ["t.png"], ["type", "Lutetia " * 30, "--width", "700", "-o", "t.png"], {}),
    ("type svg", "type", [], ["t.svg"], ["type", "Lutetia " * 30, "-o", "t.svg"], {}),
    ("type pdf", "type", [], ["t.pdf"], ["type", "Lutetia " * 30, "-o", "t.pdf"], {}),
    ("set", "set", ["out"], ["page.pdf"], ["set", "text.txt", "-o", "page.pdf"], {}),
    ("set all", "set", ["all"], ["pages/"], ["set", "text.txt", "--all", "-o", "pages/page.png"], {}),
    ("read", "read", ["out"], ["read.pdf"], ["read", "text.txt", "-o", "read.pdf"], {}),
    ("read html", "read", [], ["read.html"], ["read", "text.txt", "-o", "read.html"], {}),
    ("read small", "read", [], ["small.png"], ["read", "text.txt", "--miniatures", "60", "-o", "small.png"], {}),
    ("read all", "read", ["all"], ["pages/"], ["read", "text.txt", "--all", "-o", "pages/read.png"], {}),
    ("font", "font", ["out"], ["f.png"], ["font", "DejaVuSans", "-o", "f.png"], {}),
    ("font master", "font", ["master-out"], ["m.png", "levels.png"],
     ["font", "DejaVuSans", "--glyph", "a", "--master-out", "m.png", "-o", "levels.png"], {}),
    ("font edits", "font", ["edits"], ["edits/", "edited.png"],
     ["font", "DejaVuSans", "--glyph", "a", "--edits", "edits", "--write", "master", "-o", "edited.png"], {}),
    ("spring", "spring", ["still", "save"], ["still.png", "end.springs"],
     ["spring", "Aa", "--still", "still.png", "--save", "end.springs", "--seconds", "0.3", "--size", "96x64"], {}),
    ("spring film", "spring", ["video", "frames", "sound"], ["s.y4m", "s.wav", "spring/"],
     ["spring", "Aa", "--video", "s.y4m", "--frames", "spring", "--sound", "s.wav", "--seconds", "0.5",
      "--size", "96x64"], {}),
    ("voice", "voice", ["poster", "sheet", "envelope", "still", "features"], ["v.png", "vs.png", "ve.png", "vt.png", "v.csv"],
     ["voice", "--cry", "Ah", *PICTURE, "-o", "v.png", "--sheet", "vs.png", "--envelope", "ve.png", "--still", "vt.png",
      "--features", "v.csv"], {}),
    ("voice film", "voice", ["video", "frames"], ["v.mp4", "voice/"],
     ["voice", "--cry", "Ah", *FILM, "--video", "v.mp4", "--frames", "voice"], {}),
    ("voice film and sound", "voice", [], ["v.y4m", "v.wav"], ["voice", "--cry", "Ah", *FILM, "--video", "v.y4m"], {}),
    ("run", "run", ["out", "save"], ["run/frame.png", "run/sheet.h5", "all.h5"],
     ["run", "sheet.lua", "-q", "-o", "run", "--save", "all.h5"], {}),
    ("run film", "run", ["video", "frames"], ["r.y4m", "filmed/"],
     ["run", "sheet.lua", "-q", "-o", "run", "--video", "r.y4m", "--frames", "filmed"], {}),
    ("demo", "demo", ["out"], ["demo/"], ["demo", "-o", "demo"], {}),
    ("cc", "cc", [], ["prog"], ["cc", "prog.c", "-o", "prog"], {}),
    ("leds", "leds", ["out", "frames"], ["leds.png", "lights/"],
     ["leds", "--size", "64x64", "-o", "leds.png", "--frames", "lights", "lights.leds"], {}),
    ("display", "display", ["out", "frames"], ["display.png", "shown/"],
     ["display", "-o", "display.png", "--frames", "shown", "run.display"], {}),
    ("display film", "display", ["film"], ["d.y4m"], ["display", "--film", "d.y4m", "run.display"], {}),
    ("explain", "explain", ["json"], ["x.json"], ["explain", "--json", "x.json", "./program"], {}),
    ("keys", "keys", ["poster", "sheet", "still"], ["k.png", "ks.png", "kt.png"],
     ["keys", "song.mid", *PICTURE, "-o", "k.png", "--sheet", "ks.png", "--still", "kt.png"], {}),
    ("keys film", "keys", ["video", "frames", "sound"], ["k.avi", "k.wav", "keys/"],
     ["keys", "song.mid", *FILM, "--video", "k.avi", "--frames", "keys", "--sound", "k.wav"], {}),
    ("midi render", "midi", ["output"], ["m.wav"], ["midi", "render", "song.mid", "-t", "20", "-o", "m.wav"], {}),
    ("bench", "bench", [], ["b.json", "b.png"], ["bench", "scan", "--sizes", "4096", "--repeat", "10", "--json", "b.json", "--plot", "b.png"], {}),
    ("tune", "tune", ["json"], ["tune.json"], ["tune", "--json", "tune.json"], {}),
    ("LUTETIA_TRACE", "", [], ["trace.json"], ["./program"], {"LUTETIA_TRACE": "trace.json"}),
    ("LUTETIA_EXPLAIN", "", [], ["explained"], ["./program"], {"LUTETIA_EXPLAIN": "explained"}),
    ("LUTETIA_EXPLAIN_JSON", "", [], ["explained.json"], ["./program"], {"LUTETIA_EXPLAIN_JSON": "explained.json"}),
    ("LUTETIA_LEDS", "", [], ["run.leds"], ["./program"], {"LUTETIA_LEDS": "run.leds"}),
    ("LUTETIA_DISPLAY", "", [], ["p.display"], ["./program"], {"LUTETIA_DISPLAY": "p.display"}),
    ("LUTETIA_DUMP", "", [], ["dump/"], ["paint", "k", "--paper", "64x64", "--steps", "2", "-o", "p.png"], {"LUTETIA_DUMP": "dump"}),
    ("LUTETIA_TRACE of a verb", "", [], ["verb.json"],
     ["paint", "k", "--paper", "64x64", "--steps", "2", "-o", "p.png"], {"LUTETIA_TRACE": "verb.json"}),
]
SLOW = {"demo", "tune"}  # tried in full runs only
# Options and verbs that write no file of their own without a window or a server.
NOT_TRIED = {("spring", "session"): "written by a window", ("spring", "record"): "written by a window",
             ("spring", "watch"): "read by a window", ("keys", "watch"): "read by a window",
             ("info", None): "prints only", ("run", "in"): "a folder", ("studio", None): "opens a window", ("studio", "play"): "opens a window", ("read", "play"): "opens a window", ("keys", "filter"): "of what is heard, no file"}

# What a command line reads: @ is the file.
INPUTS = [
    ("paint", "image", ["paint", "--image", "@", "-o", "o.png"]),
    ("paint", "font", ["paint", "a", "--font", "@", "-o", "o.png"]),
    ("type", "font", ["type", "a", "--font", "@", "-o", "o.png"]),
    ("type", "edits", ["type", "a", "--edits", "@", "-o", "o.png"]),
    ("font", "edits", ["font", "DejaVuSans", "--edits", "@", "-o", "o.png"]),
    ("set", "edits", ["set", "text.txt", "--edits", "@", "-o", "o.png"]),
    ("spring", "edits", ["spring", "a", "--edits", "@", "--still", "o.png"]),
    ("paint", "edits", ["paint", "a", "--edits", "@", "-o", "o.png"]),
    ("keys", "edits", ["keys", "song.mid", "--edits", "@", "--still", "o.png"]),
    ("voice", "edits", ["voice", "--cry", "a", "--edits", "@", "-o", "o.png"]),
    ("font", "against", ["font", "DejaVuSans", "--against", "@", "-o", "o.png"]),
    ("type", "texture", ["type", "a", "--texture", "@", "-o", "o.png"]),
    ("paint", "filter", ["paint", "a", "--filter", "@@", "-o", "o.png"]),
    ("set", "filter", ["set", "text.txt", "--filter", "@@", "-o", "o.png"]),
    ("spring", "filter", ["spring", "a", "--filter", "@@", "--still", "o.png"]),
    ("type", "filter", ["type", "a", "--filter", "@@", "-o", "o.png"]),
    ("set", None, ["set", "@", "-o", "o.png"]),
    ("set", "font", ["set", "text.txt", "--font", "@", "-o", "o.png"]),
    ("read", None, ["read", "@", "-o", "o.png"]),
    ("read", "font", ["read", "text.txt", "--font", "@", "-o", "o.png"]),
    ("read", "mono", ["read", "text.txt", "--mono", "@", "-o", "o.png"]),
    ("read", "template", ["read", "text.txt", "--template", "@", "-o", "o.html"]),
    ("read", "math", ["read", "formula.md", "--math", "@", "-o", "o.png"]),
    ("font", None, ["font", "@", "-o", "o.png"]),
    ("font", "master", ["font", "DejaVuSans", "--glyph", "a", "--master", "@", "-o", "o.png"]),
    ("font", "filter", ["font", "--show-filter", "--filter", "@@", "-o", "o.png"]),
    ("spring", "network", ["spring", "--network", "@", "--still", "o.png"]),
    ("spring", "font", ["spring", "a", "--font", "@", "--still", "o.png"]),
    ("spring", "script", ["spring", "a", "--script", "@", "--still", "o.png"]),
    ("spring", "map", ["spring", "a", "--map", "@", "--song", "song.mid", "--still", "o.png"]),
    ("spring", "knobs", ["spring", "a", "--knobs", "@", "--song", "song.mid", "--still", "o.png"]),
    ("spring", "cues", ["spring", "a", "--cues", "@", "--still", "o.png"]),
    ("spring", "song", ["spring", "a", "--map", "map.lua", "--song", "@", "--still", "o.png"]),
    ("spring", "theme", ["spring", "a", "--theme", "@", "--still", "o.png"]),
    ("spring", "replay", ["spring", "a", "--replay", "@", "--video", "o.y4m"]),
    ("stage", None, ["stage", "@.lua", "--still", "o.png"]),
    ("voice", None, ["voice", "@", "a", "-o", "o.png"]),
    ("voice", "transcript", ["voice", "s.wav", "--transcript", "@", "-o", "o.png"]),
    ("voice", "font", ["voice", "--cry", "a", "--font", "@", "-o", "o.png"]),
    ("run", None, ["run", "@"]),
    ("run", "resume", ["run", "nothing.lua", "-q", "--resume", "@"]),
    ("leds", None, ["leds", "@", "-o", "o.png"]),
    ("display", None, ["display", "-o", "o.png", "@"]),
    ("explain", None, ["explain", "@"]),
    ("debug", None, ["debug", "--batch", "@"]),
    ("debug", "commands", ["debug", "--batch", "--commands", "@", "./nothing"]),
    ("cc", None, ["cc", "@.c", "-o", "o.prog"]),
    ("explain", None, ["explain", "@.c"]),
    ("keys", None, ["keys", "@", "-o", "o.png"]),
    ("keys", "map", ["keys", "song.mid", "--map", "@", "-o", "o.png"]),
    ("keys", "map", ["keys", "song.mid", "--map", "@.lua", "--still", "o.png"]),
    ("keys", "knobs", ["keys", "song.mid", "--knobs", "@", "--still", "o.png"]),
    ("keys", "cues", ["keys", "song.mid", "--cues", "@", "--still", "o.png"]),
    ("keys", "theme", ["keys", "song.mid", "--map", "map.lua", "--theme", "@", "--still", "o.png"]),
    ("keys", "font", ["keys", "song.mid", "--font", "@", "-o", "o.png"]),
    ("midi", None, ["midi", "render", "@", "-o", "o.wav"]),
    ("midi", None, ["midi", "play", "@"]),
    ("midi", "soundfont", ["midi", "render", "song.mid", "--soundfont", "@", "-o", "o.wav"]),
]


def files_make(at):
    """What the command lines read."""
    (at / "song.mid").write_bytes(SONG)
    (at / "sheet.lua").write_text(SHEET)
    (at / "nothing.lua").write_text("")
    (at / "map.lua").write_text("function note(n) end\n")
    (at / "s.wav").write_bytes(b"RIFF" + struct.pack("<I", 36 + 16000) + b"WAVEfmt " + struct.pack("<IHHIIHH", 16, 1, 1, 16000, 32000, 2, 16) +
                               b"data" + struct.pack("<I", 16000) + bytes(16000))
    (at / "prog.c").write_text(PROGRAM)
    (at / "lights.leds").write_bytes(LEDS)
    (at / "run.display").write_bytes(DISPLAY)
    (at / "text.txt").write_text("A marsh, an island and a town with walls. " * 80 + "\n\n" + "Rain. " * 400)
    (at / "formula.md").write_text("It is $x^2$ deep.")
    for name in ("pages", "run"):
        (at / name).mkdir(exist_ok=True)


def options_of(lutetia):
    """The verbs, and (verb, option) of the options that name a file or a folder."""
    table = subprocess.run([lutetia, "help", "--table"], capture_output=True, text=True, check=True).stdout
    verb, verbs, found = "", [], set()
    for line in table.splitlines():
        words = line.split("\t")
        if words[0] == "verb":
            verb = words[1]
            verbs += [verb] if verb not in verbs else []
        elif words[0] == "option" and verb and (re.search("FILE|DIR", words[4]) or words[1] in ("font", "filter") and
                                                verb != "midi" and "file" in words[7].lower() + "file" * (words[1] == "filter")):
            found.add((verb, words[1]))
    return verbs, found


def forgotten(lutetia):
    """Verbs and options that no row tries. Outputs that this build cannot make are no longer tried."""
    verbs, options = options_of(lutetia)
    known = {(verb, option) for _, verb, options, *_ in OUTPUTS for option in options} | set(NOT_TRIED)
    known |= {(verb, option) for verb, option, _ in INPUTS}
    markdown = subprocess.run([lutetia, "read", "-", "-o", "/nowhere/read.png"], input=b"a", capture_output=True, check=False)
    if b"cmark-gfm" in markdown.stderr:
        OUTPUTS[:] = [row for row in OUTPUTS if row[1] != "read"]
    tried = {verb for verb, _ in known} | {"cc", "bench"}
    return sorted("%s --%s" % pair for pair in options - known) + [verb for verb in verbs if verb not in tried]
