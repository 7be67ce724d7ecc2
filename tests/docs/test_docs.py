"""Shows docs.py small trees, right ones and wrong ones."""

import pathlib
import tempfile
import unittest

from docs import House

CODE = {
    "host/engine/graph.c": 'void graph_derive_nan(void) {}\nint main(void) { return getenv("LUTETIA_DEVICE") != 0; }\n',
    "host/display/gl/draw.c": "static int x; /* docs/tour.md#words */\n",
    "host/engine/settings.c": '    {SETTING(EAGER, eager), 0},\n    {SETTING_READ(TILE, tile, sides), 0},\n',
    "host/verb.c": 'static const char *options[] = {"still", "set"};\n',
    "tests/meson.build": "foreach part : ['forms', 'widths']\n  test('paris_' + part + '_eager', one)\nendforeach\n",
    "docs/tour.md": "# Tour\n\n## Words\n\nText.\n",
}
GOOD = "[a](docs/tour.md#words) `LUTETIA_DEVICE`, `LUTETIA_EAGER`, `LUTETIA_TILE`\n"


class Documents(unittest.TestCase):
    def offences(self, readme, **files):
        with tempfile.TemporaryDirectory() as folder:
            tree = {**CODE, "README.md": GOOD + readme, **{k.replace("__", "/"): v for k, v in files.items()}}
            for name, text in tree.items():
                path = pathlib.Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return House(folder).check()

    def clean(self, readme, **files):
        self.assertEqual(self.offences(readme, **files), [])

    def wrong(self, readme, *parts, **files):
        found = self.offences(readme, **files)
        self.assertEqual(len(found), 1, found)
        for part in parts:
            self.assertIn(part, found[0])

    def test_names(self):
        self.clean("`graph_derive_nan()` and `graph_derive_nan`; `verb_NAME.c`, `graph_...`, `paris_widths_eager`")
        self.wrong("a line\n`derive_nan`", "README.md:3", "derive_nan")
        self.wrong("`shape_gpu()`", "shape_gpu")
        self.wrong("`rows()`", "rows")
        self.wrong("`grapf_...`", "grapf_")
        self.wrong("`paris_lengths_eager`", "paris_lengths_eager")
        self.clean("```\nderive_nan\n```\n")

    def test_files_and_folders(self):
        self.clean("`engine/graph.c`, `display/gl`, `host/display/gl/`, `host/verb.c`\n\n    engine/graph.c   text\n")
        self.wrong("`display/gl/pictures`", "display/gl/pictures")
        self.wrong("`engine/grape.c`", "engine/grape.c")
        self.wrong("\n    host/grape.c   text\n", "README.md:3", "grape.c")

    def test_links(self):
        self.clean("[a](docs/tour.md) [b](https://x.org/y) [c](#words)\n\n# Words\n")
        self.wrong("[a](docs/hour.md)", "docs/hour.md")
        self.wrong("[a](docs/tour.md#swords)", "docs/tour.md#swords")
        self.wrong("[a](#swords)", "#swords")
        self.wrong("", "host/c.c:1", "docs/hour.md", host__c="", **{"host/c.c": "/* docs/hour.md */\n"})

    def test_chapters(self):
        def chapters(text):
            return {"docs/manual/chapters.txt": text}
        self.clean("", **chapters("README.md\ndocs/tour.md\n"))
        self.wrong("", "the manual has no docs/tour.md", **chapters("README.md\n"))
        self.wrong("", "docs/tour.md is there twice", **chapters("docs/tour.md\ndocs/tour.md\n"))
        self.wrong("", "hour.md is no document", **chapters("docs/tour.md\nhour.md\n"))

    def test_options(self):
        self.clean("`lutetia spring --still a.png --set x=1`")
        self.wrong("`lutetia spring --stil a.png`", "--stil")

    def test_variables(self):
        self.wrong("`LUTETIA_SCATTER=1`", "the code knows no LUTETIA_SCATTER")
        self.wrong("", "no document names LUTETIA_SCATTER", **{"host/s.c": "    {SETTING(SCATTER, scatter)},\n"})
        self.wrong("", "no document names LUTETIA_DUMP", **{"host/s.c": 'getenv("LUTETIA_DUMP")'})
        self.clean("", **{"host/s.h": "#ifndef LUTETIA_GUARD_H\n"})


if __name__ == "__main__":
    unittest.main()
