"""Asks the program: paris_compat/debug.h has the other half."""
import json
import signal
import struct

import gdb

from .values import Field

FLAGS = {"context": 0, "test": 1, "overflow": 2}
# Where a function of these has stopped, its lock may be held, which fork() waits for; HOLDS hold it also while they report that memory is damaged.
LOCKED = ("malloc", "calloc", "realloc", "free", "cfree", "memalign", "posix_memalign", "aligned_alloc", "fork", "_int_malloc", "_int_free")
HOLDS = ("_int_malloc", "_int_realloc", "_int_memalign", "malloc_consolidate", "unlink_chunk", "sysmalloc", "systrim")
TYPES = {"CM_debug_field": "unsigned, unsigned, unsigned, unsigned", "CM_debug_flag": "unsigned", "CM_debug_state": "void",
         "CM_debug_watch": "unsigned, unsigned, unsigned, unsigned, unsigned long, unsigned", "CM_debug_unwatch": "unsigned"}


class Refused(gdb.GdbError):
    """What the user is told, in one line."""


def is_library(frame):
    """Whether the frame is of libparis, or of what that calls."""
    return is_library_at(frame.pc())


def is_library_at(address):
    """The same of an address."""
    name = gdb.solib_name(address)
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


def is_locked_name(name):
    return name.lstrip("_").replace("libc_", "") in LOCKED or name in LOCKED


def has_crashed():
    """Whether a signal that ends programs has stopped it."""
    try:
        return int(gdb.parse_and_eval("$_siginfo.si_signo")) in (signal.SIGABRT, signal.SIGSEGV, signal.SIGBUS, signal.SIGILL, signal.SIGFPE)
    except (gdb.error, gdb.MemoryError):
        return False


def locked_in():
    """The function that holds malloc's lock, where the program is, or has crashed; None: none is known to.

    Where the C library has no debugging symbols, HOLDS have no names. A crash in a nameless function below one of LOCKED may be in one of them.
    """
    frame = gdb.newest_frame()
    name, nameless = frame.name() or "", False
    if is_locked_name(name):
        return name
    while frame is not None and frame.is_valid() and gdb.solib_name(frame.pc()) is not None:
        name = frame.name()
        if name in HOLDS or (name and nameless and is_locked_name(name) and has_crashed()):
            return name
        nameless = nameless or name is None
        frame = frame.older()
    return None


def may_ask():
    thread = gdb.selected_thread()
    if thread is None or not thread.is_valid():
        raise Refused("the program does not run: `run`, or `break main` and `run`")
    call = call_under_way()
    if call:
        raise Refused(f"the machine is busy in {call}: `finish` goes to its end")
    name = locked_in()
    if name:
        raise Refused(f"the program is in {name}, where no field can be looked at: `finish` goes to its end; after a crash there, "
                      "`run` again and stop before it")


def is_setting(name):
    try:
        gdb.parameter(name)
    except RuntimeError:
        return False
    return True


def may_hold_locks():
    """Whether the program is where the C library's locks may be held: it has crashed, or is in a library."""
    frame = gdb.newest_frame()
    return has_crashed() or (gdb.solib_name(frame.pc()) is not None and frame.name() != "CM_debug_stop")


class Unseen:
    """While the library is asked, its process that looks is not followed, nothing of the user's stops there, and gdb says nothing of it."""
    SETTINGS = {"print inferior-events": "off", "follow-fork-mode": "parent", "detach-on-fork": "on"}
    # Since gdb 14, a call that takes longer is given up. The library gives up before, where another process looks.
    TIMEOUTS, PATIENCE_S, PATIENCE_LOCKED_S = ("direct-call-timeout", "indirect-call-timeout"), 150, 20

    def __enter__(self):
        patience = {name: self.PATIENCE_LOCKED_S if may_hold_locks() else self.PATIENCE_S for name in self.TIMEOUTS} | {"unwind-on-timeout": "on"}
        settings = self.SETTINGS | {name: value for name, value in patience.items() if is_setting(name)}
        self.before = {name: gdb.parameter(name) for name in settings}
        self.set(settings)
        self.stops = [b for b in gdb.breakpoints() if b.enabled and b.visible and b.type in (gdb.BP_BREAKPOINT, gdb.BP_CATCHPOINT)]
        for stop in self.stops:
            stop.enabled = False

    def __exit__(self, *_):
        for stop in self.stops:
            stop.enabled = True
        self.set(self.before)

    @staticmethod
    def set(values):
        for name, value in values.items():
            word = "on" if value is True else "off" if value is False else "unlimited" if value is None else value
            gdb.execute(f"set {name} {word}", to_string=True)


def tell_locks():
    locked = may_hold_locks()
    if known_variable("(long)&CM_debug_locked"):  # an older libparis has none
        gdb.parse_and_eval(f"*(unsigned int *)&CM_debug_locked = {int(locked)}")


def called(name, *arguments):
    """What a function of the library returns."""
    try:
        gdb.parse_and_eval(f"(long)&{name}")
    except gdb.error:
        raise Refused("the program has no libparis (yet), or an older one: it is loaded when the program runs") from None
    if name == "CM_debug_watch" and has_crashed():
        raise Refused("the program has crashed: nothing more will change in it")
    try:
        with Unseen():
            tell_locks()
            return int(gdb.parse_and_eval(f"((unsigned long (*)({TYPES[name]})) {name})({', '.join(map(str, arguments))})"))
    except gdb.error as error:
        why = str(error).splitlines()[0]
        if "extended state" in why:  # of AMX, which is larger than gdb before 14 knows
            why = "this gdb cannot write the registers of this processor; gdb 14 can"
        raise Refused(f"the program could not be asked: {why}") from None


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


# What is no id, and what the user may have meant.
KINDS = {gdb.TYPE_CODE_ARRAY: "an array: say which, as in `{0}[0]`", gdb.TYPE_CODE_STRUCT: "a structure: say which member, as in `{0}.heat`",
         gdb.TYPE_CODE_UNION: "a union: say which member", gdb.TYPE_CODE_PTR: "a pointer: say `*{0}`, or `{0}->heat` of a structure",
         gdb.TYPE_CODE_FLT: "a floating point number, and ids are integers", gdb.TYPE_CODE_FUNC: "a function"}


def field_id(expression):
    try:
        value = gdb.parse_and_eval(expression)
        if value.type.strip_typedefs().code in (gdb.TYPE_CODE_REF, gdb.TYPE_CODE_RVALUE_REF):
            value = value.referenced_value()
        kind = KINDS.get(value.type.strip_typedefs().code)
        number = int(value) if not kind else 0
    except (gdb.error, ValueError, OverflowError) as error:
        if "optimized out" in str(error):
            raise Refused(f"{expression}: the compiler keeps it nowhere here: look from its caller (`up`), or compile by `lutetia cc -g`, without -O") \
                from None
        raise Refused(f"{expression}: {str(error).rstrip('.')}. A field is a variable that holds its id, or a number; variables are known of programs "
                      "compiled by `lutetia cc -g`") from None
    if kind:
        raise Refused(f"{expression} is {kind.format(expression)}")
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
        number = field_id(expression)
        try:
            facts, data = answer("CM_debug_field", number, ord(letter) if letter else 0, length, exponent)
        except Refused as refused:
            raise Refused(f"{expression}: {refused}") from None
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
