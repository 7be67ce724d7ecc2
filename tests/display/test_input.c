/* test_input.c - the queue of events, also when it is full, and the reports of pens. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <input.h>
#include <pen.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct input_queue queue;

static int finish(void **state)
{
    (void)state;
    input_queue_finish(&queue);
    return 0;
}

static bool put_key(enum input_kind kind, int key)
{
    return input_queue_put(&queue, &(struct input_event){.kind = kind, .key = key});
}

static bool put_move(double x, unsigned buttons)
{
    return input_queue_put(
        &queue,
        &(struct input_event){.kind = INPUT_POINTER_MOVE, .x_px = x, .buttons = buttons});
}

static void events_come_in_order(void **state)
{
    (void)state;
    struct input_event event;
    assert_false(input_queue_take(&queue, &event));
    assert_int_equal(event.kind, INPUT_NONE);
    int put = 0, taken = 0;
    for (int turn = 0; turn < 400; turn++) { /* several times around the ring */
        for (int i = 0; i < turn % 7 + 1; i++)
            assert_true(put_key(INPUT_KEY_DOWN, put++));
        for (int i = 0; i < turn % 7 + 1; i++) {
            assert_true(input_queue_take(&queue, &event));
            assert_int_equal(event.key, taken++);
        }
    }
    assert_false(input_queue_take(&queue, &event));
    assert_int_equal(queue.lost_count, 0);
}

/* The names of dropped files are valid until the next event is taken; the queue has its own
 * copies. */
static void paths_are_copied(void **state)
{
    (void)state;
    char path[] = "/tmp/one.ttf";
    struct input_event event;
    assert_true(
        input_queue_put(&queue, &(struct input_event){.kind = INPUT_DROP, .path = path}));
    path[5] = 'X';
    assert_true(
        input_queue_put(&queue, &(struct input_event){.kind = INPUT_DROP, .path = path}));
    assert_true(input_queue_take(&queue, &event));
    assert_string_equal(event.path, "/tmp/one.ttf");
    /* The queue frees the other path: the leak checker would notice. */
}

static void full_queues_keep_what_ends_something(void **state)
{
    (void)state;
    struct input_event event;
    int keys = 0, ups = 0;
    while (put_key(INPUT_KEY_DOWN, 'A'))
        keys++;
    assert_int_equal(queue.lost_count, 1);
    assert_false(put_move(1, 0));
    while (put_key(INPUT_KEY_UP, 'A'))
        ups++;
    assert_true(keys > INPUT_EVENTS_MAX / 2 && ups >= 32);
    /* There is always room for one closing and one size. */
    assert_int_equal(keys + ups, INPUT_EVENTS_MAX - 2);
    for (int i = 0; i < 3; i++) {
        assert_true(input_queue_put(&queue, &(struct input_event){.kind = INPUT_CLOSE}));
        assert_true(input_queue_put(&queue, &(struct input_event){.kind = INPUT_SIZE}));
    }
    assert_int_equal(queue.count, INPUT_EVENTS_MAX);
    while (input_queue_take(&queue, &event))
        keys -= event.kind == INPUT_KEY_DOWN, ups -= event.kind == INPUT_KEY_UP;
    assert_int_equal(keys, 0);
    assert_int_equal(ups, 0);
}

/* A few moves are all kept, because a stroke is made of them. When many wait, the last ones are
 * merged into one. */
static void moves_become_one_where_many_wait(void **state)
{
    (void)state;
    struct input_event event;
    int count = 0;
    for (int i = 0; i < 100; i++)
        assert_true(put_move(i, 1));
    assert_int_equal(queue.count, 100);
    for (int i = 100; i < 5000; i++)
        assert_true(put_move(i, 1));
    assert_true(queue.count <= INPUT_EVENTS_MAX / 2 + 1);
    assert_true(put_move(5000, 0)); /* another button is another movement */
    assert_int_equal(queue.lost_count, 0);
    double last = -1;
    while (input_queue_take(&queue, &event)) {
        assert_true(event.x_px > last);
        last = event.x_px;
        count++;
    }
    assert_true(last == 5000 && count > INPUT_EVENTS_MAX / 2);
}

static void of_sizes_the_newest_waits(void **state)
{
    (void)state;
    struct input_event event;
    for (int i = 1; i < 50; i++) {
        put_key(INPUT_KEY_DOWN, i);
        input_queue_put(&queue, &(struct input_event){.kind = INPUT_SIZE, .width_px = i});
    }
    int sizes = 0;
    while (input_queue_take(&queue, &event))
        if (event.kind == INPUT_SIZE) {
            sizes++;
            assert_int_equal(event.width_px, 49);
        }
    assert_int_equal(sizes, 1);
}

/* ---- pens ---- */

static const struct pen_axes wacom = {{2, 0, 2047}, {3, -64, 63}, {4, -64, 63}};

static void pens_report_changes(void **state)
{
    (void)state;
    struct pen_state pen = {0};
    pen_report(&wacom, (const unsigned char[]){0x1f}, 1,
               (const double[]){100, 200, 1023.5, -32, 64}, &pen);
    assert_true(pen.is_pen);
    assert_true(pen.pressure == 0.5 && pen.tilt_x == -0.5 && pen.tilt_y == 1);
    /* A report holds only what changed: pressure is then its first value. */
    pen_report(&wacom, (const unsigned char[]){0x04}, 1, (const double[]){2047}, &pen);
    assert_true(pen.pressure == 1 && pen.tilt_x == -0.5 && pen.tilt_y == 1);
    /* Values beyond their range, or NaN. */
    pen_report(&wacom, (const unsigned char[]){0x04}, 1, (const double[]){9999}, &pen);
    assert_true(pen.pressure == 1);
    pen_report(&wacom, (const unsigned char[]){0x04}, 1, (const double[]){NAN}, &pen);
    assert_true(pen.pressure == 1);
    /* A mask that is too short. */
    pen_report(&wacom, (const unsigned char[]){0x03}, 1, (const double[]){1, 2}, &pen);
    assert_true(pen.pressure == 1 && pen.tilt_y == 1);
}

static void mice_have_no_pressure(void **state)
{
    (void)state;
    static const struct pen_axes mouse = {{-1, 0, 0}, {-1, 0, 0}, {-1, 0, 0}};
    static const struct pen_axes broken = {{2, 5, 5}, {-1, 0, 0}, {-1, 0, 0}};
    struct pen_state pen = {true, 1, 1, 1};
    pen_report(&broken, (const unsigned char[]){0x04}, 1, (const double[]){5}, &pen);
    assert_true(pen.is_pen && pen.pressure == 1); /* a range of nothing says nothing */
    pen_report(&mouse, (const unsigned char[]){0x03}, 1, (const double[]){1, 2}, &pen);
    assert_false(pen.is_pen);
    assert_true(pen.pressure == 0 && pen.tilt_x == 0 && pen.tilt_y == 0);
    pen = pen_now(NULL);
    assert_false(pen.is_pen);
    pen_close(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(events_come_in_order, finish),
        cmocka_unit_test_teardown(paths_are_copied, finish),
        cmocka_unit_test_teardown(full_queues_keep_what_ends_something, finish),
        cmocka_unit_test_teardown(moves_become_one_where_many_wait, finish),
        cmocka_unit_test_teardown(of_sizes_the_newest_waits, finish),
        cmocka_unit_test(pens_report_changes),
        cmocka_unit_test(mice_have_no_pressure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
