"""Measures the command's first picture by `lutetia bench start`. It takes at most a few times the processor time of finding the
device, and with empty caches at most twice what it takes with warm ones; so does a first program in C/Paris."""
import json
import os
import subprocess
import sys
import tempfile

MACHINES_MOST = 10 # of processor time, each the least of three; 2 to 7 are usual
COLD_MOST = 2  # times as with warm caches; 1 to 1.3 are usual

# As anybody runs it: plans are interpreted.
usual = {name: value for name, value in os.environ.items() if name not in ("LUTETIA_BACKGROUND", "LUTETIA_INTERPRET")}

with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "start.json")
    subprocess.run([sys.argv[1], "bench", "start", "--repeat", "3", "--json", path], check=True,
                   env=usual)
    with open(path) as file:
        rows = json.load(file)["rows"]
least = {(row["what"], row["case"]): row["min"] for row in rows}
machine = least["a machine, CPU", "info"]
pictures = {case: value for (what, case), value in least.items() if what == "first picture, CPU"}
assert len(pictures) == 3, pictures
for case, value in pictures.items():
    print(f"{case}: {value:.0f} ms of processor time, {value / machine:.1f} times a machine's {machine:.0f}")
    assert 0 < value <= MACHINES_MOST * machine, case

cold = [(what, case) for what, case in least if what.endswith(", cold, CPU")]
assert len(cold) == len(pictures) + 1, cold
for what, case in cold:
    warm = least[what.replace(", cold, CPU", ", CPU"), case]
    print(f"{what}, {case}: {least[what, case] / warm:.2f} times as with warm caches")
    assert 0 < least[what, case] <= COLD_MOST * warm, (what, case)
