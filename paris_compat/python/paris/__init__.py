"""C/Paris from Python: every call of <cm/paris.h> under its name, and NumPy arrays in and out.

    import numpy, paris
    from paris import *                # all CM_ names, and those of displays and files

    CM_init()
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry([1000, 1000], 2)))
    heat = CM_allocate_heap_field(32)
    paris.write(heat, numpy.random.rand(1000, 1000).astype("f4"))
    CM_f_multiply_constant_2_1L(heat, 0.5, 23, 8)
    print(paris.read(heat, "f4").max())

The calls of <cm/cmfb.h>, <cm/cmfs.h> and <lutetia/fields.h> are here as well. picture() and state() read pictures and saved sheets.

Calls have the arguments of C. A vector (CM_vector_t) is any sequence of integers; a complex number is Python's. A wrong
call raises paris.Error and has no effect. Threads: all calls belong to one thread, as in C. The library is found beside the
system's others, or by LD_LIBRARY_PATH.
"""
import ctypes
import operator
import os

from ._files import picture, state
from ._names import CALLS, CONSTANTS, LIBRARY, VARIABLES

__all__ = [*CALLS, *CONSTANTS, *VARIABLES]


class Error(Exception):
    """A call was wrong, or the machine could not do it. `status` is CM_error_call, CM_error_memory or CM_error_device."""

    def __init__(self, message, status):
        super().__init__(message)
        self.status = status


class _Complex(ctypes.Structure):
    _fields_ = [("real", ctypes.c_double), ("imag", ctypes.c_double)]


class AxisDescriptor(ctypes.Structure):
    """struct CM_axis_descriptor, for CM_create_detailed_geometry."""
    _fields_ = [("length", ctypes.c_uint), ("weight", ctypes.c_uint), ("ordering", ctypes.c_int),
                ("on_chip_bits", ctypes.c_uint), ("off_chip_bits", ctypes.c_uint)]


def _integer(kind):
    """Integers of any type of Python's or NumPy's, as C would convert them; none that C's type has no room for."""
    bits = ctypes.sizeof(kind) * 8

    class Integer:
        @classmethod
        def from_param(cls, value):
            number = operator.index(value)
            if not -(1 << bits - 1) <= number < 1 << bits:
                raise OverflowError(f"{number} does not fit into {bits} bits")
            return kind(number)
    return Integer


class _Vector:
    """A sequence of integers, as an array of int."""

    @classmethod
    def from_param(cls, values):
        numbers = [operator.index(v) for v in values]
        return (ctypes.c_int * len(numbers))(*numbers)


class _Memory:
    """An array's elements, where they lie: an object with a buffer, contiguous in C's order."""
    writable = False

    @classmethod
    def from_param(cls, array):
        view = memoryview(array)
        if not view.c_contiguous:
            raise TypeError("the array is not contiguous in C's order; numpy.ascontiguousarray() makes one that is")
        if cls.writable and view.readonly:
            raise TypeError("the array cannot be written")
        if view.readonly:
            import numpy
            return ctypes.c_void_p(numpy.asarray(array).ctypes.data)
        return (ctypes.c_char * view.nbytes).from_buffer(array) if view.nbytes else ctypes.c_void_p(0)


class _WritableMemory(_Memory):
    writable = True


class _Bytes(_Memory):
    """Numbers from 0 to 255: bytes, an array of them, or any sequence."""

    @classmethod
    def from_param(cls, values):
        try:
            view = memoryview(values)
        except TypeError:
            return (ctypes.c_ubyte * len(values)).from_buffer_copy(bytes(map(operator.index, values)))
        if view.itemsize != 1:
            raise TypeError("the array's elements must be bytes (u1)")
        return super().from_param(values)


class _WritableBytes(_WritableMemory):
    @classmethod
    def from_param(cls, array):
        if memoryview(array).itemsize != 1:
            raise TypeError("the array's elements must be bytes (u1)")
        return super().from_param(array)


class _WritableLengths(_WritableMemory):
    @classmethod
    def from_param(cls, array):
        if memoryview(array).itemsize != 4:
            raise TypeError("the array's elements must have 4 bytes (u4)")
        return super().from_param(array)


class _Descriptors:
    @classmethod
    def from_param(cls, descriptors):
        pointers = [ctypes.pointer(d) for d in descriptors]
        return (ctypes.POINTER(AxisDescriptor) * len(pointers))(*pointers)


class _Text:
    @classmethod
    def from_param(cls, text):
        name = os.fsencode(text)
        if b"\0" in name:
            raise ValueError("a text for C has no zero in it")
        return ctypes.c_char_p(name)


class _Double:
    @classmethod
    def from_param(cls, value):
        return ctypes.c_double(value)


_Handler = ctypes.CFUNCTYPE(None, ctypes.c_char_p)
_NUMBERS = {"i": ctypes.c_int, "u": ctypes.c_uint, "l": ctypes.c_long, "m": ctypes.c_ulong}
_PARAMETERS = {"d": _Double, "V": _Vector, "R": _Memory, "W": _WritableMemory, "S": _Text, "A": _Descriptors, "H": _Handler,
               "B": _Bytes, "b": _WritableBytes, "L": _WritableLengths}
_PARAMETERS |= {letter: _integer(kind) for letter, kind in _NUMBERS.items()}
_RESULTS = {"v": None, "d": ctypes.c_double, "c": _Complex} | _NUMBERS

_library = ctypes.CDLL(LIBRARY)
_said = []  # what the library has said during a call


@_Handler
def _told(message):
    _said.append(message.decode(errors="replace"))


_library.CM_set_error_handler(_told)


def _raise():
    message = _said[0]
    _said.clear()
    raise Error(message, _library.CM_error_status())


def _call_make(name, letters):
    function = getattr(_library, name)
    function.restype = _RESULTS[letters[0]]
    function.argtypes = [_PARAMETERS[p] for p in letters[1:] if p != "."]  # what more there is are ints
    if letters[0] == "c":
        def call(*arguments):
            result = function(*arguments)
            if _said:
                _raise()
            return complex(result.real, result.imag)
    else:
        def call(*arguments):
            result = function(*arguments)
            if _said:
                _raise()
            return result
    call.__name__ = call.__qualname__ = name
    return _call_measured(call) if name in _COUNTED else call


# Calls that are told how much of an array there is: {name: (the arrays' places, the count's, bytes of an element)}.
_COUNTED = {"CMFB_write_color_map": ((3, 4, 5), 2, 1), "CMFB_read_color_map": ((3, 4, 5), 2, 1), "CMFS_serial_write_file": ((1,), 2, 1),
            "CMFS_serial_read_file": ((1,), 2, 1), "lutetia_file_shape": ((1,), 2, 4), "CM_checkpoint": ((1,), 2, 1), "CM_resume": ((1,), 2, 1)}


def _bytes_of(array, size):
    try:
        return memoryview(array).nbytes
    except TypeError:
        return len(array) * size


def _call_measured(call):
    """The same call, with a look that the arrays are as long as it is told."""
    places, count, size = _COUNTED[call.__name__]

    def measured(*arguments):
        for place in places if count < len(arguments) else ():
            has, asked = _bytes_of(arguments[place], size), operator.index(arguments[count]) * size
            if has < asked:
                raise ValueError(f"{call.__name__}: argument {place + 1} has {has} bytes, and {asked} were asked for")
        return call(*arguments)
    measured.__name__ = measured.__qualname__ = call.__name__
    return measured


def _init_make(name):
    """CM_init would end the process where there is no machine; CM_attach says that there is none."""
    attach, init = _call_make("CM_attach", CALLS["CM_attach"]), _call_make(name, CALLS[name])

    def call():
        if not attach():
            raise Error("there is no machine (the reason is on standard error)", CONSTANTS["CM_error_device"])
        init()
    call.__name__ = call.__qualname__ = name
    return call


def __getattr__(name):
    """Calls are made when they are first asked for; variables are read each time."""
    if name in CALLS:
        made = _init_make(name) if name in ("CM_init", "CM_cold_boot") else _call_make(name, CALLS[name])
    elif name in CONSTANTS:
        made = CONSTANTS[name]
    elif name in VARIABLES:
        return _NUMBERS[VARIABLES[name]].in_dll(_library, name).value
    else:
        raise AttributeError(f"module 'paris' has no '{name}'")
    globals()[name] = made
    return made


def __dir__():
    return sorted({*globals(), *__all__})


# ---- arrays ----

_FORMATS = {1: "CM_8_bit", 2: "CM_16_bit", 4: "CM_32_bit", 8: "CM_64_bit"}


def shape():
    """The lengths of the current VP set's axes."""
    geometry = __getattr__("CM_vp_set_geometry")(__getattr__("CM_current_vp_set"))
    length = __getattr__("CM_geometry_axis_length")
    return tuple(length(geometry, axis) for axis in range(__getattr__("CM_geometry_rank")(geometry)))


def _transfer(what, field, array, at, length):
    kind, size = array.dtype.kind, array.dtype.itemsize
    if kind == "b":
        kind = "u"
    if kind not in "uifc" or not array.dtype.isnative or (kind in "fc" and size not in ((4, 8), (8, 16))[kind == "c"]):
        raise TypeError(f"no field has elements of {array.dtype}: take bool, integers, f4, f8, c8 or c16, in this machine's byte order")
    rank = len(shape())
    if array.ndim != rank:
        raise ValueError(f"the VP set has {rank} axes, the array has {array.ndim}")
    start = [0] * rank if at is None else [int(x) for x in at]
    if len(start) != rank:
        raise ValueError(f"the VP set has {rank} axes, `at` has {len(start)} numbers")
    end = [a + n for a, n in zip(start, array.shape)]
    if kind in "fc":
        bits = size * 8 if kind == "f" else size * 4
        lengths = length if length is not None else ((23, 8) if bits == 32 else (52, 11))
        form = CONSTANTS["CM_float_single" if bits == 32 else "CM_float_double"]
    else:
        if length is None:
            length = min(size * 8, __getattr__("CM_field_length")(field))
        lengths, form = (length,), CONSTANTS[_FORMATS[size]]
    letter = "s" if kind == "i" else kind
    __getattr__(f"CM_{letter}_{what}_news_array_1L")(array, [0] * rank, start, end, list(range(rank)), field, *lengths, rank,
                                                    list(array.shape), form)


def write(field, array, at=None, length=None):
    """Writes an array to a field of the current VP set, in NEWS order, whatever the context.

    The array has the VP set's shape; or `at` is given, and element k belongs to the processor at + k. The array's type chooses the field's: bool and unsigned integers (u), signed
    integers (s), f4 and f8 (f), c8 and c16 (c). `length` is the field's: bits of an integer (the field's own, at most
    the element's, if not given), or (s, e) of a float ((23, 8) or (52, 11) as the array has). The array is copied only if
    it is not contiguous.
    """
    import numpy
    array = numpy.ascontiguousarray(array)
    whole = shape()
    if at is None and array.ndim == len(whole) and array.shape != tuple(whole):
        raise ValueError(f"the VP set has shape {tuple(whole)}, the array {array.shape}: say `at` to write a part")
    _transfer("write_to", field, array, at, length)


def read(field, dtype, at=None, shape=None, length=None, out=None):
    """Reads a field of the current VP set as an array of `dtype`; the counterpart of write().

    `shape` is the part's, from `at` on (the rest of the set if not given). `out` is a contiguous array to read into,
    of that shape and type.
    """
    import numpy
    if shape is None:
        whole = globals()["shape"]()
        shape = [n - a for n, a in zip(whole, at if at is not None else [0] * len(whole))]
    if out is None:
        out = numpy.empty(tuple(shape), dtype)
    elif out.shape != tuple(shape) or out.dtype != numpy.dtype(dtype):
        raise ValueError(f"out must have shape {tuple(shape)} and type {numpy.dtype(dtype)}")
    if out.size:
        if out.dtype.kind == "b":
            _transfer("read_from", field, out.view("u1"), at, 1 if length is None else length)
        else:
            _transfer("read_from", field, out, at, length)
    return out
