/* tables.h - the interpreter's loops for each instruction set that this processor has. */
#ifndef LUTETIA_TESTS_TABLES_H
#define LUTETIA_TESTS_TABLES_H

#include "interpret/lanes.h"

struct tables {
    const struct lanes_table *of[3];
    int count;
};

static inline struct tables tables_here(void)
{
    struct tables t = {{&lanes_table_plain}, 1};
#if defined(__x86_64__)
    extern const struct lanes_table lanes_table_avx2, lanes_table_avx512;
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2"))
        t.of[t.count++] = &lanes_table_avx2;
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq"))
        t.of[t.count++] = &lanes_table_avx512;
#endif
    return t;
}

#endif
