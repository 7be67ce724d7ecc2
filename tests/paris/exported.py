"""exported.py LIBRARY SYMBOLS VERSION [--write] - compares what libparis exports with debian/libparis1.symbols, which holds it fixed.

A program that was linked with the library finds each of these names in each later one of the same soname. So a name that is gone
needs a new soname (`soversion` in paris_compat/meson.build, the package libparis1, this list); a new one is a line with the version
that has it first: --write adds those. The soname is that of the list's first line.
"""
import re
import subprocess
import sys

PREFIXES = "CM_", "CMFB_", "CMFS_", "lutetia_"  # of <cm/paris.h>, <cm/cmfb.h>, <cm/cmfs.h>, <lutetia/fields.h>


def output(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def main():
    library, path, version = sys.argv[1:4]
    lines = open(path).read().splitlines()
    soname, listed = lines[0].split()[0], {}
    for line in lines[1:]:
        found = re.fullmatch(r" (\w+)@Base (\S+)", line)
        if not found:
            print(f"{path}: not a line of it: {line!r}")
            return 1
        listed[found.group(1)] = found.group(2)
    exported = {line.split()[-1].split("@")[0] for line in output("nm", "-D", "--defined-only", library).splitlines()}
    missing, new = sorted(set(listed) - exported), sorted(exported - set(listed))
    if "--write" in sys.argv:
        listed |= {name: version for name in new}
        with open(path, "w") as out:
            print(lines[0], *(f" {name}@Base {listed[name]}" for name in sorted(listed)), sep="\n", file=out)
        new = []
    has = re.search(r"\(SONAME\).*\[(.*)\]", output("readelf", "-d", library)).group(1)
    wrong = [f"{library}: its soname is {has}, that of the list {soname}"] if has != soname else []
    wrong += [f"{name}: no longer exported: programs that use it stop; keep it, or change the soname" for name in missing]
    wrong += [f"{name}: exported, and not in the list; this script adds it with --write" for name in new]
    wrong += [f"{name}: all exported names begin with {', '.join(PREFIXES)}" for name in exported if not name.startswith(PREFIXES)]
    wrong += [f"{path}: not in order"] if list(listed) != sorted(listed) else []
    print("\n".join(wrong[:20]) or f"{len(exported)} names, {soname}")
    return 1 if wrong else 0


sys.exit(main())
