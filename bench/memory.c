/* memory.c - `lutetia bench memory`: the most bytes that arrays take at once, for the programs of works.h.
 *
 *     one by one   each instruction is computed at once (LUTETIA_EAGER=1)
 *     as usual     with as much memory as the device has
 *     short        as usual, in a quarter more than one by one (LUTETIA_MEMORY)
 *
 * All must come to the same numbers. */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "of_machine.h"
#include "paris_internal.h"
#include "works.h"
#include <cm/paris.h>

enum { TURNS = 2 };

/* Runs the work on a machine of its own, with that many bytes at most (0: what there is). Returns the most that were held; 0: an error. */
static uint64_t peak_of(enum work w, bool eager, uint64_t bytes, uint32_t *result)
{
    struct machine_config config = machine_config_default();
    struct machine_stats stats;
    char limit[32] = "";
    if (bytes)
        snprintf(limit, sizeof limit, "%llu", (unsigned long long)bytes);
    setenv("LUTETIA_MEMORY", limit, 1);
    config.eager = eager;
    const bool begun = paris_reset(&config);
    unsetenv("LUTETIA_MEMORY");
    if (!begun) {
        bench_fail("no machine");
        return 0;
    }
    struct work_paris *p = work_paris_create(w, work_size(w, bench_quick));
    for (uint32_t turn = 1; p && turn <= TURNS; turn++)
        *result = work_paris_run(p, turn);
    const bool good = p && bench_machine_finished();
    machine_stats_get(paris_machine(), &stats);
    work_paris_destroy(p);
    return good ? stats.bytes_peak : 0;
}

static bool row(struct bench_report *r, enum work w)
{
    static const char *const ways[] = {"one by one", "as usual", "short"};
    uint32_t results[3] = {0, 0, 0};
    uint64_t peaks[3] = {0, 0, 0};
    for (int i = 0; i < (bench_quick ? 2 : 3);
         i++) { /* of small sets much is computed at once, and nothing waits */
        peaks[i] = peak_of(w, i == 0, i == 2 ? peaks[0] + peaks[0] / 4 : 0, &results[i]);
        if (!peaks[i])
            return false;
        if (results[i] != results[0])
            return bench_fail("%s: %s came to %u, one by one to %u", work_names[w], ways[i],
                              results[i], results[0]);
        bench_report_add(r, ways[i], work_names[w],
                         (struct bench_sample){(double)peaks[i], (double)peaks[i]}, 1e-6, "MB");
    }
    return true;
}

int bench_memory_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {.name = "memory", .repeat_least = 1, .repeat_count = 1};
    setenv("LUTETIA_INTERPRET", "1", 0); /* as anybody's */
    int status = bench_machine_start(&report, &options, false, argc, argv);
    if (status >= 0)
        return status;
    bool ok = true;
    for (int w = 0; ok && w < WORKS_COUNT; w++)
        ok = row(&report, (enum work)w);
    return bench_options_finish(&options, &report, "one by one", ok);
}
