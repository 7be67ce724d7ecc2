/* memory.c - `lutetia bench memory`: the most bytes that arrays take at once, for the programs
 * of works.h and of memory_programs.h.
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
#include "memory_programs.h"
#include "of_machine.h"
#include "paris_internal.h"
#include "works.h"
#include <cm/paris.h>

enum { TURNS = 2 };

/* Programs of grids, and their sides: in a try of seconds, usually, and with --thorough. */
static const struct grid {
    const char *name;
    bool (*run)(int side, uint32_t *result);
    int quick, usual, thorough;
} grids[] = {
    {"listing", memory_listing_run, 64, 1024, 1024},
    {"paper", memory_paper_run, 48, 1024, 1024},
    {"a line's mean", memory_mean_run, 64, 4096, 16384},
};

static bool work_run(enum work w, uint32_t *result)
{
    struct work_paris *p = work_paris_create(w, work_size(w, bench_quick));
    for (uint32_t turn = 1; p && turn <= TURNS; turn++)
        *result = work_paris_run(p, turn);
    const bool good = p && bench_machine_finished();
    work_paris_destroy(p);
    return good;
}

/* A work, or where `grid` is not NULL that, on a machine of its own, with that many bytes at
 * most (0: what there is). Returns the most that were held; 0: an error. */
static uint64_t peak_of(enum work w, const struct grid *grid, int side, bool eager,
                        uint64_t bytes, uint32_t *result)
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
    if (!(grid ? grid->run(side, result) : work_run(w, result)))
        return 0;
    machine_stats_get(paris_machine(), &stats);
    return stats.bytes_peak;
}

static bool row(struct bench_report *r, const char *name, enum work w, const struct grid *grid,
                int side)
{
    static const char *const ways[] = {"one by one", "as usual", "short"};
    uint32_t results[3] = {0, 0, 0};
    uint64_t peaks[3] = {0, 0, 0};
    for (int i = 0; i < (bench_quick ? 2 : 3);
         i++) { /* of small sets much is computed at once, and nothing waits */
        peaks[i] =
            peak_of(w, grid, side, i == 0, i == 2 ? peaks[0] + peaks[0] / 4 : 0, &results[i]);
        if (!peaks[i])
            return false;
        if (results[i] != results[0])
            return bench_fail("%s: %s came to %u, one by one to %u", name, ways[i], results[i],
                              results[0]);
        bench_report_add(r, ways[i], name,
                         (struct bench_sample){(double)peaks[i], (double)peaks[i]}, 1e-6, "MB");
    }
    return true;
}

int bench_memory_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {.name = "memory",
                                    .repeat_least = 1,
                                    .repeat_count = 1,
                                    .thorough_does =
                                        "a grid of 16384x16384, too: it takes 7 GB of memory"};
    setenv("LUTETIA_INTERPRET", "1", 0); /* as anybody's */
    int status = bench_machine_start(&report, &options, false, argc, argv);
    if (status >= 0)
        return status;
    bool ok = true;
    for (int w = 0; ok && w < WORKS_COUNT; w++)
        ok = row(&report, work_names[w], (enum work)w, NULL, 0);
    for (size_t i = 0; ok && i < sizeof grids / sizeof *grids; i++)
        ok = row(&report, grids[i].name, WORKS_COUNT, &grids[i],
                 options.thorough ? grids[i].thorough
                                  : bench_many(grids[i].usual, grids[i].quick));
    return bench_options_finish(&options, &report, "one by one", ok);
}
