"""test_debugging.py SOURCE LUTETIA [--write]: docs/debugging.md, followed by hand: what it says that the debugger shows, it shows.

The page's C goes into the file that stands before it, and its commands run in their order. What a `lutetia debug` prints, without gdb's
own lines about threads and breakpoints, must be the text below its command; --write writes it there.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "lutetia"))
import debugger

SOURCE, LUTETIA = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
PATH = SOURCE / "docs/debugging.md"
PAGE = PATH.read_text(encoding="utf-8")
CONSOLE = re.compile(r"^```console\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def followed():
    """The page as it must be, and what it shows."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {**debugger.ENVIRONMENT, "PATH": f"{LUTETIA.parent}:{os.environ['PATH']}"}
        name = re.search(r"^`(\w+\.c)`:\n\n```c\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
        (pathlib.Path(folder) / name.group(1)).write_text(name.group(2), encoding="utf-8")
        shown = []

        def block(match):
            lines = []
            for command in (line for line in match.group(1).splitlines() if line.startswith("$ ")):
                done = subprocess.run(["sh", "-c", command[2:]], cwd=folder, env=environment, capture_output=True, text=True, timeout=300,
                                      check=False)
                if done.returncode:
                    raise AssertionError(f"{command}: status {done.returncode}: {done.stdout}{done.stderr}")
                said = debugger.own_lines(done.stdout + done.stderr) if "lutetia debug" in command else []
                shown.append((command, said))
                lines += [command, *said]
            return "```console\n" + "\n".join(lines) + "\n```"
        return CONSOLE.sub(block, PAGE), shown


class Followed(unittest.TestCase):
    maxDiff = None

    def test_page(self):
        page, shown = followed()
        sessions = [said for command, said in shown if "lutetia debug" in command]
        self.assertEqual(len(sessions), 5)
        for said in sessions:
            self.assertGreater(len(said), 1, said)
        self.assertEqual(page, PAGE)


if "--write" in sys.argv:
    PATH.write_text(followed()[0], encoding="utf-8")
    sys.exit()
why = debugger.missing()
if why:
    print(f"skipped: {why}")
    sys.exit(77)
unittest.main(argv=sys.argv[:1])
