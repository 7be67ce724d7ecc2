"""What happens where the program stops: the library calls CM_debug_stop where it complains and where a watch has something to tell."""
import re

import gdb

from . import program

watched = {}  # by number: the field, as it was when the watch began


class Stop(gdb.Breakpoint):
    """Where the library stops for a debugger. gdb itself says nothing of it: told() does."""

    def stop(self):
        quietly(True)
        return True


def quietly(on):
    try:
        gdb.execute(f"set suppress-cli-notifications {'on' if on else 'off'}", to_string=True)
    except gdb.error:
        pass  # an older gdb: it says where it is, too


def of_watch(text):
    """A watch's message with the field's name and the processor's coordinates."""
    found = re.match(r"watch (\d+): (\w+): (.*)$", text, re.DOTALL)
    field = watched.get(int(found.group(1))) if found else None
    if field is None:
        return text

    def place(match):
        return f"{match.group(1)}{field.name} at {' '.join(map(str, field.place(int(match.group(2)))))}"
    what = re.sub(r"^()processor (\d+)", place, found.group(3))
    what = re.sub(r"(the first is )(\d+)", place, what)
    return f"watch {found.group(1)}: {what}; after {found.group(2)}"


def told(frame):
    """The program's line, as gdb has it where it stops there."""
    sal = frame.find_sal()
    if sal.symtab is None:
        gdb.write(f"in {frame.name() or 'code without names'}, of which no lines are known: compile it by `lutetia cc -g`\n")
        return
    gdb.write(f"{frame.name()} () at {sal.symtab.filename}:{sal.line}\n")
    gdb.execute(f"list {sal.line},{sal.line}")


def stopped(event):
    quietly(False)
    if not isinstance(event, gdb.BreakpointEvent) or not any(isinstance(b, Stop) for b in event.breakpoints):
        return
    gdb.write(of_watch(program.said()) + "\n")
    frame = program.own_frame()
    if frame is not None:
        frame.select()
        told(frame)


class Leave(gdb.Command):
    """Before a step: from where the library has stopped to the end of the call."""

    def __init__(self):
        super().__init__("leave-paris-call", gdb.COMMAND_OBSCURE)

    def invoke(self, line, from_tty):
        frame = gdb.newest_frame() if gdb.selected_thread() else None
        if frame is None or frame.name() != "CM_debug_stop":
            return
        while frame.older() is not None and program.is_library(frame.older()):
            frame = frame.older()
        frame.select()
        gdb.execute("finish", to_string=True)


def locations_choose(breakpoint):
    """A breakpoint at a function of the program stays one at the program's, where the system's libraries and libparis have some of that name, too."""
    if not breakpoint.is_valid() or breakpoint.type != gdb.BP_BREAKPOINT or not breakpoint.visible:
        return
    locations = getattr(breakpoint, "locations", [])  # of gdb 13
    names = [gdb.solib_name(location.address) for location in locations]
    for location, name in zip(locations, names):
        if None in names and name and location.enabled and (name.startswith(("/usr/lib", "/lib")) or program.is_library_at(location.address)):
            location.enabled = False


def library_loaded(filename):
    if "libparis.so" in filename and not any(isinstance(b, Stop) for b in gdb.breakpoints()):
        Stop("CM_debug_stop", internal=True)


def begin():
    for setting in ("breakpoint pending on", "unwindonsignal on", "print thread-events off"):
        gdb.execute(f"set {setting}", to_string=True)
    Leave()
    for command in ("next", "step", "until", "advance"):
        gdb.execute(f"define hook-{command}\nleave-paris-call\nend", to_string=True)
    gdb.events.new_objfile.connect(lambda event: library_loaded(event.new_objfile.filename))
    for objfile in gdb.objfiles():
        library_loaded(objfile.filename)
    for happened in (gdb.events.breakpoint_created, gdb.events.breakpoint_modified):
        happened.connect(locations_choose)
    gdb.events.stop.connect(stopped)
    gdb.events.exited.connect(lambda event: watched.clear())
