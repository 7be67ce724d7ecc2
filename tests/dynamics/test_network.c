/* test_network.c - networks: masses and springs are read back as they were set; invalid ones
 * are refused with one line, and change nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <events.h>
#include <fields.h>
#include <math.h>
#include <network.h>
#include <step.h>

#include "sample.h"
#include "scenes.h"

static void refused(enum dyn_status status, enum dyn_status want, const char *text)
{
    if (status != want || strcmp(dyn_error(), text) != 0)
        fail_msg("status %d, \"%s\" instead of %d, \"%s\"", status, dyn_error(), want, text);
}

static void network_refuses_bad_springs(void **unused)
{
    (void)unused;
    struct dyn_network *n = scene_letter(0, 0, 10, 0);
    struct dyn_spring spring = dyn_spring_usual();
    spring.end[0] = 2, spring.end[1] = 2;
    refused(dyn_spring_add(n, &spring, NULL), DYN_BAD_ARGUMENT,
            "a spring cannot go from mass 2 to itself");
    spring.end[1] = 4;
    refused(dyn_spring_add(n, &spring, NULL), DYN_BAD_ARGUMENT,
            "a spring needs two masses, and there is no mass 4 (of 4)");
    spring.end[1] = 3;
    spring.constant = NAN;
    refused(dyn_spring_add(n, &spring, NULL), DYN_BAD_ARGUMENT,
            "constant must be 0..1e+09 kg/s2 (got nan)");
    spring.constant = -1;
    refused(dyn_spring_add(n, &spring, NULL), DYN_BAD_ARGUMENT,
            "constant must be 0..1e+09 kg/s2 (got -1)");
    assert_int_equal(dyn_springs_count(n), 6);
    dyn_network_destroy(n);
}

static void network_refuses_bad_masses(void **unused)
{
    (void)unused;
    struct dyn_network *n = scene_letter(0, 0, 10, 0);
    struct dyn_mass mass = dyn_mass_usual();
    static const double bad[] = {0, -1, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        mass.mass = bad[i];
        assert_int_equal(dyn_mass_add(n, &mass, NULL), DYN_BAD_ARGUMENT);
        assert_non_null(strstr(dyn_error(), "mass must be 1e-06..1e+06 kg"));
    }
    mass = dyn_mass_usual();
    mass.hold = 4;
    refused(dyn_mass_add(n, &mass, NULL), DYN_BAD_ARGUMENT,
            "a mass is free, stuck or held (got 4)");
    mass = dyn_mass_usual();
    mass.x = INFINITY;
    refused(dyn_mass_set(n, 2, &mass), DYN_BAD_ARGUMENT,
            "x must be -1e+06..1e+06 units (got inf)");
    refused(dyn_mass_set(n, 4, &mass), DYN_BAD_ARGUMENT, "there is no mass 4 (of 4)");
    assert_int_equal(dyn_masses_count(n), 4);
    assert_true(dyn_mass_get(n, 2).x == 0);
    dyn_network_destroy(n);
}

static void mass_has_so_many_springs_and_no_more(void **unused)
{
    (void)unused;
    struct dyn_network *n;
    scene_must(dyn_network_create(&n));
    struct dyn_mass mass = dyn_mass_usual();
    for (int i = 0; i < 2; i++)
        scene_must(dyn_mass_add(n, &mass, NULL));
    struct dyn_spring spring = dyn_spring_usual();
    spring.end[0] = 0, spring.end[1] = 1;
    for (int i = 0; i < DYN_DEGREE_MAX; i++)
        scene_must(dyn_spring_add(n, &spring, NULL));
    refused(dyn_spring_add(n, &spring, NULL), DYN_TOO_LARGE,
            "mass 0 has 4096 springs, and a mass has no more");
    dyn_network_destroy(n);
}

static void tables_name_ranges_and_choices(void **unused)
{
    (void)unused;
    struct dyn_world w = dyn_world_usual();
    double value;
    assert_null(dyn_control_find("gravy"));
    assert_non_null(
        strstr(dyn_error(), "there is no control 'gravy'; there are gravity, wind_x"));
    const struct control *integrator = dyn_control_find("integrator");
    scene_must(dyn_control_parse(integrator, "verlet", &value));
    assert_true(value == DYN_VERLET);
    refused(dyn_control_parse(integrator, "euler", &value), DYN_BAD_ARGUMENT,
            "integrator must be one of symplectic verlet thesis (got 'euler')");
    scene_must(dyn_control_parse(dyn_control_find("floor_on"), "off", &value));
    assert_true(value == 0);
    refused(dyn_control_parse(dyn_control_find("gravity"), "1e9", &value), DYN_BAD_ARGUMENT,
            "gravity must be -100..100 units/s2 (got 1e+09)");
    refused(dyn_control_write(integrator, &w, 0.5), DYN_BAD_ARGUMENT,
            "integrator must be a whole number of 0..2 (got 0.5)");
    for (int i = 0; i < dyn_controls_count; i++) {
        const struct control *c = &dyn_controls[i];
        assert_ptr_equal(dyn_control_find(c->name), c);
        assert_true(control_read(c, &w) == c->usual);
        assert_int_equal(dyn_control_write(c, &w, c->least), DYN_OK);
        assert_true(control_read(c, &w) == c->least);
        assert_int_equal(dyn_control_write(c, &w, c->most + 1), DYN_BAD_ARGUMENT);
        assert_true(control_read(c, &w) == c->least);
    }
    assert_int_equal(sizeof w,
                     (size_t)dyn_controls_count * sizeof(double)); /* none without a row */
}

/* A table may have any number of rows. */
static void rows_of_a_long_table_are_found(void **unused)
{
    enum { MANY = 64 };
    static char words[MANY][40];
    static struct control rows[MANY];
    char names[400];
    (void)unused;
    for (int i = 0; i < MANY; i++) {
        snprintf(words[i], sizeof words[i], "a_name_of_some_length_%04d", i);
        rows[i].name = words[i];
    }
    assert_null(control_find(rows, MANY, "none", names, sizeof names));
    assert_in_range(strlen(names), 350, sizeof names - 1);
    assert_string_equal(names + strlen(names) - 26, words[13]); /* 14 names of 26, 13 blanks */
    assert_ptr_equal(control_find(rows, MANY, words[40], names, sizeof names), &rows[40]);
}

/* Writes and reads all fields of masses and springs, one by one and all at once. */
static void fields_are_written_and_read(void **unused)
{
    (void)unused;
    /* the padding after the last member is not compared */
    const size_t whole = offsetof(struct dyn_mass, hold) + sizeof(unsigned);
    uint64_t state = 5;
    struct dyn_network *n = scene_by_chance(&state);
    while (dyn_masses_count(n) < 5) {
        dyn_network_destroy(n);
        n = scene_by_chance(&state);
    }
    for (int i = 0; i < dyn_mass_fields_count; i++) {
        const struct control *field = &dyn_mass_fields[i];
        struct dyn_mass before = dyn_mass_get(n, 2), other = dyn_mass_get(n, 3), now;
        scene_must(dyn_mass_write(n, 2, field, field->most));
        now = dyn_mass_get(n, 2);
        assert_true(control_read(field, &now) == field->most);
        dyn_control_write(field, &before, field->most);
        assert_memory_equal(&now, &before, whole);
        now = dyn_mass_get(n, 3);
        assert_memory_equal(&now, &other, whole);
        scene_must(dyn_mass_write(n, DYN_ALL, field, field->usual));
        for (int m = 0; m < dyn_masses_count(n); m++) {
            now = dyn_mass_get(n, m);
            assert_true(control_read(field, &now) == field->usual);
        }
    }
    for (int i = 0; i < dyn_spring_fields_count; i++) {
        const struct control *field = &dyn_spring_fields[i];
        double value = isfinite(field->most) ? field->most : 7;
        scene_must(dyn_spring_write(n, DYN_ALL, field, value));
        for (int s = 0; s < dyn_springs_count(n); s++) {
            struct dyn_spring now = dyn_spring_get(n, s);
            assert_true(control_read(field, &now) == value);
        }
    }
    assert_null(dyn_mass_field_find("weight"));
    assert_string_equal(dyn_error(),
                        "a mass has no 'weight'; it has x, y, vx, vy, mass, drag, gravity, "
                        "restitution, friction");
    dyn_network_destroy(n);
}

static void nearest_is_what_all_distances_say(void **unused)
{
    (void)unused;
    uint64_t state = 9;
    for (int round = 0; round < 200; round++) {
        struct dyn_network *n = scene_by_chance(&state);
        double x = scene_chance(&state, -1, 8), y = scene_chance(&state, -1, 8), within = 0.7;
        double least = within;
        int want = -1;
        for (int i = 0; i < dyn_masses_count(n); i++) {
            struct dyn_mass m = dyn_mass_get(n, i);
            if (hypot(m.x - x, m.y - y) < least) {
                least = hypot(m.x - x, m.y - y);
                want = i;
            }
        }
        assert_int_equal(dyn_network_nearest(n, x, y, within), want);
        int spring = dyn_network_nearest_spring(n, x, y, 100);
        assert_true(dyn_springs_count(n) == 0 || spring >= 0);
        if (spring >= 0) { /* none has a point that is nearer */
            struct dyn_spring s = dyn_spring_get(n, spring);
            double found = INFINITY, any = INFINITY;
            for (int i = 0; i < dyn_springs_count(n); i++) {
                s = dyn_spring_get(n, i);
                struct dyn_mass a = dyn_mass_get(n, s.end[0]), b = dyn_mass_get(n, s.end[1]);
                for (int t = 0; t <= 1000; t++) {
                    double px = a.x + (b.x - a.x) * t / 1000, py = a.y + (b.y - a.y) * t / 1000;
                    any = fmin(any, hypot(px - x, py - y));
                    if (i == spring)
                        found = fmin(found, hypot(px - x, py - y));
                }
            }
            assert_true(found < any + 0.01);
        }
        dyn_network_destroy(n);
    }
}

static void events_are_lost_only_when_many_wait(void **unused)
{
    (void)unused;
    struct dyn_network *n;
    struct dyn_event event;
    scene_must(dyn_network_create(&n));
    struct dyn_world w = dyn_world_usual();
    w.restitution = 1;
    scene_must(dyn_network_world_set(n, &w));
    enum { MANY = DYN_EVENTS_MAX + 100 };
    for (int i = 0; i < MANY; i++) {
        struct dyn_mass mass = dyn_mass_usual();
        mass.y = 0.01;
        mass.vy = -5;
        scene_must(dyn_mass_add(n, &mass, NULL));
    }
    scene_must(dyn_network_step(n, 0.01, 1));
    assert_int_equal(dyn_events_lost(n), 100);
    for (int i = 100; i < MANY; i++) {
        assert_int_equal(dyn_events_take(n, &event, 1), 1);
        assert_int_equal(event.mass, i);
    }
    assert_int_equal(dyn_events_take(n, &event, 1), 0);
    dyn_network_destroy(n);
}

static void steps_that_cannot_be_are_refused(void **unused)
{
    (void)unused;
    struct dyn_network *n = scene_letter(0, 0, 10, 0);
    static const double bad[] = {0, -1, NAN, INFINITY, 2};
    for (int i = 0; i < 5; i++)
        assert_int_equal(dyn_network_step(n, bad[i], 1), DYN_BAD_ARGUMENT);
    refused(dyn_network_step(n, 0.01, -1), DYN_BAD_ARGUMENT, "the count of steps cannot be -1");
    assert_true(dyn_network_time_s(n) == 0);
    struct dyn_network *empty;
    scene_must(dyn_network_create(&empty));
    scene_must(dyn_network_step(empty, 0.01, 10));
    assert_near(dyn_network_time_s(empty), 0.1, 1e-12);
    dyn_network_destroy(empty);
    dyn_network_destroy(n);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(network_refuses_bad_springs),
        cmocka_unit_test(network_refuses_bad_masses),
        cmocka_unit_test(mass_has_so_many_springs_and_no_more),
        cmocka_unit_test(tables_name_ranges_and_choices),
        cmocka_unit_test(rows_of_a_long_table_are_found),
        cmocka_unit_test(fields_are_written_and_read),
        cmocka_unit_test(nearest_is_what_all_distances_say),
        cmocka_unit_test(events_are_lost_only_when_many_wait),
        cmocka_unit_test(steps_that_cannot_be_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
