"""The values of a field, as an answer of the library has them: numbers, and what is said of them."""
import math
import struct

CODES = {1: "B", 2: "H", 4: "I", 8: "Q"}


class Field:
    """A field's or a flag's values in row-major order; `active` has the context's byte for each."""

    def __init__(self, name, facts, data):
        self.name, self.facts = name, facts
        self.axes, self.count = facts["axes"], facts["count"]
        at, element = facts["at"], facts["element"]
        self.active = bytes(data[at:at + self.count])
        raw = data[at + self.count:at + self.count * (1 + element)] if "bits" in facts else self.active
        self.letter, self.length = facts["letter"], facts["len"]
        self.values = numbers(bytes(raw), self.letter, self.length, element)

    @property
    def kind(self):
        if "bits" not in self.facts:
            return "a flag"
        if self.letter == "f":
            return f"floats ({self.length}, {self.facts['e']})"
        return f"{'signed' if self.letter == 's' else 'unsigned'} numbers of {self.length} bits" if self.length > 1 else "bits"

    def title(self):
        where = f"VP set {self.facts['vp_set']}: {' x '.join(map(str, self.axes))}"
        if "bits" not in self.facts:
            return f"{self.name}: {where}"
        part = f" from bit {self.facts['offset']} on" if self.facts["offset"] else ""
        active = sum(self.active)
        some = "all processors are active" if active == self.count else f"{active} of {self.count} processors are active"
        return f"{self.name}: field {self.facts['base']} of {self.facts['bits']} bits{part}, {self.kind}; {where}; {some}"

    def place(self, index):
        """The coordinates of a row-major index."""
        out = []
        for length in reversed(self.axes):
            index, coordinate = divmod(index, length)
            out.append(coordinate)
        return list(reversed(out))

    def index(self, place):
        if len(place) != len(self.axes):
            raise ValueError(f"a place has {len(self.axes)} coordinates, {' x '.join(map(str, self.axes))} (got {len(place)})")
        index = 0
        for axis, (coordinate, length) in enumerate(zip(place, self.axes)):
            if not 0 <= coordinate < length:
                raise ValueError(f"the coordinate on axis {axis} is 0 to {length - 1} (got {coordinate})")
            index = index * length + coordinate
        return index

    def text(self, value):
        if self.letter != "f":
            return str(value)
        return f"{value:.{7 if self.facts['element'] == 4 else 12}g}"

    def chosen(self, everywhere):
        """The indices of active processors, or of all."""
        return range(self.count) if everywhere else [i for i, active in enumerate(self.active) if active]


def numbers(raw, letter, length, element):
    if letter == "f":
        return memoryview(raw).cast("f" if element == 4 else "d").tolist()
    if element == 16:
        halves = struct.unpack(f"<{len(raw) // 8}Q", raw)
        out = [low | high << 64 for low, high in zip(halves[::2], halves[1::2])]
    else:
        out = memoryview(raw).cast(CODES[element]).tolist()
    if letter == "s":
        top = 1 << (length - 1)
        out = [(x ^ top) - top for x in out]
    return out


def spoken(place):
    return " ".join(map(str, place))


def statistics(field, everywhere=False):
    """Lines about the values."""
    chosen = field.chosen(everywhere)
    values = field.values
    finite = [i for i in chosen if not isinstance(values[i], float) or math.isfinite(values[i])]
    nans = [i for i in chosen if values[i] != values[i]]
    infinite = len(chosen) - len(finite) - len(nans)
    out = []
    if finite:
        least, most = min(finite, key=values.__getitem__), max(finite, key=values.__getitem__)
        total = math.fsum(values[i] for i in finite) if field.letter == "f" else sum(values[i] for i in finite)
        mean = total / len(finite)
        spread = math.sqrt(math.fsum((values[i] - mean) ** 2 for i in finite) / len(finite))
        zeros = sum(values[i] == 0 for i in finite)
        out += [f"least {field.text(values[least])} at {spoken(field.place(least))}, "
                f"most {field.text(values[most])} at {spoken(field.place(most))}",
                f"mean {mean:.7g}, standard deviation {spread:.7g}, sum {field.text(total)}; {zeros} of {len(chosen)} are 0"]
    if nans:
        out.append(f"{len(nans)} NaN, the first at {spoken(field.place(nans[0]))}")
    if infinite:
        out.append(f"{infinite} infinite")
    return out or ["no processor is active; `all` takes all of them"]


def histogram(field, everywhere=False, bins=16, width=50):
    """Lines, one for each range of values."""
    values = [field.values[i] for i in field.chosen(everywhere)]
    finite = [x for x in values if not isinstance(x, float) or math.isfinite(x)]
    if not finite:
        return ["there is no number to count"]
    least, most = min(finite), max(finite)
    if field.letter == "f":
        step = (most - least) / bins
        begins = [least + i * step for i in range(bins)] if step else [least]
        names = [f"from {begin:.6g}" for begin in begins]
    else:
        step = (most - least) // bins + 1
        begins = list(range(least, most + 1, step))
        names = [str(begin) if step == 1 else f"{begin} to {min(begin + step - 1, most)}" for begin in begins]
    counts = [0] * len(begins)
    for x in finite:
        counts[min(int((x - least) / step) if field.letter == "f" else (x - least) // step, len(begins) - 1) if step else 0] += 1
    broad, high = max(map(len, names)), max(counts)
    return [f"{name:>{broad}} | {'#' * (count * width // high or (1 if count else 0)):{width}} {count}"
            for name, count in zip(names, counts)]


def differences(one, other, everywhere=False, most=8):
    """Lines about where two fields differ."""
    if one.axes != other.axes:
        return [f"{one.name} and {other.name} have different shapes"]
    chosen = one.chosen(everywhere)
    differ = [i for i in chosen if one.values[i] != other.values[i] and not (one.values[i] != one.values[i] and other.values[i] != other.values[i])]
    if not differ:
        return [f"{one.name} and {other.name} are equal in {len(chosen)} processors"]
    out = [f"{one.name} and {other.name} differ in {len(differ)} of {len(chosen)} processors"]
    for i in differ[:most]:
        out.append(f"  at {spoken(one.place(i))}: {one.text(one.values[i])} and {other.text(other.values[i])}")
    if len(differ) > most:
        out.append(f"  and {len(differ) - most} more")
    known = [i for i in differ if one.values[i] - other.values[i] == one.values[i] - other.values[i]]
    if known:
        far = max(known, key=lambda i: abs(one.values[i] - other.values[i]))
        out.append(f"the greatest difference is {one.text(abs(one.values[far] - other.values[far]))}, at {spoken(one.place(far))}")
    return out
