/* test_diffusion.c - compares the benchmark's peers with a plain double loop that has the
 * listing's operations. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "diffusion_oracle.h"
#include "harness.h"

enum { STEPS = 7 };

/* ---- the sheets ---- */

/* rim: the rectangle's distances from the left, top, right and bottom edge. */
static const struct {
    int width, height, rim[4];
} sheets[] = {
    {64, 64, {2, 2, 2, 2}},   {256, 40, {2, 2, 2, 2}},  {37, 29, {2, 2, 2, 2}},
    {5, 4, {0, 0, 0, 0}},     {100, 50, {0, 0, 0, 0}},  {16, 16, {0, 0, 0, 0}},
    {33, 17, {0, 0, 0, 0}},   {531, 9, {0, 3, 1, 0}},   {48, 48, {1, 1, 1, 1}},
    {50, 50, {17, 5, 16, 9}}, {300, 20, {20, 0, 1, 4}}, {65, 33, {0, 1, 0, 1}},
    {1031, 21, {3, 0, 0, 0}}, {15, 15, {7, 7, 7, 7}},   {47, 31, {0, 0, 1, 1}},
    {47, 31, {1, 1, 0, 0}},
};

enum { SHEETS_COUNT = sizeof sheets / sizeof *sheets };

static void openmp_agrees(void **state)
{
    (void)state;
    for (int n = 0; n < SHEETS_COUNT; n++) {
        struct diffusion_scene s;
        struct oracle o;

        oracle_scene_init(&s, sheets[n].width, sheets[n].height, sheets[n].rim);
        oracle_init(&o, &s);
        oracle_steps(&o, STEPS);
        float *mine = malloc((size_t)s.width * (size_t)s.height * sizeof *mine);
        struct diffusion_openmp *peer = diffusion_openmp_create(&s);
        assert_true(mine && peer);
        diffusion_openmp_steps(peer, 3);
        diffusion_openmp_steps(peer, STEPS - 3);
        for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
            diffusion_openmp_read(peer, i, mine);
            oracle_compare(&o, "openmp", i, mine);
        }
        diffusion_openmp_destroy(peer);
        free(mine);
        oracle_finish(&o);
        diffusion_scene_finish(&s);
    }
}

static void hand_agrees(enum diffusion_shape shape, const char *what)
{
    for (int n = 0; n < SHEETS_COUNT; n++) {
        struct diffusion_scene s;
        struct oracle o;

        oracle_scene_init(&s, sheets[n].width, sheets[n].height, sheets[n].rim);
        bool off_edges = s.x0 > 0 && s.y0 > 0 && s.x1 < s.width && s.y1 < s.height;
        if (shape == DIFFUSION_IN_PLACE && !off_edges) { /* it does not wrap */
            diffusion_scene_finish(&s);
            continue;
        }
        oracle_init(&o, &s);
        oracle_steps(&o, STEPS);
        float *mine = malloc((size_t)s.width * (size_t)s.height * sizeof *mine);
        struct diffusion_hand *peer = diffusion_hand_create(&s, NULL, shape);
        if (!mine || !peer)
            fail_msg("%s: %s", what, bench_error());
        assert_true(diffusion_hand_steps(peer, STEPS));
        for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
            assert_true(diffusion_hand_read(peer, i, mine));
            oracle_compare(&o, what, i, mine);
        }
        diffusion_hand_destroy(peer);
        free(mine);
        oracle_finish(&o);
        diffusion_scene_finish(&s);
    }
}

static void hand_streaming_agrees(void **state)
{
    (void)state;
    hand_agrees(DIFFUSION_STREAMING, "streaming");
}

static void hand_in_place_agrees(void **state)
{
    (void)state;
    hand_agrees(DIFFUSION_IN_PLACE, "in place");
}

static void hand_best_agrees(void **state)
{
    (void)state;
    hand_agrees(DIFFUSION_SHAPE_BEST, "best");
}

static void hand_unknown_device_fails(void **state)
{
    struct diffusion_scene s;

    (void)state;
    oracle_scene_init(&s, sheets[0].width, sheets[0].height, sheets[0].rim);
    assert_null(diffusion_hand_create(&s, "no such device", DIFFUSION_SHAPE_BEST));
    assert_non_null(strstr(bench_error(), "no such device"));
    diffusion_scene_finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(openmp_agrees),
        cmocka_unit_test(hand_streaming_agrees),
        cmocka_unit_test(hand_in_place_agrees),
        cmocka_unit_test(hand_best_agrees),
        cmocka_unit_test(hand_unknown_device_fails),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
