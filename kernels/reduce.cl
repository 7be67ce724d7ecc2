/* reduce.cl - one number for each run of columns of a row; the front end joins the runs.
 *
 * -DKIND=0 bits (ELEMENT uchar .. ulong, ACC ulong)  1 float or double (ELEMENT = ACC)  2 bits
 * in pairs of ulong -DOP= 0 and, 1 or, 2 xor, 3 add, 4 min, 5 max.  Sixteen lanes, by column
 * counted from the run's start; the order of float additions is part of what the machine
 * promises: see machine_reduce(). */
#pragma OPENCL FP_CONTRACT OFF
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)
#define CONVERT16_(type) convert_##type##16
#define CONVERT16(type) CONVERT16_(type)

#if KIND != 2
#if OP == 0
#define COMBINED(a, v) ((a) & (v))
#elif OP == 1
#define COMBINED(a, v) ((a) | (v))
#elif OP == 2
#define COMBINED(a, v) ((a) ^ (v))
#elif OP == 3
#define COMBINED(a, v) ((a) + (v))
#elif OP == 4
#define COMBINED(a, v) ((v) < (a) ? (v) : (a))
#else
#define COMBINED(a, v) ((v) > (a) ? (v) : (a))
#endif

typedef JOIN(ACC, 16) ACC16;

static inline ACC combine(ACC a, ACC v)
{
    return COMBINED(a, v);
}

static inline ACC16 combine16(ACC16 a, ACC16 v)
{
    return COMBINED(a, v);
}

__kernel void reduce(int W, int PITCH, int HALO_COLUMNS, int RUN, ACC identity,
                     const __global ELEMENT *in, __global ACC *out)
{
    const int row = get_global_id(1), begin = get_global_id(0) * RUN, end = min(begin + RUN, W);
    const __global ELEMENT *p = in + ((size_t)row * PITCH + HALO_COLUMNS);
    ACC16 sum = (ACC16)(identity);
    int x = begin;
    for (; x + 16 <= end; x += 16)
        sum = combine16(sum, CONVERT16(ACC)(vload16(0, p + x)));
    ACC lanes[16];
    vstore16(sum, 0, lanes);
    for (int lane = 0; x < end; x++, lane++)
        lanes[lane] = combine(lanes[lane], (ACC)p[x]);
    for (int apart = 8; apart; apart /= 2)
        for (int lane = 0; lane < apart; lane++)
            lanes[lane] = combine(lanes[lane], lanes[lane + apart]);
    out[(size_t)row * get_global_size(0) + get_global_id(0)] = lanes[0];
}
#else
__kernel void reduce(int W, int PITCH, int HALO_COLUMNS, int RUN, ulong lo, ulong hi,
                     const __global ulong *in, __global ulong *out)
{
    const int row = get_global_id(1), begin = get_global_id(0) * RUN, end = min(begin + RUN, W);
    const __global ulong *p = in + 2 * ((size_t)row * PITCH + HALO_COLUMNS);
    for (int x = begin; x < end; x++) {
        ulong vl = p[2 * x], vh = p[2 * x + 1];
        int less = vh < hi || (vh == hi && vl < lo), more = vh > hi || (vh == hi && vl > lo);
#if OP == 0
        lo &= vl, hi &= vh;
#elif OP == 1
        lo |= vl, hi |= vh;
#elif OP == 2
        lo ^= vl, hi ^= vh;
#elif OP == 3
        hi += vh + (lo + vl < vl);
        lo += vl;
#elif OP == 4
        lo = less ? vl : lo, hi = less ? vh : hi;
#else
        lo = more ? vl : lo, hi = more ? vh : hi;
#endif
    }
    const size_t at = (size_t)row * get_global_size(0) + get_global_id(0);
    out[2 * at] = lo;
    out[2 * at + 1] = hi;
}
#endif
