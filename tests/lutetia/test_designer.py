"""test_designer.py LUTETIA FOLDER [KEEP]: a day's work of a type designer, by the command alone.

An ampersand is retouched in its master, as a painting program would do it; a ligature is drawn anew as an outline, as a drawing program
writes it. Both are then on a line, on a page, on springs, on wet paper and in a script; what was not edited is as it was, to the byte. The ink is
compared with the master's own pixels, and with the area of the outline's boxes. KEEP: a folder in which the pictures of docs/fonts.md are left.
"""
import pathlib
import shutil
import struct
import subprocess
import sys
import zlib

lutetia, folder = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
FONT, LIGATURE, EM = "EBGaramond12-Italic", "uniFB03", 860
BOXES = ((90, -690, 150, 220), (30, -410, 600, -360), (540, 0 - 410, 600, 0), (300, -690, 360, 220))


def run(*words, status=0):
    done = subprocess.run([lutetia, *words], cwd=folder, capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == status and bool(done.stderr) == bool(status), (words, done.returncode, done.stderr)
    return done.stdout


def png_read(name):
    """Width, height, and rows of bytes, of gray or RGB with 8 bits."""
    data, at, pixels = (folder / name).read_bytes(), 8, b""
    while at < len(data):
        count, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + count]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
        pixels += body if kind == b"IDAT" else b""
        at += 12 + count
    assert depth == 8 and colour in (0, 2)
    step, pixels = 3 if colour else 1, zlib.decompress(pixels)
    rows, before = [], bytes(step * width)
    for y in range(height):
        begin = y * (step * width + 1)
        how, row = pixels[begin], bytearray(pixels[begin + 1:begin + 1 + step * width])
        for x, value in enumerate(row):
            left, up, corner = (row[x - step], before[x], before[x - step]) if x >= step else (0, before[x], 0)
            near = left + up - corner
            best = min((abs(near - left), 0, left), (abs(near - up), 1, up), (abs(near - corner), 2, corner))[2]
            row[x] = (value + (0, left, up, (left + up) // 2, best)[how]) & 255
        rows.append(row)
        before = row
    return width, height, rows


def png_write(name, rows):
    def piece(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    (folder / name).write_bytes(
        b"\x89PNG\r\n\x1a\n" + piece(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)) +
        piece(b"IDAT", zlib.compress(b"".join(b"\0" + bytes(row) for row in rows))) + piece(b"IEND", b""))


def ink(name):
    """How many pixels the ink of a line covers, that was mixed as numbers."""
    _, _, rows = png_read(name)
    return sum(255 - value for row in rows for value in row[::3]) / 255


def line(text, *words):
    run("type", text, "--filter", "box", "--darken", "0", "--gamma", "1", "-o", "line.png", *words)
    return ink("line.png")


def same(*words):
    """Whether a picture is the same with the edits as without."""
    made = []
    for font in (FONT, "mine"):
        run(*words, "--font", font)
        made.append((folder / words[-1]).read_bytes())
    return made[0] == made[1]


if subprocess.run([lutetia, "font", FONT, "-o", "/dev/null"], capture_output=True, text=True, check=False).stderr.find("there is no font") >= 0:
    sys.exit(77)
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
(folder / "page.txt").write_text("# R & D\n\nThe *office & affine*.\n")
(folder / "plain.txt").write_text("Nothing of it here.\n")

# In the morning: levels are written out. As they were written they change nothing.
run("font", FONT, "--glyph", "&", "--em", str(EM), "--edits", "mine", "--write", "master", "-o", "levels.png")
run("font", FONT, "--glyph", LIGATURE, "--edits", "mine", "--write", "outline", "-o", "levels.png")
assert same("type", "office & affine", "-o", "line.png")

# The ampersand's master gets a ball in its lower bowl, and loses a notch.
width, height, rows = png_read("mine/ampersand.png")
for y in range(height):
    for x in range(width):
        if (x - 0.36 * width) ** 2 + (y - 0.66 * height) ** 2 < (0.07 * width) ** 2:
            rows[y][x] = 0
        if 0.80 * height < y < 0.84 * height and x < 0.5 * width:
            rows[y][x] = 255
png_write("mine/ampersand.png", rows)
black = sum(value < 128 for row in rows for value in row)
got = line("&", "--size", str(EM / 8), "--font", FONT, "--edits", "mine")
assert abs(got / (black / 64) - 1) < 0.001, (got, black / 64)

# The ligature is drawn anew, wider than it was.
paths = "".join(f"<path d='M{x0} {y0}H{x1}V{y1}H{x0}Z'/>" for x0, y0, x1, y1 in BOXES)
(folder / f"mine/{LIGATURE}.svg").write_text(f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 -710 760 1000'>{paths}</svg>")
area = len({(x, y) for x0, y0, x1, y1 in BOXES for x in range(x0, x1, 10) for y in range(y0, y1, 10)}) * 100
got = line("ffi", "--size", "100", "--font", "mine")
assert abs(got / (area / 100) - 1) < 0.003, (got, area / 100)
said = run("font", FONT, "--edits", "mine", "-o", "specimen.png")
assert said.count(", edited") == 2, said

# In the afternoon they are used; what has neither of them is as it was.
for usual, edited in ((("type", "Nothing else", "-o", "l.png"), ("type", "office", "-o", "l.png")),
                      (("set", "plain.txt", "--paper", "300x200", "-o", "p.png"), ("set", "page.txt", "--paper", "300x200", "-o", "p.png")),
                      (("spring", "word", "--seconds", "0.2", "--size", "96x64", "--still", "s.png"),
                       ("spring", "ffi", "--seconds", "0.2", "--size", "96x64", "--still", "s.png")),
                      (("paint", "wet", "--paper", "96x64", "--steps", "8", "-o", "w.png"),
                       ("paint", "&", "--paper", "96x64", "--steps", "8", "-o", "w.png"))):
    assert same(*usual), usual
    assert not same(*edited), edited
    # --edits is the folder's font, and with --font that font with the folder's edits.
    by_folder = (folder / edited[-1]).read_bytes()
    for words in ((), ("--font", FONT))[edited[0] != "type":]:
        run(*edited, "--edits", "mine", *words)
        assert (folder / edited[-1]).read_bytes() == by_folder, (edited, words)
for name, font in (("own", FONT), ("edited", "mine")):
    (folder / f"{name}.lua").write_text("local p = paper{width = 96, height = 64}\n"
                                        f"p:put(text('&', {{font = '{font}', size = 50, x = 20, y = 50}}), {{water = 0.4}})\n"
                                        f"p:step(2)\np:frame('{name}.png')\n")
    run("run", f"{name}.lua", "-q", "-o", ".")
assert (folder / "own.png").read_bytes() != (folder / "edited.png").read_bytes()
# A script reads edits in its own folder alone. (security.md 1)
(folder / "elsewhere").mkdir()
run("run", "edited.lua", "--in", "elsewhere", "-q", "-o", ".", status=1)
# In the evening there is another version of the font: each verb says so, a script once.
shutil.copytree(folder / "mine", folder / "older")
rows = (folder / "older/edits.txt").read_text()
at = rows.index("sha256 ") + 7
(folder / "older/edits.txt").write_text(rows[:at] + "0" * 64 + rows[at + 64:])
(folder / "both.lua").write_text((folder / "edited.lua").read_text().replace("'mine'", f"'{FONT}+older'") +
                                 f"text('&', {{font = '{FONT}+older', size = 20}})\n")
for words in (("run", "both.lua", "-q", "-o", "."), ("type", "&", "--edits", "older", "-o", "l.png"),
              ("paint", "&", "--edits", "older", "--paper", "96x64", "--steps", "8", "-o", "w.png")):
    done = subprocess.run([lutetia, *words], cwd=folder, capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == 0 and done.stderr.count("has changed since the edits in") == 1, (words, done.stderr)
assert (folder / "own.png").read_bytes() != (folder / "edited.png").read_bytes()
run("run", "both.lua", "--in", "elsewhere", "-q", "-o", ".", status=1)
for verb in (("set", "page.txt"), ("spring", "word"), ("keys", "x.mid"), ("voice", "x.wav", "Text"), ("paint", "wet"), ("type", "a")):
    run(*verb, "--edits", "nowhere", status=1)

# A filter's words may be in a file, for each verb.
(folder / "soft.txt").write_text("# soft\ncone: 2\n")
for words in (("set", "plain.txt", "--paper", "300x200", "-o", "f.png"), ("paint", "wet", "--paper", "96x64", "--steps", "2", "-o", "f.png"),
              ("spring", "word", "--seconds", "0.1", "--size", "96x64", "--still", "f.png")):
    made = []
    for name in ("cone:2", "@soft.txt", "box"):
        run(*words, "--filter", name)
        made.append((folder / "f.png").read_bytes())
    assert made[0] == made[1] != made[2], words

if sys.argv[3:]:
    keep = pathlib.Path(sys.argv[3]).resolve()
    (folder / f"mine/{LIGATURE}.svg").write_text(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 -710 690 1000'><g transform='matrix(1 0 -0.2 1 0 0)'>"
        "<path d='M90 220V-540C90 -640 150 -690 240 -690H330V-630H250C190 -630 150 -600 150 -540V220Z'/>"
        "<path d='M300 220V-540C300 -640 360 -690 450 -690H610V-630H460C400 -630 360 -600 360 -540V220Z'/>"
        "<path d='M30 -410H600V-360H30Z'/><path d='M540 0V-410H600V0Z'/></g></svg>")
    (folder / "page.txt").write_text("An office & its affine staff\n\nof officers & traffic wardens\n\nsuffice & are efficient.\n")
    run("set", "page.txt", "--font", "mine", "--size", "34", "--paper", "440x190", "--margin", "16", "-o", str(keep / "edits-page.png"))
    run("spring", "office &", "--font", "mine", "--seconds", "0.4", "--size", "440x200", "--still", str(keep / "edits-springs.png"))
    run("paint", "office &", "--font", "mine", "--paper", "440x160", "--steps", "120", "-o", str(keep / "edits-paper.png"))
