"""The commands: field, diff, context, where, watch-field, unwatch-field."""
import os
import re
import sys

import gdb

from . import pictures, program, stops, values

WAYS = ("table", "statistics", "histogram", "picture")
LENGTHS = {"f16": ("f", 10, 5), "f32": ("f", 23, 8), "f64": ("f", 52, 11)}


def expression(words):
    """Takes an expression off the words' begin, spaces around its operators or not: `image + 8`. "": there is none."""
    taken = words.pop(0) if words else ""
    while words and (re.match(r"[-+\[.)]|([*/%&|^]|<<|>>)$", words[0]) or re.search(r"[-+*/%&|^<>(\[.,]$", taken)
                     or taken.count("(") > taken.count(")") or taken.count("[") > taken.count("]")):
        taken += " " + words.pop(0)
    return taken


class Request:
    """field EXPRESSION [TYPE [LENGTHS]] [at COORDINATES] [WAY] [all] [FILE]"""

    def __init__(self, line, fields=1):
        words = gdb.string_to_argv(line)
        self.fields = [expression(words) for _ in range(fields)]
        if "" in self.fields:
            raise program.Refused(f"which field{'s' if fields > 1 else ''}? A variable that holds its id, or a number")
        self.kind, self.at, self.way, self.all, self.file, self.nan = ("", 0, 0), None, None, False, None, False
        while words:
            self.word(words)

    def word(self, words):
        word = words.pop(0)
        if word in LENGTHS:
            self.kind = LENGTHS[word]
        elif found := re.fullmatch(r"([usf])(\d*)", word):
            numbers = [int(found.group(2))] if found.group(2) else self.numbers(words)
            if word[0] == "f" and len(numbers) == 1 or len(numbers) > (2 if word[0] == "f" else 1) or any(n < 1 for n in numbers):
                raise program.Refused(f"{word}: lengths are `u 16`, `s 16`, `f 23 8`; `f32` and `f64` are floats, too")
            self.kind = (word[0], *(numbers + [0, 0])[:2])
        elif word == "at":
            self.at = self.numbers(words)
        elif word in WAYS:
            self.way = word
            if word == "picture" and words and words[0].endswith(".png"):
                self.file = words.pop(0)
        elif word == "all":
            self.all = True
        elif word == "nan":
            self.nan = True
        else:
            raise program.Refused(f"'{word}' is not known here: it is a type (u, s, f with lengths), `at` a place, `all`, or one of "
                                  + ", ".join(WAYS))

    @staticmethod
    def numbers(words):
        out = []
        while words and re.fullmatch(r"-?\d+", words[0]):
            out.append(int(words.pop(0)))
        return out


def width():
    return min(gdb.parameter("width") or 80, 160)


def say(lines):
    for line in lines:
        gdb.write(line + "\n")


def picture(field):
    encoding = (gdb.parameter("host-charset") or "").upper()
    blocks = encoding.startswith("UTF-8") or "UTF-8" in os.environ.get("LC_ALL", os.environ.get("LANG", "")).upper()
    return pictures.terminal(field, width() - 3, 30, sys.__stdout__.isatty() and gdb.parameter("style enabled"), blocks)


def show(field, request):
    if request.at is not None:
        try:
            i = field.index(request.at)
        except ValueError as error:
            raise program.Refused(f"{field.name}: {error}") from None
        active = "" if field.active[i] or "bits" not in field.facts else " (inactive)"
        say([f"{field.name} at {values.spoken(request.at)} = {field.text(field.values[i])}{active}"])
        return
    say([field.title()])
    if request.way in (None, "table"):
        say(pictures.table(field))
    if request.way in (None, "statistics"):
        say(values.statistics(field, request.all or "bits" not in field.facts))
    if request.way == "histogram":
        say(values.histogram(field, request.all))
    if request.way == "picture" and request.file:
        try:
            say([pictures.png(field, request.file)])
        except OSError as error:
            raise program.Refused(f"{request.file}: cannot write: {error.strerror}") from None
    elif request.way == "picture":
        say(picture(field))


class FieldCommand(gdb.Command):
    """Show a field: field F [TYPE] [at COORDINATES | table | statistics | histogram | picture [FILE.png]] [all]
F is a variable that holds a field's id, a number, or one of context, test, overflow.
TYPE is u, s or f, with lengths as in `u 16` and `f 23 8`; without it floats are shown as they were stored, other bits as u.
Inactive processors are in parentheses; statistics and histogram leave them out, unless `all` is said.
Nothing that the program computes is changed by it."""

    def __init__(self):
        super().__init__("field", gdb.COMMAND_DATA, gdb.COMPLETE_EXPRESSION)

    def invoke(self, line, from_tty):
        request = Request(line)
        show(program.field(request.fields[0], request.kind), request)


class DiffCommand(gdb.Command):
    """Show where two fields differ: diff F G [TYPE] [all]"""

    def __init__(self):
        super().__init__("diff", gdb.COMMAND_DATA, gdb.COMPLETE_EXPRESSION)

    def invoke(self, line, from_tty):
        request = Request(line, 2)
        one, other = (program.field(name, request.kind) for name in request.fields)
        say(values.differences(one, other, request.all))


class ContextCommand(gdb.Command):
    """Show which processors of the current VP set are active, as a picture: context [FILE.png]"""

    def __init__(self):
        super().__init__("context", gdb.COMMAND_DATA)

    def invoke(self, line, from_tty):
        field = program.field("context", ("", 0, 0)) if not program.known_variable("context") else \
            values.Field("context", *program.answer("CM_debug_flag", 0))
        request = Request(f"context picture {line}")
        say([f"{sum(field.active)} of {field.count} processors of VP set {field.facts['vp_set']} are active"])
        show(field, request)


class WhereCommand(gdb.Command):
    """Show the Paris call, what waits to be computed, and the calls of the program: where [as backtrace]"""

    def __init__(self):
        super().__init__("where", gdb.COMMAND_STACK)

    def invoke(self, line, from_tty):
        call = program.call_under_way() if gdb.selected_thread() else None
        if call:
            say([f"within {call}"])
        else:
            self.between_calls()
        for line in gdb.execute(f"backtrace {line}", to_string=True).splitlines():
            if not re.match(r"#\d+ .* from \S*/libparis\.so", line):
                say([line])

    @staticmethod
    def between_calls():
        try:
            state = program.state()
        except program.Refused as error:
            say([str(error)])
            return
        frame = program.own_frame()
        names = program.names(frame) if frame is not None else {}
        waiting = [f for f in state["fields"] if f[4]]
        say([f"last recorded: {state['call']}; VP set {state['vp_set']}: {' x '.join(map(str, state['axes']))}; "
             f"{len(state['fields'])} field{'s' if len(state['fields']) != 1 else ''}"])
        if state["calls"]:
            say([f"{state['calls']} calls since then were foreseen, and wait to be performed together"])
        shown = ", ".join(names.get(f[0], f"field {f[0]}") for f in waiting[:8]) + (", ..." if len(waiting) > 8 else "")
        say([f"{state['values']} value{' waits' if state['values'] == 1 else 's wait'} to be computed" + (f"; of {shown}" if waiting else "")])


class WatchCommand(gdb.Command):
    """Stop after the call that changes a processor's value: watch-field F [TYPE] at COORDINATES
Or when a processor's value, or any value, becomes NaN: watch-field F [TYPE] nan [at COORDINATES]
The program computes after each call while something is watched: slower, with the same bits. unwatch-field N ends it."""

    def __init__(self):
        super().__init__("watch-field", gdb.COMMAND_BREAKPOINTS, gdb.COMPLETE_EXPRESSION)

    def invoke(self, line, from_tty):
        request = Request(line)
        if request.at is None and not request.nan:
            raise program.Refused("where? `watch-field F at 3 5`, or `watch-field F nan`")
        name = request.fields[0]
        field = program.field(name, request.kind if request.kind[0] or not request.nan else ("f", 0, 0))
        try:
            index = field.index(request.at) if request.at is not None else (1 << 64) - 1
        except ValueError as error:
            raise program.Refused(f"{name}: {error}") from None
        letter, length, exponent = field.letter, field.length, field.facts["e"]
        with program.Place():
            number = program.called("CM_debug_watch", program.field_id(name), ord(letter), length, exponent, f"{index}ul",
                                    2 if request.nan else 1) & 0xffffffff
        if not number:
            raise program.Refused(program.said())
        stops.watched[number] = field
        place = f" at {values.spoken(request.at)}" if request.at is not None else ""
        say([f"watch {number}: {name}{place}{', for NaN' if request.nan else ''}"])


class UnwatchCommand(gdb.Command):
    """End a watch: unwatch-field N"""

    def __init__(self):
        super().__init__("unwatch-field", gdb.COMMAND_BREAKPOINTS)

    def invoke(self, line, from_tty):
        if not re.fullmatch(r"\d+", line.strip()) or int(line) not in stops.watched:
            raise program.Refused("which watch? " + (", ".join(map(str, sorted(stops.watched))) or "there is none"))
        program.may_ask()
        with program.Place():
            program.called("CM_debug_unwatch", int(line))
        del stops.watched[int(line)]


def add():
    for command in (FieldCommand, DiffCommand, ContextCommand, WhereCommand, WatchCommand, UnwatchCommand):
        command()
