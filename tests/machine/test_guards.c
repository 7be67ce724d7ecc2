/* test_guards.c - byte code with guards gives what it gives without: random steps over
 * registers that are used again and again, bits that are joined, and selections within
 * selections, over arrays in which bits hold in parts of rows. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "device/device.h"
#include "interpret/blocks.h"

enum {
    ROWS = 5,
    WIDTH = 700,
    COUNT = ROWS * WIDTH,
    ARRAYS = 4, /* of numbers; and as many of bits */
    REGISTERS = 4,
    TEMPORARY = 2, /* of numbers, those from there on are of chains alone */
    STEPS = 30,
    NUMBERS_IN = 0,
    BITS_IN = ARRAYS,
    NUMBERS = 2 * ARRAYS, /* registers */
    BITS = NUMBERS + REGISTERS,
    OUT = BITS + REGISTERS,       /* of numbers, then of bits */
    STORED = OUT + 2 * REGISTERS, /* a bit that a step stores, and a later one selects by */
    PLACES = STORED + 1,
    MOST = STEPS + 4 * REGISTERS + 17 /* of one chain */
};

static uint32_t chance = 1;

static int below(int n)
{
    chance = chance * 1664525u + 1013904223u;
    return (int)((chance >> 8) % (uint32_t)n);
}

static bool is_number(int place)
{
    return place < BITS_IN || (place >= NUMBERS && place < BITS) ||
           (place >= OUT && place < OUT + REGISTERS);
}

/* ---- arrays ---- */

static uint32_t numbers[PLACES][COUNT + 16];
static uint8_t bits[PLACES][COUNT + 16];
static struct device_buffer buffers[PLACES];
static struct device_buffer *of[PLACES];

static void arrays_make(void)
{
    for (int k = 0; k < PLACES; k++) {
        buffers[k] =
            (struct device_buffer){.host = is_number(k) ? (void *)numbers[k] : bits[k]};
        of[k] = &buffers[k];
    }
    for (int i = 0; i < COUNT; i++) {
        numbers[0][i] = (uint32_t)(i % WIDTH);
        numbers[1][i] = (uint32_t)(i / WIDTH);
        numbers[2][i] = 300;
        numbers[3][i] = (uint32_t)below(1 << 20);
        bits[BITS_IN][i] = i % WIDTH >= 130 && i % WIDTH < 177;
        bits[BITS_IN + 1][i] = i / WIDTH != 2;
        bits[BITS_IN + 2][i] = (uint8_t)(i % 7 == 3 && i % WIDTH < 650);
        bits[BITS_IN + 3][i] = i % WIDTH > 600;
    }
}

/* ---- programs ---- */

static int any(bool number)
{
    const bool array = below(3) == 0;
    return number ? (array ? below(ARRAYS) : NUMBERS + below(TEMPORARY))
                  : (array ? BITS_IN + below(ARRAYS) : BITS + below(REGISTERS));
}

static struct lanes_step step(int op, enum lanes_class c, int to, int a, int b, int third)
{
    const struct machine_type type = c == LANES_U8 ? MACHINE_BIT : MACHINE_UINT(32);
    return (struct lanes_step){.run = lanes_find(op, c),
                               .op = (uint16_t)op,
                               .to = (uint16_t)to,
                               .in = {(uint16_t)a, (uint16_t)b, (uint16_t)third},
                               .from = op == NODE_SELECT ? MACHINE_BIT : type,
                               .type = to >= BITS && to < OUT ? MACHINE_BIT : type,
                               .mask = to >= BITS && to < OUT ? 1 : ~(lanes_wide)0};
}

/* Its result is in no place of its operands. */
static struct lanes_step any_step(void)
{
    static const int sums[] = {MACHINE_ADD, MACHINE_XOR, MACHINE_MUL, MACHINE_UMIN};
    for (;;) {
        const int kind = below(8);
        struct lanes_step s = kind < 1   ? step(below(2) ? MACHINE_ULT : MACHINE_EQ, LANES_U32,
                                              BITS + below(REGISTERS), any(true), any(true), 0)
                              : kind < 3 ? step(MACHINE_AND, LANES_U8, BITS + below(REGISTERS),
                                                any(false), any(false), 0)
                              : kind < 6
                                  ? step(sums[below(4)], LANES_U32, NUMBERS + below(REGISTERS),
                                         any(true), any(true), 0)
                                  : step(NODE_SELECT, LANES_U32, NUMBERS + below(REGISTERS),
                                         any(false), any(true), any(true));
        if (kind >= 3 && kind < 6 && below(2))
            s.from = MACHINE_F32; /* as dear */
        bool apart = true;
        for (int k = 0; k < lanes_inputs(s.op); k++)
            apart = apart && s.in[k] != s.to;
        if (apart)
            return s;
    }
}

static void step_put(struct byte_code *p, struct lanes_step s)
{
    p->steps[p->steps_count++] = s;
}

static void and_put(struct byte_code *p, int to, int a, int b)
{
    step_put(p, step(MACHINE_AND, LANES_U8, to, a, b, 0));
}

static bool is_stored(const struct byte_code *p)
{
    bool stored = false;
    for (int i = 0; i < p->steps_count; i++)
        stored = stored || p->steps[i].to == STORED;
    return stored;
}

/* Steps of which each takes what the one before it gives, in two registers in turn, and the
 * selection that takes the last; another may. In some the bit is an and, and that of the other
 * selection is the and of the same registers, one of which has changed. In one of a program it
 * is stored. */
static void chain_put(struct byte_code *p)
{
    const bool stores = !is_stored(p) && below(3) == 0, changes = !stores && below(3) == 0;
    const int first = below(REGISTERS);
    int bits_of[REGISTERS];
    for (int i = 0; i < REGISTERS; i++)
        bits_of[i] = BITS + (first + i) % REGISTERS;
    const int count = 1 + below(4),
              bit = stores    ? STORED
                    : changes ? bits_of[2]
                              : any(false),
              last = NUMBERS + TEMPORARY + (count - 1) % 2;
    if (changes)
        and_put(p, bit, bits_of[0], bits_of[1]);
    for (int i = 0; i < count; i++) {
        const int to = NUMBERS + TEMPORARY + i % 2, before = NUMBERS + TEMPORARY + (i + 1) % 2;
        struct lanes_step s = step(below(2) ? MACHINE_ADD : MACHINE_MUL, LANES_U32, to,
                                   i ? before : any(true), any(true), 0);
        s.from = below(2) ? MACHINE_F32 : s.from; /* as dear */
        step_put(p, s);
        if (below(6) == 0)
            step_put(p, any_step());
    }
    if (stores)
        and_put(p, STORED, bits_of[0], BITS_IN + below(ARRAYS));
    step_put(p, step(NODE_SELECT, LANES_U32, NUMBERS, bit, last, NUMBERS + 1));
    if (changes) {
        and_put(p, bits_of[0], BITS_IN + below(ARRAYS), BITS_IN + below(ARRAYS));
        and_put(p, bits_of[3], bits_of[0], bits_of[1]);
        step_put(p, step(NODE_SELECT, LANES_U32, NUMBERS + 1, bits_of[3], last, NUMBERS));
    } else if (below(3) == 0) {
        step_put(p, step(NODE_SELECT, LANES_U32, NUMBERS + 1, below(2) ? bit : any(false), last,
                         NUMBERS));
    }
}

static void program_make(struct byte_code *p)
{
    *p = (struct byte_code){.places = calloc(PLACES, sizeof *p->places),
                            .places_count = PLACES,
                            .steps = calloc(MOST, sizeof *p->steps),
                            .steps_capacity = MOST};
    assert_true(p->places && p->steps);
    for (int k = 0; k < PLACES; k++) {
        const enum lanes_class c = is_number(k) ? LANES_U32 : LANES_U8;
        const bool array = k < NUMBERS || k >= OUT;
        p->places[k] = (struct place){.kind = array ? PLACE_ARRAY : PLACE_REGISTER,
                                      .bytes = (uint8_t)lanes_bytes(c),
                                      .node = k,
                                      .offset = array ? 0 : byte_code_room(p, c)};
    }
    for (int k = 0; k < 2 * REGISTERS; k++)
        step_put(p,
                 step(LANES_COPY, k < REGISTERS ? LANES_U32 : LANES_U8, NUMBERS + k, k, 0, 0));
    while (p->steps_count < 2 * REGISTERS + STEPS)
        if (below(2))
            chain_put(p);
        else
            step_put(p, any_step());
    for (int k = 0; k < 2 * REGISTERS; k++)
        if (k < TEMPORARY || k >= REGISTERS)
            step_put(p, step(LANES_COPY, k < REGISTERS ? LANES_U32 : LANES_U8, OUT + k,
                             NUMBERS + k, 0, 0));
}

static uint64_t program_run(const struct byte_code *p, struct blocks_room *room)
{
    static const struct vpset set = {.rank = 2,
                                     .dimensions = {ROWS, WIDTH},
                                     .count = COUNT,
                                     .rows = ROWS,
                                     .width = WIDTH,
                                     .pitch = WIDTH};
    uint64_t sum = 1;
    memset(bits[STORED], 0, sizeof bits[STORED]);
    assert_true(blocks_run(room, NULL, 1, p, &set, of, NULL));
    for (int k = OUT; k < PLACES; k++)
        for (int i = 0; i < COUNT; i++)
            sum = (sum ^ (is_number(k) ? numbers[k][i] : bits[k][i])) * 0x9e3779b97f4a7c15u;
    return sum;
}

static void guards_change_no_bit(void **state)
{
    struct blocks_room room = {0};
    int guards = 0, skipped = 0;
    (void)state;
    arrays_make();
    for (uint32_t turn = 0; turn < 2000; turn++) {
        struct byte_code p;
        chance = turn;
        program_make(&p);
        const uint64_t without = program_run(&p, &room);
        byte_code_guards(&p);
        assert_false(p.failed);
        guards += p.guards_count;
        skipped += p.guards_count > 0;
        if (program_run(&p, &room) != without)
            fail_msg("program %u differs with %d guards", turn, p.guards_count);
        free(p.places);
        free(p.steps);
        free(p.guards);
    }
    blocks_room_free(&room);
    assert_true(guards > 1000 && skipped > 500);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(guards_change_no_bit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
