/* lanes_plain.c - see fast_loops.h. */
#define TABLE lanes_table_plain
#include "interpret/fast_loops.h"
