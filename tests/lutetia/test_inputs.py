"""test_inputs.py LUTETIA [all]: whatever a verb reads, a pipe, a device, a folder or a socket in its place is refused at once, in one line.

Each row has a pipe and one of the others, or all. The verbs and options are those of the command's own table, so that a new one cannot be forgotten (verbs.py). (security.md 6)
"""
import os
import pathlib
import re
import socket
import subprocess
import sys
import tempfile
import time

import verbs

SECONDS = 150  # of a busy machine: what waits, waits for ever
BAD = re.compile(rb"[\x00-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\xa8-\xae]")


def kinds_make(at):
    """Names of what is no file: each also with the ending of a script, by which maps are told apart."""
    for end in ("", ".lua", ".c"):
        os.mkfifo(at / ("pipe" + end))
        (at / ("folder" + end)).mkdir()
        listener = socket.socket(socket.AF_UNIX)
        listener.bind(str(at / ("socket" + end)))
        os.symlink("/dev/zero", at / ("zero" + end))
    return ["./pipe", "./folder", "./socket", "./zero"]


def tried(lutetia, at, words, name):
    """What is wrong; None: nothing."""
    line = [lutetia, *(re.sub("@(?!@)", name, word) for word in words)]
    began = time.monotonic()
    try:
        done = subprocess.run(line, cwd=at, stdin=subprocess.DEVNULL, capture_output=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return "%s: still there after %d s" % (line[1:], SECONDS)
    said = done.stderr
    if done.returncode not in (1, 2) or said.count(b"\n") != 1 or BAD.search(said):
        return "%s: status %d after %.1f s, and it said: %r" % (line[1:], done.returncode, time.monotonic() - began, said)
    if name.strip("./").encode() not in said:
        return "%s: does not name what is wrong: %r" % (line[1:], said)
    return None


def main():
    lutetia = os.path.abspath(sys.argv[1])
    wrong = ["no row of verbs.py tries %s" % what for what in verbs.forgotten(lutetia)]
    count = 0
    with tempfile.TemporaryDirectory(prefix="lutetia-inputs-") as folder:
        at = pathlib.Path(folder)
        verbs.files_make(at)
        pipe, *others = kinds_make(at)
        for row, (_, _, words) in enumerate(verbs.INPUTS):
            for name in [pipe, *others] if sys.argv[2:] == ["all"] else [pipe, others[row % len(others)]]:
                wrong.append(tried(lutetia, at, words, name))
                count += 1
        left = sorted(path.name for path in at.iterdir() if path.name.startswith((".", "o.")))
        wrong += ["%s was left" % name for name in left]
    wrong = [line for line in wrong if line]
    print("\n".join(wrong + ["%d tried, %d wrong" % (count, len(wrong))]))
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
