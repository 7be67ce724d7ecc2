/* sheets_by_chance.c - runs random tiny sheets. Amounts stay finite, within their bounds and
 * whole, and none is lost.
 *
 *     sheets_by_chance [COUNT [SEED [VERSION [AIRS]]]]
 *
 * Each set draws every setting: parts, torus, paper, pigments, and an air AIRS times (2); under
 * each air it draws what is put on, blotted, masked and dried. One parameter in three is at an
 * end of its range. VERSION: of the model, 0: any. Prints how many sheets were checked, and of
 * many the number so far. */
#include <history.h>
#include <paper.h>
#include <sheet.h>

#include "model/felt.h"
#include "sheet_chance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SIDE = 16,
    SIDE_LEAST = 8,
    PIGMENTS = CHANCE_PIGMENTS,
    STEPS = 5,
    PAPERS = 60,
    EVERY = 10000
};

/* The sheet's totals: water, with what has dried, and each pigment. */
static void totals_get(struct paper_sheet *sheet, int count, double *totals)
{
    for (int i = 0; i <= count; i++)
        check(paper_sheet_total(sheet, i, &totals[i]));
    double dried;
    check(paper_sheet_total(sheet, -1, &dried));
    totals[0] += dried;
}

static void planes_look(struct paper_sheet *sheet, int when)
{
    static union {
        float values[SIDE * SIDE];
        uint32_t words[SIDE * SIDE];
    } plane;
    struct paper_plane planes[PAPER_PLANES_MAX];
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    int count = paper_sheet_planes(sheet, planes), fibers = config->width * config->height;
    for (int i = 0; i < count; i++) {
        bool wet = strncmp(planes[i].name, "wet ", 4) == 0,
             speed = strncmp(planes[i].name, "speed", 5) == 0,
             noise = strcmp(planes[i].name, "sizing") == 0 ||
                     strcmp(planes[i].name, "current") == 0 ||
                     strcmp(planes[i].name, "grip") == 0,
             thick = strcmp(planes[i].name, "thickness") == 0 ||
                     strcmp(planes[i].name, "stained part") == 0;
        bool fraction = i < 10 || wet || speed || noise || thick;
        double most = noise           ? 100
                      : fraction      ? 1
                      : config->parts ? 15.0 * PAPER_GRAINS
                                      : 1,
               least = noise   ? -10
                       : speed ? -1
                               : 0;
        check(paper_sheet_plane_read(sheet, i, &plane));
        for (int j = 0; j < fibers; j++) {
            double value = planes[i].whole ? plane.words[j] : (double)plane.values[j];
            if (!(value >= least && value <= (planes[i].whole ? 0x1p31 - 1 : most)))
                wrong("after air %d: %s is %g in fiber %d", when, planes[i].name, value, j);
            if (!fraction && config->parts && floor(value) != value)
                wrong("after air %d: %s is %g in fiber %d, not whole", when, planes[i].name,
                      value, j);
        }
    }
}

static void look(struct paper_sheet *sheet, const double *before, int when)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    double after[1 + PIGMENTS];
    planes_look(sheet, when);
    if (!config->parts)
        return; /* the thesis's rule cuts amounts off */
    totals_get(sheet, config->pigments_count, after);
    for (int i = 0; i <= config->pigments_count; i++)
        if (after[i] != before[i])
            wrong("after air %d: of substance %d there was %.9g and is %.9g", when, i,
                  before[i], after[i]);
}

static void apply_by_chance(struct paper_sheet *sheet)
{
    static uint8_t gray[SIDE * SIDE];
    static float values[SIDE * SIDE];
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    double amount[1 + PIGMENTS];
    struct paper_screen screen = screen_by_chance(gray, SIDE);
    for (int i = 0; i <= config->pigments_count; i++)
        amount[i] = below(4) ? within(0, 4) : within(-4, 4);
    int x = below(SIDE + 8) - 8, y = below(SIDE + 8) - 8;
    check(paper_sheet_put(sheet, below(3) ? &screen : NULL, x, y, amount));
    switch (below(8)) {
    case 0:
        check(paper_sheet_blot(sheet, &screen, y, x, within(0, 1), within(0, 1)));
        break;
    case 1:
        if (config->parts)
            check(paper_sheet_resist(sheet, &screen, y, x, below(3) > 0));
        break;
    case 2:
        for (int i = 0; i < config->width * config->height; i++)
            values[i] = (float)within(0, 4);
        check(paper_sheet_layer_write(sheet, PAPER_LAYER_INFUSED_WATER, 0, values));
        break;
    case 3:
        for (int i = 0; i < config->width * config->height; i++)
            values[i] = (float)within(0, 1);
        check(paper_sheet_layer_write(sheet, (enum paper_layer)below(3), 0, values));
        break;
    case 5: /* holes in the paper, and none where there were some */
        for (int i = 0; i < config->width * config->height; i++)
            values[i] = (float)within(0, 1);
        if (config->deckled)
            check(paper_sheet_layer_write(sheet, PAPER_LAYER_THICKNESS, 0, values));
        break;
    case 4:
        check(below(2) ? paper_sheet_dry(sheet) : paper_sheet_seal(sheet));
        break;
    default:
        break;
    }
}

static void set_look(uint64_t seed, int airs)
{
    static uint16_t rgb[3 * SIDE * SIDE];
    chance_begin(seed);
    struct paper_sheet_config config = config_by_chance(SIDE_LEAST, SIDE);
    deckle_by_chance(&config);
    struct paper_sheet *sheet;
    double totals[1 + PIGMENTS];
    check(paper_sheet_create(&config, &sheet));
    for (int turn = 0; turn < airs; turn++) {
        struct paper_air air = air_by_chance();
        check(paper_sheet_air(sheet, &air));
        apply_by_chance(sheet);
        totals_get(sheet, config.pigments_count, totals);
        for (int i = 0; i < STEPS; i++)
            check(paper_sheet_step(sheet));
        look(sheet, totals, turn);
    }
    check(paper_sheet_view(sheet, &(struct paper_sheet_view){.show = PAPER_SHOW_WET}, rgb));
    paper_sheet_destroy(sheet);
}

/* Fibers that cannot reach a sheet are left out, and the paper is the same. */
static void paper_look(uint64_t seed)
{
    chance_begin(seed);
    struct paper_sheet_config config = config_by_chance(1, 5 * SIDE);
    struct felt felts[2];
    check(felt_make(&config, &felts[0]));
    check(felt_make_slowly(&config, &felts[1]));
    const size_t bytes = sizeof(float) * (size_t)config.width * (size_t)config.height;
    if (memcmp(felts[0].relief, felts[1].relief, bytes) != 0 ||
        memcmp(felts[0].mass, felts[1].mass, bytes) != 0 ||
        memcmp(felts[0].fibers, felts[1].fibers, bytes) != 0)
        wrong("a paper of %dx%d differs where fibers are left out", config.width,
              config.height);
    for (int k = 0; k < 2; k++)
        felt_free(&felts[k]);
}

int main(int argc, char **argv)
{
    long count = argc > 1 ? atol(argv[1]) : 1000;
    uint64_t seed = argc > 2 ? (uint64_t)atoll(argv[2]) : 1;
    const int airs = argc > 3 ? atoi(argv[3]) : 2;
    for (long i = 0; i < count && i < PAPERS; i++)
        paper_look(seed + (uint64_t)i);
    for (long i = 0; i < count; i++) {
        set_look(seed + (uint64_t)i, airs);
        if ((i + 1) % EVERY == 0)
            fprintf(stderr, "%ld sets\n", i + 1);
    }
    printf("%ld sets of parameters, each with %d airs\n", count, airs);
    return 0;
}
