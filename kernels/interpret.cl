/* interpret.cl - byte code on a device: one kernel that performs any plan's steps, a work-item
 * for each processor.
 *
 * It is for devices with memory of their own, where the front end cannot perform the steps
 * itself (host/machine/interpret). It follows lane.cl.
 *
 *     words    rank, the axes' lengths; then the steps, STEP_WORDS each; then where neighbours
 *              are
 *     step     operation, result, three operands, widths, formats, detail, family, how many
 *              bits the result has
 *     operand  kind << 28 | log2 of its bytes << 24 | number */
#define STEP_WORDS 10
#define ARRAYS_MOST 48
#define NUMBERS_MOST 32
#define REGISTERS_MOST 64

#define OPERAND_NONE 0
#define OPERAND_ARRAY 1
#define OPERAND_MOVED 2
#define OPERAND_REGISTER 3
#define OPERAND_NUMBER 4

/* ---- memory ---- */

static VQ element_load(const __global uchar *p, size_t i, int log2_bytes)
{
    switch (log2_bytes) {
    case 0:
        return q_of(p[i], 0);
    case 1:
        return q_of(((const __global ushort *)p)[i], 0);
    case 2:
        return q_of(((const __global uint *)p)[i], 0);
    case 3:
        return q_of(((const __global ulong *)p)[i], 0);
    default:
        return q_of(((const __global ulong *)p)[2 * i], ((const __global ulong *)p)[2 * i + 1]);
    }
}

static void element_store(__global uchar *p, size_t i, int log2_bytes, VQ v)
{
    switch (log2_bytes) {
    case 0:
        p[i] = (uchar)v.lo;
        break;
    case 1:
        ((__global ushort *)p)[i] = (ushort)v.lo;
        break;
    case 2:
        ((__global uint *)p)[i] = (uint)v.lo;
        break;
    case 3:
        ((__global ulong *)p)[i] = v.lo;
        break;
    default:
        ((__global ulong *)p)[2 * i] = v.lo;
        ((__global ulong *)p)[2 * i + 1] = v.hi;
        break;
    }
}

/* Where a work-item is. */
typedef struct {
    const __global int *lengths; /* of the axes */
    int rank, x, row, pitch, halo;
} processor;

/* The place of the processor that lies so much further along each axis, in an array. */
static size_t place_moved(const processor *p, const __global int *further)
{
    const int last = p->rank - 1;
    size_t moved = 0, stride = 1;
    int row = p->row;
    for (int a = last - 1; a >= 0; a--) {
        const int length = p->lengths[a], c = row % length;
        row /= length;
        moved += (size_t)wrap(c + further[a], length) * stride;
        stride *= (size_t)length;
    }
    return moved * (size_t)p->pitch + (size_t)p->halo +
           (size_t)wrap(p->x + further[last], p->lengths[last]);
}

static size_t place_own(const processor *p)
{
    return (size_t)p->row * (size_t)p->pitch + (size_t)p->halo + (size_t)p->x;
}

/* An operand that is an array's element, or none. */
static VQ array_load(const processor *p, const __global int *words,
                     __global uchar *const *arrays, int operand)
{
    const int at = operand & 0xffffff, log2_bytes = operand >> 24 & 15;
    if (operand >> 28 == OPERAND_ARRAY)
        return element_load(arrays[at], place_own(p), log2_bytes);
    if (operand >> 28 == OPERAND_MOVED)
        return element_load(arrays[words[at]], place_moved(p, words + at + 1), log2_bytes);
    return q_of(0, 0);
}

/* The first columns of a row are the right halo, too, the last ones the left. */
static void array_store(const processor *p, __global uchar *array, int log2_bytes, VQ v)
{
    const size_t here = place_own(p), width = (size_t)p->lengths[p->rank - 1];
    element_store(array, here, log2_bytes, v);
    if (p->x < p->halo)
        element_store(array, here + width, log2_bytes, v);
    if (p->x >= (int)width - p->halo)
        element_store(array, here - width, log2_bytes, v);
}

/* ---- functions of a place ---- */

static uint coordinate(const processor *p, int axis)
{
    int row = p->row;
    if (axis == p->rank - 1)
        return (uint)p->x;
    for (int a = p->rank - 2; a > axis; a--)
        row /= p->lengths[a];
    return (uint)(row % p->lengths[axis]);
}

/* A random number: see machine_random(). detail 0: the high bits; 1: below a limit of 32 bits;
 * 2: below any. */
static ulong drawn(const step_said *s, uint index, ulong key, ulong limit)
{
    const ulong r = random_bits(index, key);
    return s->detail == 0   ? r >> (64 - s->to_width)
           : s->detail == 1 ? ((r >> 32) * limit) >> 32
                            : mul_hi(r, limit);
}

static ulong placed(const processor *p, const step_said *s, int ratio, uint index, VQ number)
{
    const uint low = (1u << (s->detail & 31)) - 1;
    switch (s->op) {
    case NODE_COORDINATE:
        return coordinate(p, s->detail);
    case NODE_INDEX:
        return (uint)p->row * (uint)p->lengths[p->rank - 1] + (uint)p->x;
    case LANES_PLACE:
        return (index & low) * (uint)ratio + (index >> s->detail);
    case LANES_DRAW:
        return drawn(s, index, number.lo, number.hi);
    }
    return 0;
}

/* ---- steps ---- */

static step_said step_read(const __global int *step)
{
    step_said s;
    s.op = step[0];
    s.from_width = step[5] & 255;
    s.to_width = step[5] >> 8 & 255;
    s.from_float = step[5] >> 16 & 1;
    s.from_s = step[6] & 255;
    s.from_e = step[6] >> 8 & 255;
    s.to_s = step[6] >> 16 & 255;
    s.to_e = step[6] >> 24 & 255;
    s.detail = step[7];
    s.family = step[8];
    return s;
}

/* Eight arrays as parameters, and as a list. */
#define EIGHT_GIVEN(k)                                                                         \
    __global uchar *a##k##0, __global uchar *a##k##1, __global uchar *a##k##2,                 \
        __global uchar *a##k##3, __global uchar *a##k##4, __global uchar *a##k##5,             \
        __global uchar *a##k##6, __global uchar *a##k##7
#define EIGHT(k) a##k##0, a##k##1, a##k##2, a##k##3, a##k##4, a##k##5, a##k##6, a##k##7

__kernel void interpret(const __global int *words, int steps, int pitch, int halo, int ratio,
                        ulong16 n0, ulong16 n1, ulong16 n2, ulong16 n3, EIGHT_GIVEN(0),
                        EIGHT_GIVEN(1), EIGHT_GIVEN(2), EIGHT_GIVEN(3), EIGHT_GIVEN(4),
                        EIGHT_GIVEN(5))
{
    __global uchar *arrays[ARRAYS_MOST] = {EIGHT(0), EIGHT(1), EIGHT(2),
                                           EIGHT(3), EIGHT(4), EIGHT(5)};
    ulong numbers[2 * NUMBERS_MOST], registers[REGISTERS_MOST];
    vstore16(n0, 0, numbers);
    vstore16(n1, 1, numbers);
    vstore16(n2, 2, numbers);
    vstore16(n3, 3, numbers);
    const processor here = {words + 1,        words[0], get_global_id(0),
                            get_global_id(1), pitch,    halo};
    const __global int *step = words + 1 + here.rank;
    for (int i = 0; i < steps; i++, step += STEP_WORDS) {
        const step_said s = step_read(step);
        VQ in[3], r;
        for (int k = 0; k < 3; k++) {
            const int operand = step[2 + k], at = operand & 0xffffff,
                      log2_bytes = operand >> 24 & 15;
            if (operand >> 28 == OPERAND_REGISTER)
                in[k] = q_of(registers[at], log2_bytes == 4 ? registers[at + 1] : 0);
            else if (operand >> 28 == OPERAND_NUMBER)
                in[k] = q_of(numbers[2 * at], numbers[2 * at + 1]);
            else
                in[k] = array_load(&here, words, arrays, operand);
        }
        if (s.op == LANES_FETCH)
            r = (uint)in[0].lo < (uint)in[2].lo
                    ? element_load(arrays[s.detail & 0xffffff], (uint)in[0].lo,
                                   s.detail >> 24 & 15)
                    : q_of(0, 0);
        else
            r = s.family == SPELL_PLACE
                    ? q_of(placed(&here, &s, ratio, (uint)in[0].lo, in[1]), 0)
                    : lane_performed(&s, in[0], in[1], in[2]);
        r = q_and(r, lane_ones(step[9]));
        const int at = step[1] & 0xffffff, log2_bytes = step[1] >> 24 & 15;
        if (step[1] >> 28 == OPERAND_REGISTER) {
            registers[at] = r.lo;
            if (log2_bytes == 4)
                registers[at + 1] = r.hi;
        } else {
            array_store(&here, arrays[at], log2_bytes, r);
        }
    }
}
