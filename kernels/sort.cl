/* sort.cl - one pass of a radix sort from the lowest digit, along lines, and ranks from the
 * last.
 *
 * A line is divided into chunks. PART 0 counts the digits of each chunk; the counts, by digit
 * and then by chunk, are summed up (scan.cl) and say where each chunk's first key of each digit
 * goes; PART 1 puts keys there in order, so that equal digits keep theirs. Keys of more than 32
 * bits are sorted word by word. SOURCE says where a key comes from: 0 the word itself, in its
 * line's order; 1 a pair (key, position along the axis) of the pass before; 2 the word at the
 * position that a pair of the word before has, which PART 0 puts into the pair.
 *
 * Geometry as in scan.cl, one line in each work-item.
 */
enum { WORD, PAIR, GATHER };

#define PLACE                                                                                  \
    const int column = (int)(get_global_id(1) % (size_t)columns);                              \
    const size_t rows = get_global_size(1) / (size_t)columns;                                  \
    const size_t inner = get_global_id(1) / (size_t)columns, outer = get_global_id(2);         \
    const size_t line = (outer * rows + inner) * (size_t)columns + (size_t)column;             \
    const size_t row = base + inner * inner_stride + outer * outer_stride + (size_t)column;    \
    const int chunk = (int)get_global_id(0), chunks = (int)get_global_size(0);                 \
    const int begin = chunk * run, end = min(begin + run, length);                             \
    const uint mask = (1u << bits) - 1u;                                                       \
    uint place[1 << DIGIT];

#if PART == 0
__kernel void sort(ulong base, ulong step, ulong inner_stride, ulong outer_stride, int length,
                   int run, int columns, int source, int shift, int bits,
                   const __global uint *word, __global uint2 *pairs, __global uint *counts)
{
    PLACE
    for (uint b = 0; b <= mask; b++)
        place[b] = 0;
    __global uint2 *mine = pairs + line * (size_t)length;
    if (source == WORD)
        for (int k = begin; k < end; k++)
            place[word[row + (size_t)k * step] >> shift & mask]++;
    else if (source == PAIR)
        for (int k = begin; k < end; k++)
            place[mine[k].x >> shift & mask]++;
    else
        for (int k = begin; k < end; k++) {
            const uint key = word[row + (size_t)mine[k].y * step];
            mine[k].x = key;
            place[key >> shift & mask]++;
        }
    __global uint *to = counts + ((line << bits) * (size_t)chunks + (size_t)chunk);
    for (uint b = 0; b <= mask; b++)
        to[b * (size_t)chunks] = place[b];
}
#else
__kernel void sort(ulong base, ulong step, ulong inner_stride, ulong outer_stride, int length,
                   int run, int columns, int source, int shift, int bits,
                   const __global uint *word, const __global uint2 *pairs,
                   const __global uint *counts, int last, int width, int halo, int along,
                   __global uint2 *sorted, __global uint *ranks)
{
    PLACE
    const __global uint *from = counts + ((line << bits) * (size_t)chunks + (size_t)chunk);
    for (uint b = 0; b <= mask; b++)
        place[b] = from[b * (size_t)chunks];
    const __global uint2 *mine = pairs + line * (size_t)length;
    __global uint2 *to = sorted + line * (size_t)length;
    if (!last) {
        if (source == WORD)
            for (int k = begin; k < end; k++) {
                const uint key = word[row + (size_t)k * step];
                to[place[key >> shift & mask]++] = (uint2)(key, (uint)k);
            }
        else
            for (int k = begin; k < end; k++) {
                const uint2 pair = mine[k];
                to[place[pair.x >> shift & mask]++] = pair;
            }
        return;
    }
    for (int k = begin; k < end; k++) {
        const uint2 pair =
            source == WORD ? (uint2)(word[row + (size_t)k * step], (uint)k) : mine[k];
        const size_t at = row + (size_t)pair.y * step;
        const uint rank = place[pair.x >> shift & mask]++;
        const int c = along ? (int)pair.y : column;
        ranks[at] = rank;
        if (c < halo)
            ranks[at + (size_t)width] = rank;
        if (c >= width - halo)
            ranks[at - (size_t)width] = rank;
    }
}
#endif
