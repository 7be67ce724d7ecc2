/* step_avx2.c - see step_kernel.h. */
#define LANES 4
#define KERNEL dyn_kernel_avx2
#include "step_kernel.h"
