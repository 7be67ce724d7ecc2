"""Families of floats alone: see floats.c. tests/paris/test_floats.c has a table of their own."""
from table.basic import binary, unary
from table.function import *


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
