/* lanes_masks.h - bits of a block as a whole. Part of fast_loops.h, which is compiled once for
 * each instruction set. */

enum { MASK_RUN = 64 };
/* From so many lanes that are alike on they are copied: those of 32 bits are chosen fast enough
 * one by one. */
#define MASK_PAYS(T) (sizeof(T) == 4 ? 2 * MASK_RUN : MASK_RUN)
/* Lane i of a where bit i is 1, else of b. Compilers have no good loop of 8 or 16 bits for the
 * choice. */
#define CHOSEN(T)                                                                              \
    (sizeof(T) <= 2 ? (T)(b[i] ^ ((a[i] ^ b[i]) & (T)(0u - c[i]))) : c[i] ? a[i] : b[i])

/* Whether any of a run's bits is another than that. */
static inline bool mask_run_differs(const u8 *c, u8 bit)
{
    const u64 all = bit * UINT64_C(0x0101010101010101);
    u64 bits[MASK_RUN / sizeof(u64)], differ = 0;
    memcpy(bits, c, sizeof bits);
    for (size_t i = 0; i < sizeof bits / sizeof *bits; i++)
        differ |= bits[i] ^ all;
    return differ != 0;
}

/* How many lanes are as the first, in whole runs; n: all. */
static inline int mask_same(const u8 *c, int n)
{
    int i = 0, k;
    while (i + MASK_RUN <= n && !mask_run_differs(c + i, c[0]))
        i += MASK_RUN;
    if (i == n || i + MASK_RUN <= n)
        return i;
    if (n >= MASK_RUN) /* with lanes that are known */
        return mask_run_differs(c + n - MASK_RUN, c[0]) ? i : n;
    for (k = i; k < n && c[k] == c[0];)
        k++;
    return k < n ? i : n;
}

/* How many lanes are left of n without runs at the end where the bit is 0 in all. */
static inline int mask_end(const u8 *c, int n)
{
    while (n >= MASK_RUN && !mask_run_differs(c + n - MASK_RUN, 0))
        n -= MASK_RUN;
    return n;
}
