"""test_hostile.py LUTETIA: runs the command in hostile surroundings.

Closed and full streams, pipes and devices instead of files, names and texts with escapes, links and folders in the place of output
files. Each command ends in time with one clear line and an exit status for the error, and no file is lost or replaced.
(security.md 2, 5, 6, 12, 17, 18)
"""
import os
import pathlib
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

LUTETIA = ""
SECONDS = 120
BAD = re.compile(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff]")

SHEET = 'local p = paper{width = 16, height = 16}\np:put(ellipse(8, 8, 4), {water = 1})\nprint("printed")\n'


class Hostile(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="lutetia-hostile-")
        self.at = pathlib.Path(self.folder.name)
        self.script("sheet.lua", SHEET + 'p:step(2)\np:frame("frame.png")\np:save("sheet.h5")\n')

    def tearDown(self):
        self.folder.cleanup()

    def script(self, name, text):
        (self.at / name).write_text(text)
        return name

    def run_it(self, *arguments, close=(), full=False, **variables):
        """Runs the command with these streams closed, or with its output on a full disk."""
        def streams():
            for number in close:
                os.close(number)
        output = open("/dev/full", "wb") if full else subprocess.PIPE
        done = subprocess.run([LUTETIA, *arguments], cwd=self.at, stdin=subprocess.DEVNULL, stdout=output,
                              stderr=subprocess.PIPE, timeout=SECONDS, preexec_fn=streams, check=False,
                              env=dict(os.environ, **variables))
        if full:
            output.close()
        done.words = done.stderr.decode("utf-8", "replace")
        return done

    def refused(self, done, *says, status=1):
        """Checks for one line without control characters, and for the exit status."""
        self.assertEqual(done.returncode, status, done.words)
        self.assertEqual(done.words.count("\n"), 1, done.words)
        self.assertIsNone(BAD.search(done.words), repr(done.words))
        for text in says:
            self.assertIn(text, done.words)

    # ---- streams ----

    def test_closed_streams_are_nobodys(self):
        good = {}
        for close in ((), (0,), (1,), (2,), (0, 1, 2)):
            done = self.run_it("run", "sheet.lua", "-q", "--save", "all.h5", "--video", "film.y4m", close=close)
            self.assertEqual(done.returncode, 0, (close, done.words))
            for name in ("frame.png", "film.y4m", "sheet.h5", "all.h5"):
                found = (self.at / name).read_bytes()
                self.assertEqual(found, good.setdefault(name, found), (close, name))
            self.assertEqual(self.run_it("run", "sheet.lua", "-q", "--resume", "all.h5", close=close).returncode, 0)
        self.assertEqual(self.run_it("nothing", close=(2,)).returncode, 2)

    def test_full_output_is_told(self):
        fonts = ("font", "DejaVuSans")
        self.script("words.lua", "print(param('a', 1))\n")
        for arguments in (("--version",), ("--help",), ("run", "--help"), ("info",), fonts, ("run", "words.lua", "-q"),
                          ("run", "words.lua", "-q", "--sweep", "a=1..2"), ("bench", "--help"), ("cc", "--help"),
                          ("tune", "--help")):
            with self.subTest(arguments=arguments):
                self.refused(self.run_it(*arguments, full=True), "standard output")

    def test_a_full_disk_is_named(self):
        """A full disk in the cache folder: PoCL would abort the process that compiles a kernel, and unsaved work would be lost."""
        small = self.at / "small"
        small.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=100k", "none", small], capture_output=True, check=False).returncode:
            self.skipTest("only root may mount a small disk")
        try:
            self.refused(self.run_it("run", "sheet.lua", "-q", LUTETIA_INTERPRET="0",
                                     XDG_CACHE_HOME=str(small), POCL_CACHE_DIR=str(small / "pocl")),
                         "the disk is full", str(small))
        finally:
            subprocess.run(["umount", small], check=True)

    def test_failed_runs_keep_what_was_saved(self):
        self.script("early.lua", "error('early')")
        self.assertEqual(self.run_it("run", "sheet.lua", "-q", "--save", "all.h5").returncode, 0)
        before = (self.at / "all.h5").read_bytes()
        self.refused(self.run_it("run", "early.lua", "-q", "--save", "all.h5"), "early")
        self.assertEqual((self.at / "all.h5").read_bytes(), before)

    # ---- input ----

    def test_compiler_of_several_words(self):
        """CC is one program, or words as make takes them; a program whose name has blanks is one, too."""
        self.script("good.c", "#include <stdio.h>\n#include <cm/paris.h>\nint main() { puts(\"good\"); return 0; }\n")
        self.script("c compiler", "#!/bin/sh\nexec cc \"$@\"\n")
        (self.at / "c compiler").chmod(0o755)
        for compiler in ("env cc", " env  cc  -O1 ", str(self.at / "c compiler")):
            with self.subTest(compiler=compiler):
                done = self.run_it("cc", "good.c", "-o", "words", CC=compiler)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(subprocess.run(["./words"], cwd=self.at, capture_output=True, timeout=SECONDS).stdout, b"good\n")

    def test_programs_appear_whole_whatever_else_the_compiler_writes(self):
        """(security.md 11) Files whose names the compiler derives from the program's are the same as without `lutetia cc`; an old program
        stays after a failure."""
        self.script("good.c", "#include <stdio.h>\n#include <cm/paris.h>\nint main() { puts(\"good\"); return 0; }\n")
        self.script("bad.c", "int nothing_has_this(); int main() { return nothing_has_this(); }\n")
        more = {"-MD": "*.d", "-save-temps": "*.s", "-ftest-coverage": "*.gcno", "--coverage": "*.gcno", "-flto": "good.c"}
        for compiler in filter(shutil.which, ("gcc", "clang")):
            for option, derived in more.items():
                if compiler == "clang" and (option == "-flto" or not self.compiles(compiler, option)):
                    continue  # -flto needs a plugin of the linker
                with self.subTest(compiler=compiler, option=option):
                    self.script("former", "#!/bin/sh\necho former\n")
                    (self.at / "former").chmod(0o750)
                    before = self.at.joinpath("former").read_bytes()
                    self.assertNotEqual(self.run_it("cc", option, "bad.c", "-o", "former", CC=compiler).returncode, 0)
                    self.assertEqual(self.at.joinpath("former").read_bytes(), before)
                    self.assertEqual((self.at / "former").stat().st_mode & 0o777, 0o750)
                    done = self.run_it("cc", option, "good.c", "-oprog", CC=compiler)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual(subprocess.run(["./prog"], cwd=self.at, capture_output=True, timeout=SECONDS).stdout, b"good\n")
                    self.assertTrue(list(self.at.glob(derived)), derived)
                    self.assertFalse(list(self.at.glob(".*.part")))
                    for made in self.at.glob("*.[dsiog]*"):
                        made.unlink()
                    (self.at / "prog").unlink()

    def compiles(self, compiler, option):
        """Does the compiler by itself? clang's --coverage links with a library that is a package of its own."""
        with tempfile.TemporaryDirectory() as elsewhere:
            pathlib.Path(elsewhere, "empty.c").write_text("int main(void) { return 0; }\n", encoding="utf-8")
            return subprocess.run([compiler, option, "empty.c"], cwd=elsewhere, capture_output=True, check=False).returncode == 0

    def test_pipes_hold_nobody(self):
        os.mkfifo(self.at / "pipe.png")
        os.mkfifo(self.at / "pipe.svg")
        self.script("image.lua", 'image("pipe.png")\n')
        self.script("drawing.lua", 'svg("pipe.svg")\n')
        self.script("samples.lua", SHEET + 'p:stroke{brush = p:brush{}, file = "pipe.svg"}\n')
        self.script("load.lua", 'paper.load("pipe.svg")\n')
        for arguments in (("run", "pipe.png"), ("run", "sheet.lua", "--resume", "pipe.png"), ("font", "./pipe.png"),
                          ("type", "x", "--font", "./pipe.png"), ("type", "x", "--filter", "@pipe.png"),
                          ("paint", "--image", "pipe.png"), ("run", "image.lua"), ("run", "drawing.lua"),
                          ("run", "samples.lua"), ("run", "load.lua")):
            with self.subTest(arguments=arguments):
                self.refused(self.run_it(*arguments), "regular file", "pipe.")

    def test_devices_and_folders_are_no_files(self):
        for what in ("/dev/zero", "/dev/null", "/"):
            for arguments in (("run", what), ("run", "sheet.lua", "--resume", what), ("font", what),
                              ("type", "x", "--font", what), ("type", "x", "--filter", "@" + what)):
                with self.subTest(arguments=arguments):
                    self.refused(self.run_it(*arguments), what)

    # ---- printed text ----

    def test_escapes_are_shown(self):
        evil = "a\x1b]0;owned\x07\x9b2J\x7f\r\n\u202egnp"
        literal = '"\\x1b]0;owned\\x07\\x9b2J\\r\\n\\u{202e}"'
        (self.at / (evil + ".lua")).write_text("error(1)")
        (self.at / (evil + ".png")).write_bytes(b"no picture")
        self.script("error.lua", "error(%s)" % literal)
        self.script("name.lua", "_ENV[%s]()" % literal)
        self.script("image.lua", "image(%s .. 'x.png')" % literal)
        self.script("keys.lua", "paper{[%s] = 1}" % literal)
        self.script("words.lua", "param('a', 1)\n")
        self.script("syntax.lua", "x = = '%s'" % evil)
        for arguments, status in (((evil,), 2), (("run", "--" + evil), 2), (("run", evil), 1), (("run", evil + ".lua"), 1),
                                  (("run", "error.lua"), 1), (("run", "name.lua"), 1), (("run", "image.lua"), 1),
                                  (("run", "keys.lua"), 1), (("run", "words.lua", "a=" + evil), 1),
                                  (("run", "words.lua", evil + "=1"), 1), (("run", "syntax.lua"), 1),
                                  (("run", "sheet.lua", "--save", evil + "/x.h5"), 1),
                                  (("run", "sheet.lua", "--sweep", "b=" + evil), 1),
                                  (("run", "sheet.lua", "--resume", evil + ".png"), 1),
                                  (("paint", "--image", evil + ".png"), 1), (("type", "x", "--font", evil), 1),
                                  (("type", "x", "--filter", evil), 2), (("font", "./" + evil + ".png"), 1),
                                  (("leds", "./" + evil), 1), (("explain", "./" + evil), 1), (("debug", "./" + evil), 1),
                                  (("bench", evil), 2)):
            with self.subTest(arguments=arguments):
                done = self.run_it(*arguments)
                self.assertNotEqual(done.returncode, 0)
                self.assertGreater(len(done.words), 0)
                self.assertIsNone(BAD.search(done.words), repr(done.words))

    # ---- written files ----

    def test_only_files_are_replaced(self):
        os.mkfifo(self.at / "pipe.png")
        (self.at / "folder.png").mkdir()
        (self.at / "old").write_text("old")
        os.symlink("old", self.at / "link.png")
        os.symlink("nowhere", self.at / "dangling.png")
        os.mknod(self.at / "null.png", 0o600 | stat.S_IFCHR, os.makedev(1, 3)) if os.getuid() == 0 else None
        names = ["pipe.png", "folder.png", "link.png", "dangling.png", "/dev/null", "no/such.png"]
        names += ["null.png"] if os.getuid() == 0 else []
        self.script("nothing.lua", "")
        self.script("frame.lua", "local p = paper{width = 16, height = 16}\n" + "".join(
            'print(pcall(p.frame, p, "%s"))\n' % name for name in names))
        before = sorted(os.listdir(self.at))
        for name in names:
            for arguments in (("type", "x", "-o", name), ("font", "DejaVuSans", "-o", name),
                              ("run", "nothing.lua", "-q", "--save", name)):
                with self.subTest(arguments=arguments):
                    self.refused(self.run_it(*arguments), name.split(".")[0])
        lines = self.run_it("run", "frame.lua", "-q").stdout.decode().splitlines()
        self.assertEqual([line.split()[0] for line in lines], ["false"] * len(names), lines)
        self.refused(self.run_it("run", "sheet.lua", "-q", "--video", "no/such.y4m"), "no/such.y4m")
        for name in ("frame.png", "sheet.h5"):
            (self.at / name).unlink(missing_ok=True)
        self.assertEqual((self.at / "old").read_text(), "old")
        self.assertTrue(stat.S_ISFIFO(os.lstat(self.at / "pipe.png").st_mode))
        self.assertTrue(os.path.islink(self.at / "link.png"))
        self.assertEqual(before, sorted(os.listdir(self.at)))

    def test_a_reader_who_leaves_leaves_no_folder(self):
        (self.at / "one.c").write_text("#include <cm/paris.h>\nint main() { CM_init(); CM_set_context(); return (int)CM_global_count_context() == 0; }\n")
        (self.at / "tmp").mkdir()
        self.assertEqual(self.run_it("cc", "one.c", "-o", "one").returncode, 0)
        read, written = os.pipe()
        os.close(read)
        with os.fdopen(written) as pipe:
            subprocess.run([LUTETIA, "explain", "./one"], cwd=self.at, stdin=subprocess.DEVNULL, stdout=pipe, stderr=subprocess.DEVNULL,
                           env=dict(os.environ, TMPDIR=str(self.at / "tmp")), timeout=300, check=False)
        self.assertEqual(os.listdir(self.at / "tmp"), [])

    def test_scripts_names_have_our_endings(self):
        names = (".bashrc", "x@OTHER", "x", "@END", "sub/@END", ".x@END", "sub/.x@END", "-rf@END", "sub/-x@END", "../x@END",
                 "sub/../x@END", "sub/../../x@END", "/tmp/x@END", "x@END/", ".git/x@END", "link@END", "out/x@END", "X@UPPER")
        (self.at / "sub").mkdir()
        (self.at / ".git").mkdir()
        os.symlink("nowhere", self.at / "link.png")
        os.symlink("nowhere", self.at / "link.h5")
        os.symlink("/tmp", self.at / "out")
        for what, end, other in (("frame", ".png", ".h5"), ("save", ".h5", ".png")):
            all_names = [name.replace("@END", end).replace("@OTHER", other).replace("@UPPER", end.upper()) for name in names]
            self.script(what + ".lua", "local p = paper{width = 16, height = 16}\n" + "".join(
                "print(pcall(p.%s, p, %s))\n" % (what, '"%s"' % name) for name in [*all_names, "./sub/x" + end]))
            before = sorted(str(path) for path in self.at.rglob("*"))
            done = self.run_it("run", what + ".lua", "-q")
            lines = done.stdout.decode().splitlines()
            self.assertEqual((done.returncode, len(lines)), (0, len(names) + 1), done.words)
            for name, line in zip(all_names, lines):
                self.assertTrue(line.startswith("false"), (name, line))
            self.assertEqual(lines[-1], "true")
            (self.at / "sub" / ("x" + end)).unlink()
            self.assertEqual(before, sorted(str(path) for path in self.at.rglob("*")))


if __name__ == "__main__":
    LUTETIA = os.path.abspath(sys.argv.pop(1))
    unittest.main()
