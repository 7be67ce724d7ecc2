"""program.py PARIS OUT - writes the last whole program of paris.md, as a reader of paris(7) would copy it."""
import pathlib
import re
import sys

programs = re.findall(r"```c\n(#include.*?)```", pathlib.Path(sys.argv[1]).read_text(), re.S)
pathlib.Path(sys.argv[2]).write_text(programs[-1])
