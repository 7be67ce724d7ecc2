/* steps_sheet.h - a sheet of numbers that flow step by step, and the same steps in plain C. */
#ifndef PARIS_TESTS_STEPS_SHEET_H
#define PARIS_TESTS_STEPS_SHEET_H

#include <stdint.h>
#include <string.h>

#include "paris_internal.h"

enum { HIGH = 96, WIDE = 64, CELLS = HIGH * WIDE };

struct sheet {
    CM_field_id_t cell, flow, neighbour;
    uint32_t wanted[CELLS];
};

static uint64_t foreseen(void)
{
    struct machine_stats now;
    machine_stats_get(paris_machine(), &now);
    return now.calls_foreseen;
}

static uint64_t kernels_run(void)
{
    struct machine_stats now;
    machine_stats_get(paris_machine(), &now);
    return now.kernels_run;
}

static void begin_sheet(struct sheet *s)
{
    s->cell = CM_allocate_heap_field(32);
    s->flow = CM_allocate_heap_field(32);
    s->neighbour = CM_allocate_heap_field(32);
    for (uint32_t i = 0; i < CELLS; i++)
        s->wanted[i] = i * 2654435761u >> 7;
    assert_int_equal(
        machine_field_upload(paris_machine(), s->cell, MACHINE_UINT(32), s->wanted), 0);
}

static void start(struct sheet *s)
{
    unsigned int dimensions[2] = {HIGH, WIDE};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(dimensions, 2)));
    begin_sheet(s);
}

/* One turn: each cell adds differences of its neighbours' cells, and every second column adds a
 * constant. */
static void turn(struct sheet *s, uint32_t add)
{
    CM_get_from_news_1L(s->flow, s->cell, 0, CM_downward, 32);
    CM_get_from_news_1L(s->neighbour, s->flow, 1, CM_downward, 32);
    CM_u_subtract_2_1L(s->flow, s->neighbour, 32);
    CM_u_add_2_1L(s->cell, s->flow, 32);
    CM_my_news_coordinate_1L(s->neighbour, 1, 32);
    CM_u_ne_zero_1L(s->neighbour, 1);
    CM_store_context(s->flow);
    CM_logand_context_with_test();
    CM_u_add_constant_2_1L(s->cell, add, 32);
    CM_load_context(s->flow);
}

static void turn_wanted(struct sheet *s, uint32_t add)
{
    static uint32_t old[CELLS];
    memcpy(old, s->wanted, sizeof old);
    for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDE; x++) {
            uint32_t here = old[(y + HIGH - 1) % HIGH * WIDE + x],
                     left = old[(y + HIGH - 1) % HIGH * WIDE + (x + WIDE - 1) % WIDE];
            s->wanted[y * WIDE + x] += here - left + (x % 2 ? add : 0);
        }
}

static void expect(struct sheet *s)
{
    static uint32_t got[CELLS];
    machine_begin(paris_machine());
    assert_int_equal(machine_field_download(paris_machine(), s->cell, MACHINE_UINT(32), got),
                     0);
    assert_memory_equal(got, s->wanted, sizeof got);
}

#endif
