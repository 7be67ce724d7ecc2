"""Arithmetic, comparisons, moves, conversions, logical operations, flags, NEWS, the front end."""
from table.function import *


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
WORDS = {}  # what a logical operation does, with {0} and {1} for its operands


def logical(_, name, op, flags, doc):
    TRUTH[name] = op
    WORDS[name] = doc.removeprefix("dest = ").replace("source1", "{0}").replace("source2", "{1}")
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
        yield make(f"CM_store_{name}{a}", [DEST], f"dest = {name}, one bit", "paris_flag_store",
                   ["dest"], op="store", operands=1)
        for lop, truth in TRUTH.items():
            row = f"0x{int(truth, 2):x}"
            yield make(f"CM_{lop}_{name}{a}", [SOURCE], f"{name} = {WORDS[lop].format(name, 'source')}, one bit",
                       "paris_flag_logical_field", ["source"], row, op=lop, operands=1)
            for other in FLAGS:
                if other != name:
                    yield make(f"CM_{lop}_{name}_with_{other}{a}", [], f"{name} = {WORDS[lop].format(name, other)}",
                               "paris_flag_logical_flag", [f"MACHINE_{other.upper()}"], row, op=lop,
                               other=other[0])


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


SHAPES = {"binary": binary, "unary": unary, "compare": compare, "move": move, "convert": convert,
          "logical": logical, "not": complement, "flag": flag, "news": news, "own": own, "processor": processor,
          "newsarray": newsarray, "global": reduction, "globalflag": globalflag}
# The shapes that tests/paris/test_instructions.c knows.
TESTED = ("BINARY", "UNARY", "COMPARE", "CONVERT", "MOVE", "LOGICAL", "FLAG", "NEWS", "OWN", "GLOBAL", "GLOBALFLAG")
