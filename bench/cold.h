/* cold.h - what a first run takes: in a process of its own, whose caches of kernels are empty.
 *
 * The process is this program, called `lutetia-bench BENCH --cold-into WHAT FILE`. It runs WHAT
 * once and tells by cold_tell() how that went. */
#ifndef LUTETIA_BENCH_COLD_H
#define LUTETIA_BENCH_COLD_H

#include <stdbool.h>
#include <stdint.h>

#define COLD_FLAG "--cold-into"

struct cold {
    double seconds, kernels; /* kernels: compiled by then */
    uint32_t result;
};

/* Errors: false. */
bool cold_measure(const char *bench, const char *what, struct cold *out);
bool cold_tell(const char *path, const struct cold *c);
/* Removes a folder of caches with all that is in it. */
void cold_folder_remove(const char *folder);

#endif
