/* families.c - `lutetia bench paris`: one instruction of each family, on four million
 * processors: its compulsory traffic (sources read, destination and flags written) in GB/s,
 * beside the copy bandwidth of the same run.
 *
 * Before each counted run the sources are changed, so that no result can be reused.
 */
#include "bench.h"

#include <stdlib.h>
#include <string.h>

#include "copy.h"
#include "harness.h"
#include "of_machine.h"
#include "paris_internal.h"
#include <cm/paris.h>

enum { SIDE = 2048, COPY_BYTES = 256 << 20, S = 23, E = 8, WORD = 32, HALF = 16 };

static int side_of(void)
{
    return bench_many(SIDE, 64);
}

static const char OF_CASE[] = "4M processors";

struct fields {
    CM_field_id_t u, u_other, u_dest, half_dest; /* 32 bits, 16 */
    CM_field_id_t f, f_other, f_dest;            /* single floats */
    CM_field_id_t context, test;                 /* a bit */
    int turn;
};

/* The operand bytes of a processor: 4 for a word or a float, 1/8 for a bit. */
#define BIT 0.125
#define FAMILIES                                                                               \
    ROW(moved_under, u_dest, WORD, "move under a context", 12 + BIT,                           \
        (CM_load_context(x->context), CM_u_move_1L(x->u_dest, x->u, WORD), CM_set_context()))  \
    ROW(moved_short, half_dest, HALF, "move, 32 to 16 bits", 6,                                \
        CM_u_move_2L(x->half_dest, x->u, HALF, WORD))                                          \
    ROW(logand, u_dest, WORD, "logand", 12, CM_logand_3_1L(x->u_dest, x->u, x->u_other, WORD)) \
    ROW(logxor, u_dest, WORD, "logxor", 12, CM_logxor_3_1L(x->u_dest, x->u, x->u_other, WORD)) \
    ROW(u_add, u_dest, WORD, "u_add", 12 + BIT,                                                \
        CM_u_add_3_1L(x->u_dest, x->u, x->u_other, WORD))                                      \
    ROW(u_multiply, u_dest, WORD, "u_multiply", 12 + BIT,                                      \
        CM_u_multiply_3_1L(x->u_dest, x->u, x->u_other, WORD))                                 \
    ROW(u_truncate, u_dest, WORD, "u_truncate (divide)", 12 + BIT,                             \
        CM_u_truncate_3_1L(x->u_dest, x->u, x->u_other, WORD))                                 \
    ROW(f_add, f_dest, WORD, "f_add", 12, CM_f_add_3_1L(x->f_dest, x->f, x->f_other, S, E))    \
    ROW(f_multiply, f_dest, WORD, "f_multiply", 12,                                            \
        CM_f_multiply_3_1L(x->f_dest, x->f, x->f_other, S, E))                                 \
    ROW(f_divide, f_dest, WORD, "f_divide", 12,                                                \
        CM_f_divide_3_1L(x->f_dest, x->f, x->f_other, S, E))                                   \
    ROW(f_sqrt, f_dest, WORD, "f_sqrt", 8, CM_f_sqrt_2_1L(x->f_dest, x->f, S, E))              \
    ROW(f_sin, f_dest, WORD, "f_sin", 8, CM_f_sin_2_1L(x->f_dest, x->f, S, E))                 \
    ROW(f_exp, f_dest, WORD, "f_exp", 8, CM_f_exp_2_1L(x->f_dest, x->f, S, E))                 \
    ROW(f_ln, f_dest, WORD, "f_ln", 8, CM_f_ln_2_1L(x->f_dest, x->f, S, E))                    \
    ROW(f_power, f_dest, WORD, "f_power", 12,                                                  \
        CM_f_power_3_1L(x->f_dest, x->f, x->f_other, S, E))                                    \
    ROW(f_u_float, f_dest, WORD, "f_u_float", 8,                                               \
        CM_f_u_float_2_2L(x->f_dest, x->u, WORD, S, E))                                        \
    ROW(s_f_truncate, u_dest, WORD, "s_f_truncate", 8 + BIT,                                   \
        CM_s_f_truncate_2_2L(x->u_dest, x->f, WORD, S, E))                                     \
    ROW(news_rows, u_dest, WORD, "get_from_news, rows", 8,                                     \
        CM_get_from_news_1L(x->u_dest, x->u, 0, CM_upward, WORD))                              \
    ROW(news_columns, u_dest, WORD, "get_from_news, columns", 8,                               \
        CM_get_from_news_1L(x->u_dest, x->u, 1, CM_upward, WORD))                              \
    ROW(u_eq, test, 1, "u_eq", 8 + BIT,                                                        \
        (CM_u_eq_1L(x->u, x->u_other, WORD), CM_store_test(x->test)))                          \
    ROW(f_lt, test, 1, "f_lt", 8 + BIT,                                                        \
        (CM_f_lt_1L(x->f, x->f_other, S, E), CM_store_test(x->test)))

/* Reads the first processor's result, which makes the machine compute all processors (with
 * LUTETIA_NEAR=0, else that one). */
static bool observed(CM_field_id_t dest, unsigned int length)
{
    CM_u_read_from_processor_1L(0, dest, length);
    return bench_machine_finished();
}

#define ROW(name, dest, length, what, bytes, call)                                             \
    static bool name##_work(void *context)                                                     \
    {                                                                                          \
        const struct fields *x = context;                                                      \
        call;                                                                                  \
        return observed(x->dest, length);                                                      \
    }
FAMILIES
#undef ROW

static const struct {
    const char *what;
    double bytes;
    bench_work *work;
} families[] = {
#define ROW(name, dest, length, what, bytes, call) {what, bytes, name##_work},
    FAMILIES
#undef ROW
};

enum { FAMILIES_COUNT = sizeof families / sizeof *families };

/* Changes the sources to others of the same kind; floats stay between 1 and 2. */
static bool sources_renew(void *context)
{
    struct fields *x = context;
    double some = ++x->turn % 2 ? 0.125 : -0.125;
    CM_u_add_constant_2_1L(x->u, 1, WORD);
    CM_f_add_constant_2_1L(x->f, some, S, E);
    return bench_machine_finished();
}

static void fields_allocate(struct fields *x)
{
    unsigned int dimensions[2] = {(unsigned)side_of(), (unsigned)side_of()};
    CM_field_id_t *const words[] = {&x->u, &x->u_other, &x->u_dest,
                                    &x->f, &x->f_other, &x->f_dest};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(dimensions, 2)));
    CM_set_context();
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        *words[i] = CM_allocate_heap_field(WORD);
    x->half_dest = CM_allocate_heap_field(HALF);
    x->context = CM_allocate_heap_field(1);
    x->test = CM_allocate_heap_field(1);
    x->turn = 0;
    /* Pseudo-random numbers; the divisors are small and not 0. */
    CM_my_news_coordinate_1L(x->u_other, 1, WORD);
    CM_my_news_coordinate_1L(x->u, 0, WORD);
    CM_u_multiply_constant_2_1L(x->u, 2654435761u, WORD);
    CM_u_multiply_constant_2_1L(x->u_other, 40503, WORD);
    CM_u_add_2_1L(x->u, x->u_other, WORD);
    CM_logxor_3_1L(x->u_dest, x->u, x->u_other, WORD);
    CM_u_mod_constant_3_1L(x->u_other, x->u_dest, 1000, WORD);
    CM_u_add_constant_2_1L(x->u_other, 3, WORD);
    CM_u_mod_constant_3_1L(x->u_dest, x->u, 1 << 16, WORD);
    CM_f_u_float_2_2L(x->f, x->u_dest, WORD, S, E);
    CM_f_multiply_constant_2_1L(x->f, 0.75 / 65536, S, E);
    CM_f_add_constant_2_1L(x->f, 1.0, S, E);
    CM_f_u_float_2_2L(x->f_other, x->u_other, WORD, S, E);
    CM_f_multiply_constant_2_1L(x->f_other, 1.0 / 1024, S, E);
    CM_f_add_constant_2_1L(x->f_other, 0.5, S, E);
    CM_f_gt_constant_1L(x->f, 1.3, S, E);
    CM_store_test(x->context);
}

int bench_paris_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {.name = "paris", .repeat_least = 10, .repeat_count = 15};
    struct bench_contender contenders[FAMILIES_COUNT + 1];
    struct fields fields;
    setenv("LUTETIA_NEAR", "0", 1); /* kernels are measured, not the front end */
    int status = bench_machine_start(&report, &options, false, argc, argv);
    if (status >= 0)
        return status;
    fields_allocate(&fields);
    struct bench_copy *copy = bench_copy_create(COPY_BYTES);
    bool ok = copy && bench_machine_finished();
    for (int i = 0; i < FAMILIES_COUNT; i++)
        contenders[i] = (struct bench_contender){.what = families[i].what,
                                                 .ready = sources_renew,
                                                 .work = families[i].work,
                                                 .context = &fields};
    contenders[FAMILIES_COUNT] =
        (struct bench_contender){.work = bench_copy_work, .context = copy};
    ok = ok && bench_measure_in_turns(contenders, FAMILIES_COUNT + 1, options.repeat_count);
    for (int i = 0; ok && i < FAMILIES_COUNT; i++) {
        double gigabytes = families[i].bytes * side_of() * side_of() * 1e-9;
        bench_report_add(&report, families[i].what, OF_CASE,
                         (struct bench_sample){gigabytes / contenders[i].seconds.median,
                                               gigabytes / contenders[i].seconds.min},
                         1, "GB/s");
    }
    if (ok)
        bench_report_add(&report, "copy bandwidth", OF_CASE,
                         bench_copy_rate(copy, contenders[FAMILIES_COUNT].seconds), 1, "GB/s");
    bench_copy_destroy(copy);
    return bench_options_finish(&options, &report, "copy bandwidth", ok);
}
