/* works.c - `lutetia bench families`: programs of works.h on Paris, beside plain C.
 *
 *     cold                   the first run, in a process of its own whose caches of kernels are
 *                            empty
 *     warm                   each further run
 *     plain C                one thread
 *     plain C, two threads   with OpenMP
 *     kernels compiled       by the cold process
 *
 * All must come to the same numbers. */
#include "works.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "cold.h"
#include "harness.h"
#include "of_machine.h"
#include "paris_internal.h"
#include <cm/paris.h>

struct on_paris {
    struct work_paris *of;
    uint32_t turn, result;
};

struct in_c {
    struct work_plain *of;
    uint32_t turn, result;
};

static bool paris_work(void *context)
{
    struct on_paris *p = context;
    p->result = work_paris_run(p->of, ++p->turn);
    return bench_machine_finished();
}

static bool plain_work(void *context)
{
    struct in_c *p = context;
    p->result = work_plain_run(p->of, ++p->turn);
    return true;
}

static bool same(enum work w, const struct on_paris *paris, const struct in_c *plain)
{
    if (paris->result == plain[0].result && paris->result == plain[1].result)
        return true;
    return bench_fail("%s, turn %u: Paris came to %u, plain C to %u and %u", work_names[w],
                      paris->turn, paris->result, plain[0].result, plain[1].result);
}

bool works_same(enum work w, int n, int turns)
{
    struct in_c plain[2] = {{.of = work_plain_create(w, n, 1)},
                            {.of = work_plain_create(w, n, 2)}};
    struct on_paris paris = {.of = work_paris_create(w, n)};
    bool ok = paris.of != NULL;
    if (!plain[0].of || !plain[1].of)
        ok = bench_fail("no memory for %d words", n);
    for (int i = 0; ok && i < turns; i++)
        ok = paris_work(&paris) && plain_work(&plain[0]) && plain_work(&plain[1]) &&
             same(w, &paris, plain);
    work_paris_destroy(paris.of);
    work_plain_destroy(plain[0].of);
    work_plain_destroy(plain[1].of);
    return ok;
}

/* A cold process: `which` is the work's number, and SMALL where it is only tried. */
#define SMALL "s"
static int cold_run(const char *which, const char *path)
{
    char *end;
    long w = strtol(which, &end, 10);
    if (w < 0 || w >= WORKS_COUNT)
        return EXIT_FAILURE;
    CM_init();
    struct on_paris p = {
        .of = work_paris_create((enum work)w, work_size((enum work)w, !strcmp(end, SMALL)))};
    struct machine_stats stats;
    double start = bench_now_s();
    if (!p.of || !paris_work(&p))
        return EXIT_FAILURE;
    struct cold c = {bench_now_s() - start, 0, p.result};
    machine_stats_get(paris_machine(), &stats);
    c.kernels = (double)stats.kernels_built;
    return cold_tell(path, &c) ? EXIT_SUCCESS : EXIT_FAILURE;
}

static bool work_measure(struct bench_report *r, enum work w, int repeat_count)
{
    int n = work_size(w, bench_quick);
    char which[8];
    struct cold cold = {0};
    struct in_c plain[2] = {{.of = work_plain_create(w, n, 1)},
                            {.of = work_plain_create(w, n, 2)}};
    struct on_paris paris = {0};
    struct bench_contender contenders[] = {
        {.what = "warm", .work = paris_work, .context = &paris},
        {.what = "plain C", .work = plain_work, .context = &plain[0]},
        {.what = "plain C, two threads", .work = plain_work, .context = &plain[1]},
    };
    snprintf(which, sizeof which, "%d%s", w, bench_quick ? SMALL : "");
    bool ok = (plain[0].of && plain[1].of) || bench_fail("no memory for %d words", n);
    ok = ok && cold_measure("families", which, &cold) &&
         (cold.result == work_plain_run(plain[0].of, 1) ||
          bench_fail("%s: the cold run and plain C came to different numbers", work_names[w]));
    paris.of = ok ? work_paris_create(w, n) : NULL;
    ok = ok && paris.of && bench_measure_in_turns(contenders, 3, repeat_count) &&
         same(w, &paris, plain);
    if (ok) {
        struct bench_sample first = {cold.seconds, cold.seconds};
        struct bench_sample kernels = {cold.kernels, cold.kernels};
        bench_report_add(r, "cold", work_names[w], first, 1e3, "ms");
        for (int i = 0; i < 3; i++)
            bench_report_add(r, contenders[i].what, work_names[w], contenders[i].seconds, 1e3,
                             "ms");
        bench_report_add(r, "kernels compiled, cold", work_names[w], kernels, 1, "kernels");
    }
    work_paris_destroy(paris.of);
    work_plain_destroy(plain[0].of);
    work_plain_destroy(plain[1].of);
    return ok;
}

int bench_families_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {.name = "families", .repeat_least = 3, .repeat_count = 7};
    if (argc == 4 && !strcmp(argv[1], COLD_FLAG))
        return cold_run(argv[2], argv[3]);
    setenv("LUTETIA_INTERPRET", "1", 0); /* as anybody's */
    int status = bench_machine_start(&report, &options, false, argc, argv);
    if (status >= 0)
        return status;
    bool ok = true;
    for (int w = 0; ok && w < bench_many(WORKS_COUNT, 2); w++)
        ok = work_measure(&report, (enum work)w, options.repeat_count);
    return bench_options_finish(&options, &report, "plain C", ok);
}
