#!/usr/bin/env python3
"""Tests that complaints name the line of the call in the program's source.

    test_lines.py LUTETIA KNOWS     KNOWS: `lines` if the library was built with libdw, else `none`

Each program marks its wrong call by a comment; the oracle is the number of the line with that comment.
"""
import json
import os
import re
import subprocess
import sys
import tempfile

LUTETIA, KNOWS = os.path.abspath(sys.argv[1]), sys.argv[2]
MARK = "/* here */"

HEAD = """#include <cm/paris.h>
#include <stdio.h>
static void begin () { CM_init (); CM_set_safety_mode (1); }
"""

DIRECT = HEAD + """
main ()
{
    CM_field_id_t f;
    begin ();
    f = CM_allocate_heap_field (32);
    CM_u_add_2_1L (f, f, 32);
    CM_u_add_2_1L (f, f, 33); /* here */
}
"""

# The call is in a function that the compiler puts into its caller.
INLINED = HEAD + """
static inline void twice (f, n)
    CM_field_id_t f;
    int n;
{
    CM_u_add_2_1L (f, f, n);
    CM_u_add_2_1L (f, f, n + 1); /* here */
}

main ()
{
    begin ();
    twice (CM_allocate_heap_field (32), 32);
    return 0;
}
"""

# In a file of another name, and over several lines.
INCLUDED = {"main.c": HEAD + '#include "part.inc"\nmain () { begin (); part (); return 0; }\n',
            "part.inc": "\n\npart ()\n{\n    CM_f_add_2_1L (CM_no_field, CM_no_field, 23, 8); /* here */\n}\n"}

# The handler is told, again and again.
HANDLED = HEAD + """
static void told (message) char *message; { printf ("%s\\n", message); }

main ()
{
    int i;
    CM_field_id_t f;
    begin ();
    f = CM_allocate_heap_field (8);
    CM_set_error_handler (told);
    for (i = 0; i < 1000; i++)
        CM_u_add_2_1L (f, f, 9); /* here */
    return 0;
}
"""

# Lenient mode says it once.
LENIENT = """#include <cm/paris.h>
main ()
{
    CM_field_id_t f, g;
    CM_init ();
    CM_set_safety_mode (0);
    f = CM_allocate_heap_field (8);
    g = CM_allocate_heap_field (8);
    CM_u_move_1L (f, g, 16); /* here */
    return 0;
}
"""

UNDECLARED = """main ()
{
    CM_init ();
    return 0;
}
"""


def compile_run(folder, files, *flags, **variables):
    if isinstance(files, str):
        files = {"main.c": files}
    for name, text in files.items():
        open(os.path.join(folder, name), "w").write(text)
    environment = os.environ | variables
    made = subprocess.run([LUTETIA, "cc", "main.c", "-o", "prog", *flags], cwd=folder, env=environment,
                          capture_output=True, text=True, timeout=100)
    assert made.returncode == 0, made.stderr
    return subprocess.run(["./prog"], cwd=folder, env=environment, capture_output=True, text=True, timeout=100)


def loaded(path):
    """What of a program is loaded to run: its bytes, without the build's name, and where they go."""
    bytes_only = path + ".loaded"
    subprocess.run(["objcopy", "-O", "binary", "--remove-section=.note.gnu.build-id", path, bytes_only], check=True)
    segments = subprocess.run(["readelf", "-lW", path], capture_output=True, text=True, check=True).stdout
    return open(bytes_only, "rb").read(), [line.split()[2:6] for line in segments.split("\n") if line.startswith("  LOAD")]


def place(files):
    """The place of the marked call: "file:line"."""
    if isinstance(files, str):
        files = {"main.c": files}
    for name, text in files.items():
        for number, line in enumerate(text.split("\n"), 1):
            if MARK in line:
                return f"{name}:{number}"
    raise AssertionError("no mark")


def begins_right(text, files, call):
    start = f"{place(files)}: {call}: " if KNOWS == "lines" else f"{call}: "
    assert text.startswith(start), (start, text)


with tempfile.TemporaryDirectory() as folder:
    compilers = [c for c in ("gcc", "clang") if subprocess.run(["sh", "-c", f"command -v {c}"], capture_output=True).returncode == 0]
    assert compilers
    for compiler in compilers:
        for level in ("-O0", "-O2"):
            for files, call in ((DIRECT, "CM_u_add_2_1L"), (INLINED, "CM_u_add_2_1L"), (INCLUDED, "CM_f_add_2_1L")):
                ended = compile_run(folder, files, level, "-w", CC=compiler)
                assert ended.returncode == 1, ended
                assert ended.stderr.count("\n") == 1, ended.stderr
                begins_right(ended.stderr, files, call)
            # A program that runs with lines is the one without: no instruction and no byte more is loaded.
            for files in (DIRECT, INLINED, INCLUDED, HANDLED):
                compile_run(folder, files, level, "-w", CC=compiler)
                with_lines = loaded(os.path.join(folder, "prog"))
                compile_run(folder, files, level, "-w", "-g0", CC=compiler)
                assert with_lines[1] and with_lines == loaded(os.path.join(folder, "prog")), (compiler, level)
    ended = compile_run(folder, HANDLED, "-w")
    lines = ended.stdout.splitlines()
    assert ended.returncode == 0 and len(lines) == 1000 and len(set(lines)) == 1, ended
    begins_right(lines[0], HANDLED, "CM_u_add_2_1L")
    # The report has each complaint once, with its line.
    ended = compile_run(folder, HANDLED, "-w", LUTETIA_EXPLAIN="report", LUTETIA_EXPLAIN_JSON="report.json")
    report = open(os.path.join(folder, "report")).read()
    assert report.count(lines[0]) == 1 and f"1000 x  {lines[0]}" in report, report
    told = json.load(open(os.path.join(folder, "report.json")))["complaints"]
    assert told == [{"count": 1000, "text": lines[0]}], told
    ended = compile_run(folder, LENIENT, "-w")
    assert ended.returncode == 0 and "said once" in ended.stderr, ended
    begins_right(ended.stderr, LENIENT, "CM_u_move_1L")
    # Without debug information there is the call, as before.
    ended = compile_run(folder, DIRECT, "-w", "-g0")
    assert re.match(r"CM_u_add_2_1L: ", ended.stderr), ended.stderr
    ended = compile_run(folder, DIRECT, "-w", "-s")
    assert re.match(r"CM_u_add_2_1L: ", ended.stderr), ended.stderr
    # A program without <cm/paris.h> is warned of.
    open(os.path.join(folder, "bare.c"), "w").write(UNDECLARED)
    made = subprocess.run([LUTETIA, "cc", "bare.c", "-o", "bare"], cwd=folder, capture_output=True, text=True, timeout=100)
    assert made.returncode == 0 and "CM_init" in made.stderr and "implicit" in made.stderr, made
    made = subprocess.run([LUTETIA, "cc", "bare.c", "-o", "bare", "-w"], cwd=folder, capture_output=True, text=True, timeout=100)
    assert made.returncode == 0 and not made.stderr, made
    # What cannot be linked is said.
    for option in ("-static", "--static", "-static-pie", "-m32", "-mx32"):
        made = subprocess.run([LUTETIA, "cc", "bare.c", "-o", "new", option], cwd=folder, capture_output=True, text=True, timeout=100)
        assert made.returncode == 1 and made.stderr.count("\n") == 1 and option in made.stderr, made
        assert not os.path.exists(os.path.join(folder, "new"))
