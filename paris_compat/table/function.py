"""A Function is one entry point: its prototype, its body, and what the tests say of it."""
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


def spellings(name):
    """The name, and the older spelling without its _1L."""
    return (name, name[:-3])


def call(prototype, doc):
    head, args = prototype.split(" (", 1)
    result, name = head.rsplit(" ", 1)
    return Function(name, [("", args[:-1])], doc, "", result)
