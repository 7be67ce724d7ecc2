"""needed.py BUILD SUITE: the files in that build folder that tests need which are not in the suite, for ninja.

A test says what it needs: the programs in its command, and its dependencies.
"""
import json
import os
import subprocess
import sys


def asked(build, what):
    return json.loads(subprocess.run(["meson", "introspect", f"--{what}", build], check=True, capture_output=True).stdout)


def main(build, suite):
    files = {target["id"]: target["filename"] for target in asked(build, "targets")}
    made = {name for names in files.values() for name in names}
    needed = set()
    for test in asked(build, "tests"):
        if suite not in (name.rpartition(":")[2] for name in test["suite"]):
            needed |= made & set(test["cmd"])
            for target in test["depends"]:
                needed |= set(files[target])
    print("\n".join(sorted(os.path.relpath(name, build) for name in needed)))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
