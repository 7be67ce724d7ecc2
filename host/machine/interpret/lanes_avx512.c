/* lanes_avx512.c - see lanes_kernel.h. */
#define TABLE lanes_table_avx512
#define LANES_X86
#include "interpret/lanes_kernel.h"
