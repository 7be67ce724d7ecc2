"""layers.py ROOT [TABLE] [--rows]: checks the arrows between folders, circles of files, lengths, namesakes and the tour.

Reads TABLE (tests/layers/layers.txt under ROOT), whose head explains the rows, and every C file under ROOT. Prints one line for
each offence that no row of the table excuses, and for each excuse that is no longer needed; ends with 1 if there was one. Where
there is a docs/tour.md, it must name each folder of the table.
--rows prints the offences as rows of the table instead.

C is read as text, in the shape that clang-format gives it here: a function's braces stand alone in the first column. A file
uses another one if it names a function or a variable with external linkage that the other one defines. Names after `.` and
`->` are members; a local variable's name counts, so it should not be that of a function elsewhere. In a header the bodies of
inline functions and macros count, the prototypes do not. An inline function may call a function that its header declares and
its folder defines: the two are halves of one, of which the first is compiled into callers. What macros define is not seen, but for the prefixes that the table
lists (`names`).
"""
import bisect
import collections
import pathlib
import re
import sys

FILE_LINES = 600
FUNCTION_LINES = 70
COMMENT_COLUMNS = 96
SUFFIXES = (".c", ".h", ".cl")

NOT_CODE = re.compile(r"""//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'""", re.DOTALL)
DRAWN = re.compile(r"^[^/]*(?:/\*|\*) {2,}|[^\s.:;?!)] {2,}(?!\*/)\S")  # code, a drawing or columns within a comment
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*["<]([^">\n]+)[">]', re.MULTILINE)
DIRECTIVE = re.compile(r"^[ \t]*#(?:\\\n|[^\n])*", re.MULTILINE)
MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)(?:\([^)]*\))?((?:\\\n|[^\n])*)", re.MULTILINE)
STATIC_MACRO = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)[ \t]+static\b", re.MULTILINE)
ATTRIBUTE = re.compile(r"__attribute__\s*\(\((?:[^()]|\([^()]*\))*\)\)")
EXTERN = re.compile(r"^extern\b[^;({]*;", re.MULTILINE)
NESTED = re.compile(r"\{[^{}]*\}")
ARGUMENTS = re.compile(r"\([^()]+\)")
TOUR_LINE = re.compile(r"^ {4}([a-z][\w/]*)/(?: |$)", re.MULTILINE)
KEYWORDS = {"void", "int", "char", "float", "double", "return", "sizeof"}
OPENERS = re.compile(r"\b((?:fopen|freopen)(?:64)?|fopencookie|open(?:at)?(?:64)?|openat2|creat(?:64)?|mk(?:d|s|os)temps?(?:64)?"
                     r"|mkostemps|tmpfile(?:64)?|tempnam|tmpnam|memfd_create|shm_open|FT_New_Face)\s*\(")
SAYERS = re.compile(r"\b(?:(?:v?fprintf|v?dprintf|write)\s*\(\s*(?:stderr|STDERR_FILENO)\b|perror\s*\("
                    r"|(?:fput[sc]|putc|fwrite)\s*\([^;]*?,\s*stderr\s*\))")
CALLED = re.compile(r"\b([A-Za-z_]\w*)\s*\(")
PROTOTYPE = re.compile(r"\b([A-Za-z_]\w*)\s*\([^;{}]*\)\s*;")
VARIABLE = re.compile(r"\b([A-Za-z_]\w*)(?:\[[^\]\n]*\])*\s*[=,;]")
WORD = re.compile(r"(?<![\w.])(?<!->)(?<!struct )(?<!enum )(?<!union )[A-Za-z_]\w*")


class TableError(Exception):
    """A wrong row of the table."""


class Table:
    """The rows of layers.txt."""

    KINDS = {"include": 2, "call": 2, "opens": 2, "says": 1, "circle": 1, "length": (1, 2), "namesake": 1}

    def __init__(self, text, name):
        self.name = name
        self.folders = {}   # folder -> words of its row
        self.headers = {}   # a generated header -> its folder
        self.prefixes = {}  # of functions that macros define -> folder
        self.doors = []     # headers, or folders of headers, that outsiders call through
        self.only = {}      # beginning of an outside header's name -> folders that may include it
        self.opens = {}     # (file, function that opens files) -> line of the row
        self.says = {}      # (file,) that prints errors itself -> line of the row
        self.flat = {}      # (file,) or (file, function) -> line of the row
        self.known = {}     # an offence -> line of the row
        for number, line in enumerate(text.splitlines(), 1):
            words = line.split("#", 1)[0].split()
            if words:
                try:
                    self.row(words, number)
                except TableError as error:
                    raise TableError("%s:%d: %s" % (name, number, error)) from None
        self.reached = {folder: self.reach(folder) for folder in self.folders}

    def row(self, words, number):
        kind, rest = words[0], words[1:]
        if kind in ("folder", "header", "names", "only"):
            if not rest or not rest[0].endswith(":"):
                raise TableError("'%s' wants NAME: FOLDER..." % kind)
            name, folders = rest[0][:-1], rest[1:]
            rows = {"folder": self.folders, "header": self.headers, "names": self.prefixes, "only": self.only}[kind]
            if name in rows:
                raise TableError("a second row for %s" % name)
            if kind in ("header", "names") and len(folders) != 1:
                raise TableError("'%s' wants one folder" % kind)
            rows[name] = folders[0] if kind in ("header", "names") else folders
        elif kind == "door":
            if len(rest) != 1:
                raise TableError("'door' wants FOLDER or HEADER")
            self.doors.append(rest[0])
        elif kind == "table":
            if len(rest) not in (1, 2):
                raise TableError("'table' wants FILE [FUNCTION]")
            self.flat[tuple(rest)] = number
        elif kind == "opens":
            if len(rest) < 3:
                raise TableError("'opens' wants FILE FUNCTION and the reason")
            self.opens[tuple(rest[:2])] = number
        elif kind == "says":
            if len(rest) < 2:
                raise TableError("'says' wants FILE and the reason")
            self.says[tuple(rest[:1])] = number
        elif kind == "offends":
            what = rest[0] if rest else ""
            count = self.KINDS.get(what)
            if count is None:
                raise TableError("'offends' wants one of %s" % ", ".join(sorted(self.KINDS)))
            if len(rest) - 1 not in (count if isinstance(count, tuple) else (count,)):
                raise TableError("'offends %s' wants %s words" % (what, count))
            if tuple(rest) in self.known:
                raise TableError("a second row for the same offence")
            self.known[tuple(rest)] = number
        else:
            raise TableError("unknown row '%s' (folder, door, header, names, only, table, opens, says, offends)" % kind)

    def reach(self, folder, way=()):
        """The folders that a folder may use; None: all."""
        if folder in way:
            raise TableError("%s: arrows in a circle: %s" % (self.name, " -> ".join(way + (folder,))))
        found = {folder}
        for word in self.folders[folder]:
            if word == "*":
                return None
            below = word.rstrip("+")
            if below not in self.folders:
                raise TableError("%s: %s may use %s, which has no row" % (self.name, folder, below))
            deep = self.reach(below, way + (folder,))  # always, to find circles
            found.add(below)
            if word.endswith("+"):
                if deep is None:
                    return None
                found |= deep
        return found

    def folder_of(self, path):
        """The row of a file: its own, its folder's, or NAME/* of a folder above it; None if there is none."""
        if path in self.folders:
            return path
        parent = path.rpartition("/")[0]
        if parent in self.folders:
            return parent
        while parent:
            if parent + "/*" in self.folders:
                return parent + "/*"
            parent = parent.rpartition("/")[0]
        return None

    def may_use(self, folder, other):
        reached = self.reached[folder]
        return reached is None or other in reached


class File:
    """What a C file includes, defines and names."""

    def __init__(self, path, text, static=re.compile(r"\bstatic\b")):
        self.path = path
        self.static = static  # finds the word, or a macro that begins with it
        self.folder = path.rpartition("/")[0]
        self.includes = [(match.group(1), text.count("\n", 0, match.start(1)) + 1) for match in INCLUDE.finditer(text)]
        self.code = NOT_CODE.sub(lambda match: "\n" * match.group().count("\n") or " ", text)
        bare = DIRECTIVE.sub(lambda match: "\n" * match.group().count("\n"), self.code)
        self.lines = text.count("\n")
        self.wide = wide_comments(text)
        macros = MACRO.findall(self.code)
        self.functions = []  # (name, first line, last line, static)
        self.bodies(bare.split("\n"))
        self.external = {name for name, _, _, static in self.functions if not static}
        self.own = {name for name, _, _, _ in self.functions}
        lines = bare.split("\n")
        self.declared = set()  # by a header's prototypes
        if path.endswith(".c"):
            for _, first, last, _ in self.functions:
                lines[first - 1:last] = [""] * (last - first + 1)
            self.variables = variables("\n".join(lines))
            used = self.code
        else:
            self.promised = {name for text in EXTERN.findall(bare) for name in VARIABLE.findall(text)}
            outside = list(lines)
            for _, first, last, _ in self.functions:
                outside[first - 1:last] = [""] * (last - first + 1)
            self.declared = set(PROTOTYPE.findall("\n".join(outside)))
            used = "\n".join("\n".join(lines[first:last]) for _, first, last, _ in self.functions)
            used += "\n".join(body for _, body in macros)
        self.names = set(WORD.findall(used))

    def bodies(self, lines):
        opening = [number for number, line in enumerate(lines) if line.rstrip() == "{"]
        closing = [number for number, line in enumerate(lines) if line.startswith("}")]
        for open_line in opening:
            first = self.signature(lines, open_line)
            head = ATTRIBUTE.sub(" ", "\n".join(lines[first:open_line]))
            name = next((match for match in CALLED.finditer(head)
                         if match.group(1) not in KEYWORDS and not match.group(1).isupper()), None)  # no macro
            after = bisect.bisect(closing, open_line)
            if name and after < len(closing):
                static = bool(self.static.search(head, 0, name.start()))
                self.functions.append((name.group(1), first + 1, closing[after] + 1, static))

    @staticmethod
    def signature(lines, open_line):
        """The first line of the definition above a brace, including the parameters' declarations in K&R style."""
        first = open_line
        while first > 0:
            line = lines[first - 1].rstrip()
            old_style = line.endswith(";") and first > 1 and re.match(r"^[\w \t*]+[ (,;)\w*\[\]]*;$", line) \
                and not re.match(r"^(static|extern|typedef|struct \w+;|#)", line) \
                and re.search(r"\)\s*$|;\s*$", lines[first - 2].rstrip() or " ")
            if not line or line.startswith("}") or (line.endswith(";") and not old_style):
                break
            first -= 1
        return first

    def line_of(self, name):
        match = next((match for match in WORD.finditer(self.code) if match.group() == name), None)
        return self.code.count("\n", 0, match.start()) + 1 if match else 1


def variables(text):
    """The names of the non-static variables that a text without functions defines."""
    while text != (text := NESTED.sub(" ", ARGUMENTS.sub("()", text))):
        pass
    found = set()
    for statement in text.split(";"):
        statement = statement.lstrip() + ";"
        if re.match(r"(?!static\b|extern\b|typedef\b)[A-Za-z]", statement):
            found |= set(VARIABLE.findall(re.sub(r"=[^,;]*", "=", statement)))
    return found


class House:
    """All files, and the offences between them."""

    def __init__(self, root, table):
        self.table = table
        self.offences = {}  # as in the table's rows, without `offends` -> what to print
        self.problems = []  # what no row can excuse
        self.files = {}
        texts = {path: (root / path).read_text(encoding="utf-8", errors="replace") for path in sorted(self.paths(root))}
        hidden = {name for text in texts.values() for name in STATIC_MACRO.findall(text)}
        static = re.compile(r"\b(?:%s)\b" % "|".join(["static"] + sorted(hidden)))
        for path, text in texts.items():
            self.files[path] = File(path, text, static)
        tour = root / "docs/tour.md"
        self.tour = tour.read_text(encoding="utf-8") if tour.exists() else None
        self.find_variables()
        self.row_of = {path: table.folder_of(path) for path in self.files}
        self.by_name = collections.defaultdict(list)  # header's file name -> paths
        for path in self.files:
            self.by_name[path.rpartition("/")[2]].append(path)
        self.definers = collections.defaultdict(list)
        for path, file in self.files.items():
            row = self.row_of[path]
            if path.endswith(".cl") or not row or table.reached[row] is None:
                continue  # text for the device; tests and examples, which are programs of their own
            for name in file.external:
                self.definers[name].append(path)
            if path.endswith(".h"):
                for name in file.own - file.external:  # inline functions
                    self.definers[name].append(path)
        self.shown = collections.defaultdict(set)  # a name that a door declares -> doors
        for door in table.doors:
            found = [file for path, file in self.files.items() if path.endswith(".h") and door in (path, file.folder)]
            if not found:
                self.problems.append("%s: door %s is no header and no folder with one" % (table.name, door))
            for file in found:
                for name in CALLED.findall(file.code) + sorted(file.promised):
                    self.shown[name].add((door, self.row_of[file.path]))
        self.edges = collections.defaultdict(set)
        self.seen = {}  # file -> the project's headers that it includes, directly or not

    def find_variables(self):
        """Finds variables with external linkage: those outside functions that a header declares `extern`."""
        promised = {name for file in self.files.values() if not file.path.endswith(".c") for name in file.promised}
        for file in self.files.values():
            if file.path.endswith(".c"):
                file.own |= file.variables
                file.external |= file.variables & promised

    def headers_of(self, path):
        if path not in self.seen:
            self.seen[path] = set()
            for name, _ in self.files[path].includes:
                for header in self.headers_named(self.files[path], name):
                    if header not in self.seen[path]:
                        self.seen[path] |= {header} | self.headers_of(header)
        return self.seen[path]

    def paths(self, root):
        """All C files below the root, except in build folders and in names that begin with a dot."""
        for top in root.iterdir():
            if top.is_dir() and not re.match(r"\.|build", top.name) and not (top / "meson-private").exists():
                for path in top.rglob("*"):
                    if path.suffix in SUFFIXES:
                        yield path.relative_to(root).as_posix()

    def check(self):
        for path in self.files:
            if self.row_of[path] is None:
                self.problems.append("%s: its folder has no row in %s" % (path, self.table.name))
        for folder in self.table.folders:
            if folder not in self.row_of.values():
                self.problems.append("%s: folder %s has a row, but no file" % (self.table.name, folder))
        placed = [file for path, file in self.files.items() if self.row_of[path]]
        for file in placed:
            self.check_includes(file)
            self.check_uses(file)
            self.check_lengths(file)
            self.check_opens(file)
            self.check_says(file)
            self.check_inline(file)
        self.check_circles()
        self.check_namesakes()
        if self.tour is not None:
            self.check_tour()
        for row, number in self.table.flat.items():
            if ("length",) + row not in self.offences:
                self.problems.append("%s:%d: 'table %s' is short or gone: remove the row"
                                     % (self.table.name, number, " ".join(row)))
            self.offences.pop(("length",) + row, None)
        for kind, rows in (("opens", self.table.opens), ("says", self.table.says)):
            for row, number in rows.items():
                if (kind,) + row not in self.offences:
                    self.problems.append("%s:%d: '%s %s' %s nothing, or is gone: remove the row"
                                         % (self.table.name, number, kind, " ".join(row), kind))
                self.offences.pop((kind,) + row, None)
        for row, number in self.table.known.items():
            if row not in self.offences:
                self.problems.append("%s:%d: 'offends %s' offends no longer: remove the row"
                                     % (self.table.name, number, " ".join(row)))

    def check_tour(self):
        """Checks that the tour names each folder, by its path or as a line `    name/` of a list, and lists no others."""
        listed = set(TOUR_LINE.findall(self.tour))
        for folder in self.table.folders:
            name = folder[:-2] if folder.endswith("/*") else folder
            if name in self.files or re.search(r"(?<![\w/])%s(?![\w/]*\w)" % re.escape(name), self.tour):
                continue
            if name.rpartition("/")[2] not in listed:
                self.problems.append("docs/tour.md: says nothing of %s" % name)
        folders = {part for path in self.files for part in above(path)}
        for name in sorted(listed):
            if not any(folder == name or folder.endswith("/" + name) for folder in folders):
                self.problems.append("docs/tour.md: lists %s/, where no C file is" % name)

    def offend(self, row, file, line, text):
        self.offences.setdefault(row, "%s:%d: %s" % (file.path, line, text))

    def check_includes(self, file):
        row = self.row_of[file.path]
        for name, line in file.includes:
            outside = [start for start in self.table.only if name.startswith(start)]
            able = self.table.only[max(outside, key=len)] if outside else None
            if outside and row not in able and self.table.reached[row] is not None:
                self.offend(("include", file.path, name), file, line,
                            "includes <%s>, which only %s may" % (name, ", ".join(able) or "nobody"))
            if name in self.table.headers:
                others = [(self.table.headers[name], name)]
            else:
                others = [(self.row_of[path], path) for path in self.headers_named(file, name) if self.row_of[path]]
            if others and not any(self.table.may_use(row, other) for other, _ in others):
                self.offend(("include", file.path, name), file, line,
                            "includes %s of %s, which %s may not use" % (name, others[0][0], row))
            for _, path in others:
                if len(others) == 1 and path in self.files and file.path.endswith(".h"):
                    self.edges[file.path].add(path)

    def headers_named(self, file, name):
        """The project's headers that an include may mean: beside the file, else in the nearest folder above it, else all."""
        folder = file.folder
        while True:
            parts = (folder + "/" + name).lstrip("/").split("/")
            while ".." in parts[1:]:
                at = parts.index("..", 1)
                del parts[at - 1:at + 1]
            if "/".join(parts) in self.files:
                return ["/".join(parts)]
            if not folder:
                break
            folder = folder.rpartition("/")[0]
        tail = re.sub(r"^(\.\./)+", "", name)
        return [path for path in self.by_name[tail.rpartition("/")[2]] if ("/" + path).endswith("/" + tail)]

    def check_uses(self, file):
        row = self.row_of[file.path]
        for name in file.names if not file.path.endswith(".cl") else ():
            if name in file.own:
                continue
            places = [path for path in self.definers.get(name, ())
                      if path.endswith(".c") or path in self.headers_of(file.path)]
            if places:
                beside = [path for path in places if self.row_of[path] == row]
                self.use(file, row, name, beside or places)
            for prefix, folder in self.table.prefixes.items():
                if name.startswith(prefix) and not self.table.may_use(row, folder):
                    self.offend(("call", file.path, name), file, file.line_of(name),
                                "names %s of %s, which %s may not use" % (name, folder, row))

    def use(self, file, row, name, places):
        allowed = [path for path in places if self.row_of[path] and self.table.may_use(row, self.row_of[path])]
        for door, door_row in self.shown[name]:
            house = door.rpartition("/")[0] if door.endswith(".h") else door
            if not file.path.startswith(house + "/") and self.table.may_use(row, door_row):
                allowed = places
        if allowed:
            for path in allowed:
                half = name in file.declared and self.row_of[path] == row
                if path != file.path and not half:
                    self.edges[file.path].add(path)
        else:
            self.offend(("call", file.path, name), file, file.line_of(name),
                        "uses %s of %s, and %s may not use %s" % (name, places[0], row, self.row_of[places[0]]))

    def check_lengths(self, file):
        if file.lines > FILE_LINES:
            self.offend(("length", file.path), file, file.lines, "%d lines; at most %d" % (file.lines, FILE_LINES))
        for name, first, last, _ in file.functions:
            if last - first + 1 > FUNCTION_LINES:
                self.offend(("length", file.path, name), file, first,
                            "%s() has %d lines; at most %d" % (name, last - first + 1, FUNCTION_LINES))

        if file.wide:
            self.offend(("length", file.path, "comment"), file, file.wide[0],
                        "a comment wider than %d columns" % COMMENT_COLUMNS)

    def check_opens(self, file):
        """Files are opened by the few functions that the rows `opens` name; not so in tests and examples, programs of their own."""
        if self.table.reached[self.row_of[file.path]] is None or file.path.endswith(".cl"):
            return
        for match in OPENERS.finditer(file.code):
            if file.code[:match.start()].endswith((".", "->")):
                continue  # a member
            self.offend(("opens", file.path, match.group(1)), file, file.code.count("\n", 0, match.start()) + 1,
                        "calls %s(): files are read by input_file.h, and written by output_file.h and growing_file.h" % match.group(1))

    def check_says(self, file):
        """Errors are printed by one function, which lets no escape through, and by the files that the rows `says` name."""
        match = re.search("stderr|STDERR_FILENO|perror", file.code) and SAYERS.search(file.code)
        if match and self.table.reached[self.row_of[file.path]] is not None and not file.path.endswith(".cl"):
            self.offend(("says", file.path), file, file.code.count("\n", 0, match.start()) + 1,
                        "prints on the standard error itself: visible_say() does, without escapes")

    def check_inline(self, file):
        """In C's sense an inline function that is not static is defined elsewhere, too: drivers that do not inline it miss it."""
        match = file.path.endswith(".cl") and re.search(r"(?<!static )\binline\b", file.code)
        if match:
            self.offend(("inline", file.path), file, file.code.count("\n", 0, match.start()) + 1,
                        "an inline function that is not static: not all drivers would find it")

    def check_circles(self):
        """Each file in a circle of uses is an offence: finds strongly connected components of several files by Tarjan's algorithm."""
        for part in strong_parts(self.edges):
            if len(part) > 1:
                for path in part:
                    self.offend(("circle", path), self.files[path], 1, "is in a circle of %d files: %s"
                                % (len(part), " ".join(self.way_round(path, part))))

    def way_round(self, start, part):
        """The shortest path of uses from a file back to itself."""
        before = {}
        queue = collections.deque([start])
        while queue:
            here = queue.popleft()
            for there in sorted(self.edges[here] & part):
                if there == start:
                    way = [start]
                    while here != start:
                        way.append(here)
                        here = before[here]
                    return way + [start] if len(way) == 1 else [start] + way[:0:-1] + [start]
                if there not in before:
                    before[there] = here
                    queue.append(there)
        return [start]

    def check_namesakes(self):
        """Finds names with external linkage that two folders define."""
        for name, paths in self.definers.items():
            places = {}
            for path in paths:
                if path.endswith(".c") and name in self.files[path].external and name != "main":
                    places.setdefault(self.row_of[path], path)
            if len(places) > 1:
                path = sorted(places.values())[0]
                self.offend(("namesake", name), self.files[path], self.files[path].line_of(name),
                            "%s is defined in %s" % (name, " and ".join(sorted(places.values()))))


def wide_comments(text):
    """The numbers of lines on which a comment's words go beyond COMMENT_COLUMNS; drawings, tables and code may."""
    lines, wide = text.split("\n"), []
    for match in NOT_CODE.finditer(text):
        if not match.group().startswith("/"):
            continue
        first = text.count("\n", 0, match.start())
        for number in range(first, first + match.group().count("\n") + 1):
            line = lines[number]
            if len(line) > COMMENT_COLUMNS and not line.endswith("\\") and not DRAWN.search(line):
                wide.append(number + 1)
    return wide


def above(path):
    """The folders that a file is in."""
    while "/" in path:
        path = path.rpartition("/")[0]
        yield path


def strong_parts(edges):
    """Tarjan's strongly connected components, without recursion."""
    index, low, stack, on, parts = {}, {}, [], set(), []
    for root in sorted(edges):
        if root in index:
            continue
        work = [(root, iter(sorted(edges.get(root, ()))))]
        index[root] = low[root] = len(index)
        stack.append(root)
        on.add(root)
        while work:
            node, rest = work[-1]
            for other in rest:
                if other not in index:
                    index[other] = low[other] = len(index)
                    stack.append(other)
                    on.add(other)
                    work.append((other, iter(sorted(edges.get(other, ())))))
                    break
                if other in on:
                    low[node] = min(low[node], index[other])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    part = set()
                    while not part or node not in part:
                        part.add(stack.pop())
                    on -= part
                    parts.append(part)
    return parts


def main(words):
    rows = "--rows" in words
    words = [word for word in words if word != "--rows"]
    if len(words) not in (1, 2):
        print(__doc__.split("\n")[0], file=sys.stderr)
        return 2
    root = pathlib.Path(words[0])
    table_path = pathlib.Path(words[1]) if len(words) == 2 else root / "tests/layers/layers.txt"
    try:
        name = table_path.relative_to(root).as_posix() if table_path.is_relative_to(root) else str(table_path)
        house = House(root, Table(table_path.read_text(encoding="utf-8"), name))
    except (TableError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    house.check()
    if rows:
        for row in sorted(house.offences):
            print("offends " + " ".join(row))
        return 0
    found = house.problems + [text for row, text in sorted(house.offences.items()) if row not in house.table.known]
    for line in found:
        print(line)
    print("%d files, %d folders, %d known offenders, %d wrong"
          % (len(house.files), len(house.table.folders), len(house.table.known), len(found)))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
