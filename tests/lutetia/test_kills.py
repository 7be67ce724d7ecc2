"""test_kills.py LUTETIA [MOMENTS [SEED]]: kills the command at random moments, and runs it on full disks.

The tasks save, paint, film, compile, measure (with many moments), and start with empty caches. SIGKILL comes at some moment, or the
disk is full from some byte on. Each old file must then be unchanged, or as a whole run leaves it; each task writes two known versions
in turn. After the next start no part file is left, and its results are right. (security.md 11, 13, 16)
"""
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

SCRIPT = """
local p = paper{width = 24, height = 24, seed = param("version", 1)}
for i = 1, 4 do
  p:put(ellipse(12, 12, 3 + i), {water = 0.4})
  p:step(4)
end
for i = 1, 6 do
  p:frame("frame.png")
  p:save("sheet.h5")
end
"""
SECONDS = 120
TUNE_EVERY = 100  # moments; it takes long


class Task:
    """A command line in two versions, and the files that it writes in `folder`."""

    def __init__(self, name, files, arguments):
        self.name, self.files, self.arguments = name, files, arguments
        self.whole = {}  # (file, version): its bytes
        self.seconds = 0.1


PROGRAM = """
#include <cm/paris.h>
#include <stdio.h>
int main() { printf("%d\\n", VERSION); return 0; }
"""


def tasks_of():
    sheet = ["run", "script.lua", "-q"]
    return [
        Task("save", ["out/frame.png", "out/sheet.h5", "all.h5"],
             lambda v: [*sheet, "-o", "out", "--save", "all.h5", "version=%d" % v]),
        Task("film", ["film.y4m", "frames/color-000003.png", "frames/water-000004.png"],
             lambda v: [*sheet, "-o", "filmed", "--video", "film.y4m", "--frames", "frames", "version=%d" % v]),
        Task("type", ["type.png"], lambda v: ["type", "Kills %d" % v, "-o", "type.png", "--size", "200"]),
        Task("paint", ["paint.png"], lambda v: ["paint", "k", "--paper", "64x64", "--steps", "8", "--seed", str(v), "-o", "paint.png"]),
        Task("compile", ["prog"], lambda v: ["cc", "-MD", "prog.c", "-DVERSION=%d" % v, "-o", "prog"]),
    ]


class Place:
    """A folder with the tasks' files, and caches of its own."""

    def __init__(self, lutetia):
        self.lutetia = lutetia
        self.holder = tempfile.TemporaryDirectory(prefix="lutetia-kills-")
        self.at = pathlib.Path(self.holder.name)
        (self.at / "script.lua").write_text(SCRIPT)
        (self.at / "prog.c").write_text(PROGRAM)
        self.tasks = tasks_of()
        self.environment = dict(os.environ, XDG_CACHE_HOME=str(self.at / "cache"), LUTETIA_BACKGROUND="1")
        self.environment.pop("POCL_CACHE_DIR", None)

    def begin(self, arguments, limit=None):
        def full():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, resource.getrlimit(resource.RLIMIT_FSIZE)[1]))
        return subprocess.Popen([self.lutetia, *arguments], cwd=self.at, env=self.environment, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
                                preexec_fn=full if limit is not None else None)

    def run_whole(self, arguments):
        child = self.begin(arguments)
        said = child.communicate(timeout=SECONDS)[1].decode(errors="replace")
        assert child.returncode == 0, (arguments, said)

    def learn(self):
        """Reads the files that whole runs write; those of the second version stay."""
        for task in self.tasks:
            for version in (1, 2):
                began = time.monotonic()
                self.run_whole(task.arguments(version))
                task.seconds = time.monotonic() - began
                for name in task.files:
                    task.whole[name, version] = (self.at / name).read_bytes()
            for name in task.files:
                assert task.whole[name, 1] != task.whole[name, 2] or "water" in name or "sheet" in name, name

    def versions(self, task, name):
        return [whole for (file, _), whole in task.whole.items() if file == name]

    def is_saved(self, name):
        """Whether a failed run's state can be resumed: it must hold all that was done until then."""
        (self.at / "nothing.lua").write_text("")
        child = self.begin(["run", "nothing.lua", "-q", "--resume", name])
        child.communicate(timeout=SECONDS)
        return child.returncode == 0

    def check(self, what, failed=False):
        for other in self.tasks:
            for name in other.files:
                found = (self.at / name).read_bytes()
                good = found in self.versions(other, name) or (failed and name == "all.h5" and self.is_saved(name))
                assert good, "%s: %s is damaged (%d bytes)" % (what, name, len(found))
                if failed and found not in self.versions(other, name):
                    (self.at / name).write_bytes(other.whole[name, 1])

    def parts(self):
        return [str(path) for path in self.at.rglob(".*.part")]

    def next_start(self, task, version, what):
        self.run_whole(task.arguments(version))
        for name in task.files:
            assert (self.at / name).read_bytes() == task.whole[name, version], "%s: then %s is wrong" % (what, name)


def killed(place, chance, moment, empty):
    """Returns whether it was killed before its end."""
    task = chance.choice(place.tasks)
    version = 1 + moment % 2
    if empty:  # kernels are compiled, and kept
        shutil.rmtree(place.at / "cache", ignore_errors=True)
    after = chance.uniform(0, task.seconds * (4 if empty else 1.2))
    child = place.begin(task.arguments(version))
    try:
        child.wait(after)
    except subprocess.TimeoutExpired:
        pass
    alive = child.poll() is None
    if chance.random() < 0.5:
        child.kill()
    else:  # with all that it has started
        try:
            os.killpg(child.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    child.communicate(timeout=SECONDS)
    place.check("moment %d, %s killed after %.3f s" % (moment, task.name, after))
    return alive


def full(place, chance, moment):
    task = chance.choice(place.tasks)
    version = 1 + moment % 2
    limit = int(2 ** chance.uniform(0, 18))
    child = place.begin(task.arguments(version), limit)
    words = child.communicate(timeout=SECONDS)[1].decode(errors="replace")
    what = "moment %d, %s with files up to %d bytes" % (moment, task.name, limit)
    assert child.returncode in (0, 1), (what, child.returncode, words)
    assert child.returncode == 0 or words, what
    place.check(what, child.returncode != 0)


def tuned(place, chance, moment):
    """Killed while it measures and keeps what it found; the next start reads that, or nothing."""
    child = place.begin(["tune"])
    try:
        child.wait(chance.uniform(0, 45))
    except subprocess.TimeoutExpired:
        pass
    os.killpg(child.pid, signal.SIGKILL) if child.poll() is None else None
    child.communicate(timeout=SECONDS)
    info = place.begin(["info"])
    said = info.communicate(timeout=SECONDS)
    assert info.returncode == 0 and b"ignored" not in said[0] + said[1], ("moment %d" % moment, said)


def main():
    moments = int(sys.argv[2]) if len(sys.argv) > 2 else 30
    chance = random.Random(int(sys.argv[3]) if len(sys.argv) > 3 else 17)
    place = Place(os.path.abspath(sys.argv[1]))
    place.learn()
    in_time = fulls = empties = tunes = 0
    for moment in range(moments):
        if moment % TUNE_EVERY == TUNE_EVERY - 1:
            tuned(place, chance, moment)
            tunes += 1
            continue
        if moment % 4 == 3:
            full(place, chance, moment)
            fulls += 1
        else:
            empty = moment % 16 == 5
            alive = killed(place, chance, moment, empty)
            in_time += alive
            empties += empty
        if moment % 8 == 7 or moment == moments - 1:
            for task in place.tasks:
                place.next_start(task, 1 + moment // 8 % 2, "moment %d" % moment)
            assert not place.parts(), "moment %d: part files stay: %s" % (moment, place.parts())
    print("%d moments: %d killed on the way, %d with full disks, %d with empty caches, %d while tuning; nothing damaged" %
          (moments, in_time, fulls, empties, tunes))
    place.holder.cleanup()


if __name__ == "__main__":
    main()
