/* test_windows.c - a guard's window has every lane where its condition holds, and a step for a
 * window gives these lanes what it gives them as a whole, and no other lane anything. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "interpret/windows.h"
#include "tables.h"

enum { LANES = 500, LEAST = 16, ROOM = 16 * (LANES + 16) };

static uint32_t chance = 1;

static uint32_t below(uint32_t n)
{
    chance = chance * 1664525u + 1013904223u;
    return (chance >> 8) % n;
}

/* ---- where ---- */

static void bits_make(uint8_t *bits, int lanes)
{
    const int kind = (int)below(5), from = (int)below((uint32_t)lanes),
              end = from + (int)below((uint32_t)(lanes - from) + 1), every = 1 + (int)below(40);
    memset(bits, kind == 1, (size_t)lanes);
    for (int i = from; i < end && kind > 1; i++)
        bits[i] = kind < 4 || i % every == 0;
}

static bool holds(const struct guard *g, void *const *at, int lane)
{
    bool any = false;
    for (int i = 0; i < 2; i++) {
        const struct guard_choice *c = &g->choices[i];
        bool all = true;
        for (int k = 0; k < c->count; k++)
            all = all && ((const uint8_t *)at[c->bits[k]])[c->one[k] ? 0 : lane];
        any = any || all;
    }
    return any;
}

static void a_window_has_each_lane_where_the_condition_holds(void **state)
{
    static uint8_t bits[4][LANES];
    void *at[4];
    int empty = 0, part = 0;
    (void)state;
    for (int i = 0; i < 4; i++)
        at[i] = bits[i];
    for (int turn = 0; turn < 20000; turn++) {
        const int lanes = turn % 3 ? LANES : 1 + (int)below(LANES);
        struct guard g;
        for (int i = 0; i < 4; i++)
            bits_make(bits[i], lanes);
        for (int i = 0; i < 2; i++)
            g.choices[i] =
                (struct guard_choice){.bits = {(uint16_t)below(4), (uint16_t)below(4)},
                                      .one = {below(6) == 0, below(6) == 0},
                                      .count = (uint8_t)(1 + below(2))};
        if (below(2))
            g.choices[1] = g.choices[0];
        const struct window w = window_of(&g, at, lanes);
        bool any = false;
        assert_in_range(w.from, 0, w.end);
        assert_in_range(w.end, 0, lanes);
        assert_true(w.from % LEAST == 0 && (w.end % LEAST == 0 || w.end == lanes));
        for (int lane = 0; lane < lanes; lane++) {
            const bool here = holds(&g, at, lane);
            any = any || here;
            assert_true(!here || (w.from <= lane && lane < w.end));
        }
        empty += w.from == w.end;
        part += w.from < w.end && w.end - w.from < lanes;
        if (memcmp(&g.choices[0], &g.choices[1], sizeof g.choices[0]) == 0 &&
            g.choices[0].count == 1)
            assert_true(any || w.from == w.end);
    }
    assert_true(empty > 1000 && part > 1000);
}

/* ---- steps ---- */

struct lanes_case {
    int op;
    enum lanes_class from, to;
    bool converts;
};
static const struct lanes_case cases[] = {
    {MACHINE_ADD, LANES_U8, LANES_U8, false},
    {MACHINE_ADD, LANES_U128, LANES_U128, false},
    {MACHINE_MUL, LANES_U32, LANES_U32, false},
    {MACHINE_XOR, LANES_U64, LANES_U64, false},
    {MACHINE_SMAX, LANES_U16, LANES_U16, false},
    {MACHINE_ULT, LANES_U32, LANES_U8, false},
    {MACHINE_EQ, LANES_U64, LANES_U8, false},
    {MACHINE_NOT, LANES_U32, LANES_U32, false},
    {MACHINE_FADD, LANES_F32, LANES_F32, false},
    {MACHINE_FDIV, LANES_F64, LANES_F64, false},
    {MACHINE_FLT, LANES_F32, LANES_U8, false},
    {MACHINE_FEXP, LANES_F64, LANES_F64, false}, /* lane by lane */
    {NODE_SELECT, LANES_U64, LANES_U64, false},
    {NODE_SELECT, LANES_U8, LANES_U8, false},
    {NODE_ZERO_EXTEND, LANES_U8, LANES_U32, true},
    {NODE_ZERO_EXTEND, LANES_U64, LANES_U8, true},
    {NODE_U_TO_F, LANES_U32, LANES_F64, true},
    {LANES_COPY, LANES_U64, LANES_U64, false},
};

static struct machine_type type_of(enum lanes_class c)
{
    return c == LANES_F32   ? MACHINE_F32
           : c == LANES_F64 ? MACHINE_F64
                            : MACHINE_UINT(8 * (int)lanes_bytes(c));
}

/* Floats have no NaNs: which of two a sum passes on is not told. */
static void lanes_fill(void *to, enum lanes_class c)
{
    for (size_t i = 0; i < ROOM / lanes_bytes(c); i++)
        if (c == LANES_F32)
            ((float *)to)[i] = (float)below(1000) / 7;
        else if (c == LANES_F64)
            ((double *)to)[i] = (double)below(1000) / 7;
        else
            for (size_t k = 0; k < lanes_bytes(c); k++)
                ((unsigned char *)to)[i * lanes_bytes(c) + k] = (unsigned char)below(256);
}

static void step_compare(const struct byte_code *p, const struct lanes_step *s, void **at,
                         const void *image)
{
    static _Alignas(64) unsigned char whole[ROOM], part[ROOM];
    const size_t bytes = p->places[s->to].bytes;
    int ends[2] = {(int)below(LANES), (int)below(LANES + 1)};
    struct window w = {ends[0] / LEAST * LEAST, ends[1]};
    if (w.end <= w.from)
        w.end = LANES;
    memcpy(whole, image, ROOM);
    memcpy(part, image, ROOM);
    at[s->to] = whole;
    s->run(s, at, LANES);
    at[s->to] = part;
    window_step(p, s, at, w, LANES);
    for (size_t i = 0; i < ROOM / bytes; i++) {
        const bool inside = i >= (size_t)w.from && i < (size_t)w.end;
        assert_memory_equal(part + i * bytes,
                            (inside ? whole : (const unsigned char *)image) + i * bytes, bytes);
    }
}

static void a_step_for_a_window_gives_its_lanes_alone(void **state)
{
    static _Alignas(64) unsigned char in[3][ROOM], image[ROOM];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int turn = 0; turn < 40; turn++) {
            const struct lanes_case *c = &cases[i];
            const bool selects = c->op == NODE_SELECT;
            struct place places[4] = {
                {.bytes = (uint8_t)lanes_bytes(selects ? LANES_U8 : c->from)},
                {.bytes = (uint8_t)lanes_bytes(c->from)},
                {.bytes = (uint8_t)lanes_bytes(c->from)},
                {.bytes = (uint8_t)lanes_bytes(c->to)}};
            const struct byte_code p = {.places = places, .places_count = 4};
            lanes_function *run = c->converts ? lanes_find_conversion(c->op, c->from, c->to)
                                              : lanes_find(c->op, c->from);
            const struct lanes_step s = {.run = run ? run : lane_each,
                                         .op = (uint16_t)c->op,
                                         .to = 3,
                                         .in = {0, 1, 2},
                                         .from = type_of(c->from),
                                         .type = c->to == LANES_U8 && c->from != LANES_U8 &&
                                                         !c->converts
                                                     ? MACHINE_BIT
                                                     : type_of(c->to),
                                         .mask = ~(lanes_wide)0};
            void *at[4] = {in[0], in[1], in[2], NULL};
            for (int k = 0; k < 3; k++)
                lanes_fill(in[k], c->from);
            for (int k = 0; k < ROOM && selects; k++)
                in[0][k] = (unsigned char)below(2);
            lanes_fill(image, LANES_U8);
            step_compare(&p, &s, at, image);
        }
}

/* A get: places for all lanes, or the first one's, from which on they go up by one; some are
 * beyond the array. */
static void a_get_for_a_window_takes_its_lanes_places(void **state)
{
    static _Alignas(64) unsigned char index[ROOM], array[ROOM], image[ROOM];
    static const enum lanes_class classes[] = {LANES_U8, LANES_U32, LANES_U64, LANES_U128};
    (void)state;
    lanes_fill(array, LANES_U8);
    for (int turn = 0; turn < 400; turn++) {
        const enum lanes_class c = classes[turn % 4];
        const uint8_t bytes = (uint8_t)lanes_bytes(c);
        uint32_t count = turn % 5 ? LANES : LANES / 2;
        struct place places[4] = {
            {.bytes = 4}, {.bytes = bytes}, {.bytes = 4}, {.bytes = bytes}};
        const struct byte_code p = {.places = places, .places_count = 4};
        const struct lanes_step s = {.run = lanes_find(LANES_FETCH, c),
                                     .op = LANES_FETCH,
                                     .to = 3,
                                     .in = {0, 1, 2},
                                     .from = MACHINE_UINT(32),
                                     .type = type_of(c),
                                     .in_a_row = turn / 4 % 2,
                                     .mask = ~(lanes_wide)0};
        void *at[4] = {index, array, &count, NULL};
        for (int k = 0; k < LANES; k++)
            ((uint32_t *)index)[k] = below(LANES + 50);
        ((uint32_t *)index)[0] = below(100);
        lanes_fill(image, LANES_U8);
        step_compare(&p, &s, at, image);
    }
}

/* Its lanes are there up to the window's end: a later window may begin before this one. */
static void what_is_repeated_is_repeated_from_the_first_lane_on(void **state)
{
    uint32_t lanes[LANES];
    (void)state;
    for (uint32_t up = 0; up < 2; up++) {
        struct place place = {.bytes = 4};
        const struct byte_code p = {.places = &place, .places_count = 1};
        const struct lanes_step s = {.run = lanes_find(LANES_REPEAT, LANES_U32),
                                     .op = LANES_REPEAT,
                                     .detail = (int32_t)up};
        void *at[1] = {lanes};
        memset(lanes, 0x55, sizeof lanes);
        lanes[0] = 7;
        window_step(&p, &s, at, (struct window){64, 112}, LANES);
        for (uint32_t i = 0; i < LANES; i++)
            assert_int_equal(lanes[i], i < 112 ? 7 + up * i : 0x55555555);
    }
}

/* Of bits in parts of a block, all, none and every few, in each instruction set: no lane beyond
 * the last is written. */
static void a_selection_has_each_lane_from_the_right_side(void **state)
{
    static _Alignas(64) unsigned char in[2][ROOM], out[ROOM];
    static uint8_t bits[LANES];
    const struct tables t = tables_here();
    (void)state;
    lanes_fill(in[0], LANES_U8);
    lanes_fill(in[1], LANES_U8);
    for (int turn = 0; turn < 6000; turn++) {
        const enum lanes_class c = (enum lanes_class)(turn % LANES_INTEGERS);
        const int n = turn % 3 ? LANES : 1 + (int)below(LANES);
        const size_t bytes = lanes_bytes(c);
        const struct lanes_step s = {.op = NODE_SELECT, .to = 3, .in = {0, 1, 2}};
        void *at[] = {bits, in[0], in[1], out};
        bits_make(bits, n);
        memset(out, 0x5a, sizeof out);
        t.of[turn % t.count]->of[NODE_SELECT][c](&s, at, n);
        for (size_t i = 0; i < (size_t)n; i++)
            assert_memory_equal(out + i * bytes, in[bits[i] ? 0 : 1] + i * bytes, bytes);
        for (size_t i = (size_t)n * bytes; i < sizeof out; i++)
            assert_int_equal(out[i], 0x5a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_window_has_each_lane_where_the_condition_holds),
        cmocka_unit_test(a_step_for_a_window_gives_its_lanes_alone),
        cmocka_unit_test(a_get_for_a_window_takes_its_lanes_places),
        cmocka_unit_test(a_selection_has_each_lane_from_the_right_side),
        cmocka_unit_test(what_is_repeated_is_repeated_from_the_first_lane_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
