"""Asks the program: paris_compat/debug.h has the other half."""
import json
import struct

import gdb

from .values import Field

FLAGS = {"context": 0, "test": 1, "overflow": 2}
# Where a function of these has stopped, its lock may be held, which fork() waits for.
LOCKED = ("malloc", "calloc", "realloc", "free", "cfree", "memalign", "posix_memalign", "aligned_alloc", "fork", "_int_malloc", "_int_free")
TYPES = {"CM_debug_field": "unsigned, unsigned, unsigned, unsigned", "CM_debug_flag": "unsigned", "CM_debug_state": "void",
         "CM_debug_watch": "unsigned, unsigned, unsigned, unsigned, unsigned long, unsigned", "CM_debug_unwatch": "unsigned"}


class Refused(gdb.GdbError):
    """What the user is told, in one line."""


def is_library(frame):
    """Whether the frame is of libparis, or of what that calls."""
    name = gdb.solib_name(frame.pc())
    return name is not None and any(part in name for part in ("libparis.so", "libpocl", "libOpenCL", "libLLVM"))


def own_frame():
    """The newest frame of the program's own code, below what it has called; None: there is none."""
    frame, own = gdb.newest_frame(), None
    while frame is not None and frame.is_valid():
        if gdb.solib_name(frame.pc()) is None and not (frame.name() or "").startswith("CM_"):
            own = frame
            break
        frame = frame.older()
    return own


def call_under_way():
    """The name of the Paris call that the program is in; None: it is between calls, or at a stop of the debugger's."""
    frame, inside = gdb.newest_frame(), False
    if frame.name() == "CM_debug_stop":
        return None
    while frame is not None and frame.is_valid():
        inside = inside or is_library(frame)
        name = frame.name() or ""
        if name.startswith("CM_"):
            return name
        if inside and not is_library(frame) and gdb.solib_name(frame.pc()) is None:
            break
        frame = frame.older()
    return "a call of libparis" if inside else None


def may_ask():
    thread = gdb.selected_thread()
    if thread is None or not thread.is_valid():
        raise Refused("the program does not run: `run`, or `break main` and `run`")
    call = call_under_way()
    if call:
        raise Refused(f"the machine is busy in {call}: `finish` goes to its end")
    name = gdb.newest_frame().name() or ""
    if name.lstrip("_").replace("libc_", "") in LOCKED:
        raise Refused(f"the program is in {name}: `finish` goes to its end")


def called(name, *arguments):
    """What a function of the library returns. Nothing about processes that come and go is printed."""
    try:
        gdb.parse_and_eval(f"(long)&{name}")
    except gdb.error:
        raise Refused("the program has no libparis (yet), or an older one: it is loaded when the program runs") from None
    events = gdb.parameter("print inferior-events")
    gdb.execute("set print inferior-events off", to_string=True)
    try:
        return int(gdb.parse_and_eval(f"((unsigned long (*)({TYPES[name]})) {name})({', '.join(map(str, arguments))})"))
    except gdb.error as error:
        raise Refused(f"the program could not be asked: {error}") from None
    finally:
        gdb.execute(f"set print inferior-events {'on' if events else 'off'}", to_string=True)


class Place:
    """The thread and the frame that are selected, which are selected again afterwards."""

    def __enter__(self):
        self.thread, self.frame = gdb.selected_thread(), gdb.selected_frame()

    def __exit__(self, *_):
        self.thread.switch()
        if self.frame.is_valid():
            self.frame.select()


def memory(address, count):
    return gdb.selected_inferior().read_memory(address, count)


def answer(name, *arguments):
    """(facts, bytes) of an answer; Refused with its error."""
    may_ask()
    with Place():
        address = called(name, *arguments)
        if not address:
            raise Refused("the program has no memory left for an answer")
        total, length = struct.unpack("<QQ", bytes(memory(address, 16)))
        facts = json.loads(bytes(memory(address + 16, length)).decode())
        if "error" in facts:
            raise Refused(facts["error"])
        return facts, memory(address, total) if "at" in facts else b""


def field_id(expression):
    try:
        value = gdb.parse_and_eval(expression)
        number = int(value)
    except (gdb.error, ValueError, OverflowError) as error:
        raise Refused(f"{expression}: {str(error).rstrip('.')}. A field is a variable that holds its id, or a number; variables are known of programs "
                      "compiled by `lutetia cc -g`") from None
    if not 0 < number < 1 << 32:
        raise Refused(f"{expression} is {number}: that is no field")
    return number


def known_variable(name):
    try:
        gdb.parse_and_eval(name)
    except gdb.error:
        return False
    return True


def field(expression, kind):
    """A field's values; or a flag's, if no variable has its name. kind: ("f", 23, 8), ("", 0, 0)"""
    may_ask()
    if expression in FLAGS and not known_variable(expression):
        facts, data = answer("CM_debug_flag", FLAGS[expression])
    else:
        letter, length, exponent = kind
        facts, data = answer("CM_debug_field", field_id(expression), ord(letter) if letter else 0, length, exponent)
    return Field(expression, facts, data)


def state():
    return answer("CM_debug_state")[0]


def said():
    """Why the debugger was stopped."""
    text = bytes(memory(int(gdb.parse_and_eval("(long)&CM_debug_text")), 1600))
    return text[:text.find(b"\0")].decode(errors="replace")


def names(frame):
    """Which variables of the frame hold which numbers: {number: name}, those of the type CM_field_id_t first."""
    typed, others = {}, {}
    try:
        block = frame.block()
    except RuntimeError:
        return {}
    while block is not None:
        for symbol in block:
            if not (symbol.is_variable or symbol.is_argument) or symbol.type.strip_typedefs().code != gdb.TYPE_CODE_INT:
                continue
            try:
                number = int(symbol.value(frame))
            except (gdb.error, ValueError):
                continue
            (typed if symbol.type.name == "CM_field_id_t" else others).setdefault(number, symbol.name)
        block = block.superblock
    return {**others, **typed}
