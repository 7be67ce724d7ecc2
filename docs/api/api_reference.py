"""Makes a library's reference from the comments of its public headers, and finds functions that do not tell enough.

    api_reference.py ROOT LIBRARY OUT.md DEPENDENCIES    writes the reference of a library of headers.txt, and its depfile
    api_reference.py ROOT --check           prints the functions that do not tell errors, ownership and threads

A comment belongs to the declarations that follow it without an empty line. The comment at a header's head has paragraphs
`Errors:`, `Ownership:` and `Threads:`, which hold for each function that says nothing else; `Errors and threads: as sheet.h says.`
takes them from there. A function's own comment must say more where its type demands it:

- a status is returned: `Errors:` and which; `Errors: as f().` takes those of f;
- a bool is returned: when it is false, or `whether`;
- a pointer is returned: when it is NULL, or that it never is;
- something new is returned, or handed out through a pointer to a pointer: `Owns:` and who frees it and how;
- a pointer to const is returned, or handed out: how long it is `valid`.
"""

import pathlib
import re
import sys

COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
FUNCTION = re.compile(r"^((?:[\w*]+[\s*]+)+?\**)(\w+)\s*\((.*)\)$", re.DOTALL)
LABELS = ("Errors", "Ownership", "Owns", "Threads")


class Declaration:
    def __init__(self, text, comment, header, inline):
        self.text, self.comment, self.header, self.inline = text, comment, header, inline
        found = FUNCTION.match(text.rstrip(";").strip()) if "(" in text and not text.startswith(("typedef", "#")) else None
        self.name = found.group(2) if found else None
        self.type = re.sub(r"\bstatic\b|\binline\b|\bextern\b", "", found.group(1)).strip() if found else None
        self.arguments = found.group(3) if found else None

    def returns_pointer(self):
        return self.type.endswith("*")

    def hands_out(self):  # what is only lent is const
        return bool(re.search(r"(?<!const )struct \w+ ?\*\*\s?\w+(?!\w*\[)", self.arguments))

    def lends(self):
        return self.type.startswith("const") and self.returns_pointer() or \
            bool(re.search(r"const struct \w+ ?\*\*\s?\w+", self.arguments))


def prose(comment):
    """A comment's text in one piece; paragraphs stay apart."""
    text = re.sub(r"^/\*+\s?|\s*\*+/$", "", comment.strip())
    lines = [re.sub(r"^\s*\*( |$)", "", line).rstrip() for line in text.split("\n")]
    return "\n".join(lines)


def braces_end(text, at):
    depth = 0
    while at < len(text):
        depth += (text[at] == "{") - (text[at] == "}")
        at += 1
        if depth == 0:
            return at
    return at


def words(text):
    return " ".join(text.split())


class Header:
    def __init__(self, root, path):
        self.path = path
        self.name = path.rpartition("/")[2]
        text = (root / path).read_text(encoding="utf-8")
        head = COMMENT.search(text)
        self.head = prose(head.group())
        self.declarations = []
        self.scan(re.sub(r"\\\n", " ", text[head.end():]))

    def scan(self, text):
        text = re.sub(r"^#ifdef __cplusplus\n.*?^#endif$", "#", text, flags=re.MULTILINE | re.DOTALL)
        text = re.sub(r"^[ \t]*#.*$", "#", text, flags=re.MULTILINE)
        at, comment = 0, None
        while at < len(text):
            if text[at] in "#":
                comment, at = None, at + 1
            elif text[at] == "\n":
                if re.match(r"\n[ \t]*\n", text[at:]):
                    comment = None
                at += 1
            elif text[at].isspace():
                at += 1
            elif text.startswith("/*", at):
                found = COMMENT.match(text, at)
                comment = prose(found.group())
                at = found.end()
                if re.match(r"---|====", comment.strip()):
                    comment = None
            elif text.startswith("//", at):
                at = text.find("\n", at)
            else:
                at, comment = self.declaration(text, at, comment)

    def declaration(self, text, at, comment):
        begin, inline = at, False
        while at < len(text) and text[at] != ";":
            if text.startswith("/*", at):
                at = COMMENT.match(text, at).end()
            elif text[at] == "{":
                before = COMMENT.sub("", text[begin:at]).strip()
                end = braces_end(text, at)
                if before.endswith(")"):  # an inline function
                    inline, at = True, end
                    break
                at = end
            else:
                at += 1
        source = text[begin:at]
        if not inline:
            at += 1
        beside = re.match(r"[ \t]*(/\*.*?\*/)", text[at:], re.DOTALL)
        own = comment
        if beside:
            own = (comment + "\n\n" if comment else "") + prose(beside.group(1))
            at += beside.end()
        if inline:
            source = source[:source.index("{")]
            shown = words(COMMENT.sub("", source))
        else:
            shown = source
        plain = words(COMMENT.sub("", source)) if "{" not in source else source
        self.declarations.append(Declaration(plain if inline or "{" not in source else shown, own or "", self, inline))
        return at, comment

    def functions(self):
        return [d for d in self.declarations if d.name]

    def label(self, label):
        """What the head says of it: a paragraph that begins so."""
        for paragraph in re.split(r"\n\s*\n", self.head):
            paragraph = words(paragraph)
            for part in re.split(r"(?<=\.) (?=(?:Errors|Ownership|Threads)(?:(?:, | and )\w+)*:)", paragraph):
                found = re.match(r"([\w, ]+):", part)
                if found and label.lower() in re.split(r", | and ", found.group(1).lower()):
                    return part[found.end():].strip()
        return None


class Library:
    def __init__(self, root, title, headers):
        self.title = title
        self.headers = [Header(root, path) for path in headers]
        self.by_name = {header.name: header for header in self.headers}
        self.functions = {f.name: f for header in self.headers for f in header.functions()}

    def head_says(self, header, label, seen=()):
        said = header.label(label)
        other = re.match(r"as (\w+\.h)\b(?: says)?", said) if said else None
        if other and other.group(1) in self.by_name and other.group(1) not in seen:
            there = self.head_says(self.by_name[other.group(1)], label, seen + (header.name,))
            rest = said[other.end():].lstrip(" .;,:")
            return (there + (" " + rest if rest else "")) if there else None
        return None if other else said

    def own(self, function, label):
        """The sentences after the label in the function's comment, to the next label or paragraph."""
        text = words(function.comment)
        found = re.search(r"\b%s: (.*?)(?= (?:Errors|Owns|Threads): |$)" % label, text)
        return found.group(1).strip() if found else None

    def problems(self, function):
        comment = words(function.comment)
        found = []
        errors = self.own(function, "Errors")
        if re.match(r"(?:const )?enum \w+_status$", function.type) and not errors:
            found.append("returns a status, and does not say which errors (`Errors:`)")
        named = re.match(r"as (\w+)\(\)", errors or "")
        if named and named.group(1) not in self.functions:
            found.append("has the errors of %s(), which is in no public header" % named.group(1))
        if function.type == "bool" and not re.search(r"\b[Ff]alse\b|\b[Ww]hether\b|\b[Tt]rue\b", comment):
            found.append("returns a bool, and does not say when it is false")
        if function.returns_pointer() and "NULL" not in comment:
            found.append("returns a pointer, and does not say when it is NULL")
        if (function.hands_out() or function.returns_pointer() and "const" not in function.type) and \
                not self.own(function, "Owns"):
            found.append("hands something out, and does not say who owns it (`Owns:`)")
        if function.lends() and not re.search(r"\bvalid\b|\bOwns:", comment):
            found.append("lends something, and does not say how long it is valid")
        if not comment:
            found.append("has no comment")
        return found

    def check(self):
        wrong = []
        for header in self.headers:
            for label in ("Errors", "Ownership", "Threads") if header.functions() or header.path.endswith(".in") else ():
                if not self.head_says(header, label):
                    wrong.append("%s: its head does not say `%s:`" % (header.path, label))
            wrong += ["%s: %s() %s" % (header.path, f.name, problem) for f in header.functions() for problem in self.problems(f)]
        return wrong

    def told(self, function):
        """Errors, ownership and threads of a function, from its comment, its type and the header's head."""
        errors = self.own(function, "Errors")
        if function.type == "void":
            errors = "none"
        elif not errors:
            comment = words(function.comment)
            if function.type == "bool" or function.returns_pointer():
                errors = "by what it returns; see above"
            elif re.search(r"\b(?:NULL|-1|0|NaN): ", comment):
                errors = "by its number; see above"
            else:
                errors = "none"
        owns = self.own(function, "Owns") or self.head_says(function.header, "Ownership")
        return errors, owns, self.own(function, "Threads") or self.head_says(function.header, "Threads")

    def reference(self):
        out = ["# %s: the C interface" % self.title, "",
               "Made from the comments of the headers. What a header says of errors, ownership and threads holds for each of its "
               "functions that says nothing else.", ""]
        out += ["- [%s](#%s)" % (header.name, header.name.replace(".", "")) for header in self.headers]
        for header in self.headers:
            out += ["", "## %s" % header.name, "", "`%s`" % header.path, ""] + markdown(header.head)
            group = None
            for d in header.declarations:
                if d.comment != group or not d.comment:
                    group = d.comment
                    out += [""] + markdown(d.comment)
                out += ["", "```c", signature(d), "```"]
                if d.name:
                    out += ["", "| errors | ownership | threads |", "|---|---|---|",
                            "| %s |" % " | ".join((t or "").replace("|", "\\|") for t in self.told(d))]
        return "\n".join(out).rstrip() + "\n"


def signature(d):
    return d.text.strip() if "{" in d.text else words(d.text).rstrip(";") + ";"


def markdown(text):
    """A comment as Markdown: what is indented stays as it is."""
    out, code = [], False
    for line in text.split("\n"):
        indented = line.startswith("    ")
        if indented and not code and out and out[-1]:
            out.append("")
        code = indented
        out.append(line if indented else re.sub(r"([*_<])", r"\\\1", line.strip()))
    return out


def libraries(root):
    found, current = {}, None
    for line in (pathlib.Path(__file__).parent / "headers.txt").read_text(encoding="utf-8").splitlines():
        line = line.partition("#")[0].strip()
        if line.startswith("library "):
            name, _, title = line[len("library "):].partition(": ")
            current = found[name] = (title, [])
        elif line:
            current[1].append(line)
    return {name: Library(root, title, headers) for name, (title, headers) in found.items()}


def main():
    root = pathlib.Path(sys.argv[1])
    every = libraries(root)
    if sys.argv[2] == "--check":
        wrong = [problem for library in every.values() for problem in library.check()]
        print("\n".join(wrong))
        print("%d functions in %d headers, %d wrong" % (sum(len(l.functions) for l in every.values()),
                                                       sum(len(l.headers) for l in every.values()), len(wrong)))
        return 1 if wrong else 0
    library = every[sys.argv[2]]
    pathlib.Path(sys.argv[3]).write_text(library.reference(), encoding="utf-8")
    if len(sys.argv) > 4:
        needs = [str(root / header.path) for header in library.headers]
        pathlib.Path(sys.argv[4]).write_text("%s: %s\n" % (sys.argv[3], " ".join(needs)), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
