#!/usr/bin/env python3
"""Tests the Python module `paris`.

    test_paris.py LUTETIA RANDOM HEADERS DATA [PROGRAMS]

LUTETIA is the command, RANDOM the generator of random programs (test_random), HEADERS the folder of <cm/paris.h>, DATA a library
with data_real() and data_word(), the generator's data. Each random program is compiled as C and performed by Python; both print
the same. 77: NumPy is not installed.
"""
import ctypes
import io
import os
import re
import struct
import subprocess
import sys
import tempfile
import zlib

try:
    import numpy as np
except ImportError:
    print("skipped: NumPy is not installed for this python3")
    sys.exit(77)
import paris
from paris import *
from paris._names import CALLS, CONSTANTS, VARIABLES

LUTETIA, RANDOM, HEADERS, DATA = map(os.path.abspath, sys.argv[1:5])
PROGRAMS = int(sys.argv[5]) if len(sys.argv) > 5 else 20
C_TYPES = {"v": "void", "i": "int", "u": "unsigned int", "l": "long", "m": "unsigned long", "d": "double", "c": "CM_complex_t",
           "V": "CM_vector_t", "R": "const void *", "W": "void *", "A": "CM_axis_descriptor_t *",
           "S": "const char *", "H": "void (*) (const char *)", "B": "const unsigned char *", "b": "unsigned char *", "L": "unsigned int *",
           ".": "..."}
HAND_WRITTEN = "cm/cmfb.h", "cm/cmfs.h", "lutetia/fields.h"


def signatures_are_the_headers():
    """A C compiler compares each name's types with the headers'; and no name of a header is missing."""
    lines = [f"#include <{name}>" for name in ("cm/paris.h", *HAND_WRITTEN)]
    for name, letters in CALLS.items():
        arguments = ", ".join(C_TYPES[x] for x in letters[1:]) or "void"
        lines.append(f'_Static_assert (__builtin_types_compatible_p (__typeof__ ({name}), {C_TYPES[letters[0]]} ({arguments})), "{name}");')
    lines += [f'_Static_assert ({name} == {value}, "{name}");' for name, value in CONSTANTS.items()]
    lines += [f'_Static_assert (__builtin_types_compatible_p (__typeof__ ({name}), {C_TYPES[x]}), "{name}");' for name, x in VARIABLES.items()]
    made = subprocess.run(["cc", "-std=gnu17", "-fsyntax-only", "-I" + HEADERS, "-x", "c", "-"], input="\n".join(lines), text=True, capture_output=True)
    assert made.returncode == 0, made.stderr[:3000]
    header = "".join(open(os.path.join(HEADERS, name)).read() for name in ("cm/paris.h", *HAND_WRITTEN))
    # What the headers declare, as the compiler's list of names has it.
    listed = subprocess.run(["cc", "-std=gnu17", "-E", "-P", "-I" + HEADERS, "-x", "c", "-"], input="\n".join(lines[:1 + len(HAND_WRITTEN)]),
                            text=True, capture_output=True, check=True).stdout
    declared = set(re.findall(r"\b((?:CM(?:FB|FS)?|lutetia)_\w+) ?\((?!\*)", listed))
    assert declared == set(CALLS), declared ^ set(CALLS)
    defined = set(re.findall(r"^#define ((?:CM|CMFB|CMFS)_\w+) \w", header, re.M)) - {"CM_CMFB_H", "CM_CMFS_H"}
    assert defined == set(CONSTANTS), defined ^ set(CONSTANTS)
    for name in CALLS:
        getattr(paris, name)


def set_make(*lengths):
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(lengths, len(lengths))))


def address_of(place):
    geometry, address = CM_vp_set_geometry(paris.CM_current_vp_set), 0
    for axis, coordinate in enumerate(place):
        address = CM_fe_deposit_news_coordinate(geometry, address, axis, coordinate)
    return address


def arrays_are_fields():
    """Each type and several ranks: every element stands where the calls for one processor find it."""
    rng = np.random.default_rng(1)
    for lengths in ((7,), (3, 5), (4, 1, 6), (2, 3, 2, 2)):
        set_make(*lengths)
        assert paris.shape() == lengths
        for kind in "?", "u1", "u2", "u4", "u8", "i1", "i2", "i4", "i8", "f4", "f8", "c8", "c16":
            dtype = np.dtype(kind)
            values = rng.integers(-120, 120, lengths)
            array = (values % 2 if kind == "?" else values % 200 if kind[0] == "u" else values).astype(dtype)
            field = CM_allocate_heap_field(1 if kind == "?" else dtype.itemsize * 8)
            paris.write(field, array)
            for place in np.ndindex(*lengths):
                a, n = address_of(place), dtype.itemsize * 8
                if kind == "f4":
                    got = CM_f_read_from_processor_1L(a, field, 23, 8)
                elif kind == "f8":
                    got = CM_f_read_from_processor_1L(a, field, 52, 11)
                elif kind == "c8":
                    got = CM_c_read_from_processor_1L(a, field, 23, 8)
                elif kind == "c16":
                    got = CM_c_read_from_processor_1L(a, field, 52, 11)
                elif kind[0] == "i":
                    got = CM_s_read_from_processor_1L(a, field, min(n, 32))
                else:
                    got = CM_u_read_from_processor_1L(a, field, 1 if kind == "?" else min(n, 32))
                assert got == array[place], (kind, place, got, array[place])
            back = paris.read(field, dtype)
            assert back.dtype == dtype and (back == array).all(), (kind, back, array)
            into = np.zeros(lengths, dtype)
            assert paris.read(field, dtype, out=into) is into and (into == array).all()
            CM_deallocate_heap_field(field)


def parts_and_turned_arrays():
    set_make(6, 9)
    field = CM_allocate_heap_field(32)
    whole = np.arange(54, dtype="u4").reshape(6, 9)
    paris.write(field, whole.T.copy().T)  # in Fortran's order
    assert (paris.read(field, "u4") == whole).all()
    assert (paris.read(field, "u4", at=(2, 3), shape=(3, 4)) == whole[2:5, 3:7]).all()
    assert (paris.read(field, "u4", at=(2, 3)) == whole[2:, 3:]).all()
    paris.write(field, np.full((2, 2), 1000, "u4"), at=(4, 0))
    for part in (np.zeros((2, 2), "u4"), np.zeros((0, 9), "u4")):
        raises(ValueError, "say `at` to write a part", paris.write, field, part)
    whole[4:6, 0:2] = 1000
    assert (paris.read(field, "u4") == whole).all()
    # A context does not matter; lengths shorter than the element do.
    CM_clear_context()
    paris.write(field, whole + 1)
    CM_set_context()
    assert (paris.read(field, "u4") == whole + 1).all()
    narrow = CM_allocate_heap_field(5)
    paris.write(narrow, whole)
    assert (paris.read(narrow, "u1") == whole % 32).all()
    signed = CM_allocate_heap_field(12)
    paris.write(signed, whole.astype("i4") - 700)
    assert (paris.read(signed, "i2") == whole.astype("i4") - 700).all()
    half = CM_allocate_heap_field(16)
    paris.write(half, np.full((6, 9), 0.5, "f4"), length=(10, 5))
    assert (paris.read(half, "f4", length=(10, 5)) == 0.5).all()


def raises(kind, words, call, *arguments, **more):
    try:
        call(*arguments, **more)
    except kind as error:
        assert words in str(error), (words, str(error))
        return error
    raise AssertionError(f"{call.__name__}{arguments} was let pass")


def errors_are_exceptions():
    set_make(4, 4)
    field = CM_allocate_heap_field(8)
    paris.write(field, np.arange(16, dtype="u1").reshape(4, 4))
    error = raises(paris.Error, "CM_u_add_2_1L: ", CM_u_add_2_1L, field, CM_no_field, 8)
    assert error.status == CM_error_call
    raises(paris.Error, "", CM_u_move_constant_1L, field, 1, 2000)
    raises(paris.Error, "end_vector", paris.write, field, np.zeros((5, 4), "u1"), at=(0, 0))
    raises(ValueError, "2 axes", paris.write, field, np.zeros(4, "u1"))
    raises(ValueError, "2 axes", paris.read, field, "u1", at=(1,), shape=(1, 1))
    raises(TypeError, "float16", paris.write, field, np.zeros((4, 4), "f2"))
    raises(TypeError, ">u4", paris.write, field, np.zeros((4, 4), ">u4"))
    raises(ValueError, "out must have", paris.read, field, "u1", out=np.zeros((4, 3), "u1"))
    raises(ctypes.ArgumentError, "contiguous", CM_u_read_from_news_array_1L, np.zeros((4, 8), "u1")[:, ::2], [0, 0], [0, 0], [4, 4], [0, 1], field, 8, 2, [4, 4], CM_8_bit)
    frozen = np.zeros((4, 4), "u1")
    frozen.flags.writeable = False
    raises(ctypes.ArgumentError, "written", CM_u_read_from_news_array_1L, frozen, [0, 0], [0, 0], [4, 4], [0, 1], field, 8, 2, [4, 4], CM_8_bit)
    paris.write(field, frozen + np.arange(16, dtype="u1").reshape(4, 4))
    raises(ctypes.ArgumentError, "", CM_u_add_2_1L, field, 1.5, 8)
    raises(ctypes.ArgumentError, "", CM_u_add_2_1L, field, 1 << 40, 8)
    raises(AttributeError, "CM_such", getattr, paris, "CM_such")
    assert (paris.read(field, "u1") == np.arange(16).reshape(4, 4)).all()  # nothing of it had an effect


def data_of(path):
    library = ctypes.CDLL(path)
    library.data_real.restype, library.data_real.argtypes = ctypes.c_double, [ctypes.c_uint32, ctypes.c_uint64]
    library.data_word.restype, library.data_word.argtypes = ctypes.c_uint64, [ctypes.c_uint32, ctypes.c_uint64]
    return library


def to_python(source):
    """The body of main() of a random program, line by line: calls, assignments, loops over processors, prints."""
    out, body = [], source[source.index("int main (void)"):]
    indent = "    "
    for line in body.splitlines()[2:-1]:
        line = line.strip()
        line = re.sub(r"\b(\d+)u\b", r"\1", line).replace("HUGE_VAL", "inf").replace("NAN", "nan")
        if m := re.fullmatch(r"int (lengths\d+)\[\] = \{(.*)\};", line):
            out.append(f"    {m[1]} = [{m[2]}]")
        elif not line or line.startswith(("CM_field_id_t f", "CM_vp_set_id_t ", "int n;", "{ /*", "return", "unsigned ")) and "(" not in line.split("/*")[0]:
            continue
        elif m := re.fullmatch(r"\{ int n; for \(n = (\d+); n < (\d+); n\+\+\) printf \(\"(%\w+)\\n\", (.*)\); \}", line):
            out.append(f"    for n in range({m[1]}, {m[2]}):\n        show('{m[3]}', {m[4]})")
        elif m := re.fullmatch(r"for \(n = (\d+); n < (\d+); n\+\+\)", line):
            out.append(f"    for n in range({m[1]}, {m[2]}):")
            indent = "        "
        elif line in "{}":
            indent = "    "
        elif m := re.fullmatch(r"printf \(\"(%\w+)\\n\", (.*)\);", line):
            out.append(f"{indent}show('{m[1]}', {m[2]})")
        elif line.endswith(";"):
            out.append(indent + line[:-1])
            indent = "    "
        else:
            raise AssertionError(f"a line of a random program is not understood: {line}")
    return "def program():\n" + "\n".join(out) + "\n"


def random_program_is_cs(seed, folder, data):
    source = subprocess.run([RANDOM, "--print", str(seed)], capture_output=True, text=True, check=True).stdout
    declared = "#include <stdint.h>\nuint64_t data_word (uint32_t stream, uint64_t index);\ndouble data_real (uint32_t stream, uint64_t index);\n"
    open(os.path.join(folder, "program.c"), "w").write(declared + source)
    subprocess.run([LUTETIA, "cc", "-std=gnu17", "-w", "program.c", "-o", "program", DATA, "-Wl,-rpath," + os.path.dirname(DATA)], cwd=folder, check=True)
    expected = subprocess.run(["./program"], cwd=folder, capture_output=True, text=True)
    shown = io.StringIO()
    printf = ctypes.CDLL(None).snprintf

    def show(form, value):
        text = ctypes.create_string_buffer(400)
        printf(text, 400, (form + "\n").encode(), ctypes.c_double(value) if form[-1] in "agef" else ctypes.c_ulong(value & 0xffffffffffffffff))
        shown.write(text.value.decode())

    def address(vp_set, n):
        geometry, a = CM_vp_set_geometry(vp_set), 0
        for axis in range(CM_geometry_rank(geometry) - 1, -1, -1):
            length = CM_geometry_axis_length(geometry, axis)
            a = CM_fe_deposit_news_coordinate(geometry, a, axis, n % length)
            n //= length
        return a

    names = {name: getattr(paris, name) for name in [*CALLS, *CONSTANTS]}
    text = to_python(source)
    text = re.sub(r"\bCM_current_vp_set\b", "paris.CM_current_vp_set", text)
    environment = names | {"paris": paris, "show": show, "address": address, "inf": float("inf"), "nan": float("nan"),
                           "data_real": data.data_real, "data_word": data.data_word}
    exec(text, environment)
    failed = None
    try:
        environment["program"]()
    except paris.Error as error:
        failed = str(error)
    assert (failed is None) == (expected.returncode == 0), (seed, failed, expected.stderr)
    assert shown.getvalue() == expected.stdout, (seed, shown.getvalue(), expected.stdout)
    return len(expected.stdout.splitlines())


def a_machine_goes_to_a_file():
    """And comes back, under the same ids, with the program's own array."""
    CM_init()
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry([6, 10], 2)))
    field, values = CM_allocate_heap_field(32), np.arange(60, dtype="f4").reshape(6, 10)
    paris.write(field, values)
    own = np.array([field, 7], dtype="u4")
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "machine")
        assert CM_resume(name, own, own.nbytes) == 0  # there is none yet
        assert CM_checkpoint(name, own, own.nbytes) == 1
        CM_init()
        again = np.zeros(2, dtype="u4")
        assert CM_resume(name, again, again.nbytes) == 1
    assert again.tolist() == own.tolist()
    assert np.array_equal(paris.read(int(again[0]), "f4"), values)


def displays_show_fields():
    """What Python writes to a display is what the command reads from its recording; and picture() reads that."""
    set_make(12, 20)
    gray, colours = np.arange(240, dtype="u1").reshape(12, 20), np.random.default_rng(3).integers(0, 256, (12, 20, 3), "u1")
    field, red, green, blue = (CM_allocate_heap_field(8) for _ in range(4))
    with tempfile.TemporaryDirectory() as folder:
        recording, out = os.path.join(folder, "run.display"), os.path.join(folder, "out.png")
        os.environ["LUTETIA_DISPLAY"] = recording
        try:
            one, two = CMFB_attach_display("eight"), CMFB_attach_display("")
            assert (one, two, CMFB_attached(two), CMFB_attached(5), CMFB_watched()) == (1, 2, 1, 0, 1)
            CMFB_initialize_display(one, 8, 20, 12)
            CMFB_initialize_display(two, 24, 20, 12)
            assert (CMFB_display_bits(one), CMFB_display_width(two), CMFB_display_height(two)) == (8, 20, 12)
            map_red, rest = np.arange(255, -1, -1).astype("u1"), bytes(256)
            CMFB_write_color_map(one, 0, 256, map_red, list(range(256)), rest)
            read = [np.zeros(256, "u1") for _ in range(3)]
            CMFB_read_color_map(one, 0, 256, *read)
            assert all(bytes(a) == bytes(b) for a, b in zip(read, (map_red, bytes(range(256)), rest)))
            raises(ValueError, "has 255 bytes", CMFB_write_color_map, one, 0, 256, map_red[1:], rest, rest)
            raises(ctypes.ArgumentError, "bytes (u1)", CMFB_read_color_map, one, 0, 64, *[np.zeros(64, "u4")] * 3)
            paris.write(field, gray)
            for k, channel in enumerate((red, green, blue)):
                paris.write(channel, np.ascontiguousarray(colours[:, :, k]))
            CMFB_write_news_always(one, 0, field, 0, 0)
            CMFB_write_rgb_news_always(two, 0, red, green, blue, 0, 0)
            raises(paris.Error, "CMFB_write_always", CMFB_write_always, 7, 0, field, 0, 0)
        finally:
            del os.environ["LUTETIA_DISPLAY"]
        subprocess.run([LUTETIA, "display", "-o", out, recording], check=True, timeout=100)
        shown = [paris.picture(name) for name in (out, out.replace(".png", "-2.png"))]
        assert np.array_equal(shown[0], np.stack([255 - gray, gray, 0 * gray], -1)), shown[0]
        assert np.array_equal(shown[1], colours), shown[1]
        CMFB_detach_display(one)
        CMFB_detach_display(two)


def fields_go_to_files():
    set_make(5, 7)
    field, again = CM_allocate_heap_field(32), CM_allocate_heap_field(32)
    values = np.arange(35, dtype="f4").reshape(5, 7) / 4
    paris.write(field, values)
    with tempfile.TemporaryDirectory() as folder:
        for name in "a.npy", "a.h5", "a.raw":
            path = os.path.join(folder, name)
            assert lutetia_field_write(path, field, "f4", 0) == 1
            CM_u_move_zero_always_1L(again, 32)
            assert lutetia_field_read(path, again, "f4", 0) == 1
            assert np.array_equal(paris.read(again, "f4"), values)
        assert np.array_equal(np.load(os.path.join(folder, "a.npy")), values)
        lengths = np.zeros(4, "u4")
        assert lutetia_file_shape(os.path.join(folder, "a.h5"), lengths, 4) == 2 and lengths.tolist() == [5, 7, 0, 0]
        raises(ValueError, "has 16 bytes", lutetia_file_shape, os.path.join(folder, "a.h5"), lengths, 5)
        raises(paris.Error, "b.npy", lutetia_field_read, os.path.join(folder, "b.npy"), again, "f4", 0)
        path = os.path.join(folder, "machine")
        file = CMFS_open(path, CMFS_O_RDWR | CMFS_O_CREAT | CMFS_O_TRUNC, 0o640)
        assert CMFS_write_file_always(file, field, 32) == 32 and CMFS_serial_write_file(file, b"end", 3) == 3
        assert CMFS_serial_lseek(file, 4, CMFS_L_SET) == 4
        rest = bytearray(200)
        assert CMFS_serial_read_file(file, rest, 200) == 34 * 4 + 3 and rest[:139] == values.tobytes()[4:] + b"end"
        raises(ValueError, "has 200 bytes", CMFS_serial_read_file, file, rest, 201)
        assert CMFS_close(file) == 0 and os.stat(path).st_mode & 0o777 == 0o640 & ~umask()
        assert CMFS_open(os.path.join(folder, "none"), CMFS_O_RDONLY) == -1 and paris.CMFS_errno == 2


def umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def png(rng, width, height, depth, colours, palette=None):
    """A PNG file of random samples, each row filtered in a way of its own, and what it shows. As the specification has it, byte by byte."""
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[colours]
    most = len(palette) if palette is not None else 1 << depth
    samples = rng.integers(0, most, (height, width * channels))
    pixel, before, packed = max(channels * depth // 8, 1), None, b""
    for line in samples:
        bits = "".join(f"{x:0{depth}b}" for x in line)
        row = int(bits.ljust(-len(bits) // 8 * -8, "0"), 2).to_bytes((len(bits) + 7) // 8, "big")
        before, kind, coded = before or bytes(len(row)), int(rng.integers(0, 5)), []
        for i, x in enumerate(row):
            a, b, c = row[i - pixel] if i >= pixel else 0, before[i], before[i - pixel] if i >= pixel else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            coded.append((x - (0, a, b, (a + b) // 2, paeth)[kind]) % 256)
        packed, before = packed + bytes([kind]) + bytes(coded), row

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    data = zlib.compress(packed)
    file = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, colours, 0, 0, 0)) \
        + (chunk(b"PLTE", palette.tobytes()) if palette is not None else b"") + chunk(b"IDAT", data[:7]) + chunk(b"IDAT", data[7:]) + chunk(b"IEND", b"")
    seen = samples.reshape(height, width, channels).astype("u2" if depth == 16 else "u1")
    if palette is not None:
        return file, palette[seen[:, :, 0]]
    seen = seen * (255 // ((1 << depth) - 1)) if depth < 8 else seen
    return file, seen[:, :, 0] if channels == 1 else seen


def pictures_are_read():
    rng = np.random.default_rng(4)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.png")
        kinds = [(d, c) for c, depths in ((0, (1, 2, 4, 8, 16)), (2, (8, 16)), (3, (1, 2, 4, 8)), (4, (8, 16)), (6, (8, 16))) for d in depths]
        for depth, colours in kinds * 3:
            palette = rng.integers(0, 256, (min(1 << depth, 200), 3), "u1") if colours == 3 else None
            data, seen = png(rng, *rng.integers(1, 24, 2).tolist(), depth, colours, palette)
            open(path, "wb").write(data)
            read = paris.picture(path)
            assert read.dtype == seen.dtype and np.array_equal(read, seen), (depth, colours, read, seen)
            # A file that is cut or changed is refused, and nothing else happens.
            for _ in range(6):
                damaged = bytearray(data)
                if rng.integers(2):
                    del damaged[int(rng.integers(0, len(data))):]
                else:
                    damaged[int(rng.integers(0, len(data)))] ^= 1 << int(rng.integers(0, 8))
                open(path, "wb").write(damaged)
                raises(ValueError, path, paris.picture, path)
            # Changed within, with sums that are right: it is read or refused.
            damaged = bytearray(data)
            damaged[int(rng.integers(16, 29))] = int(rng.integers(0, 256))
            damaged[29:33] = struct.pack(">I", zlib.crc32(damaged[12:29]))
            open(path, "wb").write(damaged)
            try:
                paris.picture(path)
            except ValueError as error:
                assert path in str(error)
        raises(FileNotFoundError, "none.png", paris.picture, os.path.join(folder, "none.png"))


def states_are_read():
    """As another library of HDF5 has written them."""
    try:
        import h5py
    except ImportError:
        print("not tried: states, for want of python3-h5py")
        return
    with tempfile.TemporaryDirectory() as folder:
        path, script = os.path.join(folder, "wet.h5"), os.path.join(folder, "wet.lua")
        open(script, "w").write('paper{width = 32, height = 24}:save("wet.h5")\n')
        subprocess.run([LUTETIA, "run", "--out", folder, script], check=True, timeout=100, cwd=folder)
        read = paris.state(path)
        with h5py.File(path) as file:
            planes = file["sheet-1/planes"]
            assert len(planes) and {f"sheet-1/planes/{name}" for name in planes} <= set(read)
            for name in planes:
                assert read[f"sheet-1/planes/{name}"].shape == (24, 32) and np.array_equal(read[f"sheet-1/planes/{name}"], planes[name][()])


CM_attach_to_processors(16)
CM_init()
signatures_are_the_headers()
displays_show_fields()
fields_go_to_files()
pictures_are_read()
states_are_read()
arrays_are_fields()
parts_and_turned_arrays()
errors_are_exceptions()
a_machine_goes_to_a_file()
CM_attach_to_processors(16)
with tempfile.TemporaryDirectory() as folder:
    data = data_of(DATA)
    lines = sum(random_program_is_cs(seed, folder, data) for seed in range(1, PROGRAMS + 1))
    assert lines > PROGRAMS  # they print something
