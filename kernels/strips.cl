/* strips.cl - the part of kernels in strips (strips_text.c) that follows the prelude.
 *
 * Vectors lie where x is a multiple of VECTOR. At the ends of a row some lanes may be beyond
 * its halos. Values loaded there are never used (the memory exists: see DEVICE_GUARD_BYTES),
 * and nothing is stored there.
 */

/* The last column that a store of a whole vector may end at; the halos' columns are in such
 * vectors then. */
#define WHOLE (W % VECTOR ? W - VECTOR : W)

/* Lane by lane, with their copies in the halos. */
#define EDGES(kind)                                                                            \
    __attribute__((noinline)) void edge_store_##kind(__global TYPE_##kind *q, int i,           \
                                                     LANES_OF(TYPE_##kind) v, int W)           \
    {                                                                                          \
        TYPE_##kind t[VECTOR];                                                                 \
        *(JOIN(TYPE_##kind, _anywhere) *)t = v;                                                \
        for (int l = 0; l < VECTOR && i + l < W; l++) {                                        \
            q[i + l] = t[l];                                                                   \
            if (i + l < HALO)                                                                  \
                q[i + l + W] = t[l];                                                           \
            if (i + l >= W - HALO)                                                             \
                q[i + l - W] = t[l];                                                           \
        }                                                                                      \
    }
#define STORE_AT_EDGE(kind, q, i, v)                                                           \
    do {                                                                                       \
        if ((i) + VECTOR <= WHOLE)                                                             \
            STORE_INSIDE(kind, q, i, v);                                                       \
        else                                                                                   \
            edge_store_##kind(q, i, TO_##kind(v), W);                                          \
    } while (0)

/* In the middle of it. The first HALO columns are the right halo, the last ones the left. */
#define AT_END(i) ((i) == 0 || (i) == W - VECTOR)
#define STORE_INSIDE(kind, q, i, v)                                                            \
    do {                                                                                       \
        PASS_##kind(q, i, v);                                                                  \
        if (at_end) {                                                                          \
            if ((i) == 0)                                                                      \
                FIRST_OUT(kind, q, W, v);                                                      \
            if ((i) == W - VECTOR)                                                             \
                LAST_OUT(kind, q, -HALO, v);                                                   \
        }                                                                                      \
    } while (0)

/* Where all of a row is the strip's, in vectors as they come: the last one may end in the halo.
 * Halos follow when the row has been made. What has been stored past the caches (rows of whole
 * vectors) is not read again. */
#define NOT_STORED(kind, q, i, v) (void)0
#if STREAMS
#define STORE_EVEN STORE_INSIDE
#define ROW_ENDS(kind, q, own) (void)0
#else
#define STORE_EVEN(kind, q, i, v) OUT_##kind(q, i, v)
#define ROW_ENDS(kind, q, own)                                                                 \
    do {                                                                                       \
        if (own) {                                                                             \
            FIRST_OUT(kind, q, W, LOAD_##kind(q, 0));                                          \
            LAST_OUT(kind, q, -HALO, LOAD_##kind(q, W - VECTOR));                              \
        }                                                                                      \
    } while (0)
#endif

/* Arrays whose stores bypass the caches must not be prefetched into them. */
#if STREAMS
#define PREFETCH_STORE(q) (void)0
#else
#define PREFETCH_STORE(q) PREFETCH(q, 1)
#endif

/* If there are more arrays than the hardware prefetcher follows, their rows are prefetched
 * one after the other, a few pieces in each iteration of the loop over columns. So few
 * places of the memory are accessed at the same time. */
#define PIECE_BYTES 512
struct row_ahead {
    const __global uchar *at;
    int bytes; /* 0: there are no more */
};
#define ROW_AHEAD(p) {(const __global uchar *)((p) + first), (last - first) * (int)sizeof *(p)},
#if STREAMS
#define STORED_ROW_AHEAD(p)
#else
#define STORED_ROW_AHEAD(p) ROW_AHEAD(p)
#endif
#define FETCH_AHEAD                                                                            \
    for (int i = 0; i < each && ahead[row_ahead].bytes; i++) {                                 \
        const __global uchar *at = ahead[row_ahead].at + done_ahead;                           \
        for (int line = 0; line < PIECE_BYTES; line += 64)                                     \
            PREFETCH(at + line, 0);                                                            \
        done_ahead += PIECE_BYTES;                                                             \
        if (done_ahead >= ahead[row_ahead].bytes) {                                            \
            done_ahead = 0;                                                                    \
            row_ahead++;                                                                       \
        }                                                                                      \
    }
static inline int pieces_each(const struct row_ahead *ahead, int turns)
{
    int pieces = 0;
    for (; ahead->bytes; ahead++)
        pieces += (ahead->bytes + PIECE_BYTES - 1) / PIECE_BYTES;
    return (pieces + turns - 1) / max(turns, 1);
}

/* The halos of a ring's row, when it has been made. */
#define WRAP_RIGHT(kind, q) PUT(TYPE_##kind, q, W, GET(TYPE_##kind, q, 0))
#define WRAP_LEFT(kind, q) PUT(TYPE_##kind, q, -VECTOR, GET(TYPE_##kind, q, W - VECTOR))

#ifdef ABOVE
/* Rows around strips, which are written in place: see borders.cl. */
#define BORDERS (get_global_size(1) * (ABOVE + BELOW))
static inline size_t border_row(int y, int top, int bottom,
                                int down) /* down: the strip's number */
{
    return (size_t)down * (ABOVE + BELOW) + (size_t)((y < top ? y - top : y - bottom) + ABOVE);
}
#endif

static inline int ring(int y, int rows)
{
    y %= rows;
    return y < 0 ? y + rows : y;
}
