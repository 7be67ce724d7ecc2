/* boxes_by_chance.c - random sessions on two sheets, one with boxes and one without: all planes
 * are the same, to the bit.
 *
 *     boxes_by_chance [COUNT [SEED]]
 *
 * Each session draws a sheet of water that flows, its air some times, and what is done: put,
 * blotted, masked, salted, washed, painted with a brush, lifted, dried, sealed, undone and done
 * again; steps in between, and looks. Prints how many sessions there were, and how many of
 * their steps were done in boxes: without these the test would say nothing. */
#include <brush.h>
#include <history.h>
#include <techniques.h>

#include "sheet_chance.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE_LEAST = 32, SIDE = 96, SIDE_LARGE = 160, SCREEN = 20, OPERATIONS = 9, STEPS = 40 };

static struct paper_sheet *sheets[2];
static long steps_all, steps_confined;

static void planes_compare(const char *when)
{
    static uint32_t words[2][SIDE_LARGE * SIDE_LARGE];
    struct paper_plane planes[PAPER_PLANES_MAX];
    const struct paper_sheet_config *config = paper_sheet_get_config(sheets[0]);
    int count = paper_sheet_planes(sheets[0], planes), fibers = config->width * config->height;
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++)
            check(paper_sheet_plane_read(sheets[k], i, words[k]));
        for (int j = 0; j < fibers; j++)
            if (words[0][j] != words[1][j])
                wrong("%s: %s is 0x%x in boxes, and 0x%x, at %d, %d of %dx%d", when,
                      planes[i].name, words[0][j], words[1][j], j % config->width,
                      j / config->width, config->width, config->height);
    }
}

static void steps_go(int count)
{
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++)
            check(paper_sheet_step(sheets[k]));
        steps_all++;
        steps_confined += paper_sheet_share(sheets[0]) < 1;
    }
}

#define BOTH(call)                                                                             \
    for (int k = 0; k < 2; k++) {                                                              \
        struct paper_sheet *sheet = sheets[k];                                                 \
        check(call);                                                                           \
    }

static void amounts_draw(double *amount, int count, double most)
{
    for (int i = 0; i <= count; i++)
        amount[i] = within(0, most);
}

static void brush_draw(int pigments)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(sheets[0]);
    struct paper_brush brush = paper_brush_default();
    brush.bristles = 1 + below(20);
    const bool small = below(4) > 0; /* such strokes leave room for boxes */
    brush.width = within(1, small ? 4 : 12);
    brush.depth = 1 + below(3);
    brush.load = within(small ? 0.5 : 0.01, 2);
    brush.thickness = within(0, 3);
    brush.seed = chance_word();
    struct paper_dip dip = {.part = 1, .side = {-1, 1}};
    amounts_draw(dip.amount, pigments, 1);
    dip.amount[0] = small ? 1 : dip.amount[0];
    struct paper_stroke_sample samples[2];
    for (int i = 0; i < 2; i++)
        samples[i] = (struct paper_stroke_sample){.time_s = 0.1 * i,
                                                  .x = within(-5, config->width + 5),
                                                  .y = within(-5, config->height + 5),
                                                  .pressure = small ? 0.8 : within(0, 1)};
    if (small) {
        samples[1].x = samples[0].x + within(-8, 8);
        samples[1].y = samples[0].y + within(-8, 8);
    }
    const struct paper_stroke stroke = {
        .pace = below(3) ? 60 : 0, .samples_count = 2, .samples = samples};
    BOTH(paper_sheet_brush(sheet, &brush))
    BOTH(paper_sheet_dip(sheet, &dip))
    BOTH(paper_sheet_stroke(sheet, &stroke, NULL))
}

static void layer_draw(int pigments)
{
    static float values[SIDE * SIDE];
    static const enum paper_layer layers[] = {PAPER_LAYER_SURFACE_WATER, PAPER_LAYER_HEIGHT,
                                              PAPER_LAYER_INFUSED_PIGMENT,
                                              PAPER_LAYER_ABSORBENCY};
    const struct paper_sheet_config *config = paper_sheet_get_config(sheets[0]);
    enum paper_layer layer = layers[below(4)];
    int pigment = pigments ? below(pigments) : 0;
    if ((layer == PAPER_LAYER_INFUSED_PIGMENT && !pigments) ||
        (layer == PAPER_LAYER_SURFACE_WATER && !(config->parts & PAPER_PART_SURFACE)))
        return;
    for (int i = 0; i < config->width * config->height; i++)
        values[i] = i % config->width < config->width / 4 ? (float)within(0, 1) : 0;
    BOTH(paper_sheet_layer_write(sheet, layer, pigment, values))
}

static void something_do(int pigments)
{
    static uint8_t gray[SCREEN * SCREEN];
    double amount[1 + CHANCE_PIGMENTS];
    struct paper_screen screen = screen_by_chance(gray, SCREEN);
    int x = below(SIDE) - SCREEN / 2, y = below(SIDE) - SCREEN / 2, what = below(16);
    amounts_draw(amount, pigments, below(4) ? 1 : 4);
    struct paper_air air = below(3) ? paper_air_default() : air_by_chance();
    double part = within(0, 1), reach = within(1, 20);
    if (what < 2)
        air.humidity = within(0, 0.02), air.edge_width = within(1, 32);
    switch (what) {
    case 0:
    case 1:
        BOTH(paper_sheet_air(sheet, &air))
        break;
    case 2:
        BOTH(paper_sheet_blot(sheet, &screen, x, y, part, 0.5))
        break;
    case 3:
        BOTH(paper_sheet_resist(sheet, &screen, x, y, part > 0.3))
        break;
    case 4:
        layer_draw(pigments);
        break;
    case 5:
        if (part < 0.5)
            BOTH(paper_sheet_dry(sheet))
        else
            BOTH(paper_sheet_seal(sheet))
        break;
    case 6:
    case 7: {
        const struct paper_salt salt = {.x = x + SCREEN / 2,
                                        .y = y + SCREEN / 2,
                                        .radius = 10,
                                        .grains = 5,
                                        .size = {1, 2},
                                        .strength = 4 * part,
                                        .reach = reach,
                                        .seed = 4};
        BOTH(paper_sheet_salt(sheet, &salt))
        break;
    }
    case 8:
        BOTH(paper_sheet_lift(sheet, &(struct paper_lift){{&screen, x, y}, part}))
        break;
    case 9:
    case 10:
        brush_draw(pigments);
        break;
    default:
        BOTH(paper_sheet_put(sheet, &screen, x, y, amount))
        break;
    }
}

static void session(uint64_t seed)
{
    chance_begin(seed);
    struct paper_sheet_config config = config_by_chance(SIDE_LEAST, SIDE);
    config.parts = config.parts ? config.parts : PAPER_PARTS_ALL;
    deckle_by_chance(&config);
    for (int k = 0; k < 2; k++)
        check(paper_sheet_create(&config, &sheets[k]));
    const int unit = below(2) ? 4 : 8, recorded = below(3) == 0;
    check(paper_sheet_confine(sheets[0], unit));
    check(paper_sheet_confine(sheets[1], 0));
    for (int k = 0; k < 2 && recorded; k++)
        check(paper_history_begin(sheets[k], k ? 0 : 1e6));
    for (int i = 0; i < OPERATIONS; i++) {
        something_do(config.pigments_count);
        steps_go(below(STEPS));
        if (below(4) == 0)
            planes_compare("in between");
        if (recorded && below(4) == 0) {
            const int back = 1 + below(3), forth = below(3);
            for (int k = 0; k < 2; k++) {
                paper_history_undo(sheets[k], back);
                paper_history_redo(sheets[k], forth);
            }
        }
    }
    planes_compare("at the end");
    for (int k = 0; k < 2; k++)
        paper_sheet_destroy(sheets[k]);
}

/* Two large sheets, one in boxes, with a puddle on each. */
static void puddle_make(void)
{
    enum { PUDDLE = 12 };
    static uint8_t gray[PUDDLE * PUDDLE];
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = config.height = SIDE_LARGE;
    config.pigments_count = 1;
    config.pigments[0] = *paper_pigment_number(0);
    chance_begin(3);
    for (int k = 0; k < 2; k++)
        check(paper_sheet_create(&config, &sheets[k]));
    check(paper_sheet_confine(sheets[0], 4));
    check(paper_sheet_confine(sheets[1], 0));
    struct paper_air air = paper_air_default();
    air.edge_width = 1;
    BOTH(paper_sheet_air(sheet, &air))
    memset(gray, 255, sizeof gray);
    const struct paper_screen screen = {.width_px = PUDDLE, .height_px = PUDDLE, .gray = gray};
    const double amount[2] = {2, 0.3};
    BOTH(paper_sheet_put(sheet, &screen, 14, 14, amount))
    steps_go(2);
    if (!(paper_sheet_share(sheets[0]) < 1))
        wrong("a puddle is not in boxes");
}

static void puddle_end(const char *what)
{
    planes_compare(what);
    for (int k = 0; k < 2; k++)
        paper_sheet_destroy(sheets[k]);
}

/* Edges get wide while boxes are open: what is active spreads faster than they were made
 * for. */
static void air_changes(void)
{
    puddle_make();
    steps_go(1); /* the boxes are good for another */
    struct paper_air air = paper_air_default();
    air.edge_width = 32;
    BOTH(paper_sheet_air(sheet, &air))
    steps_go(20);
    puddle_end("another air");
}

/* Salt dissolves in a box; then all dries. */
static void salt_dissolves(void)
{
    puddle_make();
    const struct paper_salt salt = {.x = 20,
                                    .y = 20,
                                    .radius = 5,
                                    .grains = 5,
                                    .size = {1, 2},
                                    .strength = 1,
                                    .reach = 10,
                                    .seed = 4};
    BOTH(paper_sheet_salt(sheet, &salt))
    steps_go(20);
    planes_compare("salt");
    BOTH(paper_sheet_dry(sheet))
    steps_go(20);
    puddle_end("salt that is dry again");
}

/* A stroke in one box while a puddle runs in another: what the bristles' exchange makes wet, it
 * makes wet in all of them. */
static void puddle_beside_stroke(void)
{
    puddle_make();
    struct paper_brush brush = paper_brush_default();
    brush.bristles = 8;
    brush.width = 4;
    const struct paper_dip dip = {.amount = {1, 0.5}, .part = 1, .side = {-1, 1}};
    const struct paper_stroke_sample samples[2] = {
        {.time_s = 0, .x = 106, .y = 110, .pressure = 0.8},
        {.time_s = 0.1, .x = 112, .y = 110, .pressure = 0.8}};
    const struct paper_stroke stroke = {.pace = 60, .samples_count = 2, .samples = samples};
    BOTH(paper_sheet_brush(sheet, &brush))
    BOTH(paper_sheet_dip(sheet, &dip))
    BOTH(paper_sheet_stroke(sheet, &stroke, NULL))
    if (!(paper_sheet_share(sheets[0]) < 1))
        wrong("a stroke beside a puddle is not in boxes");
    puddle_end("a stroke beside a puddle");
}

int main(int argc, char **argv)
{
    long count = argc > 1 ? atol(argv[1]) : 25;
    uint64_t seed = argc > 2 ? (uint64_t)atoll(argv[2]) : 1;
    puddle_beside_stroke();
    air_changes();
    salt_dissolves();
    for (long i = 0; i < count; i++)
        session(seed + (uint64_t)i);
    printf("%ld sessions; %ld of %ld steps in boxes\n", count, steps_confined, steps_all);
    return count >= 20 && steps_confined < steps_all / 10;
}
