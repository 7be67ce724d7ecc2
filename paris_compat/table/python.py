"""What the Python module knows of libparis: each call's types, and the header's constants."""
import re

# A letter for each type of C: see paris/__init__.py, which makes ctypes of them.
LETTERS = {
    "void": "v", "int": "i", "unsigned int": "u", "long": "l", "unsigned long": "m", "double": "d",
    "CM_field_id_t": "u", "CM_sendaddr_t": "u", "CM_vp_set_id_t": "i", "CM_geometry_id_t": "i",
    "CM_complex_t": "c", "CM_vector_t": "V", "const void *": "R", "void *": "W", "const char *": "S",
    "CM_axis_descriptor_t *": "A", "void (*) (const char *)": "H",
}
HANDLER = "void (*handler) (const char *message)"


def letters(f):
    """The result's letter, then those of the parameters."""
    types = [t for t, _ in f.params]
    if f.params and f.params[0][0] == "":
        text = f.params[0][1]  # written by hand in the table: "type name, type name"
        if text == HANDLER:
            types = ["void (*) (const char *)"]
        else:
            types = [re.sub(r"\s*\w+$", "", p.strip()) for p in text.split(",")] if text != "void" else []
    return LETTERS[f.result] + "".join(LETTERS[t] for t in types)


def constants(template):
    """{name: number} of the header's constants."""
    found = dict(re.findall(r"^#define (CM_\w+) (\w+)", template, re.M))
    while any(v in found for v in found.values()):
        found = {k: found.get(v, v) for k, v in found.items()}
    return {k: int(v) for k, v in found.items()}


def variables(template):
    """{name: letter} of the variables that a program may read."""
    return {name: LETTERS[kind.strip()] for kind, name in
            re.findall(r"^extern ([\w ]+?) (CM_\w+);", template.split("@PROTOTYPES@")[0], re.M)}


def names(sections, template, library):
    out = ['"""Generated from instructions.tab: the calls of <cm/paris.h>, its constants and its variables."""', "",
           f'LIBRARY = "{library}"', "",
           "CONSTANTS = {"]
    out += [f'    "{k}": {v},' for k, v in constants(template).items()]
    out += ["}", "", "VARIABLES = {"]
    out += [f'    "{k}": "{v}",' for k, v in variables(template).items()]
    out += ["}", "", "CALLS = {"]
    for _, rows in sections:
        for _, functions in rows:
            out += [f'    "{f.name}": "{letters(f)}",' for f in functions]
    return "\n".join(out + ["}", ""])
