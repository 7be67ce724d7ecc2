#!/usr/bin/env python3
"""math_tables.py > math_tables.cl, then clang-format: the numbers of math.cl. Needs mpmath (Debian:
python3-mpmath); run it only to change them.

Polynomials are near-minimax (Chebyshev) fits with coefficients rounded to double; tables are pairs of doubles,
the second one what the first lacks.
"""

from mpmath import mp, mpf

mp.prec = 400


def double(x):
    return float(x)


def pair(x):
    hi = double(x)
    return hi, double(x - mpf(hi))


def fit(name, f, top, terms, note):
    """Of f on [0, top] or, where top is a pair, on that interval; lowest coefficient first."""
    low, high = top if isinstance(top, tuple) else (0, top)
    coefficients, error = mp.chebyfit(f, [mpf(low), mpf(high)], terms, error=True)
    print("/* %s; off by %s at most */" % (note, mp.nstr(error, 2)))
    for i, c in enumerate(reversed(coefficients)):
        print("#define %s_%d %s" % (name, i, double(c).hex()))
    print()


def constant(name, x, note, head=None):
    """head: how many bits the first double may have, so that small multiples of it are exact."""
    parts, rest = [], x
    for i in range(3):
        if i == 0 and head:
            e = int(mp.floor(mp.log(x, 2))) + 1 - head
            hi = double(mp.floor(rest / mpf(2)**e) * mpf(2)**e)
        else:
            hi = double(rest)
        parts.append(hi)
        rest -= mpf(hi)
    print("/* %s */" % note)
    for i, p in enumerate(parts):
        print("#define %s_%d %s" % (name, i, p.hex()))
    print()


def series(f, order):
    """f without the rounding that its formula would have near 0."""
    def g(x):
        with mp.workprec(1600):
            return f(x if abs(x) > mpf(2)**-300 else mpf(2)**-300)
    return g


print("""/* math_tables.cl - the numbers of math.cl. Made by math_tables.py. */
#ifdef VECTOR
#define TABLE(type, name, count) __constant type name[count]
#endif
""")
constant("LN2", mp.log(2), "ln 2: the first has 40 bits", 40)
constant("HALF_PI", mp.pi / 2, "pi / 2")
constant("PI", mp.pi, "pi")
constant("INVERSE_LN2", 1 / mp.log(2), "1 / ln 2")
constant("INVERSE_LN10", 1 / mp.log(10), "1 / ln 10")
constant("TWO_OVER_PI", 2 / mp.pi, "2 / pi")

fit("EXP", series(lambda r: (mp.exp(r) - 1 - r) / r**2, 2), (-0.3470, 0.3470), 12, "e^r = 1 + r + r^2 EXP(r)")
fit("LOG", series(lambda r: (mp.log1p(r) - r + r**2 / 2) / r**3, 3), (-0.0057, 0.0057), 8,
    "ln(1 + r) = r - r^2/2 + r^3 LOG(r)")
fit("SIN", series(lambda s: (mp.sin(mp.sqrt(s)) - mp.sqrt(s)) / mp.sqrt(s)**3, 3), 0.6170, 8,
    "sin r = r + r^3 SIN(r^2)")
fit("COS", series(lambda s: (mp.cos(mp.sqrt(s)) - 1 + s / 2) / s**2, 4), 0.6170, 8,
    "cos r = 1 - r^2/2 + r^4 COS(r^2)")
fit("SINH", series(lambda s: (mp.sinh(mp.sqrt(s)) - mp.sqrt(s)) / mp.sqrt(s)**3, 3), 0.2501, 7,
    "sinh r = r + r^3 SINH(r^2)")
fit("COSH", series(lambda s: (mp.cosh(mp.sqrt(s)) - 1 - s / 2) / s**2, 4), 0.2501, 7,
    "cosh r = 1 + r^2/2 + r^4 COSH(r^2)")
fit("ATAN", series(lambda s: (mp.atan(mp.sqrt(s)) - mp.sqrt(s)) / mp.sqrt(s)**3, 3), 0.00099, 6,
    "atan r = r + r^3 ATAN(r^2)")

print("/* 1/c as a double, and the logarithm of that double's inverse, for c = (i + 90) / 128 */")
print("TABLE(double, log_table, 276) = {")
for i in range(92):
    inverse = double(mpf(128) / (i + 90))
    hi, lo = pair(-mp.log(mpf(inverse)))
    print("    %s, %s, %s," % (inverse.hex(), hi.hex(), lo.hex()))
print("};\n")

print("/* atan(i / 16) */")
print("TABLE(double, atan_table, 34) = {")
for i in range(17):
    hi, lo = pair(mp.atan(mpf(i) / 16))
    print("    %s, %s," % (hi.hex(), lo.hex()))
print("};\n")

print("/* 2 / pi, 64 bits at a time: word i counts 2^-64i; word 0 is its whole part */")
print("TABLE(ulong, two_over_pi, 22) = {")
with mp.workprec(2000):
    n = int(mp.floor(2 / mp.pi * mpf(2)**(64 * 21)))
words = [(n >> (64 * (21 - i))) & (2**64 - 1) for i in range(22)]
for i in range(0, 22, 2):
    print("    0x%016xUL, 0x%016xUL," % (words[i], words[i + 1]))
print("};")
