/* lanes_avx512.c - see fast_loops.h. */
#define TABLE lanes_table_avx512
#define LANES_X86
#include "interpret/fast_loops.h"
