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

/* The first lane where the bit is 1, and the one after the last; from == end: there is none. */
struct mask_window {
    int from, end;
};

static inline u64 mask_eight(const u8 *c)
{
    u64 bits;
    memcpy(&bits, c, sizeof bits);
    return bits;
}

static inline struct mask_window mask_window(const u8 *c, int n)
{
    struct mask_window w = {0, n};
    while (w.from + 32 <= n && !(mask_eight(c + w.from) | mask_eight(c + w.from + 8) |
                                 mask_eight(c + w.from + 16) | mask_eight(c + w.from + 24)))
        w.from += 32;
    while (w.from < n && !c[w.from])
        w.from++;
    while (w.end - 32 >= w.from && !(mask_eight(c + w.end - 32) | mask_eight(c + w.end - 24) |
                                     mask_eight(c + w.end - 16) | mask_eight(c + w.end - 8)))
        w.end -= 32;
    while (w.end > w.from && !c[w.end - 1])
        w.end--;
    return w;
}
