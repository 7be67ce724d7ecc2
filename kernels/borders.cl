/* borders.cl - the rows around strips, copied before strips write where they read: see
 * host/machine/codegen/strips.h.
 *
 * to: one array after the other; those whose bit in `which` is not set are skipped but have
 * room. For each array and each strip of `run` rows it holds the `above` rows before the
 * strip and the `below` rows after it. bytes: of an array's elements, four bits for each
 * array.
 */
#define ARRAYS(F)                                                                              \
    F(0) F(1) F(2) F(3) F(4) F(5) F(6) F(7) F(8) F(9) F(10) F(11) F(12) F(13) F(14) F(15)
#define PARAMETER(n) , const __global uchar *a##n
#define CASE(n)                                                                                \
    case n:                                                                                    \
        from = a##n;                                                                           \
        break;

typedef ulong2 vector __attribute__((aligned(1)));

__kernel void borders(uint pitch, int rows, int run, int above, int below, uint which,
                      ulong bytes, ulong begin, __global uchar *to ARRAYS(PARAMETER))
{
    const int array = get_global_id(2), strip = get_global_id(1), row = get_global_id(0);
    if (!(which >> array & 1))
        return;
    const __global uchar *from = a0;
    switch (array) {
        ARRAYS(CASE)
    }
    uint before = 0;
    for (int i = 0; i < array; i++)
        before += bytes >> 4 * i & 15;
    const uint size = bytes >> 4 * array & 15;
    const int top = strip * run, bottom = min(top + run, rows);
    const int y = row < above ? top - above + row : bottom + row - above;
    const int strips = get_global_size(1);
    to += begin + (ulong)pitch * ((ulong)(strips * (above + below)) * before +
                                  (ulong)(strip * (above + below) + row) * size);
    from += (ulong)((y % rows + rows) % rows) * pitch * size;
    /* pitches are multiples of 16 elements */
    const __global vector *f = (const __global vector *)from;
    __global vector *t = (__global vector *)to;
    for (uint i = 0; i < pitch * size / 16; i++)
        t[i] = f[i];
}
