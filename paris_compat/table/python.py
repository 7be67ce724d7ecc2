"""What the Python module knows of libparis: each call's types, and the header's constants."""
import re

# A letter for each type of C: see paris/__init__.py, which makes ctypes of them.
LETTERS = {
    "void": "v", "int": "i", "unsigned int": "u", "long": "l", "unsigned long": "m", "double": "d",
    "CM_field_id_t": "u", "CM_sendaddr_t": "u", "CM_vp_set_id_t": "i", "CM_geometry_id_t": "i",
    "CM_complex_t": "c", "CM_vector_t": "V", "const void *": "R", "void *": "W", "const char *": "S",
    "CM_axis_descriptor_t *": "A", "void (*) (const char *)": "H",
    "CMFB_display_id_t": "i", "const unsigned char *": "B", "unsigned char *": "b", "unsigned int *": "L", "...": ".",
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


def type_of(parameter):
    """The type of `type name`, `type *name` or `...`."""
    return parameter.strip() if parameter.strip() == "..." else re.sub(r"\w+$", "", parameter.strip()).strip()


def declared(text):
    """{name: letters} of the calls of a header that is written by hand."""
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    found = {}
    for result, name, parameters in re.findall(r"^extern ([\w ]+?\s*\*?)\s*\b(\w+)\(([^)]*)\);", text, re.M):
        parts = [] if parameters.strip() == "void" else parameters.split(",")
        found[name] = LETTERS[result.strip()] + "".join(LETTERS[" ".join(type_of(p).split())] for p in parts)
    return found


def constants(text):
    """{name: number} of a header's constants."""
    found = dict(re.findall(r"^#define (CM\w*_\w+) (\w+)", text, re.M))
    while any(v in found for v in found.values()):
        found = {k: found.get(v, v) for k, v in found.items()}
    return {k: int(v) for k, v in found.items()}


def variables(text):
    """{name: letter} of the variables that a program may read."""
    return {name: LETTERS[kind.strip()] for kind, name in
            re.findall(r"^extern ([\w ]+?) (CM\w*_\w+);", text.split("@PROTOTYPES@")[0], re.M)}


def names(sections, headers, library):
    """headers: the texts of <cm/paris.h>'s template, then of those that stand beside it."""
    out = ['"""Generated: the calls of <cm/paris.h>, <cm/cmfb.h>, <cm/cmfs.h> and <lutetia/fields.h>, their constants and variables."""', "",
           f'LIBRARY = "{library}"', "",
           "CONSTANTS = {"]
    out += [f'    "{k}": {v},' for text in headers for k, v in constants(text).items()]
    out += ["}", "", "VARIABLES = {"]
    out += [f'    "{k}": "{v}",' for text in headers for k, v in variables(text).items()]
    out += ["}", "", "CALLS = {"]
    for _, rows in sections:
        for _, functions in rows:
            out += [f'    "{f.name}": "{letters(f)}",' for f in functions]
    out += [f'    "{k}": "{v}",' for text in headers[1:] for k, v in declared(text).items()]
    return "\n".join(out + ["}", ""])
