/* Spreads of lines as values: random programs of spreads of all widths along all axes, of what
 * is computed and of what is in memory, mixed with shifts, contexts, products and parts of
 * fields. All tiers give the bits of one instruction at a time, where each spread is an
 * array. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../sample.h"
#include "paris_internal.h"
#include "tier.h"
#include <cm/paris.h>

enum { PROGRAMS = 24, STEPS = 40, FIELDS = 4, WIDE = 100, MOST = 60000 };

static const struct tier tiers[] = {
    {"one instruction at a time", "1", "2", "0", true, 1, NULL, NULL},
    {"as usual", "1", "1", "1", false, 1, NULL, NULL},
    {"byte code", "1", "2", "0", false, 1, NULL, NULL},
    {"byte code, shared out", "2", "2", "0", false, 1, NULL, NULL},
    {"kernels", "0", "0", "0", false, 12, NULL, NULL},
    {"always at once", "1", "2", "2", false, 2, NULL, NULL},
};
enum { TIERS = sizeof tiers / sizeof *tiers };

static uint64_t state, said;
static int first_program, programs_count = PROGRAMS;
static struct {
    unsigned int count, rank, sides[3];
    CM_field_id_t u[FIELDS], f[FIELDS], d[FIELDS], wide, bit, small;
} on;

static unsigned int below(unsigned int n)
{
    return (unsigned int)(sample_shifted(&state) >> 33) % n;
}

static void say(uint64_t x)
{
    said = (said ^ x) * 0x9e3779b97f4a7c15u;
}

static CM_field_id_t any(const CM_field_id_t of[FIELDS])
{
    return of[below(FIELDS)];
}

static void spread(void)
{
    const unsigned int axis = below(on.rank), at = below(on.sides[axis]);
    switch (below(9)) {
    case 0:
    case 1:
        CM_spread_with_copy_1L(any(on.f), any(on.f), axis, 32, at);
        break;
    case 2:
    case 3:
        CM_spread_with_copy_1L(any(on.d), any(on.d), axis, 64, at);
        break;
    case 4:
        CM_spread_with_copy_1L(any(on.u), any(on.u), axis, 32, at);
        break;
    case 5:
        CM_spread_with_copy_1L(on.wide, on.wide, axis, WIDE, at);
        break;
    case 6:
        CM_spread_with_copy_1L(on.small, on.small, axis, 7, at);
        break;
    case 7:
        CM_spread_with_copy_1L(on.bit, on.bit, axis, 1, at);
        break;
    default: /* a part of a field, to another */
        CM_spread_with_copy_1L(any(on.u) + 8, any(on.u) + 3, axis, 12, at);
    }
}

static void compute(void)
{
    CM_field_id_t u = any(on.u), v = any(on.u), f = any(on.f), g = any(on.f), d = any(on.d),
                  e = any(on.d);
    switch (below(11)) {
    case 0:
        CM_f_multiply_2_1L(f, g, 23, 8);
        break;
    case 1:
        CM_f_add_2_1L(f, g, 23, 8);
        break;
    case 2:
        CM_f_divide_2_1L(d, e, 52, 11);
        break;
    case 3:
        CM_f_subtract_2_1L(d, e, 52, 11);
        break;
    case 4:
        CM_f_multiply_2_1L(d, e, 52, 11);
        break;
    case 5:
        CM_u_add_3_1L(u, u, v, 32);
        break;
    case 6:
        CM_get_from_news_1L(f, g, below(on.rank), below(2) ? CM_upward : CM_downward, 32);
        break;
    case 7:
        CM_u_move_2L(on.wide + 40, u, WIDE - 40, 32);
        break;
    case 8:
        CM_f_gt_1L(f, g, 23, 8);
        CM_store_test(on.bit);
        break;
    case 9:
        CM_u_move_2L(on.small, u, 7, 32);
        break;
    default:
        CM_scan_with_u_add_1L(u, v, below(on.rank), 32, CM_upward, CM_exclusive,
                              below(2) ? CM_none : CM_start_bit, on.bit);
    }
}

static void where(void)
{
    const unsigned int axis = below(on.rank);
    CM_set_context();
    switch (below(4)) {
    case 0:
        return;
    case 1:
        CM_u_lt_constant_1L(any(on.u), below(4000), 13);
        break;
    case 2:
        CM_my_news_coordinate_1L(on.u[0], axis, 32);
        CM_u_gt_constant_1L(on.u[0], below(on.sides[axis]), 32);
        break;
    default:
        CM_my_news_coordinate_1L(on.u[1], axis, 32);
        CM_u_eq_constant_1L(on.u[1], below(on.sides[axis]), 32);
    }
    CM_logand_context_with_test();
}

/* A step of an elimination, and one of a product of matrices. */
static void eliminate(void)
{
    const unsigned int row = below(on.rank), column = (row + 1) % on.rank,
                       k = below(on.sides[row]), l = below(on.sides[column]);
    CM_spread_with_copy_1L(on.d[1], on.d[0], row, 64, k);
    CM_spread_with_copy_1L(on.d[2], on.d[1], column, 64, l);
    CM_f_divide_2_1L(on.d[0], on.d[2], 52, 11);
    CM_spread_with_copy_1L(on.d[3], on.d[0], column, 64, l);
    CM_f_multiply_2_1L(on.d[3], on.d[1], 52, 11);
    CM_f_subtract_2_1L(on.d[0], on.d[3], 52, 11);
    CM_spread_with_copy_1L(on.f[1], on.f[0], row, 32, k);
    CM_spread_with_copy_1L(on.f[2], on.f[3], column, 32, l);
    CM_f_multiply_2_1L(on.f[1], on.f[2], 23, 8);
    CM_f_add_2_1L(on.f[3], on.f[1], 23, 8);
}

static void set_make(int program)
{
    static const unsigned int shapes[][3] = {{700, 0},  {20, 33},    {5, 7, 700}, {40, 900},
                                             {3, 1300}, {9, 600, 3}, {17, 520},   {1, 5000},
                                             {64, 512}, {2, 3, 5}};
    const unsigned int *shape = shapes[program % (int)(sizeof shapes / sizeof *shapes)];
    on.rank = 0;
    on.count = 1;
    while (on.rank < 3 && shape[on.rank]) {
        on.sides[on.rank] = shape[on.rank];
        on.count *= shape[on.rank++];
    }
    CM_set_vp_set(
        CM_allocate_vp_set(CM_create_geometry((unsigned int *)(uintptr_t)shape, on.rank)));
    CM_set_context();
    on.wide = CM_allocate_heap_field(WIDE);
    on.bit = CM_allocate_heap_field(1);
    on.small = CM_allocate_heap_field(7);
    for (int i = 0; i < FIELDS; i++) {
        on.u[i] = CM_allocate_heap_field(32);
        on.f[i] = CM_allocate_heap_field(32);
        on.d[i] = CM_allocate_heap_field(64);
        CM_u_random_1L(on.u[i], 32, 0);
        CM_f_s_float_2_2L(on.f[i], on.u[i], 32, 23, 8);
        CM_f_s_float_2_2L(on.d[i], on.u[i], 32, 52, 11);
    }
    CM_u_move_2L(on.wide, on.u[2], WIDE, 32);
    CM_u_move_2L(on.small, on.u[1], 7, 32);
    CM_u_lt_1L(on.u[0], on.u[3], 32);
    CM_store_test(on.bit);
}

static void field_say(CM_field_id_t field, int bits)
{
    static unsigned char content[16 * MOST];
    size_t element = bits <= 8 ? 1 : bits <= 16 ? 2 : bits <= 32 ? 4 : bits <= 64 ? 8 : 16;
    assert_int_equal(
        machine_field_download(paris_machine(), field, MACHINE_UINT(bits), content),
        MACHINE_OK);
    for (size_t i = 0; i < on.count * element; i++)
        say(content[i]);
}

static uint64_t program_run(int program, const struct tier *t)
{
    state = 88172645463325252u + (uint64_t)program * 104729;
    said = 1;
    tier_begin(t, 16);
    set_make(program);
    for (int step = 0; step < STEPS; step++) {
        unsigned int what = below(16);
        if (what < 6)
            spread();
        else if (what < 12)
            compute();
        else if (what < 14)
            where();
        else if (what < 15)
            eliminate();
        else
            say(CM_u_read_from_processor_1L(0, any(on.u), 32));
    }
    for (int i = 0; i < FIELDS; i++) {
        field_say(on.u[i], 32);
        field_say(on.f[i], 32);
        field_say(on.d[i], 64);
    }
    field_say(on.wide, WIDE);
    field_say(on.small, 7);
    field_say(on.bit, 1);
    return said;
}

static void all_tiers_give_the_same_bits(void **unused)
{
    (void)unused;
    for (int program = first_program; program < first_program + programs_count; program++) {
        uint64_t first = 0;
        for (int i = 0; i < TIERS; i++) {
            if (program % tiers[i].every)
                continue;
            uint64_t is = program_run(program, &tiers[i]);
            if (i == 0)
                first = is;
            else if (is != first)
                fail_msg("program %d: not the same %s", program, tiers[i].name);
        }
    }
}

/* A product of matrices by spreads makes no array for a spread. */
static void a_product_holds_no_spreads(void **unused)
{
    struct machine_stats stats;
    (void)unused;
    tier_begin(&tiers[1], 16);
    set_make(3);
    for (unsigned int k = 0; k < 40; k++) {
        CM_spread_with_copy_1L(on.f[1], on.f[0], 1, 32, k);
        CM_spread_with_copy_1L(on.f[2], on.f[3], 0, 32, k);
        CM_f_multiply_2_1L(on.f[1], on.f[2], 23, 8);
        CM_f_add_2_1L(on.f[3], on.f[1], 23, 8);
    }
    machine_stats_get(paris_machine(), &stats);
    assert_true(stats.bytes_peak < 40 * (uint64_t)4 * on.count);
}

/* [programs [the first]] */
int main(int argc, char **argv)
{
    if (argc > 1)
        programs_count = atoi(argv[1]);
    if (argc > 2)
        first_program = atoi(argv[2]);
    unsetenv("LUTETIA_LEDS");
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_tiers_give_the_same_bits),
                                       cmocka_unit_test(a_product_holds_no_spreads)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
