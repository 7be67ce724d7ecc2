"""Finds what the documents say and the code does not know, and what no document says.

    docs.py ROOT        prints each offence, and ends with 1 if there is one

- Links: a link to a file or to a heading of a document must lead there, in documents and in comments that name a document.
- Names in code spans (`like_this`): a function, a variable or a constant must be a word of the code.
- Files and folders in code spans and in indented text: they must be there.
- Options (`--like-this`): the code must know them.
- The manual's chapters: all documents of docs/, each once.
- Environment variables LUTETIA_...: the code must know those that a document names, and a document must name those that the
  code reads.

What stands for something else is not looked for: FILE, NAME and other words of capitals, `prefix_...`, `<module>`.
"""

import os
import pathlib
import re
import sys

NO_CODE = {".png", ".svg", ".csv", ".mid", ".otf", ".ttf", ".wav", ".pgm"}
SOURCE = r"(?:c|h|cl|tab|py|lua|build)"
FILE = re.compile(r"(?<![\w/.$~*<>…-])((?:[\w.-]+/)*[\w-]+\.%s)\b(?![\w/(*])" % SOURCE)
FOLDER = re.compile(r"^((?:[\w-]+/)+[\w-]*)$")
NAME = re.compile(r"(?<![\w/.$<…-])([A-Za-z]\w*_\w*|[a-z]\w+(?=\(\)))(?![\w>])(\*|\.\.\.|…|-)?")
VARIABLE = re.compile(r"\bLUTETIA_[A-Z][A-Z_]*[A-Z]\b")
OPTION = re.compile(r"(?<![\w-])--([a-z][a-z-]*[a-z])\b")
LINK = re.compile(r"\]\(([^()\s]+)\)")
NAMED = re.compile(r"\bdocs/[\w-]+\.md(?:#[\w-]+)?")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
FENCED = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`([^`]+)`")
INDENTED = re.compile(r"^ {4}.*$", re.MULTILINE)
SETTING = re.compile(r"^\s*\{?(?:SETTING|KNOB)\w*\s*\(\s*([A-Z][A-Z_]*)\s*,", re.MULTILINE)
PLACEHOLDER = re.compile(r"(?<![a-z])[A-Z]{3,}(?![a-z_A-Z])")
ELSEWHERE = {  # what the documents name of others
    "names": {"module_noun_verb", "low_latency", "vfork", "snd_virmidi", "snd_seq", "snd_seq_dummy", "MALLOC_MMAP_THRESHOLD_"},
    "options": {"suite", "list"},
    "files": {"cm/paris.h", "kernels.h", "paris.h", "prog.c", "heat.c", "relief.c", "snow.c"},  # made by the build, or the reader's own
}


def here_not(path):
    """This folder names what the code does not know, to see whether it is found."""
    return path.resolve().parent != pathlib.Path(__file__).resolve().parent


def slug(heading):
    """The anchor that GitHub gives a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.replace("`", "")).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


class House:
    """The documents and the code below a folder."""

    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.offences = []
        self.documents, self.code = {}, {}
        self.paths = set()  # of files and folders
        for path in sorted(self.walk()):
            name = path.relative_to(self.root).as_posix()
            self.paths |= {name} | {parent.as_posix() for parent in pathlib.PurePosixPath(name).parents}
            if path.suffix == ".md":
                self.documents[name] = path.read_text(encoding="utf-8")
            elif path.suffix not in NO_CODE and path.name != "LICENSE" and here_not(path):
                self.code[name] = path.read_text(encoding="utf-8", errors="replace")
        self.ends = {"/".join(parts[i:]) for parts in (p.split("/") for p in self.paths) for i in range(len(parts))}
        self.folders = {part for path in self.paths for part in path.split("/")[:-1]}
        every = "\n".join(self.code.values())
        self.words = set(re.findall(r"\w+", every))
        # The reference of C/Paris is made from the tables, which spell most names in parts.
        self.words |= set(re.findall(r"CM_\w+", self.documents.get("docs/paris-reference.md", "")))
        self.options = set(re.findall(r"--([a-z][a-z-]*)", every)) | set(re.findall(r"[\"']([a-z][a-z-]*)[\"']", every))
        self.settings = {"LUTETIA_" + name for text in self.code.values() for name in SETTING.findall(text)}
        self.made = self.made_by_meson()
        self.read = set(self.settings)
        for name, text in self.code.items():
            if not name.startswith("tests/"):
                self.read |= set(re.findall(r"[\"'](LUTETIA_[A-Z_]*[A-Z])[\"'=]", text))
            else:
                self.read |= set(re.findall(r"getenv\(\s*\"(LUTETIA_[A-Z_]*[A-Z])\"", text))

    def walk(self):
        for folder, folders, files in os.walk(self.root):
            here = pathlib.Path(folder)
            top = here == self.root
            folders[:] = [f for f in folders if not (top and re.match(r"build|\.(?!ci|github)", f))
                          and f != "__pycache__" and not (here / f / "meson-private").exists()]
            for file in files:
                yield here / file

    def made_by_meson(self):
        """Patterns of names that a meson.build puts together: 'machine_' + part + '_eager', 'fuzz_@0@'.format(what)."""
        patterns = []
        for name, text in self.code.items():
            if not name.endswith("meson.build"):
                continue
            parts = "(?:%s)" % "|".join(sorted(map(re.escape, set(re.findall(r"'(\w+)'", text))))) or "x"
            for before, after in re.findall(r"'(\w+_)' \+ \w+(?: \+ '(_\w+)')?", text):
                patterns.append(before + parts + after)
            for whole in re.findall(r"'(\w*@0@\w*)'\.format", text):
                patterns.append(whole.replace("@0@", parts))
        return re.compile("|".join(patterns) or "(?!)")

    def offend(self, document, at, text):
        line = self.documents[document].count("\n", 0, at) + 1 if document in self.documents else 0
        self.offences.append("%s:%d: %s" % (document, line, text))

    def anchors(self, document):
        return {slug(heading) for heading in HEADING.findall(FENCED.sub("", self.documents[document]))}

    def check(self):
        for document, text in self.documents.items():
            if document == "docs/paris-reference.md":  # made from the tables
                continue
            self.check_links(document, text)
            self.check_spans(document, text)
        for name, text in self.code.items():
            for found in NAMED.finditer(text):
                if not self.leads("README.md", found.group()) and not name.startswith("tests/"):
                    self.offences.append("%s:%d: there is no %s"
                                         % (name, text.count("\n", 0, found.start()) + 1, found.group()))
        self.check_chapters()
        said = {variable for text in self.documents.values() for variable in VARIABLE.findall(text)}
        for variable in sorted(self.read - said):
            self.offences.append("no document names %s, which the code reads" % variable)
        return self.offences

    def check_chapters(self):
        """The manual has all documents of docs/, each once."""
        listed = self.code.get("docs/manual/chapters.txt")
        if listed is None:
            return
        chapters = listed.split()
        for chapter in sorted({c for c in chapters if c not in self.documents or chapters.count(c) > 1}):
            self.offences.append("docs/manual/chapters.txt: %s is %s" % (chapter, "there twice" if chapter in self.documents else "no document"))
        for document in sorted(self.documents):
            if re.fullmatch(r"docs/[^/]+", document) and document not in chapters:
                self.offences.append("docs/manual/chapters.txt: the manual has no %s" % document)

    def leads(self, document, target):
        path, _, anchor = target.partition("#")
        place = os.path.normpath(os.path.join(os.path.dirname(document), path)) if path else document
        if place not in self.paths:
            return False
        return not anchor or place not in self.documents or anchor in self.anchors(place)

    def check_links(self, document, text):
        plain = FENCED.sub(lambda m: "\n" * m.group().count("\n"), text)
        plain = re.sub(r"`[^`\n]*`", lambda m: " " * len(m.group()), plain)
        for found in LINK.finditer(plain):
            target = found.group(1)
            if not re.match(r"[a-z]+:", target) and not self.leads(document, target):
                self.offend(document, text.find("](" + target), "the link to %s leads nowhere" % target)

    def check_spans(self, document, text):
        plain = FENCED.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)
        for found in SPAN.finditer(plain):
            self.check_names(document, found.start(1), found.group(1))
            self.check_files(document, found.start(1), found.group(1))
        for found in INDENTED.finditer(plain):
            self.check_files(document, found.start(), found.group())
        for found in VARIABLE.finditer(text):
            if found.group() not in self.words and found.group() not in self.settings:
                self.offend(document, found.start(), "the code knows no %s" % found.group())

    def check_names(self, document, at, span):
        for found in NAME.finditer(span):
            name, more = found.groups()
            if name not in self.words and ("NAME" in name.split("_") or not name.isupper() and PLACEHOLDER.search(
                    re.sub(r"^(CM|PARIS|MACHINE|NODE|LUTETIA)_", "", name))):
                continue  # verb_NAME, SHEET_EVENT_NAME
            if name in ELSEWHERE["names"] or VARIABLE.fullmatch(name) or name in self.ends:
                continue
            if more or name.endswith("_"):
                good = any(word.startswith(name) for word in self.words)
            else:
                good = name in self.words or self.made.fullmatch(name)
            if not good:
                self.offend(document, at + found.start(), "the code knows no `%s`" % name)
        for found in OPTION.finditer(span):
            if found.group(1) not in self.options | ELSEWHERE["options"]:
                self.offend(document, at + found.start(), "nothing knows the option `--%s`" % found.group(1))

    def check_files(self, document, at, span):
        for found in FILE.finditer(span):
            name = found.group(1)
            if name in self.ends or name in ELSEWHERE["files"] or name.startswith(("build", "/")):
                continue
            if PLACEHOLDER.search(name) or re.match(r"\d+\.", name) or not ("_" in name or "/" in name or document.startswith("docs/")):
                continue
            if name.endswith((".lua", ".py")) and "/" not in name or self.is_made(name):
                continue  # a reader's script
            self.offend(document, at + found.start(), "there is no file %s" % name)
        whole = FOLDER.match(span)
        if whole and whole.group(1).split("/")[0] in self.folders and whole.group(1).rstrip("/") not in self.ends:
            if not whole.group(1).startswith("build") and not self.is_made(whole.group(1)) and \
                    not self.made.fullmatch(whole.group(1).rpartition("/")[2]):
                self.offend(document, at, "there is no folder or file %s" % whole.group(1))

    def is_made(self, name):
        """Made by a build: a meson.build names it."""
        last = name.rstrip("/").rpartition("/")[2]
        return any(re.search(r"'[^'\n]*\b%s'" % re.escape(last), text) for path, text in self.code.items()
                   if path.endswith("meson.build"))


if __name__ == "__main__":
    house = House(sys.argv[1])
    offences = house.check()
    print("\n".join(offences))
    print("%d documents, %d files, %d wrong" % (len(house.documents), len(house.code), len(offences)))
    sys.exit(1 if offences else 0)
