/* sheets_by_chance.c - runs random tiny sheets. Amounts stay finite, within their bounds and whole, and none is lost.
 *
 *     sheets_by_chance [COUNT [SEED]]
 *
 * Each set draws every setting: parts, torus, paper, pigments, and the air twice; and it draws what is put on, blotted, masked
 * and dried. One parameter in three is at an end of its range. Prints how many sheets were checked. */
#include <history.h>
#include <paper.h>
#include <sheet.h>

#include "../sample.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 16, SIDE_LEAST = 8, PIGMENTS = 3, STEPS = 5 };

static uint64_t chance;
static uint64_t set_seed;

static int below(int n)
{
    return (int)(sample_word(&chance) % (uint64_t)n);
}

static double within(double low, double high)
{
    uint64_t word = sample_word(&chance);
    switch (word % 6) {
    case 0:
        return low;
    case 1:
        return high;
    case 2: /* orders of magnitude near the low end */
        return low + (high - low) * ldexp(1, -(int)(word >> 8 & 31));
    default:
        return low + (high - low) * (double)(word >> 11) * 0x1p-53;
    }
}

__attribute__((noreturn, format(printf, 1, 2))) static void wrong(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "set %llu: ", (unsigned long long)set_seed);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(1);
}

static void check(enum paper_status status)
{
    if (status != PAPER_OK)
        wrong("status %d: %s", (int)status, paper_error());
}

static struct paper_pigment pigment_by_chance(void)
{
    struct paper_pigment pigment = *paper_pigment_number(below(15));
    if (below(2))
        return pigment;
    for (int i = 0; i < 2; i++)
        pigment.weight[i] = within(0, 1);
    pigment.density = within(0, 1);
    pigment.staining = within(0.5, 100);
    pigment.granulation = within(0, 1);
    for (int i = 0; i < 3; i++) {
        pigment.k[i] = within(0, 100);
        pigment.s[i] = within(0, 100);
        pigment.takes[i] = within(-1, 1);
    }
    return pigment;
}

static struct paper_sheet_config config_by_chance(void)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = SIDE_LEAST + below(SIDE - SIDE_LEAST + 1);
    config.height = SIDE_LEAST + below(SIDE - SIDE_LEAST + 1);
    config.torus = below(2);
    config.parts = (unsigned)(below(3) ? 15 : below(16));
    config.model = 1 + below(PAPER_MODEL_VERSION);
    config.rule = (enum paper_rule)below(3);
    config.seed = sample_word(&chance);
    config.stock = *paper_stock_number(below(5));
    if (below(2)) {
        struct paper_stock *stock = &config.stock;
        stock->color_variation = within(0, 1);
        stock->absorbency = within(0, PAPER_ABSORBENCY_MAX);
        stock->absorbency_variation = within(0, 1);
        for (int i = 0; i < 2; i++) {
            stock->absorbency_along[i] = within(0, 1);
            stock->capacity[i] = within(0.01, 1);
            stock->fiber_length[i] = (int)within(1, 64);
        }
        stock->roughness = within(0, 1);
        stock->grain_px = within(1, 64);
    }
    config.pigments_count = below(PIGMENTS + 1);
    for (int i = 0; i < config.pigments_count; i++)
        config.pigments[i] = pigment_by_chance();
    return config;
}

static struct paper_air air_by_chance(void)
{
    struct paper_air air = paper_air_default();
    for (int i = 0; i < 2; i++) {
        air.gravity[i] = within(-1, 1);
        air.seep[i] = within(-1, 1);
    }
    air.spread = within(0, 1);
    air.tension = below(2) ? 0 : within(0, 0.1);
    air.relief = within(0, 1);
    air.film = within(0.001, 1);
    air.pinning = within(0, 2);
    air.damp = within(0, 1);
    air.absorption = within(0, 4);
    air.carry = within(0, 1);
    air.humidity = within(0, 1);
    air.edge = within(0, 200);
    air.edge_width = within(1, 32);
    air.settling = within(0, 10);
    air.thesis.gravity_x = within(0.5, 2);
    air.thesis.gravity_y = within(0.5, 2);
    air.thesis.humidity = within(0, 1);
    return air;
}

static struct paper_screen screen_by_chance(uint8_t *gray)
{
    struct paper_screen screen = {
        .width_px = 1 + below(SIDE), .height_px = 1 + below(SIDE), .gray = gray};
    for (int i = 0; i < screen.width_px * screen.height_px; i++)
        gray[i] = (uint8_t)within(0, 255);
    return screen;
}

/* The sheet's totals: water, with what has dried, and each pigment. */
static void totals_get(struct paper_sheet *sheet, int count, double *totals)
{
    for (int i = 0; i <= count; i++)
        check(paper_sheet_total(sheet, i, &totals[i]));
    double dried;
    check(paper_sheet_total(sheet, -1, &dried));
    totals[0] += dried;
}

static void planes_look(struct paper_sheet *sheet, const char *when)
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
                     strcmp(planes[i].name, "grip") == 0;
        bool fraction = i < 10 || wet || speed || noise;
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
                wrong("%s: %s is %g in fiber %d", when, planes[i].name, value, j);
            if (!fraction && config->parts && floor(value) != value)
                wrong("%s: %s is %g in fiber %d, not whole", when, planes[i].name, value, j);
        }
    }
}

static void look(struct paper_sheet *sheet, const double *before, const char *when)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    double after[1 + PIGMENTS];
    planes_look(sheet, when);
    if (!config->parts)
        return; /* the thesis's rule cuts amounts off */
    totals_get(sheet, config->pigments_count, after);
    for (int i = 0; i <= config->pigments_count; i++)
        if (after[i] != before[i])
            wrong("%s: of substance %d there was %.9g and is %.9g", when, i, before[i],
                  after[i]);
}

static void apply_by_chance(struct paper_sheet *sheet)
{
    static uint8_t gray[SIDE * SIDE];
    static float values[SIDE * SIDE];
    const struct paper_sheet_config *config = paper_sheet_get_config(sheet);
    double amount[1 + PIGMENTS];
    struct paper_screen screen = screen_by_chance(gray);
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
    case 4:
        check(below(2) ? paper_sheet_dry(sheet) : paper_sheet_seal(sheet));
        break;
    default:
        break;
    }
}

static void set_look(uint64_t seed)
{
    static uint16_t rgb[3 * SIDE * SIDE];
    set_seed = seed;
    chance = seed * 0x2545f4914f6cdd1d;
    struct paper_sheet_config config = config_by_chance();
    struct paper_sheet *sheet;
    double totals[1 + PIGMENTS];
    check(paper_sheet_create(&config, &sheet));
    for (int turn = 0; turn < 2; turn++) {
        struct paper_air air = air_by_chance();
        check(paper_sheet_air(sheet, &air));
        apply_by_chance(sheet);
        totals_get(sheet, config.pigments_count, totals);
        for (int i = 0; i < STEPS; i++)
            check(paper_sheet_step(sheet));
        look(sheet, totals, turn ? "after the second air" : "after the first air");
    }
    check(paper_sheet_view(sheet, &(struct paper_sheet_view){.show = PAPER_SHOW_WET}, rgb));
    paper_sheet_destroy(sheet);
}

int main(int argc, char **argv)
{
    long count = argc > 1 ? atol(argv[1]) : 1000;
    uint64_t seed = argc > 2 ? (uint64_t)atoll(argv[2]) : 1;
    for (long i = 0; i < count; i++)
        set_look(seed + (uint64_t)i);
    printf("%ld sets of parameters\n", count);
    return 0;
}
