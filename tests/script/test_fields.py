"""test_fields.py PROGRAM DOCUMENT [--write] - compares the document's tables between "<!-- fields NAME -->" and "<!-- end -->" with
those that the program prints from the rows; --write replaces them."""
import re
import subprocess
import sys

program, document = sys.argv[1:3]
printed = subprocess.run([program], check=True, capture_output=True, text=True).stdout
tables = dict(part.split("\n", 1) for part in printed.split("== ")[1:])
with open(document, encoding="utf-8") as file:
    text = file.read()
marks = re.compile(r"(<!-- fields (\w+) -->\n)(.*?)(<!-- end -->)", re.S)

if "--write" in sys.argv:
    with open(document, "w", encoding="utf-8") as file:
        file.write(marks.sub(lambda found: found[1] + tables[found[2]] + found[4], text))
    sys.exit(0)

there = {found[2]: found[3] for found in marks.finditer(text)}
wrong = [name for name in tables if there.get(name) != tables[name]] + [name for name in there if name not in tables]
for name in wrong:
    print(f"{document}: the table of {name} is not what its rows say; python3 {sys.argv[0]} {program} {document} --write")
sys.exit(bool(wrong))
