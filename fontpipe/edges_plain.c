/* edges_plain.c - see edges_kernel.h. */
#define LANES 4
#define KERNEL font_edges_kernel_plain
#include "edges_kernel.h"
