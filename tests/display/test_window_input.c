/* test_window_input.c - actions in a window arrive as events: places, buttons, wheels, keys
 * with modifiers, text. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <window.h>

#include "xtest.h"

#include <X11/keysym.h>

static struct window *window;
static Window there;

/* The next event of this kind; skips others before it. */
static struct input_event next(enum input_kind kind)
{
    struct input_event event;
    do
        if (!window_input_take(window, 5, &event))
            fail_msg("no event of kind %d came", kind);
    while (event.kind != kind);
    return event;
}

static void settle(void)
{
    struct input_event event;
    while (window_input_take(window, 0.05, &event))
        ;
}

static void pointers_move_press_and_release(void **state)
{
    (void)state;
    static const struct {
        unsigned x11;
        int button;
    } buttons[] = {{1, INPUT_BUTTON_LEFT}, {2, INPUT_BUTTON_MIDDLE}, {3, INPUT_BUTTON_RIGHT}};
    settle();
    for (size_t i = 0; i < sizeof buttons / sizeof *buttons; i++) {
        int x = 40 + 30 * (int)i, y = 20 + 7 * (int)i;
        xtest_move(there, x, y);
        struct input_event event = next(INPUT_POINTER_MOVE);
        assert_true(event.x_px == x && event.y_px == y && event.buttons == 0);
        assert_false(event.pen);
        assert_true(event.pressure == 0);

        xtest_button(buttons[i].x11, true);
        event = next(INPUT_POINTER_DOWN);
        assert_int_equal(event.button, buttons[i].button);
        assert_int_equal(event.buttons, 1u << buttons[i].button);
        assert_true(event.x_px == x && event.y_px == y);

        /* While a button is held the window gets the pointer's moves beyond its edges. */
        xtest_move(there, x + 400, y + 5);
        event = next(INPUT_POINTER_MOVE);
        assert_true(event.x_px == x + 400 && event.y_px == y + 5);
        assert_int_equal(event.buttons, 1u << buttons[i].button);
        xtest_button(buttons[i].x11, false);
        event = next(INPUT_POINTER_UP);
        assert_int_equal(event.button, buttons[i].button);
        assert_int_equal(event.buttons, 0);
    }
}

/* A program that reads events late gets the press at its place, although the pointer has moved
 * since. */
static void late_presses_are_where_they_were(void **state)
{
    (void)state;
    xtest_move(there, 10, 10);
    settle();
    xtest_move(there, 60, 40);
    xtest_button(1, true);
    xtest_move(there, 200, 150);
    xtest_button(1, false);
    xtest_move(there, 20, 90);
    struct input_event event = next(INPUT_POINTER_DOWN);
    assert_true(event.x_px == 60 && event.y_px == 40);
    event = next(INPUT_POINTER_UP);
    assert_true(event.x_px == 200 && event.y_px == 150);
}

static void wheels_scroll(void **state)
{
    (void)state;
    xtest_move(there, 50, 50);
    settle();
    for (unsigned button = 4; button <= 5; button++) {
        xtest_button(button, true);
        xtest_button(button, false);
        struct input_event event = next(INPUT_SCROLL);
        assert_true(event.scroll_x == 0 && event.scroll_y == (button == 4 ? 1 : -1));
        assert_true(event.x_px == 50 && event.y_px == 50);
    }
}

static void modifiers_are_those_held(void **state)
{
    (void)state;
    settle();
    xtest_key(XK_Shift_L, true);
    assert_int_equal(next(INPUT_KEY_DOWN).modifiers, INPUT_SHIFT);
    xtest_type(XK_a);
    struct input_event event = next(INPUT_KEY_DOWN);
    assert_true(event.key == 'A' && event.modifiers == INPUT_SHIFT);
    assert_int_equal(next(INPUT_TEXT).character, 'A');
    xtest_button(1, true);
    assert_int_equal(next(INPUT_POINTER_DOWN).modifiers, INPUT_SHIFT);
    xtest_key(XK_Shift_L, false);
    do
        event = next(INPUT_KEY_UP);
    while (event.key != INPUT_KEY_SHIFT);
    assert_int_equal(event.modifiers, 0);
    xtest_button(1, false);
    assert_int_equal(next(INPUT_POINTER_UP).modifiers, 0);
    xtest_type(XK_a);
    assert_int_equal(next(INPUT_TEXT).character, 'a');
}

static void held_keys_repeat(void **state)
{
    (void)state;
    settle();
    xtest_key(XK_Right, true);
    assert_int_equal(next(INPUT_KEY_DOWN).key, INPUT_KEY_RIGHT);
    assert_int_equal(next(INPUT_KEY_REPEAT).key, INPUT_KEY_RIGHT);
    xtest_key(XK_Right, false);
    assert_int_equal(next(INPUT_KEY_UP).key, INPUT_KEY_RIGHT);
}

/* Without a window manager a window fills the screen, and then returns to its place and
 * size. */
static void windows_fill_the_screen_and_go_back(void **state)
{
    (void)state;
    int width, height;
    settle();
    window_fullscreen_set(window, true);
    assert_true(window_fullscreen(window));
    struct input_event event = next(INPUT_SIZE);
    assert_true(event.width_px == 800 && event.height_px == 600);
    window_fullscreen_set(window, false);
    assert_false(window_fullscreen(window));
    event = next(INPUT_SIZE);
    window_size(window, &width, &height);
    assert_true(event.width_px == 300 && event.height_px == 200 && width == 300 &&
                height == 200);
    assert_true(window_scale(window) == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pointers_move_press_and_release),
        cmocka_unit_test(late_presses_are_where_they_were),
        cmocka_unit_test(wheels_scroll),
        cmocka_unit_test(modifiers_are_those_held),
        cmocka_unit_test(held_keys_repeat),
        cmocka_unit_test(windows_fill_the_screen_and_go_back),
    };
    struct window_config config = window_config_default();
    config.title = "hand";
    config.width_px = 300;
    config.height_px = 200;
    if (!screen_start("800x600"))
        return 77;
    int failed = window_create(&config, &window) != DISPLAY_OK;
    there = failed ? 0 : screen_window("hand", 10);
    if (there)
        failed = cmocka_run_group_tests(tests, NULL, NULL);
    window_destroy(window);
    screen_end();
    return there ? failed : 1;
}
