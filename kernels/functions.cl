/* functions.cl - declares the functions of OpenCL C that the machine's kernels call.
 *
 * A driver that compiles with clang reads a header of all OpenCL functions before each
 * kernel, which takes most of the time of compiling a small one. Where the header can be
 * left out (device/programs.c), this file replaces it, with the same names, types and
 * attributes. If a function is missing here, compiling fails, and the kernel is compiled
 * with the header.
 */
#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#define CONSTANT __attribute__((overloadable, const))
#define CHANGING __attribute__((overloadable))
#define READING __attribute__((overloadable, pure))

size_t CONSTANT get_global_id(uint);
size_t CONSTANT get_global_size(uint);
size_t CONSTANT get_local_id(uint);
size_t CONSTANT get_group_id(uint);
void __attribute__((overloadable, convergent)) barrier(cl_mem_fence_flags);

/* Of T, and of vectors of it. */
#define WIDTHS(EACH, T) EACH(T) EACH(T##2) EACH(T##4) EACH(T##8) EACH(T##16)
#define INTEGERS(EACH)                                                                         \
    WIDTHS(EACH, int) WIDTHS(EACH, uint) WIDTHS(EACH, long) WIDTHS(EACH, ulong)
#define FLOATS(EACH) WIDTHS(EACH, float) WIDTHS(EACH, double)

#define OF_INTEGERS(T)                                                                         \
    T CONSTANT min(T, T);                                                                      \
    T CONSTANT max(T, T);                                                                      \
    T CONSTANT mul_hi(T, T);                                                                   \
    T CONSTANT clz(T);                                                                         \
    T CONSTANT popcount(T);
INTEGERS(OF_INTEGERS)

#define OF_FLOATS(T)                                                                           \
    T CONSTANT fma(T, T, T);                                                                   \
    T CONSTANT fabs(T);                                                                        \
    T CONSTANT sqrt(T);                                                                        \
    T CONSTANT rint(T);                                                                        \
    T CONSTANT floor(T);                                                                       \
    T CONSTANT ceil(T);                                                                        \
    T CONSTANT trunc(T);                                                                       \
    T CONSTANT fmin(T, T);                                                                     \
    T CONSTANT fmax(T, T);
FLOATS(OF_FLOATS)

#define OF_TRUTHS(T)                                                                           \
    int CONSTANT any(T);                                                                       \
    int CONSTANT all(T);
WIDTHS(OF_TRUTHS, int)
WIDTHS(OF_TRUTHS, long)

#define FROM(TO, N, T) TO##N CONSTANT convert_##TO##N(T##N);
#define TO(TO_, N)                                                                             \
    FROM(TO_, N, uchar)                                                                        \
    FROM(TO_, N, ushort)                                                                       \
    FROM(TO_, N, int)                                                                          \
    FROM(TO_, N, uint)                                                                         \
    FROM(TO_, N, long)                                                                         \
    FROM(TO_, N, ulong)                                                                        \
    FROM(TO_, N, float)                                                                        \
    FROM(TO_, N, double)
#define CONVERSIONS(N)                                                                         \
    TO(uchar, N)                                                                               \
    TO(ushort, N) TO(int, N) TO(uint, N) TO(long, N) TO(ulong, N) TO(float, N) TO(double, N)
CONVERSIONS(4)
CONVERSIONS(8)
CONVERSIONS(16)

#define LOADS(T, N, SPACE)                                                                     \
    T##N READING vload##N(size_t, const SPACE T *);                                            \
    void CHANGING vstore##N(T##N, size_t, SPACE T *);
#if defined(__opencl_c_generic_address_space)
#define LOADS_ANY(T, N) LOADS(T, N, )
#else
#define LOADS_ANY(T, N)
#endif
#if defined(__opencl_c_named_address_space_builtins)
#define LOADS_NAMED(T, N) LOADS(T, N, __global) LOADS(T, N, __local) LOADS(T, N, __private)
#else
#define LOADS_NAMED(T, N)
#endif
#define LOADS_OF(T)                                                                            \
    LOADS_ANY(T, 4)                                                                            \
    LOADS_ANY(T, 8)                                                                            \
    LOADS_ANY(T, 16)                                                                           \
    LOADS_NAMED(T, 4)                                                                          \
    LOADS_NAMED(T, 8)                                                                          \
    LOADS_NAMED(T, 16)
LOADS_OF(uchar)
LOADS_OF(ushort)
LOADS_OF(int)
LOADS_OF(uint)
LOADS_OF(long)
LOADS_OF(ulong)
LOADS_OF(float)
LOADS_OF(double)

int CHANGING atomic_max(volatile __global int *, int);
uint CHANGING atomic_max(volatile __global uint *, uint);

#undef CONSTANT
#undef CHANGING
#undef READING
#undef WIDTHS
#undef INTEGERS
#undef FLOATS
#undef FROM
#undef TO
#undef CONVERSIONS
#undef LOADS
#undef LOADS_OF
