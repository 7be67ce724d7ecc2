/* test_creep.c - water and pigments that creep in paper without size, beside the same rule in
 * plain C, fiber after fiber: the same bits. */
#include <paper.h>
#include <sheet.h>

#include "sheet_calls.h"
#include "sheets.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 40, HEIGHT = 28, FIBERS = WIDTH * HEIGHT, PIGMENTS = 2, STEPS = 60 };
#define UNIT 1048576.0f

/* What the rule is applied to; amounts in grains. */
struct plain {
    float absorbency[FIBERS], capacity[FIBERS], water[FIBERS], infused[PIGMENTS][FIBERS];
    float room[FIBERS], saturated[FIBERS], left[FIBERS], threshold[FIBERS], inverse[FIBERS];
    float creep[2][FIBERS], out[2][FIBERS], in[2][FIBERS]; /* over the face above, x and y */
};

/* Of the stock, as the sheet has it. */
struct rule {
    double absorbency, unsized, weight[PIGMENTS];
    int passes;
};

static float within(float x, float low, float high)
{
    return x < low ? low : x > high ? high : x;
}

/* The fiber after or before i on an axis, around the sheet. */
static int beside(int i, int axis, int by)
{
    const int x = i % WIDTH, y = i / WIDTH;
    return axis == 0 ? y * WIDTH + (x + by + WIDTH) % WIDTH
                     : (y + by + HEIGHT) % HEIGHT * WIDTH + x;
}

static bool last(int i, int axis)
{
    return axis == 0 ? i % WIDTH == WIDTH - 1 : i / WIDTH == HEIGHT - 1;
}

static void room_find(struct plain *p, int pass)
{
    for (int i = 0; i < FIBERS; i++) {
        float load = 0;
        if (pass == 0)
            load = p->infused[0][i] + p->infused[1][i] + p->water[i];
        else
            load = p->water[i] + p->infused[0][i] + p->infused[1][i];
        const float most = 15 * UNIT, slope = (float)(pass == 0 ? 1 / (13.0 * (double)UNIT)
                                                                : 2 / (15.0 * (double)UNIT));
        p->room[i] = within((most - load) * slope, 0, 1);
    }
}

static void fibers_find(struct plain *p, const struct rule *r)
{
    const double sized = 1 - r->unsized;
    const float base = (float)(sized * 2.1 + r->unsized * 3.4),
                slope = (float)((r->unsized - 1) * 4.5 -
                                (r->unsized > 0 ? r->unsized * 3.4 / r->absorbency : 0));
    for (int i = 0; i < FIBERS; i++) {
        const float most = p->capacity[i] * UNIT;
        p->saturated[i] = p->water[i] / most;
        p->left[i] = fmaxf((most - p->water[i]) * 0.25f, 0);
        p->threshold[i] = within(p->absorbency[i] * slope + base, 0.05f, 0.98f) *
                          fmaxf(p->saturated[i] * -16 + 1, 0);
        p->inverse[i] = 1 / fmaxf(p->water[i], 1);
    }
}

/* How hard one fiber presses into another. */
static float pull(float full, float threshold, const struct rule *r)
{
    const float gate = within((full - threshold) * 8, 0, 1);
    if (r->unsized == 0)
        return gate * full;
    return gate * (full * (float)(1 - r->unsized) + (float)r->unsized);
}

static void faces_find(struct plain *p, const struct rule *r, double carry)
{
    const float leads = (float)(((1 - r->unsized) * 0.8 / r->passes + r->unsized) * UNIT),
                spreads = (float)((1 - carry) * 0.05 * (1 + 1.5 * r->unsized) / UNIT),
                carried = (float)fmin(1, 3 * carry);
    for (int axis = 0; axis < 2; axis++)
        for (int i = 0; i < FIBERS; i++) {
            const int j = beside(i, axis, 1);
            const float face =
                last(i, axis) ? 0 : fmaxf((p->absorbency[j] + p->absorbency[i]) * 0.5f, 1e-6f);
            const float slope = p->saturated[i] - p->saturated[j];
            float flow = pull(p->saturated[i], p->threshold[j], r) * fmaxf(slope, 0) +
                         pull(p->saturated[j], p->threshold[i], r) * fminf(slope, 0);
            flow = flow * face * (fminf(p->capacity[i], p->capacity[j]) * leads);
            flow = fminf(fminf(flow, p->left[j]), p->water[i] * 0.125f);
            flow = fmaxf(fmaxf(flow, -p->left[i]), p->water[j] * -0.125f);
            p->creep[axis][i] = rintf(flow);
            flow = p->creep[axis][i];
            const float both = fminf(p->water[i], p->water[j]) * spreads * face;
            p->out[axis][i] =
                fminf(fmaxf(flow, 0) * p->inverse[i] * carried + both, 0.125f) * p->room[j];
            p->in[axis][i] =
                fmaxf(fminf(flow, 0) * p->inverse[j] * carried - both, -0.125f) * p->room[i];
        }
}

static void flow(float *q, const float over[2][FIBERS])
{
    float to[FIBERS];
    for (int i = 0; i < FIBERS; i++)
        to[i] = q[i] + ((over[0][beside(i, 0, -1)] - over[0][i]) +
                        (over[1][beside(i, 1, -1)] - over[1][i]));
    memcpy(q, to, sizeof to);
}

static void pigment_flow(struct plain *p, float *q, double weight)
{
    static float over[2][FIBERS];
    for (int axis = 0; axis < 2; axis++)
        for (int i = 0; i < FIBERS; i++) {
            const float low = fmaxf(q[i] - 4, 0), high = fmaxf(q[beside(i, axis, 1)] - 4, 0);
            over[axis][i] = rintf(p->out[axis][i] * (float)weight * low +
                                  p->in[axis][i] * (float)weight * high);
        }
    flow(q, over);
}

static void plain_step(struct plain *p, const struct rule *r, double carry)
{
    for (int pass = 0; pass < r->passes; pass++) {
        room_find(p, pass);
        fibers_find(p, r);
        faces_find(p, r, carry);
        flow(p->water, p->creep);
        for (int i = 0; i < PIGMENTS; i++)
            pigment_flow(p, p->infused[i],
                         r->weight[i] + (sqrt(r->weight[i]) - r->weight[i]) * r->unsized);
    }
}

static void layer_get(struct paper_sheet *sheet, enum paper_layer layer, int pigment, float by,
                      float *values)
{
    check(paper_sheet_layer_read(sheet, layer, pigment, values));
    for (int i = 0; i < FIBERS; i++)
        values[i] *= by;
}

/* Amounts by chance, in half of the fibers. */
static void amounts_put(struct paper_sheet *sheet, uint32_t chance)
{
    static float values[FIBERS];
    for (int what = 0; what <= PIGMENTS; what++) {
        for (int i = 0; i < FIBERS; i++) {
            chance = chance * 1664525u + 1013904223u;
            const float part = (float)(chance >> 8) / 16777216.0f;
            values[i] = (i % WIDTH < WIDTH / 2) ? part * (what == 0 ? 0.9f : 3) : 0;
        }
        check(paper_sheet_layer_write(
            sheet, what == 0 ? PAPER_LAYER_INFUSED_WATER : PAPER_LAYER_INFUSED_PIGMENT,
            what == 0 ? 0 : what - 1, values));
    }
}

static void compare(struct paper_sheet *sheet, const struct plain *p, int step)
{
    static float got[FIBERS];
    for (int what = 0; what <= PIGMENTS; what++) {
        const float *right = what == 0 ? p->water : p->infused[what - 1];
        layer_get(sheet, what == 0 ? PAPER_LAYER_INFUSED_WATER : PAPER_LAYER_INFUSED_PIGMENT,
                  what == 0 ? 0 : what - 1, UNIT, got);
        for (int i = 0; i < FIBERS; i++)
            if (got[i] != right[i])
                fail_msg("step %d, %s %d, fiber %d, %d: %.0f grains where %.0f are right", step,
                         what == 0 ? "water" : "pigment", what, i % WIDTH, i / WIDTH,
                         (double)got[i], (double)right[i]);
    }
}

static void creeps_as_plain_c(const char *stock, double absorbency, int passes)
{
    static struct plain p;
    struct paper_sheet_config config =
        sheet_of_two(WIDTH, HEIGHT, "french ultramarine", "burnt umber");
    struct paper_air air = paper_air_default();
    struct paper_sheet *sheet;
    config.parts = PAPER_PART_INFUSED;
    config.stock = *paper_stock_find(stock);
    if (absorbency > 0)
        config.stock.absorbency = absorbency;
    for (int i = 0; i < PIGMENTS; i++)
        config.pigments[i].weight[0] = config.pigments[i].weight[1] = i ? 0.25 : 0.9;
    air.humidity = 0;
    check(paper_sheet_create(&config, &sheet));
    check(paper_sheet_air(sheet, &air));
    amounts_put(sheet, 7);
    const double unsized = 1 - fmin(1, fmax(0, (0.2 - config.stock.absorbency) / (0.2 - 0.12)));
    const struct rule rule = {config.stock.absorbency, unsized, {0.9, 0.25}, passes};
    layer_get(sheet, PAPER_LAYER_ABSORBENCY, 0, 1, p.absorbency);
    layer_get(sheet, PAPER_LAYER_CAPACITY, 0, 1, p.capacity);
    layer_get(sheet, PAPER_LAYER_INFUSED_WATER, 0, UNIT, p.water);
    for (int i = 0; i < PIGMENTS; i++)
        layer_get(sheet, PAPER_LAYER_INFUSED_PIGMENT, i, UNIT, p.infused[i]);
    for (int step = 1; step <= STEPS; step++) {
        check(paper_sheet_step(sheet));
        plain_step(&p, &rule, air.carry);
        if (step < 4 || step % 20 == 0)
            compare(sheet, &p, step);
    }
    int wet = 0;
    for (int i = 0; i < FIBERS; i++)
        wet += i % WIDTH >= WIDTH / 2 && p.water[i] > 0;
    print_message("%s, absorbency %g: water came to %d fibers\n", stock,
                  config.stock.absorbency, wet);
    assert_true(unsized < 1 || wet > FIBERS / 20);
    paper_sheet_destroy(sheet);
}

static void stocks_creep_as_plain_c(void **state)
{
    (void)state;
    creeps_as_plain_c("xuan", 0, 2);
    creeps_as_plain_c("blotting", 0, 2);
    creeps_as_plain_c("xuan", 0.15, 2); /* sized in part */
    creeps_as_plain_c("cold press", 0, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(stocks_creep_as_plain_c)};
    return cmocka_run_group_tests_name("creep", tests, NULL, NULL);
}
