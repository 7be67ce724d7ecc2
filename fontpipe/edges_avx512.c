/* edges_avx512.c - see edges_kernel.h. */
#define LANES 16
#define KERNEL font_edges_kernel_avx512
#include "edges_kernel.h"
