/* start_calls.c - a program of random calls, each of which is timed. */
#include <stdint.h>

#include <cm/paris.h>

#include "harness.h"
#include "start_calls.h"

enum {
    SIDE = 64,
    FIELDS = 60,
    BITS = 32,
    PIECES = 14,
    LEAST = 250, /* calls of a piece */
    MOST = 5000,
    BODIES = 6,
    BODY_LEAST = 80, /* calls of a loop's body */
    BODY_MOST = 900,
    TURNS = 40
};

static CM_field_id_t fields[FIELDS], bit;

static unsigned int below(uint64_t *state, unsigned int limit)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (unsigned int)(*state >> 33) % limit;
}

static void call(uint64_t *state)
{
    const CM_field_id_t to = fields[below(state, FIELDS)], from = fields[below(state, FIELDS)];
    switch (below(state, 10)) {
    case 0:
        CM_u_add_2_1L(to, from, BITS);
        break;
    case 1:
        CM_u_subtract_2_1L(to, from, BITS);
        break;
    case 2:
        CM_u_multiply_2_1L(to, from, BITS);
        break;
    case 3:
        CM_logxor_2_1L(to, from, BITS);
        break;
    case 4:
        CM_s_max_2_1L(to, from, BITS);
        break;
    case 5:
        CM_u_min_2_1L(to, from, BITS);
        break;
    case 6:
        CM_get_from_news_1L(to, from, below(state, 2), CM_upward, BITS);
        break;
    case 7:
        CM_u_lt_1L(to, from, BITS);
        CM_store_test(bit);
        break;
    case 8:
        CM_load_context(bit);
        CM_u_move_1L(to, from, BITS);
        CM_set_context();
        break;
    default:
        CM_u_add_constant_2_1L(to, below(state, 1000), BITS);
    }
}

static double longest, began;

static void calls(uint64_t *state, unsigned int count)
{
    double before = bench_now_s();
    for (unsigned int i = 0; i <= count; i++) {
        if (i < count)
            call(state);
        else
            CM_u_read_from_processor_1L(SIDE, fields[below(state, FIELDS)], BITS);
        const double now = bench_now_s();
        longest = now - before > longest ? now - before : longest;
        before = now;
    }
}

bool start_calls_run(double *longest_s, double *all_s)
{
    static unsigned int sides[2] = {SIDE, SIDE};
    uint64_t state = 20;
    CM_init();
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sides, 2)));
    CM_set_context();
    bit = CM_allocate_heap_field(1);
    for (int i = 0; i < FIELDS; i++) {
        fields[i] = CM_allocate_heap_field(BITS);
        CM_my_news_coordinate_1L(fields[i], (unsigned int)i % 2, BITS);
        CM_u_multiply_constant_2_1L(fields[i], 2 * below(&state, 1u << 30) + 1, BITS);
    }
    CM_my_news_coordinate_1L(bit, 0, 1);
    calls(&state, LEAST);
    longest = 0;
    began = bench_now_s();
    for (int piece = 0; piece < PIECES; piece++)
        calls(&state, LEAST + below(&state, MOST - LEAST));
    for (int body = 0; body < BODIES; body++) {
        const unsigned int count = BODY_LEAST + below(&state, BODY_MOST - BODY_LEAST);
        const uint64_t first = state;
        for (int turn = 0; turn < TURNS; turn++) {
            state = first;
            calls(&state, count);
        }
    }
    *longest_s = longest;
    *all_s = bench_now_s() - began;
    return true;
}
