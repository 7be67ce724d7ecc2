"""numpy_peer.py: the diffusion step in numpy, whole arrays at a time; spoken to as bench/peer.h says."""
import sys

try:
    import numpy as np
except ImportError:
    sys.exit(3)

commands, answers = sys.stdin.buffer, sys.stdout.buffer
numbers = commands.readline().split()
width, height, x0, y0, x1, y1 = map(int, numbers[:6])
gravity, *weights = (np.float32(float.fromhex(number.decode())) for number in numbers[6:])


def sheet():
    plane = np.frombuffer(commands.read(4 * width * height), np.float32)
    return plane.reshape(height, width).copy()


absorbency, *fields = [sheet() for _ in range(5)]
here = slice(y0, y1), slice(x0, x1)
lower = (slice(y0 - 1, y1 - 1), slice(x0, x1)), (slice(y0, y1), slice(x0 - 1, x1 - 1))
outside = (slice(-1, None), slice(None)), (slice(None), slice(-1, None))


def disperse(axis):
    for i, field in enumerate(fields):
        inward = (field[lower[axis]] - field[here]) * absorbency[here]
        if i:
            inward *= fields[0][here]
            inward *= weights[i - 1]
        inward = np.where(inward > 0, inward * gravity, inward / gravity)
        outward = np.roll(inward, -1, axis)
        outward[outside[axis]] = 0
        inward += field[here]
        inward -= outward
        np.clip(inward, 0, 1, out=field[here])


def answer(data):
    answers.write(data)
    answers.flush()


answer(b"ready\n")
for line in commands:
    verb, number = line.split()
    if verb == b"steps":
        for _ in range(int(number)):
            disperse(1)
            disperse(0)
        answer(b"done\n")
    else:
        answer(fields[int(number)].tobytes())
