/* Work that the front end does itself where it shares memory with the device: reads and writes
 * of one processor, gathered writes, reductions. Random programs mix these with instructions.
 * They run with LUTETIA_NEAR=1, with LUTETIA_NEAR=0 (the device does all of it), and on the
 * eager machine. All three give the same numbers, and integers also agree with a model in plain
 * C. */
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
#include <cm/paris.h>

enum { PROGRAMS = 6, STEPS = 60, MOST = 700, MODES = 3 };

static uint64_t state;

static unsigned int below(unsigned int n)
{
    return (unsigned int)(sample_shifted(&state) >> 33) % n;
}

/* ---- the model ---- */

static struct model {
    unsigned int count;
    uint32_t a[MOST], b[MOST];
    uint16_t c[MOST];
    bool active[MOST];
} model;

static CM_field_id_t a, b, c, f;
static uint64_t said[STEPS * 2];
static int said_count;

static void say(uint64_t x)
{
    said[said_count++] = x;
}

static void expect(uint64_t is, uint64_t should, const char *what, int program, int step)
{
    if (is != should)
        fail_msg("program %d, step %d, %s: %llx, not %llx", program, step, what,
                 (unsigned long long)is, (unsigned long long)should);
    say(is);
}

/* ---- steps ---- */

static void instruction(void)
{
    struct model *m = &model;
    unsigned int k = below(1000);
    switch (below(6)) {
    case 0:
        CM_u_add_2_1L(a, b, 32);
        for (unsigned int i = 0; i < m->count; i++)
            m->a[i] += m->active[i] ? m->b[i] : 0;
        break;
    case 1:
        CM_logxor_2_1L(b, a, 32);
        for (unsigned int i = 0; i < m->count; i++)
            m->b[i] ^= m->active[i] ? m->a[i] : 0;
        break;
    case 2:
        CM_u_move_2L(c, a, 16, 32);
        for (unsigned int i = 0; i < m->count; i++)
            m->c[i] = m->active[i] ? (uint16_t)m->a[i] : m->c[i];
        break;
    case 3:
        CM_set_context();
        CM_u_lt_constant_1L(c, 40 * k, 16);
        CM_logand_context_with_test();
        for (unsigned int i = 0; i < m->count; i++)
            m->active[i] = m->c[i] < 40 * k;
        break;
    case 4:
        CM_set_context();
        for (unsigned int i = 0; i < m->count; i++)
            m->active[i] = true;
        break;
    default:
        CM_f_u_float_2_2L(f, c, 16, 23, 8);
        CM_f_multiply_constant_2_1L(f, 0.1, 23, 8);
    }
}

static void write_one(void)
{
    struct model *m = &model;
    for (unsigned int times = 1 + below(5); times; times--) {
        unsigned int p = below(m->count), x = below(1u << 31) * 2u + below(2), at = below(3);
        if (below(8) == 0)
            p = below(2) ? 0 : m->count - 1;
        if (at == 0) {
            CM_u_write_to_processor_1L(p, a, x, 32);
            m->a[p] = x;
        } else if (at == 1) { /* a part */
            CM_u_write_to_processor_1L(p, b + 8, x >> 16, 16);
            m->b[p] = (m->b[p] & 0xff0000ffu) | x >> 16 << 8;
        } else {
            CM_u_write_to_processor_1L(p, c, x & 0xffff, 16);
            m->c[p] = (uint16_t)x;
        }
    }
}

static void read_one(int program, int step)
{
    unsigned int p = below(model.count);
    double x;
    uint64_t bits = 0;
    switch (below(5)) {
    case 0:
        expect(CM_u_read_from_processor_long_1L(p, a, 32), model.a[p], "a", program, step);
        break;
    case 1:
        expect(CM_u_read_from_processor_long_1L(p, b + 5, 20), model.b[p] >> 5 & 0xfffff,
               "part of b", program, step);
        break;
    case 2:
        expect((uint64_t)CM_s_read_from_processor_1L(p, c, 16),
               (uint64_t)(int64_t)(int16_t)model.c[p], "c", program, step);
        break;
    case 3:
        expect(CM_u_read_from_processor_long_1L(p, a + 24, 8), model.a[p] >> 24, "part of a",
               program, step);
        break;
    default:
        x = CM_f_read_from_processor_1L(p, f, 23, 8);
        memcpy(&bits, &x, sizeof x);
        say(bits);
    }
}

static uint64_t reduced(unsigned int op)
{
    const struct model *m = &model;
    uint64_t sum = op == 1 || op == 4 ? UINT64_MAX : 0;
    int64_t least = INT64_MAX;
    for (unsigned int i = 0; i < m->count; i++) {
        uint64_t x = m->a[i];
        if (!m->active[i])
            continue;
        sum = op == 0   ? sum + x
              : op == 1 ? sum & x
              : op == 2 ? sum | x
              : op == 3 ? (x > sum ? x : sum)
              : op == 4 ? (x < sum ? x : sum)
              : op == 5 ? sum ^ x
                        : sum + (uint64_t)(int64_t)(int16_t)m->c[i];
        least = (int16_t)m->c[i] < least ? (int16_t)m->c[i] : least;
    }
    if (op == 7)
        return (uint64_t)(least == INT64_MAX ? INT16_MAX : least);
    return op == 1 || op == 4 ? sum & UINT32_MAX : sum;
}

static void reduce(int program, int step)
{
    unsigned int op = below(10);
    uint64_t is = 0, ones = 0;
    double x = 0;
    switch (op) {
    case 0:
        is = CM_global_u_add_long_1L(a, 32);
        break;
    case 1:
        is = CM_global_logand_long_1L(a, 32);
        break;
    case 2:
        is = CM_global_logior_long_1L(a, 32);
        break;
    case 3:
        is = CM_global_u_max_long_1L(a, 32);
        break;
    case 4:
        is = CM_global_u_min_long_1L(a, 32);
        break;
    case 5:
        is = CM_global_logxor_long_1L(a, 32);
        break;
    case 6:
        is = (uint64_t)CM_global_s_add_long_1L(c, 16);
        break;
    case 7:
        is = (uint64_t)CM_global_s_min_long_1L(c, 16);
        break;
    case 8:
        for (unsigned int i = 0; i < model.count; i++)
            ones += model.active[i] && (model.a[i] >> 3 & 1);
        expect(CM_global_count_bit(a + 3), ones, "count", program, step);
        return;
    default:
        x = below(2) ? CM_global_f_add_1L(f, 23, 8) : CM_global_f_min_1L(f, 23, 8);
        memcpy(&is, &x, sizeof x);
        say(is);
        return;
    }
    expect(is, reduced(op), "a reduction", program, step);
}

/* ---- programs ---- */

static void machine_begin_as(int mode)
{
    struct machine_config config = machine_config_default();
    setenv("LUTETIA_NEAR", mode == 1 ? "0" : "1", 1);
    config.eager = mode == 2;
    config.processors_count = 16;
    assert_true(paris_reset(&config));
}

static void program_run(int program, int mode)
{
    static const int shapes[][3] = {{1, 1, 1}, {1, 1, 37},  {1, 1, 700},
                                    {5, 7, 3}, {1, 20, 33}, {1, 3, 130}};
    const int *shape = shapes[program % (int)(sizeof shapes / sizeof *shapes)];
    state = 88172645463325252u + (uint64_t)program * 7919;
    said_count = 0;
    machine_begin_as(mode);
    /* The axes are in send order, so that a send address is a row-major index. */
    struct CM_axis_descriptor axes[3];
    CM_axis_descriptor_t all[3];
    memset(axes, 0, sizeof axes);
    for (int i = 0; i < 3; i++) {
        axes[i].length = (unsigned int)shape[i];
        axes[i].weight = 1;
        axes[i].ordering = CM_send_order;
        all[i] = &axes[i];
    }
    CM_set_vp_set(CM_allocate_vp_set(CM_create_detailed_geometry(all, 3)));
    memset(&model, 0, sizeof model);
    model.count = (unsigned int)(shape[0] * shape[1] * shape[2]);
    a = CM_allocate_heap_field(32);
    b = CM_allocate_heap_field(32);
    c = CM_allocate_heap_field(16);
    f = CM_allocate_heap_field(32);
    for (unsigned int i = 0; i < model.count; i++)
        model.active[i] = true;
    CM_my_send_address(b);
    for (unsigned int i = 0; i < model.count; i++)
        model.b[i] = i;
    for (int step = 0; step < STEPS; step++) {
        unsigned int what = below(10);
        if (what < 3)
            instruction();
        else if (what < 5)
            write_one();
        else if (what < 8)
            read_one(program, step);
        else
            reduce(program, step);
    }
    for (unsigned int p = 0; p < model.count; p++) {
        if (CM_u_read_from_processor_long_1L(p, a, 32) != model.a[p] ||
            CM_u_read_from_processor_long_1L(p, b, 32) != model.b[p] ||
            CM_u_read_from_processor_long_1L(p, c, 16) != model.c[p])
            fail_msg("program %d, mode %d: processor %u", program, mode, p);
    }
}

static void all_modes_say_the_same(void **unused)
{
    static uint64_t first[STEPS * 2];
    (void)unused;
    for (int program = 0; program < PROGRAMS; program++) {
        int count = 0;
        for (int mode = 0; mode < MODES; mode++) {
            if (mode == 2 && program >= 2)
                break;
            program_run(program, mode);
            if (mode == 0)
                memcpy(first, said, sizeof said);
            else if (count != said_count ||
                     memcmp(first, said, (size_t)count * sizeof *said) != 0)
                fail_msg("program %d: mode %d says something else", program, mode);
            count = said_count;
        }
    }
}

/* Thousands of writes into a field that is not computed yet build no plans. */
static void writes_make_no_plans(void **unused)
{
    struct machine_stats before, after;
    (void)unused;
    machine_begin_as(0);
    CM_field_id_t x = CM_allocate_heap_field(32), y = CM_allocate_heap_field(32);
    CM_my_send_address(x);
    CM_u_multiply_3_1L(y, x, x, 32);
    machine_stats_get(paris_machine(), &before);
    for (unsigned int i = 0; i < 5000; i++)
        CM_u_write_to_processor_1L(i % 16, y, i, 32);
    machine_stats_get(paris_machine(), &after);
    assert_int_equal(before.plans_built, after.plans_built);
    assert_int_equal(before.kernels_run, after.kernels_run);
    for (unsigned int p = 0; p < 16; p++)
        assert_int_equal(CM_u_read_from_processor_1L(p, y, 32), 4984 + (p + 16 - 8) % 16);
}

int main(void)
{
    unsetenv("LUTETIA_LEDS");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_modes_say_the_same),
        cmocka_unit_test(writes_make_no_plans),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
