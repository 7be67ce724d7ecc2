/* lanes_masks.h - bits of a block as a whole. Part of fast_loops.h, which is compiled once for each instruction set. */

/* Whether bits are the same in all lanes. */
static inline bool mask_is_even(const u8 *c, int n)
{
    enum { LINE = 64 };
    u8 differ = 0;
    int i = 0;
    for (; i + LINE <= n && !differ; i += LINE)
        for (int k = 0; k < LINE; k++)
            differ |= (u8)(c[i + k] ^ c[0]);
    for (; i < n && !differ; i++)
        differ |= (u8)(c[i] ^ c[0]);
    return !differ;
}

enum { MASK_RUN = 64 };

static inline bool mask_is_empty(const u8 *c)
{
    u64 bits[MASK_RUN / sizeof(u64)], any = 0;
    memcpy(bits, c, sizeof bits);
    for (size_t i = 0; i < sizeof bits / sizeof *bits; i++)
        any |= bits[i];
    return !any;
}

/* Whole runs of lanes without those at both ends where the bit is 0 in all; from == end: there is no other. */
struct mask_window {
    int from, end;
};

static inline struct mask_window mask_window(const u8 *c, int n)
{
    struct mask_window w = {0, n};
    while (w.from + MASK_RUN <= n && mask_is_empty(c + w.from))
        w.from += MASK_RUN;
    while (w.end - MASK_RUN >= w.from && mask_is_empty(c + w.end - MASK_RUN))
        w.end -= MASK_RUN;
    return w;
}

static inline u64 mask_eight(const u8 *c)
{
    u64 bits;
    memcpy(&bits, c, sizeof bits);
    return bits;
}

/* From the first lane where the bit is 1 to the last. */
static inline struct mask_window mask_trimmed(const u8 *c, struct mask_window w)
{
    while (w.from + 8 < w.end && !mask_eight(c + w.from))
        w.from += 8;
    while (w.from < w.end && !c[w.from])
        w.from++;
    while (w.from + 8 < w.end && !mask_eight(c + w.end - 8))
        w.end -= 8;
    while (w.from < w.end && !c[w.end - 1])
        w.end--;
    return w;
}
