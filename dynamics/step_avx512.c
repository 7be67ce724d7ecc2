/* step_avx512.c - see step_kernel.h. */
#define LANES 8
#define KERNEL dyn_kernel_avx512
#include "step_kernel.h"
