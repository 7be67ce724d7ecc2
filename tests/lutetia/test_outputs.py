"""test_outputs.py LUTETIA [MOMENTS|SECONDSs [SEED [NAME...]]]: everything that the command writes, on full disks and ended by signals.

Each row of verbs.py (verbs, options and environment variables that name an output; those of the command's own table, so that a new one
cannot be forgotten) runs on a disk with no room, with half of what it takes, and with a page too little; and is ended by SIGINT,
SIGTERM, SIGHUP or SIGKILL at MOMENTS moments by chance. A disk is a small tmpfs, which root alone can mount; else files may not grow beyond
such a length. Each file is then the old one or a whole new one, and all are new where the status is 0; no part file is left, but after
SIGKILL, and the next run removes that. A third of the moments are near that at which the first file is begun. 300s: by chance, for so
many seconds. MOMENTS 0 (what CI does): one disk and one signal for each row but the slow ones.
(security.md 11, 13, 18, 25)
"""
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree
import zlib

import verbs

SECONDS = 3600  # of a busy machine
PAGE = 4096
OLD = b"before"
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL)


# ---- what is a whole file ----

def png_whole(data):
    at, pixels = 8, b""
    while data[:8] == b"\x89PNG\r\n\x1a\n" and at + 12 <= len(data):
        count, kind = struct.unpack(">I4s", data[at:at + 8])
        if at + 12 + count > len(data) or zlib.crc32(data[at + 4:at + 8 + count]) != struct.unpack(">I", data[at + 8 + count:at + 12 + count])[0]:
            return False
        pixels += data[at + 8:at + 8 + count] if kind == b"IDAT" else b""
        at += 12 + count
        if kind == b"IEND":
            return at == len(data) and len(zlib.decompress(pixels)) > 0
    return False


def y4m_whole(data):
    head, _, frames = data.partition(b"\n")
    words = {word[:1]: word[1:] for word in head.split()[1:]}
    if not head.startswith(b"YUV4MPEG2 "):
        return False
    one = 6 + int(words[b"W"]) * int(words[b"H"]) * 3 // (1 if b"444" in words.get(b"C", b"") else 2)
    return len(frames) > 0 and len(frames) % one == 0


def film_frames(path):
    done = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
                           "stream=nb_read_frames", "-of", "csv=p=0", str(path)], capture_output=True, timeout=SECONDS, check=False)
    words = done.stdout.decode().strip().strip(",")
    return int(words) if done.returncode == 0 and not done.stderr and words.isdigit() else -1


def json_whole(data):
    try:
        return json.loads(data) is not None
    except ValueError:
        return False


def svg_whole(data):
    try:
        return xml.etree.ElementTree.fromstring(data) is not None
    except xml.etree.ElementTree.ParseError:
        return False


def display_whole(data):
    at = len(b"lutetia display 1\n")
    good = data[:at] == b"lutetia display 1\n" and len(data) > at
    while good and at < len(data):
        good = at + 24 <= len(data)
        at += 24 + struct.unpack("<I", data[at + 4:at + 8])[0] if good else 0
    return good and at == len(data)


WHOLE = {
    ".png": png_whole, ".y4m": y4m_whole, ".json": json_whole, ".svg": svg_whole,
    ".wav": lambda data: data[:4] == b"RIFF" and struct.unpack("<I", data[4:8])[0] == len(data) - 8,
    ".pdf": lambda data: data[:5] == b"%PDF-" and data.rstrip().endswith(b"%%EOF"),
    ".leds": lambda data: data[:20] == b"lutetia leds 1 4096\n" and len(data) > 20 and (len(data) - 20) % 520 == 0,
    ".display": display_whole,
    ".cl": lambda data: data.rstrip().endswith(b"}"), ".graph": lambda data: data.endswith(b"\n"),
    ".txt": lambda data: data.endswith(b"\n"), ".springs": lambda data: data.endswith(b"\n"), "": lambda data: data[:4] == b"\x7fELF" or data.endswith(b"\n"),
}


class Place:
    """A folder with what the rows read, and a disk that can be mounted in it. own_caches: kernels are compiled anew here, and a run
    may end while they are; else the caches are those of the environment."""

    def __init__(self, lutetia, own_caches):
        self.lutetia = lutetia
        self.holder = tempfile.TemporaryDirectory(prefix="lutetia-outputs-")
        self.at = pathlib.Path(self.holder.name)
        for name in ("disk", "work", "tmp", "caches"):
            (self.at / name).mkdir()
        self.environment = dict(os.environ, TMPDIR=str(self.at / "tmp"))
        if own_caches:
            self.environment["XDG_CACHE_HOME"] = str(self.at / "caches")
            self.environment.pop("POCL_CACHE_DIR", None)
        self.fill(self.at / "work")
        self.program = self.at / "program"
        subprocess.run([lutetia, "cc", "prog.c", "-o", str(self.program)], cwd=self.at / "work", check=True)
        shutil.copy(self.program, self.at / "work/program")
        self.mounts = self.mount(PAGE * 8)
        self.unmount()

    def fill(self, folder):
        verbs.files_make(folder)
        if hasattr(self, "program"):
            shutil.copy(self.program, folder / "program")

    def mount(self, size):
        return subprocess.run(["mount", "-t", "tmpfs", "-o", "size=%d" % size, "none", str(self.at / "disk")],
                              capture_output=True, check=False).returncode == 0

    def unmount(self):
        if os.path.ismount(self.at / "disk"):
            subprocess.run(["umount", "-l", str(self.at / "disk")], check=True)


class Row:
    def __init__(self, place, name, files, words, variables):
        self.place, self.name, self.files, self.words, self.variables = place, name, files, words, variables
        self.has = [file for file in files if not file.endswith("/")]
        self.folders = [file for file in files if file.endswith("/")]
        self.seconds, self.bytes, self.whole, self.frames = 0.1, 0, {}, {}

    def begin(self, cwd, limit=None):
        def limited():
            for number in SIGNALS[:3]:  # whoever started this may ignore some
                signal.signal(number, signal.SIG_DFL)
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            if limit is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        first = self.place.lutetia if self.words[0] != "./program" else "./program"
        words = self.words[1:] if first == "./program" else self.words
        return subprocess.Popen([first, *words], cwd=cwd, env=dict(self.place.environment, **self.variables), stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True, preexec_fn=limited)

    def old(self, cwd):
        """The state before a run."""
        for folder in self.folders:
            shutil.rmtree(cwd / folder, ignore_errors=True)
            if folder == "pages/":
                (cwd / folder).mkdir()
        for file in self.has:
            (cwd / file).parent.mkdir(exist_ok=True)
            (cwd / file).write_bytes(OLD)

    def learn(self):
        cwd = self.place.at / "work"
        for turn in range(2):
            if turn and self.seconds < 1:  # no kernel was compiled
                break
            self.old(cwd)
            began = time.monotonic()
            child = self.begin(cwd)
            said = child.communicate(timeout=SECONDS)[1].decode(errors="replace")
            self.seconds = time.monotonic() - began
            if child.returncode != 0 and ("SoundFont" in said or "FluidSynth" in said or "ffmpeg" in said):
                return False
            assert child.returncode == 0, (self.name, child.returncode, said)
        for path in self.paths(cwd):
            self.whole[str(path.relative_to(cwd))] = path.read_bytes()
            if path.suffix in (".mp4", ".avi"):
                self.frames[path.suffix] = film_frames(path)
        assert all(file in self.whole and self.whole[file] != OLD for file in self.has), (self.name, sorted(self.whole))
        assert all(any(name.startswith(folder) for name in self.whole) for folder in self.folders), (self.name, sorted(self.whole))
        self.bytes = sum((len(data) + PAGE - 1) // PAGE * PAGE for data in self.whole.values())
        assert not self.wrong(cwd, 0), self.wrong(cwd, 0)
        return True

    def paths(self, cwd):
        found = [cwd / file for file in self.has]
        for folder in self.folders:
            found += [path for path in (cwd / folder).rglob("*") if path.is_file() and path.suffix != ".part"]
        return found

    def is_new(self, path, data, full):
        """full: as long as that of a whole run, too."""
        learned = next((whole for file, whole in self.whole.items() if str(path).endswith("/" + file)), None)
        if data == learned:
            return True
        if path.suffix in (".mp4", ".avi"):
            frames = film_frames(path)
            return frames == self.frames[path.suffix] if full else frames > 0
        if path.suffix == ".h5":
            child = subprocess.run([self.place.lutetia, "run", "nothing.lua", "-q", "--resume", str(path)], cwd=self.place.at / "work",
                                   env=self.place.environment, capture_output=True, check=False)
            return child.returncode == 0
        if full and path.suffix == ".y4m" and len(data) != len(learned):
            return False
        try:
            return len(data) > 0 and WHOLE[path.suffix](data)
        except (zlib.error, struct.error, ValueError):
            return False

    def wrong(self, cwd, status):
        """What is neither old nor new; None: nothing."""
        for path in self.paths(cwd):
            data = path.read_bytes() if path.exists() else OLD
            if data == OLD and (status != 0 or path.parent.name + "/" in self.folders):
                continue
            if data == OLD or not self.is_new(path, data, status == 0):
                return "%s: status %d, and %s is %s (%d bytes)" % (
                    self.name, status, path.relative_to(cwd), "the old one" if data == OLD else "damaged", len(data))
        return None

    def writes(self, cwd, killed):
        """Whether a file has been begun, or is there already."""
        return set(self.parts(cwd)) - killed or any(not path.exists() or path.stat().st_size != len(OLD) for path in self.paths(cwd))

    def parts(self, cwd):
        return [path.name for path in [*cwd.rglob(".*.part"), *self.place.at.glob("tmp/lutetia-*")]]


def disk_full(row, part):
    """One run with that part of what it writes free; part 1: a page too little."""
    place = row.place
    free = max(0, int(row.bytes * part) // PAGE * PAGE - (PAGE if part == 1 else 0))
    what = "%s with %d of %d bytes free" % (row.name, free, row.bytes)
    if place.mounts:
        cwd = place.at / "disk"
        assert place.mount(256 << 20), what
    else:
        cwd = place.at / "work"
    try:
        if place.mounts:
            place.fill(cwd)
        row.old(cwd)
        if place.mounts:
            left = os.statvfs(cwd).f_bavail * PAGE - free
            with open(cwd / "filler", "wb") as filler:
                filler.truncate(left)
                os.posix_fallocate(filler.fileno(), 0, left)
        child = row.begin(cwd, None if place.mounts else free)
        said = child.communicate(timeout=SECONDS)[1].decode(errors="replace")
        if child.returncode not in (0, 1):
            return "%s: status %d, and it said: %s" % (what, child.returncode, said)
        if child.returncode == 1 and not said.strip():
            return "%s: no word of it" % what
        if part == 0 and child.returncode == 0:
            return "%s: status 0" % what
        found = row.wrong(cwd, child.returncode)
        if found:
            return "%s: %s; it said: %s" % (what, found, said)
        if row.parts(cwd):
            return "%s: part files stay: %s" % (what, row.parts(cwd))
        return None
    finally:
        place.unmount()


def signalled(row, chance, number):
    """One run that is ended at a moment by chance. Returns what is wrong, and whether it was on its way."""
    cwd = row.place.at / "work"
    row.old(cwd)
    killed = set(row.parts(cwd))  # by SIGKILL, before
    writing = chance.random() < 0.3
    after = chance.uniform(0, 0.02 if writing else row.seconds * 1.1)
    child = row.begin(cwd)
    while writing and child.poll() is None and not row.writes(cwd, killed):
        time.sleep(0.001)
    try:
        child.wait(after)
    except subprocess.TimeoutExpired:
        pass
    alive = child.poll() is None
    group = number == signal.SIGKILL or chance.random() < 0.5  # a terminal sends it to all
    if alive:
        try:
            os.killpg(child.pid, number) if group else child.send_signal(number)
        except ProcessLookupError:
            pass
    said = child.communicate(timeout=SECONDS)[1].decode(errors="replace")
    status = child.returncode
    what = "%s, %s%s after %.3f of %.3f s%s" % (row.name, number.name, " to all" if group else "", after, row.seconds,
                                                 " from the first file on" if writing else "")
    if status not in (0, 1, 130, -number):
        return "%s: status %d, and it said: %s" % (what, status, said), alive
    found = row.wrong(cwd, status)
    if found:
        return "%s: %s; it said: %s" % (what, found, said), alive
    if number != signal.SIGKILL and set(row.parts(cwd)) - killed:
        return "%s: part files stay: %s; it said: %s" % (what, set(row.parts(cwd)) - killed, said), alive
    return None, alive


def swept(row):
    """The next run after SIGKILL removes what that left."""
    cwd = row.place.at / "work"
    child = row.begin(cwd)
    said = child.communicate(timeout=SECONDS)[1]
    if child.returncode != 0 or row.parts(cwd):
        return "%s, after kills: status %d, part files: %s; it said: %s" % (row.name, child.returncode, row.parts(cwd), said)
    return row.wrong(cwd, 0)


def by_chance(place, seconds, chance):
    """Disks and signals by chance, until the time is over; returns how many were wrong."""
    until = time.monotonic() + seconds
    tried = wrong = 0
    known = {}
    while time.monotonic() < until:
        name, _, _, files, words, variables = chance.choice([row for row in verbs.OUTPUTS if row[0] not in verbs.SLOW])
        if name not in known:
            known[name] = Row(place, name, files, words, variables)
            known[name] = known[name].learn() and known[name]
        row = known[name]
        if not row:
            continue
        number = chance.choice(SIGNALS)
        found = disk_full(row, chance.choice((0, chance.random(), 1))) if chance.random() < 0.4 else signalled(row, chance, number)[0]
        found = found or (swept(row) if row.parts(place.at / "work") else None)
        tried += 1
        wrong += found is not None
        if found:
            print(found, flush=True)
    print("%d tried, %d wrong" % (tried, wrong))
    return wrong


def main():
    lutetia = os.path.abspath(sys.argv[1])
    if len(sys.argv) > 2 and sys.argv[2].endswith("s"):
        place = Place(lutetia, True)
        wrong = by_chance(place, float(sys.argv[2][:-1]), random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else None))
        place.holder.cleanup()
        sys.exit(wrong > 0)
    moments = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 17
    names = sys.argv[4:]
    chance = random.Random(seed)
    wrong = ["no row of verbs.py tries %s" % what for what in verbs.forgotten(lutetia)]
    counts = {"disks": 0, "signals": 0, "on the way": 0, "rows": 0}
    place = Place(lutetia, moments > 0)
    for at, (name, _, _, files, words, variables) in enumerate(verbs.OUTPUTS):
        if (names and name not in names) or (not names and not moments and name in verbs.SLOW):
            continue
        row = Row(place, name, files, words, variables)
        if not row.learn():
            print("%s: left out, for what it needs is not here" % name)
            continue
        counts["rows"] += 1
        for part in (0, 0.5, 1) if moments else ((0, 0.5, 1)[(at + seed) % 3],):
            wrong.append(disk_full(row, part))
            counts["disks"] += 1
        for moment in range(moments or 1):
            number = SIGNALS[moment % 4 if moments else (at + seed) % 4]
            found, alive = signalled(row, chance, number)
            wrong.append(found)
            counts["signals"] += 1
            counts["on the way"] += alive
        if moments or SIGNALS[(at + seed) % 4] == signal.SIGKILL:
            wrong.append(swept(row))
        for line in [line for line in wrong if line]:
            print(line, flush=True)
        if moments:
            print("%s: tried at %d moments" % (name, moments), flush=True)
        counts["wrong"] = counts.get("wrong", 0) + len([line for line in wrong if line])
        wrong = []
    print(", ".join("%d %s" % (count, what) for what, count in counts.items()))
    place.unmount()
    place.holder.cleanup()
    sys.exit(counts.get("wrong", 0) > 0)


if __name__ == "__main__":
    main()
