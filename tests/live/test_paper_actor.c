/* test_paper_actor.c - paper on a stage: keys print, controls and maps act, the pointer paints,
 * and undo takes it back. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <live_player.h>
#include <paper_actor.h>
#include <stage.h>

#include "../display/scratch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 64, COUNT = WIDTH * HEIGHT };

static struct font_face *face;

static struct paper_actor_def small_def(void)
{
    struct paper_actor_def def = paper_actor_def_default();
    def.keys.face = face;
    def.keys.text = "H";
    def.width = WIDTH;
    def.height = HEIGHT;
    def.pigments_count = 2;
    return def;
}

static struct stage *paper_stage(void)
{
    const struct paper_actor_def def = small_def();
    struct stage_def stage_def = stage_def_default();
    struct stage *stage;
    stage_def.step_s = 1.0 / 60;
    if (paper_actor_create(&def, &stage_def.actor) != STAGE_OK)
        fail_msg("%s", stage_error());
    assert_int_equal(stage_create(&stage_def, &stage), STAGE_OK);
    assert_int_equal(stage_frame(stage, 0, NULL), STAGE_OK);
    return stage;
}

static void strike(struct stage *stage, int note, int velocity)
{
    const struct stage_actor actor = stage_actor(stage);
    const uint8_t bytes[3] = {0x90, (uint8_t)note, (uint8_t)velocity};
    assert_int_equal(paper_actor_play(&actor, bytes), STAGE_OK);
}

static double total(struct stage *stage, int substance)
{
    const struct stage_actor actor = stage_actor(stage);
    double sum;
    assert_int_equal(paper_sheet_total(paper_actor_sheet(&actor), substance, &sum), PAPER_OK);
    return sum;
}

/* The mean place of the first pigment, 0..1 from the left and from the top. */
static void ink_place(struct stage *stage, double *x, double *y)
{
    static const enum paper_layer layers[3] = {
        PAPER_LAYER_SURFACE_PIGMENT, PAPER_LAYER_INFUSED_PIGMENT, PAPER_LAYER_FIXED_PIGMENT};
    static float values[COUNT];
    const struct stage_actor actor = stage_actor(stage);
    double sum = 0, across = 0, down = 0;
    for (int k = 0; k < 3; k++) {
        assert_int_equal(
            paper_sheet_layer_read(paper_actor_sheet(&actor), layers[k], 0, values), PAPER_OK);
        for (int i = 0; i < COUNT; i++) {
            sum += (double)values[i];
            across += (double)values[i] * (i % WIDTH + 0.5) / WIDTH;
            down += (double)values[i] * (floor((double)i / WIDTH) + 0.5) / HEIGHT;
        }
    }
    assert_true(sum > 0);
    *x = across / sum;
    *y = down / sum;
}

static void go_on(struct stage *stage, double *now_s, double seconds)
{
    for (int i = 0; i < (int)lround(seconds * 20); i++)
        assert_int_equal(stage_frame(stage, *now_s += 0.05, NULL), STAGE_OK);
}

/* A letter's ink is proportional to its area, and so to the square of the velocity. */
static void letters_are_as_large_as_keys_are_struck(void **unused)
{
    (void)unused;
    struct stage *stage = paper_stage();
    double before = 0, ink[2];
    for (int i = 0; i < 2; i++) {
        strike(stage, 60, i ? 120 : 60);
        ink[i] = total(stage, 1) - before;
        before += ink[i];
        if (i == 0)
            assert_int_equal(stage_reset(stage), STAGE_OK);
        before = 0;
    }
    assert_true(ink[0] > 0 && fabs(ink[1] / ink[0] - 4) < 0.4);
    assert_true(total(stage, 2) == 0); /* the second pigment has not been chosen */
    assert_int_equal(stage_set(stage, "pigment=quinacridone-rose"), STAGE_OK);
    strike(stage, 62, 100);
    assert_true(total(stage, 2) > 0 && total(stage, 1) == ink[1]);
    stage_destroy(stage);
}

static void controls_lead_the_water(void **unused)
{
    (void)unused;
    double places[3][2];
    static const char *const sets[3] = {"gravity=0", "gravity=0.9", "tilt=-0.9"};
    for (int i = 0; i < 3; i++) {
        struct stage *stage = paper_stage();
        double now_s = 0;
        assert_int_equal(stage_set(stage, "water=2"), STAGE_OK);
        assert_int_equal(stage_set(stage, sets[i]), STAGE_OK);
        strike(stage, 60, 127);
        const double ink = total(stage, 1);
        go_on(stage, &now_s, 1);
        assert_true(total(stage, 1) == ink); /* not a grain is lost */
        ink_place(stage, &places[i][0], &places[i][1]);
        stage_destroy(stage);
    }
    assert_true(places[1][1] > places[0][1] + 0.02); /* down */
    assert_true(places[2][0] < places[0][0] - 0.01); /* to the left */
}

static void aftertouch_gives_water(void **unused)
{
    (void)unused;
    struct stage *stage = paper_stage();
    const struct stage_actor actor = stage_actor(stage);
    double now_s = 0;
    assert_int_equal(stage_set(stage, "humidity=0"), STAGE_OK);
    strike(stage, 60, 100);
    const double dry = total(stage, 0), ink = total(stage, 1);
    go_on(stage, &now_s, 0.5);
    assert_true(total(stage, 0) <= dry);
    assert_int_equal(paper_actor_play(&actor, (const uint8_t[]){0xd0, 127, 0}), STAGE_OK);
    go_on(stage, &now_s, 0.5);
    assert_true(total(stage, 0) > dry && total(stage, 1) == ink);
    stage_destroy(stage);
}

/* A low note moves the brush along the bottom. */
static void a_map_leads_a_brush(void **unused)
{
    (void)unused;
    static const int ms[2] = {100, 1400};
    static const uint8_t bytes[2][3] = {{0x90, 35, 127}, {0x80, 35, 64}}; /* b1: far right */
    const struct midi_song_def song_def = midi_song_def_default();
    struct midi_song *song;
    struct live_source *source;
    struct live_player *player;
    char map[400];
    double x, y;
    assert_int_equal(midi_song_create(&song_def, &song), MIDI_OK);
    for (int i = 0; i < 2; i++) {
        struct midi_message m =
            midi_message_make((uint64_t)ms[i] * 1000000, bytes[i][0], bytes[i][1], bytes[i][2]);
        assert_int_equal(midi_song_record(song, 0, &m, 0), MIDI_OK);
    }
    const struct live_source_def source_def = {.song = song};
    assert_int_equal(live_source_open(&source_def, &source), MIDI_OK);
    struct stage *stage = paper_stage();
    assert_int_equal(stage_set(stage, "size=0.05"),
                     STAGE_OK); /* the brush alone is to be seen */
    snprintf(map, sizeof map, "%s/paper.lua", getenv("MAPS"));
    const struct live_player_def def = {.source = source, .script = map};
    if (live_player_create(&def, stage, &player) != STAGE_OK)
        fail_msg("%s", stage_error());
    for (int i = 0; i < 40; i++) {
        assert_int_equal(live_player_before(player, stage, i * 0.05), STAGE_OK);
        assert_int_equal(stage_frame(stage, i * 0.05, NULL), STAGE_OK);
    }
    ink_place(stage, &x, &y);
    assert_true(x > 0.7 && y > 0.75);
    live_player_destroy(player);
    live_source_close(source);
    stage_destroy(stage);
    midi_song_destroy(song);
}

static void a_hand_paints_and_takes_it_back(void **unused)
{
    (void)unused;
    struct stage *stage = paper_stage();
    struct stage_draw_list list = {0};
    double now_s = 0;
    strike(stage, 60, 90);
    go_on(stage, &now_s, 0.3);
    const double ink = total(stage, 1);
    stage_picture(stage, 2 * WIDTH, 2 * HEIGHT, 1, &list);
    assert_int_equal(stage_mark(stage), STAGE_OK);
    assert_true(stage_hand(stage, STAGE_POINTER_DOWN, 40, 60, 0.8, 0, 0));
    go_on(stage, &now_s, 0.1);
    assert_true(stage_hand(stage, STAGE_POINTER_MOVE, 120, 60, 0.8, 0, 0));
    go_on(stage, &now_s, 0.1);
    const double painted = total(stage, 1);
    assert_true(painted > ink * 1.2);
    stage_hand(stage, STAGE_POINTER_UP, 120, 60, 0, 0, 0);
    go_on(stage, &now_s, 0.2);
    assert_true(total(stage, 1) == painted); /* it is lifted */
    assert_true(stage_undo(stage));
    assert_true(total(stage, 1) == ink);
    stage_draw_finish(&list);
    stage_destroy(stage);
}

/* Down and up again between two steps. */
static void a_tap_paints(void **unused)
{
    (void)unused;
    struct stage *stage = paper_stage();
    struct stage_draw_list list = {0};
    double now_s = 0;
    stage_picture(stage, 2 * WIDTH, 2 * HEIGHT, 1, &list);
    assert_true(stage_hand(stage, STAGE_POINTER_DOWN, 90, 60, 0.8, 0, 0));
    stage_hand(stage, STAGE_POINTER_UP, 90, 60, 0, 0, 0);
    go_on(stage, &now_s, 0.1);
    const double painted = total(stage, 1);
    assert_true(painted > 0);
    go_on(stage, &now_s, 0.1);
    assert_true(total(stage, 1) == painted);
    stage_draw_finish(&list);
    stage_destroy(stage);
}

static void a_resting_brush_does_not_flood(void **unused)
{
    (void)unused;
    static const char *const sets[] = {"brush_ink=0.5", "brush_water=0.8", "humidity=0"};
    struct stage *stage = paper_stage();
    double now_s = 0;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
        assert_int_equal(stage_set(stage, sets[i]), STAGE_OK);
    go_on(stage, &now_s, 0.1);
    const double ink = total(stage, 1), water = total(stage, 0);
    assert_true(ink > 0 && water > 0); /* it paints where it comes down */
    go_on(stage, &now_s, 3);
    assert_true(total(stage, 1) < 4 * ink && total(stage, 0) < 4 * water);
    stage_destroy(stage);
}

static void unknown_names_are_answered_with_the_known_ones(void **unused)
{
    (void)unused;
    struct stage_actor actor;
    struct paper_actor_def def = small_def();
    def.stock = "toast";
    assert_int_equal(paper_actor_create(&def, &actor), STAGE_BAD_ARGUMENT);
    assert_non_null(strstr(stage_error(), "there is no paper 'toast'; there are cold press"));
    def = small_def();
    def.pigments[1] = "mud";
    assert_int_equal(paper_actor_create(&def, &actor), STAGE_BAD_ARGUMENT);
    assert_non_null(strstr(stage_error(), "there is no pigment 'mud'; there are "));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_are_as_large_as_keys_are_struck),
        cmocka_unit_test(controls_lead_the_water),
        cmocka_unit_test(aftertouch_gives_water),
        cmocka_unit_test(a_map_leads_a_brush),
        cmocka_unit_test(a_hand_paints_and_takes_it_back),
        cmocka_unit_test(a_tap_paints),
        cmocka_unit_test(a_resting_brush_does_not_flood),
        cmocka_unit_test(unknown_names_are_answered_with_the_known_ones),
    };
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK)
        return 77;
    const int failed = cmocka_run_group_tests_name("paper actor", tests, NULL, NULL);
    font_face_close(face);
    return failed;
}
