/* test_page.c - the sheet on the machine: its pictures, the same bits in each run, and
 * conservation in its flow. */
#include <paper.h>
#include <paris_internal.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sheet_calls.h"

enum { WIDTH = 96, HEIGHT = 70, BYTES = 3 * WIDTH * HEIGHT };

/* The FNV-1a hash of the golden page, which PoCL 3.1 on x86-64 and every other device must
 * give. */
static const uint64_t golden_hash = 0x4abb75efe109d328u;

/* Evaluates two steps at a time, as `lutetia` does: kernels of more steps take long to
 * compile. */
static void disperse(struct paper *sheet, const struct paper_weather *weather, int steps)
{
    for (int i = 0; i < steps; i++) {
        check(paper_disperse(sheet, weather));
        if (i % 2)
            check(paper_finish(sheet));
    }
}

static struct paper_config config_small(void)
{
    struct paper_config config = paper_config_default();
    config.width = WIDTH;
    config.height = HEIGHT;
    return config;
}

/* Makes a small page with pools, rectangles and type, and runs `steps` cycles of windy
 * weather. */
static struct paper *page_make(const struct paper_config *config, int steps)
{
    struct paper *sheet;
    check(paper_create(config, &sheet));
    check(paper_rectangle(sheet, 20, 10, 50, 45, &(struct paper_ink){.water = 0.9}));
    check(paper_rectangle(sheet, 30, 30, 20, 12,
                          &(struct paper_ink){.cyan = 0.8, .yellow = 0.4}));
    struct paper_line line = {.text = "Paris", .font = "DejaVuSerif", .size_px = 30};
    struct paper_screen screen;
    check(paper_line_screen(&line, &screen, NULL));
    check(paper_screen_ink(sheet, &screen, 12, 20,
                           &(struct paper_ink){.cyan = 0.9, .magenta = 0.7, .water = 0.3}));
    paper_screen_destroy(&screen);
    struct paper_weather weather = paper_weather_default();
    weather.gravity_y = 1.4;
    weather.gravity_x = 0.8;
    disperse(sheet, &weather, steps);
    return sheet;
}

static void page_view(const struct paper_config *config, int steps, uint8_t *rgb)
{
    struct paper *sheet = page_make(config, steps);
    check(paper_view_read(sheet, PAPER_VIEW_COLOR, rgb));
    paper_destroy(sheet);
}

static void bits_per_fiber_add_up(void **state)
{
    (void)state;
    /* 5 permanent and 4 temporary floats, image and colour, coordinates, two contexts. */
    assert_int_equal(paper_bits_per_fiber(1024, 512), 9 * 32 + 2 * 24 + 10 + 9 + 2);
    assert_int_equal(paper_bits_per_fiber(1024, 1024), 358);
    const char *name;
    int bits;
    assert_false(paper_field_describe(1024, 1024, -1, &name, &bits));
    assert_false(paper_field_describe(1024, 1024, 15, &name, &bits));
}

static void same_seed_same_picture(void **state)
{
    (void)state;
    static uint8_t a[BYTES], b[BYTES], c[BYTES];
    struct paper_config config = config_small();
    page_view(&config, 12, a);
    page_view(&config, 12, b);
    assert_memory_equal(a, b, BYTES);
    config.seed++;
    page_view(&config, 12, c);
    assert_memory_not_equal(a, c, BYTES);
}

static void eager_is_fused(void **state)
{
    (void)state;
    static uint8_t fused[BYTES], eager[BYTES];
    struct paper_config config = config_small();
    page_view(&config, 6, fused);
    struct machine_config slow = machine_config_default();
    slow.eager = 1;
    assert_true(paris_reset(&slow));
    page_view(&config, 6, eager);
    assert_true(paris_reset(NULL));
    assert_memory_equal(fused, eager, BYTES);
}

static void golden_page_has_its_hash(void **state)
{
    (void)state;
    static uint8_t rgb[BYTES];
    struct paper_config config = config_small();
    struct paper *sheet;
    check(paper_create(&config, &sheet)); /* no type: FreeType's rendering may change */
    check(paper_rectangle(sheet, 20, 10, 50, 45, &(struct paper_ink){.water = 0.9}));
    check(paper_rectangle(sheet, 30, 30, 20, 12,
                          &(struct paper_ink){.cyan = 0.8, .magenta = 0.5, .yellow = 0.4}));
    struct paper_weather weather = paper_weather_default();
    weather.gravity_x = 0.8;
    weather.gravity_y = 1.4;
    disperse(sheet, &weather, 20);
    check(paper_view_read(sheet, PAPER_VIEW_COLOR, rgb));
    paper_destroy(sheet);
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < BYTES; i++)
        hash = (hash ^ rgb[i]) * 0x100000001b3u;
    if (hash != golden_hash)
        fail_msg("the golden page hashes to 0x%016llx", (unsigned long long)hash);
}

/* Before the first step the picture is the sheet minus the screen, to the bit. */
static void type_is_crisp_before_time(void **state)
{
    (void)state;
    static uint8_t blank[BYTES], inked[BYTES];
    struct paper_config config = config_small();
    config.color_variation = 0;
    config.color[0] = 1;
    struct paper *sheet;
    check(paper_create(&config, &sheet));
    check(paper_view_read(sheet, PAPER_VIEW_COLOR, blank));
    struct paper_line line = {.text = "Type", .font = "DejaVuSerif", .size_px = 30};
    struct paper_screen screen;
    check(paper_line_screen(&line, &screen, NULL));
    check(paper_screen_ink(sheet, &screen, 10, 20, &(struct paper_ink){.cyan = 1, .water = 1}));
    check(paper_view_read(sheet, PAPER_VIEW_COLOR, inked));
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            size_t at = 3 * ((size_t)y * WIDTH + (size_t)x);
            bool inside =
                x >= 10 && x < 10 + screen.width_px && y >= 20 && y < 20 + screen.height_px;
            int gray = inside ? screen.gray[(y - 20) * screen.width_px + x - 10] : 0;
            assert_int_equal(inked[at], 255 - gray);
            assert_int_equal(inked[at + 1], blank[at + 1]);
            assert_int_equal(inked[at + 2], blank[at + 2]);
        }
    paper_screen_destroy(&screen);
    paper_destroy(sheet);
}

/* The outflow of a fiber is its neighbour's inflow: away from the rim nothing is lost except by
 * drying. */
static void flow_keeps_water_and_pigment(void **state)
{
    (void)state;
    struct paper_config config = config_small();
    struct paper *sheet;
    check(paper_create(&config, &sheet));
    check(
        paper_rectangle(sheet, 35, 25, 20, 20, &(struct paper_ink){.cyan = 0.5, .water = 0.7}));
    double water[2], cyan[2];
    check(paper_total(sheet, PAPER_WATER, &water[0]));
    check(paper_total(sheet, PAPER_CYAN, &cyan[0]));
    struct paper_weather weather = paper_weather_default();
    weather.humidity = 0;
    disperse(sheet, &weather, 20);
    check(paper_total(sheet, PAPER_WATER, &water[1]));
    check(paper_total(sheet, PAPER_CYAN, &cyan[1]));
    paper_destroy(sheet);
    assert_true(fabs(water[0] - 280) < 1e-2 && fabs(cyan[0] - 200) < 1e-2);
    assert_true(fabs(water[1] - water[0]) < 1e-3 * water[0]);
    assert_true(fabs(cyan[1] - cyan[0]) < 1e-3 * cyan[0]);
}

/* With the same absorbency everywhere and no gravity the rule is symmetric. Two asymmetries
 * remain, less than a shade: the order of rounding, and that the pigment that crosses a face
 * depends on the water of one side. */
static void still_paper_is_symmetric(void **state)
{
    (void)state;
    static uint8_t rgb[BYTES];
    struct paper_config config = config_small();
    config.absorbency_variation = 0;
    config.color_variation = 0;
    struct paper *sheet;
    check(paper_create(&config, &sheet));
    check(paper_rectangle(sheet, 0, 0, WIDTH, HEIGHT, &(struct paper_ink){.water = 1}));
    check(paper_rectangle(sheet, 40, 0, 16, HEIGHT, &(struct paper_ink){.cyan = 0.8}));
    struct paper_weather weather = paper_weather_default();
    weather.humidity = 0;
    disperse(sheet, &weather, 20);
    check(paper_view_read(sheet, PAPER_VIEW_COLOR, rgb));
    paper_destroy(sheet);
    for (int x = 20; x < WIDTH / 2; x++) {
        const uint8_t *row = rgb + 3 * WIDTH * (HEIGHT / 2);
        assert_true(abs(row[3 * x] - row[3 * (WIDTH - 1 - x)]) <= 1);
    }
    assert_true(rgb[3 * (WIDTH * (HEIGHT / 2) + 36)] < rgb[3 * (WIDTH * (HEIGHT / 2) + 20)]);
}

static void dry_paper_stands_still(void **state)
{
    (void)state;
    static uint8_t before[BYTES], after[BYTES];
    struct paper_config config = config_small();
    struct paper *sheet;
    check(paper_create(&config, &sheet));
    check(
        paper_rectangle(sheet, 30, 20, 30, 30, &(struct paper_ink){.cyan = 0.5, .magenta = 1}));
    check(paper_view_read(sheet, PAPER_VIEW_COLOR, before));
    struct paper_weather weather = paper_weather_default();
    weather.gravity_x = 0.8;
    weather.gravity_y = 1.4;
    disperse(sheet, &weather, 10);
    check(paper_view_read(sheet, PAPER_VIEW_COLOR, after));
    paper_destroy(sheet);
    assert_memory_equal(before, after, BYTES);
}

/* Amounts stay within 0..1 in any weather: no colour channel wraps round, and no total is a
 * NaN. */
static void extremes_stay_within_bounds(void **state)
{
    (void)state;
    static const double gravities[] = {0.5, 2};
    for (size_t i = 0; i < 4; i++) {
        struct paper_config config = config_small();
        config.absorbency = PAPER_ABSORBENCY_MAX;
        config.absorbency_variation = 1;
        struct paper *sheet;
        check(paper_create(&config, &sheet));
        check(paper_rectangle(
            sheet, -5, -5, 60, 60,
            &(struct paper_ink){.cyan = 1, .magenta = 1, .yellow = 1, .water = 1}));
        struct paper_weather weather = {.gravity_x = gravities[i % 2],
                                        .gravity_y = gravities[i / 2],
                                        .humidity = 0.01,
                                        .molecular_weight = {1, 1, 1}};
        disperse(sheet, &weather, 24);
        for (int amount = PAPER_WATER; amount <= PAPER_YELLOW; amount++) {
            double total;
            check(paper_total(sheet, (enum paper_amount)amount, &total));
            assert_true(total >= 0 && total <= WIDTH * HEIGHT);
        }
        paper_destroy(sheet);
    }
}

static void wrong_arguments_are_refused(void **state)
{
    (void)state;
    struct paper *sheet;
    struct paper_config config = config_small();
    static const int sides[] = {0, -3, 7, PAPER_SIDE_MAX + 1};
    for (size_t i = 0; i < 4; i++) {
        config.width = sides[i];
        assert_int_equal(paper_create(&config, &sheet), PAPER_BAD_ARGUMENT);
        assert_null(sheet);
    }
    config = config_small();
    config.absorbency = NAN;
    assert_int_equal(paper_create(&config, &sheet), PAPER_BAD_ARGUMENT);
    config = config_small();
    config.fiber_length = 0;
    assert_int_equal(paper_create(&config, &sheet), PAPER_BAD_ARGUMENT);
    config = config_small();
    check(paper_create(&config, &sheet));
    assert_int_equal(paper_rectangle(sheet, 0, 0, 9, 9, &(struct paper_ink){.water = NAN}),
                     PAPER_BAD_ARGUMENT);
    assert_int_equal(paper_rectangle(sheet, 0, 0, 9, 9, &(struct paper_ink){.cyan = 1.5}),
                     PAPER_BAD_ARGUMENT);
    struct paper_screen none = {0};
    assert_int_equal(paper_screen_ink(sheet, &none, 0, 0, &(struct paper_ink){.cyan = 1}),
                     PAPER_BAD_ARGUMENT);
    struct paper_weather weather = paper_weather_default();
    weather.gravity_x = INFINITY;
    assert_int_equal(paper_disperse(sheet, &weather), PAPER_BAD_ARGUMENT);
    weather = paper_weather_default();
    weather.humidity = -1;
    assert_int_equal(paper_disperse(sheet, &weather), PAPER_BAD_ARGUMENT);
    paper_destroy(sheet);
}

/* Places off the sheet, half on it, and farther away than an int can hold. */
static void places_off_the_sheet_are_ignored(void **state)
{
    (void)state;
    struct paper_config config = config_small();
    struct paper *sheet;
    check(paper_create(&config, &sheet));
    const struct paper_ink ink = {.cyan = 1};
    check(paper_rectangle(sheet, -50, 0, 50, 10, &ink));
    check(paper_rectangle(sheet, WIDTH, 0, 50, 10, &ink));
    check(paper_rectangle(sheet, 5, 5, 0, 10, &ink));
    check(paper_rectangle(sheet, 5, 5, -7, 10, &ink));
    check(paper_rectangle(sheet, INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX, &ink));
    double cyan;
    check(paper_total(sheet, PAPER_CYAN, &cyan));
    assert_true(cyan == 0);
    check(paper_rectangle(sheet, -5, -5, 10, 10, &ink));
    check(paper_total(sheet, PAPER_CYAN, &cyan));
    assert_true(cyan == 25);
    uint8_t gray[100];
    memset(gray, 255, sizeof gray);
    struct paper_screen screen = {.width_px = 10, .height_px = 10, .gray = gray};
    check(paper_screen_ink(sheet, &screen, WIDTH - 3, HEIGHT - 2, &ink));
    check(paper_total(sheet, PAPER_CYAN, &cyan));
    assert_true(cyan == 31);
    paper_destroy(sheet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_per_fiber_add_up),
        cmocka_unit_test(same_seed_same_picture),
        cmocka_unit_test(eager_is_fused),
        cmocka_unit_test(golden_page_has_its_hash),
        cmocka_unit_test(type_is_crisp_before_time),
        cmocka_unit_test(flow_keeps_water_and_pigment),
        cmocka_unit_test(still_paper_is_symmetric),
        cmocka_unit_test(dry_paper_stands_still),
        cmocka_unit_test(extremes_stay_within_bounds),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(places_off_the_sheet_are_ignored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
