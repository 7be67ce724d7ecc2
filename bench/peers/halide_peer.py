"""halide_peer.py: the diffusion step in Halide, spoken to as bench/peer.h says. Its argument is the number of
steps that are one pipeline: 1, rows that follow each other in bands; more, tiles that overlap."""
import sys

try:
    import halide as hl
    import numpy as np
except ImportError:
    sys.exit(3)

LANES, BAND, TILE = 16, 32, (512, 64)

commands, answers = sys.stdin.buffer, sys.stdout.buffer
steps_at_once = int(sys.argv[1])
numbers = commands.readline().split()
width, height, x0, y0, x1, y1 = map(int, numbers[:6])
gravity, *weights = (float.fromhex(number.decode()) for number in numbers[6:])
# Where a tile does not fit, it is moved in: none is larger than the rectangle.
columns, rows = x1 - x0, y1 - y0
lanes = LANES if columns >= LANES else 1
band, tile = min(BAND, rows), (min(TILE[0], columns), min(TILE[1], rows))
x, y, xo, yo, xi, yi = map(hl.Var, ("x", "y", "xo", "yo", "xi", "yi"))


def padded(values):
    """A row is not a power of two long: rows would fight for the same lines of the cache."""
    plane = np.zeros((height, width + LANES), np.float32)[:, :width]
    plane[:] = values
    return plane


def sheet():
    return padded(np.frombuffer(commands.read(4 * width * height), np.float32).reshape(height, width))


def buffer(plane, only_rectangle=False):
    b = hl.Buffer(plane.T)
    if only_rectangle:
        b.crop(0, x0, x1 - x0)
        b.crop(1, y0, y1 - y0)
    return b


def constant(number):
    return hl.f32(number)


def active(at_x, at_y):
    return (at_x >= x0) & (at_x < x1) & (at_y >= y0) & (at_y < y1)


def disperse(fields, absorbency, axis):
    """fields: a function of four values. The same a step along the axis later."""
    dx, dy = (1, 0) if axis == 0 else (0, 1)

    def inward(i, at_x, at_y, water):
        flow = (fields[at_x - dx, at_y - dy][i] - fields[at_x, at_y][i]) * absorbency[at_x, at_y]
        if i:
            flow = flow * water * constant(weights[i - 1])
        flow = hl.select(flow > constant(0), flow * constant(gravity), flow / constant(gravity))
        return hl.select(active(at_x, at_y), flow, constant(0))

    def moved(i, at_x, at_y, water, next_water):
        old = fields[at_x, at_y][i]
        new = old + inward(i, at_x, at_y, water) - inward(i, at_x + dx, at_y + dy, next_water)
        new = hl.max(hl.min(new, constant(1)), constant(0))
        return hl.strict_float(hl.select(active(at_x, at_y), new, old))

    water, result = hl.Func("water"), hl.Func("along")
    water[x, y] = moved(0, x, y, None, None)
    result[x, y] = hl.Tuple([water[x, y]] + [
        moved(i, x, y, water[x, y], water[x + dx, y + dy]) for i in (1, 2, 3)])
    return result


def pipeline(inputs, absorbency):
    start = hl.Func("start")
    bounded = [hl.BoundaryConditions.repeat_edge(i) for i in inputs]
    start[x, y] = hl.Tuple([b[x, y] for b in bounded])
    absorbency = hl.BoundaryConditions.repeat_edge(absorbency)
    stages, fields = [], start
    for _ in range(steps_at_once):
        for axis in (0, 1):
            fields = disperse(fields, absorbency, axis)
            stages.append(fields)
    last = stages.pop()
    if steps_at_once == 1:
        last.split(y, yo, yi, band).parallel(yo).vectorize(x, lanes)
        stages[0].compute_at(last, yi).store_at(last, yo).vectorize(x, lanes)
    else:
        last.tile(x, y, xo, yo, xi, yi, *tile).parallel(yo).vectorize(xi, lanes)
        for stage in stages:
            stage.compute_at(last, xo).vectorize(x, lanes)
    return last


absorbency = sheet()
now = [sheet() for _ in range(4)]
other = [padded(plane) for plane in now]
parameters = [hl.ImageParam(hl.Float(32), 2, "field%d" % i) for i in range(4)]
paper = hl.ImageParam(hl.Float(32), 2, "absorbency")
paper.set(buffer(absorbency))
program = pipeline(parameters, paper)


def answer(data):
    answers.write(data)
    answers.flush()


def steps(count):
    global now, other
    for _ in range(count):
        for parameter, plane in zip(parameters, now):
            parameter.set(buffer(plane))
        program.realize([buffer(plane, True) for plane in other])
        now, other = other, now


program.compile_jit()
answer(b"ready\n")
for line in commands:
    verb, number = line.split()
    if verb == b"steps":
        steps(int(number) // steps_at_once)
        answer(b"done\n")
    else:
        answer(np.ascontiguousarray(now[int(number)]).tobytes())
