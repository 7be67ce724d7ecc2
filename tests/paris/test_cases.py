"""Programs that came to wrong numbers, in ../shared/cases/paris, where that folder is: each must see the same in all ways, and what is
right. test_cases.py FOLDER INCLUDE LIBRARIES [FLAG...] (of the compiler); a file that is not there is skipped by name."""

import gzip
import os
import shutil
import subprocess
import sys
import tempfile

FOLDER, INCLUDE, LIBRARIES = sys.argv[1:4]
FLAGS = sys.argv[4:]
WAYS = {
    "as usual": {},
    "without replay": {"LUTETIA_REPLAY": "0"},
    "one at a time": {"LUTETIA_EAGER": "1"},
    "byte code": {"LUTETIA_INTERPRET": "2", "LUTETIA_AT_ONCE": "0"},
    "always at once": {"LUTETIA_INTERPRET": "2", "LUTETIA_AT_ONCE": "2"},
}
SETTINGS = ("LUTETIA_REPLAY", "LUTETIA_EAGER", "LUTETIA_INTERPRET", "LUTETIA_AT_ONCE", "LUTETIA_NEAR")
failures = []


def built(folder, source):
    """The program, compiled as a user's."""
    program = os.path.join(folder, os.path.splitext(source)[0])
    subprocess.run(
        ["cc", "-w", "-std=gnu99", "-O1", *FLAGS, os.path.join(FOLDER, source), "-o", program, "-I", INCLUDE, "-L", LIBRARIES,
         "-lparis", "-ldl", "-Wl,-rpath," + LIBRARIES], check=True)
    return program


def run(command, way, **more):
    environment = {k: v for k, v in os.environ.items() if k not in SETTINGS}
    environment.update(LUTETIA_BACKGROUND="0", **WAYS[way], **more)
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=240)
    return done.returncode, done.stdout


def calls_agree(name, command, last=None, **more):
    """All ways print the same, end well, and print `last` at the end."""
    right = run(command, "without replay", **more)
    if right[0] or (last and not right[1].rstrip().endswith(last)):
        failures.append(f"{name}, without replay: status {right[0]}, {right[1][-200:]!r}")
    for way in WAYS:
        seen = run(command, way, **more)
        if seen != right:
            failures.append(f"{name}, {way}: status {seen[0]}, {seen[1][-200:]!r}")


def there(*names):
    missing = [n for n in names if not os.path.exists(os.path.join(FOLDER, n))]
    for n in missing:
        print(f"skipped: {n}: not in {FOLDER}")
    return not missing


def main():
    if not os.path.isdir(FOLDER):
        print("skipped: replay-wrong.c, replay-silent.rep.gz, replay-use-after-free.rep and others: no ../shared/cases/paris")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        if there("replay-wrong.c"):
            calls_agree("replay-wrong.c", [built(folder, "replay-wrong.c")])
        if there("rep.c", "replay-silent.rep.gz"):
            calls = os.path.join(folder, "silent.rep")
            with gzip.open(os.path.join(FOLDER, "replay-silent.rep.gz")) as packed, open(calls, "wb") as out:
                shutil.copyfileobj(packed, out)
            calls_agree("replay-silent.rep", [built(folder, "rep.c"), calls], " 83 4a", LUTETIA_PROCESSORS="16")
        if there("rep.c", "replay-use-after-free.rep"):
            calls_agree("replay-use-after-free.rep",
                        [built(folder, "rep.c"), os.path.join(FOLDER, "replay-use-after-free.rep")], LUTETIA_PROCESSORS="16")
        if there("rep2.c", "replay-segfault.rep"):
            calls_agree("replay-segfault.rep", [built(folder, "rep2.c"), os.path.join(FOLDER, "replay-segfault.rep")])
    for f in failures:
        print(f)
    return bool(failures)


sys.exit(main())
