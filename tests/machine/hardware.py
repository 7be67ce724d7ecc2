"""Numbers about hardware stand in device/shape.h and costs_by_driver.c only.

hardware.py MACHINE: looks through the sources of that folder for constants whose names speak of caches, lines, pages, of what is
near or far, or of what is fetched ahead, and that are given a number. Each is one of those below, which are no hardware's, or an
error."""
import pathlib
import re
import sys

HERE = {"device/shape.h", "device/costs_by_driver.c"}
OTHER = {
    "AHEAD_TO", "AHEAD_LIST", "AHEAD_ALL",  # flags
    "CACHE_FILES_MOST", "MACHINE_CACHE_FOLDER_MAX",  # of the cache on disk
    "CHUNKS_AHEAD",  # how many there is room for
    "CROSS_NEAR",  # a block of lanes: what a cross may look at before it is in memory
    "LINE_GHOSTS",  # processors of a set with one axis
    "LINE_MOST",  # of text
    "NEAR_SHARED",  # for tests
    "NEAR_ROWS", "FAR_ROWS",  # of what is measured
}
NAMED = re.compile(r"\b((?:[A-Z0-9]+_)*(?:LINE|PAGE|NEAR|FAR|AHEAD|CACHE)(?:_[A-Z0-9]+)*)\s*=\s*([0-9][^,}\n]*)")
DEFINED = re.compile(r"#define\s+((?:[A-Z0-9]+_)*(?:LINE|PAGE|NEAR|FAR|AHEAD|CACHE)(?:_[A-Z0-9]+)*)\s+\(?([0-9]\S*)")
BARE = re.compile(r"aligned_alloc\(\s*[0-9]")


def main():
    folder = pathlib.Path(sys.argv[1])
    wrong, used = [], set()
    for path in sorted(folder.rglob("*.[ch]")):
        name = path.relative_to(folder).as_posix()
        if name in HERE:
            continue
        text = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.DOTALL)
        for match in [*NAMED.finditer(text), *DEFINED.finditer(text)]:
            if match[1] in OTHER:
                used.add(match[1])
            else:
                wrong.append(f"{name}: {match[1]} = {match[2].strip()}")
        wrong += [f"{name}: {match[0]}" for match in BARE.finditer(text)]
    for line in wrong:
        print(f"{line}: a number about hardware stands in device/shape.h, or its name in {__file__}", file=sys.stderr)
    for name in sorted(OTHER - used):
        print(f"{name} is in {__file__}, and nowhere else", file=sys.stderr)
    return 1 if wrong or OTHER != used else 0


sys.exit(main())
