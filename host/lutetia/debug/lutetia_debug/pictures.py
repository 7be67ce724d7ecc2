"""Fields as tables and pictures: characters of a terminal, and PNG files."""
import math
import os
import struct
import tempfile
import zlib

SHADES = " ░▒▓█"
PLAIN = " .:-=+*#%@"


def planes(field):
    """(rows, columns) of the picture: the last axis goes to the right, all others together go down."""
    return field.count // field.axes[-1], field.axes[-1]


def parts(count, most):
    """Where each of at most so many pieces of a length begins, and the end."""
    pieces = min(count, most)
    return [count * i // pieces for i in range(pieces + 1)]


def table(field, rows_most=12, columns_most=8):
    """Lines; what is inactive is in parentheses."""
    rows, columns = planes(field)
    shown = range(min(rows, rows_most)), range(min(columns, columns_most))
    cells = []
    for row in shown[0]:
        line = []
        for column in shown[1]:
            i = row * columns + column
            text = field.text(field.values[i])
            line.append(text if field.active[i] or "bits" not in field.facts else f"({text})")
        cells.append(line)
    names = [" ".join(map(str, field.place(row * columns)[:-1])) for row in shown[0]]
    broad = max([len(text) for line in cells for text in line] + [len(str(columns_most))])
    left = max(map(len, names))
    out = [" " * left + "   " + " ".join(f"{column:>{broad}}" for column in shown[1]) + (" ..." if columns > columns_most else "")]
    out += [f"{name:>{left}} | " + " ".join(f"{text:>{broad}}" for text in line) + (" ..." if columns > columns_most else "")
            for name, line in zip(names, cells)]
    if rows > rows_most:
        out.append(f"... {rows} rows; `at` shows one processor, `picture` all")
    return out


def grays(field):
    """From 0 to 1 for each processor, None for what is no number; and the least and the greatest number."""
    finite = [x for x in field.values if not isinstance(x, float) or math.isfinite(x)]
    least, most = (min(finite), max(finite)) if finite else (0, 0)
    if field.length == 1 and field.letter != "f":
        least, most = 0, 1
    span = most - least

    def gray(x):
        if x != x:
            return None
        return 0.0 if not span or x < least else 1.0 if x > most else (x - least) / span
    return [gray(x) for x in field.values], least, most


def shrunk(gray, rows, columns, rows_most, columns_most, bits):
    """Pieces of the picture as one number each: bits by any that is 1, others by their mean; None if one in it is."""
    down, across = parts(rows, rows_most), parts(columns, columns_most)
    out = []
    for top, bottom in zip(down, down[1:]):
        line = []
        for first, last in zip(across, across[1:]):
            piece = [gray[row * columns + column] for row in range(top, bottom) for column in range(first, last)]
            line.append(None if None in piece else max(piece) if bits else sum(piece) / len(piece))
        out.append(line)
    return out


def colour(gray):
    return 196 if gray is None else 232 + round(23 * gray)


def in_colours(image):
    """Half blocks: the upper and the lower half of a character are a row each."""
    out = []
    for upper, lower in zip(image[::2], image[1::2] + [[0.0] * len(image[0])]):
        out.append("".join(f"\x1b[38;5;{colour(a)};48;5;{colour(b)}m▀" for a, b in zip(upper, lower)) + "\x1b[0m")
    return out


def in_blocks(image, bits):
    """The same without colours: bits exactly, others by five shades; ! is no number."""
    out = []
    for upper, lower in zip(image[::2], image[1::2] + [[0.0] * len(image[0])]):
        line = ""
        for a, b in zip(upper, lower):
            if a is None or b is None:
                line += "!"
            elif bits:
                line += " ▄▀█"[2 * (a > 0.5) + (b > 0.5)]
            else:
                line += SHADES[min(int((a + b) / 2 * 5), 4)]
        out.append(line)
    return out


def in_letters(image):
    return ["".join("!" if a is None else PLAIN[min(int(a * 10), 9)] for a in line) for line in image[::2]]


def terminal(field, columns_most, rows_most, colours, blocks):
    rows, columns = planes(field)
    gray, least, most = grays(field)
    bits = field.length == 1 and field.letter != "f"
    image = shrunk(gray, rows, columns, 2 * rows_most, columns_most, bits)
    lines = in_colours(image) if colours and blocks else in_blocks(image, bits) if blocks else in_letters(image)
    lines = [f"|{line}|" for line in lines]
    if not bits:
        lines.append(f"dark is {field.text(least)}, light is {field.text(most)}")
    return lines


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(field, name):
    """A pixel for each processor, gray; what is no number is red. The file appears whole under its name."""
    rows, columns = planes(field)
    gray = grays(field)[0]
    lines = bytearray()
    for row in range(rows):
        lines.append(0)
        for a in gray[row * columns:(row + 1) * columns]:
            lines += b"\xff\0\0" if a is None else bytes([round(255 * a)]) * 3
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)) + \
        chunk(b"IDAT", zlib.compress(bytes(lines))) + chunk(b"IEND", b"")
    folder = os.path.dirname(os.path.abspath(name))
    handle, part = tempfile.mkstemp(prefix=".lutetia-", dir=folder)
    try:
        with os.fdopen(handle, "wb") as out:
            out.write(data)
            out.flush()
            os.fsync(out.fileno())
        os.chmod(part, 0o644)
        os.replace(part, name)
    except BaseException:
        os.unlink(part)
        raise
    return f"{name}: {columns}x{rows}"
