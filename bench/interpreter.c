/* interpreter.c - `lutetia bench interpreter`: programs that do not repeat, as an interpreter
 * of a vector language runs them on Paris, beside plain C.
 *
 *     cold                     the first run of a program, in a process of its own whose caches
 *                              of kernels are empty
 *     plain C, cold            likewise: its vectors, too, are memory that nobody has written
 *                              before
 *     warm                     each further run of that program
 *     plain C                  a loop for each operation, one thread
 *     plain C, two threads     likewise, with OpenMP
 *     warm, after a pause      one run after some milliseconds without work
 *     plain C, after a pause
 *     kernels compiled         by the cold process, for each size
 *
 * Times are for each element of each operation. Short runs are timed many together: one that
 * follows a pause takes longer, in plain C, too, since a processor that has halted begins with
 * empty caches. All must come to the same numbers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "cold.h"
#include "harness.h"
#include "interpreter.h"
#include "of_machine.h"
#include "paris_internal.h"
#include <cm/paris.h>

enum { WORD = 32, SIZES_COUNT = 4, SEED = 20 };
static const int sizes[SIZES_COUNT] = {10, 1000, 100000, 4000000};
/* How many runs are timed together. */
enum { COLD_TIMES = 5 };
static int runs_of(int n)
{
    return n < 10000 ? 64 : n < 1000000 ? 8 : 1;
}
#define PLAIN "plain " /* a cold process of plain C: before its size */

/* ---- on Paris ---- */

struct stack_paris {
    const struct stack_program *program;
    CM_vp_set_id_t set;
    CM_geometry_id_t geometry;
    CM_field_id_t vectors[STACK_VECTORS], index, permutation, segments, rank, address;
    unsigned int address_bits;
    uint32_t turn, result;
};

static bool paris_begin(struct stack_paris *s, const struct stack_program *p)
{
    unsigned int dimensions[1] = {(unsigned int)p->n};
    *s = (struct stack_paris){.program = p};
    s->geometry = CM_create_geometry(dimensions, 1);
    s->set = CM_allocate_vp_set(s->geometry);
    CM_set_vp_set(s->set);
    CM_set_context();
    s->address_bits = CM_geometry_send_address_length(s->geometry);
    for (int i = 0; i < STACK_VECTORS; i++)
        s->vectors[i] = CM_allocate_heap_field(WORD);
    s->index = CM_allocate_heap_field(WORD);
    s->rank = CM_allocate_heap_field(WORD);
    s->segments = CM_allocate_heap_field(1);
    s->permutation = CM_allocate_heap_field(s->address_bits);
    s->address = CM_allocate_heap_field(s->address_bits);
    uint32_t *permutation = malloc((size_t)p->n * sizeof *permutation);
    if (!permutation)
        return bench_fail("no memory for %d words", p->n);
    stack_permutation(permutation, p->n);
    bool good = bench_machine_said(
        machine_field_upload(paris_machine(), s->rank, MACHINE_UINT(WORD), permutation));
    free(permutation);
    CM_make_news_coordinate_1L(s->geometry, s->permutation, 0, s->rank, WORD);
    CM_my_news_coordinate_1L(s->index, 0, WORD);
    CM_u_mod_constant_3_1L(s->rank, s->index, STACK_SEGMENT, WORD);
    CM_u_eq_constant_1L(s->rank, 0, WORD);
    CM_store_test(s->segments);
    return good && bench_machine_finished();
}

static void paris_pack(const struct stack_paris *s, CM_field_id_t to, CM_field_id_t a)
{
    CM_u_move_zero_1L(to, WORD);
    CM_load_context(a); /* its lowest bit */
    CM_enumerate_1L(s->rank, 0, WORD, CM_upward, CM_exclusive, CM_none, CM_no_field);
    CM_make_news_coordinate_1L(s->geometry, s->address, 0, s->rank, WORD);
    CM_send_1L(to, s->address, a, WORD, CM_no_field);
    CM_set_context();
}

static uint32_t paris_step(const struct stack_paris *s, const struct stack_step *t)
{
    CM_field_id_t to = s->vectors[t->to], a = s->vectors[t->a], b = s->vectors[t->b];
    switch (t->op) {
    case STACK_START:
        CM_u_multiply_constant_3_1L(to, s->index, t->number, WORD);
        CM_u_add_constant_2_1L(to, s->turn, WORD);
        return 0;
    case STACK_ADD:
        CM_u_add_3_1L(to, a, b, WORD);
        return 0;
    case STACK_SUBTRACT:
        CM_u_subtract_3_1L(to, a, b, WORD);
        return 0;
    case STACK_MULTIPLY:
        CM_u_multiply_3_1L(to, a, b, WORD);
        return 0;
    case STACK_MIN:
        CM_u_min_3_1L(to, a, b, WORD);
        return 0;
    case STACK_MAX:
        CM_u_max_3_1L(to, a, b, WORD);
        return 0;
    case STACK_XOR:
        CM_logxor_3_1L(to, a, b, WORD);
        return 0;
    case STACK_ADD_NUMBER:
        CM_u_add_constant_3_1L(to, a, t->number, WORD);
        return 0;
    case STACK_WHERE_LESS:
        CM_u_lt_1L(a, b, WORD);
        CM_logand_context_with_test();
        CM_u_move_1L(to, a, WORD);
        CM_set_context();
        return 0;
    case STACK_SCAN:
        CM_scan_with_u_add_1L(to, a, 0, WORD, CM_upward, CM_inclusive, CM_none, CM_no_field);
        return 0;
    case STACK_SCAN_SEGMENTED:
        CM_scan_with_u_add_1L(to, a, 0, WORD, CM_upward, CM_inclusive, CM_segment_bit,
                              s->segments);
        return 0;
    case STACK_PERMUTE:
        CM_send_1L(to, s->permutation, a, WORD, CM_no_field);
        return 0;
    case STACK_PACK:
        paris_pack(s, to, a);
        return 0;
    case STACK_SUM:
        return CM_global_u_add_1L(a, WORD);
    case STACK_READ:
        return CM_u_read_from_processor_1L(
            CM_fe_make_news_coordinate(s->geometry, 0, t->number), a, WORD);
    case STACK_WRITE:
    case STACK_OPS_COUNT:
        CM_u_write_to_processor_1L(CM_fe_make_news_coordinate(s->geometry, 0, t->number), to,
                                   t->number, WORD);
    }
    return 0;
}

static bool paris_work(void *context)
{
    struct stack_paris *s = context;
    s->turn++;
    s->result = 0;
    for (int i = 0; i < STACK_OPERATIONS; i++)
        s->result = s->result * 31 + paris_step(s, &s->program->steps[i]);
    for (int i = 0; i < STACK_VECTORS; i++)
        s->result =
            s->result * 31 + paris_step(s, &(struct stack_step){.op = STACK_SUM, .a = i});
    return bench_machine_finished();
}

static bool paris_works(void *context)
{
    const struct stack_paris *s = context;
    bool ok = true;
    for (int i = runs_of(s->program->n); ok && i; i--)
        ok = paris_work(context);
    return ok;
}

/* ---- plain C ---- */

struct plain {
    struct stack_plain *of;
    int runs;
    uint32_t turn, result;
};

static bool plain_work(void *context)
{
    struct plain *p = context;
    p->result = stack_plain_run(p->of, ++p->turn);
    return true;
}

static bool plain_works(void *context)
{
    const struct plain *p = context;
    for (int i = p->runs; i; i--)
        plain_work(context);
    return true;
}

bool interpreter_same(uint64_t seed, int n, int turns)
{
    static struct stack_program program;
    struct stack_paris paris;
    stack_program_make(&program, seed, n);
    struct plain plain[2] = {{.of = stack_plain_create(&program, 1)},
                             {.of = stack_plain_create(&program, 2)}};
    bool ok = (plain[0].of && plain[1].of) || bench_fail("no memory for %d words", n);
    ok = ok && paris_begin(&paris, &program);
    for (int i = 0; ok && i < turns; i++) {
        ok = paris_work(&paris) && plain_work(&plain[0]) && plain_work(&plain[1]);
        if (ok && (paris.result != plain[0].result || paris.result != plain[1].result))
            ok = bench_fail("turn %d on %d processors: Paris came to %u, plain C to %u and %u",
                            i, n, paris.result, plain[0].result, plain[1].result);
    }
    if (ok)
        CM_deallocate_vp_set(paris.set);
    stack_plain_destroy(plain[0].of);
    stack_plain_destroy(plain[1].of);
    return ok;
}

/* ---- cold ---- */

/* A cold process: its first run of the program; the time of it, the kernels that were compiled,
 * what it came to. */
static bool cold_tell_plain(const struct stack_program *program, const char *path)
{
    struct stack_plain *of = stack_plain_create(program, 1);
    double start = bench_now_s();
    uint32_t result = of ? stack_plain_run(of, 1) : 0;
    double passed = bench_now_s() - start;
    bool told = of && cold_tell(path, &(struct cold){passed, 0, result});
    stack_plain_destroy(of);
    return told;
}

static int cold_run(const char *size, const char *path)
{
    static struct stack_program program;
    struct stack_paris s;
    struct machine_stats stats;
    const bool is_plain = !strncmp(size, PLAIN, strlen(PLAIN));
    int n = atoi(is_plain ? size + strlen(PLAIN) : size);
    if (n < 1 || n > sizes[SIZES_COUNT - 1])
        return EXIT_FAILURE;
    stack_program_make(&program, SEED, n);
    if (is_plain)
        return cold_tell_plain(&program, path) ? EXIT_SUCCESS : EXIT_FAILURE;
    CM_init();
    if (!paris_begin(&s, &program))
        return EXIT_FAILURE;
    double start = bench_now_s();
    if (!paris_work(&s))
        return EXIT_FAILURE;
    double passed = bench_now_s() - start;
    machine_stats_get(paris_machine(), &stats);
    return cold_tell(path, &(struct cold){passed, (double)stats.kernels_built, s.result})
               ? EXIT_SUCCESS
               : EXIT_FAILURE;
}

/* ---- all ---- */

static bool results_same(const struct plain *plain, const struct stack_paris *paris,
                         const struct cold *cold, struct stack_plain *of)
{
    if (plain[0].result != plain[1].result || plain[0].result != paris->result ||
        plain[0].turn != paris->turn)
        return bench_fail("Paris and plain C came to different numbers");
    return cold->result == stack_plain_run(of, 1) ||
           bench_fail("the cold run and plain C came to different numbers");
}

/* Processes of both, in turn; last: the last one of ours. */
static bool colds_measure(struct bench_report *r, int n, int times, struct cold *last)
{
    double seconds[2][COLD_TIMES], scale = 1e9 / ((double)n * STACK_OPERATIONS);
    char of_case[16], of_plain[32];
    struct cold plain = {0};
    snprintf(of_case, sizeof of_case, "%d", n);
    snprintf(of_plain, sizeof of_plain, PLAIN "%d", n);
    for (int i = 0; i < times; i++) {
        if (!cold_measure("interpreter", of_case, last) ||
            !cold_measure("interpreter", of_plain, &plain))
            return false;
        if (plain.result != last->result)
            return bench_fail("cold runs of Paris and plain C came to different numbers");
        seconds[0][i] = last->seconds;
        seconds[1][i] = plain.seconds;
    }
    for (int i = 0; i < 2; i++)
        bench_report_add(r, i ? "plain C, cold" : "cold", of_case,
                         bench_sample_of(seconds[i], times), scale, "ns/element");
    return true;
}

static void rows_add(struct bench_report *r, const struct bench_contender *c, int count, int n,
                     int runs)
{
    char of_case[16];
    snprintf(of_case, sizeof of_case, "%d", n);
    for (int i = 0; i < count; i++)
        bench_report_add(r, c[i].what, of_case, c[i].seconds,
                         1e9 / ((double)n * STACK_OPERATIONS * runs), "ns/element");
}

static bool size_measure(struct bench_report *r, int n, int repeat_count)
{
    static struct stack_program program;
    struct stack_paris paris;
    struct cold cold = {0};
    char of_case[16];
    stack_program_make(&program, SEED, n);
    struct plain plain[2] = {{.of = stack_plain_create(&program, 1), .runs = runs_of(n)},
                             {.of = stack_plain_create(&program, 2), .runs = runs_of(n)}};
    bool ok = (plain[0].of && plain[1].of) || bench_fail("no memory for %d words", n);
    struct bench_contender together[] = {
        {.what = "warm", .work = paris_works, .context = &paris},
        {.what = "plain C", .work = plain_works, .context = &plain[0]},
        {.what = "plain C, two threads", .work = plain_works, .context = &plain[1]},
    };
    struct bench_contender alone[] = {
        {.what = "warm, after a pause", .work = paris_work, .context = &paris},
        {.what = "plain C, after a pause", .work = plain_work, .context = &plain[0]},
    };
    snprintf(of_case, sizeof of_case, "%d", n);
    ok = ok && colds_measure(r, n, repeat_count > COLD_TIMES ? COLD_TIMES : 1, &cold) &&
         paris_begin(&paris, &program) && bench_measure_in_turns(together, 3, repeat_count) &&
         results_same(plain, &paris, &cold, plain[0].of);
    if (ok) {
        struct bench_sample kernels = {cold.kernels, cold.kernels};
        rows_add(r, together, 3, n, runs_of(n));
        ok = runs_of(n) == 1 || bench_measure_in_turns(alone, 2, repeat_count);
        if (ok && runs_of(n) > 1)
            rows_add(r, alone, 2, n, 1);
        bench_report_add(r, "kernels compiled, cold", of_case, kernels, 1, "kernels");
        CM_deallocate_vp_set(paris.set);
        ok = bench_machine_finished() && ok;
    }
    stack_plain_destroy(plain[0].of);
    stack_plain_destroy(plain[1].of);
    return ok;
}

int bench_interpreter_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {
        .name = "interpreter", .repeat_least = 3, .repeat_count = 11};
    if (argc == 4 && !strcmp(argv[1], COLD_FLAG))
        return cold_run(argv[2], argv[3]);
    setenv("LUTETIA_INTERPRET", "1", 0); /* as anybody's */
    int status = bench_machine_start(&report, &options, false, argc, argv);
    if (status >= 0)
        return status;
    bool ok = true;
    for (int i = 0; ok && i < bench_many(SIZES_COUNT, 2); i++)
        ok = size_measure(&report, sizes[i], options.repeat_count);
    return bench_options_finish(&options, &report, "plain C", ok);
}
