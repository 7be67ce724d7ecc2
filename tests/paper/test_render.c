/* test_render.c - sheets painted in twelve ways, and their renders at 2: the same painting,
 * finer. Structural similarity of both, the finer one box-averaged, both in even light. (Of the
 * first version that flows salt and drips are alike by 0.5.) */
#include <brush.h>
#include <history.h>
#include <paper.h>
#include <sheet.h>
#include <techniques.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sheet_calls.h"

enum { SIDE = 160, WINDOW = 8 };
#define LEAST 0.9

static struct paper_sheet *sheet_of(const char *stock, bool deckled)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = config.height = SIDE;
    config.seed = 7;
    config.stock = *paper_stock_find(stock);
    config.deckled = deckled;
    config.pigments_count = 2;
    config.pigments[0] = *paper_pigment_curtis("french ultramarine");
    config.pigments[1] = *paper_pigment_curtis("quinacridone rose");
    struct paper_sheet *sheet;
    check(paper_sheet_create(&config, &sheet));
    check(paper_history_begin(sheet, 0));
    return sheet;
}

static void steps(struct paper_sheet *sheet, int count)
{
    for (int i = 0; i < count; i++)
        check(paper_sheet_step(sheet));
    check(paper_sheet_finish(sheet));
}

static void box_put(struct paper_sheet *sheet, double x1, double y1, double x2, double y2,
                    const double *amount)
{
    polygon_put(sheet, SIDE, (double[]){x1, y1, x2, y1, x2, y2, x1, y2}, 4, amount);
}

static void lean(struct paper_sheet *sheet, double gravity)
{
    struct paper_air air = paper_air_default();
    air.gravity[1] = gravity;
    check(paper_sheet_air(sheet, &air));
}

/* ---- the paintings ---- */

static void wash(struct paper_sheet *sheet)
{
    box_put(sheet, 12, 12, SIDE - 12, SIDE - 12, (double[]){0.6, 0.6, 0.1});
    steps(sheet, 200);
}

static void type(struct paper_sheet *sheet)
{
    const struct paper_line line = {.text = "Rag", .font = "DejaVu Serif", .size_px = 80};
    struct paper_screen screen;
    check(paper_line_screen(&line, &screen, NULL));
    check(paper_sheet_put_charged(sheet, &screen, 14, 40, (double[]){0.6, 0.9, 0}, 80));
    paper_screen_destroy(&screen);
    steps(sheet, 200);
}

static void splatter(struct paper_sheet *sheet)
{
    check(paper_sheet_splatter(sheet, &(struct paper_splatter){.x = SIDE / 2,
                                                               .y = SIDE / 2,
                                                               .radius = 50,
                                                               .drops = 50,
                                                               .size = {1, 6},
                                                               .seed = 3,
                                                               .amount = {1, 0.2, 0.8}}));
    steps(sheet, 160);
}

static void drawn(struct paper_sheet *sheet, bool dry)
{
    struct paper_brush brush = paper_brush_default();
    brush.width = 34;
    brush.flat = brush.follows = true;
    brush.reach = dry ? 260 : 600;
    brush.load = dry ? 0.2 : 0.6;
    check(paper_sheet_brush(sheet, &brush));
    for (int i = 0; i < 3; i++) {
        const double y = 34 + 45 * i;
        const struct paper_stroke_sample samples[] = {
            {.time_s = 0, .x = 16, .y = y, .pressure = 0.75},
            {.time_s = 0.16, .x = 80, .y = y - 12, .pressure = 0.45},
            {.time_s = 0.32, .x = SIDE - 14, .y = y + 4, .pressure = 0.25}};
        check(paper_sheet_dip(
            sheet, &(struct paper_dip){.part = 1,
                                       .side = {-1, 1},
                                       .amount = {dry ? 0.4 - 0.1 * i : 0.9, 0.9, 0.3 * i}}));
        check(paper_sheet_stroke(
            sheet, &(struct paper_stroke){.pace = 60, .samples_count = 3, .samples = samples},
            NULL));
    }
    steps(sheet, 160);
}

static void strokes(struct paper_sheet *sheet)
{
    drawn(sheet, false);
}

static void dry_brush(struct paper_sheet *sheet)
{
    drawn(sheet, true);
}

static void salt(struct paper_sheet *sheet)
{
    box_put(sheet, 10, 10, SIDE - 10, SIDE - 10, (double[]){0.7, 0.7, 0});
    check(paper_sheet_salt(sheet, &(struct paper_salt){.x = SIDE / 2,
                                                       .y = SIDE / 2,
                                                       .radius = 50,
                                                       .grains = 36,
                                                       .size = {0.6, 1.5},
                                                       .reach = 10,
                                                       .strength = 1,
                                                       .seed = 1}));
    steps(sheet, 200);
}

static void drop(struct paper_sheet *sheet)
{
    check(paper_sheet_put(sheet, NULL, 0, 0, (double[]){0.6, 0, 0}));
    disc_put(sheet, SIDE, 60, 80, 18, (double[]){2, 0, 1.6});
    disc_put(sheet, SIDE, 104, 86, 14, (double[]){2, 1.6, 0});
    steps(sheet, 250);
}

static void puddle(struct paper_sheet *sheet)
{
    disc_put(sheet, SIDE, SIDE / 2, SIDE / 2, 58, (double[]){0.6, 0.2, 0.5});
    steps(sheet, 700);
}

static void drips(struct paper_sheet *sheet)
{
    lean(sheet, 0.2);
    box_put(sheet, 12, 12, SIDE - 12, 42, (double[]){1.5, 0.7, 0});
    steps(sheet, 250);
}

static void ink(struct paper_sheet *sheet)
{
    disc_put(sheet, SIDE, SIDE / 2, SIDE / 2, 24, (double[]){1.2, 1, 0.4});
    steps(sheet, 300);
}

static void backrun(struct paper_sheet *sheet)
{
    check(paper_sheet_put(sheet, NULL, 0, 0, (double[]){0.3, 0.5, 0.1}));
    steps(sheet, 300);
    disc_put(sheet, SIDE, SIDE / 2, SIDE / 2, 18, (double[]){4, 0, 0});
    steps(sheet, 400);
}

/* What is seldom tried (PAPER_TEST_FULL=1) is close in kind to another painting, and was never
 * near the least likeness. */
static const struct painting {
    const char *name, *stock;
    void (*paint)(struct paper_sheet *sheet);
    bool deckled, seldom;
} paintings[] = {
    {"a wash", "cold press", wash, false, true},
    {"type", "cold press", type, false, false},
    {"splatter", "hot press", splatter, false, true},
    {"strokes", "cold press", strokes, false, false},
    {"salt", "cold press", salt, false, false},
    {"drops in water", "cold press", drop, false, true},
    {"a drying puddle", "cold press", puddle, false, true},
    {"drips", "cold press", drips, false, false},
    {"ink on xuan", "xuan", ink, false, false},
    {"dry brush", "rough", dry_brush, false, true},
    {"a backrun", "cold press", backrun, false, false},
    {"deckle edges", "rough", wash, true, false},
};

/* ---- similarity ---- */

/* Grays of a picture in even light; of `finer` pixels each way to one. */
static void grays_make(struct paper_sheet *sheet, int finer, double *grays)
{
    const int side = SIDE * finer;
    uint16_t *rgb = malloc((size_t)side * (size_t)side * 3 * sizeof *rgb);
    assert_non_null(rgb);
    check(paper_sheet_view(sheet, &(struct paper_sheet_view){.high = 1}, rgb));
    memset(grays, 0, SIDE * SIDE * sizeof *grays);
    for (int i = 0; i < side * side; i++)
        grays[i / side / finer * SIDE + i % side / finer] +=
            (0.2126 * rgb[3 * i] + 0.7152 * rgb[3 * i + 1] + 0.0722 * rgb[3 * i + 2]) / 65535 /
            (finer * finer);
    free(rgb);
}

static double alike_in(const double *a, const double *b, int left, int top)
{
    double sum[5] = {0};
    for (int y = top; y < top + WINDOW; y++)
        for (int x = left; x < left + WINDOW; x++) {
            const double u = a[y * SIDE + x], v = b[y * SIDE + x],
                         terms[5] = {u, v, u * u, v * v, u * v};
            for (int i = 0; i < 5; i++)
                sum[i] += terms[i] / (WINDOW * WINDOW);
        }
    const double c1 = 0.0001, c2 = 0.0009, squares = sum[0] * sum[0] + sum[1] * sum[1];
    return (2 * sum[0] * sum[1] + c1) * (2 * (sum[4] - sum[0] * sum[1]) + c2) /
           ((squares + c1) * (sum[2] + sum[3] - squares + c2));
}

/* Structural similarity of what the sheet shows and of its render at 2. */
static double render_likeness(struct paper_sheet *sheet)
{
    static double coarse[SIDE * SIDE], fine[SIDE * SIDE];
    struct paper_sheet *large;
    grays_make(sheet, 1, coarse);
    check(paper_history_render(sheet, 2, 4, -1, &large));
    grays_make(large, 2, fine);
    paper_sheet_destroy(large);
    double sum = 0, count = 0;
    for (int y = 0; y + WINDOW <= SIDE; y++)
        for (int x = 0; x + WINDOW <= SIDE; x++, count++)
            sum += alike_in(coarse, fine, x, y);
    return sum / count;
}

static void a_render_is_the_same_painting(void **state)
{
    int worse = 0;
    (void)state;
    for (size_t i = 0; i < sizeof paintings / sizeof *paintings; i++) {
        if (paintings[i].seldom && !all_sheets_wanted())
            continue;
        struct paper_sheet *sheet = sheet_of(paintings[i].stock, paintings[i].deckled);
        paintings[i].paint(sheet);
        const double likeness = render_likeness(sheet);
        print_message("render at 2, %s: %.3f alike\n", paintings[i].name, likeness);
        worse += likeness < LEAST;
        paper_sheet_destroy(sheet);
    }
    assert_int_equal(worse, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_render_is_the_same_painting)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
