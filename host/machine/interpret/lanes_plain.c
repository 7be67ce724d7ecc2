/* lanes_plain.c - see lanes_kernel.h. */
#define TABLE lanes_table_plain
#include "interpret/lanes_kernel.h"
