/* test_session.c - a session's history as a script: run, it makes the same planes and leaves
 * the same in the brushes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <brush.h>
#include <history.h>
#include <script_session.h>
#include <techniques.h>

#include <locale.h>
#include <unistd.h>

#include "../sample.h"
#include "../sheets.h"
#include "scripted.h"

enum { WIDTH = 40, HEIGHT = 28, FIBERS = WIDTH * HEIGHT };

static void check(enum paper_status status)
{
    if (status != PAPER_OK)
        fail_msg("status %d: %s", (int)status, paper_error());
}

static struct paper_sheet *painted;
static int compared;

/* The host's: the script's paper is the painted one. */
static enum script_status compare(void *context, const struct paper_state_sheet *papers,
                                  int count, enum script_status status)
{
    static uint32_t words[2][FIBERS];
    struct paper_plane planes[PAPER_PLANES_MAX];
    (void)context;
    if (status != SCRIPT_OK)
        return status;
    assert_int_equal(count, 1);
    struct paper_sheet *made = papers[0].sheet;
    assert_true(
        paper_sheet_config_same(paper_sheet_get_config(painted), paper_sheet_get_config(made)));
    for (int i = paper_sheet_planes(painted, planes) - 1; i >= 0; i--) {
        check(paper_sheet_plane_read(painted, i, words[0]));
        check(paper_sheet_plane_read(made, i, words[1]));
        assert_memory_equal(words[0], words[1], sizeof words[0]);
    }
    for (int brush = 0; brush < 3; brush++)
        for (int i = 0; i < 3; i++) {
            double total[2];
            check(paper_sheet_brush_total(painted, brush, i, &total[0]));
            check(paper_sheet_brush_total(made, brush, i, &total[1]));
            assert_memory_equal(&total[0], &total[1], sizeof total[0]);
        }
    assert_int_equal(paper_sheet_steps(painted), paper_sheet_steps(made));
    compared++;
    return status;
}

static void steps(int count)
{
    for (int i = 0; i < count; i++)
        check(paper_sheet_step(painted));
}

static void stroke(int number, double x)
{
    struct paper_brush brush = paper_brush_default();
    brush.number = number;
    brush.bristles = 12 + number;
    brush.width = 6.1;
    brush.flat = number == 1;
    brush.angle = 0.1 + 0.7 * number;
    brush.seed = number == 2 ? UINT64_C(1) << 40 : 77; /* what no script can say */
    struct paper_dip dip = {
        .number = number, .part = 0.9, .side = {-0.5, 1}, .amount = {0.8, 0.3, 1 / 3.0}};
    check(paper_sheet_brush(painted, &brush));
    check(paper_sheet_dip(painted, &dip));
    check(paper_sheet_stroke_begin(painted, number, 60));
    for (int i = 0; i < 6; i++)
        check(paper_sheet_stroke_add(painted,
                                     &(struct paper_stroke_sample){.time_s = 0.1 + i / 70.0,
                                                                   .x = x + 10 / 3.0 * i,
                                                                   .y = 9 + i / 7.0,
                                                                   .pressure = 0.5 + i / 13.0,
                                                                   .tilt_x = 0.1},
                                     1, NULL));
    check(paper_sheet_stroke_end(painted, NULL));
}

static void session_paint(void)
{
    static uint8_t gray[9 * 7];
    static float values[FIBERS];
    for (size_t i = 0; i < sizeof gray; i++)
        gray[i] = (uint8_t)(37 * i);
    const struct paper_screen screen = {.width_px = 9, .height_px = 7, .gray = gray};
    const struct paper_place place = {&screen, 5, 6};
    struct paper_air air = *paper_sheet_get_air(painted);
    air.gravity[1] = 1 / 30.0;
    check(paper_sheet_wash(
        painted,
        &(struct paper_wash){.amount = {0.2, 0.1}, .end = {0.1, 0.3}, .to = {30, 20}}));
    check(paper_sheet_put(painted, &screen, -3, 4, (double[]){1, 0.4, 0.1}));
    check(paper_sheet_put(painted, NULL, 0, 0, (double[]){0.1, 0, 0.05}));
    steps(5);
    check(paper_sheet_air(painted, &air));
    check(paper_sheet_resist(painted, &screen, 20, 15, true));
    for (int number = 0; number < 3; number++)
        stroke(number, 4 + 8 * number);
    check(paper_sheet_blot(painted, &screen, 9, 9, 0.5, 0.25));
    check(paper_sheet_blot(painted, NULL, 0, 0, 0.125, 0));
    check(paper_sheet_salt(painted, &(struct paper_salt){.x = 20,
                                                         .y = 14,
                                                         .radius = 9,
                                                         .grains = 4,
                                                         .size = {1, 2},
                                                         .strength = 1,
                                                         .reach = 5,
                                                         .seed = 9}));
    steps(3);
    check(paper_history_insert_begin(painted, 2));
    stroke(0, 7);
    check(paper_history_insert_end(painted, true));
    check(paper_sheet_lift(painted, &(struct paper_lift){place, 0.4}));
    check(paper_sheet_dry(painted));
    check(paper_sheet_layer_read(painted, PAPER_LAYER_HEIGHT, 0, values));
    values[40] = 0.75f;
    check(paper_sheet_layer_write(painted, PAPER_LAYER_HEIGHT, 0, values));
    check(paper_sheet_varnish(painted, &(struct paper_varnish){place, 0.6}));
    check(paper_sheet_seal(painted));
    stroke(1, 9);
    steps(6);
    check(paper_sheet_resist(painted, &screen, 20, 15, false));
    stroke(0, 3); /* is undone */
    assert_int_equal(paper_history_undo(painted, 3), 3);
}

static void painted_make(void)
{
    struct paper_sheet_config config =
        sheet_of_two(WIDTH, HEIGHT, "quinacridone rose", "french ultramarine");
    memset(config.pigments[1].name, 0, sizeof config.pigments[1].name);
    snprintf(config.pigments[1].name, sizeof config.pigments[1].name, "my \"own\" blue");
    config.pigments[1].k[0] = 1 / 3.0;
    config.stock = *paper_stock_find("laid");
    config.stock.roughness = 0.123;
    config.seed = 4711;
    check(paper_sheet_create(&config, &painted));
    check(paper_history_begin(painted, 1e7));
}

static void a_session_is_a_script(void **state)
{
    (void)state;
    char path[512];
    struct scripted s = {.config = scripted_config(), .host = {.finish = compare}};
    painted_make();
    session_paint();
    snprintf(path, sizeof path, "%s", scratch_path("session.lua"));
    assert_int_equal(script_session_write(painted, PAPER_SHOW_COLOR, path), SCRIPT_OK);
    FILE *file = fopen(path, "r");
    static char text[1 << 18];
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    assert_non_null(strstr(text, "p:stroke{brush = b1, pace = 60, points = {"));
    assert_non_null(strstr(text, "p:put(image(\"session-1.png\", 0, 4), {[\"water\"] = 1,"));
    assert_non_null(strstr(text, "-- wash\n")); /* some have no words */
    const enum script_status status = scripted_run(&s, text);
    assert_string_equal(s.errors, "");
    assert_true(status == SCRIPT_OK);
    assert_int_equal(compared, 1);
    unlink(path);
    unlink(scratch_path("session.png"));
    for (int i = 1; i < 8; i++) {
        char name[32];
        snprintf(name, sizeof name, "session-%d.png", i);
        unlink(scratch_path(name));
    }
    paper_sheet_destroy(painted);
}

static void what_cannot_be_written_is_said(void **state)
{
    (void)state;
    painted_make();
    assert_int_equal(script_session_write(painted, PAPER_SHOW_COLOR, "/nowhere/at/all.lua"),
                     SCRIPT_FAILED);
    assert_non_null(strstr(script_session_error(), "/nowhere/at/all.lua: cannot write: "));
    assert_int_equal(script_session_write(painted, PAPER_SHOW_COLOR, "/tmp/session.txt"),
                     SCRIPT_FAILED);
    assert_non_null(strstr(script_session_error(), "ends in .lua"));
    paper_sheet_destroy(painted);
}

/* Operations' bytes, changed by chance: refused, or another operation. */
static void changed_bytes_are_refused(void **state)
{
    uint64_t chance = 5;
    int refused = 0;
    (void)state;
    painted_make();
    session_paint();
    const int operations = paper_history_done(painted);
    struct paper_sheet *other;
    check(paper_sheet_create(paper_sheet_get_config(painted), &other));
    for (int turn = 0; turn < 4 * operations; turn++) {
        uint8_t *bytes;
        size_t count;
        check(paper_history_operation(painted, turn % operations, &bytes, &count));
        for (int i = turn / operations; i > 0; i--)
            bytes[sample_word(&chance) % (count < 60 ? count : 60)] ^=
                (uint8_t)(1u << sample_word(&chance) % 8);
        if (turn >= operations && bytes[1] == 's' && bytes[2] == 't' && bytes[3] == 'r')
            count--; /* a stroke of years would be painted */
        const enum paper_status status = paper_sheet_again(other, bytes, count);
        free(bytes);
        assert_true(status == PAPER_OK || status == PAPER_BAD_FILE ||
                    status == PAPER_BAD_ARGUMENT || status == PAPER_NO_MEMORY);
        refused += status != PAPER_OK;
    }
    assert_true(refused > operations);
    paper_sheet_destroy(other);
    paper_sheet_destroy(painted);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_session_is_a_script),
        cmocka_unit_test(what_cannot_be_written_is_said),
        cmocka_unit_test(changed_bytes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
