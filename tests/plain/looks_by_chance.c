/* looks_by_chance.c - random sessions on two sheets. One is painted with strokes that grow,
 * steps go on in boxes, and its picture is kept by looking where it has changed. The other one
 * gets the same strokes at once, has no boxes, is looked at whole, and keeps no copies of its
 * past, which it computes anew from the beginning. Pictures are the same to the bit, and so are
 * the planes and what brushes hold.
 *
 *     looks_by_chance [COUNT [SEED [undo]]]
 *
 * With `undo` every second operation is a move in the past, after which planes are compared.
 *
 * Prints how many strokes were dropped on their way, and what part of the looks was at less
 * than the sheet: without these the test would say nothing. */
#include <brush.h>
#include <history.h>
#include <picture.h>
#include <techniques.h>

#include "sheet_chance.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE_LEAST = 36, SIDE = 64, SCREEN = 14, OPERATIONS = 6, STEPS = 8, SAMPLES = 9 };

static struct paper_sheet *grown, *whole;
static struct paper_sheet_view view;
static int width, height;
static uint8_t picture[3 * SIDE * SIDE];
static long looks, looks_at_parts, dropped, strokes;
static bool often_undone;

#define BOTH(call)                                                                             \
    for (int k = 0; k < 2; k++) {                                                              \
        struct paper_sheet *sheet = k ? whole : grown;                                         \
        check(call);                                                                           \
    }

/* Brings the kept picture up to date. */
static void picture_follow(void)
{
    struct paper_area areas[PAPER_AREAS_MAX];
    const int count = paper_sheet_changed(grown, areas);
    double pixels = 0;
    for (int i = 0; i < count; i++) {
        const size_t first = (size_t)areas[i].y * (size_t)width + (size_t)areas[i].x;
        check(paper_sheet_view_area(grown, &view, &areas[i], picture + 3 * first,
                                    3 * (size_t)width));
        pixels += (double)areas[i].width * areas[i].height;
    }
    looks++;
    looks_at_parts += count > 0 && pixels < (double)width * height;
}

static void pictures_compare(const char *when)
{
    static uint16_t rgb[3 * SIDE * SIDE];
    static uint8_t part[3 * SIDE * SIDE];
    check(paper_sheet_view(whole, &view, rgb));
    for (int i = 0; i < 3 * width * height; i++)
        if (picture[i] != rgb[i] >> 8)
            wrong("%s: the picture has %d, and the whole one %d, in channel %d at %d, %d of "
                  "%dx%d",
                  when, picture[i], rgb[i] >> 8, i % 3, i / 3 % width, i / 3 / width, width,
                  height);
    struct paper_area area = {below(width), below(height), 1, 1};
    area.width = 1 + below(width - area.x);
    area.height = 1 + below(height - area.y);
    check(paper_sheet_view_area(grown, &view, &area, part, 3 * (size_t)area.width));
    for (int y = 0; y < area.height; y++)
        for (int i = 0; i < 3 * area.width; i++)
            if (part[y * 3 * area.width + i] !=
                rgb[3 * ((area.y + y) * width + area.x) + i] >> 8)
                wrong("%s: an area of %dx%d at %d, %d of %dx%d is not the whole picture's",
                      when, area.width, area.height, area.x, area.y, width, height);
}

static void planes_compare(const char *when)
{
    static uint32_t words[2][SIDE * SIDE];
    struct paper_plane planes[PAPER_PLANES_MAX];
    const int count = paper_sheet_planes(grown, planes);
    for (int i = 0; i < count; i++) {
        check(paper_sheet_plane_read(grown, i, words[0]));
        check(paper_sheet_plane_read(whole, i, words[1]));
        if (memcmp(words[0], words[1], 4 * (size_t)(width * height)) != 0)
            wrong("%s: %s differs", when, planes[i].name);
    }
    for (int brush = 0; brush < PAPER_BRUSHES_MAX; brush++)
        for (int i = 0; i <= paper_sheet_get_config(grown)->pigments_count; i++) {
            double total[2];
            if (!paper_history_brush(grown, brush))
                continue;
            check(paper_sheet_brush_total(grown, brush, i, &total[0]));
            check(paper_sheet_brush_total(whole, brush, i, &total[1]));
            if (total[0] < total[1] || total[0] > total[1])
                wrong("%s: a brush holds %.17g, and %.17g", when, total[0], total[1]);
        }
    if (paper_history_done(grown) != paper_history_done(whole) ||
        paper_sheet_steps(grown) != paper_sheet_steps(whole))
        wrong("%s: the histories differ", when);
}

/* ---- strokes ---- */

static int samples_draw(struct paper_stroke_sample samples[SAMPLES])
{
    const int count = 1 + below(SAMPLES);
    double time = within(0, 1), x = within(-5, width + 5), y = within(-5, height + 5);
    for (int i = 0; i < count; i++) {
        samples[i] = (struct paper_stroke_sample){.time_s = time,
                                                  .x = x,
                                                  .y = y,
                                                  .pressure = within(0, 1),
                                                  .tilt_x = below(3) ? 0 : within(-1, 1)};
        time += below(5) ? within(0.002, 0.03) : within(0.0001, 0.1);
        x += below(6) ? within(-4, 4) : 0;
        y += below(6) ? within(-4, 4) : 0;
    }
    return count;
}

/* What is refused in the middle of a stroke. */
static void refuse(void)
{
    uint8_t *bytes;
    size_t count;
    if (paper_sheet_step(grown) != PAPER_BAD_ARGUMENT ||
        paper_sheet_stroke_begin(grown, 0, 0) != PAPER_BAD_ARGUMENT ||
        paper_history_seek(grown, 0) != PAPER_BAD_ARGUMENT ||
        paper_history_encode(grown, &bytes, &count) != PAPER_BAD_ARGUMENT ||
        paper_history_redo(grown, 1) != 0)
        wrong("a stroke that grows lets something else be done");
}

/* Feeds samples from..to in pieces, with looks. */
static void grow(const struct paper_stroke_sample *samples, int from, int to)
{
    while (from < to) {
        const int count = 1 + below(to - from);
        check(paper_sheet_stroke_add(grown, samples + from, count, NULL));
        from += count;
        if (below(4) == 0)
            picture_follow();
        if (below(12) == 0)
            refuse();
        if (paper_sheet_stroke_add(grown, samples, 1, NULL) != PAPER_BAD_ARGUMENT)
            wrong("a stroke goes back in time");
    }
}

static void stroke_do(int pigments)
{
    static const double paces[4] = {0, 60, 30, 150};
    struct paper_brush brush = paper_brush_default();
    brush.number = below(2);
    brush.bristles = 1 + below(24);
    brush.width = within(1, 7);
    brush.depth = within(1, 4);
    brush.follows = below(2);
    brush.thickness = within(0, 3);
    brush.seed = chance_word();
    struct paper_dip dip = {.number = brush.number, .part = 1, .side = {-1, 1}};
    for (int i = 0; i <= pigments; i++)
        dip.amount[i] = within(0, 1);
    struct paper_stroke_sample samples[SAMPLES];
    const struct paper_stroke stroke = {.number = brush.number,
                                        .pace = paces[below(4)],
                                        .samples_count = samples_draw(samples),
                                        .samples = samples};
    BOTH(paper_sheet_brush(sheet, &brush))
    BOTH(paper_sheet_dip(sheet, &dip))
    if (below(4) == 0) { /* one that is not to be */
        check(paper_sheet_stroke_begin(grown, brush.number, stroke.pace));
        grow(samples, 0, below(stroke.samples_count + 1));
        if (below(2) && paper_history_undo(grown, 1) != 1)
            wrong("undo does not drop a stroke");
        paper_sheet_stroke_drop(grown);
        dropped++;
    }
    check(paper_sheet_stroke_begin(grown, brush.number, stroke.pace));
    grow(samples, 0, stroke.samples_count);
    check(paper_sheet_stroke_end(grown, NULL));
    check(paper_sheet_stroke(whole, &stroke, NULL));
    strokes++;
}

/* ---- all else ---- */

static void something_do(int pigments)
{
    static uint8_t gray[SCREEN * SCREEN];
    double amount[1 + CHANCE_PIGMENTS];
    struct paper_screen screen = screen_by_chance(gray, SCREEN);
    const int x = below(width) - SCREEN / 2, y = below(height) - SCREEN / 2, drawn = below(20),
              what = often_undone && below(2) ? 6 : drawn;
    const struct paper_screen *through = below(8) ? &screen : NULL;
    const double part = within(0, 1);
    for (int i = 0; i <= pigments; i++)
        amount[i] = within(0, below(4) ? 1 : 4);
    switch (what) {
    case 0:
        BOTH(paper_sheet_blot(sheet, through, x, y, part, 0.5))
        break;
    case 1:
        BOTH(paper_sheet_resist(sheet, through, x, y, part > 0.3))
        break;
    case 2:
        if (part < 0.5)
            BOTH(paper_sheet_dry(sheet))
        else
            BOTH(paper_sheet_seal(sheet))
        break;
    case 3:
        BOTH(paper_sheet_lift(sheet, &(struct paper_lift){{through, x, y}, part}))
        break;
    case 4:
        BOTH(paper_sheet_varnish(sheet, &(struct paper_varnish){{through, x, y}, part}))
        break;
    case 5:
        BOTH(paper_sheet_salt(sheet, &(struct paper_salt){.x = x,
                                                          .y = y,
                                                          .radius = 9,
                                                          .grains = 5,
                                                          .size = {1, 2},
                                                          .strength = part,
                                                          .reach = 5,
                                                          .seed = 4}))
        break;
    case 6:
    case 7: {
        const int back = 1 + below(4), forth = below(3);
        for (int k = 0; k < 2; k++) {
            paper_history_undo(k ? whole : grown, back);
            paper_history_redo(k ? whole : grown, forth);
        }
        if (often_undone)
            planes_compare("in the past");
        break;
    }
    case 8:
    case 9:
        BOTH(paper_sheet_put(sheet, through, x, y, amount))
        break;
    default:
        stroke_do(pigments);
        break;
    }
}

static void view_draw(const struct paper_sheet_config *config)
{
    static const enum paper_layer layers[] = {
        PAPER_LAYER_HEIGHT,        PAPER_LAYER_RESIST,       PAPER_LAYER_VARNISH,
        PAPER_LAYER_SALT,          PAPER_LAYER_GREEN,        PAPER_LAYER_SURFACE_WATER,
        PAPER_LAYER_DRIED_WATER,   PAPER_LAYER_WET_PART,     PAPER_LAYER_GRIP,
        PAPER_LAYER_INFUSED_WATER, PAPER_LAYER_FIXED_PIGMENT};
    static const double ground[3] = {0.2, 0.5, 0.9};
    view = paper_sheet_view_default(config);
    view.show = (enum paper_show)below(4);
    if (view.show == PAPER_SHOW_LAYER)
        view.layer = layers[below(config->pigments_count ? 11 : 10)];
    view.light = below(3) ? view.light : within(0, 4);
    view.ground = below(2) ? ground : NULL;
}

static void session(uint64_t seed)
{
    chance_begin(seed);
    struct paper_sheet_config config = config_by_chance(SIDE_LEAST, SIDE);
    config.parts = config.parts ? config.parts : PAPER_PARTS_ALL;
    deckle_by_chance(&config);
    width = config.width;
    height = config.height;
    check(paper_sheet_create(&config, &grown));
    check(paper_sheet_create(&config, &whole));
    check(paper_history_begin(grown, often_undone && below(2) ? 3e5 : 1e6));
    check(paper_history_begin(whole, 0));
    check(paper_sheet_confine(grown, below(2) ? 4 : 8));
    check(paper_sheet_confine(whole, 0));
    struct paper_air air = paper_air_default();
    air.edge_width = 2;
    BOTH(paper_sheet_air(sheet, &air))
    view_draw(&config);
    for (int i = 0; i < (often_undone ? 3 : 1) * OPERATIONS; i++) {
        something_do(config.pigments_count);
        if (below(3) == 0)
            picture_follow();
        for (int j = below(STEPS); j > 0; j--)
            BOTH(paper_sheet_step(sheet))
        picture_follow();
        pictures_compare("in between");
    }
    planes_compare("at the end");
    for (int k = 0; k < 2; k++)
        paper_sheet_destroy(k ? whole : grown);
}

int main(int argc, char **argv)
{
    const long count = argc > 1 ? atol(argv[1]) : 6;
    const uint64_t seed = argc > 2 ? (uint64_t)atoll(argv[2]) : 1;
    often_undone = argc > 3 && strcmp(argv[3], "undo") == 0;
    for (long i = 0; i < count; i++)
        session(seed + (uint64_t)i);
    printf("%ld sessions; %ld strokes, %ld dropped; %ld of %ld looks at parts\n", count,
           strokes, dropped, looks_at_parts, looks);
    return count >= 20 && (looks_at_parts < looks / 10 || dropped == 0);
}
