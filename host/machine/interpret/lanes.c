/* lanes.c - which loop performs an operation: see lanes.h. */
#include "interpret/lanes.h"

#include "base/types.h"

size_t lanes_bytes(enum lanes_class c)
{
    static const uint8_t bytes[LANES_CLASSES] = {1, 2, 4, 8, 16, 4, 8};
    return bytes[c];
}

const struct lanes_table *lanes_table(void)
{
#ifdef LANES_X86
    static const struct lanes_table *chosen;
    const struct lanes_table *t = __atomic_load_n(&chosen, __ATOMIC_RELAXED);
    if (t)
        return t;
    __builtin_cpu_init();
    bool avx2 = __builtin_cpu_supports("avx2"),
         avx512 = avx2 && __builtin_cpu_supports("avx512f") &&
                  __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
                  __builtin_cpu_supports("avx512dq");
    t = avx512 ? &lanes_table_avx512 : avx2 ? &lanes_table_avx2 : &lanes_table_plain;
    __atomic_store_n(&chosen, t, __ATOMIC_RELAXED);
    return t;
#else
    return &lanes_table_plain;
#endif
}

lanes_function *lanes_find(int op, enum lanes_class c)
{
    return lanes_table()->of[op][c];
}

lanes_function *lanes_find_conversion(int op, enum lanes_class from, enum lanes_class to)
{
    if (op >= NODE_OP_COUNT)
        return NULL;
    if (op == NODE_EXTRACT)
        op = NODE_ZERO_EXTEND;
    return lanes_table()->convert[op][from][to];
}
