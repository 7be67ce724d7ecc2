/* calls.c - `lutetia bench calls`: the front end's time for a C/Paris call, which is recorded
 * and not waited for.
 *
 * Recorded: the processor time of the calling thread, which makes the calls and submits their
 * evaluation. To the end: includes the time until the device is done. Growth: of the process's
 * memory, and of the machine's, over a million calls after a warm-up. Looks: reads and writes
 * of one processor and reductions of what is in memory, and steps of the diffusion listing on a
 * sheet so small that no kernel pays.
 */
#include "calls.h"
#include <visible_text.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "bench.h"
#include "harness.h"
#include "input_file.h"
#include "listing.h"
#include "of_machine.h"
#include "paris_internal.h"

enum {
    SIDE = 256,
    CALLS_TIMED = 10000,
    CALLS_GROWTH = 1000000,
    STEPS_GROWTH = 1000000,
    STEPS_SIDE = 64,
    STEPS_BETWEEN = 100, /* two looks */
    REPEAT_MIN = 10,
    LOOKS = 2000,
    SMALL_SIDE = 32,
    SMALL_STEPS = 1000
};

static int calls_timed(void)
{
    return bench_many(CALLS_TIMED, 10 * CALLS_IN_TURN);
}

static int looks_count(void)
{
    return bench_many(LOOKS, 20);
}

static int small_steps(void)
{
    return bench_many(SMALL_STEPS, STEPS_BETWEEN);
}

/* ---- the program ---- */

void calls_init(struct calls *c, int width, int height)
{
    int dimensions[2] = {height, width};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(dimensions, 2)));
    CM_set_context();
    c->count = CM_allocate_heap_field(32);
    c->limit = CM_allocate_heap_field(32);
    c->small = CM_allocate_heap_field(8);
    c->heat = CM_allocate_heap_field(32);
    c->mark = CM_allocate_heap_field(1);
    CM_my_news_coordinate_1L(c->count, 1, 32);
    CM_u_move_constant_1L(c->limit, 1000, 32);
    CM_my_news_coordinate_1L(c->small, 0, 8);
    CM_f_u_float_2_2L(c->heat, c->count, 32, 23, 8);
    CM_clear_bit(c->mark);
}

void calls_turn(const struct calls *c, int turn)
{
    CM_field_id_t east = CM_allocate_stack_field(32), west = CM_allocate_stack_field(32);

    CM_get_from_news_1L(east, c->heat, 1, CM_upward, 32);
    CM_get_from_news_1L(west, c->heat, 1, CM_downward, 32);
    CM_f_add_2_1L(east, west, 23, 8);
    CM_f_multiply_constant_2_1L(east, 0.5, 23, 8);
    CM_f_subtract_2_1L(east, c->heat, 23, 8);
    CM_f_multiply_constant_2_1L(east, 0.1, 23, 8);
    CM_f_add_2_1L(c->heat, east, 23, 8);
    CM_f_gt_constant_1L(c->heat, 100.0 + turn % 7, 23, 8);
    CM_logand_context_with_test();
    CM_set_bit(c->mark);
    CM_u_add_constant_2_1L(c->count, 3, 32);
    CM_u_gt_1L(c->count, c->limit, 32);
    CM_logand_context_with_test();
    CM_u_subtract_2_1L(c->count, c->limit, 32);
    CM_clear_bit(c->mark);
    CM_set_context();

    CM_field_id_t sum = CM_allocate_stack_field(16);
    CM_u_move_2L(sum, c->small, 16, 8);
    CM_u_add_constant_2_1L(sum, (unsigned long)(turn & 15), 16);
    CM_u_move_constant_1L(east, 77, 32);
    CM_u_move_1L(west, east, 32);
    CM_get_from_news_1L(c->small, c->small, 0, CM_downward, 8);
    CM_load_context(c->mark);
    CM_u_move_2L(c->small, sum, 8, 16);
    CM_invert_context();
    CM_u_eq_constant_1L(c->small, 5, 8);
    CM_logand_context_with_test();
    CM_u_add_constant_2_1L(c->small, 1, 8);
    CM_set_context();
    CM_deallocate_stack_through(sum);
    CM_u_eq_1L(c->small, c->small, 8);
    CM_store_test(c->mark);
    CM_logxor_2_1L(c->mark, c->small, 1);
    CM_s_lt_constant_1L(c->count, 500, 32);
    CM_logand_context_with_test();
    CM_invert_bit(c->mark);
    CM_set_context();
    CM_deallocate_stack_through(east);
}

/* ---- measuring ---- */

/* Makes about that many calls, from turn 0 on. recorded_s: processor time of the calling thread
 * until all are made; total_s: time until the device is done with them. */
static void calls_make(const struct calls *c, int calls_count, double *recorded_s,
                       double *total_s)
{
    double thread = bench_thread_s(), start = bench_now_s();
    for (int turn = 0; turn < calls_count / CALLS_IN_TURN; turn++)
        calls_turn(c, turn);
    *recorded_s = bench_thread_s() - thread;
    machine_finish(paris_machine());
    *total_s = bench_now_s() - start;
}

size_t calls_resident_bytes(void)
{
    unsigned long all, resident;
    FILE *f = input_file_open("/proc/self/statm", NULL);
    int got = f ? fscanf(f, "%lu %lu", &all, &resident) : 0;
    if (f)
        fclose(f);
    return got == 2 ? resident * (size_t)sysconf(_SC_PAGESIZE) : 0;
}

static struct bench_sample one(double value)
{
    return (struct bench_sample){value, value};
}

static bool cost_measure(struct bench_report *r, const struct calls *c, int repeat_count)
{
    double *recorded = calloc((size_t)repeat_count, sizeof *recorded);
    double *total = calloc((size_t)repeat_count, sizeof *total), ignored;
    bool ok = (recorded && total) || bench_fail("no memory for %d times", repeat_count);
    for (int i = 0; ok && i < 3; i++)
        calls_make(c, calls_timed(), &ignored, &ignored);
    for (int i = 0; ok && i < repeat_count; i++)
        calls_make(c, calls_timed(), &recorded[i], &total[i]);
    if (ok) {
        bench_report_add(r, "recorded", "65536 processors",
                         bench_sample_of(recorded, repeat_count), 1e6 / calls_timed(),
                         "us/call");
        bench_report_add(r, "to the end", "65536 processors",
                         bench_sample_of(total, repeat_count), 1e6 / calls_timed(), "us/call");
    }
    free(recorded);
    free(total);
    return ok;
}

/* ---- looks ---- */

static void read_one(const struct calls *c, unsigned int i)
{
    CM_u_read_from_processor_1L(i * 97 % (SMALL_SIDE * SMALL_SIDE), c->count, 32);
}

static void write_one(const struct calls *c, unsigned int i)
{
    CM_u_write_to_processor_1L(i * 97 % (SMALL_SIDE * SMALL_SIDE), c->count, i, 32);
}

static void logior(const struct calls *c, unsigned int i)
{
    (void)i;
    CM_global_logior_1L(c->count, 32);
}

/* The time of each of LOOKS calls. */
static bool look_measure(struct bench_report *r, const char *name, const char *of_case,
                         void (*call)(const struct calls *c, unsigned int i),
                         const struct calls *c, int repeat_count)
{
    double *times = calloc((size_t)repeat_count, sizeof *times);
    if (!times)
        return bench_fail("no memory for %d times", repeat_count);
    for (int k = -1; k < repeat_count; k++) {
        double start = bench_now_s();
        for (unsigned int i = 0; i < (unsigned)looks_count(); i++)
            call(c, i);
        if (k >= 0)
            times[k] = bench_now_s() - start;
    }
    bench_report_add(r, name, of_case, bench_sample_of(times, repeat_count),
                     1e6 / looks_count(), "us");
    free(times);
    return true;
}

static bool looks_measure(struct bench_report *r, int side, const char *of_case,
                          int repeat_count)
{
    struct calls c;
    calls_init(&c, side, side);
    machine_finish(paris_machine());
    return look_measure(r, "read one processor", of_case, read_one, &c, repeat_count) &&
           look_measure(r, "write one processor", of_case, write_one, &c, repeat_count) &&
           look_measure(r, "global logior", of_case, logior, &c, repeat_count);
}

static void listing_once(const void *listing)
{
    listing_step(listing);
}

static bool small_steps_measure(struct bench_report *r, int repeat_count)
{
    struct listing listing = {.width = SMALL_SIDE,
                              .height = SMALL_SIDE,
                              .gravity = 1.1,
                              .molecular_weight = {0.9, 0.7, 0.5}};
    double *times = calloc((size_t)repeat_count, sizeof *times);
    bool ok = times || bench_fail("no memory for %d times", repeat_count);
    if (ok)
        listing_allocate(&listing);
    for (int k = -1; k < repeat_count && ok; k++) {
        double start = bench_now_s();
        ok = bench_machine_steps(listing_once, &listing, small_steps(), STEPS_BETWEEN);
        if (k >= 0)
            times[k] = bench_now_s() - start;
    }
    if (ok)
        bench_report_add(r, "diffusion step", "1024 processors",
                         bench_sample_of(times, repeat_count), 1e6 / small_steps(), "us");
    free(times);
    return ok;
}

struct held {
    struct machine_stats machine;
    size_t resident;
};

static struct held held_now(void)
{
    struct held h = {.resident = calls_resident_bytes()};
    machine_stats_get(paris_machine(), &h.machine);
    return h;
}

static void growth_add(struct bench_report *r, const char *of_case, struct held before)
{
    struct held after = held_now();
    bench_report_add(r, "growth, process", of_case,
                     one((double)after.resident - (double)before.resident), 1.0 / 1024, "KiB");
    bench_report_add(
        r, "growth, values", of_case,
        one((double)after.machine.values_live - (double)before.machine.values_live), 1,
        "values");
    bench_report_add(r, "growth, device", of_case,
                     one((double)after.machine.bytes_held - (double)before.machine.bytes_held),
                     1.0 / 1024, "KiB");
}

static void growth_measure(struct bench_report *r, const struct calls *c)
{
    double ignored;
    calls_make(c, bench_many(CALLS_GROWTH, CALLS_TIMED) / 10, &ignored, &ignored);
    struct held before = held_now();
    calls_make(c, bench_many(CALLS_GROWTH, CALLS_TIMED), &ignored, &ignored);
    growth_add(r, "million calls", before);
}

/* Memory growth in the diffusion listing on a small sheet: 108 million calls. */
static bool steps_growth_measure(struct bench_report *r)
{
    struct machine_config config = machine_config_default();
    struct listing listing = {.width = STEPS_SIDE,
                              .height = STEPS_SIDE,
                              .gravity = 1.1,
                              .molecular_weight = {0.9, 0.7, 0.5}};
    visible_say("calls: a million steps ...");
    if (!paris_reset(&config))
        return bench_fail("%s", paris_error());
    listing_allocate(&listing);
    if (!bench_machine_steps(listing_once, &listing, STEPS_GROWTH / 20, STEPS_BETWEEN))
        return false;
    struct held before = held_now();
    if (!bench_machine_steps(listing_once, &listing, STEPS_GROWTH, STEPS_BETWEEN))
        return false;
    growth_add(r, "million steps", before);
    return true;
}

int bench_calls_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {
        .name = "calls",
        .thorough_does = "memory over a million steps of the diffusion listing, too",
        .repeat_least = REPEAT_MIN,
        .repeat_count = 21};
    struct calls c;
    int status = bench_machine_start(&report, &options, false, argc, argv);
    if (status >= 0)
        return status;
    calls_init(&c, SIDE, SIDE);
    bool ok = cost_measure(&report, &c, options.repeat_count);
    if (ok)
        growth_measure(&report, &c);
    ok = ok && looks_measure(&report, SMALL_SIDE, "1024 processors", options.repeat_count) &&
         looks_measure(&report, SIDE, "65536 processors", options.repeat_count) &&
         small_steps_measure(&report, options.repeat_count);
    ok = ok && (!options.thorough || steps_growth_measure(&report));
    return bench_options_finish(&options, &report, "recorded", ok);
}
