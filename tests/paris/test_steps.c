/* Steps that repeat: the machine performs them without recording them again, and many in one
 * kernel where that is forced. They leave the bits of plain C, whatever other calls come
 * between them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "paris_internal.h"
#include <cm/paris.h>

#include "base/parts.h"
#include "machine_explained.h"
#include "memory/memory.h"
#include "steps_sheet.h"
#include "values/values.h"

enum { CALLS = 10, TURNS = 240 };

static void a_loop_is_not_recorded_again(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    uint64_t before = foreseen();
    for (int i = 0; i < TURNS; i++) {
        turn(&s, 3);
        turn_wanted(&s, 3);
    }
    expect(&s);
    assert_true(foreseen() - before >= CALLS * TURNS / 2);
}

static void a_loop_that_is_looked_at_is_not_either(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    uint64_t before = foreseen();
    for (int i = 0; i < 60; i++) {
        turn(&s, 5);
        turn_wanted(&s, 5);
        expect(&s);
    }
    assert_true(foreseen() - before >= CALLS * 60 / 2);
}

/* A loop with interruptions: reads, unfinished turns, another constant, another VP set, and a
 * temporary field. */
static void what_comes_between_is_seen(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    CM_vp_set_id_t here = CM_current_vp_set;
    unsigned int line[1] = {WIDE};
    CM_vp_set_id_t other = CM_allocate_vp_set(CM_create_geometry(line, 1));
    CM_field_id_t count = CM_allocate_heap_field_vp_set(16, other);
    int counted = 0;
    for (int i = 0; i < 400; i++) {
        uint32_t add = i % 97 == 96 ? 11 : 3;
        turn(&s, add);
        turn_wanted(&s, add);
        if (i % 31 == 30)
            expect(&s);
        if (i % 7 == 3) {
            CM_set_vp_set(other);
            CM_u_add_constant_2_1L(count, 1, 16);
            CM_set_vp_set(here);
            counted++;
        }
        if (i % 53 == 52) {
            CM_get_from_news_1L(s.flow, s.cell, 0, CM_downward, 32); /* as a turn begins */
            expect(&s);
        }
        if (i % 71 == 70) {
            CM_field_id_t gone = CM_allocate_stack_field(32);
            CM_u_move_1L(gone, s.cell, 32);
            CM_deallocate_stack_through(gone);
        }
    }
    expect(&s);
    CM_set_vp_set(other);
    assert_int_equal(CM_u_read_from_processor_1L(0, count, 16), counted);
}

/* Instructions that are no rows of a table are foreseen as well. */
static void bits_and_lights_are_not_recorded_again(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    CM_field_id_t bit = CM_allocate_heap_field(1);
    uint64_t before = 0;
    for (int i = 0; i < 60; i++) {
        if (i == 20)
            before = foreseen();
        turn(&s, 5);
        turn_wanted(&s, 5);
        CM_u_move_1L(bit, s.cell, 1);
        CM_invert_bit(bit);
        CM_latch_leds(bit);
        unsigned int even = 0;
        for (int k = 0; k < CELLS; k++)
            even += s.wanted[k] % 2 == 0;
        assert_int_equal(CM_global_count_bit(bit), even);
    }
    expect(&s);
    assert_int_equal(foreseen() - before, 40 * (CALLS + 3));
}

/* A constant that changes in each turn builds no new kernels. */
static void a_constant_that_changes_builds_nothing(void **state)
{
    (void)state;
    struct sheet s;
    struct machine_stats before, after;
    start(&s);
    for (uint32_t i = 0; i < 60; i++) {
        turn(&s, i);
        turn_wanted(&s, i);
        if (i == 30)
            machine_stats_get(paris_machine(), &before);
        expect(&s);
    }
    machine_stats_get(paris_machine(), &after);
    assert_int_equal(after.kernels_built, before.kernels_built);
}

/* One kernel runs three turns in strips of 32 columns; any number of turns is right. */
static void many_turns_are_one_kernel(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    for (int i = 0; i < 60; i++) {
        turn(&s, 7);
        turn_wanted(&s, 7);
    }
    expect(&s);
    uint64_t before = kernels_run();
    for (int i = 0; i < 90; i++) {
        turn(&s, 7);
        turn_wanted(&s, 7);
    }
    expect(&s);
    assert_true(kernels_run() - before <= 90 / 2);
    for (int some = 1; some < 12; some++) {
        for (int i = 0; i < some; i++) {
            turn(&s, 7);
            turn_wanted(&s, 7);
        }
        expect(&s);
    }
}

/* A program that reads after every twentieth turn gets two kernels of ten turns, not two of
 * eight and four of one. The strips are whole rows, whose rings are tori. */
static void none_is_left_over(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    uint64_t before = 0;
    for (int look = 0; look < 30; look++) {
        before = kernels_run();
        for (int i = 0; i < 20; i++) {
            turn(&s, 7);
            turn_wanted(&s, 7);
        }
        expect(&s);
    }
    assert_int_equal(kernels_run() - before, 2);
}

/* A turn without coordinates: all cells are computed alike, so the plan has no boxes. */
static void turn_alike(struct sheet *s)
{
    CM_get_from_news_1L(s->neighbour, s->cell, 0, CM_downward, 32);
    CM_u_add_2_1L(s->cell, s->neighbour, 32);
    CM_get_from_news_1L(s->neighbour, s->cell, 1, CM_downward, 32);
    CM_u_add_2_1L(s->cell, s->neighbour, 32);
}

static void turn_alike_wanted(struct sheet *s)
{
    static uint32_t old[CELLS];
    for (int axis = 0; axis < 2; axis++) {
        memcpy(old, s->wanted, sizeof old);
        for (int y = 0; y < HIGH; y++)
            for (int x = 0; x < WIDE; x++)
                s->wanted[y * WIDE + x] += axis ? old[y * WIDE + (x + WIDE - 1) % WIDE]
                                                : old[(y + HIGH - 1) % HIGH * WIDE + x];
    }
}

/* The loop's first kernels are already optimised as far as kernels in rows can be; many turns
 * become one kernel even so. */
static void a_loop_without_boxes_is_many_turns_at_once(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    uint64_t before = 0;
    for (int i = 0; i < 160; i++) {
        if (i == 80)
            before = kernels_run();
        turn_alike(&s);
        turn_alike_wanted(&s);
    }
    expect(&s);
    assert_true(kernels_run() - before <= 80 / 2);
}

static uint64_t in_place(void)
{
    struct machine_stats now;
    machine_stats_get(paris_machine(), &now);
    return now.kernels_in_place;
}

/* Strips of whole rows, one below the other, overwrite the array that they read, but not while
 * another field needs the old values. */
static void what_nobody_wants_is_written_over(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    uint64_t before = in_place();
    for (int i = 0; i < 150; i++) {
        turn(&s, 7);
        turn_wanted(&s, 7);
        if (i % 13 < 3)
            expect(&s);
    }
    expect(&s);
    assert_true(in_place() - before >= 20);
    CM_field_id_t kept = CM_allocate_heap_field(32);
    static uint32_t wanted[CELLS], got[CELLS];
    for (int i = 0; i < 60; i++) {
        CM_u_move_1L(kept, s.cell, 32);
        memcpy(wanted, s.wanted, sizeof wanted);
        turn(&s, 9);
        turn_wanted(&s, 9);
        if (i % 5 == 0) {
            machine_begin(paris_machine());
            assert_int_equal(
                machine_field_download(paris_machine(), kept, MACHINE_UINT(32), got), 0);
            assert_memory_equal(got, wanted, sizeof got);
            expect(&s);
        }
    }
    expect(&s);
}

/* ---- where turns begin ---- */

enum { SHORT_CALLS = 5 };

/* A turn whose temporaries are written before they are read. */
static void short_turn(struct sheet *s)
{
    CM_get_from_news_1L(s->flow, s->cell, 0, CM_downward, 32);
    CM_u_add_constant_2_1L(s->flow, 3, 32);
    CM_get_from_news_1L(s->neighbour, s->cell, 1, CM_downward, 32);
    CM_u_subtract_2_1L(s->neighbour, s->flow, 32);
    CM_u_add_2_1L(s->cell, s->neighbour, 32);
}

static void short_turn_wanted(struct sheet *s)
{
    static uint32_t old[CELLS];
    memcpy(old, s->wanted, sizeof old);
    for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDE; x++)
            s->wanted[y * WIDE + x] += old[y * WIDE + (x + WIDE - 1) % WIDE] -
                                       (old[(y + HIGH - 1) % HIGH * WIDE + x] + 3);
}

/* Evaluations end with the loop's turns, whatever was called before the loop. So they store the
 * sheet and no temporaries. */
static void only_the_sheet_is_stored(void **state)
{
    (void)state;
    for (int before = 0; before < SHORT_CALLS; before++) {
        struct machine_config config = machine_config_default();
        config.explain = 1;
        assert_true(paris_reset(&config));
        struct sheet s;
        start(&s);
        for (int i = 0; i < before; i++)
            CM_set_context();
        for (int i = 0; i < 200; i++) {
            short_turn(&s);
            short_turn_wanted(&s);
        }
        expect(&s);
        const struct machine_explained *x = machine_explain(paris_machine(), false);
        assert_non_null(x);
        uint64_t runs = 0, alone = 0;
        for (int i = 0; i < x->kernels_count; i++) {
            runs += x->kernels[i].generated ? x->kernels[i].runs : 0;
            alone += x->kernels[i].arrays_written == 1 ? x->kernels[i].runs : 0;
        }
        assert_true(runs >= 200 / 4);
        if (alone < runs * 9 / 10)
            fail_msg("after %d calls: %d of %d runs store the sheet alone", before, (int)alone,
                     (int)runs);
    }
}

/* The program reads in the middle of each twentieth turn. Evaluations then end there, so that
 * one or two kernels run twenty turns. */
static void turns_end_where_somebody_looks(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    for (int i = 0; i < 60; i++) {
        short_turn(&s);
        short_turn_wanted(&s);
    }
    uint64_t before = 0;
    for (int i = 0; i < 600; i++) {
        CM_get_from_news_1L(s.flow, s.cell, 0, CM_downward, 32);
        CM_u_add_constant_2_1L(s.flow, 3, 32);
        if (i % 20 == 0) {
            expect(&s);
            before = i == 560 ? kernels_run() : before;
        }
        CM_get_from_news_1L(s.neighbour, s.cell, 1, CM_downward, 32);
        CM_u_subtract_2_1L(s.neighbour, s.flow, 32);
        CM_u_add_2_1L(s.cell, s.neighbour, 32);
        short_turn_wanted(&s);
        if (i == 580)
            break;
    }
    assert_in_range(kernels_run() - before, 1, 2);
    expect(&s);
}

/* A program that reads after each turn, and later after every twentieth: then many turns are a
 * kernel, each time. */
static void looks_become_fewer(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    for (int time = 0; time < 3; time++) {
        uint64_t before = 0;
        for (int i = 0; i < 240; i++) {
            before = i == 220 ? kernels_run() : before;
            short_turn(&s);
            short_turn_wanted(&s);
            if (i < 40 || i % 20 == 19)
                expect(&s);
        }
        assert_in_range(kernels_run() - before, 1, 12);
    }
}

/* A turn of two sheets: each adds the other's cells and their neighbours. `looks` reads in the
 * middle of the turn. */
static void coupled_turn(struct sheet s[2], bool looks)
{
    for (int k = 0; k < 2; k++) {
        CM_u_move_1L(s[k].flow, s[k].cell, 32);
        for (unsigned int axis = 0; axis < 2; axis++)
            for (int way = 0; way < 2; way++) {
                CM_get_from_news_1L(s[0].neighbour, s[k].cell, axis,
                                    way ? CM_upward : CM_downward, 32);
                CM_u_add_2_1L(s[k].flow, s[0].neighbour, 32);
                if (looks && k == 1 && axis == 1 && way == 0)
                    CM_u_read_from_processor_1L(0, s[0].flow, 32);
            }
    }
    CM_u_add_2_1L(s[0].cell, s[1].flow, 32);
    CM_u_add_2_1L(s[1].cell, s[0].flow, 32);
}

static void coupled_turn_wanted(struct sheet s[2])
{
    static uint32_t flow[2][CELLS];
    for (int k = 0; k < 2; k++)
        for (int y = 0; y < HIGH; y++)
            for (int x = 0; x < WIDE; x++) {
                const uint32_t *old = s[k].wanted;
                flow[k][y * WIDE + x] =
                    old[y * WIDE + x] + old[(y + HIGH - 1) % HIGH * WIDE + x] +
                    old[(y + 1) % HIGH * WIDE + x] + old[y * WIDE + (x + WIDE - 1) % WIDE] +
                    old[y * WIDE + (x + 1) % WIDE];
            }
    for (int i = 0; i < CELLS; i++) {
        s[0].wanted[i] += flow[1][i];
        s[1].wanted[i] += flow[0][i];
    }
}

/* Sixteen turns in one kernel would need more columns than there are; eight do not. */
static void as_many_turns_as_can_be_are_one_kernel(void **state)
{
    (void)state;
    struct sheet s[2];
    start(&s[0]);
    begin_sheet(&s[1]);
    uint64_t before = 0;
    for (int i = 0; i < 320; i++) {
        if (i == 160)
            before = kernels_run();
        coupled_turn(s, i == 3);
        coupled_turn_wanted(s);
    }
    const uint64_t of_turns = kernels_run() - before; /* each look at a sheet takes one more */
    for (int k = 0; k < 2; k++)
        expect(&s[k]);
    assert_true(of_turns <= 160 / 4);
}

static struct device_buffer *buffer_of(CM_field_id_t id)
{
    const struct machine *m = paris_machine();
    for (int i = 0; i < m->memory->fields_count; i++)
        if (m->memory->fields[i]->base == id)
            return m->memory->fields[i]->slots[0].value->buffer;
    return NULL;
}

/* Temporaries that are not computed need the sheet of the turn before, but no older one. So two
 * arrays suffice. */
static void two_arrays_take_turns(void **state)
{
    (void)state;
    struct sheet s;
    static uint32_t before[CELLS], wanted[CELLS], got[CELLS];
    struct device_buffer *last[2] = {NULL, NULL};
    start(&s);
    for (int i = 0; i < 40; i++) {
        short_turn(&s);
        memcpy(before, s.wanted, sizeof before);
        short_turn_wanted(&s);
        assert_int_equal(machine_flush(paris_machine()), 0);
        struct device_buffer *now = buffer_of(s.cell);
        assert_non_null(now);
        if (i >= 20)
            assert_ptr_equal(now, last[i % 2]);
        last[i % 2] = now;
    }
    assert_ptr_not_equal(last[0], last[1]);
    expect(&s);
    for (int y = 0; y < HIGH; y++)
        for (int x = 0; x < WIDE; x++)
            wanted[y * WIDE + x] = before[(y + HIGH - 1) % HIGH * WIDE + x] + 3;
    machine_begin(paris_machine());
    assert_int_equal(machine_field_download(paris_machine(), s.flow, MACHINE_UINT(32), got), 0);
    assert_memory_equal(got, wanted, sizeof got);
}

/* Without strips, two turns at once would need two kernels and a third array. */
static void turns_that_save_nothing_are_evaluated_one_by_one(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    struct machine_stats before, after;
    for (int i = 0; i < 200; i++) {
        if (i == 100)
            machine_stats_get(paris_machine(), &before);
        short_turn(&s);
        short_turn_wanted(&s);
    }
    machine_stats_get(paris_machine(), &after);
    assert_in_range(after.flushes - before.flushes, 98, 102);
    assert_in_range(after.kernels_run - before.kernels_run, 98, 102);
    expect(&s);
}

/* When the loop comes again, its turns are evaluated one by one at once. */
static void so_they_are_when_they_come_again(void **state)
{
    (void)state;
    struct sheet s;
    start(&s);
    CM_field_id_t drawn = CM_allocate_heap_field(32);
    uint64_t before = 0;
    for (int i = 0; i < 20; i++) {
        if (i == 10)
            before = foreseen();
        for (int k = 0; k < 60; k++) {
            short_turn(&s);
            short_turn_wanted(&s);
        }
        CM_u_multiply_constant_3_1L(drawn, s.cell, 5, 32);
        CM_u_add_constant_2_1L(drawn, 1, 32);
        assert_int_equal(CM_u_read_from_processor_1L(3, drawn, 32), s.wanted[3] * 5 + 1);
    }
    expect(&s);
    assert_true(foreseen() - before >= (60 * SHORT_CALLS + 2) * 10 * 9 / 10);
}

/* ---- each case has a machine of its own, and only these variables are set for it ---- */

struct forced {
    const char *strips, *columns, *turns, *in_place, *box_after, *optimise_after, *flush_after;
};

static const struct forced usual,
    three_turns = {.strips = "1",
                   .columns = "32",
                   .turns = "3",
                   .box_after = "0",
                   .optimise_after = "0",
                   .flush_after = "48"},
    whole_rows = {.strips = "1",
                  .turns = "3",
                  .in_place = "1",
                  .box_after = "0",
                  .optimise_after = "0",
                  .flush_after = "48"},
    strips = {.strips = "1", .box_after = "0", .optimise_after = "0", .flush_after = "48"},
    better_after_a_while = {.box_after = "50000", /* cells: eight turns */
                            .optimise_after = "0",
                            .flush_after = "8"},
    one_turn = {.turns = "1", .box_after = "0", .optimise_after = "0", .flush_after = "8"},
    one_turn_in_rows = {.strips = "0", .turns = "1", .box_after = "0", .optimise_after = "0"},
    eight_turns = {.strips = "1",
                   .columns = "32",
                   .turns = "8", /* twice two of the program's */
                   .box_after = "0",
                   .optimise_after = "0",
                   .flush_after = "240"};

static void force(const char *variable, const char *value)
{
    if (value)
        setenv(variable, value, 1);
    else
        unsetenv(variable);
}

static int begin(void **state)
{
    const struct forced *f = *state;
    force("LUTETIA_STRIPS", f->strips);
    force("LUTETIA_COLUMNS", f->columns);
    force("LUTETIA_TURNS", f->turns);
    force("LUTETIA_IN_PLACE", f->in_place);
    force("LUTETIA_BOX_AFTER", f->box_after);
    force("LUTETIA_OPTIMISE_AFTER", f->optimise_after);
    force("LUTETIA_FLUSH_AFTER", f->flush_after);
    return paris_reset(NULL) ? 0 : -1;
}

#define CASE(function, forced)                                                                 \
    cmocka_unit_test_prestate_setup_teardown(function, begin, NULL,                            \
                                             (void *)(uintptr_t) & (forced))

/* "shuffled N": in the order that follows from the number. */
static void shuffle(struct CMUnitTest *tests, size_t count, uint32_t seed)
{
    for (size_t i = count; i > 1; i--) {
        seed = seed * 1664525 + 1013904223;
        const size_t k = (size_t)(seed >> 8) % i;
        const struct CMUnitTest other = tests[i - 1];
        tests[i - 1] = tests[k];
        tests[k] = other;
    }
}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[] = {
        CASE(a_loop_is_not_recorded_again, usual),
        CASE(a_loop_that_is_looked_at_is_not_either, usual),
        CASE(what_comes_between_is_seen, usual),
        CASE(a_constant_that_changes_builds_nothing, usual),
        CASE(bits_and_lights_are_not_recorded_again, usual),
        CASE(many_turns_are_one_kernel, three_turns),
        CASE(what_comes_between_is_seen, three_turns),
        CASE(a_loop_that_is_looked_at_is_not_either, three_turns),
        CASE(what_nobody_wants_is_written_over, whole_rows),
        CASE(what_comes_between_is_seen, whole_rows),
        CASE(none_is_left_over, strips),
        CASE(turns_end_where_somebody_looks, strips),
        CASE(what_comes_between_is_seen, strips),
        CASE(a_loop_without_boxes_is_many_turns_at_once, better_after_a_while),
        CASE(only_the_sheet_is_stored, one_turn),
        CASE(two_arrays_take_turns, one_turn_in_rows),
        CASE(turns_that_save_nothing_are_evaluated_one_by_one, one_turn_in_rows),
        CASE(so_they_are_when_they_come_again, one_turn_in_rows),
        CASE(as_many_turns_as_can_be_are_one_kernel, eight_turns),
        CASE(looks_become_fewer, strips),
    };
    if (argc > 2 && !strcmp(argv[1], "shuffled"))
        shuffle(tests, sizeof tests / sizeof tests[0], (uint32_t)strtoul(argv[2], NULL, 10));
    return cmocka_run_group_tests(tests, NULL, NULL);
}
