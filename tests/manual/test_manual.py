"""test_manual.py MAN LUTETIA HEADER SCRIPTS - the manual pages of a build: each is without warnings, and says all that it should.

MAN is the folder of pages; LUTETIA the command, whose --help is compared; HEADER <cm/paris.h>, each of whose functions must have a
page; SCRIPTS docs/scripts.md, which must name each function that scripts have.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

MAN, LUTETIA, HEADER, SCRIPTS = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])
SECTIONS = ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "ENVIRONMENT", "EXIT STATUS", "EXAMPLES", "SEE ALSO"]


def said(*command, **more):
    return subprocess.run(command, capture_output=True, text=True, timeout=120, **more)


def pages():
    return [page for page in sorted(MAN.glob("man?/*")) if not page.is_symlink()]


def plain(page):
    """The page's text, without its macros and fonts."""
    text = re.sub(r"\\f[BIR]", "", page.read_text())
    for escape, sign in {r"\-": "-", r"\(aq": "'", r"\(ga": "`", r"\(ha": "^", r"\(ti": "~", r"\&": "", r"\e": "\\"}.items():
        text = text.replace(escape, sign)
    return text


def heads(page):
    return [line[4:].strip('"') for line in page.read_text().splitlines() if line.startswith(".SH ")]


class Manual(unittest.TestCase):
    def test_no_page_has_warnings_of_mandoc(self):
        if not shutil.which("mandoc"):
            self.skipTest("no mandoc")
        found = said("mandoc", "-Tlint", "-W", "warning", *map(str, pages()))
        self.assertEqual(found.stdout + found.stderr, "")

    def test_no_page_has_warnings_of_groff(self):
        if not shutil.which("groff"):
            self.skipTest("no groff")
        for page in pages():
            if page.parent.name != "man3" or page.name[3] == "s":  # of pages of one kind some
                found = said("groff", "-ww", "-man", "-K", "utf8", "-Tutf8", "-rLL=100n", str(page))
                self.assertEqual(found.stderr, "", page)

    def test_a_wrong_page_is_noticed(self):
        if not shutil.which("mandoc"):
            self.skipTest("no mandoc")
        found = said("mandoc", "-Tlint", "-W", "warning", input=".TH x 1 2026-11-25\n.SH NAME\nx \\- y\n.RE\n.XX\n")
        self.assertNotEqual(found.stdout + found.stderr, "")

    def test_man_finds_pages(self):
        if not shutil.which("man"):
            self.skipTest("no man")
        for name in ("lutetia", "lutetia-paint", "CM_f_add_2_1L", "paris", "lutetia-scripts"):
            found = said("man", "-w", name, env=os.environ | {"MANPATH": str(MAN)})
            self.assertIn(str(MAN), found.stdout, name)

    def test_each_verb_has_a_page_with_each_option(self):
        verbs = re.findall(r"^  ([a-z]+) ", said(LUTETIA, "--help").stdout, re.M)
        self.assertGreater(len(verbs), 10)
        main = plain(MAN / "man1/lutetia.1")
        for verb in verbs:
            page = MAN / f"man1/lutetia-{verb}.1"
            text = plain(page)
            for section in SECTIONS:
                self.assertIn(section, heads(page), page)
            self.assertIn(f"lutetia-{verb}(1)", main)
            for option in re.findall(r"^  (?:-., )?(--[a-z-]+)", said(LUTETIA, verb, "--help").stdout, re.M):
                self.assertRegex(text, rf"\n(-., |-. .*, )?{option}\b", page)
        self.assertEqual({p.name for p in MAN.glob("man1/*")}, {"lutetia.1"} | {f"lutetia-{v}.1" for v in verbs})

    def test_examples_are_commands_of_this_program(self):
        """Their options are those that their pages list."""
        for page in MAN.glob("man1/lutetia-*.1"):
            verb = page.stem.removeprefix("lutetia-")
            text = plain(page)
            examples = text[text.index(".SH EXAMPLES"):text.index('.SH "SEE ALSO"')]
            lines = [line for line in examples.splitlines() if f"lutetia {verb}" in line]
            self.assertGreater(len(lines), 0, page)
            if verb in ("cc", "bench"):
                continue
            for line in lines:
                for option in re.findall(r" (--[a-z][a-z-]*)", line):
                    self.assertRegex(text, rf"\n(-., |-. .*, )?{option}\b", f"{page}: {line}")

    def test_examples_that_need_no_file_work(self):
        """Those that are quick, and open no window."""
        tried = 0
        for page in MAN.glob("man1/lutetia-*.1"):
            text = plain(page)
            for line in text[text.index(".SH EXAMPLES"):text.index('.SH "SEE ALSO"')].splitlines():
                words = shlex.split(line.replace("$'", "'")) if line.startswith("lutetia ") else [""]
                if not (words[1:2] and words[1] in ("type", "font", "info") or "--controls" in words or "--cry" in words):
                    continue
                with tempfile.TemporaryDirectory() as folder:
                    done = said(str(pathlib.Path(LUTETIA).resolve()), *words[1:], cwd=folder)
                    tried += "there is no font" not in done.stderr
                    if "there is no font" not in done.stderr:
                        self.assertEqual((done.returncode, done.stderr), (0, ""), f"{page}: {line}")
        self.assertGreater(tried, 4)

    def test_help_of_a_verb_is_its_help(self):
        self.assertEqual(said(LUTETIA, "help", "paint").stdout, said(LUTETIA, "paint", "--help").stdout)
        wrong = said(LUTETIA, "help", "pain")
        self.assertEqual((wrong.returncode, wrong.stdout), (2, ""))
        self.assertIn("pain", wrong.stderr)

    def test_each_instruction_has_a_page_that_names_it(self):
        names = re.findall(r"^extern .*\b(CM_\w+) \(", HEADER.read_text(), re.M)
        self.assertGreater(len(names), 2000)
        texts = {}
        for name in names:
            page = MAN / f"man3/{name}.3"
            self.assertTrue(page.exists(), name)
            whole = page.resolve()
            if whole not in texts:
                texts[whole] = set(re.findall(r"\bCM_\w+(?= \()", plain(whole)))
            if "_const_" not in name:
                self.assertIn(name, texts[whole], page)

    def test_operands_are_explained(self):
        """Each name in a page's prototypes is an item of its section OPERANDS."""
        for page in MAN.glob("man3/*.3"):
            if page.is_symlink():
                continue
            text = plain(page)
            synopsis = " ".join(text[text.index(".SH SYNOPSIS"):text.index(".SH DESCRIPTION")].split())
            names = set()
            for arguments in re.findall(r"CM_\w+ \((.*?)\);", synopsis):
                names |= set(re.findall(r"(\w+)(?:,|$)", re.sub(r"\(\*(\w+)\) \([^)]*\)", r"\1", arguments))) - {"void"}
            operands = text[text.index(".SH OPERANDS"):text.index(".SH ERRORS")] if ".SH OPERANDS" in text else ""
            items = re.findall(r"\n\.TP\n(.*)", operands)
            self.assertEqual(names - {name for item in items for name in item.split(", ")}, set(), page)

    def test_pages_of_instructions_say_at_the_top_what_they_do(self):
        """No bracket is left open, no sentence is cut in two, nothing stands twice."""
        for page in MAN.glob("man3/*.3"):
            if page.is_symlink():
                continue
            short = re.search(r"\.SH NAME\n.*? - (.*)", plain(page)).group(1)
            self.assertEqual(short.count("("), short.count(")"), page)
            self.assertRegex(short, r"^(NEWS|[^A-Z]).*[\w)|]$", page)
            self.assertNotRegex(short, r"^nEWS|^the same|= not$|^dest$", page)
            parts = re.split(r"; ", short)
            self.assertEqual(len(parts), len(set(parts)), page)
            heads_below = re.findall(r"^\.SS (.*)$", page.read_text(), re.M)
            self.assertEqual(len(heads_below), len(set(heads_below)), page)

    def test_pages_that_are_named_exist(self):
        there = {p.name for p in MAN.glob("man?/*")}
        for page in pages():
            for name, section in re.findall(r"\b((?:lutetia|CM_|paris)[\w-]*)\(([137])\)", plain(page)):
                self.assertTrue(f"{name}.{section}" in there, f"{page}: {name}({section})")

    def test_devices_are_those_of_the_server(self):
        kinds = re.findall(r"^  ([a-z]+)", said(LUTETIA, "midi", "devices", "kinds").stdout, re.M)
        self.assertGreater(len(kinds), 5)
        for kind in kinds:
            self.assertRegex(plain(MAN / "man1/lutetia-midi.1"), rf"(?m)^{kind}(:|$)")

    def test_scripts_functions_are_described(self):
        text = SCRIPTS.read_text()
        table = [line.split("\t") for line in said(LUTETIA, "help", "--table").stdout.splitlines() if line.startswith("script\t")]
        self.assertGreater(len(table), 80)
        for _, kind, name in table:
            self.assertRegex(text, rf"[`:. ]{name}[({{\"]|p:{name}\b|`{name}`", f"docs/scripts.md: {kind} {name}")

    def test_variables_are_those_of_the_table(self):
        rows = [line.split("\t") for line in said(LUTETIA, "help", "--table").stdout.splitlines() if line.startswith("environment\t")]
        self.assertGreater(len(rows), 40)
        main, info = plain(MAN / "man1/lutetia.1"), said(LUTETIA, "info", "--variables").stdout
        for _, name, value, _, _ in rows:
            self.assertIn(f"\n{name}={value}\n", main)
            self.assertIn(f"  {name}={value} ", info)

    def test_variables_that_the_code_reads_are_in_the_table(self):
        root, names = SCRIPTS.resolve().parent.parent, set()
        for folder in ("host", "midi", "paris_compat", "voice", "fontpipe", "dynamics"):
            for path in (root / folder).rglob("*.c"):
                text = path.read_text()
                names |= set(re.findall(r'(?:getenv\(|variable = )"(LUTETIA_\w+)"', text))
        settings = (root / "host/machine/machine_settings.tab").read_text()
        names |= {"LUTETIA_" + name for name in re.findall(r"^SETTING\((\w+),", settings, re.MULTILINE)}
        self.assertGreater(len(names), 30)
        rows = [line.split("\t") for line in said(LUTETIA, "help", "--table").stdout.splitlines()]
        self.assertEqual(names - {row[1] for row in rows if row[0] == "environment"}, set(), "host/lutetia/environment.c lacks these")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
