"""Complex numbers: see complex.c. Constants are two doubles, the real part first."""
from table.function import *

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


SHAPES = {"cbinary": cbinary, "cunary": cunary, "ccompare": ccompare, "cmove": cmove, "cpower": cpower,
          "cpart": cpart, "cangle": cangle, "cfrontend": cfrontend}
