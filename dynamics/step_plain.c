/* step_plain.c - see step_kernel.h. */
#define LANES 1
#define KERNEL dyn_kernel_plain
#include "step_kernel.h"
