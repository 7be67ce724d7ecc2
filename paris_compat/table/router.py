"""The router and coordinates: see router.c and coordinates.c."""
from table.function import *

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


SHAPES = {"send": send, "get": get, "powertwo": powertwo, "crossmove": crossmove, "coordinate": coordinate}
