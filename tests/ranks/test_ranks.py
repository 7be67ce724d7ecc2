"""test_ranks.py WHAT BUILD PROGRAM...: one program on several processes, by mpirun.

same      the programs (NAME=PATH) print and write what they do in one process, on 2 and 3 ranks, and on 7 of few rows each
random    PATH, which is test_random, on 3 ranks
suite     PATH, a test of cmocka, on 2 ranks
scripts   LUTETIA: a script and its saved state, `paint` and a sweep give the same files on 2 and 3 ranks
counts    PATH, which is counts: what is done on ranks, and not in one piece
forks     PATH, which is forks: input, children, other programs, the status
wrong     each wrong start is a line (NO_MPI PATH LIBPARIS LUTETIA)
killed    a rank that is killed ends all within seconds, with a line that names it (PATH)

Where there is no mpirun it says so, and is skipped.
"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe"]
# Small sets are cut, too. A rank's byte code is as fast as kernels there, and nothing is compiled. Containers may not let processes read
# each other's memory.
SMALL = {"LUTETIA_BLOCKS_FROM": "2", "LUTETIA_GHOSTS": "2", "LUTETIA_INTERPRET": "2", "LUTETIA_TUNED": "0",
         "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
SIZES = {"life": ["6", "56", "40"], "heat": ["6", "56", "40"], "diffusion": ["3", "56", "40"], "components": ["1", "56", "40"],
         "waves": ["20", "56", "41"], "sort": ["5"], "matrix": ["20"], "quicksort": ["300"]}
OF_SEVEN = ("life", "heat")
failed = 0


def wrong(what, *told):
    global failed
    failed += 1
    print("WRONG:", what)
    for text in told:
        print(text)


def environment(**more):
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMI", "SLURM_"))}
    # Programs are not built with ASan, though the library may be; MPI's own memory is not ours.
    clean["ASAN_OPTIONS"] = "verify_asan_link_order=0:detect_leaks=0"
    return {**clean, **SMALL, **more}


def ran(command, folder, given="", **more):
    done = subprocess.run(command, cwd=folder, env=environment(**more), input=given, text=True, capture_output=True, timeout=120)
    return done.returncode, done.stdout, done.stderr


def files_of(folder):
    found = {}
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), "rb") as file:
            found[name] = file.read()
    return found


def same(programs):
    for program in programs:
        name, path = program.split("=", 1)
        path = os.path.abspath(path)
        with tempfile.TemporaryDirectory() as alone:
            expected = ran([path, *SIZES[name]], alone), files_of(alone)
        for ranks in (2, 3, 7) if name in OF_SEVEN else (3,):
            with tempfile.TemporaryDirectory() as together:
                got = ran([*MPIRUN, "-n", str(ranks), path, *SIZES[name]], together, LUTETIA_GHOSTS="3"), files_of(together)
            if (got[0][:2], got[1]) != (expected[0][:2], expected[1]):
                wrong(f"{name} on {ranks} ranks", *expected[0][1:2], *got[0][1:])
            else:
                print(f"{name} on {ranks} ranks: the same")


def random(path):
    status, out, error = ran([*MPIRUN, "-n", "3", path, "--loops", "--programs", "150", "--seconds", "15", "--seed", "43000"], ".")
    print(out)
    if status or " 0 differ" not in out:
        wrong("random programs differ", error)


def suite(*paths):
    for path in paths:
        status, out, error = ran([*MPIRUN, "-n", "2", path], ".")
        print(out, error)
        if status:
            wrong(f"{path} on 2 ranks")


def counts(path):
    alone = ran([path], ".", LUTETIA_BLOCKS="1")
    for ranks in ("2", "3", "5"):
        status, out, error = ran([*MPIRUN, "-n", ranks, path], ".")
        if status or out != alone[1]:
            wrong(f"{ranks} ranks", alone[1], out, error)
        out = ran([*MPIRUN, "-n", ranks, path, "counts"], ".")[1]
        if out.count("put together: 0") != len(alone[1].splitlines()):
            wrong(f"{ranks} ranks: something was put together", out)
    print(out)


def forks(path):
    path = os.path.abspath(path)
    alone = ran([path], ".", "a line")
    status, out, error = ran([*MPIRUN, "-n", "3", path], ".", "a line")
    expected = [line for line in alone[1].splitlines() if "child" not in line]
    if alone[0] != 3 or status != 3 or [line for line in out.splitlines() if "child" not in line] != expected:
        wrong("forks", alone, status, out, error)
    if "the child reads" in out or "has no ranks" not in error or "the child ended with 1" not in out:
        wrong("a child has what ranks have", out, error)
    print(out)


def says(what, said, line, count=1):
    if said.count(line) != count:
        wrong(f"{what}: not {count} times \"{line}\"", said)
    else:
        print(f"{what}: {line}")


def wrong_starts(no_mpi, life, libparis, lutetia):
    life, libparis, lutetia = (os.path.abspath(path) for path in (life, libparis, lutetia))
    with tempfile.TemporaryDirectory() as folder:
        status, out, error = ran([life, "2", "24", "40"], folder, OMPI_COMM_WORLD_SIZE="3", OMPI_COMM_WORLD_RANK="0",
                                 LD_PRELOAD=os.path.abspath(no_mpi))
        says("no MPI", error, "there is no MPI library here")
        status, out, error = ran([life, "2", "24", "40"], folder, PMI_SIZE="3", PMI_RANK="0")
        says("another MPI's start", error, "MPI knows of one process alone")
        if not status or out:
            wrong("it runs all the same", out)
        unequal = 'if [ $OMPI_COMM_WORLD_RANK = 1 ]; then export LUTETIA_TURNS=3; fi; exec "$0" 2 24 40'
        status, out, error = ran([*MPIRUN, "-n", "2", "sh", "-c", unequal, life], folder)
        says("unequal settings", error, "has LUTETIA_TURNS=3, rank 0")
        if not status or out:
            wrong("unequal settings run all the same", out)
        error = ran([*MPIRUN, "-n", "2", life, "2", "24", "40"], folder, LUTETIA_BLOCKS="5")[2]
        says("blocks", error, "LUTETIA_BLOCKS is 5, but each of 2 ranks has one block")
        later = f"import ctypes; ctypes.CDLL({libparis!r}).CM_init(); print('made')"
        status, out, error = ran([*MPIRUN, "-n", "2", sys.executable, "-c", later], folder)
        if "OMPI_COMM_WORLD_SIZE is 2" not in error or out or not status:
            wrong("a library that is loaded later", out, error)
        status, out, error = ran([*MPIRUN, "-n", "2", lutetia, "demo", "-o", folder], folder)
        if "cannot be one of several processes" not in error or not status:
            wrong("lutetia", out, error)
        status, out, error = ran([*MPIRUN, "-n", "2", life, "2", "24", "40"], folder, LUTETIA_RANKS="0")
        says("separate programs", out, "same as a plain loop: yes", 2)


# Pictures, a state that another number of ranks goes on from, and the past.
SCRIPT = """
local p = paper{width = 90, height = 70, pigments = {"burnt sienna", "yellow ochre"}, undo = 20, seed = 4}
p:type(param("word", "Ink"), {size = 44, x = 6, y = 52})
for i = 1, param("steps", 12) do p:step() end
p:frame("a.png")
p:undo(3)
p:frame("b.png")
"""


def scripts(lutetia):
    lutetia = os.path.abspath(lutetia)
    with tempfile.TemporaryDirectory() as folder:
        script = os.path.join(folder, "a.lua")
        with open(script, "w", encoding="utf-8") as file:
            file.write(SCRIPT)

        def outcome(name, starter, *command):
            out = os.path.join(folder, name)
            os.makedirs(out)
            status, said, error = ran([*starter, lutetia, *command, "-o", out], folder)
            if status:
                wrong(f"{name}: status {status}", said, error)
            return {name: data for name, data in all_of(out).items() if name.endswith(".png")}

        def compare(what, *pictures):
            if not pictures[0] or any(picture != pictures[0] for picture in pictures):
                wrong(f"{what}: {[sorted(picture) for picture in pictures]}")

        def ranks(count):
            return [*MPIRUN, "-n", str(count)]

        compare("a script", *(outcome(f"run-{n}", ranks(n) if n > 1 else [], "run", script, "-q") for n in (1, 2, 3)))
        compare("a sweep", *(outcome(f"sweep-{n}", ranks(n) if n > 1 else [], "run", script, "-q", "--sweep", "word=Wet,Dry") for n in (1, 2)))
        state = os.path.join(folder, "state.h5")
        outcome("saved", ranks(3), "run", script, "-q", "--save", state, "steps=8")
        compare("a state", *(outcome(f"resumed-{n}", ranks(n) if n > 1 else [], "run", script, "-q", "--resume", state) for n in (1, 2)),
                outcome("at-once", [], "run", script, "-q"))
        for n in (1, 3):
            status, _, error = ran([*(ranks(n) if n > 1 else []), lutetia, "paint", "Bon", "--paper", "80x60", "-o", f"paint-{n}.png"], folder)
            if status:
                wrong("paint", error)
        if file_of(folder, "paint-1.png") != file_of(folder, "paint-3.png"):
            wrong("paint: other bits")


def file_of(folder, name):
    with open(os.path.join(folder, name), "rb") as file:
        return file.read()


def all_of(folder):
    return {os.path.relpath(os.path.join(place, name), folder): file_of(place, name)
            for place, _, names in os.walk(folder) for name in names}


def rank_of(process):
    try:
        with open(f"/proc/{process}/environ", "rb") as file:
            for variable in file.read().split(b"\0"):
                if variable.startswith(b"OMPI_COMM_WORLD_RANK="):
                    return int(variable.partition(b"=")[2])
    except OSError:
        pass
    return -1


def children(process):
    with open(f"/proc/{process}/task/{process}/children", encoding="ascii") as file:
        return [int(word) for word in file.read().split()]


def lives(process):
    try:
        with open(f"/proc/{process}/stat", encoding="ascii", errors="replace") as file:
            return file.read().rpartition(")")[2].split()[0] not in "ZX"
    except OSError:
        return False


def killed(life):
    life = os.path.abspath(life)
    for victim, after in ((1, 1.5), (2, 0.9), (0, 1.2), (1, 0.5)):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.Popen([*MPIRUN, "-n", "3", life, "1000000", "256", "256"], cwd=folder, env=environment(),
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            until, ranks = time.monotonic() + 20, []
            while time.monotonic() < until and sorted(rank_of(process) for process in ranks) != [0, 1, 2]:
                time.sleep(0.05)
                ranks = [process for process in children(run.pid) if rank_of(process) >= 0]
            time.sleep(after)
            os.kill(next(process for process in ranks if rank_of(process) == victim), signal.SIGKILL)
            begun = time.monotonic()
            try:
                said = run.communicate(timeout=20)[0]
            except subprocess.TimeoutExpired:
                run.kill()
                said = run.communicate()[0]
                wrong(f"rank {victim} was killed, and nothing ended")
            while any(lives(process) for process in ranks) and time.monotonic() < begun + 10:
                time.sleep(0.05)
            if any(lives(process) for process in ranks):
                wrong(f"rank {victim} was killed, and a process is left")
            if f"rank {victim} " not in said or not run.returncode:
                wrong(f"rank {victim} was killed, and nobody says so", said)
            print(f"rank {victim} killed after {after} s: all ended {time.monotonic() - begun:.1f} s later")


def main():
    if not shutil.which("mpirun"):
        print("skipped: mpirun is not installed (Debian: openmpi-bin)")
        sys.exit(77)
    what = {"same": lambda *programs: same(programs), "random": random, "suite": suite, "forks": forks, "scripts": scripts, "counts": counts, "wrong": wrong_starts,
            "killed": killed}
    what[sys.argv[1]](*sys.argv[2:])
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
