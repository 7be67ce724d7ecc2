"""Compares the version in meson.build with all that states one.

    version.py ROOT LUTETIA PARIS.PC

The program and paris.pc must say it, CHANGELOG.md must begin with it, and where there is a debian/changelog so must that. No
other file may contain the number: it would be forgotten at the next release.
"""

import pathlib
import re
import subprocess
import sys

MAY = {"meson.build", "CHANGELOG.md", "debian/changelog"}


def first(pattern, text):
    found = re.search(pattern, text, re.MULTILINE)
    return found.group(1) if found else None


def main():
    root = pathlib.Path(sys.argv[1])
    version = first(r"^\s*version: '([^']+)'", (root / "meson.build").read_text())
    wrong = []

    def compare(what, other):
        if other != version:
            wrong.append("%s says %s, meson.build %s" % (what, other, version))

    said = subprocess.run([sys.argv[2], "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    compare("lutetia --version", first(r"^lutetia (\S+)$", said))
    compare("paris.pc", first(r"^Version: (\S+)$", pathlib.Path(sys.argv[3]).read_text()))
    compare("the first heading of CHANGELOG.md", first(r"^## (\d[\w.]*)", (root / "CHANGELOG.md").read_text()))
    if (root / "debian/changelog").exists():
        compare("debian/changelog", first(r"^\w+ \((\d[\d.]*)", (root / "debian/changelog").read_text()))
    number = re.compile(r"(?<![\d.])%s(?![\d.])" % re.escape(version))
    for path in root.rglob("*"):
        name = path.relative_to(root).as_posix()
        if re.match(r"build|\.git/|debian/", name) or not path.is_file() or name in MAY or path.stat().st_size > 1 << 20:
            continue
        if any((root / folder / "meson-private").exists() for folder in name.split("/")[:1]):
            continue
        text = path.read_bytes()
        if b"\0" not in text and number.search(text.decode("utf-8", "replace")):
            wrong.append("%s contains the version, which stands in meson.build alone" % name)
    print("\n".join(wrong) or "version %s" % version)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
