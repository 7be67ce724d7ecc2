/* gray_plain.c - see gray_kernel.h. */
#define LANES 4
#define KERNEL font_gray_kernel_plain
#include "gray_kernel.h"
