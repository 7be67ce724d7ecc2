/* test_studio_springs.c - springy type in a hand: where it lies before it is taken, against
 * type that is set by other code; how it is taken, thrown, and comes to rest on the sheet. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "studio_scene.h"
#include "studio_springs.h"

enum { WIDTH = 640, HEIGHT = 400, PRESETS = 3 };

#define good(call) assert_int_equal(call, PAPER_OK)

static const struct studio_type type = {"Water", "DejaVu Sans", "", 200, 200};

static struct studio_settings settings_of(int springs, double angle)
{
    struct studio_settings s;
    studio_settings_usual(&s);
    s.value[STUDIO_TYPE_SPRINGS] = springs;
    s.value[STUDIO_TYPE_SIZE] = 60;
    s.value[STUDIO_TYPE_ANGLE] = angle;
    return s;
}

static struct studio_springs *springs_of(const struct studio_type *of,
                                         const struct studio_settings *settings)
{
    struct studio_springs *s;
    good(studio_springs_create(of, settings, WIDTH, HEIGHT, &s));
    return s;
}

static int gray_at(const struct paper_screen *s, int x, int y)
{
    return x < 0 || y < 0 || x >= s->width_px || y >= s->height_px
               ? 0
               : s->gray[y * s->width_px + x];
}

/* ---- before it is taken ---- */

/* Straight, turned, in two lines: it lies where type lies that is set. */
static void untouched_it_is_type_that_is_set(void **state)
{
    static const struct {
        const char *text;
        double angle;
    } cases[] = {{"Water", 0}, {"Water", 25}, {"Water", -90}, {"fig\nWo", 0}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct studio_settings settings = settings_of(1, cases[i].angle);
        const struct studio_type of = {cases[i].text, "DejaVu Sans", "", 200, 200};
        struct studio_springs *springs = springs_of(&of, &settings);
        struct paper_screen got, set;
        int x, y, set_x, set_y, most = 0;
        uint32_t missing;
        good(studio_springs_screen(springs, &got, &x, &y));
        good(studio_session_type_screen(&settings, &of, &set, &set_x, &set_y, &missing));
        for (int row = 0; row < HEIGHT; row++)
            for (int column = 0; column < WIDTH; column++) {
                const int apart = abs(gray_at(&got, column - x, row - y) -
                                      gray_at(&set, column - set_x, row - set_y));
                most = apart > most ? apart : most;
            }
        if (most > 2)
            fail_msg("case %zu: %d of 255 apart", i, most);
        paper_screen_destroy(&got);
        paper_screen_destroy(&set);
        studio_springs_destroy(springs);
    }
}

/* ---- in a hand ---- */

/* The middle of what is covered. */
static void middle(struct studio_springs *springs, double at[2], double *area)
{
    struct paper_screen screen;
    int x, y;
    *area = at[0] = at[1] = 0;
    good(studio_springs_screen(springs, &screen, &x, &y));
    for (int i = 0; i < screen.width_px * screen.height_px; i++) {
        *area += screen.gray[i] / 255.0;
        at[0] += screen.gray[i] / 255.0 * (x + i % screen.width_px + 0.5);
        at[1] += screen.gray[i] / 255.0 * (y + i / screen.width_px + 0.5);
    }
    at[0] /= *area;
    at[1] /= *area;
    assert_true(x >= 0 && y >= 0 && x + screen.width_px <= WIDTH &&
                y + screen.height_px <= HEIGHT);
    paper_screen_destroy(&screen);
}

/* Takes it near the W's upper left corner, throws it, and waits; how long. */
static double thrown(struct studio_springs *springs, double by_x, double by_y)
{
    double seconds = 0;
    assert_true(studio_springs_take(springs, 206, 165));
    assert_true(studio_springs_held(springs));
    for (int i = 1; i <= 10; i++) {
        studio_springs_move(springs, 206 + by_x * i / 10, 165 + by_y * i / 10);
        studio_springs_step(springs, 1.0 / 60);
        assert_false(studio_springs_rests(springs));
    }
    studio_springs_let_go(springs);
    assert_false(studio_springs_held(springs));
    for (; !studio_springs_rests(springs) && seconds < 60; seconds += 1.0 / 60)
        studio_springs_step(springs, 1.0 / 60);
    assert_true(studio_springs_rests(springs));
    return seconds;
}

static void only_a_letter_can_be_taken(void **state)
{
    const struct studio_settings settings = settings_of(1, 0);
    struct studio_springs *springs = springs_of(&type, &settings);
    double before[2], after[2], area;
    (void)state;
    assert_false(studio_springs_take(springs, 100, 100));
    assert_false(studio_springs_take(springs, NAN, 1e300));
    assert_false(studio_springs_held(springs));
    middle(springs, before, &area);
    studio_springs_let_go(springs); /* what nobody has */
    studio_springs_step(springs, 5);
    studio_springs_step(springs, -1);
    middle(springs, after, &area);
    assert_true(hypot(after[0] - before[0], after[1] - before[1]) < 0.01);
    assert_false(studio_springs_rests(springs)); /* it was not thrown */
    assert_true(studio_springs_take(springs, 206, 165));
    studio_springs_move(springs, NAN, INFINITY);
    studio_springs_step(springs, 0.1);
    middle(springs, after, &area);
    assert_true(hypot(after[0] - before[0], after[1] - before[1]) < 1);
    studio_springs_destroy(springs);
}

/* Each kind flies on when it is let go, and rests with all of its ink on the sheet: also when
 * it is thrown against an edge. */
static void thrown_it_comes_to_rest_on_the_sheet(void **state)
{
    static const double ways[][2] = {{60, 20}, {-400, 0}, {900, 700}, {0, -2000}, {1, 0}};
    (void)state;
    for (int preset = 1; preset <= PRESETS; preset++)
        for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
            const struct studio_settings settings = settings_of(preset, 0);
            struct studio_springs *springs = springs_of(&type, &settings);
            double before[2], after[2], had, has;
            middle(springs, before, &had);
            const double seconds = thrown(springs, ways[i][0], ways[i][1]);
            middle(springs, after, &has);
            if (i == 0)
                assert_true(after[0] - before[0] > 30 && seconds > 0.2);
            if (!(has > 0.3 * had)) /* letters may lie on each other, or be pressed flat */
                fail_msg("preset %d, way %zu: %g of its ink is left", preset, i, has / had);
            studio_springs_destroy(springs);
        }
}

/* Letters that join, marks on letters, two directions and a letter of another font, large and
 * partly off the sheet: as they are set, and at rest in the end. */
static void any_script_is_thrown(void **state)
{
    static const char *const texts[] = {"سلام é مرحبا", "नमस्ते", "e\xcc\x81\xcc\xa3 😀", "W"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        for (int preset = 1; preset <= PRESETS; preset++) {
            struct studio_settings settings = settings_of(preset, 0);
            const struct studio_type of = {texts[i], "DejaVu Sans", "", 300, 200};
            settings.value[STUDIO_TYPE_SIZE] = i == 3 ? 2000 : 120;
            struct studio_springs *springs = springs_of(&of, &settings);
            double at[2], area, seconds = 0;
            bool taken = false;
            for (int x = 0; x < WIDTH && !taken; x += 10)
                for (int y = 0; y < HEIGHT && !taken; y += 10)
                    taken = studio_springs_take(springs, x, y);
            assert_true(taken);
            studio_springs_move(springs, 100, -300);
            studio_springs_step(springs, 0.1);
            studio_springs_let_go(springs);
            for (; !studio_springs_rests(springs) && seconds < 120; seconds += 0.1)
                studio_springs_step(springs, 0.1);
            assert_true(seconds < 120);
            middle(springs, at, &area);
            assert_true(area > 0);
            studio_springs_destroy(springs);
        }
}

static void the_longer_it_slides_the_farther(void **state)
{
    double before[2], at[2][2], area, seconds[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct studio_settings settings = settings_of(1, 0);
        settings.value[STUDIO_TYPE_SLIDE] = i ? 4 : 0.3;
        struct studio_springs *springs = springs_of(&type, &settings);
        middle(springs, before, &area);
        seconds[i] = thrown(springs, 30, 0);
        middle(springs, at[i], &area);
        studio_springs_destroy(springs);
    }
    assert_true(at[1][0] - before[0] > 1.5 * (at[0][0] - before[0]));
    assert_true(seconds[1] > 2 * seconds[0]);
}

static void no_type_is_an_error(void **state)
{
    struct studio_settings settings = settings_of(0, 0);
    struct studio_springs *s;
    (void)state;
    assert_int_equal(studio_springs_create(&type, &settings, WIDTH, HEIGHT, &s),
                     PAPER_BAD_ARGUMENT);
    assert_null(s);
    settings = settings_of(1, 0);
    const struct studio_type blank = {" \n ", "DejaVu Sans", "", 0, 0};
    assert_int_not_equal(studio_springs_create(&blank, &settings, WIDTH, HEIGHT, &s), PAPER_OK);
    assert_null(s);
    assert_true(studio_session_error()[0] != '\0');
}

/* ---- on the sheet ---- */

/* What is let into the paper is what was seen, and one deed. */
static void it_is_printed_where_it_lands(void **state)
{
    enum { FIBERS = SCENE_WIDTH * SCENE_HEIGHT };
    static float water[FIBERS];
    const struct paper_sheet_config config = scene_config();
    struct studio_settings settings = settings_of(2, 0);
    const struct studio_type small = {"Ah", "DejaVu Sans", "", 20, 40};
    struct studio_springs *springs;
    struct studio_session *s;
    struct paper_screen screen;
    int x, y;
    (void)state;
    settings.value[STUDIO_TYPE_SIZE] = 24;
    good(studio_springs_create(&small, &settings, SCENE_WIDTH, SCENE_HEIGHT, &springs));
    assert_true(studio_springs_take(springs, 28, 32));
    studio_springs_move(springs, 40, 20);
    studio_springs_step(springs, 0.1);
    studio_springs_let_go(springs);
    for (int i = 0; i < 600 && !studio_springs_rests(springs); i++)
        studio_springs_step(springs, 1.0 / 60);
    good(studio_springs_screen(springs, &screen, &x, &y));
    good(studio_session_create(&config, 64e6, &s));
    good(studio_session_set(s, STUDIO_PAUSED, 1));
    good(studio_session_put(s, &screen, x, y));
    assert_int_equal(studio_session_deeds_done(s), 1);
    good(paper_sheet_layer_read(studio_session_sheet(s), PAPER_LAYER_SURFACE_WATER, 0, water));
    for (int i = 0; i < FIBERS; i++) {
        const int gray = gray_at(&screen, i % SCENE_WIDTH - x, i / SCENE_WIDTH - y);
        assert_true((water[i] > 0) == (gray > 0));
    }
    assert_true(studio_session_undo(s));
    good(paper_sheet_layer_read(studio_session_sheet(s), PAPER_LAYER_SURFACE_WATER, 0, water));
    for (int i = 0; i < FIBERS; i++)
        assert_true(water[i] == 0);
    paper_screen_destroy(&screen);
    studio_session_destroy(s);
    studio_springs_destroy(springs);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(untouched_it_is_type_that_is_set),
        cmocka_unit_test(only_a_letter_can_be_taken),
        cmocka_unit_test(thrown_it_comes_to_rest_on_the_sheet),
        cmocka_unit_test(any_script_is_thrown),
        cmocka_unit_test(the_longer_it_slides_the_farther),
        cmocka_unit_test(no_type_is_an_error),
        cmocka_unit_test(it_is_printed_where_it_lands),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
