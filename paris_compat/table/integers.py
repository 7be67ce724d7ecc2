"""Integers beyond arithmetic: see integers.c and bits.c."""
from table.basic import unary
from table.function import *

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


SHAPES = {"integer": integer, "integer1": integer1, "power": power, "shift": shift, "rotate": rotate,
          "two_fields": two_fields}
