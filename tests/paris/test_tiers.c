/* Runs random programs without loops in all tiers: byte code and C loops on the front end's
 * threads, the same with even short work shared out to threads, kernels only, one instruction
 * at a time, and small sets' operations as they are called. After each program all fields hold
 * the same bits. */
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

enum { PROGRAMS = 20, STEPS = 40, FIELDS = 4, WIDE = 100, MOST = 400000 };

static const struct tier tiers[] = {
    {"as usual", "1", "1", "1", false, 1, "1", NULL},
    {"byte code, shared out", "2", "2", "0", false, 1, "1", NULL},
    {"kernels", "0", "0", "0", false, 8, "1", NULL},
    {"byte code, one instruction at a time", "1", "2", "0", true, 1, "1", NULL},
    {"gets apart", "2", "2", "0", false, 2, "0", NULL},
    {"byte code", "1", "2", "0", false, 1, "1", NULL},
    {"always at once", "1", "2", "2", false, 1, "1", NULL},
};
enum { TIERS = sizeof tiers / sizeof *tiers };

static uint64_t state;

static unsigned int below(unsigned int n)
{
    return (unsigned int)(sample_shifted(&state) >> 33) % n;
}

static struct {
    unsigned int count;
    CM_field_id_t u[FIELDS], f, d, wide, bit, address, self, at[3];
    unsigned int rank, address_bits;
    CM_geometry_id_t geometry;
} on;

static uint64_t said; /* a hash of the results of reductions and reads */

static void say(uint64_t x)
{
    said = (said ^ x) * 0x9e3779b97f4a7c15u;
}

static CM_field_id_t any(void)
{
    return on.u[below(FIELDS)];
}

/* ---- steps ---- */

static void elementwise(void)
{
    CM_field_id_t to = any(), a = any(), b = any();
    switch (below(10)) {
    case 0:
        CM_u_add_3_1L(to, a, b, 32);
        break;
    case 1:
        CM_u_multiply_3_1L(to, a, b, 32);
        break;
    case 2:
        CM_logxor_3_1L(to, a, b, 32);
        break;
    case 3:
        CM_s_min_3_1L(to, a, b, 32);
        break;
    case 4:
        CM_u_add_constant_3_1L(to, a, below(1000), 32);
        break;
    case 5:
        if (below(2)) {
            CM_f_multiply_2_1L(on.f, on.f, 23, 8);
            CM_f_divide_constant_2_1L(on.f, 1.5, 23, 8);
            CM_f_add_2_1L(on.f, on.f, 23, 8);
            break;
        }
        CM_f_s_float_2_2L(on.f, a, 32, 23, 8);
        CM_f_multiply_constant_2_1L(on.f, 1e-5, 23, 8);
        break;
    case 6:
        CM_f_s_float_2_2L(on.d, a, 32, 52, 11);
        CM_f_add_constant_2_1L(on.d, 0.1, 52, 11);
        break;
    case 7:
        CM_u_move_2L(on.wide, a, WIDE, 32);
        CM_u_move_2L(on.wide + 60, b, WIDE - 60, 32);
        break;
    case 8:
        CM_u_lt_1L(a, b, 32);
        CM_store_test(on.bit);
        break;
    default:
        CM_get_from_news_1L(to, a, below(on.rank), below(2) ? CM_upward : CM_downward, 32);
    }
}

/* A part of the set: between two coordinates along an axis, or at one. */
static void part(void)
{
    const unsigned int axis = below(on.rank),
                       length = CM_geometry_axis_length(on.geometry, axis),
                       from = below(length);
    if (below(3)) {
        CM_u_ge_constant_1L(on.at[axis], from, 32);
        CM_logand_context_with_test();
        CM_u_lt_constant_1L(on.at[axis], from + 1 + below(length - from), 32);
    } else {
        CM_u_eq_constant_1L(on.at[axis], from, 32);
    }
    CM_logand_context_with_test();
}

static void where(void)
{
    CM_set_context();
    for (unsigned int parts = below(2) ? 0 : 1 + below(2); parts--;)
        part();
    if (below(3)) {
        CM_u_lt_constant_1L(any() + below(8), below(4000), 13);
        CM_logand_context_with_test();
    }
}

static void scan(void)
{
    unsigned int axis = below(on.rank), direction = below(2) ? CM_upward : CM_downward,
                 inclusion = below(2) ? CM_inclusive : CM_exclusive, kind = below(3),
                 mode = kind == 0   ? CM_none
                        : kind == 1 ? CM_segment_bit
                                    : CM_start_bit;
    CM_field_id_t to = any(), a = any(), bit = mode == CM_none ? CM_no_field : on.bit;
#define REST axis, 32, direction, inclusion, mode, bit
    switch (below(12)) {
    case 0:
    case 1:
        CM_scan_with_u_add_1L(to, a, REST);
        break;
    case 2:
        CM_scan_with_u_max_1L(to, a, REST);
        break;
    case 3:
        CM_scan_with_s_min_1L(to, a, REST);
        break;
    case 4:
        CM_scan_with_logand_1L(to, a, REST);
        break;
    case 5:
        CM_scan_with_logxor_1L(to, a, REST);
        break;
    case 6:
        CM_scan_with_copy_1L(to, a, REST);
        break;
    case 7:
        CM_scan_with_f_add_1L(on.f, on.f, axis, 23, 8, direction, inclusion, mode, bit);
        break;
    case 8:
        CM_scan_with_f_max_1L(on.d, on.d, axis, 52, 11, direction, inclusion, mode, bit);
        break;
    case 9:
        CM_scan_with_f_add_1L(on.d, on.d, axis, 52, 11, direction, inclusion, mode, bit);
        break;
    case 10:
        CM_scan_with_u_add_1L(on.wide, on.wide, axis, WIDE, direction, inclusion, mode, bit);
        break;
    default:
        CM_enumerate_1L(to, axis, 32, direction, inclusion, mode, bit);
    }
#undef REST
}

static void spread_or_rank(void)
{
    unsigned int axis = below(on.rank);
    CM_field_id_t to = any(), a = any();
    switch (below(5)) {
    case 0:
        CM_spread_with_u_add_1L(to, a, axis, 32);
        break;
    case 1:
        CM_spread_with_f_add_1L(on.f, on.f, axis, 23, 8);
        break;
    case 2:
        CM_spread_with_copy_1L(to, a, axis, 32, 0);
        break;
    case 3:
        CM_f_rank_2L(to, on.f, axis, 32, 23, 8, CM_upward, CM_none, CM_no_field);
        break;
    default:
        CM_u_rank_2L(to, a + 4, axis, 32, 12, CM_downward, below(2) ? CM_segment_bit : CM_none,
                     on.bit);
    }
}

/* Computes send addresses; all are addresses of existing processors. */
static void addresses(void)
{
    switch (below(3)) {
    case 0:
        CM_u_move_1L(on.address, on.self, on.address_bits);
        break;
    case 1:
        CM_get_from_news_1L(on.address, on.address, below(on.rank), CM_upward, on.address_bits);
        break;
    default:
        CM_u_lt_1L(any(), any(), 32);
        CM_logand_context_with_test();
        CM_get_from_power_two_1L(on.address, on.self, 0, below(4), CM_downward,
                                 on.address_bits);
    }
}

static void route(void)
{
    CM_field_id_t to = any(), a = any(), told = below(3) ? CM_no_field : on.bit;
    switch (below(9)) {
    case 0:
    case 1:
        CM_send_1L(to, on.address, a, 32, told);
        break;
    case 2:
        CM_send_with_u_add_1L(to, on.address, a, 32, told);
        break;
    case 3:
        CM_send_with_s_max_1L(to + 8, on.address, a, 16, told);
        break;
    case 4:
        CM_send_with_f_add_1L(on.f, on.address, on.f, 23, 8, told);
        break;
    case 5:
        CM_send_with_logior_1L(to, on.address, a, 32, told);
        break;
    case 6:
        CM_send_1L(on.wide, on.address, on.wide, WIDE, told);
        break;
    case 7:
        CM_get_1L(on.d, on.address, on.d, 64);
        break;
    default:
        CM_get_1L(to, on.address, a, 32);
    }
}

static void look(void)
{
    double x;
    uint64_t bits;
    switch (below(6)) {
    case 0:
        say(CM_global_u_add_1L(any(), 32));
        break;
    case 1:
        say((uint64_t)(int64_t)CM_global_s_min_1L(any(), 32));
        break;
    case 2:
        say(CM_global_count_bit(on.bit));
        break;
    case 3:
        x = CM_global_f_add_1L(on.d, 52, 11);
        memcpy(&bits, &x, sizeof bits);
        say(bits);
        break;
    case 4:
        CM_u_write_to_processor_1L(0, any(), below(1u << 30), 32);
        break;
    default:
        say(CM_u_read_from_processor_1L(0, any(), 32));
    }
}

/* The addresses of processors whose coordinates along an axis differ in some bits. */
static void coordinates_turn(CM_field_id_t coordinate)
{
    const unsigned int axis = below(on.rank),
                       length = CM_geometry_axis_length(on.geometry, axis),
                       bits = below(3) ? 1u << below(14) : below(length);
    CM_my_news_coordinate_1L(coordinate, axis, 32);
    CM_logxor_constant_2_1L(coordinate, bits % length, 32);
    if (below(4))
        CM_u_move_1L(on.address, on.self, on.address_bits);
    CM_deposit_news_coordinate_1L(on.geometry, on.address, axis, coordinate, 32);
}

/* From the processors whose addresses differ in some bits: of these sets all there are. */
static void cross(void)
{
    const unsigned int bits = below(2) ? 1u << below(on.address_bits) : below(on.count);
    CM_field_id_t to = any(), a = any();
    if (on.count != 1u << on.address_bits)
        return;
    if (below(2))
        CM_logxor_constant_3_1L(on.address, on.self, bits, on.address_bits);
    else
        coordinates_turn(any());
    switch (below(4)) {
    case 0:
        CM_get_1L(on.f, on.address, on.f, 32);
        break;
    case 1:
        CM_get_1L(on.bit, on.address, on.bit, 1);
        break;
    default:
        CM_get_1L(to, on.address, a, 32);
        CM_u_min_2_1L(to, a, 32);
    }
}

/* ---- programs ---- */

static int first_program, programs_count = PROGRAMS;

static void set_make(int program)
{
    static const unsigned int shapes[][3] = {
        {37, 0},  {700, 0},  {20, 33},  {5, 7, 3},  {1, 0},    {5000, 0}, {3, 1300},  {40, 60},
        {130, 3}, {MOST, 0}, {4096, 0}, {16, 1024}, {8192, 0}, {64, 64},  {32, 4, 16}};
    const unsigned int *shape = shapes[program % (int)(sizeof shapes / sizeof *shapes)];
    on.rank = 0;
    on.count = 1;
    while (on.rank < 3 && shape[on.rank])
        on.count *= shape[on.rank++];
    on.geometry = CM_create_geometry((unsigned int *)(uintptr_t)shape, on.rank);
    CM_set_vp_set(CM_allocate_vp_set(on.geometry));
    CM_set_context();
    on.address_bits = CM_geometry_send_address_length(on.geometry);
    on.address_bits = on.address_bits ? on.address_bits : 1;
    on.address = CM_allocate_heap_field(on.address_bits);
    on.self = CM_allocate_heap_field(on.address_bits);
    for (unsigned int axis = 0; axis < on.rank; axis++) {
        on.at[axis] = CM_allocate_heap_field(32);
        CM_my_news_coordinate_1L(on.at[axis], axis, 32);
    }
    CM_my_send_address(on.self);
    CM_u_move_1L(on.address, on.self, on.address_bits);
    for (int i = 0; i < FIELDS; i++) {
        on.u[i] = CM_allocate_heap_field(32);
        CM_my_news_coordinate_1L(on.u[i], on.rank - 1, 32);
        CM_u_multiply_constant_3_1L(on.u[i], on.u[i], 0x9e3779b1u * (unsigned int)(i + 1), 32);
    }
    on.f = CM_allocate_heap_field(32);
    on.d = CM_allocate_heap_field(64);
    on.wide = CM_allocate_heap_field(WIDE);
    on.bit = CM_allocate_heap_field(1);
    CM_f_s_float_2_2L(on.f, on.u[0], 32, 23, 8);
    CM_f_s_float_2_2L(on.d, on.u[1], 32, 52, 11);
    CM_u_move_2L(on.wide, on.u[2], WIDE, 32);
    CM_u_lt_1L(on.u[0], on.u[3], 32);
    CM_store_test(on.bit);
}

static void field_say(CM_field_id_t field, int bits)
{
    static unsigned char content[16 * MOST];
    struct machine *m = paris_machine();
    size_t element = bits <= 8 ? 1 : bits <= 16 ? 2 : bits <= 32 ? 4 : bits <= 64 ? 8 : 16;
    assert_int_equal(machine_field_download(m, field, MACHINE_UINT(bits), content), MACHINE_OK);
    for (size_t i = 0; i < on.count * element; i++)
        say(content[i]);
}

/* Runs a program; returns a hash of its fields and of all that it has read. */
static uint64_t program_run(int program, const struct tier *t)
{
    state = 88172645463325252u + (uint64_t)program * 104729;
    said = 1;
    tier_begin(t, 16);
    set_make(program);
    for (int step = 0; step < (on.count == MOST ? STEPS / 2 : STEPS); step++) {
        unsigned int what = below(on.count >= 4096 && on.count < MOST ? 22 : 16);
        if (what < 5)
            elementwise();
        else if (what < 6)
            where();
        else if (what < 9)
            scan();
        else if (what < 10)
            spread_or_rank();
        else if (what < 11)
            addresses();
        else if (what < 14)
            route();
        else if (what < 16)
            look();
        else
            cross();
    }
    for (int i = 0; i < FIELDS; i++)
        field_say(on.u[i], 32);
    field_say(on.f, 32);
    field_say(on.d, 64);
    field_say(on.wide, WIDE);
    field_say(on.bit, 1);
    field_say(on.address, (int)on.address_bits);
    return said;
}

static void all_tiers_give_the_same_bits(void **unused)
{
    struct machine_stats stats;
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
            machine_stats_get(paris_machine(), &stats);
            if (!strcmp(tiers[i].interpret, "2") && !strcmp(tiers[i].near, "2"))
                assert_int_equal(stats.kernels_run, 0);
            if (!strcmp(tiers[i].near, "0"))
                assert_int_equal(stats.interpreted, 0);
        }
    }
}

/* [programs [the first]] */
int main(int argc, char **argv)
{
    if (argc > 1)
        programs_count = atoi(argv[1]);
    if (argc > 2)
        first_program = atoi(argv[2]);
    unsetenv("LUTETIA_LEDS");
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_tiers_give_the_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
