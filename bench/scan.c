/* scan.c - `lutetia bench scan` and `lutetia bench rank`: scans and ranks of one line of
 * processors, beside plain C on one thread in the same run: after a pause of some milliseconds,
 * when caches hold other things and threads sleep, and sixteen in a row. Results are compared
 * first, except floats, which are added in another order. */
#include "bench.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "of_machine.h"
#include "paris_internal.h"
#include "prefix.h"
#include <cm/paris.h>

enum { COUNT_MAX = 1 << 26, REPEAT_MIN = 10, SEGMENT = 100 };

struct line {
    size_t count;
    uint32_t *in, *out, *mine, *scratch;
    float *floats, *floats_out;
    uint8_t *begins;
    CM_field_id_t source, dest, float_source, float_dest, bits;
};

/* ---- the contenders ---- */

static bool scan_work(void *context)
{
    struct line *l = context;
    CM_scan_with_u_add_1L(l->dest, l->source, 0, 32, CM_upward, CM_inclusive, CM_none,
                          CM_no_field);
    return bench_machine_finished();
}

static bool segments_work(void *context)
{
    struct line *l = context;
    CM_scan_with_u_add_1L(l->dest, l->source, 0, 32, CM_upward, CM_inclusive, CM_segment_bit,
                          l->bits);
    return bench_machine_finished();
}

static bool floats_work(void *context)
{
    struct line *l = context;
    CM_scan_with_f_add_1L(l->float_dest, l->float_source, 0, 23, 8, CM_upward, CM_inclusive,
                          CM_none, CM_no_field);
    return bench_machine_finished();
}

static bool rank_work(void *context)
{
    struct line *l = context;
    CM_u_rank_2L(l->dest, l->source, 0, 32, 32, CM_upward, CM_none, CM_no_field);
    return bench_machine_finished();
}

static bool plain_scan(void *context)
{
    struct line *l = context;
    prefix_sum(l->in, l->out, l->count);
    return true;
}

static bool plain_segments(void *context)
{
    struct line *l = context;
    prefix_sum_segments(l->in, l->begins, l->out, l->count);
    return true;
}

static bool plain_floats(void *context)
{
    struct line *l = context;
    prefix_sum_floats(l->floats, l->floats_out, l->count);
    return true;
}

static bool plain_rank(void *context)
{
    struct line *l = context;
    radix_ranks(l->in, l->out, l->scratch, l->count);
    return true;
}

struct match {
    const char *what, *name;
    bench_work *ours, *plain;
    bool same; /* the results must be equal */
};
static const struct match scans[] = {
    {"scan u_add", "sum", scan_work, plain_scan, true},
    {"scan u_add", "segments", segments_work, plain_segments, true},
    {"scan f_add", "floats", floats_work, plain_floats, false},
};
static const struct match ranks[] = {{"u_rank", "rank", rank_work, plain_rank, true}};

/* ---- one size ---- */

static bool line_start(struct line *l, int count)
{
    struct machine_config config = machine_config_default();
    config.eager = 0;
    *l = (struct line){.count = (size_t)count};
    l->in = malloc(l->count * 4);
    l->out = malloc(l->count * 4);
    l->mine = malloc(l->count * 4);
    l->scratch = malloc(l->count * 16);
    l->floats = malloc(l->count * 4);
    l->floats_out = malloc(l->count * 4);
    l->begins = malloc(l->count);
    if (!l->in || !l->out || !l->mine || !l->scratch || !l->floats || !l->floats_out ||
        !l->begins)
        return bench_fail("no memory for lines of %d", count);
    if (!paris_reset(&config))
        return bench_fail("%s", paris_error());
    uint64_t x = 88172645463325252u;
    for (size_t i = 0; i < l->count; i++) {
        x ^= x << 13;
        x ^= x >> 7;
        x ^= x << 17;
        l->in[i] = (uint32_t)(x >> 20);
        l->floats[i] = (float)(x >> 40) * 0x1p-24f;
        l->begins[i] = (x >> 8) % SEGMENT == 0;
    }
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry((CM_vector_t){.ints = &count}, 1)));
    l->source = CM_allocate_heap_field(32);
    l->dest = CM_allocate_heap_field(32);
    l->float_source = CM_allocate_heap_field(32);
    l->float_dest = CM_allocate_heap_field(32);
    l->bits = CM_allocate_heap_field(1);
    struct machine *m = paris_machine();
    return (machine_field_upload(m, l->source, MACHINE_UINT(32), l->in) == MACHINE_OK &&
            machine_field_upload(m, l->float_source, MACHINE_F32, l->floats) == MACHINE_OK &&
            machine_field_upload(m, l->bits, MACHINE_BIT, l->begins) == MACHINE_OK) ||
           bench_fail("the machine: %s", machine_error(m));
}

static void line_finish(struct line *l)
{
    free(l->in);
    free(l->out);
    free(l->mine);
    free(l->scratch);
    free(l->floats);
    free(l->floats_out);
    free(l->begins);
}

/* Many together: what one takes that follows the last at once. */
enum { IN_A_ROW = 16 };

struct row {
    struct line *line;
    bench_work *work;
};

static bool row_work(void *context)
{
    const struct row *row = context;
    bool ok = true;
    for (int i = 0; ok && i < IN_A_ROW; i++)
        ok = row->work(row->line);
    return ok;
}

static bool match_measure(struct bench_report *r, const struct bench_options *o, struct line *l,
                          const struct match *match)
{
    char of_case[32];
    snprintf(of_case, sizeof of_case, "%s %zu", match->name, l->count);
    if (!match->ours(l) || !match->plain(l))
        return false;
    if (match->same && (machine_field_download(paris_machine(), l->dest, MACHINE_UINT(32),
                                               l->mine) != MACHINE_OK ||
                        memcmp(l->mine, l->out, l->count * 4) != 0))
        return bench_fail("%s of %zu differs from plain C", match->what, l->count);
    char of_row[32];
    snprintf(of_row, sizeof of_row, "%s %zu in a row", match->name, l->count);
    struct row rows[] = {{l, match->ours}, {l, match->plain}};
    struct bench_contender contenders[] = {
        {.what = match->what, .work = match->ours, .context = l},
        {.what = "plain C", .work = match->plain, .context = l},
        {.what = match->what, .work = row_work, .context = &rows[0]},
        {.what = "plain C", .work = row_work, .context = &rows[1]},
    };
    if (!bench_measure_in_turns(contenders, 4, o->repeat_count))
        return false;
    for (int i = 0; i < 4; i++)
        bench_report_add(r, contenders[i].what, i < 2 ? of_case : of_row, contenders[i].seconds,
                         i < 2 ? 1e3 : 1e3 / IN_A_ROW, "ms");
    return true;
}

static int run(const char *name, const struct match *matches, int matches_count, int argc,
               char **argv)
{
    static struct bench_report report;
    struct bench_options options = {.name = name,
                                    .sizes = {{1 << 16, 1}, {1 << 20, 1}},
                                    .sizes_count = 2,
                                    .lines = true,
                                    .size_least = 1,
                                    .size_most = COUNT_MAX,
                                    .repeat_least = REPEAT_MIN,
                                    .repeat_count = 31};
    int status = bench_machine_start(&report, &options, false, argc, argv);
    if (status >= 0)
        return status;
    bool ok = true;
    for (int i = 0; ok && i < options.sizes_count; i++) {
        struct line line;
        ok = line_start(&line, options.sizes[i][0]);
        for (int k = 0; ok && k < matches_count; k++)
            ok = match_measure(&report, &options, &line, &matches[k]);
        line_finish(&line);
    }
    return bench_options_finish(&options, &report, "plain C", ok);
}

int bench_scan_main(int argc, char **argv)
{
    return run("scan", scans, sizeof scans / sizeof *scans, argc, argv);
}

int bench_rank_main(int argc, char **argv)
{
    return run("rank", ranks, sizeof ranks / sizeof *ranks, argc, argv);
}
