"""test_program.py PROGRAM - the program of paris(7) says what Life by the rules has."""
import collections
import subprocess
import sys

SIDE, GENERATIONS = 64, 50
AROUND = [(y, x) for y in (-1, 0, 1) for x in (-1, 0, 1) if y or x]

alive = {(30, 31), (30, 32), (31, 30), (31, 31), (32, 31)}
for _ in range(GENERATIONS):
    counts = collections.Counter(((y + dy) % SIDE, (x + dx) % SIDE) for y, x in alive for dy, dx in AROUND)
    alive = {cell for cell, count in counts.items() if count == 3 or (count == 2 and cell in alive)}

said = subprocess.run([sys.argv[1]], capture_output=True, text=True, timeout=100)
should = f"{len(alive)} cells live after {GENERATIONS} generations\n"
if (said.returncode, said.stdout, said.stderr) != (0, should, ""):
    sys.exit(f"{said.stdout}{said.stderr}status {said.returncode}; expected {should}")
