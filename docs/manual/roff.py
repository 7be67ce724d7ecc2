"""roff.py - writes manual pages: escapes, sections, and a Markdown like that of docs/ turned into macros of man(7)."""
import re

BOLD, ITALIC, ROMAN = "\\fB", "\\fI", "\\fR"


def literal(text):
    """Text that is shown as it is: what is typed."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("`", "\\(ga").replace("^", "\\(ha")
    return text.replace("~", "\\(ti")


def prose(text):
    """Running text: `code`, **bold**, *slanted*, [text](address), --options and pages(1) are marked."""
    pieces = []

    def keep(marked):
        pieces.append(marked)
        return f"\0{len(pieces) - 1}\0"
    text = re.sub(r"``(.+?)``|`(.+?)`", lambda m: keep(BOLD + literal(m.group(1) or m.group(2)) + ROMAN), text)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"(?<![\w*])\*\*(\w(?:[^*]*\w)?)\*\*(?![\w*])", lambda m: keep(BOLD + m.group(1) + ROMAN), text)
    text = re.sub(r"(?<![\w-])--?[a-z][\w-]*", lambda m: keep(BOLD + literal(m.group()) + ROMAN), text)
    text = re.sub(r"\b([\w-]+)\(([1-8])\)", lambda m: keep(f"{BOLD}{literal(m.group(1))}{ROMAN}({m.group(2)})"), text)
    text = text.replace("\\", "\\e").replace("…", "...")
    text = re.sub(r"\0(\d+)\0", lambda m: pieces[int(m.group(1))], text)
    return "\\&" + text if text[:1] in (".", "'") else text


def sentence(text):
    """Begins with a capital letter, but for names of variables and libraries, and ends with a full stop."""
    text = text.strip()
    found = re.match(r"[a-z](?!\w* =|ibparis)", text)
    return (text[0].upper() if found else text[:1]) + text[1:] + ("" if text.endswith((".", ":")) else ".")


class Page:
    def __init__(self, name, section, edition, manual):
        self.name, self.section = name, section
        self.lines = [".\\\" Made from tables of Lutetia's source; changes belong there.",
                      f'.TH {name} {section} {edition.date} "Lutetia {edition.version}" "{manual}"', ".nh", ".ad l"]

    def add(self, *lines):
        self.lines += lines

    def section_begin(self, title):
        self.add(f'.SH "{title}"' if " " in title else f".SH {title}")

    def subsection(self, title):
        self.add(f'.SS "{prose(title)}"')

    def paragraph(self, text):
        if self.lines[-1].startswith((".SH", ".SS")):
            self.add(prose(text))
        else:
            self.add(".PP", prose(text))

    def item(self, term, *texts):
        """A term, marked already, and what it is."""
        self.add(".TP", term, prose(texts[0]))
        for text in texts[1:]:
            self.add(".IP", prose(text))

    def code(self, lines):
        if not self.lines[-1].startswith((".SH", ".SS")):
            self.add(".PP")
        self.add(".RS 4", ".nf")
        for line in lines:
            line = literal(line.rstrip())
            self.add("\\&" + line if line[:1] in (".", "'") or not line else line)
        self.add(".fi", ".RE")

    def see_also(self, names):
        self.section_begin("SEE ALSO")
        marked = [re.sub(r"(.*)\((.)\)", lambda m: f"{BOLD}{literal(m.group(1))}{ROMAN}({m.group(2)})", n) for n in names]
        self.add(", ".join(marked))

    def text(self):
        return "\n".join(self.lines) + "\n"


def cells(line):
    """The cells of a row of a table; a | in code does not end one."""
    out, inside, cell = [], False, ""
    for at, c in enumerate(line):
        if c == "`":
            inside = not inside
        if c == "|" and (not inside or line[at - 1] == "\\") and line[at - 1] != "\\":
            out.append(cell.strip())
            cell = ""
        else:
            cell += c
    out.append(cell.strip())
    return [c.replace("\\|", "|") for c in out[1:-1]]


def table(page, lines):
    """A row is an item: its first cell the term, the others with their heads before them."""
    heads, above = cells(lines[0]), []
    for line in lines[2:]:
        first, *others = cells(line)
        others = above = [above[i] if text == "〃" else text for i, text in enumerate(others)]
        texts = [f"{head}: {text}" if head else text for head, text in zip(heads[1:], others) if text]
        page.item(prose(first), "; ".join(texts) + "." if texts else "As its name says.")


def markdown(page, text):
    """Headings (# is left out, ## begins a section, ### a subsection), paragraphs, lists, tables, code."""
    lines = re.sub(r"<!--.*?-->\n?", "", text).splitlines()
    at = 0
    while at < len(lines):
        line, begin = lines[at], at
        at += 1
        if not line.strip() or line.startswith(("# ", "![")):
            continue
        if line.startswith("## "):
            page.section_begin(line[3:].upper())
        elif line.startswith("### "):
            page.subsection(line[4:])
        elif line.startswith("```"):
            while not lines[at].startswith("```"):
                at += 1
            page.code(lines[begin + 1:at])
            at += 1
        elif line.startswith("    "):
            while at < len(lines) and (lines[at].startswith("    ") or
                                       (not lines[at].strip() and lines[at + 1:at + 2] and lines[at + 1].startswith("    "))):
                at += 1
            page.code([code[4:] for code in lines[begin:at]])
        elif line.startswith("|"):
            while at < len(lines) and lines[at].startswith("|"):
                at += 1
            table(page, lines[begin:at])
        elif line.startswith("- "):
            while at < len(lines) and lines[at].startswith("  "):
                at += 1
            page.add(".IP \\(bu 2", prose(" ".join(l.strip() for l in lines[begin:at])[2:]))
        else:
            while at < len(lines) and lines[at].strip() and not lines[at].startswith(("#", "|", "- ", "```", "!")):
                at += 1
            page.paragraph(" ".join(l.strip() for l in lines[begin:at]))
