"""Scans, spreads, reductions, ranks: see scans.c."""
from table.function import *

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
Floats of other formats than 23, 8 and 52, 11 are combined as doubles in that order, and each result is rounded once.
""", "The router": """\
It is as if one active processor after the other, in row-major order, did the operation on dest in the processor at its
send_address. *notify* is a field of one bit of dest's VP set, which may be another one than the current: it becomes 1 in
each processor where a message has arrived, and 0 in each other one, whatever the context of that set. `CM_no_field`: nobody
is told. A *get* needs none. Sums of floats begin with the old dest; floats of other formats than 23, 8 and 52, 11 are
combined as doubles, and what arrives is rounded once.
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


SHAPES = {"combine": combine, "rank": rank}
