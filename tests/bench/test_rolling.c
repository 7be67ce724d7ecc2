/* test_rolling.c - compares the yardsticks in rolling rows, in OpenCL and in C, with the
 * oracle: bit for bit, except the relaxed ones. */
#include <math.h>
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
#include "rolling.h"

/* rim: the rectangle's distances from the left, top, right and bottom edge; steps: those of two
 * calls; tiling: the size of the sheet's pieces. */
static const struct {
    int width, height, rim[4], steps[2];
    struct rolling_tiling tiling;
    float gravity;
} cases[] = {
    {64, 64, {2, 2, 2, 2}, {4, 3}, {4, 1, 1}, 1.25f},
    {256, 40, {2, 2, 2, 2}, {8, 1}, {8, 2, 3}, 1.25f},
    {37, 29, {2, 2, 2, 2}, {1, 0}, {1, 1, 2}, 1.25f},
    {5, 4, {1, 1, 0, 0}, {17, 0}, {15, 1, 1}, 1.25f},
    {4, 4, {3, 3, 0, 0}, {3, 2}, {2, 1, 1}, 1.25f},
    {100, 50, {1, 1, 0, 0}, {2, 11}, {3, 1, 4}, 0.75f},
    {531, 9, {1, 3, 1, 0}, {15, 2}, {15, 8, 1}, 1.0f},
    {48, 48, {1, 1, 1, 1}, {5, 5}, {5, 1, 46}, 1.25f},
    {50, 50, {17, 5, 16, 9}, {6, 0}, {6, 1, 7}, 3.7f},
    {300, 20, {20, 1, 1, 4}, {7, 7}, {7, 4, 2}, 1.25f},
    {1031, 21, {3, 1, 0, 0}, {9, 8}, {12, 16, 2}, 0.3f},
    {15, 15, {7, 7, 7, 7}, {10, 0}, {4, 1, 1}, 1.25f},
    {18, 90, {1, 1, 1, 1}, {14, 3}, {14, 1, 5}, 1.25f},
    {275, 131, {2, 2, 1, 3}, {13, 4}, {13, 4, 3}, 1.25f},
    {145, 33, {1, 2, 0, 0}, {16, 0}, {11, 2, 2}, 1.25f},
    {132, 132, {2, 2, 2, 2}, {12, 5}, {10, 2, 2}, 1.25f},
};

enum { CASES_COUNT = sizeof cases / sizeof *cases };

static void scene_make(int n, struct diffusion_scene *s)
{
    oracle_scene_init(s, cases[n].width, cases[n].height, cases[n].rim);
    s->gravity = cases[n].gravity;
    for (int k = 0; k < s->width * s->height; k += 7) /* dry places, and full ones */
        s->field[k / 7 % DIFFUSION_FIELDS_COUNT][k] = k % 3 ? 0.0f : 1.0f;
}

/* Numbers between 0 and 1 are rounded by 6e-8 at most, and a step of diffusion makes the error
 * only a few times larger. */
static void compare_relaxed(const struct oracle *o, const char *what, int n, int field,
                            const float *mine)
{
    const struct diffusion_scene *s = o->s;

    for (int k = 0; k < s->width * s->height; k++)
        if (!(fabsf(mine[k] - o->field[field][k]) <=
              1e-6f * (float)(cases[n].steps[0] + cases[n].steps[1])))
            fail_msg("%s, case %d: field %d, row %d, column %d: %a, the oracle has %a", what, n,
                     field, k / s->width, k % s->width, (double)mine[k],
                     (double)o->field[field][k]);
}

static void hand_agrees(enum diffusion_rolling_kind kind, const char *what, bool relaxed)
{
    for (int n = 0; n < CASES_COUNT; n++) {
        struct diffusion_scene s;
        struct oracle o;

        if (relaxed && n % 3) /* only the arithmetic differs: one gravity, one build */
            continue;
        scene_make(n, &s);
        if (relaxed)
            s.gravity = 1.25f;
        oracle_init(&o, &s);
        oracle_steps(&o, cases[n].steps[0] + cases[n].steps[1]);
        float *mine = malloc((size_t)s.width * (size_t)s.height * sizeof *mine);
        struct diffusion_rolling *peer =
            diffusion_rolling_create(&s, NULL, kind, &cases[n].tiling);
        if (!mine || !peer)
            fail_msg("%s: %s", what, bench_error());
        for (int i = 0; i < 2; i++)
            assert_true(diffusion_rolling_steps(peer, cases[n].steps[i]));
        for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
            assert_true(diffusion_rolling_read(peer, i, mine));
            if (relaxed)
                compare_relaxed(&o, what, n, i, mine);
            else
                oracle_compare(&o, what, i, mine);
        }
        diffusion_rolling_destroy(peer);
        free(mine);
        oracle_finish(&o);
        diffusion_scene_finish(&s);
    }
}

static void single_pass_agrees(void **state)
{
    (void)state;
    hand_agrees(DIFFUSION_SINGLE_PASS, "single pass", false);
}

static void single_pass_relaxed_is_near(void **state)
{
    (void)state;
    hand_agrees(DIFFUSION_SINGLE_PASS_RELAXED, "single pass relaxed", true);
}

static void time_tiled_agrees(void **state)
{
    (void)state;
    hand_agrees(DIFFUSION_TIME_TILED, "time-tiled", false);
}

static void time_tiled_relaxed_is_near(void **state)
{
    (void)state;
    hand_agrees(DIFFUSION_TIME_TILED_RELAXED, "time-tiled relaxed", true);
}

static void openmp_agrees_with(int n, const struct rolling_tiling *tiling)
{
    struct diffusion_scene s;
    struct oracle o;

    scene_make(n, &s);
    oracle_init(&o, &s);
    oracle_steps(&o, cases[n].steps[0] + cases[n].steps[1]);
    float *mine = malloc((size_t)s.width * (size_t)s.height * sizeof *mine);
    struct diffusion_openmp_rolling *peer = diffusion_openmp_rolling_create(&s, tiling);
    if (!mine || !peer)
        fail_msg("openmp time-tiled: %s", bench_error());
    for (int i = 0; i < 2; i++)
        assert_true(diffusion_openmp_rolling_steps(peer, cases[n].steps[i]));
    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
        diffusion_openmp_rolling_read(peer, i, mine);
        oracle_compare(&o, "openmp time-tiled", i, mine);
    }
    diffusion_openmp_rolling_destroy(peer);
    free(mine);
    oracle_finish(&o);
    diffusion_scene_finish(&s);
}

static void openmp_agrees(void **state)
{
    (void)state;
    for (int n = 0; n < CASES_COUNT; n++)
        openmp_agrees_with(n, &cases[n].tiling);
}

/* Every number of steps in a call, up to the most. */
static void openmp_agrees_for_any_steps(void **state)
{
    (void)state;
    for (int steps = 1; steps <= ROLLING_STEPS_MAX; steps++)
        openmp_agrees_with(13, &(struct rolling_tiling){steps, 1 + steps % 4, 1 + steps % 3});
}

/* The measurement does not change the sheet, and the sizes that it chooses can run. */
static void tuned_agrees(void **state)
{
    (void)state;
    openmp_agrees_with(15, NULL);
}

static void rectangle_at_the_edge_is_refused(void **state)
{
    struct diffusion_scene s;

    (void)state;
    assert_true(diffusion_scene_init(&s, 8, 8));
    s.x0 = 0;
    assert_null(diffusion_openmp_rolling_create(&s, NULL));
    assert_non_null(strstr(bench_error(), "begins at column 0, row 2"));
    assert_null(diffusion_rolling_create(&s, NULL, DIFFUSION_TIME_TILED, NULL));
    diffusion_scene_finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(openmp_agrees),
        cmocka_unit_test(openmp_agrees_for_any_steps),
        cmocka_unit_test(tuned_agrees),
        cmocka_unit_test(single_pass_agrees),
        cmocka_unit_test(single_pass_relaxed_is_near),
        cmocka_unit_test(time_tiled_agrees),
        cmocka_unit_test(time_tiled_relaxed_is_near),
        cmocka_unit_test(rectangle_at_the_edge_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
