/* gray_avx2.c - see gray_kernel.h. */
#define LANES 8
#define KERNEL font_gray_kernel_avx2
#include "gray_kernel.h"
