"""fuzz_files.py LUTETIA [SECONDS [SEED]]: terminals and files by chance.

Outputs of every verb and variable (verbs.py) are links, dangling links, pipes, sockets, devices, folders, other users' files in a folder
that all may write to, and names with escapes and line feeds; so for this user and, where root runs it, for another. What is read, what the
command line and the environment say, holds escapes. Whatever comes: nothing but regular files with the names given is written, none
appears half, nothing of anybody else's is changed, and no escape reaches the terminal, which is a real one here. (security.md 5, 11, 12, 21, 25, 26, 27)
"""
import os
import pathlib
import pty
import random
import re
import select
import shutil
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import time

import verbs

CASES = 24
SECONDS = 600  # of a busy machine
NOBODY, STRANGER = 65534, 12345
ESCAPES = ["\x1b]0;owned\x07", "\x1b[31mred\x1b[0m", "\x9b31m", "\u202eabc", "\x7f", "\x08\x08", "\x1b[2J", "\x1bP0;1|17/ab\x1b\\", "\u2028", "\u200f",
           "\r\x0b\x0c", "\x1b[?25l", "\x1b[K\x1b[1A"]
# What the command itself may send: a line that is drawn again, and the mark that a terminal's driver adds.
OWN = re.compile(rb"\r[^\r\n\x1b]*\x1b\[K|\r\n|\r")
BAD = re.compile(rb"[\x00-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\x8b-\x8f\xa8-\xae]|(?<![\xc0-\xff\x80-\xbf])[\x80-\xbf]")


class Place:
    """A folder that all may write to, as /tmp is, with this user's and others' things in it."""

    def __init__(self, lutetia, program, users, chance):
        self.lutetia, self.chance = lutetia, chance
        self.holder = tempfile.TemporaryDirectory(prefix="lutetia-fuzz-files-")
        self.top = pathlib.Path(self.holder.name)
        self.top.chmod(0o755)
        self.at = self.top / "open"
        self.at.mkdir()
        verbs.files_make(self.at)
        shutil.copy(program, self.at / "program")
        for name in ("cache", "tmp"):
            (self.top / name).mkdir()
            (self.top / name).chmod(0o777)
        self.user = chance.choice(users)
        if self.user == NOBODY:
            for path in [self.at, *self.at.rglob("*")]:
                os.chown(path, NOBODY, NOBODY)
            (self.top / "cache").chmod(0o700)
            os.chown(self.top / "cache", NOBODY, NOBODY)
            os.chown(self.at, 0, 0)
        self.at.chmod(0o1777)
        (self.at / "precious").write_text("precious")
        (self.at / "precious folder").mkdir()
        (self.at / "precious folder/kept").write_text("kept")
        self.sockets = []

    def end(self):
        for each in self.sockets:
            each.close()
        self.holder.cleanup()

    def occupy(self, name):
        """Puts something by chance where an output is to be; returns what."""
        chance, path = self.chance, self.at / name
        kinds = ["nothing", "own", "link", "dangling", "device", "null", "folder", "link to folder", "pipe", "socket"]
        if os.geteuid() == 0:
            kinds += ["stranger's", "stranger's pipe", "stranger's link"]
        kind = chance.choice(kinds)
        path.parent.mkdir(exist_ok=True)
        if os.path.lexists(path):  # what the row reads; or two outputs have one name
            return "occupied"
        if kind in ("own", "stranger's"):
            path.write_text("before")
        elif kind in ("link", "stranger's link"):
            path.symlink_to(chance.choice((self.at / "precious", "precious")) if "/" not in name else self.at / "precious")
        elif kind == "dangling":
            path.symlink_to(self.at / "nowhere")
        elif kind == "device":
            path.symlink_to(chance.choice(("/dev/null", "/dev/full", "/dev/zero")))
        elif kind == "null" and os.geteuid() == 0:
            os.mknod(path, 0o666 | stat.S_IFCHR, os.makedev(1, 3))
        elif kind == "folder":
            path.mkdir()
        elif kind == "link to folder":
            path.symlink_to(self.at / "precious folder")
        elif kind in ("pipe", "stranger's pipe"):
            os.mkfifo(path, 0o666)
        elif kind == "socket":
            self.sockets.append(socket.socket(socket.AF_UNIX))
            here = os.open(path.parent, os.O_RDONLY)
            try:
                self.sockets[-1].bind("/proc/self/fd/%d/%s" % (here, path.name))
            except OSError:  # its name is too long
                kind = "nothing"
            os.close(here)
        if kind.startswith("stranger"):
            os.chown(path, STRANGER, STRANGER, follow_symlinks=False)
        elif kind != "nothing" and os.geteuid() == 0 and os.path.lexists(path):
            os.chown(path, self.user, self.user, follow_symlinks=False)
        return kind

    def look(self):
        found = {}
        for path in sorted(self.at.rglob("*")):
            about = os.lstat(path)
            if stat.S_ISLNK(about.st_mode):
                what = ("link", os.readlink(path))
            elif stat.S_ISREG(about.st_mode):
                what = ("file", path.read_bytes())
            else:
                what = ("other", stat.S_IFMT(about.st_mode))
            found[str(path.relative_to(self.at))] = (*what, about.st_uid)
        return found

    def run(self, words, variables):
        """Runs the command on a terminal of its own; returns its status and what it wrote there."""
        top, low = pty.openpty()

        def become():
            if self.user == NOBODY:
                os.setgroups([])
                os.setgid(NOBODY)
                os.setuid(NOBODY)
        environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY", "POCL_CACHE_DIR")}
        environment.update({"XDG_CACHE_HOME": str(self.top / "cache"), "TMPDIR": str(self.top / "tmp"), "HOME": str(self.top)})
        if self.user != NOBODY:
            environment["XDG_CACHE_HOME"] = os.environ.get("XDG_CACHE_HOME", os.path.expanduser("~/.cache"))
        environment.update(variables)
        line = [word.encode("utf-8", "surrogateescape") for word in words]
        child = subprocess.Popen(line, cwd=self.at, env=environment, stdin=subprocess.DEVNULL, stdout=low, stderr=low,
                                 start_new_session=True, preexec_fn=become)
        os.close(low)
        said, until, status = b"", time.monotonic() + SECONDS, None
        while time.monotonic() < until:
            if select.select([top], [], [], 0.2)[0]:
                try:
                    got = os.read(top, 65536)
                except OSError:
                    got = b""
                if not got:
                    break
                said += got
        else:
            os.killpg(child.pid, signal.SIGKILL)
            status = "no end"
        code = child.wait()
        os.close(top)
        return status or code, said


def escaped(said):
    """What reached the terminal that should not."""
    found = BAD.search(OWN.sub(b"", said))
    return found and said[max(0, said.find(found.group()) - 60):][:200]


# ---- outputs ----

def name_by_chance(chance, name):
    """The file's name, or one that is hard to bear, with the same ending."""
    stem, dot, end = name.rpartition(".")
    if name.endswith("/") or chance.random() < 0.6:
        return name
    text = chance.choice(ESCAPES + ["\n", "\nroot:x:0:0\n", "-rf", "--help", "%s%n", "a b", "é漢", "x" * 220, "\udcff\udcfe", "..", "'\"`$(id)"])
    text = text.replace("/", "|")
    folder, slash, stem = stem.rpartition("/") if dot else name.rpartition("/")
    return folder + slash + (stem + text if chance.random() < 0.7 and not text.startswith("-") else text + stem) + dot + (end if dot else "")


def output_case(place):
    chance = place.chance
    name, verb, _, files, words, variables = chance.choice([row for row in verbs.OUTPUTS if row[0] not in verbs.SLOW | {"bench"}])
    names = {file: name_by_chance(chance, file) for file in files}
    words = [names.get(word, word) for word in words]
    variables = {key: names.get(value, value) for key, value in variables.items()}
    kinds = {}
    for file in files:
        if not file.endswith("/") and (chance.random() < 0.6 or len(files) == 1):
            kinds[names[file]] = place.occupy(names[file])
        elif file.endswith("/") and chance.random() < 0.4:
            kinds[names[file][:-1]] = place.occupy(names[file][:-1])
    before = place.look()
    first = [] if words[0] == "./program" else [place.lutetia]
    status, said = place.run(first + words, variables)
    what = "%r as %d, %r with %r: status %s; it said %r" % (name, place.user, words, kinds, status, said[-600:])
    waits = any(kind == "pipe" for kind in kinds.values()) and variables  # a reader is waited for
    if status == "no end" and not waits:
        return what
    if escaped(said):
        return "an escape on the terminal: %r; %s" % (escaped(said), what)
    after = place.look()
    asked = [names[file] for file in files] + ["p.png", "run/", "made"]
    for path in sorted(before.keys() | after.keys()):
        if before.get(path) == after.get(path):
            continue
        old = before.get(path)
        ours = any(path == name or path.startswith(name.rstrip("/")) or name.startswith(path + "/") for name in asked)
        if path not in after:
            return "%s is gone; %s" % (path, what)
        if "link to folder" in kinds.values() and path.startswith("precious folder/") and path != "precious folder/kept":
            continue  # a folder may be named by a link to it
        if not ours and not path.endswith((".wav", ".d")) and not path.startswith(("pages/", "run/")):
            return "%s is written; %s" % (path, what)
        if old and old[0] != "file":
            return "%s was no file; %s" % (path, what)
        if old and old[2] == STRANGER and place.user == NOBODY:
            return "%s was a stranger's; %s" % (path, what)
        if path.endswith(".part") and status != "no end":
            return "%s stays; %s" % (path, what)
        if status not in (0, "no end") and old and old[:2] == ("file", b"before") and after[path][1] == b"":
            return "%s is empty; %s" % (path, what)
    return None


# ---- inputs, words and variables with escapes ----

def strewn(chance, data):
    """The data with escapes in it, at places by chance; more often behind a line's first word."""
    for _ in range(chance.randrange(1, 4)):
        escape = chance.choice(ESCAPES).encode()
        ends = [at for at, byte in enumerate(data[:4000]) if byte in b" \n=("]
        at = chance.choice(ends) if ends and chance.random() < 0.7 else chance.randrange(len(data) + 1)
        data = data[:at + 1] + escape + data[at + 1:]
    return data


SEEDS = [b"c4 A\nd4 B\n", b"gravity = 1\nmass 0 0 1 fixed\nspring 0 1\n", b"error('@')\n", b"function note(n) error('@') end\n", b"1\n00:00:00,000 --> 00:00:01,000\n@\n",
         b"background 0 0 0\nnonsense 1\n", b"<svg><path d='M0 0'/></svg>", b"session 1\nset gravity 1\n", b"box:2", verbs.SONG, verbs.LEDS, verbs.DISPLAY, b"\x89PNG\r\n\x1a\n",
         b"\x89HDF\r\n\x1a\n", b"#include <cm/paris.h>\nint main( {\n", b"print('@') warn('@') local t <const> = 1 t = 2\n", b"A text with @ in it.\n\n# Head @\n"]


def input_case(place):
    chance = place.chance
    _, option, words = chance.choice(verbs.INPUTS)
    data = strewn(chance, chance.choice(SEEDS).replace(b"@", chance.choice(ESCAPES).encode()))
    name = "in" + chance.choice(["", chance.choice(ESCAPES).replace("/", "_"), "\n"]) + chance.choice(["", ".lua", ".srt", ".png", ".mid", ".c"])
    if chance.random() < 0.9:
        (place.at / name).write_bytes(data)
        (place.at / name).chmod(0o644)  # not to be run, which `leds` and `explain` do
    words = [re.sub("@(?!@)", lambda _: "./" + name, word) for word in words]
    status, said = place.run([place.lutetia, *words], {})
    what = "%r as %d with %r: status %s" % (words, place.user, data[:300], status)
    compiles = words[0] == "cc" or any(word.endswith(".c") for word in words)
    if not compiles and escaped(said):  # a compiler says what it says, names among it
        return "an escape on the terminal: %r; %s" % (escaped(said), what)
    return what if status == "no end" or status not in (0, 1, 2) else None


def words_case(place):
    """Options and variables whose values are escapes."""
    chance = place.chance
    verb = chance.choice([row for row in verbs.OUTPUTS if row[0] not in verbs.SLOW | {"bench"}])
    words, variables = list(verb[4]), dict(verb[5])
    if chance.random() < 0.5 and place.options and words[0] != "./program":
        option = chance.choice([name for of, name in place.options if of == words[0]] or ["none"])
        words += ["--%s=%s" % (option, chance.choice(["", "1"]) + chance.choice(ESCAPES))]
    elif chance.random() < 0.5 and len(words) > 1:
        at = chance.randrange(1, len(words))
        words[at] += chance.choice(ESCAPES)
    else:
        variables[chance.choice(place.variables)] = chance.choice(["", "/no/such/", "1"]) + chance.choice(ESCAPES)
    status, said = place.run(([] if words[0] == "./program" else [place.lutetia]) + words, variables)
    what = "%r with %r as %d: status %s; it said %r" % (words, variables, place.user, status, said[-400:])
    if words[0] != "cc" and escaped(said):  # a compiler says what it says
        return "an escape on the terminal: %r; %s" % (escaped(said), what)
    return what if status == "no end" or status not in (0, 1, 2) else None


def table_of(lutetia):
    table = subprocess.run([lutetia, "help", "--table"], capture_output=True, text=True, check=True).stdout
    verb, options, variables = "", [], []
    for words in (line.split("\t") for line in table.splitlines()):
        verb = words[1] if words[0] == "verb" else verb
        if words[0] == "option" and verb:
            options.append((verb, words[1]))
        if words[0] == "environment":
            variables += [word for word in words[1:] if re.fullmatch("[A-Z_]{2,}", word)]
    skipped = {"LUTETIA_LEDS_PROGRAM", "LUTETIA_DISPLAY_PROGRAM", "LUTETIA_DISPLAY_ROOM", "DISPLAY", "TMPDIR", "XDG_CACHE_HOME", "POCL_CACHE_DIR", "CC"}  # of programs that are not ours
    return options, [name for name in variables if name not in skipped]


def users_of(lutetia):
    """Who may be the command's user: this one; root's also nobody, unless the command lies where only root may go."""
    if os.geteuid() != 0:
        return [os.geteuid()]
    try:
        subprocess.run([lutetia, "--version"], user=NOBODY, group=NOBODY, extra_groups=[], check=True, capture_output=True)
    except (PermissionError, subprocess.CalledProcessError):
        print("another user cannot run %s: all cases are root's" % lutetia)
        return [0]
    return [0, NOBODY]


def main():
    lutetia = os.path.abspath(sys.argv[1])
    users = users_of(lutetia)
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 0
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else (int(time.time()) if seconds else 6)
    chance = random.Random(seed)
    options, variables = table_of(lutetia)
    assert len(options) > 100 and len(variables) > 20, (len(options), len(variables))
    began, count, wrong = time.monotonic(), 0, 0
    with tempfile.TemporaryDirectory(prefix="lutetia-fuzz-program-") as folder:
        at = pathlib.Path(folder)
        (at / "prog.c").write_text(verbs.PROGRAM)
        subprocess.run([lutetia, "cc", "prog.c", "-o", "program"], cwd=at, check=True)
        while time.monotonic() - began < seconds if seconds else count < CASES:
            place = Place(lutetia, at / "program", users, chance)
            place.options, place.variables = options, variables
            try:
                found = (output_case, output_case, input_case, words_case)[count % 4](place)
            finally:
                place.end()
            count += 1
            if found:
                wrong += 1
                print("seed %d, case %d: %s" % (seed, count - 1, found), flush=True)
    print("seed %d: %d cases, %d wrong" % (seed, count, wrong))
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
