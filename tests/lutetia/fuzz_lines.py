"""fuzz_lines.py LUTETIA [SECONDS]: runs random command lines, made from the options that each verb's --help lists, with values that
are wrong, huge, empty, other files, or right. (security.md 19)

Each command ends in time, with status 0, 1, 2 or (when interrupted) 130. An error is one line without control characters. Only files
that the line names are written. The seeds are fixed; or new ones for that many seconds, printed where a command fails the test.
"""
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

LINES = 30
SECONDS = 20
# verbs that take long, open windows or wait for others only get lines that are refused at once
SLOW = {"bench", "tune", "demo", "leds", "display", "explain", "debug", "spring", "play", "record", "midi", "sound", "voice", "keys", "studio", "read", "cc"}
BAD = re.compile(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff]")
ROW = re.compile(r"^\s+(?:-(\w), )?--([a-z][\w-]*)(?:[ =](\S+))?")
VERB = re.compile(r"^  ([a-z]+) ")

VALUES = ["", "0", "1", "-1", "2", "0.5", "1e3", "1e308", "-1e308", "nan", "inf", "99999999999999999999", "0x10", "1,2", "1,2,3", "0,0,0,0",
          "8x8", "16x16", "16384x16384", "0x0", "x", ",", "--", "-", "%s%n%n", "a=1", "=", "a=1..3", "a=1..1e9", "a\x1b[2Jb", "\u202ex", "é漢",
          "/no/such/", "./made", "made/", "/dev/null", "/dev/full", "/dev/zero", "pipe", "folder", "link", "picture.png", "script.lua", "no/such",
          "out.png", "out.h5", "out.y4m", "made", "box:2", "gauss:1.5", "samples:1,2", "DejaVuSans", "wght=400", "A" * 300, "x" * 5000]
# good values, by the name that the help gives a value
RIGHT = {"FILE": ["out.png", "out.h5", "script.lua"], "DIR": ["made", "folder"], "N": ["1", "2", "3"], "S": ["1", "5"], "PX": ["12", "40"],
         "F": ["box:2", "DejaVuSans", "triangle:3"], "WxH": ["16x16", "40x20"], "W": ["0.5"], "A": ["left", "0.5"], "B": ["1"],
         "C,M,Y": ["0.1,0.5,1"], "X,Y": ["3,4"], "R,G,B": ["0,0.5,1"], "DEG": ["30"], "G": ["1.5"], "H": ["0.1"], "C": ["g", "0.5"], "X,Y,X,Y": ["0,-40,90,0"], "X,Y,R": ["40,-20,60"],
         "AT,R,G,B,C": ["0,1,0,0,1", "1,0,0,1,0.4"],
         "KEY=LIST": ["a=1,2"], "MB": ["64", "4096"], "VIEW": ["color"], "X,Y,W,H": ["0,0,8,8"], "TEXT": ["Ag"], "L": ["en", "1.2"]}
WORDS = ["Wet", "", "é漢🎨", "\x1b]0;x\x07", "script.lua", "picture.png", "DejaVuSans", "pipe", "folder", "link", "no/such", "a=1", "-",
         "A" * 400]


class Lines:
    def __init__(self, lutetia, seed):
        self.lutetia = lutetia
        self.chance = random.Random(seed)
        self.environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        self.verbs = {}
        for line in self.help_of():
            found = VERB.match(line)
            if found:
                self.verbs[found.group(1)] = []
        for verb, rows in self.verbs.items():
            for line in self.help_of(verb):
                found = ROW.match(line)
                if found and found.group(2) != "help":
                    rows.append((found.group(1), found.group(2), found.group(3)))
        assert {"type", "font", "run", "paint"} <= set(self.verbs) and all(self.verbs[v] for v in ("type", "font", "run"))

    def help_of(self, *verb):
        return subprocess.run([self.lutetia, *verb, "--help"], env=self.environment, capture_output=True, text=True, timeout=SECONDS,
                              check=True).stdout.splitlines()

    def line(self):
        """Draws a line; returns it, and whether it is certainly wrong."""
        chance = self.chance
        quick = [verb for verb in self.verbs if verb not in SLOW]
        verb = chance.choice(list(self.verbs)) if chance.random() < 0.15 else chance.choice([*quick, "type", "font", "run"])
        rows = self.verbs[verb]
        line = [verb]
        if chance.random() < 0.9:
            line.append(chance.choice(WORDS) if chance.random() < 0.2 else "script.lua" if verb == "run" else "DejaVuSans")
        if chance.random() < 0.15:
            line.append(chance.choice(WORDS))
        for _ in range(chance.randrange(4)):
            if not rows:
                break
            letter, name, value = chance.choice(rows)
            text = chance.choice(RIGHT.get(value, VALUES) if chance.random() < 0.8 else VALUES)
            if not value:
                line += ["--" + name]
            elif letter and chance.random() < 0.3:
                line += ["-" + letter + text] if chance.random() < 0.5 else ["-" + letter, text]
            else:
                line += ["--%s=%s" % (name, text)] if chance.random() < 0.5 else ["--" + name, text]
        if verb in SLOW:
            line = [verb, "--no-such-option"] + line[1:]
        elif chance.random() < 0.1:
            line.insert(chance.randrange(len(line)), chance.choice(VALUES + ["--no-such-option", "-z"]))
        return [word.replace("\0", "") for word in line]

    def place_make(self, at):
        (at / "script.lua").write_text('print(param("a", 1))\n')
        (at / "picture.png").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(100))
        (at / "folder").mkdir()
        os.symlink("picture.png", at / "link")
        os.mkfifo(at / "pipe")

    def look(self, at):
        found = {}
        for path in sorted(at.rglob("*")):
            if path.is_symlink():
                found[path.relative_to(at)] = ("link", os.readlink(path))
            elif path.is_file():
                found[path.relative_to(at)] = path.read_bytes()
            else:
                found[path.relative_to(at)] = "folder" if path.is_dir() else "pipe"
        return found

    def one(self, line):
        with tempfile.TemporaryDirectory(prefix="lutetia-lines-") as name:
            at = pathlib.Path(name)
            self.place_make(at)
            before = self.look(at)

            def limits():
                resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
                resource.setrlimit(resource.RLIMIT_FSIZE, (64 << 20, 64 << 20))
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                if line[0] in ("type", "font"):
                    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
            child = subprocess.Popen([self.lutetia, *[word.encode("utf-8", "surrogateescape") for word in line]], cwd=at,
                                     env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                     preexec_fn=limits)
            try:
                words = child.communicate(timeout=SECONDS)[1]
            except subprocess.TimeoutExpired:
                child.send_signal(signal.SIGINT)
                words = child.communicate(timeout=SECONDS)[1]
                assert child.returncode in (0, 130), child.returncode
            words = words.decode("utf-8", "replace")
            assert child.returncode in (0, 1, 2, 130), (child.returncode, words)
            assert child.returncode == 0 or words, "nothing is said"
            if line[0] != "cc":
                assert not BAD.search(words), repr(words)
                assert child.returncode != 2 or "usage:" in words or words.count("\n") == 1, words
            after = self.look(at)
            asked = "\n".join(line) + "\na-1\na-2\na-3\nout.png\npage.png\na.out\nleds.png\ndisplay.png"  # folders of sweeps; what a verb is to write if nothing is said
            for path in after.keys() | before.keys():
                if after.get(path) == before.get(path):
                    continue
                assert path in after, "%s is gone" % path
                assert any(part in asked for part in path.parts), "%s is written" % path
                assert path not in before or isinstance(before[path], bytes), "%s was no file" % path
            return child.returncode


def main():
    lutetia = os.path.abspath(sys.argv[1])
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 0
    seed = int(time.time()) if seconds else 4
    lines = Lines(lutetia, seed)
    began, count, statuses = time.monotonic(), 0, {}
    while time.monotonic() - began < seconds if seconds else count < LINES:
        line = lines.line()
        try:
            status = lines.one(line)
        except (AssertionError, subprocess.TimeoutExpired) as wrong:
            sys.exit("seed %d, line %d: %r\n%s" % (seed, count, line, wrong))
        statuses[status] = statuses.get(status, 0) + 1
        count += 1
    print("%d lines: %s" % (count, ", ".join("%d with status %d" % (n, s) for s, n in sorted(statuses.items()))))
    assert statuses.get(0) and statuses.get(1) and statuses.get(2), "it looks at half of what it should"


if __name__ == "__main__":
    main()
