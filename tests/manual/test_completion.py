"""test_completion.py BASH ZSH LUTETIA - types into shells and presses Tab: verbs, options, their values and files are completed.

BASH and ZSH are the completions that the build made; LUTETIA the command, whose --help says what there is.
"""
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

BASH, ZSH, LUTETIA = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
SHOWN_S, LONGEST_S = 0.5, 30  # a shell is done when it has been silent so long; what is waited for in vain


def offered(*words, folder="."):
    """What bash's function offers for the last word of a line."""
    script = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _lutetia; printf "%s\\n" "${COMPREPLY[@]}"'
    done = subprocess.run(["bash", "--norc", "-c", script, "bash", BASH, *words], cwd=folder, capture_output=True, text=True, timeout=60)
    assert not done.stderr, done.stderr
    return [line for line in done.stdout.splitlines() if line]


class Shell:
    """An interactive shell on a terminal of its own."""

    def __init__(self, folder, *command):
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            os.environ |= {"TERM": "dumb", "PS1": "> ", "HOME": str(folder), "INPUTRC": "/dev/null", "ZDOTDIR": str(folder), "COLUMNS": "200"}
            os.execvp(command[0], command)

    def type(self, text, until):
        """Types, and returns what is shown until it matches, or for long enough."""
        os.write(self.terminal, text.encode())
        seen, end = "", time.monotonic() + LONGEST_S
        while time.monotonic() < end and not re.search(until, seen):
            if select.select([self.terminal], [], [], SHOWN_S)[0]:
                try:
                    seen += os.read(self.terminal, 4096).decode(errors="replace")
                except OSError:
                    break
        return seen

    def end(self):
        os.close(self.terminal)
        try:
            os.kill(self.pid, 9)
        except ProcessLookupError:
            pass
        os.waitpid(self.pid, 0)


class Bash(unittest.TestCase):
    def test_verbs(self):
        verbs = re.findall(r"^  ([a-z]+) ", subprocess.run([LUTETIA, "--help"], capture_output=True, text=True).stdout, re.M)
        self.assertEqual(sorted(offered("lutetia", "")), sorted([*verbs, "--help", "--version"]))
        self.assertEqual(offered("lutetia", "spr"), ["spring"])

    def test_options_are_all_that_the_help_lists(self):
        for verb in ("paint", "midi", "spring", "info"):
            text = subprocess.run([LUTETIA, verb, "--help"], capture_output=True, text=True).stdout
            names = re.findall(r"^  (?:-., )?(--[a-z-]+)", text, re.M)
            self.assertEqual(sorted(w for w in offered("lutetia", verb, "--")), sorted(names), verb)

    def test_values(self):
        self.assertEqual(offered("lutetia", "paint", "--stock", "hot"), ["hot\\ press"])
        self.assertEqual(offered("lutetia", "paint", "--stock", "=", "ro"), ["rough"])
        self.assertEqual(offered("lutetia", "paint", "--pigment", "french\\ u"), ["french\\ ultramarine="])
        self.assertEqual(offered("lutetia", "paint", "--pigment", "\"hook"), ["hooker's green="])
        self.assertEqual(offered("lutetia", "spring", "-p", "je"), ["jelly"])
        self.assertEqual(offered("lutetia", "paint", "--steps", ""), [])
        self.assertIn("gaussian-fast", offered("lutetia", "type", "--filter", "ga"))

    def test_commands_of_a_verb(self):
        self.assertEqual(offered("lutetia", "midi", "mon"), ["monitor"])
        self.assertEqual(offered("lutetia", "bench", "diff"), ["diffusion"])

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a song.mid", "rain.lua", "rain.txt"):
                (pathlib.Path(folder) / name).touch()
            (pathlib.Path(folder) / "rainbow").mkdir()
            self.assertEqual(sorted(offered("lutetia", "run", "ra", folder=folder)), ["rain.lua", "rainbow"])
            self.assertEqual(offered("lutetia", "paint", "--frames", "ra", folder=folder), ["rainbow"])
            self.assertEqual(offered("lutetia", "keys", "a", folder=folder), ["a song.mid"])

    def test_a_terminal(self):
        with tempfile.TemporaryDirectory() as folder:
            shell = Shell(folder, "bash", "--norc", "--noprofile", "-i")
            try:
                shell.type(f"source {BASH}; echo rea''dy\r", "ready")
                self.assertIn("--deckle", shell.type("lutetia paint --dec\t", "--deckle"))
                self.assertIn("hot\\ press", shell.type(" --stock ho\t", r"hot\\ press"))
            finally:
                shell.end()


@unittest.skipUnless(shutil.which("zsh"), "no zsh")
class Zsh(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        at = pathlib.Path(self.folder.name)
        (at / "tune.mid").touch()
        self.shell = Shell(at, "zsh", "-f", "-i")
        self.shell.type(f"fpath=({ZSH.parent} $fpath); autoload -U compinit; compinit -u -d {at}/dump; echo rea''dy\r", "ready")

    def tearDown(self):
        self.shell.end()
        self.folder.cleanup()

    def test_verbs_options_values_and_files(self):
        self.assertRegex(self.shell.type("lutetia spr\t", "lutetia spring"), "lutetia spring")
        self.assertIn("--preset", self.shell.type("--pre\t", "--preset"))
        self.assertIn("jelly", self.shell.type("jel\t", "jelly"))
        self.shell.type("\x15", " ")
        self.assertIn("hot\\ press", self.shell.type("lutetia paint --stock=hot\t", r"hot\\ press"))
        self.assertIn("hooker\\'s\\ green=", self.shell.type(" --pigment hoo\t", "green="))
        self.shell.type("\x15", " ")
        self.assertIn("diffusion", self.shell.type("lutetia bench diffu\t", "diffusion"))
        self.shell.type("\x15", " ")
        self.assertIn("tune.mid", self.shell.type("lutetia keys tu\t", r"tune\.mid"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
