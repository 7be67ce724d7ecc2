/* lanes_avx2.c - see fast_loops.h. */
#define TABLE lanes_table_avx2
#define LANES_X86
#include "interpret/fast_loops.h"
