#!/usr/bin/env python3
"""Makes the public header, the entry points, the tests' table and the reference page of instructions.tab.

    generate.py header instructions.tab paris.h paris.h.in
    generate.py entries|tests|reference instructions.tab OUTPUT

Each row becomes a list of Function; the four outputs are four ways of printing these.
"""
import sys
from dataclasses import dataclass, field

FIELD = "CM_field_id_t"
LEN = "unsigned int"
DEST, SOURCE, SOURCE1, SOURCE2 = ((FIELD, n) for n in ("dest", "source", "source1", "source2"))
DLEN, SLEN, SLEN1, SLEN2, AXIS = ((LEN, n) for n in ("dlen", "slen", "slen1", "slen2", "axis"))
SCALAR = {"u": "unsigned long", "s": "long", "f": "double", "": "unsigned long"}
RESULT = {"u": "unsigned int", "s": "int", "f": "double", "": "unsigned int"}
SIGNED = {"MIN": ("UMIN", "SMIN"), "MAX": ("UMAX", "SMAX"), "LT": ("ULT", "SLT"), "LE": ("ULE", "SLE")}


@dataclass
class Function:
    name: str
    params: list                # (type, name)
    doc: str
    body: str = ""              # of the entry point; "" when it is written by hand
    result: str = "void"
    test: dict = field(default_factory=dict)  # what the tests' table says of it

    def prototype(self):
        args = ", ".join(f"{t}{'' if t.endswith('*') else ' '}{n}" for t, n in self.params)
        return f"{self.result}{'' if self.result.endswith('*') else ' '}{self.name} ({args or 'void'})"


def lengths(letter, *names):
    """Length parameters: one a name for integers, s and e for floats (with the name's first letter when several)."""
    if letter != "f":
        return [(LEN, n) for n in names]
    if len(names) == 1:
        return [(LEN, "s"), (LEN, "e")]
    return [(LEN, n[0] + x) for n in names for x in "se"]


def value(letter):
    return (SCALAR[letter], "value")


def operand(letter, name, *length):
    return f"paris_{letter}({name}, {', '.join(length)})"


def constant(letter, name, *length):
    return f"paris_{letter}_constant({name}, {', '.join(length)})"


def length_names(letter, *names):
    return [n for _, n in lengths(letter, *names)]


def self_row(name, op="0", overflow=False, swap=False, always=False):
    scope = "MACHINE_EVERYWHERE" if always else "MACHINE_WHERE_ACTIVE"
    return (f'    static const struct paris_instruction self = {{"{name}", {op}, {int(overflow)}, {int(swap)}, '
            f"{scope}}};\n")


def machine_op(op, letter):
    if letter in "su" and op in SIGNED:
        op = SIGNED[op][letter == "s"]
    return "PARIS_OP_ABS" if op == "ABS" else f"MACHINE_{op}"


def instruction(name, params, doc, action, args, row, flags, always=False, result="void", **test):
    body = self_row(name, row, "overflow" in flags, "swap" in flags, always)
    ret = "return " if result != "void" else ""
    body += f"    {ret}{action}(&self{''.join(', ' + a for a in args)});\n"
    test["always"] = always
    return Function(name, params, doc, body, result, test)


def mid(always):
    return "_always" if always else ""


CONSTANTS = ("_constant", "_const")


def binary(types, name, op, flags, doc):
    for T in types:
        row = machine_op(op, T)
        L = length_names(T, "len")
        for always in (False, True):
            def make(suffix, const, params, args, **test):
                return instruction(f"CM_{T}_{name}{const}{mid(always)}_{suffix}", params, doc, "paris_binary",
                                   args, row, flags, always, shape="BINARY", type=T, op=name, **test)

            d = operand(T, "dest", *L)
            yield make("2_1L", "", [DEST, SOURCE] + lengths(T, "len"),
                       [d, d, operand(T, "source", *L)], operands=2, lengths=1)
            yield make("3_1L", "", [DEST, SOURCE1, SOURCE2] + lengths(T, "len"),
                       [d, operand(T, "source1", *L), operand(T, "source2", *L)], operands=3, lengths=1)
            for const in CONSTANTS:
                c = constant(T, "value", *L)
                yield make("2_1L", const, [DEST, value(T)] + lengths(T, "len"),
                           [d, d, c], operands=2, lengths=1, constant=1)
                yield make("3_1L", const, [DEST, SOURCE, value(T)]
                           + lengths(T, "len"), [d, operand(T, "source", *L), c], operands=3, lengths=1, constant=1)
                if T != "f":
                    yield make("3_2L", const, [DEST, SOURCE, value(T),
                                               DLEN, SLEN],
                               [operand(T, "dest", "dlen"), operand(T, "source", "slen"),
                                constant(T, "value", "slen")], operands=3, lengths=2, constant=1)
            if T != "f":
                d = operand(T, "dest", "dlen")
                yield make("2_2L", "", [DEST, SOURCE, DLEN, SLEN],
                           [d, d, operand(T, "source", "slen")], operands=2, lengths=2)
                yield make("3_3L", "", [DEST, SOURCE1, SOURCE2, DLEN,
                                        SLEN1, SLEN2],
                           [d, operand(T, "source1", "slen1"), operand(T, "source2", "slen2")],
                           operands=3, lengths=3)


def unary(types, name, op, flags, doc):
    for T in types:
        row = machine_op(op, T)
        L = length_names(T, "len")
        for always in (False, True):
            def make(suffix, params, args, **test):
                return instruction(f"CM_{T}_{name}{mid(always)}_{suffix}", params, doc, "paris_unary", args, row,
                                   flags, always, shape="UNARY", type=T, op=name, **test)

            d = operand(T, "dest", *L)
            yield make("1_1L", [DEST] + lengths(T, "len"), [d, d], operands=1, lengths=1)
            yield make("2_1L", [DEST, SOURCE] + lengths(T, "len"),
                       [d, operand(T, "source", *L)], operands=2, lengths=1)
            if T != "f":
                yield make("2_2L", [DEST, SOURCE, DLEN, SLEN],
                           [operand(T, "dest", "dlen"), operand(T, "source", "slen")], operands=2, lengths=2)


def compare(types, name, op, flags, doc):
    for T in types:
        row = machine_op(op, T)
        L = length_names(T, "len")

        def make(suffix, params, args, **test):
            return instruction(f"CM_{T}_{name}_{suffix}", params, doc, "paris_compare", args, row, flags,
                               shape="COMPARE", type=T, op=name, **test)

        a = operand(T, "source1", *L)
        yield make("1L", [SOURCE1, SOURCE2] + lengths(T, "len"),
                   [a, operand(T, "source2", *L)], operands=2, lengths=1)
        if T != "f":
            yield make("2L", [SOURCE1, SOURCE2, SLEN1, SLEN2],
                       [operand(T, "source1", "slen1"), operand(T, "source2", "slen2")], operands=2, lengths=2)
        for const in ("constant", "const"):
            yield make(f"{const}_1L", [SOURCE, value(T)] + lengths(T, "len"),
                       [operand(T, "source", *L), constant(T, "value", *L)], operands=2, lengths=1, constant=1)
        yield make("zero_1L", [SOURCE] + lengths(T, "len"),
                   [operand(T, "source", *L), constant(T, "0", *L)], operands=2, lengths=1, zero=1)


def move(types, name, op, flags, doc):
    for T in types:
        L = length_names(T, "len")
        for always in (False, True):
            def make(form, params, args, action="paris_move", **test):
                return instruction(f"CM_{T}_{name}{form}", params, doc, action, args, "0", flags, always,
                                   shape="MOVE", type=T, op=name, **test)

            a = mid(always)
            d = operand(T, "dest", *L)
            yield make(f"{a}_1L", [DEST, SOURCE] + lengths(T, "len"),
                       [d, operand(T, "source", *L)], operands=2, lengths=1)
            yield make(f"{a}_2L", [DEST, SOURCE] + lengths(T, "dlen", "slen"),
                       [operand(T, "dest", *length_names(T, "dlen", "slen")[:len(L)]),
                        operand(T, "source", *length_names(T, "dlen", "slen")[len(L):])], operands=2, lengths=2)
            for const in CONSTANTS:
                yield make(f"{const}{a}_1L", [DEST, value(T)] + lengths(T, "len"),
                           [d, constant(T, "value", *L)], operands=2, lengths=1, constant=1)
            yield make(f"_zero{a}_1L", [DEST] + lengths(T, "len"), [d, constant(T, "0", *L)],
                       operands=2, lengths=1, zero=1)


def convert(types, name, op, flags, doc):
    D, S = types
    row = "0" if op == "FLOAT" else f"MACHINE_{op}"
    dl = ["s", "e"] if D == "f" else ["dlen"]
    sl = ["s", "e"] if S == "f" else ["slen"]
    params = [DEST, SOURCE] + [(LEN, n) for n in (sl + dl if D == "f" else dl + sl)]
    for always in (False, True):
        yield instruction(f"CM_{name}{mid(always)}_2_2L", params, doc,
                          "paris_to_float" if D == "f" else "paris_to_bits",
                          [operand(D, "dest", *dl), operand(S, "source", *sl)], row, flags, always,
                          shape="CONVERT", type=D, type2=S, op=name, operands=2, lengths=2)


TRUTH = {}


def logical(_, name, op, flags, doc):
    TRUTH[name] = op
    for always in (False, True):
        def make(suffix, const, params, args, **test):
            return instruction(f"CM_{name}{const}{mid(always)}_{suffix}", params, doc, "paris_logical", args,
                               f"0x{int(op, 2):x}", flags, always, shape="LOGICAL", type="b", op=name, **test)

        d = operand("b", "dest", "len")
        yield make("2_1L", "", [DEST, SOURCE, (LEN, "len")],
                   [d, d, operand("b", "source", "len")], operands=2, lengths=1)
        yield make("3_1L", "", [DEST, SOURCE1, SOURCE2, (LEN, "len")],
                   [d, operand("b", "source1", "len"), operand("b", "source2", "len")], operands=3, lengths=1)
        for const in CONSTANTS:
            c = constant("b", "value", "len")
            yield make("2_1L", const, [DEST, value("u"), (LEN, "len")], [d, d, c],
                       operands=2, lengths=1, constant=1)
            yield make("3_1L", const, [DEST, SOURCE, value("u"), (LEN, "len")],
                       [d, operand("b", "source", "len"), c], operands=3, lengths=1, constant=1)


def complement(_, name, op, flags, doc):
    for always in (False, True):
        for n, source in ((1, "dest"), (2, "source")):
            s = operand("b", source, "len")
            yield instruction(f"CM_{name}{mid(always)}_{n}_1L",
                              [DEST, SOURCE][:n] + [(LEN, "len")], doc, "paris_logical",
                              [operand("b", "dest", "len"), s, s], "0xc", flags, always, shape="LOGICAL",
                              type="b", op=name, operands=n, lengths=1)


FLAGS = ("context", "test", "overflow")


def flag(_, name, op, flags, doc):
    """The context's operations are unconditional; those of test and overflow have an always form."""
    F = f"MACHINE_{op}"
    for always in (True,) if name == "context" else (False, True):
        a = "" if name == "context" else mid(always)

        def make(fname, params, what, action, args, row="0", **test):
            return instruction(fname, params, what, action, [F] + args, row, flags, always, shape="FLAG",
                               type=name[0], **test)

        for verb, bit in (("set", 1), ("clear", 0)):
            yield make(f"CM_{verb}_{name}{a}", [], f"{name} = {bit}", "paris_flag_constant", [str(bit)],
                       op=verb)
        yield make(f"CM_invert_{name}{a}", [], f"{name} = not {name}", "paris_flag_logical_flag", [F], "0xc",
                   op="invert")
        yield make(f"CM_load_{name}{a}", [SOURCE], f"{name} = source, one bit", "paris_flag_load",
                   ["source"], op="load", operands=1)
        yield make(f"CM_store_{name}{a}", [DEST], f"dest, one bit, = {name}", "paris_flag_store",
                   ["dest"], op="store", operands=1)
        for lop, truth in TRUTH.items():
            row = f"0x{int(truth, 2):x}"
            yield make(f"CM_{lop}_{name}{a}", [SOURCE], f"{name} = {name} {lop} source, one bit",
                       "paris_flag_logical_field", ["source"], row, op=lop, operands=1)
            for other in FLAGS:
                if other != name:
                    yield make(f"CM_{lop}_{name}_with_{other}{a}", [], f"{name} = {name} {lop} {other}",
                               "paris_flag_logical_flag", [f"MACHINE_{other.upper()}"], row, op=lop,
                               other=other[0])


def spellings(name):
    """The name, and the older spelling without its _1L."""
    return (name, name[:-3])


def news(_, name, op, flags, doc):
    for always in (False, True):
        for fname in spellings(f"CM_{name}{mid(always)}_1L"):
            yield instruction(fname, [DEST, SOURCE, AXIS, (LEN, "direction"),
                                      (LEN, "len")], doc, "paris_news",
                              ["dest", "source", "axis", "direction", "len"], f"PARIS_NEWS_{op}", flags, always,
                              shape="NEWS", op=name, operands=2)


def own(_, name, op, flags, doc):
    for always in (False, True):
        for fname in spellings(f"CM_{name}{mid(always)}_1L"):
            yield instruction(fname, [DEST, AXIS, (LEN, "len")], doc, "paris_my_coordinate",
                              ["dest", "axis", "len"], "0", flags, always, shape="OWN", op=name, operands=1)


def processor(types, name, op, flags, doc):
    address = ("CM_sendaddr_t", "send_address")
    for T in types:
        L = length_names(T, "len")
        for fname in spellings(f"CM_{T}_write_to_processor_1L"):
            yield instruction(fname, [address, DEST, value(T)] + lengths(T, "len"), doc,
                              "paris_processor_write",
                              ["send_address", operand(T, "dest", *L), constant(T, "value", *L)], "0", flags,
                              shape="PROCESSOR", type=T, op="write")
        reads = [(n, RESULT[T]) for n in spellings(f"CM_{T}_read_from_processor_1L")]
        if T != "f":
            reads.append((f"CM_{T}_read_from_processor_long_1L", SCALAR[T]))
        for fname, result in reads:
            yield instruction(fname, [address, SOURCE] + lengths(T, "len"), doc,
                              f"({result}) paris_processor_read_{T}",
                              ["send_address", operand(T, "source", *L)], str(int("long" in result)), flags,
                              result=result, shape="PROCESSOR", type=T, op="read")


def newsarray(types, name, op, flags, doc):
    vectors = [("CM_vector_t", f"{v}_vector") for v in ("offset", "start", "end", "axis")]
    for T in types:
        L = length_names(T, "len")
        for verb, array, where in (("write_to", "const void *", "dest"), ("read_from", "void *", "source")):
            for fname in spellings(f"CM_{T}_{verb}_news_array_1L"):
                yield instruction(
                    fname, [(array, "array")] + vectors + [(FIELD, where)] + lengths(T, "len")
                    + [(LEN, "rank"), ("CM_vector_t", "dimension_vector"), (LEN, "format")], doc,
                    f"paris_array_{verb.split('_')[0]}",
                    ["array", "PARIS_BLOCK", operand(T, where, *L)], "0", flags, shape="ARRAY", type=T,
                    op=verb.split("_")[0])


def reduction(types, name, op, flags, doc):
    for T in types:
        letter = "" if T == "-" else T
        kind = letter or "b"
        L = length_names(kind, "len")
        prefix = f"CM_global_{letter + '_' if letter else ''}{name}"
        row = machine_op(op, kind).replace("MACHINE_", "MACHINE_REDUCE_")
        forms = [(n, RESULT[letter]) for n in spellings(f"{prefix}_1L")]
        if T != "f":
            forms.append((f"{prefix}_long_1L", SCALAR[letter]))
        for fname, result in forms:
            yield instruction(fname, [SOURCE] + lengths(kind, "len"), doc,
                              f"({result}) paris_global_{kind}", [operand(kind, "source", *L)], row, flags,
                              result=result, shape="GLOBAL", type=kind, op=name, operands=1,
                              lengths=2 if "long" in result else 1)


def globalflag(_, name, op, flags, doc):
    for what, result, action in (("count", "unsigned int", "paris_global_count"),
                                 ("logior", "int", "paris_global_any"), ("logand", "int", "paris_global_all")):
        text = {"count": "how many have a 1", "logior": "1 if one has a 1", "logand": "1 if all have"}[what]
        yield instruction(f"CM_global_{what}_{name}", [], f"{name} {doc}: {text}", action, [f"MACHINE_{op}"],
                          "0", flags, name == "context", result, shape="GLOBALFLAG", type=name[0], op=what)


# ---- along axes ----

NOTES = {"Scans, spreads, reductions, ranks": """\
Inactive processors neither take part nor change; overflow stays as it is. A *scan* gives each active processor the
combination of those from the beginning of its segment to itself (`CM_inclusive`) or before it (`CM_exclusive`: the
operation's identity in the first), along the axis, `CM_upward` or `CM_downward`. `CM_none`: a line is one segment.
`CM_start_bit`: one begins where an active processor's sbit is 1, in the direction of the scan. `CM_segment_bit`: a
1, in an inactive processor too, marks the segment's processor of least coordinate, in both directions. A *spread*
gives all active processors on a line the combination of them all, a *multispread* all that differ only on the axes
of the mask (bit 0: axis 0), a *reduction* the one with to_coordinate, if it is active. *Ranks* with segments are
absolute: the segment's first coordinate plus the rank in it. dest may be the source. Floats are added and multiplied
in a fixed order: one after the other in runs of 512 processors, and then these results, as machine.h says in full.
"""}

SCAN = [(LEN, n) for n in ("direction", "inclusion", "smode")] + [(FIELD, "sbit")]
SCAN_ARGS = ["direction, inclusion, smode, sbit"]


def combine(types, name, op, flags, doc):
    for T in types:
        floats = T in "fc"
        L = length_names("f" if floats else T, "len")
        lens = lengths("f" if floats else T, "len")
        letter = "f" if floats else T
        row = "MACHINE_SCAN_" + machine_op(op, T).removeprefix("MACHINE_")
        d, a = operand(letter, "dest", *L), operand(letter, "source", *L)
        parts = "2" if T == "c" else "1"

        def make(verb, params, action, args):
            fname = f"CM_{verb}_with_{'' if T == 'b' else T + '_'}{name}"
            for spelling in spellings(fname + "_1L"):
                yield instruction(spelling, params, doc, action, [parts, d, a] + args, row, flags, shape=None)

        copies = op == "COPY"
        yield from make("scan", [DEST, SOURCE, AXIS] + lens + SCAN, "paris_scan", ["axis"] + SCAN_ARGS)
        yield from make("spread", [DEST, SOURCE, AXIS] + lens + ([(LEN, "coordinate")] if copies else []),
                        "paris_spread", ["axis", "coordinate" if copies else "0"])
        yield from make("reduce", [DEST, SOURCE, AXIS] + lens + [(LEN, "to_coordinate")]
                        + ([(LEN, "from_coordinate")] if copies else []),
                        "paris_reduce", ["axis, to_coordinate", "from_coordinate" if copies else "0"])
        if not copies:
            yield from make("multispread", [DEST, SOURCE, (LEN, "axis_mask")] + lens, "paris_multispread",
                            ["axis_mask"])


def rank(types, name, op, flags, doc):
    for T in types:
        L, lens = (["s", "e"], lengths("f", "len")) if T == "f" else (["slen"], [SLEN])
        for fname in (f"CM_{T}_{name}_2L", f"CM_{T}_{name}"):
            yield instruction(fname, [DEST, SOURCE, AXIS, DLEN] + lens + [(LEN, "direction"), (LEN, "smode"),
                                                                          (FIELD, "sbit")],
                              doc, "paris_rank", ["paris_u(dest, dlen)", operand(T, "source", *L),
                                                  "axis, direction, smode, sbit"], "0", flags, shape=None)


def call(prototype, doc):
    head, args = prototype.split(" (", 1)
    result, name = head.rsplit(" ", 1)
    return Function(name, [("", args[:-1])], doc, "", result)


SHAPES = {"binary": binary, "unary": unary, "compare": compare, "move": move, "convert": convert,
          "logical": logical, "not": complement, "flag": flag, "news": news, "own": own, "processor": processor,
          "newsarray": newsarray, "global": reduction, "globalflag": globalflag,
          "combine": combine, "rank": rank}


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


def entries(sections):
    out = ["/* Generated from instructions.tab: every entry point that is a row of a family. */",
           '#include "paris_state.h"', ""]
    for _, rows in sections:
        for _, functions in rows:
            for f in functions:
                if f.body:
                    out += [f.prototype(), "{", f.body.rstrip("\n"), "}", ""]
    return "\n".join(out)


def tests(sections):
    """A function that calls each instruction with a struct's members, and a table of them."""
    calls, rows_out = [], []
    for _, rows in sections:
        for _, functions in rows:
            for f in functions:
                if not f.body or f.test["shape"] in ("PROCESSOR", "ARRAY", None):
                    continue
                t = f.test
                T = t.get("type", "u")

                def member(name):
                    return f"t->value_{T if T in 'usf' else 'u'}" if name == "value" else f"t->{name}"
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


def reference(sections):
    out = ["# Paris, instruction by instruction", "",
           "Generated from `paris_compat/instructions.tab`. Context: an instruction changes dest, test and overflow "
           "only in active processors; `always` forms change dest in all. `constant` is spelt `const` too.", ""]
    for title, rows in sections:
        out += [f"## {title}", ""] + ([NOTES[title]] if title in NOTES else [])
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
    return "\n".join(out)


def main():
    kind, table, output = sys.argv[1:4]
    sections = read_table(table)
    if kind == "header":
        text = header(sections, sys.argv[4])
    else:
        text = {"entries": entries, "tests": tests, "reference": reference}[kind](sections)
    with open(output, "w") as out:
        out.write(text)


if __name__ == "__main__":
    main()
