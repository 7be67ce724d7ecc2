/* test_diffusion.c - the benchmark's peers against a plain double loop, operation by operation
 * as the listing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "harness.h"
#include "scene.h"

enum { STEPS = 7 };

/* ---- the oracle ---- */

struct oracle {
    const struct diffusion_scene *s;
    float *field[DIFFUSION_FIELDS_COUNT], *inflow, *inward, *outward;
};

static size_t neighbour(const struct diffusion_scene *s, int x, int y, int axis, int distance)
{
    if (axis == 0)
        x = (x + distance + s->width) % s->width;
    else
        y = (y + distance + s->height) % s->height;
    return (size_t)y * (size_t)s->width + (size_t)x;
}

#define EACH_ACTIVE(s)                                                                         \
    for (int y = (s)->y0; y < (s)->y1; y++)                                                    \
        for (int x = (s)->x0; x < (s)->x1; x++)

static void oracle_substance(struct oracle *o, int which, int axis)
{
    const struct diffusion_scene *s = o->s;
    float *f = o->field[which];

    EACH_ACTIVE(s) o->inflow[neighbour(s, x, y, 0, 0)] = f[neighbour(s, x, y, axis, -1)];
    EACH_ACTIVE(s)
    {
        size_t k = neighbour(s, x, y, 0, 0);
        float t = o->inflow[k] - f[k];

        t *= s->absorbency[k];
        if (which) {
            t *= o->field[DIFFUSION_WATER][k];
            t *= s->molecular_weight[which - 1];
        }
        if (t > 0.0f)
            t *= s->gravity;
        if (t < 0.0f)
            t /= s->gravity;
        o->inward[k] = t;
    }
    EACH_ACTIVE(s)
    o->outward[neighbour(s, x, y, 0, 0)] = o->inward[neighbour(s, x, y, axis, 1)];
    EACH_ACTIVE(s)
    {
        size_t k = neighbour(s, x, y, 0, 0);
        float t = f[k] + o->inward[k];

        t -= o->outward[k];
        t = t < 1.0f ? t : 1.0f;
        f[k] = t > 0.0f ? t : 0.0f;
    }
}

static void oracle_init(struct oracle *o, const struct diffusion_scene *s)
{
    size_t count = (size_t)s->width * (size_t)s->height, bytes = count * sizeof(float);
    float **const temporaries[] = {&o->inflow, &o->inward, &o->outward};

    o->s = s;
    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
        o->field[i] = malloc(bytes);
        assert_non_null(o->field[i]);
        memcpy(o->field[i], s->field[i], bytes);
    }
    for (int i = 0; i < 3; i++) {
        *temporaries[i] = calloc(count, sizeof(float));
        assert_non_null(*temporaries[i]);
    }
    for (int step = 0; step < STEPS; step++)
        for (int axis = 0; axis < 2; axis++)
            for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++)
                oracle_substance(o, i, axis);
}

static void oracle_finish(struct oracle *o)
{
    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++)
        free(o->field[i]);
    free(o->inflow);
    free(o->inward);
    free(o->outward);
}

static void compare(const struct oracle *o, const char *what, int field, const float *mine)
{
    const struct diffusion_scene *s = o->s;

    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) {
            size_t k = neighbour(s, x, y, 0, 0);
            if (memcmp(&mine[k], &o->field[field][k], sizeof mine[k]))
                fail_msg("%s, %dx%d, rectangle %d..%d by %d..%d: field %d, row %d, column %d: "
                         "%a, the "
                         "oracle has %a",
                         what, s->width, s->height, s->x0, s->x1, s->y0, s->y1, field, y, x,
                         (double)mine[k], (double)o->field[field][k]);
        }
}

/* ---- the sheets ---- */

/* The rectangle's distance from each edge: left, top, right, bottom. */
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

static void scene_make(int n, struct diffusion_scene *s)
{
    const int *rim = sheets[n].rim;

    assert_true(diffusion_scene_init(s, sheets[n].width, sheets[n].height));
    s->x0 = rim[0];
    s->y0 = rim[1];
    s->x1 = s->width - rim[2];
    s->y1 = s->height - rim[3];
}

static void openmp_agrees(void **state)
{
    (void)state;
    for (int n = 0; n < SHEETS_COUNT; n++) {
        struct diffusion_scene s;
        struct oracle o;

        scene_make(n, &s);
        oracle_init(&o, &s);
        float *mine = malloc((size_t)s.width * (size_t)s.height * sizeof *mine);
        struct diffusion_openmp *peer = diffusion_openmp_create(&s);
        assert_true(mine && peer);
        diffusion_openmp_steps(peer, 3);
        diffusion_openmp_steps(peer, STEPS - 3);
        for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
            diffusion_openmp_read(peer, i, mine);
            compare(&o, "openmp", i, mine);
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

        scene_make(n, &s);
        bool off_edges = s.x0 > 0 && s.y0 > 0 && s.x1 < s.width && s.y1 < s.height;
        if (shape == DIFFUSION_IN_PLACE && !off_edges) { /* it does not wrap */
            diffusion_scene_finish(&s);
            continue;
        }
        oracle_init(&o, &s);
        float *mine = malloc((size_t)s.width * (size_t)s.height * sizeof *mine);
        struct diffusion_hand *peer = diffusion_hand_create(&s, NULL, shape);
        if (!mine || !peer)
            fail_msg("%s: %s", what, bench_error());
        assert_true(diffusion_hand_steps(peer, STEPS));
        for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
            assert_true(diffusion_hand_read(peer, i, mine));
            compare(&o, what, i, mine);
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
    scene_make(0, &s);
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
