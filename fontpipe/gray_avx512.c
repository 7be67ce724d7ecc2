/* gray_avx512.c - see gray_kernel.h. */
#define LANES 16
#define KERNEL font_gray_kernel_avx512
#include "gray_kernel.h"
