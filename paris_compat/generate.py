#!/usr/bin/env python3
"""Makes the public header, the entry points, the tests' table and the reference page of instructions.tab.

    generate.py header instructions.tab paris.h paris.h.in
    generate.py entries|tests|tests_floats|integers|fuzz|reference instructions.tab OUTPUT

Each row becomes a list of Function; the outputs are so many ways of printing these.
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


# ---- complex numbers: see complex.c. Constants are two doubles, the real part first. ----

C_LENGTHS = [(LEN, "s"), (LEN, "e")]
C_VALUE = [("double", "value_real"), ("double", "value_imag")]


def c_operand(name, s="s", e="e"):
    return f"paris_c({name}, {s}, {e})"


C_CONSTANT = "paris_c_constant(value_real, value_imag, s, e)"
C_ZERO = "paris_c_constant(0, 0, s, e)"


def c_make(name, params, doc, action, args, op, flags, always=False, result="void"):
    return instruction(name, params, doc, action, args, op, flags, always, result, shape="COMPLEX", type="c", op=op)


def cbinary(_, name, op, flags, doc):
    row = f"PARIS_C_{op}"
    for always in (False, True):
        def make(suffix, const, params, args):
            return c_make(f"CM_c_{name}{const}{mid(always)}_{suffix}", params + C_LENGTHS, doc,
                          "paris_complex_binary", args, row, flags, always)

        d = c_operand("dest")
        yield make("2_1L", "", [DEST, SOURCE], [d, d, c_operand("source")])
        yield make("3_1L", "", [DEST, SOURCE1, SOURCE2], [d, c_operand("source1"), c_operand("source2")])
        for const in CONSTANTS:
            yield make("2_1L", const, [DEST] + C_VALUE, [d, d, C_CONSTANT])
            yield make("3_1L", const, [DEST, SOURCE] + C_VALUE, [d, c_operand("source"), C_CONSTANT])


def cunary(_, name, op, flags, doc):
    for always in (False, True):
        d = c_operand("dest")
        for n, source in ((1, "dest"), (2, "source")):
            yield c_make(f"CM_c_{name}{mid(always)}_{n}_1L", [DEST, SOURCE][:n] + C_LENGTHS, doc,
                         "paris_complex_unary", [d, c_operand(source)], f"PARIS_C_{op}", flags, always)


def ccompare(_, name, op, flags, doc):
    def make(suffix, params, b):
        a = "source1" if params[0] == SOURCE1 else "source"
        return c_make(f"CM_c_{name}_{suffix}", params + C_LENGTHS, doc, "paris_complex_compare",
                      [c_operand(a), b], f"PARIS_C_{op}", flags)

    yield make("1L", [SOURCE1, SOURCE2], c_operand("source2"))
    for const in CONSTANTS:
        yield make(f"{const[1:]}_1L", [SOURCE] + C_VALUE, C_CONSTANT)
    yield make("zero_1L", [SOURCE], C_ZERO)


def cmove(_, name, op, flags, doc):
    for always in (False, True):
        def make(form, params, args):
            return c_make(f"CM_c_{name}{form}", params, doc, "paris_complex_move", args, "PARIS_C_MOVE", flags, always)

        a, d = mid(always), c_operand("dest")
        yield make(f"{a}_1L", [DEST, SOURCE] + C_LENGTHS, [d, c_operand("source")])
        yield make(f"{a}_2L", [DEST, SOURCE] + lengths("f", "dlen", "slen"),
                   [c_operand("dest", "ds", "de"), c_operand("source", "ss", "se")])
        for const in CONSTANTS:
            yield make(f"{const}{a}_1L", [DEST] + C_VALUE + C_LENGTHS, [d, C_CONSTANT])
        yield make(f"_zero{a}_1L", [DEST] + C_LENGTHS, [d, C_ZERO])


def cpower(types, name, op, flags, doc):
    for T in types:
        L = ["s", "e"] if T == "f" else ["slen"]
        both = C_LENGTHS if T == "f" else [(LEN, "slen")] + C_LENGTHS
        n = 1 if T == "f" else 2
        for always in (False, True):
            def make(suffix, const, params, args):
                return c_make(f"CM_c_{T}_{name}{const}{mid(always)}_{suffix}", params, doc,
                              "paris_complex_raise", args, f"PARIS_C_{op}", flags, always)

            d = c_operand("dest")
            yield make(f"2_{n}L", "", [DEST, SOURCE] + both, [d, d, operand(T, "source", *L)])
            yield make(f"3_{n}L", "", [DEST, SOURCE1, SOURCE2] + both,
                       [d, c_operand("source1"), operand(T, "source2", *L)])
            for const in CONSTANTS:
                c = constant(T, "value", *(L if T == "f" else ["64"]))
                yield make("2_1L", const, [DEST, value(T)] + C_LENGTHS, [d, d, c])
                yield make("3_1L", const, [DEST, SOURCE, value(T)] + C_LENGTHS, [d, c_operand("source"), c])


def cpart(_, name, op, flags, doc):
    for always in (False, True):
        yield c_make(f"CM_f_c_{name}{mid(always)}_2_1L", [DEST, SOURCE] + C_LENGTHS, doc, "paris_complex_to_float",
                     [operand("f", "dest", "s", "e"), c_operand("source")], f"PARIS_C_{op}", flags, always)


def cangle(_, name, op, flags, doc):
    for always in (False, True):
        yield c_make(f"CM_c_f_{name}{mid(always)}_2_1L", [DEST, SOURCE] + C_LENGTHS, doc, "paris_complex_of_angle",
                     [c_operand("dest"), operand("f", "source", "s", "e")], "0", flags, always)


def cfrontend(_, name, op, flags, doc):
    address = ("CM_sendaddr_t", "send_address")
    vectors = [("CM_vector_t", f"{v}_vector") for v in ("offset", "start", "end", "axis")]
    rest = C_LENGTHS + [(LEN, "rank"), ("CM_vector_t", "dimension_vector"), (LEN, "format")]
    forms = [("CM_c_write_to_processor_1L", [address, DEST] + C_VALUE + C_LENGTHS, "paris_complex_write",
              ["send_address", c_operand("dest"), C_CONSTANT], "void"),
             ("CM_c_read_from_processor_1L", [address, SOURCE] + C_LENGTHS, "paris_complex_read",
              ["send_address", c_operand("source")], "CM_complex_t"),
             ("CM_global_c_add_1L", [SOURCE] + C_LENGTHS, "paris_complex_global_add", [c_operand("source")],
              "CM_complex_t"),
             ("CM_c_write_to_news_array_1L", [("const void *", "array")] + vectors + [DEST] + rest,
              "paris_complex_array_write", ["array", "PARIS_BLOCK", c_operand("dest")], "void"),
             ("CM_c_read_from_news_array_1L", [("void *", "array")] + vectors + [SOURCE] + rest,
              "paris_complex_array_read", ["array", "PARIS_BLOCK", c_operand("source")], "void")]
    for form, params, action, args, result in forms:
        for fname in spellings(form):
            yield c_make(fname, params, doc, action, args, "MACHINE_REDUCE_FADD" if "global" in form else "0",
                         flags, False, result)
    for verb in ("get_from", "send_to"):
        for always in (False, True):
            yield c_make(f"CM_c_{verb}_news{mid(always)}_1L",
                         [DEST, SOURCE, AXIS, (LEN, "direction")] + C_LENGTHS, doc, "paris_news",
                         ["dest", "source", "axis", "direction", "2 * (s + e + 1)"],
                         f"PARIS_NEWS_{verb.split('_')[0].upper()}", flags, always)


COMPLEX_SHAPES = {"cbinary": cbinary, "cunary": cunary, "ccompare": ccompare, "cmove": cmove, "cpower": cpower,
                  "cpart": cpart, "cangle": cangle, "cfrontend": cfrontend}
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
# ---- the router, aliases, coordinates ----

ADDRESS = (FIELD, "send_address")
GEOMETRY = ("CM_geometry_id_t", "geometry")


def send(types, name, op, flags, doc):
    for T in types:
        letter = "" if T == "-" else T
        kind = letter or "b"
        L = length_names(kind, "len")
        row = f"MACHINE_COMBINE_{op if op not in ('MIN', 'MAX', 'ADD') else machine_op(op, kind)[8:]}"
        if kind == "f":
            row = f"MACHINE_COMBINE_F{op}"
        stem = name if not letter else name.replace("with_", f"with_{letter}_")
        for fname in spellings(f"CM_{stem}_1L"):
            yield instruction(fname, [DEST, ADDRESS, SOURCE] + lengths(kind, "len") + [(FIELD, "notify")], doc,
                              "paris_send", [operand(kind, "dest", *L), "send_address",
                                             operand(kind, "source", *L), "notify"], row, flags,
                              shape="SEND", type=kind, op=op.lower(), operands=2)


def get(_, name, op, flags, doc):
    for fname in spellings(f"CM_{name}_1L"):
        yield instruction(fname, [DEST, ADDRESS, SOURCE, (LEN, "len")], doc, "paris_get",
                          ["dest", "send_address", "source", "len"], "0", flags, shape="GET", type="b", op="get",
                          operands=2)


def powertwo(_, name, op, flags, doc):
    for always in (False, True):
        for fname in spellings(f"CM_{name}{mid(always)}_1L"):
            yield instruction(fname, [DEST, SOURCE, AXIS, (LEN, "log2_distance"), (LEN, "direction"),
                                      (LEN, "len")], doc, "paris_power_two",
                              ["dest", "source", "axis", "log2_distance", "direction", "len"], "0", flags, always,
                              shape="POWERTWO", type="b", op="power_two", operands=2)


def crossmove(_, name, op, flags, doc):
    for always in (False, True):
        for fname in spellings(f"CM_{name}{mid(always)}_1L"):
            yield instruction(fname, [DEST, SOURCE, (LEN, "len")], doc, "paris_cross_move",
                              ["dest", "source", "len"], "0", flags, always, shape="CROSSMOVE", type="b", op="cross",
                              operands=2)


def coordinate(_, name, op, flags, doc):
    """make, deposit (in place, also with a number) and extract: of the geometry, by active processors."""
    forms = {"MAKE": [("coordinate_1L", (FIELD, "coordinate"), (LEN, "slen"), "0")],
             "DEPOSIT": [("coordinate_1L", (FIELD, "coordinate"), (LEN, "slen"), "0"),
                         ("constant_1L", (LEN, "value"), (LEN, "slen"), "1")],
             "EXTRACT": [("coordinate_1L", ADDRESS, (LEN, "dlen"), "0")]}
    for suffix, source, length, constant in forms[op]:
        for always in (False, True):
            base, one = suffix.rsplit("_", 1)
            yield instruction(f"CM_{name}_{base}{mid(always)}_{one}", [GEOMETRY, DEST, AXIS, source, length], doc,
                              f"paris_coordinate_{op.lower()}",
                              ["geometry", "dest", "axis", source[1], length[1]], constant, flags, always,
                              shape="COORDINATE", type="u", op=op.lower(), operands=2)


def call(prototype, doc):
    head, args = prototype.split(" (", 1)
    result, name = head.rsplit(" ", 1)
    return Function(name, [("", args[:-1])], doc, "", result)


# ---- floats: families of their own, tested by tests/paris/test_floats.c from a table of their own ----


def in_float_table(functions, shape):
    for f in functions:
        f.test["shape"] = shape
        yield f


def float_unary(types, name, op, flags, doc):
    return in_float_table(unary(types, name, op, flags, doc), "FLOAT_UNARY")


def float_binary(types, name, op, flags, doc):
    return in_float_table(binary(types, name, op, flags, doc), "FLOAT_BINARY")


def float_function(name, params, doc, action, args, row, flags, always, shape, **test):
    return instruction(name, params, doc, action, args, row, flags, always, shape=f"FLOAT_{shape}", **test)


F = [(LEN, "s"), (LEN, "e")]
FLOAT_DEST, FLOAT_SOURCE = ("paris_f(dest, s, e)", "paris_f(source, s, e)")


def float_by_integer(types, name, op, flags, doc):
    """CM_f_T_name: dest = source1 op source2, the latter an integer of type T."""
    for T in types:
        for always in (False, True):
            def make(suffix, const, params, args, **test):
                return float_function(f"CM_f_{T}_{name}{const}{mid(always)}_{suffix}", params + F, doc,
                                      "paris_float_by_integer", args, f"MACHINE_{op}", flags, always,
                                      "BY_INTEGER", type="f", type2=T, op=name, **test)

            yield make("2_2L", "", [DEST, SOURCE, SLEN],
                       [FLOAT_DEST, FLOAT_DEST, operand(T, "source", "slen")], operands=2, lengths=2)
            yield make("3_2L", "", [DEST, SOURCE1, SOURCE2, SLEN2],
                       [FLOAT_DEST, "paris_f(source1, s, e)", operand(T, "source2", "slen2")],
                       operands=3, lengths=2)
            for const in CONSTANTS:
                c = constant(T, "value", "64")
                yield make("2_1L", const, [DEST, value(T)], [FLOAT_DEST, FLOAT_DEST, c],
                           operands=2, lengths=1, constant=1)
                yield make("3_1L", const, [DEST, SOURCE, value(T)], [FLOAT_DEST, FLOAT_SOURCE, c],
                           operands=3, lengths=1, constant=1)


def float_pair(_, name, op, flags, doc):
    """CM_f_name_1L and its const forms: name is two operations, such as mult_add, on three sources."""
    first, second = name.split("_")
    for always in (False, True):
        for const in CONSTANTS:
            for c2 in ("", const):
                for c3 in ("", const):
                    if not c2 and not c3 and const != CONSTANTS[0]:
                        continue
                    values = [("double", "source2_value" if c3 else "value")] if c2 else [SOURCE2]
                    values += [("double", "source3_value" if c2 else "value")] if c3 else [(FIELD, "source3")]
                    args = [f"paris_f{'_constant' if t == 'double' else ''}({n}, s, e)" for t, n in values]
                    yield float_function(f"CM_f_{first}{c2}_{second}{c3}{mid(always)}_1L",
                                         [DEST, SOURCE1] + values + F, doc, "paris_float_pair",
                                         [FLOAT_DEST, "paris_f(source1, s, e)"] + args, f"PARIS_{op}", flags,
                                         always, "PAIR", type="f", op=name, operands=3, lengths=1,
                                         constant=bool(c2) + 2 * bool(c3))


def float_part(types, name, op, flags, doc):
    """CM_T_f_name_2_2L: an integer made of a float."""
    for T in types:
        for always in (False, True):
            yield float_function(f"CM_{T}_f_{name}{mid(always)}_2_2L", [DEST, SOURCE, DLEN] + F, doc,
                                 "paris_float_part", [operand(T, "dest", "dlen"), FLOAT_SOURCE], f"PARIS_{op}",
                                 flags, always, "PART", type=T, op=name, operands=2, lengths=2)


def float_vax(types, name, op, flags, doc):
    return float_made(types, name, op, flags, doc, "paris_float_vax")


def float_made(_, name, op, flags, doc, action="paris_float_made"):
    """CM_f_name_1_1L, _2_1L: a float made of one."""
    for always in (False, True):
        for suffix, params, source in (("1_1L", [DEST], FLOAT_DEST), ("2_1L", [DEST, SOURCE], FLOAT_SOURCE)):
            yield float_function(f"CM_f_{name}{mid(always)}_{suffix}", params + F, doc, action,
                                 [FLOAT_DEST, source], f"PARIS_{op}", flags, always, "MADE", type="f", op=name,
                                 operands=len(params), lengths=1)


def float_test(_, name, op, flags, doc):
    yield float_function(f"CM_f_{name}_1L", [SOURCE] + F, doc, "paris_float_test", [FLOAT_SOURCE], f"PARIS_{op}",
                         flags, False, "TEST", type="f", op=name, operands=1, lengths=1)


def float_swap(_, name, op, flags, doc):
    for always in (False, True):
        yield float_function(f"CM_f_{name}{mid(always)}_2_1L", [DEST, SOURCE] + F, doc, "paris_float_swap",
                             [FLOAT_DEST, FLOAT_SOURCE], "0", flags, always, "SWAP", type="f", op=name,
                             operands=2, lengths=1)


SHAPES = {"float_unary": float_unary, "float_binary": float_binary, "float_by_integer": float_by_integer,
          "float_pair": float_pair, "float_part": float_part, "float_made": float_made, "float_test": float_test,
          "float_swap": float_swap, "float_vax": float_vax}



# ---- integers beyond arithmetic: integers.c and bits.c ----

INTEGER_OPS = {"TRUNCATE": ("UDIV", "SDIV"), "FLOOR": ("UDIV", "SFLOOR"), "CEILING": ("UCEIL", "SCEIL"),
               "ROUND": ("UROUND", "SROUND"), "MOD": ("UREM", "SMOD"), "REM": ("UREM", "SREM"),
               "SHIFT": ("USHIFT", "SSHIFT"), "TO_GRAY": ("PARIS_OP_TO_GRAY",) * 2,
               "SIGNUM": ("PARIS_OP_SIGNUM",) * 2}
COUNT, CLEN = (FIELD, "count"), (LEN, "clen")


def integer_op(op, letter):
    op = INTEGER_OPS.get(op, (op, op))[letter == "s"]
    return op if op.startswith("PARIS") else f"MACHINE_{op}"


def forms(stem, always, doc, action, row, flags, T, S, wanted, second=SOURCE2, **test):
    """The forms with two sources of which wanted gives the suffixes; S is the second source's letter, which is a
    signed long where it is a constant of any length ("n")."""
    field = "s" if S == "n" else S
    second_len = {"source2": "slen2", "count": "clen"}[second[1]]

    def make(suffix, const, params, args, operands):
        return instruction(f"CM_{stem}{const}{mid(always)}_{suffix}", params, doc, action, args, row, flags, always,
                           type=T, type2=field, op=stem, operands=operands, lengths=int(suffix[2]),
                           constant=int(const != ""), **test)

    len1, d = (LEN, "len"), operand(T, "dest", "len")
    two = second if second[1] == "count" else SOURCE
    a = operand(T, "source" if two is COUNT else "source1", "len")
    sources = [SOURCE, COUNT] if two is COUNT else [SOURCE1, SOURCE2]
    two_len = "clen" if two is COUNT else "slen"
    if "2_1L" in wanted:
        yield make("2_1L", "", [DEST, two, len1], [d, d, operand(field, two[1], "len")], 2)
    if "3_1L" in wanted:
        yield make("3_1L", "", [DEST] + sources + [len1], [d, a, operand(field, second[1], "len")], 3)
    if "2_2L" in wanted:
        dd = operand(T, "dest", "dlen")
        yield make("2_2L", "", [DEST, two, DLEN, (LEN, two_len)], [dd, dd, operand(field, two[1], two_len)], 2)
    if "3_2L" in wanted:
        yield make("3_2L", "", [DEST] + sources + [len1, (LEN, second_len)],
                   [d, a, operand(field, second[1], second_len)], 3)
    if "3_3L" in wanted:
        first_len = "slen" if two is COUNT else "slen1"
        yield make("3_3L", "", [DEST] + sources + [DLEN, (LEN, first_len), (LEN, second_len)],
                   [operand(T, "dest", "dlen"), operand(T, sources[0][1], first_len),
                    operand(field, second[1], second_len)], 3)
    for const in CONSTANTS:
        def c(length):
            return "paris_s_constant(value, 64)" if S == "n" else constant(S, "value", length)
        v = value(field)
        yield make("2_1L", const, [DEST, v, len1], [d, d, c("len")], 2)
        yield make("3_1L", const, [DEST, SOURCE, v, len1], [d, operand(T, "source", "len"), c("len")], 3)
        if "3_3L" in wanted:
            yield make("3_2L", const, [DEST, SOURCE, v, DLEN, SLEN],
                       [operand(T, "dest", "dlen"), operand(T, "source", "slen"), c("slen")], 3)


def integer(types, name, op, flags, doc):
    for T in types:
        for always in (False, True):
            yield from forms(f"{T}_{name}", always, doc, "paris_integer", integer_op(op, T), flags, T, T,
                             ("2_1L", "3_1L", "2_2L", "3_3L"), shape="INTEGER")


def power(types, name, op, flags, doc):
    """types: pairs of the base's and the exponent's letter."""
    for T, S in zip(types[::2], types[1::2]):
        for always in (False, True):
            yield from forms(f"{T}_{S}_{name}", always, doc, "paris_power", integer_op(op, T), flags, T, S,
                             ("2_1L", "3_1L", "2_2L", "3_3L"), shape="INTEGER")


def integer1(types, name, op, flags, doc):
    for T in types:
        for f in unary(T, name, "NOT", flags, doc):
            f.body = f.body.replace("MACHINE_NOT", integer_op(op, T)).replace("paris_unary", "paris_integer_unary")
            f.test.update(shape="INTEGER", op=f"{T}_{name}")
            yield f


def shift(types, name, op, flags, doc):
    for T in types:
        for stem in (f"{T}_s_{name}", f"{T}_{name}"):
            for always in (False, True):
                yield from forms(stem, always, doc, "paris_shift", integer_op(op, T), flags, T, "n",
                                 ("2_1L", "3_1L", "2_2L", "3_2L", "3_3L"), COUNT, shape="INTEGER")


def rotate(_, name, op, flags, doc):
    for stem in (name, f"u_{name}"):
        for always in (False, True):
            yield from forms(stem, always, doc, "paris_rotate", integer_op(op, "u"), flags, "u", "n",
                             ("2_1L", "3_1L", "2_2L", "3_2L"), COUNT, shape="INTEGER")


def two_fields(_, name, op, flags, doc):
    """Bit fields of any length. flags: the spellings."""
    action = f"paris_{name}"
    for stem in flags:
        for always in (False, True):
            yield instruction(f"CM_{stem}{mid(always)}_{op}", [DEST, SOURCE, (LEN, "len")], doc, action,
                              [operand("b", "dest", "len"), operand("b", "source", "len")], "0", [], always,
                              shape="INTEGER", type="b", op=name, operands=2, lengths=1)


SHAPES |= {"integer": integer, "integer1": integer1, "power": power, "shift": shift, "rotate": rotate,
          "two_fields": two_fields,
          "binary": binary, "unary": unary, "compare": compare, "move": move, "convert": convert,
          "logical": logical, "not": complement, "flag": flag, "news": news, "own": own, "processor": processor,
          "newsarray": newsarray, "global": reduction, "globalflag": globalflag,
          "combine": combine, "rank": rank,
          "send": send, "get": get, "powertwo": powertwo, "crossmove": crossmove, "coordinate": coordinate}
SHAPES |= COMPLEX_SHAPES


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


def tests(sections, floats=False):
    """A function that calls each instruction with a struct's members, and a table of them."""
    calls, rows_out = [], []
    for _, rows in sections:
        for _, functions in rows:
            for f in functions:
                if not f.body or f.test["shape"] in ("PROCESSOR", "ARRAY", "INTEGER", "COMPLEX", "SEND", "GET", "POWERTWO",
                                                     "CROSSMOVE", "COORDINATE", None):
                    continue
                if f.test["shape"].startswith("FLOAT_") != floats:
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
                if not f.body or f.test["shape"] != "INTEGER":
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
# ---- the fuzzer's table ----

# Calls that the fuzzer makes itself, or must not make: they end what is under way.
FUZZ_NOT = {"CM_set_error_handler", "CM_init", "CM_cold_boot", "CM_warm_boot", "CM_attach", "CM_attach_to_processors",
            "CM_detach", "CM_timer_print", "CM_set_safety_mode"}
# What reads a number back, so that kernels are made and run.
FUZZ_OBSERVES = ("global", "read_from", "news_array", "write_to_processor", "timer_", "latch_leds", "leds_mode")
FUZZ_BY_TYPE = {"CM_field_id_t": "field", "CM_vp_set_id_t": "vp_set", "CM_geometry_id_t": "geometry",
                "CM_sendaddr_t": "address", "CM_axis_descriptor_t *": "descriptors", "const void *": "array",
                "void *": "array", "double": "double", "unsigned long": "word", "long": "word"}
FUZZ_BY_NAME = {"axis": "axis", "direction": "small", "inclusion": "small", "smode": "small", "rank": "rank",
                "format": "small", "timer": "small", "dimension_vector": "dimensions", "dimensions": "dimensions",
                "send_address": "address", "offset": "offset"}
FUZZ_KEEPS = ("CM_field_id_t", "CM_vp_set_id_t", "CM_geometry_id_t")


def fuzz_argument(kind, name):
    """The function that makes such an argument of the fuzzer's bytes; None: there is none."""
    if name in FUZZ_BY_NAME and kind != "CM_field_id_t":
        return FUZZ_BY_NAME[name]
    if kind == "CM_vector_t":
        return "vector"
    if kind in FUZZ_BY_TYPE:
        return FUZZ_BY_TYPE[kind]
    if "*" in kind or "(" in kind:
        return None
    letters = name.lstrip("ds")
    if name in ("s", "ss", "ds"):
        return "significand"
    if letters == "e":
        return "exponent"
    return "length" if "len" in name else "number"


def fuzz_params(f):
    """[(type, name)], of a call's prototype too."""
    if not (f.params and f.params[0][0] == ""):
        return f.params
    if f.params[0][1] == "void":
        return []
    out = []
    for text in f.params[0][1].split(","):
        text = text.strip()
        name = text.split()[-1].lstrip("*")
        out.append((text[:len(text) - len(name)].strip(), name))
    return out


def fuzz(sections):
    """A function for each call that makes its arguments of bytes, and a table of them."""
    calls, table = [], []
    for _, rows in sections:
        for _, functions in rows:
            for f in functions:
                if f.name in FUZZ_NOT:
                    continue
                arguments = [(t, fuzz_argument(t, n)) for t, n in fuzz_params(f)]
                if any(how is None for _, how in arguments):
                    continue
                # One after the other: the order in which C makes the arguments of a call is not said.
                lines = []
                for i, (kind, how) in enumerate(arguments):
                    cast = "" if "*" in kind or kind == "CM_vector_t" else f"({kind})"
                    lines.append(f"    {kind}{'' if kind.endswith('*') else ' '}a{i} = {cast}fuzz_{how}(f);")
                call = f"{f.name}({', '.join(f'a{i}' for i in range(len(arguments)))})"
                if f.result in FUZZ_KEEPS:
                    call = f"fuzz_keep_{f.result[3:-2]}(f, {call})"
                elif f.result != "void":
                    call = f"(void){call}"
                if not arguments and f.result not in FUZZ_KEEPS:
                    lines.append("    (void)f;")
                body = "\n".join(lines + [f"    {call};"])
                calls.append(f"static void fuzz_call_{f.name}(struct fuzz *f)\n{{\n{body}\n}}")
                observes = int(any(word in f.name for word in FUZZ_OBSERVES))
                table.append(f'    {{"{f.name}", fuzz_call_{f.name}, {observes}}},')
    return "\n".join(["/* Generated from instructions.tab: every call, with arguments made of the fuzzer's bytes. */",
                      *calls, "", "static const struct fuzz_row fuzz_rows[] = {", *table, "};", ""])


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
        text = {"entries": entries, "tests": tests, "tests_floats": lambda all: tests(all, True),
                "integers": integer_tests,
                "fuzz": fuzz, "reference": reference}[kind](sections)
    with open(output, "w") as out:
        out.write(text)


if __name__ == "__main__":
    main()
