/* background_loops.h - loops whose kernels are worth optimising, for the tests of background
 * compilation. */
#ifndef LUTETIA_TESTS_BACKGROUND_LOOPS_H
#define LUTETIA_TESTS_BACKGROUND_LOOPS_H

#include <stdint.h>
#include <unistd.h>

#include "plans/plans.h"
#include "support.h"

struct sheet {
    struct machine *m;
    uint32_t a, b;
    const struct looped *loop;
    uint64_t variant; /* 0: the usual kernels; else its bits choose other operations */
};

struct looped {
    const char *what;
    struct machine_type type;
    int height, width;
    struct machine_value *(*next)(const struct sheet *s);
    bool looks; /* reads after every turn; else many can be evaluated at once */
    bool tiles; /* on scalar work-items */
};

static struct machine_value *of(const struct sheet *s, uint32_t field)
{
    return machine_field_value(s->m, field, s->loop->type, MACHINE_EVERYWHERE);
}

static struct machine_value *beside(const struct sheet *s, int axis, int distance)
{
    return machine_shift(s->m, of(s, s->a), axis, distance);
}

/* Selects the value inside a box; the rim keeps its old value. */
static struct machine_value *inside(const struct sheet *s, struct machine_value *value)
{
    struct machine *m = s->m;
    struct machine_value *box = NULL;
    for (int axis = 0; axis < 2; axis++) {
        int length = axis ? s->loop->width : s->loop->height;
        struct machine_value *x = machine_coordinate(m, axis, 16),
                             *first = machine_constant(m, MACHINE_UINT(16),
                                                       (struct machine_scalar){2, 0}),
                             *end = machine_constant(
                                 m, MACHINE_UINT(16),
                                 (struct machine_scalar){(uint64_t)length - 3, 0}),
                             *both = machine_binary(m, MACHINE_AND,
                                                    machine_binary(m, MACHINE_ULE, first, x),
                                                    machine_binary(m, MACHINE_ULT, x, end));
        box = box ? machine_binary(m, MACHINE_AND, box, both) : both;
    }
    return machine_select(m, box, value, of(s, s->a));
}

static struct machine_value *flow(const struct sheet *s)
{
    struct machine *m = s->m;
    struct machine_value *sum = beside(s, 0, 1);
    sum = machine_binary(m, MACHINE_FADD, sum, beside(s, 0, -1));
    sum = machine_binary(m, MACHINE_FADD, sum, beside(s, 1, 1));
    sum = machine_binary(m, MACHINE_FADD, sum, beside(s, 1, -1));
    sum = machine_binary(m, MACHINE_FMUL, sum, machine_constant_float(m, MACHINE_F32, 0.24));
    return inside(s, machine_binary(m, MACHINE_FADD, sum, of(s, s->b)));
}

static struct machine_value *bytes(const struct sheet *s)
{
    struct machine *m = s->m;
    struct machine_value *x = machine_binary(m, MACHINE_ADD, beside(s, 1, -1), of(s, s->b));
    for (uint64_t ops = s->variant; ops > 1; ops >>= 1)
        x = machine_binary(m, ops & 1 ? MACHINE_ADD : MACHINE_XOR, x, of(s, s->b));
    return inside(s, machine_binary(m, MACHINE_XOR, x, beside(s, 0, 1)));
}

static struct machine_value *words(const struct sheet *s)
{
    struct machine *m = s->m;
    struct machine_value *x = machine_binary(m, MACHINE_MUL, beside(s, 1, 1), of(s, s->b));
    return inside(s, machine_binary(m, MACHINE_ADD, x, beside(s, 0, -1)));
}

static const struct looped loops[] = {
    {"flow of floats", {MACHINE_FLOAT, 32, 0, 0}, 60, 100, flow, true, false},
    {"words, many turns at once", {MACHINE_BITS, 32, 0, 0}, 96, 64, words, false, false},
    {"words, many turns in tiles", {MACHINE_BITS, 32, 0, 0}, 50, 40, words, false, true},
};
/* Loops whose kernels depend on the variant. */
static const struct looped new_loop = {"bytes", {MACHINE_BITS, 8, 0, 0}, 48, 130, bytes, true,
                                       false};

static void turn(const struct machine_call *call)
{
    const struct sheet *s = (const struct sheet *)(uintptr_t)call->words[0];
    struct machine_call known = {
        .again = turn, .name = "turn", .words_count = 1, .words = {call->words[0]}};
    if (machine_call_foreseen(s->m, &known))
        return;
    machine_begin(s->m);
    struct machine_value *next = s->loop->next(s);
    if (next && machine_field_store(s->m, s->a, next, MACHINE_EVERYWHERE) == MACHINE_OK)
        machine_call_performed(s->m);
    else
        machine_call_failed(s->m);
}

static void turns(const struct sheet *s, int count)
{
    const struct machine_call call = {.words = {(uintptr_t)s}};
    for (int i = 0; i < count; i++) {
        turn(&call);
        if (s->loop->looks)
            assert_ok(machine_flush(s->m), s->m);
    }
}

/* Waits until the background has compiled all kernels. */
static void wait_for(const struct sheet *s)
{
    for (int i = 0; s->m->plans->improving || choice_is_awaited(s->m); i++) {
        assert_true(i < 60000);
        usleep(1000);
        plans_see_to(s->m);
    }
}

#endif
