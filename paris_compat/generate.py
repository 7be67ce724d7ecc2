#!/usr/bin/env python3
"""Makes the public header, the entry points, the tests' table and the reference page of instructions.tab.

    generate.py header instructions.tab paris.h paris.h.in
    generate.py entries|tests|tests_floats|reference instructions.tab OUTPUT

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

SHAPES |= {"binary": binary, "unary": unary, "compare": compare, "move": move, "convert": convert,
          "logical": logical, "not": complement, "flag": flag, "news": news, "own": own, "processor": processor,
          "newsarray": newsarray, "global": reduction, "globalflag": globalflag}
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
                if not f.body or f.test["shape"] in ("PROCESSOR", "ARRAY", "COMPLEX"):
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


def reference(sections):
    out = ["# Paris, instruction by instruction", "",
           "Generated from `paris_compat/instructions.tab`. Context: an instruction changes dest, test and overflow "
           "only in active processors; `always` forms change dest in all. `constant` is spelt `const` too.", ""]
    for title, rows in sections:
        out += [f"## {title}", ""]
        for cells, functions in rows:
            if cells[0] == "call":
                out.append(f"- `{cells[1]}`: {cells[2]}")
                continue
            name = cells[2] if cells[2] != "-" else cells[0]
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
                "reference": reference}[kind](sections)
    with open(output, "w") as out:
        out.write(text)


if __name__ == "__main__":
    main()
