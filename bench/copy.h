/* copy.h - the bandwidth of the memory that the machine's device computes in, as one of the
 * contenders: a run copies an array. Its rate counts bytes read and written.
 *
 * A device that shares the front end's memory is a CPU: its threads copy, with stores that
 * bypass the caches if the compiler supports them. Another one copies a buffer of its own. */
#ifndef LUTETIA_BENCH_COPY_H
#define LUTETIA_BENCH_COPY_H

#include <stddef.h>

#include "harness.h"

struct bench_copy;
struct bench_copy *bench_copy_create(size_t bytes); /* Errors: NULL */
void bench_copy_destroy(struct bench_copy *c);      /* takes NULL */
bench_work bench_copy_work;
/* GB/s, from the seconds of its runs; min is the best. */
struct bench_sample bench_copy_rate(const struct bench_copy *c, struct bench_sample seconds);

#endif
