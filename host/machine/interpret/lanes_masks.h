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
