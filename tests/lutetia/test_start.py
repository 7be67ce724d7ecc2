"""Measures the command's first picture with warm caches by `lutetia bench start`. It takes at most a few times the processor time
of finding the device."""
import json
import os
import subprocess
import sys
import tempfile

MACHINES_MOST = 8  # of processor time, each the least of three; 2 to 4 are usual

with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "start.json")
    subprocess.run([sys.argv[1], "bench", "start", "--repeat", "3", "--json", path], check=True)
    with open(path) as file:
        rows = json.load(file)["rows"]
least = {(row["what"], row["case"]): row["min"] for row in rows}
machine = least["a machine, CPU", "info"]
pictures = {case: value for (what, case), value in least.items() if what == "first picture, CPU"}
assert len(pictures) == 3, pictures
for case, value in pictures.items():
    print(f"{case}: {value:.0f} ms of processor time, {value / machine:.1f} times a machine's {machine:.0f}")
    assert 0 < value <= MACHINES_MOST * machine, case
