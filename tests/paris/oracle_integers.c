#include "oracle_integers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef __int128 signed_number;

static bool ends(const char *op, const char *end)
{
    size_t n = strlen(op), k = strlen(end);
    return n >= k && strcmp(op + n - k, end) == 0;
}

bool oracle_integer_overflows(const char *op)
{
    return !ends(op, "rotate");
}

static bool fits(number value, int len, bool is_signed)
{
    return oracle_extend(value, len, is_signed) == value;
}

/* ---- quotients ---- */

static struct oracle_result divided_unsigned(const char *op, number x, number y)
{
    struct oracle_result out = {0, false};
    if (y == 0) {
        out.overflow = true;
        out.bits = ends(op, "_rem") || ends(op, "_mod") ? x : 0;
        return out;
    }
    number q = x / y, r = x % y;
    if (ends(op, "_rem") || ends(op, "_mod"))
        q = r;
    else if (ends(op, "_ceiling"))
        q += r != 0;
    else if (ends(op, "_round"))
        q += r > y - r || (r == y - r && q % 2 == 1);
    out.bits = q;
    return out;
}

static struct oracle_result divided_signed(const char *op, signed_number x, signed_number y)
{
    struct oracle_result out = {0, false};
    const signed_number least = (signed_number)((number)1 << 127);
    bool remains = ends(op, "_rem") || ends(op, "_mod");
    if (y == 0) {
        out.overflow = true;
        out.bits = remains ? (number)x : 0;
        return out;
    }
    if (x == least && y == -1) {
        out.overflow = !remains;
        out.bits = remains ? 0 : (number)least;
        return out;
    }
    signed_number q = x / y, r = x % y;
    bool negative = (x < 0) != (y < 0);
    if (ends(op, "_rem"))
        q = r;
    else if (ends(op, "_mod"))
        q = r != 0 && (r < 0) != (y < 0) ? r + y : r;
    else if (ends(op, "_floor"))
        q -= r != 0 && negative;
    else if (ends(op, "_ceiling"))
        q += r != 0 && !negative;
    else if (ends(op, "_round")) {
        number twice = r < 0 ? -(number)r : (number)r, all = y < 0 ? -(number)y : (number)y;
        bool away = twice > all - twice || (twice == all - twice && q % 2 != 0);
        q += away ? (negative ? -1 : 1) : 0;
    }
    out.bits = (number)q;
    return out;
}

/* ---- powers ---- */

static struct oracle_result raised(bool is_signed, number x, number e)
{
    struct oracle_result out = {1, false};
    bool small = x == 0 || x == 1 || (is_signed && x == ~(number)0);
    if (small) {
        out.bits = e == 0 ? 1 : x == 0 ? 0 : x == 1 || e % 2 == 0 ? 1 : x;
        return out;
    }
    number square = x;
    for (number k = e; k; k /= 2) { /* the bits */
        if (k % 2)
            out.bits *= square;
        square *= square;
    }
    if (e > 127) {
        out.overflow = true;
        return out;
    }
    number u = 1;
    signed_number s = 1;
    for (int i = 0; i < (int)e && !out.overflow; i++) /* whether they are all */
        out.overflow = is_signed ? __builtin_mul_overflow(s, (signed_number)x, &s)
                                 : __builtin_mul_overflow(u, x, &u);
    return out;
}

static struct oracle_result power(bool is_signed, bool e_signed, number x, number e)
{
    struct oracle_result out = {0, false};
    if (!e_signed || (signed_number)e >= 0)
        return raised(is_signed, x, e);
    if (x == 0)
        out.overflow = true;
    else if (x == 1)
        out.bits = 1;
    else if (is_signed && x == ~(number)0)
        out.bits = e % 2 ? x : 1;
    return out;
}

/* ---- bits ---- */

static bool bit(number x, int i)
{
    return x >> i & 1;
}

static number counted(const char *op, bool is_signed, number x)
{
    int count = 0, length = 0;
    for (int i = 0; i < 128; i++)
        if (bit(x, i) != (is_signed && bit(x, 127))) {
            count++;
            length = i + 1;
        }
    return (number)(ends(op, "logcount") ? count : length);
}

static number root(number x)
{
    number low = 0, high = (number)1 << 64; /* low^2 <= x < high^2 */
    while (high - low > 1) {
        number middle = low + (high - low) / 2;
        if (middle <= x / middle)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static number gray(const char *op, number x)
{
    number r = 0;
    bool above = false;
    for (int i = 127; i >= 0; i--) {
        bool from = ends(op, "from_gray_code");
        bool now = bit(x, i) != above;
        r |= (number)now << i;
        above = from ? now : bit(x, i);
    }
    return r;
}

/* x * 2^n in dlen bits. x and n are extended to 128 bits; n is signed. */
static struct oracle_result shifted(bool is_signed, number x, signed_number n, int dlen)
{
    struct oracle_result out = {0, false};
    bool sign = is_signed && bit(x, 127);
    for (int i = 0; i < dlen; i++) {
        signed_number from = n > 256 ? -1 : n < -256 ? 256 : i - n;
        out.bits |= (number)(from < 0 ? 0 : from > 127 ? sign : bit(x, (int)from)) << i;
    }
    /* overflow: x * 2^n, rounded down, does not fit in dest */
    number v = x;
    for (signed_number k = n; k > 0 && k > n - 200 && !out.overflow; k--) {
        bool carry = is_signed ? bit(v, 127) != bit(v, 126) : bit(v, 127);
        out.overflow = carry;
        v *= 2;
    }
    for (signed_number k = n; k < 0 && k < n + 200; k++)
        v = v / 2 | (number)sign << 127;
    out.overflow = out.overflow || !fits(v, dlen, is_signed);
    return out;
}

static number rotated(number a, int len, signed_number n)
{
    number r = 0;
    for (int i = 0; i < len; i++) {
        int to = (int)(((signed_number)i + n % len + len) % len);
        r |= (number)bit(a, i) << to;
    }
    return r;
}

number oracle_reversed(number a, int len)
{
    number r = 0;
    for (int i = 0; i < len; i++)
        r |= (number)bit(a, i) << (len - 1 - i);
    return r;
}

/* ---- all ---- */

static bool is_quotient(const char *op)
{
    return ends(op, "truncate") || ends(op, "_floor") || ends(op, "_ceiling") ||
           ends(op, "_round") || ends(op, "_rem") || ends(op, "_mod");
}

struct oracle_result oracle_integer_row(const char *op, bool is_signed, bool b_signed, number a,
                                        int alen, number b, int blen, int dlen)
{
    number x = oracle_extend(a, alen, is_signed), y = oracle_extend(b, blen, b_signed);
    struct oracle_result out = {0, false};
    bool result_signed = is_signed;
    if (ends(op, "shift")) {
        out = shifted(is_signed, x, (signed_number)y, dlen);
        return out;
    }
    if (ends(op, "rotate")) {
        out.bits = rotated(a & oracle_mask(dlen), dlen, (signed_number)y);
        return out;
    }
    if (ends(op, "power"))
        out = power(is_signed, b_signed, x, y);
    else if (ends(op, "signum"))
        out.bits = x == 0 ? 0 : bit(x, 127) ? ~(number)0 : 1;
    else if (ends(op, "isqrt")) {
        out.overflow = is_signed && bit(x, 127);
        out.bits = out.overflow ? 0 : root(x);
    } else if (ends(op, "gray_code"))
        out.bits = gray(op, x);
    else if (ends(op, "logcount") || ends(op, "integer_length")) {
        out.bits = counted(op, is_signed, x);
        result_signed = false;
    } else if (is_quotient(op))
        out = is_signed ? divided_signed(op, (signed_number)x, (signed_number)y)
                        : divided_unsigned(op, x, y);
    else {
        fprintf(stderr, "oracle_integers.c does not know %s\n", op);
        abort();
    }
    out.overflow = out.overflow || !fits(out.bits, dlen, result_signed);
    out.bits &= oracle_mask(dlen);
    return out;
}
