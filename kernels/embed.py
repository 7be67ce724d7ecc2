"""embed.py [--prefix=PREFIX] OUT.c OUT.h FILE…: writes text files as C arrays, `PREFIX<name>_<ending>[]` (of kernels:
`kernel_<name>_cl[]`), zero-terminated.

Bytes rather than string literals: compilers need only take literals of 4095 characters.
"""
import pathlib
import re
import sys


def array(name, data):
    lines = ["const char %s[%d] = {" % (name, len(data) + 1)]
    for at in range(0, len(data), 16):
        lines.append("    " + " ".join("%d," % byte for byte in data[at:at + 16]))
    lines.append("    0};\n")
    return "\n".join(lines)


def main(out_c, out_h, *kernels, prefix="kernel_"):
    header = ["/* Made by embed.py. */", "#pragma once"]
    source = ['#include "%s"\n' % pathlib.Path(out_h).name]
    for kernel in sorted(map(pathlib.Path, kernels), key=lambda path: path.name):
        data = kernel.read_bytes()
        wrong = [byte for byte in data if byte == 0 or byte > 126]
        if wrong:
            sys.exit("%s: byte %d: what is embedded is plain ASCII" % (kernel, wrong[0]))
        name = prefix + re.sub(r"\W", "_", kernel.name)
        header.append("extern const char %s[%d];" % (name, len(data) + 1))
        source.append(array(name, data))
    if not kernels:
        source.append("extern const char kernel_none[1];\nconst char kernel_none[1] = {0};")
    pathlib.Path(out_h).write_text("\n".join(header) + "\n")
    pathlib.Path(out_c).write_text("\n".join(source) + "\n")


arguments = sys.argv[1:]
if arguments and arguments[0].startswith("--prefix="):
    main(*arguments[1:], prefix=arguments[0].removeprefix("--prefix="))
else:
    main(*arguments)
