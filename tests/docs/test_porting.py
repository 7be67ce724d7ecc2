"""test_porting.py SOURCE LUTETIA: docs/porting.md, followed by hand: what it says that happens, happens.

The page's C goes into the file that stands before it, its commands run in their order, and each has its own check here: the page
says in words what comes, since messages differ between compilers.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE, LUTETIA = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
PAGE = (SOURCE / "docs/porting.md").read_text(encoding="utf-8")


def blocks(kind):
    return re.findall(r"^```%s\n(.*?)^```$" % kind, PAGE, re.MULTILINE | re.DOTALL)


class Followed(unittest.TestCase):
    def test_page(self):
        commands = [line[2:] for block in blocks("console") for line in block.splitlines() if line.startswith("$ ")]
        with tempfile.TemporaryDirectory() as folder:
            environment = {**os.environ, "PATH": f"{LUTETIA.parent}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8"}
            name = re.search(r"^`(\w+\.c)`:\n\n```c$", PAGE, re.MULTILINE).group(1)
            (pathlib.Path(folder) / name).write_text(blocks("c")[0], encoding="utf-8")

            def run(command):
                return subprocess.run(["sh", "-c", command], cwd=folder, env=environment, capture_output=True, text=True, timeout=300, check=False)

            done = {}
            for command in commands:
                done[command] = run(command)
                if command.startswith("lutetia cc relief.c"):
                    self.assertIn(run("./relief").returncode, (139, -11), "a pointer that lost its upper half does no harm")
            self.assertEqual((pathlib.Path(folder) / "survey").stat().st_size, 8192)
            warned = done[commands[2]].stdout
            self.assertIn("exit", warned)
            self.assertRegex(warned, r"cast.*from pointer to integer|cast to smaller integer")
            refused = done["sed 's/.*relief/relief/' messages"].stdout
            self.assertEqual(len(refused.splitlines()), 1, refused)
            self.assertRegex(refused, r"relief\.c:\d+: CM_s_add_3_1L")
            self.assertEqual(done["./relief 2>messages"].returncode, 1)
            self.assertEqual(done["./relief"].stdout, "highest 32319, steepest 32319\n")
            self.assertEqual(done["./relief swapped"].stdout, "highest 16254, steepest 16254\n")
            for command in (c for c in commands if c.startswith("lutetia cc")):
                self.assertEqual(done[command].returncode, 0, command)


unittest.main(argv=sys.argv[:1])
