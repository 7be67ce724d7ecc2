/* lanes_avx2.c - see lanes_kernel.h. */
#define TABLE lanes_table_avx2
#define LANES_X86
#include "interpret/lanes_kernel.h"
