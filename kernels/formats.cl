/* formats.cl - floats of short formats (s <= 24, e <= 9: see host/machine/values/soft.c) on
 * vectors. Their values are doubles that the format has; soft.cl does the same and all other
 * formats, one lane at a time. */
#define SHORT_SIGN ((ulong)1 << 63)
#define SHORT_INFINITE ((ulong)0x7ff << 52)
/* 2^n as a double's bits */
#define SHORT_POWER(n) ((ulong)(1023 + (n)) << 52)

/* x rounded to nearest even: by adding and subtracting a number so large that the sum's last
 * place is that of the result. */
static inline VD short_fit(VD x, int s, int e)
{
    const int most = (1 << (e - 1)) - 1, least = 1 - most;
    VL bits = AS_L(x), limit = (VL)(SHORT_POWER(most + 1));
    VL power = min(max(bits & SHORT_INFINITE, (VL)(SHORT_POWER(least))), limit);
    VD great = AS_D(power + (((ulong)(52 - s) << 52) + ((ulong)1 << 51)));
    VL r = AS_L((x + great) - great) & ~SHORT_SIGN;
    r = SEL_L(CMP_L(r >= limit), (VL)(SHORT_INFINITE), r) | (bits & SHORT_SIGN);
    return SEL_D(CMP_L(x == x), AS_D(r), x);
}

/* s + e + 1 bits of any double. Of a NaN the upper bits of its fraction; where these are 0, the
 * quiet one. */
static inline VL short_pack(VD x, int s, int e)
{
    const int most = (1 << (e - 1)) - 1, least = 1 - most;
    const ulong ones = (((ulong)1 << e) - 1) << s, unit = SHORT_POWER(least - s + 52);
    VL bits = AS_L(short_fit(x, s, e)), magnitude = bits & ~SHORT_SIGN;
    VL normal = (magnitude >> (ulong)(52 - s)) - ((ulong)(1023 - most) << s);
    VL small = AS_L(AS_D(magnitude) + as_double(unit)) - unit;
    VL r = SEL_L(CMP_L(magnitude < (VL)(SHORT_POWER(least))), small, normal);
    r = SEL_L(CMP_L(magnitude == (VL)(SHORT_INFINITE)), (VL)(ones), r) |
        (bits & SHORT_SIGN) >> (ulong)(63 - s - e);
    VL given = AS_L(x), fraction = (given & (((ulong)1 << 52) - 1)) >> (ulong)(52 - s);
    VL nan = SEL_L(CMP_L(fraction == (VL)((ulong)0)), (VL)((ulong)1 << (s - 1)), fraction);
    return SEL_L(CMP_L(x == x), r, nan | ones | (given & SHORT_SIGN) >> (ulong)(63 - s - e));
}

static inline VD short_unpack(VL bits, int s, int e)
{
    const int most = (1 << (e - 1)) - 1, least = 1 - most;
    const ulong ones = (((ulong)1 << e) - 1) << s, unit = SHORT_POWER(least - s + 52);
    VL magnitude = bits & (((ulong)1 << (s + e)) - 1);
    VL normal = (magnitude << (ulong)(52 - s)) + ((ulong)(1023 - most) << 52);
    VL small = AS_L(AS_D(magnitude | unit) - as_double(unit));
    VL r = SEL_L(CMP_L(magnitude < (VL)((ulong)1 << s)), small, normal);
    VL endless = (magnitude & (((ulong)1 << s) - 1)) << (ulong)(52 - s) | SHORT_INFINITE;
    r = SEL_L(CMP_L(magnitude >= (VL)(ones)), endless, r) | (bits & ((ulong)1 << (s + e)))
                                                                << (ulong)(63 - s - e);
    return AS_D(r);
}
