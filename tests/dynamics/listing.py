"""Writes the listing of the thesis's appendix 7.1 as a C function, from the thesis's text: listing.py TEXT OUT.

In the text the listing is in pieces between commentary. Lines that were too long are broken, some in the middle of "->"."""
import re
import sys

text = open(sys.argv[1], encoding="utf-8").read()
part = re.search(r"^### 7\.1 .*?^## 7\.2 ", text, re.M | re.S).group(0)
code = "\n".join(re.findall(r"^```\n(.*?)^```", part, re.M | re.S)).replace("-\n>", "->")
assert "TheMass" in code and code.count("{") == code.count("}"), "not the listing"
with open(sys.argv[2], "w", encoding="utf-8") as out:
    out.write('#include "thesis_oracle.h"\n#include <math.h>\n'
              "#define TheMass(i) (&masses[i])\n#define TheSpring(i) (&springs[i])\n"
              "void thesis_step_listing(const struct thesis_params *params, struct thesis_mass *masses,\n"
              "                         struct thesis_spring *springs, void (*clank)(int))\n"
              "{\n    int i, n, velocity;\n" + code + "\n}\n")
