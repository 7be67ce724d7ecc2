"""test_names.py SOURCE BENCH: all places that list the benchmarks list the same ones; and the quick form of each runs.

./run's table of packages, `./run help`, the README and `lutetia bench --help` are compared. A benchmark that is tried prints rows and ends
well. A name that is none, and a benchmark that fails, are told.
"""
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(sys.argv[1])
BENCH = sys.argv[2]
SECONDS = 250


def bench(*arguments):
    return subprocess.run([BENCH, *arguments], capture_output=True, text=True, timeout=SECONDS, check=False)


def listed():
    return re.findall(r"^  (\w+) +\S", bench("--help").stdout, re.MULTILINE)


class Names(unittest.TestCase):
    def test_all_places_list_the_same(self):
        names = sorted(listed())
        self.assertGreater(len(names), 10)
        self.assertEqual(len(names), len(set(names)))
        script = (SOURCE / "run").read_text(encoding="utf-8")
        table = re.search(r"^declare -A packages_bench=\((.*?)^\)", script, re.MULTILINE | re.DOTALL).group(1)
        self.assertEqual(sorted(re.findall(r"\[(\w+)\]=", table)), names)
        helped = subprocess.run(["bash", SOURCE / "run", "help"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(sorted(re.findall(r"\w+", re.search(r"measure \((.*?)\)", helped, re.DOTALL).group(1))), names)
        readme = (SOURCE / "README.md").read_text(encoding="utf-8").split("\n## Measure\n")[1].split("\n## ")[0]
        self.assertEqual(sorted(re.findall(r"^\| `(\w+)` \|", readme, re.MULTILINE)), names)

    def test_tries(self):
        for name in listed():
            with self.subTest(name=name):
                done = bench("--quick", name)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertEqual(done.stdout.splitlines()[0], "== " + name)
                self.assertGreater(len(done.stdout.splitlines()), 3, done.stdout)

    def test_what_is_wrong_is_told(self):
        done = bench("--quick", "scan", "nothing")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("'nothing'", done.stderr)
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([BENCH, "--quick", "scan"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=SECONDS, check=False)
        self.assertEqual(done.returncode, 1)


unittest.main(argv=sys.argv[:1])
