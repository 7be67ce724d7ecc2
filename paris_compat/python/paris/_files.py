"""Pictures and states as NumPy arrays. Neither needs the machine.

A PNG file's rows are filtered: each byte is told as its difference to one that is guessed from its neighbours to the left, above, and above to
the left. Those of a diagonal depend on earlier diagonals alone, so a diagonal at a time is computed:

    0 1 2 3       picture, rows of pixels; the number is the diagonal's.
    1 2 3 4       NumPy does all pixels of one number together.
    2 3 4 5
"""
import struct
import zlib

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}
_DEPTHS = {0: (1, 2, 4, 8, 16), 2: (8, 16), 3: (1, 2, 4, 8), 4: (8, 16), 6: (8, 16)}
_BYTES_MOST, _SIDE_MOST = 1 << 30, 1 << 16


def _chunks(data):
    """{kind: bytes} of a PNG file; those of one kind are joined."""
    found, at = {}, len(_SIGNATURE)
    if data[:at] != _SIGNATURE:
        raise ValueError("this is no PNG file")
    while b"IEND" not in found:
        head = data[at:at + 8]
        if len(head) < 8:
            raise ValueError("the file is cut short")
        length, kind = struct.unpack(">I4s", head)
        body, check = data[at + 8:at + 8 + length], data[at + 8 + length:at + 12 + length]
        if len(body) < length or len(check) < 4:
            raise ValueError("the file is cut short")
        if struct.unpack(">I", check)[0] != zlib.crc32(kind + body):
            raise ValueError("the file is damaged")
        found.setdefault(kind, []).append(body)
        at += 12 + length
    return {kind: b"".join(bodies) for kind, bodies in found.items()}


def _unfiltered(filters, rows):
    """The bytes of rows x pixels x bytes of a pixel."""
    import numpy
    height, width, depth = rows.shape
    out = numpy.zeros((height + 1, width + 1, depth), "i2")  # a row above and a column to the left of zeros
    rows, kinds = rows.astype("i2"), filters[:, None]
    for diagonal in range(height + width - 1):
        row = numpy.arange(max(0, diagonal - width + 1), min(height, diagonal + 1))
        column, kind = diagonal - row, kinds[row]
        left, above, corner = out[row + 1, column], out[row, column + 1], out[row, column]
        to_left, to_above = abs(above - corner), abs(left - corner)
        to_corner = abs(above + left - 2 * corner)
        nearest = numpy.where((to_left <= to_above) & (to_left <= to_corner), left, numpy.where(to_above <= to_corner, above, corner))
        guess = numpy.choose(kind, [numpy.zeros_like(left), left, above, (left + above) >> 1, nearest])
        out[row + 1, column + 1] = (rows[row, column] + guess) & 255
    return out[1:, 1:].astype("u1")


def _picture(data):
    import numpy
    chunks = _chunks(data)
    if len(chunks.get(b"IHDR", b"")) != 13 or b"IDAT" not in chunks:
        raise ValueError("the file is damaged")
    width, height, depth, colours, method, filtering, interlaced = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    if depth not in _DEPTHS.get(colours, ()) or method or filtering or interlaced > 1 or not 0 < width < 1 << 31 or not 0 < height < 1 << 31:
        raise ValueError("the file is damaged")
    if interlaced:
        raise ValueError("the picture is interlaced; save it without")
    stride, pixel = (width * _CHANNELS[colours] * depth + 7) // 8, max(_CHANNELS[colours] * depth // 8, 1)
    if height * (stride + 1) > _BYTES_MOST or max(width, height) > _SIDE_MOST:
        raise ValueError(f"a picture of {width} x {height} is too large")
    inflate = zlib.decompressobj()
    try:
        raw = inflate.decompress(chunks[b"IDAT"], height * (stride + 1) + 1)
    except zlib.error:
        raise ValueError("the file is damaged") from None
    lines = numpy.frombuffer(raw, "u1")
    if lines.size != height * (stride + 1) or lines[::stride + 1].max() > 4:
        raise ValueError("the file is damaged")
    lines = lines.reshape(height, stride + 1)
    rows = _unfiltered(lines[:, 0], lines[:, 1:].reshape(height, stride // pixel, pixel)).reshape(height, stride)
    if depth == 16:
        samples = rows.view(">u2").astype("u2")
    elif depth < 8:
        bits = numpy.unpackbits(rows, axis=1).reshape(height, -1, depth)
        samples = numpy.packbits(bits, axis=2)[:, :width, 0] >> (8 - depth)
        samples = samples if colours == 3 else samples * (255 // ((1 << depth) - 1))
    else:
        samples = rows
    if colours == 3:
        return _coloured(samples, chunks)
    channels = _CHANNELS[colours]
    return samples.reshape(height, width) if channels == 1 else samples.reshape(height, width, channels)


def _coloured(numbers, chunks):
    """Numbers of colours as colours; with alpha, where the file has one for them."""
    import numpy
    palette = numpy.frombuffer(chunks.get(b"PLTE", b""), "u1")
    if not palette.size or palette.size % 3 or int(numbers.max()) >= palette.size // 3:
        raise ValueError("the file is damaged")
    palette = palette.reshape(-1, 3)
    if b"tRNS" in chunks:
        alpha = numpy.full(len(palette), 255, "u1")
        given = numpy.frombuffer(chunks[b"tRNS"], "u1")[:len(palette)]
        alpha[:given.size] = given
        palette = numpy.hstack([palette, alpha[:, None]])
    return palette[numbers]


def picture(path):
    """Reads a PNG file: rows from top to bottom, as u1 or u2 (16 bits).

    Gray has the shape (height, width); colours (height, width, 3), and 4 with alpha; gray with alpha (height, width, 2). ValueError: it is
    no such file, is damaged, interlaced, or larger than a gigabyte or 65,536 along a side.
    """
    with open(path, "rb") as file:
        data = file.read()
    try:
        return _picture(data)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def state(path):
    """Reads the sheets of a saved state, or any HDF5 file: {"sheet-1/planes/height": array, ...}. It needs h5py (python3-h5py).

    Read files that you trust: HDF5's library is not made for others."""
    import h5py
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found
