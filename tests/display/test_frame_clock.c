/* test_frame_clock.c - the frame clock, with times that the test gives it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <frame_clock.h>

#include <math.h>

static bool near(double a, double b)
{
    return fabs(a - b) < 1e-9;
}

/* After frames of random lengths the clock has made all steps that fit into the time, and
 * carries the remainder. */
static void steps_follow_real_time(void **state)
{
    (void)state;
    struct frame_clock clock = frame_clock_begin(1 / 240.0, 50);
    uint64_t random = 7;
    double now_s = 50;
    int64_t steps = 0;
    for (int i = 0; i < 100000; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        now_s += 0.04 * (double)(random >> 40) / (1 << 24);
        steps += frame_clock_advance(&clock, now_s);
        assert_int_equal(steps, clock.steps_count);
        assert_true(clock.carried_s >= 0 && clock.carried_s < clock.step_s * (1 + 1e-6));
        assert_true(frame_clock_fraction(&clock) >= 0 && frame_clock_fraction(&clock) <= 1);
    }
    assert_true(fabs(frame_clock_time_s(&clock) - (now_s - 50)) < 1e-6);
    assert_true(clock.lost_s == 0);
}

/* Each frame of a film has the same whole number of steps, in spite of rounding. */
static void films_have_the_same_steps_in_each_frame(void **state)
{
    (void)state;
    static const int fps[] = {24, 25, 30, 60};
    for (size_t k = 0; k < sizeof fps / sizeof *fps; k++) {
        struct frame_clock clock = frame_clock_begin(1.0 / (fps[k] * 8), 0);
        for (int i = 1; i <= 20000; i++)
            assert_int_equal(frame_clock_advance(&clock, (double)i / fps[k]), 8);
    }
}

static void slow_motion_makes_fewer_steps(void **state)
{
    (void)state;
    struct frame_clock clock = frame_clock_begin(0.01, 0);
    assert_int_equal(frame_clock_advance(&clock, 0.1), 10);
    frame_clock_rate_set(&clock, 0.25);
    assert_int_equal(frame_clock_advance(&clock, 0.2), 2);
    assert_true(near(frame_clock_fraction(&clock), 0.5)); /* half a step is carried */
    assert_int_equal(frame_clock_advance(&clock, 0.3), 3);
    frame_clock_rate_set(&clock, 2);
    assert_int_equal(frame_clock_advance(&clock, 0.4), 20);
    assert_true(near(frame_clock_time_s(&clock), 0.35));
    frame_clock_rate_set(&clock, 0);
    assert_true(clock.rate == FRAME_CLOCK_RATE_MIN);
    frame_clock_rate_set(&clock, 1e9);
    assert_true(clock.rate == FRAME_CLOCK_RATE_MAX);
}

static void paused_clocks_take_single_steps(void **state)
{
    (void)state;
    struct frame_clock clock = frame_clock_begin(0.01, 0);
    frame_clock_advance(&clock, 0.1);
    clock.paused = true;
    assert_int_equal(frame_clock_advance(&clock, 0.15), 0);
    assert_true(isinf(frame_clock_wait_s(&clock, 0.2)));
    frame_clock_single(&clock);
    frame_clock_single(&clock);
    assert_int_equal(frame_clock_advance(&clock, 0.2), 2);
    assert_int_equal(frame_clock_advance(&clock, 0.25), 0);
    assert_true(near(frame_clock_time_s(&clock), 0.12));
    /* The steps of the paused time are not made afterwards. */
    clock.paused = false;
    assert_int_equal(frame_clock_advance(&clock, 0.27), 2);
    frame_clock_single(&clock);
    assert_true(clock.paused);
}

static void long_frames_lose_time(void **state)
{
    (void)state;
    struct frame_clock clock = frame_clock_begin(0.01, 0);
    assert_int_equal(frame_clock_advance(&clock, 100), 25);
    assert_true(near(clock.lost_s, 99.75));
    assert_int_equal(frame_clock_advance(&clock, 99), 0); /* time does not go back */
    assert_int_equal(frame_clock_advance(&clock, 100.05), 5);
    assert_true(clock.frame_longest_s == 100);
    clock.frame_max_s = INFINITY;
    assert_int_equal(frame_clock_advance(&clock, 200.05), 10000);
}

static void frames_are_measured(void **state)
{
    (void)state;
    struct frame_clock clock = frame_clock_begin(0.01, 0);
    assert_true(clock.frame_s == 0);
    for (int i = 1; i <= 200; i++)
        frame_clock_advance(&clock, i / 50.0);
    assert_true(near(clock.frame_s, 0.02));
    for (int i = 1; i <= 200; i++)
        frame_clock_advance(&clock, 4 + i / 100.0);
    assert_true(fabs(clock.frame_s - 0.01) < 1e-5);
}

/* The waiting time for each moment of a recording is right at any rate and with pauses. */
static void moments_are_waited_for(void **state)
{
    (void)state;
    struct frame_clock clock = frame_clock_begin(0.001, 10);
    assert_true(frame_clock_wait_s(&clock, 0) == 0);
    assert_true(near(frame_clock_wait_s(&clock, 0.9), 0.9));
    frame_clock_advance(&clock, 10.2);
    assert_true(near(frame_clock_wait_s(&clock, 0.9), 0.7));
    frame_clock_rate_set(&clock, 0.5);
    assert_true(near(frame_clock_wait_s(&clock, 0.9), 1.4));
    frame_clock_advance(&clock, 10.4);
    frame_clock_rate_set(&clock, 1);
    assert_true(near(frame_clock_wait_s(&clock, 0.9), 0.6));
    clock.frame_max_s = 10;
    frame_clock_advance(&clock, 11);
    assert_true(frame_clock_wait_s(&clock, 0.9) == 0);
    frame_clock_skip(&clock, 3600.0005);
    assert_true(near(frame_clock_time_s(&clock), 3600.0005));
    assert_true(near(clock.carried_s, 0.0005));
    frame_clock_skip(&clock, 5); /* it was */
    assert_true(near(frame_clock_time_s(&clock), 3600.0005));
}

static void pictures_leave_time(void **state)
{
    (void)state;
    struct frame_pace pace = {.least_s = 0.04};
    assert_true(pace.due_s == 0);
    frame_pace_drawn(&pace, 1, 1.01);
    assert_true(near(pace.due_s, 1.04)); /* a quick picture: the rate is limited */
    frame_pace_drawn(&pace, 2, 2.3);
    assert_true(near(pace.due_s, 2.6)); /* a slow one: a pause as long as it took */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_follow_real_time),
        cmocka_unit_test(films_have_the_same_steps_in_each_frame),
        cmocka_unit_test(slow_motion_makes_fewer_steps),
        cmocka_unit_test(paused_clocks_take_single_steps),
        cmocka_unit_test(long_frames_lose_time),
        cmocka_unit_test(frames_are_measured),
        cmocka_unit_test(moments_are_waited_for),
        cmocka_unit_test(pictures_leave_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
