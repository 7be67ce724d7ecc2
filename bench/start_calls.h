/* start_calls.h - how long a call of a program takes that is as no benchmark: long pieces that
 * never repeat, and bodies of loops of hundreds of calls, on a small set, so that what a call
 * takes is planning, building, loading. */
#ifndef LUTETIA_BENCH_START_CALLS_H
#define LUTETIA_BENCH_START_CALLS_H

#include <stdbool.h>

/* Runs the program; tells the longest call and the time of all of them in seconds. The first
 * piece, with which the machine starts, does not count. Errors: false. */
bool start_calls_run(double *longest_s, double *all_s);

#endif
