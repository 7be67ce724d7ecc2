/* test_quad.c - maps of the unit square onto quads: a million random quads, against a second
 * way to compute them, the inverse, and moving corners. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <math.h>
#include <quad.h>

#include "sample.h"
#include "scenes.h"

enum { MANY = 1000000 };

static const double square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

static void quad_by_chance(uint64_t *state, double q[4][2])
{
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 2; k++)
            q[i][k] = scene_chance(state, -1, 1);
}

/* Whether the quad is strictly convex: it turns to the same side at all corners. */
static bool convex(const double q[4][2])
{
    int left = 0, right = 0;
    for (int i = 0; i < 4; i++) {
        const double *a = q[i], *b = q[(i + 1) % 4], *c = q[(i + 2) % 4];
        double turn = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
        left += turn > 0;
        right += turn < 0;
    }
    return left == 4 || right == 4;
}

static void convex_by_chance(uint64_t *state, double q[4][2])
{
    do
        quad_by_chance(state, q);
    while (!convex(q));
}

/* Twice the area of the smallest triangle of three corners. */
static double least_triangle(const double q[4][2])
{
    double least = INFINITY;
    for (int i = 0; i < 4; i++) {
        const double *a = q[i], *b = q[(i + 1) % 4], *c = q[(i + 2) % 4];
        least =
            fmin(least, fabs((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])));
    }
    return least;
}

static double corners_miss(const struct dyn_quad_map *map, const double q[4][2])
{
    double most = 0, x, y;
    for (int i = 0; i < 4; i++) {
        assert_true(dyn_quad_point(map, square[i][0], square[i][1], &x, &y, NULL));
        most = fmax(most, hypot(x - q[i][0], y - q[i][1]));
    }
    return most;
}

static void matrix_point(const double m[4][4], double u, double v, double *x, double *y)
{
    double out[4];
    for (int i = 0; i < 4; i++)
        out[i] = u * m[0][i] + v * m[1][i] + m[3][i];
    *x = out[0] / out[3];
    *y = out[1] / out[3];
}

/* Mapped points are within 1e-12 for all million quads. The matrix is a difference of areas and
 * loses precision with them. It is within 1e-12 where the smallest triangle of three corners is
 * at least a thousandth, else within 1e-14 divided by its area. */
static void corners_of_a_million_quads_are_met(void **unused)
{
    (void)unused;
    uint64_t state = 31;
    double worst = 0, worst_matrix = 0;
    int fine = 0, kinds[3] = {0};
    for (int i = 0; i < MANY; i++) {
        double q[4][2], m[4][4], x, y, miss = 0;
        struct dyn_quad_map map;
        convex_by_chance(&state, q);
        assert_true(dyn_quad_make(&map, DYN_QUAD_PROJECTIVE, q));
        assert_true(map.condition > 0 && map.condition <= 1);
        worst = fmax(worst, corners_miss(&map, q));
        dyn_quad_matrix(&map, m);
        for (int k = 0; k < 4; k++) {
            matrix_point(m, square[k][0], square[k][1], &x, &y);
            miss = fmax(miss, hypot(x - q[k][0], y - q[k][1]));
        }
        assert_true(miss * least_triangle(q) < 1e-14);
        if (least_triangle(q) > 1e-3) {
            fine++;
            worst_matrix = fmax(worst_matrix, miss);
        }
        assert_true(dyn_quad_make(&map, DYN_QUAD_SMOOTH, q));
        kinds[map.kind]++;
        worst = fmax(worst, corners_miss(&map, q));
    }
    print_message("corners missed by %.2g, by the matrix by %.2g (of %d)\n", worst,
                  worst_matrix, fine);
    assert_true(worst < 1e-12 && worst_matrix < 1e-12);
    assert_true(fine > MANY * 9 / 10);
    for (int kind = 0; kind < 3; kind++)
        assert_true(kinds[kind] > MANY / 50);
}

/* The thesis's product meets the corners where its divisors are not small. It is then the same
 * map as ours at all points. */
static void thesis_meets_the_corners_of_a_million_quads(void **unused)
{
    (void)unused;
    uint64_t state = 32;
    double worst = 0;
    int met = 0;
    for (int i = 0; i < MANY; i++) {
        double q[4][2], m[4][4], x, y, ours_x, ours_y;
        struct dyn_quad_map map;
        convex_by_chance(&state, q);
        if (!dyn_quad_thesis(q, m))
            continue;
        assert_true(dyn_quad_make(&map, DYN_QUAD_PROJECTIVE, q));
        double shear = (q[3][0] - q[0][0]) * (q[1][1] - q[0][1]);
        double scale = (q[1][0] - q[0][0]) * (q[3][1] - q[0][1]);
        double divisor = fmin(fmin(fabs(q[1][0] - q[0][0]), fabs(q[3][1] - q[0][1])),
                              fmin(fabs(1 - shear / scale), fabs(m[3][3] / m[0][0])));
        if (divisor < 0.05 || map.condition < 0.01)
            continue;
        met++;
        for (int k = 0; k < 4; k++) {
            matrix_point(m, square[k][0], square[k][1], &x, &y);
            worst = fmax(worst, hypot(x - q[k][0], y - q[k][1]));
        }
        double u = scene_chance(&state, 0, 1), v = scene_chance(&state, 0, 1), mine[4][4];
        matrix_point(m, u, v, &x, &y);
        assert_true(dyn_quad_point(&map, u, v, &ours_x, &ours_y, NULL));
        assert_near(x, ours_x, 1e-10);
        assert_near(y, ours_y, 1e-10);
        dyn_quad_matrix(&map, mine);
        matrix_point(mine, u, v, &x, &y);
        assert_near(x, ours_x, 1e-13);
        assert_near(y, ours_y, 1e-13);
    }
    print_message("the thesis's misses corners by %.2g at most, of %d\n", worst, met);
    assert_true(worst < 1e-12);
    assert_true(met > MANY / 4);
}

/* For a letter that lies on its side the thesis's product divides by 0; our map is exact. */
static void turned_square_has_a_map(void **unused)
{
    (void)unused;
    for (int turns = 0; turns < 4; turns++) {
        double q[4][2], m[4][4], x, y;
        struct dyn_quad_map map;
        for (int i = 0; i < 4; i++)
            memcpy(q[i], square[(i + turns) % 4], sizeof q[i]);
        assert_int_equal(dyn_quad_thesis(q, m), turns % 2 == 0);
        assert_true(dyn_quad_make(&map, DYN_QUAD_PROJECTIVE, q));
        assert_true(map.condition == 1);
        assert_true(corners_miss(&map, q) == 0);
        assert_true(dyn_quad_point(&map, 0.5, 0.5, &x, &y, NULL));
        assert_true(x == 0.5 && y == 0.5);
    }
}

/* Only projective maps keep all lines straight. Bilinear maps keep equal parts of a side
 * equal. */
static void kinds_are_what_they_say(void **unused)
{
    (void)unused;
    uint64_t state = 33;
    for (int i = 0; i < 10000; i++) {
        double q[4][2], p[3][2];
        struct dyn_quad_map map;
        convex_by_chance(&state, q);
        assert_true(dyn_quad_make(&map, DYN_QUAD_PROJECTIVE, q));
        double u = scene_chance(&state, 0, 1), v = scene_chance(&state, 0, 1);
        double du = scene_chance(&state, 0, 1) - u, dv = scene_chance(&state, 0, 1) - v;
        for (int k = 0; k < 3; k++)
            dyn_quad_point(&map, u + k * du / 2, v + k * dv / 2, &p[k][0], &p[k][1], NULL);
        double off = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
                     (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        assert_true(map.condition < 1e-3 || fabs(off) < 1e-12);
        assert_true(dyn_quad_make(&map, DYN_QUAD_BILINEAR, q));
        dyn_quad_point(&map, u, v, &p[0][0], &p[0][1], NULL);
        for (int k = 0; k < 2; k++) {
            double low = q[0][k] + u * (q[1][k] - q[0][k]);
            double high = q[3][k] + u * (q[2][k] - q[3][k]);
            assert_near(p[0][k], low + v * (high - low), 1e-14);
        }
    }
}

static void points_come_back(void **unused)
{
    (void)unused;
    uint64_t state = 34;
    int kinds[3] = {0};
    for (int i = 0; i < 100000; i++) {
        double q[4][2], x, y, u, v, j[4];
        struct dyn_quad_map map;
        convex_by_chance(&state, q);
        assert_true(dyn_quad_make(&map, i % 2 ? DYN_QUAD_BILINEAR : DYN_QUAD_SMOOTH, q));
        kinds[map.kind]++;
        double u0 = scene_chance(&state, 0, 1), v0 = scene_chance(&state, 0, 1);
        assert_true(dyn_quad_point(&map, u0, v0, &x, &y, j));
        double det = fabs(j[0] * j[3] - j[1] * j[2]);
        if (det < 1e-3)
            continue; /* any point near is as good */
        if (!dyn_quad_inverse(&map, x, y, &u, &v))
            fail_msg("%d: (%g, %g) does not come back", i, u0, v0);
        assert_near(u, u0, 1e-9);
        assert_near(v, v0, 1e-9);
    }
    assert_true(kinds[0] > 10000 && kinds[1] > 10000 && kinds[2] > 1000);
}

static void jacobians_are_slopes(void **unused)
{
    (void)unused;
    uint64_t state = 35;
    for (int i = 0; i < 20000; i++) {
        double q[4][2], x[4], y[4], j[4], h = 1e-6;
        struct dyn_quad_map map;
        convex_by_chance(&state, q);
        assert_true(dyn_quad_make(&map, i % 3 ? DYN_QUAD_SMOOTH : DYN_QUAD_BILINEAR, q));
        double u = scene_chance(&state, 0.1, 0.9), v = scene_chance(&state, 0.1, 0.9);
        dyn_quad_point(&map, u + h, v, &x[0], &y[0], NULL);
        dyn_quad_point(&map, u - h, v, &x[1], &y[1], NULL);
        dyn_quad_point(&map, u, v + h, &x[2], &y[2], NULL);
        dyn_quad_point(&map, u, v - h, &x[3], &y[3], NULL);
        double there[2];
        dyn_quad_point(&map, u, v, &there[0], &there[1], j);
        assert_near(j[0], (x[0] - x[1]) / (2 * h), 1e-4);
        assert_near(j[1], (x[2] - x[3]) / (2 * h), 1e-4);
        assert_near(j[2], (y[0] - y[1]) / (2 * h), 1e-4);
        assert_near(j[3], (y[2] - y[3]) / (2 * h), 1e-4);
    }
}

/* A corner moves across the diagonal, which makes a dent, and back. All points move without a
 * jump. */
static void smooth_is_continuous_while_a_corner_moves(void **unused)
{
    (void)unused;
    enum { STEPS = 4000 };
    int kinds[3] = {0};
    double before[2] = {0}, most = 0;
    for (int i = 0; i <= STEPS; i++) {
        double q[4][2], at = 1.2 - 1.0 * i / STEPS, x, y;
        struct dyn_quad_map map;
        memcpy(q, square, sizeof q);
        q[2][0] = q[2][1] = at;
        assert_true(dyn_quad_make(&map, DYN_QUAD_SMOOTH, q));
        kinds[map.kind]++;
        assert_true(dyn_quad_point(&map, 0.8, 0.7, &x, &y, NULL));
        if (i > 0)
            most = fmax(most, hypot(x - before[0], y - before[1]));
        before[0] = x;
        before[1] = y;
    }
    assert_true(kinds[0] > 100 && kinds[1] > 100 && kinds[2] > 100);
    assert_true(most < 8.0 / STEPS); /* the corner itself goes 1.4 / STEPS */
}

static void condition_tells_dents_and_crossings(void **unused)
{
    (void)unused;
    static const struct {
        double q[4][2], condition;
    } cases[] = {
        {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 1},
        {{{0, 0}, {0, 1}, {1, 1}, {1, 0}}, 1},
        {{{0, 0}, {2, 0}, {3, 1}, {1, 1}}, 1},
        {{{0, 0}, {1, 0}, {0.5, 0.5}, {0, 1}}, 0},
        {{{0, 0}, {1, 0}, {0.25, 0.25}, {0, 1}}, -0.5},
        {{{0, 0}, {0, 0}, {0, 0}, {0, 0}}, 0},
        {{{0, 0}, {1, 0}, {0, 0}, {1, 0}}, 0},
        {{{0, 0}, {4, 0}, {4, 1}, {0, 3}}, 1 / 3.0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_near(dyn_quad_condition(cases[i].q), cases[i].condition, 1e-15);
    const double bow[4][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    assert_true(dyn_quad_condition(bow) < 0);
    const double nan[4][2] = {{0, 0}, {1, 0}, {NAN, 1}, {0, 1}};
    struct dyn_quad_map map;
    assert_false(dyn_quad_make(&map, DYN_QUAD_SMOOTH, nan));
    assert_false(dyn_quad_make(&map, DYN_QUAD_PROJECTIVE, bow));
    assert_true(dyn_quad_make(&map, DYN_QUAD_SMOOTH, bow));
    assert_int_equal(map.kind, DYN_QUAD_BILINEAR);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_of_a_million_quads_are_met),
        cmocka_unit_test(thesis_meets_the_corners_of_a_million_quads),
        cmocka_unit_test(turned_square_has_a_map),
        cmocka_unit_test(kinds_are_what_they_say),
        cmocka_unit_test(points_come_back),
        cmocka_unit_test(jacobians_are_slopes),
        cmocka_unit_test(smooth_is_continuous_while_a_corner_moves),
        cmocka_unit_test(condition_tells_dents_and_crossings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
