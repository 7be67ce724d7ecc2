/* edges_avx2.c - see edges_kernel.h. */
#define LANES 8
#define KERNEL font_edges_kernel_avx2
#include "edges_kernel.h"
