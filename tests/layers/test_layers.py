"""Tests layers.py on small trees of files, one for each case."""
import contextlib
import io
import pathlib
import tempfile
import unittest

import layers

ROWS = """
folder base:
folder low: base
folder high: low
folder tests/*: *
"""


def run(files, rows=ROWS, words=()):
    """Checks a tree of {path: text}; returns (exit status, lines printed)."""
    with tempfile.TemporaryDirectory() as name:
        root = pathlib.Path(name)
        for path, text in {"base/b.h": "", "low/l.h": "", "high/h.h": "", "tests/t.c": "", **files}.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text)
        (root / "layers.txt").write_text(rows)
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            status = layers.main([name, name + "/layers.txt", *words])
        return status, out.getvalue().splitlines()


def function(name, lines=1, head="void", body="    ;\n"):
    return "%s %s(void)\n{\n%s}\n" % (head, name, body * (lines - 3))


class Layers(unittest.TestCase):
    def clean(self, files, rows=ROWS):
        status, lines = run(files, rows)
        self.assertEqual((status, len(lines)), (0, 1), lines)

    def wrong(self, files, rows, *says):
        status, lines = run(files, rows)
        self.assertEqual(status, 1, lines)
        self.assertEqual(len(lines), len(says) + 1, lines)
        for say, line in zip(says, lines):
            self.assertIn(say, line)

    def refused(self, rows, say):
        status, lines = run({}, rows)
        self.assertEqual(status, 2, lines)
        self.assertIn(say, lines[0])

    def test_arrows_down_are_allowed(self):
        self.clean({"base/b.h": "int b(void);\n", "base/b.c": '#include "b.h"\n' + function("b", head="int"),
                    "low/l.c": '#include "b.h"\nint l(void)\n{\n    return b();\n}\n',
                    "high/h.c": '#include "l.h"\nint h(void)\n{\n    return l();\n}\n',
                    "tests/t.c": '#include "h.h"\nint t(void)\n{\n    return h() + l() + b();\n}\n'})

    def test_include_upwards_is_wrong(self):
        self.wrong({"low/l.c": '\n#include "h.h"\n'}, ROWS, "low/l.c:2: includes h.h of high, which low may not use")

    def test_include_with_a_path_is_seen(self):
        self.wrong({"low/l.c": '#include "../high/h.h"\n'}, ROWS, "low/l.c:1: includes ../high/h.h of high")

    def test_include_past_a_folder_is_wrong_without_plus(self):
        files = {"high/h.c": '#include <b.h>\n'}
        self.wrong(files, ROWS, "includes b.h of base, which high may not use")
        self.clean(files, ROWS.replace("high: low", "high: low+"))

    def test_header_beside_the_file_is_meant(self):
        self.clean({"low/same.h": "", "high/same.h": "", "low/l.c": '#include "same.h"\n'})

    def test_call_upwards_is_wrong(self):
        self.wrong({"high/h.c": function("high_do"),
                    "low/l.c": "void high_do(void);\n" + function("l", 4, body="    high_do();\n")}, ROWS,
                   "low/l.c:1: uses high_do of high/h.c, and low may not use high")

    def test_function_in_a_table_is_a_use(self):
        self.wrong({"high/h.c": function("high_do"), "low/l.c": "static void (*const rows[])(void) = {\n    high_do,\n};\n"},
                   ROWS, "low/l.c:2: uses high_do")

    def test_variable_is_a_use(self):
        self.wrong({"high/h.h": "extern const int high_more, high_rows[3];\n",
                    "high/h.c": "const int high_more = 1,\n          high_rows[3] = {1, 2, 3};\n",
                    "low/l.c": "int l = sizeof high_rows;\n",
                    "low/m.c": "static int high_rows(void);\n" + function("high_rows", head="static int")},
                   ROWS, "low/l.c:1: uses high_rows of high/h.c")

    def test_macro_in_a_header_is_a_use(self):
        self.wrong({"high/h.c": function("high_do"), "low/l.h": "#define L() \\\n    high_do()\n"},
                   ROWS, "low/l.h:2: uses high_do of high/h.c")

    def test_static_namesakes_members_comments_and_strings_are_no_use(self):
        self.clean({"high/h.c": function("high_do") + function("hidden", head="static void"),
                    "low/l.h": "void high_do(void);\n",
                    "low/l.c": "/* high_do() */ // high_do\n" + function("hidden", head="static void")
                    + 'int l(struct s *s)\n{\n    return s->high_do + s[0].high_do + "high_do"[0];\n}\n',
                    "low/own.c": function("high_do", head="static void"),
                    "low/tag.c": "struct high_do {\n    int n;\n};\n",
                    "low/array.c": "int s(int n[static 3])\n{\n    return n[0];\n}\n"})

    def test_macros_before_a_function_are_not_its_name(self):
        self.clean({"low/l.c": function("same", head="PRINTF(1, 2) static void"), "high/h.c": function("same")})

    def test_static_behind_a_macro_is_static(self):
        files = {"high/h.h": "#define INLINE static inline\n",
                 "high/h.c": '#include "h.h"\n' + function("step", head="INLINE void"),
                 "low/l.c": "int l(int step)\n{\n    return step;\n}\n"}
        self.clean(files)

    def test_function_that_returns_a_function_has_its_name(self):
        files = {"high/h.c": "void (*high_of(int n))(void)\n{\n    return 0;\n}\n", "low/l.c": "void *l = high_of;\n"}
        self.wrong(files, ROWS, "low/l.c:1: uses high_of")

    def test_headers_of_folders_above_are_the_nearest(self):
        rows = ROWS + "folder low/deep: low\n"
        self.clean({"low/in.h": "", "high/in.h": "", "low/deep/d.c": '#include "in.h"\n#include "deep/d.h"\n',
                    "low/deep/d.h": ""}, rows)

    def test_a_file_may_have_a_row(self):
        rows = ROWS + "folder low/top.c: low+ high\n"
        self.clean({"low/top.c": '#include "h.h"\n#include "b.h"\n'}, rows)
        self.wrong({"low/l.c": function("l", 4, body="    top();\n"), "low/top.c": function("top")}, rows,
                   "uses top of low/top.c, and low may not use low/top.c")

    def test_doors_are_for_outsiders(self):
        rows = ROWS + "folder low/deep: low\nfolder low/upper: low/deep low\ndoor low\n"
        files = {"low/l.h": "void upper(void);\n", "low/upper/u.c": function("upper")}
        call = function("call", 4, body="    upper();\n")
        self.clean({**files, "high/h.c": call, "low/deep/d.c": ""}, rows)
        self.wrong({**files, "base/b.c": call, "low/deep/d.c": call.replace("call", "deeper")}, rows,
                   "base/b.c:3: uses upper of low/upper/u.c", "low/deep/d.c:3: uses upper of low/upper/u.c")
        self.wrong({**files, "low/deep/d.c": ""}, rows + "door gone.h\n", "door gone.h is no header")

    def test_generated_headers_and_prefixes_have_folders(self):
        rows = ROWS + "header made.h: high\nnames MADE_: high\n"
        self.wrong({"low/l.c": "#include <made.h>\nint l = MADE_row();\n"}, rows,
                   "low/l.c:2: names MADE_row of high", "low/l.c:1: includes made.h of high")
        self.clean({"high/h.c": "#include <made.h>\nint h = MADE_row();\n"}, rows)

    def test_outside_headers_belong_to_folders(self):
        rows = ROWS + "only CL/: base\n"
        self.wrong({"base/b.c": "#include <CL/cl.h>\n", "tests/t.c": "#include <CL/cl.h>\n", "low/l.c": "#include <CL/cl.h>\n"},
                   rows, "low/l.c:1: includes <CL/cl.h>, which only base may")

    def test_files_are_opened_by_those_who_are_named(self):
        rows = ROWS + "opens base/b.c open the one that opens\n"
        files = {"base/b.c": "int b(const char *p)\n{\n    return open(p, 0);\n}\n"}
        self.clean(files, rows)
        self.clean({**files, "tests/t.c": "int t = fopen(0, 0);\n",
                    "low/l.c": 'int l = s->open(1) + s.fopen(2) + reopen(3) + is_open; /* open(4) */ char *p = "creat(";\n'}, rows)
        for name in ("fopen", "open", "openat", "creat", "mkstemp", "mkostemps", "mkdtemp", "freopen", "tmpfile", "open64", "memfd_create"):
            self.wrong({**files, "low/l.c": "int l(void)\n{\n    return %s (0);\n}\n" % name}, rows, "low/l.c:3: calls %s()" % name)
        self.wrong({}, rows, "'opens base/b.c open' opens nothing, or is gone")
        self.refused(ROWS + "opens base/b.c open\n", "'opens' wants FILE FUNCTION and the reason")

    def test_errors_are_printed_by_those_who_are_named(self):
        rows = ROWS + "says base/b.c the way out\n"
        files = {"base/b.c": 'int b(void)\n{\n    return fprintf(stderr, "b");\n}\n'}
        self.clean({**files, "tests/t.c": "int t = perror(0);\n", "low/l.c": 'int l = fprintf(out, "stderr") + vfprintf(stdout, 0); /* perror(0) */\n'},
                   rows)
        for call in ('fprintf(stderr, "x")', "perror(0)", 'fputs("x", stderr)', "fputc(10, stderr)", "vfprintf (stderr, a, b)", "dprintf(STDERR_FILENO, a)"):
            self.wrong({**files, "low/l.c": "int l(void)\n{\n    return %s;\n}\n" % call}, rows, "low/l.c:3: prints on the standard error")
        self.wrong({}, rows, "'says base/b.c' says nothing, or is gone")
        self.refused(ROWS + "says base/b.c\n", "'says' wants FILE and the reason")

    def test_two_files_in_a_circle_are_wrong(self):
        self.wrong({"low/a.c": function("a", 4, body="    b();\n"), "low/b.c": function("b", 4, body="    a();\n")}, ROWS,
                   "low/a.c:1: is in a circle of 2 files: low/a.c low/b.c low/a.c", "low/b.c:1: is in a circle")

    def test_circle_through_an_inline_function_is_wrong(self):
        self.wrong({"low/l.h": function("l", 4, "static inline void", "    b();\n"),
                    "low/b.c": '#include "l.h"\n' + function("b", 4, body="    l();\n")}, ROWS,
                   "low/b.c:1: is in a circle of 2 files", "low/l.h:1: is in a circle")

    def test_an_inline_function_and_what_its_header_declares_are_halves_of_one(self):
        inline = function("l", 4, "static inline void", "    b();\n")
        files = {"low/l.h": "void b(void);\n" + inline, "low/b.c": '#include "l.h"\n' + function("b", 4, body="    l();\n")}
        self.clean(files)
        self.wrong({"base/l.h": files["low/l.h"], "low/b.c": files["low/b.c"]}, ROWS, "base/l.h:1: uses b of low/b.c")

    def test_circle_of_three_names_the_way_and_leaves_out_who_only_calls_it(self):
        self.wrong({"low/%s.c" % one: function(one, 4, body="    %s();\n" % other) for one, other in
                    (("a", "b"), ("b", "c"), ("c", "a"), ("d", "a"))}, ROWS,
                   "low/a.c low/b.c low/c.c low/a.c", "low/b.c low/c.c low/a.c low/b.c", "low/c.c low/a.c low/b.c low/c.c")

    def test_lengths_have_limits(self):
        self.clean({"low/l.c": function("l", layers.FUNCTION_LINES), "low/m.c": "\n" * layers.FILE_LINES})
        self.wrong({"low/l.c": "\n\n" + function("l", layers.FUNCTION_LINES + 1), "tests/t.c": "\n" * (layers.FILE_LINES + 1)},
                   ROWS, "low/l.c:3: l() has 71 lines; at most 70", "tests/t.c:601: 601 lines; at most 600")

    def test_comments_of_words_are_narrow(self):
        words = ("word " * 20)[:-1]
        self.clean({"low/l.c": "/* %s*/\n/* a\n *     %sdrawn%s*/\nchar *s = \"/* %s\";\n" % (words[:80], " " * 80, "x" * 20, words * 2)})
        self.wrong({"low/l.c": "int a;\n/* a\n * %s */\n" % words}, ROWS, "low/l.c:3: a comment wider than 96 columns")
        self.wrong({"low/l.c": "int a; // %s\n" % words}, ROWS, "low/l.c:1: a comment wider than 96 columns")

    def test_inline_functions_of_kernels_are_static(self):
        self.clean({"low/k.cl": "/* inline */\nstatic inline int one(void)\n{\n    return 1;\n}\n", "low/l.c": function("l")})
        self.wrong({"low/k.cl": "#define V float\ninline int one(void)\n{\n    return 1;\n}\n"}, ROWS,
                   "low/k.cl:2: an inline function that is not static")

    def test_functions_of_old_are_measured(self):
        old = "static int\nold (a, b)\n    int a;\n    char *b;\n{\n" + "    ;\n" * 80 + "}\n"
        self.wrong({"low/l.c": old}, ROWS, "low/l.c:1: old() has 86 lines")

    def test_flat_tables_may_be_long_as_long_as_they_are(self):
        rows = ROWS + "table low/l.c l\ntable low/l.c\n"
        self.clean({"low/l.c": function("l", 700)}, rows)
        self.wrong({"low/l.c": function("l")}, rows, "'table low/l.c l' is short or gone", "'table low/l.c' is short or gone")

    def test_namesakes_across_folders_are_wrong_but_for_tests(self):
        files = {"low/l.c": function("same"), "high/h.c": function("same"), "tests/t.c": function("same")}
        self.wrong(files, ROWS, "same is defined in high/h.c and low/l.c")
        self.clean({"low/l.c": function("same"), "low/none.c": function("same"), "tests/t.c": function("same")})

    def test_known_offenders_are_excused_until_they_are_gone(self):
        files = {"low/l.c": '#include "h.h"\nvoid high_do(void);\n' + function("l", 80), "high/h.c": function("high_do")}
        known = "offends include low/l.c h.h\noffends call low/l.c high_do\noffends length low/l.c l\n"
        self.clean(files, ROWS + known)
        self.wrong({}, ROWS + known, "'offends include low/l.c h.h' offends no longer: remove the row",
                   "'offends call low/l.c high_do'", "'offends length low/l.c l'")

    def test_rows_prints_what_the_table_wants(self):
        status, lines = run({"low/l.c": '#include "h.h"\n' + function("l", 80)}, words=["--rows"])
        self.assertEqual((status, lines), (0, ["offends include low/l.c h.h", "offends length low/l.c l"]))

    def test_the_tour_names_each_folder_and_no_other(self):
        tour = "In `base/` and high.\n\n    low/      text\n    tests/    text\n"
        self.clean({"docs/tour.md": tour})
        self.wrong({"docs/tour.md": tour.replace("low/", "lower/")}, ROWS, "docs/tour.md: says nothing of low",
                   "docs/tour.md: lists lower/, where no C file is")
        self.wrong({"docs/tour.md": tour.replace("high", "high/deep highland")}, ROWS, "docs/tour.md: says nothing of high")
        self.clean({"docs/tour.md": tour + "    deep/    text\n", "low/deep/d.c": ""}, ROWS + "folder low/deep: low\n")

    def test_folders_and_rows_must_meet(self):
        self.wrong({"new/n.c": ""}, ROWS, "new/n.c: its folder has no row")
        self.wrong({}, ROWS + "folder gone:\n", "folder gone has a row, but no file")
        self.clean({"build-x/n.c": "", ".x/n.c": ""})

    def test_bad_rows_are_refused_with_their_line(self):
        self.refused("folder base:\nfoldr low:\n", "layers.txt:2: unknown row 'foldr'")
        self.refused("folder base\n", "layers.txt:1: 'folder' wants NAME: FOLDER...")
        self.refused("folder base:\nfolder base:\n", "layers.txt:2: a second row for base")
        self.refused("folder base: low\n", "base may use low, which has no row")
        self.refused("folder base: low\nfolder low: base\n", "arrows in a circle: base -> low -> base")
        self.refused("offends\n", "'offends' wants one of call, circle, include, length, namesake")
        self.refused("offends circle\n", "'offends circle' wants 1 words")
        self.refused("header made.h: a b\n", "'header' wants one folder")
        self.refused("offends circle a.c\noffends circle a.c\n", "layers.txt:2: a second row for the same offence")


if __name__ == "__main__":
    unittest.main()
