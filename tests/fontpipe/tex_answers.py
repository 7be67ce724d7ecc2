#!/usr/bin/env python3
"""Makes tex_answers.h from TeX's log: each paragraph's demerits, and each line's last piece and badness.

    build/tests/fontpipe/test_tex --tex > paragraphs.tex
    tex -ini paragraphs.tex                                   (INITEX of any TeX; no format and no fonts are needed)
    tests/fontpipe/tex_answers.py paragraphs.log > tests/fontpipe/tex_answers.h
"""
import re
import sys


def ways(trace):
    """The chain of breaks with the fewest demerits: the badness of each line, and the sum of demerits."""
    nodes, group, finals, manners = {}, {}, [], {0: (2, False)}
    at_end = False
    for line in trace:
        via = re.match(r"@(\\\w+)? ?via @@(\d+) b=(\S+) p=(\S+) d=(\S+)", line)
        node = re.match(r"@@(\d+): line \d+\.(\d)(-?) t=(\d+)(?: -> @@(\d+))?", line)
        if via:
            group[int(via[2])] = (via[3], via[5])
            at_end = via[1] == "\\par"
        elif node:
            before = int(node[5] or 0)
            manners[int(node[1])] = (int(node[2]), bool(node[3]))
            nodes[int(node[1])] = (int(node[4]), before, *group[before])
            if at_end:
                finals.append(int(node[1]))
        else:
            group = {}
    best = min(finals, key=lambda n: nodes[n][0])
    demerits, before, b, d = nodes[best]
    if d == "*" and b != "*":  # the only way that is left costs nothing more in TeX: what its last line would
        fitness, hyphen = manners[before]
        demerits += (10 + int(b)) ** 2 + (10000 if abs(fitness - 2) > 1 else 0) + (5000 if hyphen else 0)
    bad = []
    while best:
        _, best, b, d = nodes[best]
        if b == "*" or (d == "*" and bad):
            return 0, []
        bad.insert(0, int(b))
    return demerits, bad


def ends(box):
    """The number in the last box of each line."""
    last = []
    for line in box:
        if line.startswith(".\\hbox("):
            last.append(None)
        number = re.match(r"\.\.\.\\penalty (\d+)", line)
        if number:
            last[-1] = int(number[1])
    return last


def main():
    log = open(sys.argv[1], encoding="latin-1").read()
    parts = re.split(r"PARAGRAPH \d+", log)[1:]
    print("/* tex_answers.h - made by tex_answers.py from what TeX (3.141592653) said of the paragraphs of test_tex.c. */")
    print("/* clang-format off */")
    print("static const struct tex_answer tex_answers[PARAGRAPHS] = {")
    for part in parts:
        trace, box = part.split("> \\box0=")
        demerits, bad = ways(trace.splitlines())
        places = ends(box.splitlines()) if demerits else []
        assert len(places) == len(bad), (places, bad)
        text = "    {%d, %d, {%s}, {%s}}," % (demerits, len(bad), ", ".join(map(str, places or [0])), ", ".join(map(str, bad or [0])))
        print(text)
    print("};")
    print("/* clang-format on */")


main()
