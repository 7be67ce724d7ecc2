#!/usr/bin/env python3
"""Makes the public header, the entry points, the tests' table and the reference page of instructions.tab.

    generate.py header instructions.tab paris.h paris.h.in
    generate.py python instructions.tab OUTPUT SONAME paris.h.in HEADER...
    generate.py entries|tests|tests_floats|integers|fuzz|reference instructions.tab OUTPUT

Each row becomes a list of Function, by a shape of table/*.py; the outputs are so many ways of printing these.
"""
import sys

sys.dont_write_bytecode = True

from table import along_axes, basic, complex, floats, integers, python, router
from table.function import call
from table.fuzz import fuzz

SHAPES = {}
for family in (basic, integers, floats, complex, router, along_axes):
    SHAPES |= family.SHAPES


def read_table(path):
    """[(title, [(row's text, [Function])])]"""
    sections = []
    for number, line in enumerate(open(path), 1):
        line = line.strip()
        if not line or line.startswith("#"):
            continue
        cells = [c.strip() for c in line.split(" | ")]
        try:
            if cells[0] == "section":
                sections.append((cells[1], []))
            elif cells[0] == "call":
                sections[-1][1].append((cells, [call(cells[1], cells[2])]))
            else:
                shape, types, name, op, flags, doc = cells
                sections[-1][1].append((cells, list(SHAPES[shape](types, name, op, flags.split(), doc))))
        except (KeyError, ValueError, IndexError) as error:
            sys.exit(f"{path}:{number}: not a row of the table: {error}")
    names = set()
    for _, rows in sections:
        for _, functions in rows:
            for f in functions:
                if f.name in names:
                    sys.exit(f"{path}: {f.name} is made twice")
                names.add(f.name)
    return sections


def prototype(f):
    if f.params and f.params[0][0] == "":
        return f"{f.result} {f.name} ({f.params[0][1]})"
    return f.prototype()


def header(sections, template):
    out = []
    for title, rows in sections:
        out.append(f"/* ---- {title} ---- */\n")
        for cells, functions in rows:
            out.append(f"/* {functions[0].doc} */" if len(functions) == 1 else
                       f"/* {cells[2] if cells[2] != '-' else cells[0]}: {cells[5]} */")
            out += [f"extern {prototype(f)};" for f in functions]
            out.append("")
    return open(template).read().replace("@PROTOTYPES@", "\n".join(out))


# How an argument becomes a word of a call that the machine may foresee, and back.
WORDS = {t: ("(uint64_t){}", f"({t}){{}}") for t in
         ("CM_field_id_t", "CM_sendaddr_t", "CM_geometry_id_t", "unsigned int", "unsigned long", "long")}
WORDS["double"] = ("paris_word({})", "paris_double({})")
WORDS_MOST = 8  # MACHINE_CALL_WORDS


def foreseeable(f):
    """What it does follows from its arguments alone: see machine_call_foreseen()."""
    return f.result == "void" and len(f.params) <= WORDS_MOST and all(t in WORDS for t, _ in f.params)


def entries(sections):
    out = ["/* Generated from instructions.tab: every entry point that is a row of a family. */",
           '#include "paris_state.h"', ""]
    for _, rows in sections:
        for _, functions in rows:
            for f in functions:
                if not f.body:
                    continue
                body = f.body.rstrip("\n")
                if foreseeable(f):
                    words = [WORDS[t][0].format(n) for t, n in f.params]
                    args = [WORDS[t][1].format(f"call->words[{i}]") for i, (t, _) in enumerate(f.params)]
                    unused = "" if args else "    (void)call;\n"
                    out += [f"static void again_{f.name}(const struct machine_call *call)", "{",
                            f"{unused}    {f.name}({', '.join(args)});", "}", ""]
                    given = f", .words = {{{', '.join(words)}}}" if words else ""
                    body = (f"    struct machine_call call = {{.again = again_{f.name}, .name = \"{f.name}\", "
                            f".words_count = {len(words)}{given}}};\n"
                            f"    if (paris_foreseen(&call))\n        return;\n{body}\n    paris_performed();")
                out += [f.prototype(), "{", body, "}", ""]
    return "\n".join(out)


def tests(sections, of_floats=False):
    """A function that calls each instruction with a struct's members, and a table of them."""
    calls, rows_out = [], []
    for _, rows in sections:
        for _, functions in rows:
            for f in functions:
                shape = f.test.get("shape") or ""
                if not f.body or not (shape.startswith("FLOAT_") if of_floats else shape in basic.TESTED):
                    continue
                t = f.test
                T = t.get("type", "u")

                def member(name):
                    kind = t["type2"] if t["shape"] == "FLOAT_BY_INTEGER" else T
                    return f"t->value_{kind if kind in 'usf' else 'u'}" if name == "value" else f"t->{name}"
                args = ", ".join(member(n) for _, n in f.params)
                result = f"t->result_{'f' if T == 'f' else 'u'} = " if f.result != "void" else ""
                if f.result in ("int", "long"):
                    result += "(uint64_t)"
                unused = "" if f.params or result else "    (void)t;\n"
                calls.append(f"static void call_{f.name}(struct paris_test_args *t)\n{{\n{unused}"
                             f"    {result}{f.name}({args});\n}}")
                rows_out.append(
                    f'    {{"{f.name}", PARIS_TEST_{t["shape"]}, \'{T[0]}\', \'{t.get("type2", "-")}\', '
                    f'"{t["op"]}", {t.get("operands", 0)}, {t.get("lengths", 0)}, {t.get("constant", 0)}, '
                    f'{t.get("zero", 0)}, {int(t["always"])}, \'{t.get("other", "-")}\', call_{f.name}}},')
    return "\n".join(["/* Generated from instructions.tab: every instruction and how to call it. */", *calls, "",
                      "static const struct paris_test_row paris_test_rows[] = {", *rows_out, "};", "",
                      "/* All there are, so that none is declared and not written. */",
                      "static void (*const paris_test_functions[])(void) = {",
                      *(f"    (void (*)(void)){f.name}," for _, rows in sections for _, functions in rows
                        for f in functions), "};", ""])


def integer_tests(sections):
    """The same for the rows of the families of integers.c and bits.c, which test_integers.c takes."""
    calls, rows_out = [], []
    for _, rows in sections:
        for _, functions in rows:
            for f in functions:
                if not f.body or f.test.get("shape") != "INTEGER":
                    continue
                t = f.test
                signed = t.get("type2", t["type"]) == "s"
                args = ", ".join(f"t->value_{'s' if signed else 'u'}" if n == "value" else f"t->{n}"
                                 for _, n in f.params)
                calls.append(f"static void call_{f.name}(const struct integer_args *t)\n{{\n    {f.name}({args});\n}}")
                rows_out.append(f'    {{"{f.name}", "{t["op"]}", \'{t["type"]}\', \'{t.get("type2", "-")}\', '
                                f'{t["operands"]}, {t["lengths"]}, {t.get("constant", 0)}, {int(t["always"])}, '
                                f'call_{f.name}}},')
    return "\n".join(["/* Generated from instructions.tab: the rows of integers.c and bits.c. */", *calls, "",
                      "static const struct integer_row integer_rows[] = {", *rows_out, "};", ""])


NOT_HERE = """
## What is not here

The machine had these instructions, too. They are not provided, because no source that was found shows the order of their arguments
with certainty; a program that calls one does not link.

| instruction | what does the same |
|---|---|
| NEWS with integer or float combiners | `CM_get_from_news_1L` into a field of the stack, and the operation |
| intern-identical-geometry | `CM_intern_geometry`, `CM_intern_detailed_geometry` |
| add with carry, subtract with borrow | fields of up to 128 bits; or `CM_u_add_3_1L`, `CM_store_overflow`, and adding that bit |
| compare | two comparisons, each stored with `CM_store_test` |
| available-memory | nothing: memory ends where the device's does, and an allocation that fails says so |
| send-to-queue32 | `CM_enumerate_1L` and `CM_aset32_2L` |
| aref32 and aset32 in other forms than those above | `CM_aref_2L`, `CM_aset_2L` |
"""


def reference(sections):
    out = ["# Paris, instruction by instruction", "",
           "Generated from `paris_compat/instructions.tab`. Context: an instruction changes dest, test and overflow "
           "only in active processors; `always` forms change dest in all. `constant` is spelt `const` too.", "",
           "Errors, ownership and threads are the same for all. *Errors*: a wrong call has no effect and is explained in one "
           "line to the error handler (`CM_set_error_handler`), which by default prints it and exits; if the handler "
           "returns, so does the call, with 0 in place of an id or a number. *Ownership*: fields, VP sets and geometries "
           "belong to the machine; ids name them until they are deallocated. Arrays and texts that are passed stay the "
           "caller's, and are read or written during the call alone. *Threads*: all calls belong to one thread.", ""]
    for title, rows in sections:
        out += [f"## {title}", ""] + ([along_axes.NOTES[title]] if title in along_axes.NOTES else [])
        for cells, functions in rows:
            if cells[0] == "call":
                out.append(f"- `{cells[1]}`: {cells[2]}")
                continue
            name = cells[2] if cells[2] != "-" else cells[0]
            name = f"scan, spread, multispread, reduce with {name}" if cells[0] == "combine" else name
            note = " Sets overflow." if "overflow" in cells[4].split() else ""
            out += ["", f"### {name}", "", f"{cells[5]}.{note}", ""]
            out += [f"- `{prototype(f)}`" for f in functions if "_const_" not in f.name]
        out.append("")
    return "\n".join(out) + NOT_HERE


def main():
    kind, table, output = sys.argv[1:4]
    sections = read_table(table)
    if kind == "header":
        text = header(sections, sys.argv[4])
    elif kind == "python":
        text = python.names(sections, [open(path, encoding="utf-8").read() for path in sys.argv[5:]], sys.argv[4])
    else:
        text = {"entries": entries, "tests": tests, "tests_floats": lambda all: tests(all, True),
                "integers": integer_tests, "fuzz": fuzz, "reference": reference}[kind](sections)
    with open(output, "w") as out:
        out.write(text)


if __name__ == "__main__":
    main()
