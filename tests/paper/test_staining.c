/* test_staining.c - how paints granulate, and what a sponge lifts of them.
 *
 * Ratings are those of painters, 0..4: what makers print on tubes, and MacEvoy's guide to
 * watercolours. */
#include <paper.h>
#include <sheet.h>
#include <techniques.h>

#include "sheet_calls.h"
#include "sheets.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 96, FIBERS = SIDE * SIDE, INSIDE = 12 };

static float values[FIBERS], other[FIBERS];

struct rated {
    const char *name;
    double staining, granulation; /* painters', 0..4 */
    double kept, spread;          /* measured here */
};

static struct rated rated[] = {
    {"quinacridone rose", 3, 0, 0, 0}, {"cadmium yellow", 2, 0, 0, 0},
    {"cerulean blue", 1, 4, 0, 0},     {"burnt umber", 2, 2, 0, 0},
    {"cadmium red", 2, 0, 0, 0},       {"hansa yellow", 2, 0, 0, 0},
    {"phthalo green", 4, 0, 0, 0},     {"french ultramarine", 1, 4, 0, 0},
    {"yellow ochre", 1, 1, 0, 0},      {"raw sienna", 1, 1, 0, 0},
    {"quinacridone gold", 3, 0, 0, 0}, {"pyrrole red", 4, 0, 0, 0},
    {"burnt sienna", 1, 2, 0, 0},      {"alizarin crimson", 3, 0, 0, 0},
    {"dioxazine violet", 4, 0, 0, 0},  {"cobalt blue", 1, 3, 0, 0},
    {"indanthrone blue", 3, 1, 0, 0},  {"phthalo blue", 4, 0, 0, 0},
    {"prussian blue", 3, 0, 0, 0},     {"cobalt turquoise", 1, 3, 0, 0},
    {"viridian", 1, 3, 0, 0},          {"oxide of chromium", 2, 1, 0, 0},
    {"raw umber", 1, 2, 0, 0},         {"ivory black", 2, 2, 0, 0},
};
enum { RATED = sizeof rated / sizeof *rated, AT_ONCE = 8 };

static void steps(struct paper_sheet *sheet, int count)
{
    for (int i = 0; i < count; i++)
        check(paper_sheet_step(sheet));
    check(paper_sheet_finish(sheet));
}

static void settled_read(struct paper_sheet *sheet, int pigment)
{
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_FIXED_PIGMENT, pigment, values));
    check(paper_sheet_layer_read(sheet, PAPER_LAYER_INFUSED_PIGMENT, pigment, other));
    for (int i = 0; i < FIBERS; i++)
        values[i] += other[i];
}

/* The deviation of `values` away from the sheet's edges, as a part of their mean. */
static double spread_of_values(void)
{
    double sum = 0, squares = 0, count = 0;
    for (int y = INSIDE; y < SIDE - INSIDE; y++)
        for (int x = INSIDE; x < SIDE - INSIDE; x++) {
            const double value = (double)values[y * SIDE + x];
            sum += value;
            squares += value * value;
            count++;
        }
    return sqrt(fmax(0, squares / count - sum / count * (sum / count))) / (sum / count);
}

/* Each paint's wash on rough paper, some on one sheet, which hinder nobody; a sponge. */
static void rated_measure(struct rated *first, int count)
{
    struct paper_sheet_config config = sheet_of_two(SIDE, SIDE, first[0].name, first[1].name);
    double amount[1 + PAPER_PIGMENTS_MAX] = {0.8}, before, after;
    config.stock = *paper_stock_find("rough");
    config.pigments_count = count;
    for (int i = 0; i < count; i++) {
        config.pigments[i] = *paper_pigment_find(first[i].name);
        amount[1 + i] = 0.2;
    }
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    check(paper_sheet_put(sheet, NULL, 0, 0, amount));
    steps(sheet, 1200);
    check(paper_sheet_dry(sheet));
    for (int i = 0; i < count; i++) {
        settled_read(sheet, i);
        first[i].spread = spread_of_values();
    }
    double all[PAPER_PIGMENTS_MAX];
    for (int i = 0; i < count; i++)
        check(paper_sheet_total(sheet, 1 + i, &all[i]));
    check(paper_sheet_lift(sheet, &(struct paper_lift){.part = 0.9}));
    for (int i = 0; i < count; i++) {
        before = all[i];
        check(paper_sheet_total(sheet, 1 + i, &after));
        first[i].kept = after / before;
    }
    paper_sheet_destroy(sheet);
}

/* How many of the others are less, ties by half. */
static double rank_of(const double *of, int i)
{
    double rank = 0;
    for (int k = 0; k < RATED; k++)
        rank += of[k] < of[i] ? 1 : of[k] == of[i] ? 0.5 : 0;
    return rank;
}

/* Spearman's correlation. */
static double ranks_agree(const double *one, const double *two)
{
    double sum[5] = {0};
    for (int i = 0; i < RATED; i++) {
        const double p = rank_of(one, i) - RATED / 2.0, q = rank_of(two, i) - RATED / 2.0;
        sum[0] += p * q;
        sum[1] += p * p;
        sum[2] += q * q;
    }
    return sum[0] / sqrt(sum[1] * sum[2]);
}

static void paints_stain_and_granulate_as_painters_say(void **state)
{
    (void)state;
    double stains[RATED], kept[RATED], grains[RATED], spread[RATED], ultramarine = 0, rose = 1;
    for (int i = 0; i < RATED; i += AT_ONCE)
        rated_measure(&rated[i], RATED - i < AT_ONCE ? RATED - i : AT_ONCE);
    for (int i = 0; i < RATED; i++) {
        stains[i] = rated[i].staining;
        grains[i] = rated[i].granulation;
        kept[i] = rated[i].kept;
        spread[i] = rated[i].spread;
        printf("%-20s a sponge leaves %3.0f%%, spread %4.1f%%\n", rated[i].name, 100 * kept[i],
               100 * spread[i]);
        if (strcmp(rated[i].name, "french ultramarine") == 0)
            ultramarine = spread[i];
        if (strcmp(rated[i].name, "quinacridone rose") == 0)
            rose = spread[i];
    }
    const double lifting = ranks_agree(stains, kept), granulating = ranks_agree(grains, spread);
    printf("ranks: staining %.2f, granulation %.2f\n", lifting, granulating);
    if (!(lifting >= 0.8 && granulating >= 0.8))
        fail_msg("ranks agree by %.2f (staining) and %.2f (granulation)", lifting, granulating);
    if (!(ultramarine >= 0.30 && rose <= 0.04))
        fail_msg("ultramarine's spread is %.3f, quinacridone rose's %.3f", ultramarine, rose);
}
int main(void)
{
    setvbuf(stdout, NULL, _IONBF, 0);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paints_stain_and_granulate_as_painters_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
