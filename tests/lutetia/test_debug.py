#!/usr/bin/env python3
"""Tests `lutetia debug`: what it shows of fields, that looking changes nothing, watches, stops, and what it refuses.

    test_debug.py LUTETIA

The oracles are the values that the program below stores, computed here.
"""
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import debugger

LUTETIA = os.path.abspath(sys.argv[1])

# Values of all kinds; `here` is where they are looked at.
KINDS = """
#include <cm/paris.h>
#include <stdio.h>
CM_field_id_t bit, small, sign, wide, real, twice, odd;
here () {}
main ()
{
    unsigned int sides[2] = {4, 6};
    CM_field_id_t row = 0;
    CM_init ();
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sides, 2)));
    CM_set_context ();
    bit = CM_allocate_heap_field (1);
    small = CM_allocate_heap_field (5);
    sign = CM_allocate_heap_field (12);
    wide = CM_allocate_heap_field (100);
    real = CM_allocate_heap_field (32);
    twice = CM_allocate_heap_field (64);
    odd = CM_allocate_heap_field (16);
    row = CM_allocate_stack_field (32);
    CM_my_news_coordinate_1L (row, 0, 32);
    CM_u_multiply_constant_2_1L (row, 6, 32);
    CM_my_news_coordinate_1L (real, 1, 32);
    CM_u_add_2_1L (row, real, 32);
    CM_u_move_2L (small, row, 5, 32);
    CM_u_move_2L (bit, row, 1, 32);
    CM_u_move_2L (sign, row, 12, 32);
    CM_s_subtract_constant_2_1L (sign, 10, 12);
    CM_u_move_2L (wide, row, 100, 32);
    CM_u_multiply_constant_2_1L (wide, 1000000007, 100);
    CM_u_multiply_constant_2_1L (wide, 1000000007, 100);
    CM_u_multiply_constant_2_1L (wide, 1000000007, 100);
    CM_f_u_float_2_2L (real, row, 32, 23, 8);
    CM_f_multiply_constant_2_1L (real, 0.375, 23, 8);
    CM_f_move_2L (twice, real, 52, 11, 23, 8);
    CM_f_divide_constant_2_1L (twice, 3.0, 52, 11);
    CM_f_move_2L (odd, real, 10, 5, 23, 8);
    CM_u_lt_constant_1L (row, 13, 32);
    CM_load_context (bit);
    here ();
    printf ("%u\\n", CM_global_u_add_1L (row, 32));
    return 0;
}
"""

# A step that is repeated, with stores that wait, calls that are foreseen, and a look now and then.
STEPS = """
#include <cm/paris.h>
#include <stdio.h>
CM_field_id_t heat, near, flow;
step (i) int i; {}
main ()
{
    unsigned int sides[2] = {32, 64};
    int i;
    CM_init ();
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sides, 2)));
    CM_set_context ();
    heat = CM_allocate_heap_field (32);
    near = CM_allocate_heap_field (32);
    flow = CM_allocate_heap_field (32);
    CM_initialize_random_generator (7);
    CM_f_random (heat, 23, 8);
    for (i = 0; i < 60; i++) {
        CM_get_from_news_1L (near, heat, 0, CM_upward, 32);
        CM_f_subtract_3_1L (flow, near, heat, 23, 8);
        CM_f_multiply_constant_2_1L (flow, 0.25, 23, 8);
        CM_f_add_2_1L (heat, flow, 23, 8);
        step (i);
        if (i % 20 == 19)
            printf ("%.9g\\n", CM_global_f_add_1L (heat, 23, 8));
    }
    return 0;
}
"""

# A thread that allocates all the time.
THREADS = STEPS.replace("main ()", """#include <pthread.h>
#include <stdlib.h>
static volatile int ends;
static void *allocates (void *of)
{
    while (!ends)
        free (malloc (rand () % 5000));
    return of;
}
main ()""").replace("    CM_init ();", "    pthread_t thread;\n    pthread_create (&thread, 0, allocates, 0);\n    CM_init ();").replace(
    "    return 0;\n}\n", "    ends = 1;\n    pthread_join (thread, 0);\n    return 0;\n}\n")

FAILS = """
#include <cm/paris.h>
#include <stdio.h>
static void told (message) char *message; { printf ("told\\n"); }
main ()
{
    CM_field_id_t f;
    CM_init ();
    f = CM_allocate_heap_field (8);
    CM_set_error_handler (told);
    CM_u_add_2_1L (f, f, 9); /* first */
    CM_u_move_constant_1L (f, 3, 8);
    CM_u_add_2_1L (f, f, 99); /* second */
    CM_set_error_handler (0);
    CM_u_add_2_1L (f + 1, f, 8); /* third */
    return 0;
}
"""

# Names of libparis's own functions, ids in arrays and structures, two sets, a child, and memory that is damaged at the end.
OTHERS = """
#include <cm/paris.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
CM_field_id_t list[2], image;
struct { CM_field_id_t heat; double dt; } plate, *p = &plate;
fill (f, n)
    CM_field_id_t f;
    int n;
{
    CM_my_send_address (f);
    CM_u_multiply_constant_2_1L (f, n, 32);
}
here () { fflush (stdout); }
main ()
{
    unsigned int long_side[1] = {16}, sides[2] = {2, 3};
    CM_vp_set_id_t one, two;
    char *room;
    CM_init ();
    CM_set_vp_set (one = CM_allocate_vp_set (CM_create_geometry (long_side, 1)));
    list[0] = CM_allocate_heap_field (32);
    fill (list[0], 3);
    CM_set_vp_set (two = CM_allocate_vp_set (CM_create_geometry (sides, 2)));
    list[1] = plate.heat = CM_allocate_heap_field (32);
    image = CM_allocate_heap_field (24);
    plate.dt = 64.5;
    CM_u_move_constant_1L (image, 0x123456, 24);
    fill (list[1], 5);
    CM_set_vp_set (one);
    if (fork () == 0) {
        CM_set_vp_set (two);
        CM_u_move_constant_1L (list[1], 99, 32);
        here ();
        _exit (0);
    }
    wait (0);
    CM_deallocate_heap_field (image);
    here ();
    room = malloc (40);
    memset (room, 255, (char *) sbrk (0) - room);
    printf ("%p\\n", malloc ((room[50] & 255) * 400));
    return 0;
}
"""

# Crashes where locks are held. What waits for one of the C library's waits for ever: before fork(), as glibc 2.41 and later do after abort(), or in malloc.
CRASHES = """
#include <cm/paris.h>
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
extern void *__libc_malloc (size_t);
static volatile int forks_wait, malloc_waits;
CM_field_id_t f, g;
static void prepare (void) { while (forks_wait) pause (); }
void *malloc (size_t n) { while (malloc_waits) pause (); return __libc_malloc (n); }
static void ended (int s) { forks_wait = 1; raise (SIGSEGV); }
int main (int count, char **words)
{
    unsigned int side[1] = {16};
    CM_init ();
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (side, 1)));
    f = CM_allocate_heap_field (32);
    g = CM_allocate_heap_field (32);
    CM_my_send_address (f);
    CM_u_add_constant_3_1L (g, f, 7, 32);
    pthread_atfork (prepare, 0, 0);
    forks_wait = 1;
    malloc_waits = getenv ("MALLOC_WAITS") != 0;
    if (getenv ("IN_A_HANDLER")) {
        forks_wait = 0;
        signal (SIGALRM, ended);
        raise (SIGALRM);
    }
    abort ();
}
"""


def line_of(text, part):
    return 1 + next(i for i, line in enumerate(text.splitlines()) if part in line)


class Debug(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        for name, text in (("kinds", KINDS), ("steps", STEPS), ("threads", THREADS), ("fails", FAILS), ("others", OTHERS), ("crashes", CRASHES)):
            with open(cls.path(name + ".c"), "w", encoding="utf-8") as file:
                file.write(text)
            subprocess.run([LUTETIA, "cc", "-g", "-w", *(["-O2", "-fno-inline"] if name == "others" else []), name + ".c", "-lpthread", "-o", name], check=True, timeout=120,
                           cwd=cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder.name, name)

    def debug(self, program, *commands, **variables):
        """The lines that the commands gave."""
        given = [word for command in commands for word in ("-e", command)]
        done = subprocess.run([LUTETIA, "debug", "--batch", *given, self.path(program)], cwd=self.folder.name, capture_output=True,
                              text=True, timeout=200, check=False,
                              env={**debugger.ENVIRONMENT, **variables})
        self.assertNotIn("Traceback", done.stdout + done.stderr)
        self.assertNotIn("Python Exception", done.stdout + done.stderr)
        return debugger.own_lines(done.stdout + done.stderr)

    def kinds(self, *commands, **variables):
        return self.debug("kinds", "break here", "run", *commands, **variables)[2:]

    # ---- values ----

    def test_values_at_places(self):
        n = 3 * 6 + 4
        lines = self.kinds("field small at 3 4", "field bit at 3 3", "field sign s at 0 3", "field sign at 0 3", "field wide at 3 4",
                           "field real at 3 4", "field twice at 3 4", "field odd f 10 5 at 3 4", "field real u at 0 1", "field odd f16 at 3 4")
        third = n * 0.375 / 3
        bits = struct.unpack("<I", struct.pack("<f", 0.375))[0]
        self.assertEqual(lines, [f"small at 3 4 = {n & 31} (inactive)", "bit at 3 3 = 1", "sign at 0 3 = -7", f"sign at 0 3 = {4096 - 7}",
                                 f"wide at 3 4 = {n * 1000000007 ** 3 % (1 << 100)} (inactive)", f"real at 3 4 = {n * 0.375:.7g} (inactive)",
                                 f"twice at 3 4 = {third:.12g} (inactive)", f"odd at 3 4 = {n * 0.375:.12g} (inactive)",
                                 f"real at 0 1 = {bits}", f"odd at 3 4 = {n * 0.375:.12g} (inactive)"])

    def test_values_as_a_table(self):
        lines = self.kinds("field small table")
        self.assertRegex(lines[0], r"small: field \d+ of 5 bits, unsigned numbers of 5 bits; VP set 2: 4 x 6; 12 of 24 processors are active")
        self.assertEqual(lines[1].split(), [str(x) for x in range(6)])
        for row in range(4):
            cells = lines[2 + row].split("|")[1].split()
            self.assertEqual(cells, [f"{6 * row + x}" if (6 * row + x) & 1 else f"({6 * row + x})" for x in range(6)])

    def test_values_counted(self):
        lines = self.kinds("field small statistics", "field small statistics all", "field small histogram", "field test", "diff small sign",
                           "diff small small", "field test statistics")
        odd = [x for x in range(24) if x & 1]
        mean = sum(odd) / len(odd)
        spread = (sum((x - mean) ** 2 for x in odd) / len(odd)) ** 0.5
        self.assertEqual(lines[1:3], ["least 1 at 0 1, most 23 at 3 5",
                                      f"mean {mean:.7g}, standard deviation {spread:.7g}, sum {sum(odd)}; 0 of 12 are 0"])
        self.assertIn("least 0 at 0 0, most 23 at 3 5", lines)
        self.assertIn("small and small are equal in 12 processors", lines)
        # sign is 10 less; below 10 that is 4086 more
        self.assertIn("small and sign differ in 12 of 12 processors", lines)
        self.assertIn("mean 0.5416667, standard deviation 0.4982609, sum 13; 11 of 24 are 0", lines)

    def test_pictures(self):
        lines = self.kinds("context", "field real picture real.png", "field small picture small.png")
        self.assertEqual(lines[0], "12 of 24 processors of VP set 2 are active")
        self.assertEqual(lines[2:4], ["| █ █ █|"] * 2)
        with open(self.path("real.png"), "rb") as file:
            data = file.read()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", data[16:24]), (6, 4))
        at = data.index(b"IDAT")
        pixels = zlib.decompress(data[at + 4:at + 4 + struct.unpack(">I", data[at - 4:at])[0]])
        grays = [pixels[row * 19 + 1 + 3 * column] for row in range(4) for column in range(6)]
        self.assertEqual(grays, [round(255 * i / 23) for i in range(24)])
        self.assertEqual([name for name in os.listdir(self.folder.name) if name.startswith(".")], [])

    # ---- nothing changes ----

    def steps_done(self, *commands, **variables):
        report = self.path("report.json")
        printed = self.debug("steps", *commands, LUTETIA_EXPLAIN_JSON=report, LUTETIA_EXPLAIN="/dev/null",
                             LUTETIA_INTERPRET="2", LUTETIA_BACKGROUND="0", **variables)
        with open(report, encoding="utf-8") as file:
            done = json.load(file)
        os.unlink(report)

        def counts(node):
            """Without times and the orders by them."""
            if isinstance(node, dict):
                return {k: counts(v) for k, v in node.items() if not re.search(r"time|_s$|_ns$|seconds|speed|rate|bytes_s|version", k)}
            return sorted((counts(v) for v in node), key=json.dumps) if isinstance(node, list) else node
        return [line for line in printed if re.fullmatch(r"[-0-9.e]+", line)], counts(done)

    def test_looking_changes_nothing(self):
        plain = self.steps_done("run")
        self.assertEqual(len(plain[0]), 3)
        looks = ["break step if i % 7 == 3", "run"]
        for _ in range(9):
            looks += ["field flow statistics", "field heat at 3 5", "context", "where", "continue"]
        self.assertEqual(self.steps_done(*looks), plain)
        watched = self.steps_done("break step", "run", "watch-field heat at 3 5", *["continue"] * 20, "unwatch-field 1", "delete 1", "continue",
                                  "continue")
        self.assertEqual(watched[0], plain[0])

    def test_other_threads(self):
        plain = [line for line in self.debug("threads", "run") if re.fullmatch(r"[-0-9.e]+", line)]
        looks = ["break step", "run"] + ["field flow at 3 5", "continue"] * 12 + ["delete", "continue"]
        lines = self.debug("threads", *looks)
        self.assertEqual(sum(line.startswith("flow at 3 5 = ") for line in lines), 12)
        self.assertEqual([line for line in lines if re.fullmatch(r"[-0-9.e]+", line)], plain)

    # ---- where it stops ----

    def test_where(self):
        lines = self.debug("steps", "break step if i == 5", "run", "up", "where")
        self.assertTrue(any(re.match(r"\d+ values wait to be computed; of .*heat", line) for line in lines), lines)
        self.assertTrue(any("VP set 2: 32 x 64; 3 fields" in line for line in lines), lines)
        self.assertIn("main () at steps.c", "\n".join(lines))

    def test_within_a_call(self):
        lines = self.debug("steps", "break step", "run", "break CM_f_add_2_1L", "continue", "field heat", "where", "finish",
                           "field heat at 0 0")
        self.assertTrue(any(re.search("the machine is busy in CM_f_add_2_1L: `finish`", line) for line in lines), lines)
        self.assertIn("within CM_f_add_2_1L", lines)
        self.assertTrue(any(line.startswith("heat at 0 0 = 0.") for line in lines), lines)

    def test_complaints_stop(self):
        lines = self.debug("fails", "run", "field f at 0 0", "continue", "field f at 0 0", "continue", "field f at 1 1", "continue")
        stops = [line for line in lines if line.startswith("fails.c:")]
        for mark in ("first", "second", "third"):
            number = line_of(FAILS, f"/* {mark} */")
            self.assertTrue(any(line.startswith(f"fails.c:{number}: CM_u_add_2_1L: ") for line in stops), lines)
        self.assertEqual([line for line in lines if line.startswith("f at")], ["f at 0 0 = 0", "f at 0 0 = 3", "f at 1 1 = 3"])

    def test_watches(self):
        lines = self.debug("kinds", "break here", "run", "watch-field row at 0 1", "finish")
        self.assertTrue(any("No symbol \"row\"" in line for line in lines), lines)
        lines = self.debug("kinds", f"break {line_of(KINDS, 'CM_u_multiply_constant_2_1L (row')}", "run", "watch-field row at 2 1", "continue", "continue", "unwatch-field 1", "continue")
        self.assertEqual([line for line in lines if line.startswith("watch 1: row at 2 1:")],
                         ["watch 1: row at 2 1: 12, was 2; after CM_u_multiply_constant_2_1L",
                          "watch 1: row at 2 1: 13, was 12; after CM_u_add_2_1L"])
        self.assertIn("144", lines)

    # ---- other people's programs ----

    def test_names_that_the_library_has_too(self):
        lines = self.debug("others", "break fill", "run", "field f at 3", "continue", "field f at 0 1", "continue")
        self.assertEqual([line for line in lines if line.startswith(("f at", "fill"))], ["f at 3 = 0", "f at 0 1 = 0"])
        self.assertEqual(sum("fill (f=" in line for line in lines), 2, lines)

    def test_ids_in_structures_and_children(self):
        wrong = {"field list": "list is an array: say which, as in `list[0]`", "field plate": "plate is a structure", "field p": "p is a pointer",
                 "field plate.dt": "plate.dt is a floating point number", "field here": "here is a function", "field image u 0": "lengths are"}
        right = {"field image + 8 u 8 at 1 2": "image + 8 at 1 2 = 52", "field (image +8) u 8 at 1 2": "(image +8) at 1 2 = 52",
                 "field p->heat at 0 0": "p->heat at 0 0 = 99", "field list [0] at 0": "list [0] at 0 = 0"}
        lines = self.debug("others", "set follow-fork-mode child", "break here", "run", *wrong, *right, "diff list[0] list [1]", "catch fork",
                           "field plate.heat at 1 1", "show follow-fork-mode", "continue")
        for command, said in (wrong | right).items():
            self.assertTrue(any(said in line for line in lines), (command, lines))
        for line in ("list[0] and list [1] have different shapes", "plate.heat at 1 1 = 99"):
            self.assertIn(line, lines)
        self.assertTrue(any("fork" in line and '"child"' in line for line in lines), lines)

    def test_after_a_crash(self):
        self.after_a_crash()

    def test_after_a_crash_in_a_library_without_symbols(self):
        self.after_a_crash("set debug-file-directory /nonexistent")

    def after_a_crash(self, *before):
        lines = self.debug("others", *before, "break here", "run", "field list[1] at 0 0", "field image", "field list[0] u 200", "continue", "field list[0]")
        for said in ("list[1] at 0 0 = 0", "image: there is no field", "list[0]: the field has 32 bits from here on; 200 were", "received signal SIG", "`run` again and stop before it"):
            self.assertTrue(any(said in line for line in lines), (said, lines))

    def test_after_a_crash_with_locks_held(self):
        """Nothing of the C library's is waited for, and a child that waits is given up."""
        for variables in ({}, {"IN_A_HANDLER": "1"}):
            lines = self.debug("crashes", "run", "field f at 5", "up", "up", "field g at 15", "context", "watch-field f at 3", **variables)
            for said in ("received signal SIG", "f at 5 = 7", "g at 15 = 15", "the program has crashed: nothing more will change in it"):
                self.assertTrue(any(said in line for line in lines), (said, lines))
        lines = self.debug("crashes", "run", "field g at 5", MALLOC_WAITS="1")
        self.assertTrue(any("holds a lock of the C library" in line and "`run` again and stop before it" in line for line in lines), lines)

    # ---- what is refused ----

    def test_refused(self):
        wrong = {"field": "which field", "field no_such": "No symbol", "field 1": "there is no field 1", "field small at 9 9": "coordinate on axis 0",
                 "field small at 1": "a place has 2 coordinates", "field small u 6": "the field has 5 bits from here on; 6", "field small x": "'x'",
                 "field small f 3": "lengths are", "diff small": "which fields", "watch-field small": "where?", "watch-field small u nan": "only floats",
                 "unwatch-field 9": "which watch", "field real picture no/where.png": "cannot write", "field 0": "that is no field",
                 "field sides": "No symbol"}
        lines = self.kinds(*wrong)
        for command, said in wrong.items():
            self.assertTrue(any(said in line for line in lines), (command, lines))
        self.assertIn("the program does not run", "\n".join(self.debug("kinds", "field small")))

    def test_command_line(self):
        for words, status in (([], 2), (["--nonsense", "x"], 2), (["-x", "/no/such", self.path("kinds")], 1)):
            done = subprocess.run([LUTETIA, "debug", *words], capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (status, 1), done.stderr)
        none = subprocess.run([LUTETIA, "debug", self.path("kinds")], capture_output=True, text=True, timeout=60, check=False,
                              env={**os.environ, "PATH": self.folder.name})
        self.assertEqual(none.returncode, 1)
        self.assertIn("gdb is not installed", none.stderr)


why = debugger.missing()
if why:
    print(f"skipped: {why}")
    sys.exit(77)
unittest.main(argv=sys.argv[:1] + sys.argv[2:])
