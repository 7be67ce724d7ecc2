/* test_stage.c - a word of springs on a stage, without a window: time, controls, pointers,
 * pictures, undo. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <input.h>
#include <step.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene_springs.h"

static struct font_face *face;
static struct stage *stage;
static struct stage_draw_list list;

enum { WIDTH = 640, HEIGHT = 480 };

static int setup(void **state)
{
    (void)state;
    stage = scene_springs("word", 1, face);
    stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    return stage_frame(stage, 0, NULL) != STAGE_OK;
}

static int teardown(void **state)
{
    (void)state;
    stage_destroy(stage);
    stage_draw_finish(&list);
    return 0;
}

static struct dyn_network *network(void)
{
    struct stage_actor actor = stage_actor(stage);
    return stage_springs_network(&actor);
}

static struct dyn_mass mass(int i)
{
    return dyn_mass_get(network(), i);
}

static void set(const char *assignment)
{
    if (stage_set(stage, assignment) != STAGE_OK)
        fail_msg("%s", stage_error());
}

static double px_of(double x, double y, double *y_px)
{
    double x_px;
    stage_view_to_px(stage_view(stage), x, y, &x_px, y_px);
    return x_px;
}

/* Sends a pointer's event at a place of the world. */
static bool hand(enum stage_event_kind kind, double x, double y, double pressure, int button,
                 unsigned modifiers)
{
    double y_px, x_px = px_of(x, y, &y_px);
    return stage_hand(stage, kind, x_px, y_px, pressure, button, modifiers);
}

/* A film at any frame rate has the simulation's own steps. */
static void frames_are_steps_of_one_length(void **state)
{
    (void)state;
    struct stage *other = scene_springs("word", 1, face);
    struct stage_actor actor = stage_actor(other);
    struct dyn_network *alone = stage_springs_network(&actor);
    int steps, sum = 0;
    for (int frame = 1; frame <= 60; frame++) {
        assert_int_equal(stage_frame(stage, frame / 40.0, &steps), STAGE_OK);
        sum += steps;
    }
    assert_int_equal(sum, 360);
    assert_int_equal(dyn_network_step(alone, 1.0 / 240, 360), DYN_OK);
    assert_memory_equal(dyn_network_states(network()), dyn_network_states(alone),
                        16 * sizeof(struct dyn_state));
    assert_true(mass(0).y < 2); /* it fell */
    stage_destroy(other);
}

static void controls_are_the_stages_and_the_actors(void **state)
{
    (void)state;
    int count;
    const struct control *rows = stage_controls(stage, &count);
    for (int i = 0; i < count; i++) { /* each control has its default; names differ */
        if (fabs(control_read(&rows[i], stage) - rows[i].usual) > 1e-12)
            fail_msg("%s", rows[i].name);
        assert_int_equal(stage_control_write(&rows[i], stage, rows[i].usual), STAGE_OK);
        assert_ptr_equal(stage_control_find(rows, count, rows[i].name), &rows[i]);
        assert_true(rows[i].does[0] && rows[i].most > rows[i].least);
    }
    set("gravity=3.5");
    assert_true(dyn_network_world(network())->gravity == 3.5);
    set("integrator=verlet");
    assert_true(dyn_network_world(network())->integrator == DYN_VERLET);
    set("rate=0.5");
    assert_true(stage_clock(stage)->rate == 0.5);
    static const char *const wrong[] = {
        "gravity",          "=3",        "gravity=",  "gravity=1e9",
        "integrator=euler", "gravita=3", "floor_on=2"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(stage_set(stage, wrong[i]), STAGE_BAD_ARGUMENT);
        assert_null(strchr(stage_error(), '\n'));
    }
    assert_true(dyn_network_world(network())->gravity == 3.5);
}

static int items_of(enum stage_draw_kind kind)
{
    int count = 0;
    for (int i = 0; i < list.count; i++)
        count += list.items[i].kind == kind;
    return count;
}

static void pictures_show_what_is_set(void **state)
{
    (void)state;
    stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    assert_int_equal(items_of(STAGE_DRAW_GLYPH), 4);
    /* Bars: 16 masses, 4 x 6 + 3 x 2 springs, the floor. */
    assert_int_equal(items_of(STAGE_DRAW_BAR), 16 + 30 + 1);
    set("show_masses=off");
    set("show_springs=off");
    set("shadow=on");
    stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    assert_int_equal(items_of(STAGE_DRAW_GLYPH), 8);
    assert_int_equal(items_of(STAGE_DRAW_BAR), 1);
    set("grid=on");
    stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    assert_in_range(items_of(STAGE_DRAW_BAR), 5, 100);
    /* Lines are two pixels wide on a screen of twice the resolution. */
    set("grid=off");
    set("show_masses=on");
    stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    double radius = list.items[list.count - 1].bar.radius_px;
    stage_picture(stage, 2 * WIDTH, 2 * HEIGHT, 2, &list);
    assert_true(fabs(list.items[list.count - 1].bar.radius_px - 2 * radius) < 1e-9);
    assert_false(list.incomplete);
}

/* Pictures between steps extrapolate places: a falling mass is drawn lower by its fall in half
 * a step. */
static void pictures_are_between_steps(void **state)
{
    (void)state;
    set("show_springs=off");
    set("floor_on=off");
    assert_int_equal(stage_frame(stage, 48.0 / 240, NULL), STAGE_OK);
    stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    double at = list.items[list.count - 1].bar.y_px;
    assert_int_equal(stage_frame(stage, 48.5 / 240, NULL), STAGE_OK);
    stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    double ahead = list.items[list.count - 1].bar.y_px;
    double wanted = -mass(15).vy * 0.5 / 240 * stage_view(stage).scale;
    assert_true(wanted > 0.1 && fabs(ahead - at - wanted) < 1e-6);
}

static void skins_are_earlier_moments(void **state)
{
    (void)state;
    set("skins=3");
    set("skin_every=0.1");
    set("show_springs=off");
    double before[4];
    for (int frame = 1; frame <= 24; frame++) {
        assert_int_equal(stage_frame(stage, frame / 40.0, NULL), STAGE_OK);
        stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    }
    assert_int_equal(items_of(STAGE_DRAW_GLYPH), 4 + 3 * 4);
    /* The list goes from back to front: older traces are higher and fainter. */
    for (int i = 0; i < 4; i++) {
        struct font_point at;
        double jacobian[4];
        const struct stage_item *item = &list.items[4 * i + (i == 3 ? 1 : 0)];
        assert_int_equal(item->kind, STAGE_DRAW_GLYPH);
        assert_true(
            font_map_point(&item->glyph.map, (struct font_point){40, -40}, &at, jacobian));
        before[i] = at.y;
        if (i) {
            assert_true(before[i] > before[i - 1] || mass(0).vy > 0);
            assert_true(item->color.a > list.items[4 * (i - 1)].color.a);
        }
    }
    set("skins=0");
    stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    assert_int_equal(items_of(STAGE_DRAW_GLYPH), 4);
}

static void hands_pull_and_let_go(void **state)
{
    (void)state;
    double x = mass(0).x, y = mass(0).y;
    set("gravity=0");
    assert_true(hand(STAGE_POINTER_DOWN, x, y, 0, INPUT_BUTTON_LEFT, 0));
    for (int i = 1; i <= 20; i++) {
        assert_true(hand(STAGE_POINTER_MOVE, x - 0.1 * i, y + 0.05 * i, 0, 0, 0));
        assert_int_equal(stage_frame(stage, i / 60.0, NULL), STAGE_OK);
    }
    assert_true(mass(0).x < x - 0.3); /* it came along, behind the hand */
    assert_true(mass(0).x > x - 2.1);
    stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    int with_hand = items_of(STAGE_DRAW_BAR);
    assert_true(hand(STAGE_POINTER_UP, x - 2, y + 1, 0, INPUT_BUTTON_LEFT, 0));
    stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    assert_int_equal(items_of(STAGE_DRAW_BAR), with_hand - 1);
    assert_int_equal(mass(0).hold, DYN_FREE);
    assert_false(hand(STAGE_POINTER_MOVE, x, y, 0, 0, 0)); /* nobody has it */
    assert_int_equal(stage_frame(stage, 1, NULL), STAGE_OK);
}

static int sounds(const char *name)
{
    struct stage_sound sound[64];
    struct stage_actor actor = stage_actor(stage);
    int count = actor.kind->heard(actor.self, sound, 64), found = 0;
    for (int i = 0; i < count; i++)
        found += strcmp(sound[i].name, name) == 0;
    return found;
}

/* With Shift, or with a pen pressed hard, a mass moves to the pointer in the same frame, and
 * stays there. */
static void hands_tack(void **state)
{
    (void)state;
    static const struct {
        double pressure;
        unsigned modifiers;
    } ways[] = {{0, INPUT_SHIFT}, {0.9, 0}};
    double now_s = 0;
    for (int w = 0; w < 2; w++) {
        int m = 4 * w;
        double x = mass(m).x, y = mass(m).y;
        assert_true(hand(STAGE_POINTER_DOWN, x, y, 0.2, INPUT_BUTTON_LEFT, 0));
        hand(STAGE_POINTER_MOVE, x - 0.2, y + 0.9, ways[w].pressure, 0, ways[w].modifiers);
        assert_int_equal(stage_frame(stage, now_s += 1 / 60.0, NULL), STAGE_OK);
        assert_true(fabs(mass(m).x - (x - 0.2)) < 1e-9 && fabs(mass(m).y - (y + 0.9)) < 1e-9);
        assert_int_equal(mass(m).hold, DYN_HELD);
        sounds("");
        hand(STAGE_POINTER_UP, x - 0.2, y + 0.9, ways[w].pressure, INPUT_BUTTON_LEFT,
             ways[w].modifiers);
        assert_int_equal(sounds("click"), 1);
        assert_int_equal(mass(m).hold, DYN_STUCK);
        assert_int_equal(stage_frame(stage, now_s += 0.2, NULL), STAGE_OK);
        assert_true(fabs(mass(m).y - (y + 0.9)) < 1e-9);
    }
    /* A tacked mass that is moved without Shift stays tacked. */
    double x = mass(0).x, y = mass(0).y;
    hand(STAGE_POINTER_DOWN, x, y, 0, INPUT_BUTTON_LEFT, 0);
    hand(STAGE_POINTER_MOVE, x + 0.4, y, 0, 0, 0);
    hand(STAGE_POINTER_UP, x + 0.4, y, 0, INPUT_BUTTON_LEFT, 0);
    assert_true(fabs(mass(0).x - x - 0.4) < 1e-9 && mass(0).hold == DYN_STUCK);
    /* A touch with Shift frees the mass. */
    hand(STAGE_POINTER_DOWN, x + 0.4, y, 0, INPUT_BUTTON_LEFT, INPUT_SHIFT);
    hand(STAGE_POINTER_UP, x + 0.4, y, 0, INPUT_BUTTON_LEFT, INPUT_SHIFT);
    assert_int_equal(mass(0).hold, DYN_FREE);
}

static void hands_pull_whole_letters(void **state)
{
    (void)state;
    set("gravity=0");
    double x = mass(4).x + 0.5, y = mass(4).y - 0.6, before[4][2];
    for (int k = 0; k < 4; k++)
        before[k][0] = mass(4 + k).x, before[k][1] = mass(4 + k).y;
    assert_true(hand(STAGE_POINTER_DOWN, x, y, 0, INPUT_BUTTON_LEFT, 0));
    for (int i = 1; i <= 30; i++) {
        hand(STAGE_POINTER_MOVE, x + 0.02 * i, y + 0.05 * i, 0, 0, 0);
        assert_int_equal(stage_frame(stage, i / 60.0, NULL), STAGE_OK);
    }
    for (int k = 0; k < 4; k++) { /* the letter's four masses moved together */
        assert_true(mass(4 + k).y > before[k][1] + 0.4);
        assert_true(mass(4 + k).x > before[k][0]);
    }
    assert_true(fabs(mass(4).y - mass(5).y) < 0.5);
    hand(STAGE_POINTER_CANCEL, 0, 0, 0, 0, 0);
    assert_false(hand(STAGE_POINTER_MOVE, x, y, 0, 0, 0));
    /* Away from all letters the pointer takes nothing. */
    assert_false(hand(STAGE_POINTER_DOWN, 2, 6, 0, INPUT_BUTTON_LEFT, 0));
}

static int broken(void)
{
    int count = 0;
    for (int i = 0; i < dyn_springs_count(network()); i++)
        count += dyn_spring_get(network(), i).broken;
    return count;
}

static void strokes_cut(void **state)
{
    (void)state;
    double x = (mass(1).x + mass(4).x) / 2;
    sounds("");
    assert_true(hand(STAGE_POINTER_DOWN, x, 3, 0, INPUT_BUTTON_RIGHT, 0));
    assert_true(hand(STAGE_POINTER_MOVE, x, 1.6, 0, 0, 0)); /* the upper one of two */
    assert_int_equal(broken(), 1);
    hand(STAGE_POINTER_UP, x, 0.5, 0, INPUT_BUTTON_RIGHT, 0);
    assert_int_equal(broken(), 2);
    assert_int_equal(sounds("snap"), 2);
    stage_picture(stage, WIDTH, HEIGHT, 1, &list);
    assert_int_equal(items_of(STAGE_DRAW_BAR), 16 + 28 + 1);
}

static void what_is_done_is_undone(void **state)
{
    (void)state;
    double before = mass(0).y, x = (mass(1).x + mass(4).x) / 2;
    assert_false(stage_undo(stage));
    for (int round = 0; round < STAGE_UNDO_MAX + 10; round++)
        assert_int_equal(stage_mark(stage), STAGE_OK);
    assert_int_equal(stage_mark(stage), STAGE_OK);
    hand(STAGE_POINTER_DOWN, x, 3, 0, INPUT_BUTTON_RIGHT, 0);
    hand(STAGE_POINTER_UP, x, 0.5, 0, INPUT_BUTTON_RIGHT, 0);
    set("gravity=-3");
    set("grid=on");
    set("hand=77");
    assert_int_equal(stage_frame(stage, 0.2, NULL), STAGE_OK);
    assert_true(stage_undo(stage));
    assert_int_equal(broken(), 0);
    assert_true(mass(0).y == before);
    assert_true(dyn_network_world(network())->gravity == 9.81);
    int count;
    const struct control *rows = stage_controls(stage, &count);
    assert_true(control_read(stage_control_find(rows, count, "hand"), stage) == 300);
    assert_true(control_read(stage_control_find(rows, count, "grid"), stage) == 0);
    count = 0;
    while (stage_undo(stage))
        count++;
    assert_int_equal(count, STAGE_UNDO_MAX - 1);
}

static void reset_is_the_beginning(void **state)
{
    (void)state;
    double before = mass(3).y;
    assert_int_equal(stage_frame(stage, 0.25, NULL), STAGE_OK);
    set("gravity=1");
    double later = mass(3).y;
    assert_true(later < before);
    assert_int_equal(stage_reset(stage), STAGE_OK);
    assert_true(mass(3).y == before && dyn_network_world(network())->gravity == 9.81);
    assert_true(stage_undo(stage));
    assert_true(mass(3).y == later && dyn_network_world(network())->gravity == 1);
}

/* The same pointer events at the same frames give the same bits. */
static void hands_are_replayed_to_the_bit(void **state)
{
    (void)state;
    struct dyn_state first[16];
    for (int run = 0; run < 2; run++) {
        uint64_t chance = 9;
        double now_s = 0;
        if (run) {
            teardown(NULL);
            setup(NULL);
        }
        for (int i = 0; i < 300; i++) {
            chance = chance * 6364136223846793005u + 1442695040888963407u;
            double x = (double)(chance >> 40) / (1 << 24) * 6 - 1;
            double y = (double)(chance >> 30 & 0x3ff) / 256;
            enum stage_event_kind kind = (enum stage_event_kind)(chance >> 20 & 3);
            hand(kind, x, y, (double)(chance >> 16 & 15) / 16, (int)(chance >> 13 & 1),
                 (unsigned)(chance >> 12 & 1));
            assert_int_equal(stage_frame(stage, now_s += 1 / 60.0, NULL), STAGE_OK);
        }
        const struct dyn_state *now = dyn_network_states(network());
        if (run)
            assert_memory_equal(first, now, sizeof first);
        memcpy(first, now, sizeof first);
        for (int i = 0; i < 16; i++)
            assert_true(isfinite(now[i].x) && isfinite(now[i].y));
    }
}

static void wrong_letters_are_refused(void **state)
{
    (void)state;
    struct stage_springs_letter letter = {.masses = {0, 1, 2, 3}};
    struct stage_springs_def def = stage_springs_def_default();
    struct stage_actor actor;
    def.letters = &letter;
    def.letters_count = 1;
    assert_int_equal(dyn_network_create(&def.network), DYN_OK);
    assert_int_equal(stage_springs_create(&def, &actor), STAGE_BAD_ARGUMENT);
    assert_non_null(strstr(stage_error(), "stands on mass 0"));
    assert_int_equal(dyn_network_create(&def.network), DYN_OK);
    def.letters_count = 0;
    struct stage_def stage_def = stage_def_default();
    assert_int_equal(stage_springs_create(&def, &stage_def.actor), STAGE_OK);
    stage_def.theme = "/no/such/theme";
    struct stage *none;
    assert_int_equal(stage_create(&stage_def, &none), STAGE_BAD_FILE);
    assert_null(none);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(frames_are_steps_of_one_length),
        TEST(controls_are_the_stages_and_the_actors),
        TEST(pictures_show_what_is_set),
        TEST(pictures_are_between_steps),
        TEST(skins_are_earlier_moments),
        TEST(hands_pull_and_let_go),
        TEST(hands_tack),
        TEST(hands_pull_whole_letters),
        TEST(strokes_cut),
        TEST(what_is_done_is_undone),
        TEST(reset_is_the_beginning),
        TEST(hands_are_replayed_to_the_bit),
        TEST(wrong_letters_are_refused),
    };
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK)
        return 1;
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    font_face_close(face);
    return failed;
}
