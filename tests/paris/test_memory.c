/* Memory: what an evaluation after each instruction can do in so many bytes, the default can do
 * in a quarter more, with the same bits. Random programs of stencils, spreads, scans, sends,
 * contexts and several sets are run with the limit at that size. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../sample.h"
#include "device.h"

enum { PROGRAMS = 40, STEPS = 60, FIELDS = 6, LOOKED_AT_AS_BITS = 1027 };

static uint64_t state, said;
static int first_program, programs_count = PROGRAMS;
static struct {
    unsigned int count, rank, sides[3], address_bits;
    CM_field_id_t u[FIELDS], f[FIELDS], bit, address;
} on;

static unsigned int below(unsigned int n)
{
    return (unsigned int)(sample_shifted(&state) >> 33) % n;
}

static void begin(bool eager, uint64_t bytes)
{
    struct machine_config config = machine_config_default();
    char limit[32] = "";
    if (bytes)
        snprintf(limit, sizeof limit, "%llu", (unsigned long long)bytes);
    setenv("LUTETIA_MEMORY", limit, 1);
    config.eager = eager;
    config.processors_count = 16;
    assert_true(paris_reset(&config));
}

static uint64_t peak(void)
{
    struct machine_stats stats;
    machine_stats_get(paris_machine(), &stats);
    return stats.bytes_peak;
}

static void set_make(int program)
{
    static const unsigned int shapes[][3] = {{20000, 0}, {90, 700},    {16, 20, 64},
                                             {256, 256}, {40, 30, 20}, {3, 9000}};
    const unsigned int *shape = shapes[program % (int)(sizeof shapes / sizeof *shapes)];
    on.rank = 0;
    on.count = 1;
    while (on.rank < 3 && shape[on.rank]) {
        on.sides[on.rank] = shape[on.rank];
        on.count *= shape[on.rank++];
    }
    CM_geometry_id_t geometry = CM_create_geometry((unsigned int *)(uintptr_t)shape, on.rank);
    CM_set_vp_set(CM_allocate_vp_set(geometry));
    CM_set_context();
    on.address_bits = CM_geometry_send_address_length(geometry);
    on.address = CM_allocate_heap_field(on.address_bits);
    CM_my_send_address(on.address);
    for (int i = 0; i < FIELDS; i++) {
        on.u[i] = CM_allocate_heap_field(32);
        on.f[i] = CM_allocate_heap_field(32);
        CM_my_news_coordinate_1L(on.u[i], (unsigned int)i % on.rank, 32);
        CM_u_multiply_constant_3_1L(on.u[i], on.u[i], 0x9e3779b1u * (unsigned int)(i + 1), 32);
        CM_f_u_float_2_2L(on.f[i], on.u[i], 32, 23, 8);
    }
    on.bit = CM_allocate_heap_field(1);
    CM_u_lt_1L(on.u[0], on.u[1], 32);
    CM_store_test(on.bit);
}

static void step(void)
{
    CM_field_id_t u = on.u[below(FIELDS)], v = on.u[below(FIELDS)], f = on.f[below(FIELDS)],
                  g = on.f[below(FIELDS)], h = on.f[below(FIELDS)];
    unsigned int axis = below(on.rank), direction = below(2) ? CM_upward : CM_downward;
    switch (below(14)) {
    case 0:
        CM_get_from_news_1L(f, g, axis, direction, 32);
        CM_f_add_2_1L(g, f, 23, 8);
        break;
    case 1:
        CM_spread_with_copy_1L(f, g, axis, 32, below(on.sides[axis]));
        break;
    case 2:
        CM_f_multiply_3_1L(h, f, g, 23, 8);
        break;
    case 3:
        CM_f_subtract_2_1L(f, g, 23, 8);
        break;
    case 4:
        CM_f_multiply_constant_2_1L(f, 0.25, 23, 8);
        break;
    case 5:
        CM_u_add_3_1L(u, u, v, 32);
        break;
    case 6:
        CM_set_context();
        CM_u_lt_constant_1L(u, below(4000), 13);
        CM_logand_context_with_test();
        break;
    case 7:
        CM_set_context();
        break;
    case 8:
        CM_scan_with_u_add_1L(u, v, axis, 32, direction, CM_inclusive,
                              below(2) ? CM_none : CM_segment_bit, on.bit);
        break;
    case 9:
        CM_spread_with_u_max_1L(u, v, axis, 32);
        break;
    case 10:
        CM_send_with_u_add_1L(u, on.address, v, 32, CM_no_field);
        break;
    case 11:
        CM_get_1L(f, on.address, g, 32);
        break;
    case 12:
        CM_u_rank_2L(u, v, axis, 32, 12, CM_upward, CM_none, CM_no_field);
        break;
    default:
        CM_f_gt_1L(f, g, 23, 8);
        CM_store_test(on.bit);
    }
}

/* A hash of all fields. */
static uint64_t program_run(int program)
{
    state = 88172645463325252u + (uint64_t)program * 104729;
    said = 1;
    set_make(program);
    for (int i = 0; i < STEPS; i++)
        step();
    unsigned char *content = malloc(4 * (size_t)on.count);
    assert_non_null(content);
    for (int i = 0; i < 2 * FIELDS; i++) {
        assert_int_equal(machine_field_download(paris_machine(),
                                                i < FIELDS ? on.u[i] : on.f[i - FIELDS],
                                                MACHINE_UINT(32), content),
                         MACHINE_OK);
        for (size_t k = 0; k < 4 * (size_t)on.count; k++)
            said = (said ^ content[k]) * 0x9e3779b97f4a7c15u;
    }
    free(content);
    return said;
}

static void a_quarter_more_than_eager_suffices(void **unused)
{
    int fewer = 0;
    (void)unused;
    for (int i = 0; i < programs_count; i++) {
        /* the first one: fields of floats are looked at as bits where nearly all is in use */
        const int program = i || first_program ? first_program + i : LOOKED_AT_AS_BITS;
        begin(true, 0);
        const uint64_t bits = program_run(program), bytes = peak();
        begin(false, bytes + bytes / 4);
        if (program_run(program) != bits)
            fail_msg("program %d: not the same bits in %llu bytes", program,
                     (unsigned long long)(bytes + bytes / 4));
        assert_true(peak() <= bytes + bytes / 4);
        begin(false, 0);
        assert_true(program_run(program) == bits);
        fewer += peak() > bytes + bytes / 4;
    }
    assert_true(fewer > 0); /* without the limit some take more */
}

/* Turns of a stencil that nobody looks at, and of products of spreads. */
static void loops_wait_within_the_limit(void **unused)
{
    uint64_t bits[2];
    (void)unused;
    for (int eager = 1; eager >= 0; eager--) {
        static uint64_t bytes;
        begin(eager, eager ? 0 : bytes + bytes / 4);
        set_make(3);
        for (unsigned int i = 0; i < 200; i++) {
            CM_get_from_news_1L(on.f[1], on.f[0], 0, CM_upward, 32);
            CM_f_add_2_1L(on.f[0], on.f[1], 23, 8);
            CM_f_multiply_constant_2_1L(on.f[0], 0.5, 23, 8);
            CM_spread_with_copy_1L(on.f[2], on.f[0], 1, 32, i);
            CM_spread_with_copy_1L(on.f[3], on.f[4], 0, 32, i);
            CM_f_multiply_2_1L(on.f[2], on.f[3], 23, 8);
            CM_f_add_2_1L(on.f[5], on.f[2], 23, 8);
        }
        bits[eager] = 0;
        for (int i = 0; i < FIELDS; i++)
            bits[eager] = bits[eager] * 31 + CM_global_u_add_1L(on.f[i], 32);
        bytes = peak();
    }
    assert_true(bits[0] == bits[1]);
}

/* What flows from field to field under a context, along both axes: what is stored is a choice,
 * and what comes later takes the new value without it. */
static void flows(CM_field_id_t inside)
{
    for (unsigned int axis = 0; axis < 2; axis++) {
        CM_load_context(inside);
        for (int i = 0; i < 4; i++) {
            CM_get_from_news_1L(on.f[4], on.f[i], axis, CM_downward, 32);
            CM_f_subtract_3_1L(on.f[5], on.f[4], on.f[i], 23, 8);
            CM_f_multiply_constant_2_1L(on.f[5], 0.125, 23, 8);
            if (i)
                CM_f_multiply_2_1L(on.f[5], on.f[0], 23, 8);
            CM_store_context(on.bit);
            CM_f_gt_zero_1L(on.f[5], 23, 8);
            CM_logand_context_with_test();
            CM_f_multiply_constant_2_1L(on.f[5], 1.5, 23, 8);
            CM_load_context(on.bit);
            CM_get_from_news_1L(on.f[4], on.f[5], axis, CM_upward, 32);
            CM_f_add_2_1L(on.f[i], on.f[5], 23, 8);
            CM_f_subtract_2_1L(on.f[i], on.f[4], 23, 8);
            CM_f_min_constant_2_1L(on.f[i], 1.0, 23, 8);
            CM_f_max_constant_2_1L(on.f[i], 0.0, 23, 8);
        }
        CM_set_context();
    }
}

static void what_flows_under_a_context_waits_within_the_limit(void **unused)
{
    uint64_t bits[2], bytes = 0;
    (void)unused;
    for (int eager = 1; eager >= 0; eager--) {
        begin(eager, eager ? 0 : bytes + bytes / 4);
        set_make(3);
        CM_field_id_t inside = CM_allocate_heap_field(1);
        for (int i = 0; i < 4; i++)
            CM_f_multiply_constant_2_1L(on.f[i], 0x1p-32, 23, 8);
        CM_u_gt_constant_1L(on.u[0], 1u << 20, 32);
        CM_store_test(inside);
        for (int i = 0; i < FIELDS; i++)
            CM_deallocate_heap_field(on.u[i]);
        for (int i = 0; i < 10; i++)
            flows(inside);
        bits[eager] = 0;
        for (int i = 0; i < 4; i++)
            bits[eager] = bits[eager] * 31 + CM_global_u_add_1L(on.f[i], 32);
        bytes = peak();
    }
    assert_true(bits[0] == bits[1]);
}

static void what_never_fits_is_told_by_fields(void **unused)
{
    (void)unused;
    begin(false, 600000);
    CM_set_error_handler(device_error_catch);
    device_message[0] = '\0';
    set_make(3);
    for (int i = 0; i < FIELDS && !device_message[0]; i++) {
        CM_u_random_1L(on.u[i], 32, 0);
        CM_global_u_add_1L(on.u[i], 32);
    }
    assert_non_null(strstr(device_message, "do not fit in the memory"));
    assert_non_null(strstr(device_message, "by field "));
    assert_non_null(strstr(device_message, "deallocate fields"));
    assert_null(strchr(device_message, '\n'));
}

/* [programs [the first]] */
int main(int argc, char **argv)
{
    if (argc > 1)
        programs_count = atoi(argv[1]);
    if (argc > 2)
        first_program = atoi(argv[2]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_quarter_more_than_eager_suffices),
        cmocka_unit_test(loops_wait_within_the_limit),
        cmocka_unit_test(what_flows_under_a_context_waits_within_the_limit),
        cmocka_unit_test(what_never_fits_is_told_by_fields)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
