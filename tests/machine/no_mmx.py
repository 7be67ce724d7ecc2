"""No function of the library uses MMX registers.

no_mmx.py LIBRARY: they are those of long double, too, so a program's long doubles would be NaN after such a function. A compiler
that is not told otherwise may take them to move halves of 128 bits."""
import shutil
import subprocess
import sys

if not shutil.which("objdump"):
    print("no objdump")
    sys.exit(77)
code = subprocess.run(["objdump", "-d", "--no-show-raw-insn", sys.argv[1]], capture_output=True, text=True, check=True).stdout
function, wrong = "", set()
for line in code.splitlines():
    if line.endswith(">:"):
        function = line
    elif "%mm" in line:
        wrong.add(function)
for name in sorted(wrong):
    print(f"{name} uses an MMX register", file=sys.stderr)
sys.exit(1 if wrong or not function else 0)
