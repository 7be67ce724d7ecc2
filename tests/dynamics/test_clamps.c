/* test_clamps.c - clamps move masses along keys. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <clamps.h>
#include <hand.h>
#include <math.h>
#include <step.h>

#include "sample.h"
#include "scenes.h"

static struct dyn_clamps *clamps_make(void)
{
    struct dyn_clamps *c;
    scene_must(dyn_clamps_create(&c));
    return c;
}

static void keys_are_met_and_the_way_is_smooth(void **unused)
{
    (void)unused;
    struct dyn_clamps *c = clamps_make();
    double times[8], xs[8], ys[8], x, y;
    uint64_t state = 3;
    for (int i = 0; i < 8; i++) {
        times[i] = i + scene_chance(&state, 0, 0.8);
        xs[i] = scene_chance(&state, -3, 3);
        ys[i] = scene_chance(&state, -3, 3);
    }
    for (int i = 0; i < 8; i++) { /* in any order */
        int k = i * 3 % 8;
        scene_must(dyn_clamps_key(c, 5, times[k], xs[k], ys[k]));
        scene_must(dyn_clamps_key(c, 4 + 2 * (i % 2), times[k], 99, 99)); /* others' */
    }
    assert_false(dyn_clamps_at(c, 5, times[0] - 1e-9, &x, &y));
    for (int i = 0; i < 8; i++) {
        assert_true(dyn_clamps_at(c, 5, times[i], &x, &y));
        assert_true(x == xs[i] && y == ys[i]);
    }
    assert_true(dyn_clamps_at(c, 5, 1000, &x, &y));
    assert_true(x == xs[7] && y == ys[7]);
    /* the speeds before and after a key are the same */
    for (int i = 1; i < 7; i++) {
        double h = 1e-6, before, after;
        dyn_clamps_at(c, 5, times[i] - h, &before, &y);
        dyn_clamps_at(c, 5, times[i] + h, &after, &y);
        double want = (xs[i + 1] - xs[i - 1]) / (times[i + 1] - times[i - 1]);
        assert_near((xs[i] - before) / h, want, 1e-3);
        assert_near((after - xs[i]) / h, want, 1e-3);
    }
    dyn_clamps_destroy(c);
}

static void network_follows_and_is_let_go(void **unused)
{
    (void)unused;
    struct dyn_clamps *c = clamps_make();
    struct dyn_network *n = scene_letter(0, 3, 300, 5);
    scene_must(dyn_clamps_key(c, 2, 0.25, 0, 4));
    scene_must(dyn_clamps_key(c, 2, 1.25, 3, 5));
    scene_must(dyn_clamps_key(c, 2, 2.25, 6, 6));
    scene_must(dyn_clamps_free(c, 2, 1.75));
    scene_must(dyn_clamps_step(c, n, 1.0 / 256, 63));
    assert_true(dyn_mass_get(n, 2).hold == DYN_FREE && dyn_mass_get(n, 2).y < 4);
    scene_must(dyn_clamps_step(c, n, 1.0 / 256, 1));
    assert_true(dyn_mass_get(n, 2).hold == DYN_HELD);
    assert_true(dyn_mass_get(n, 2).x == 0 && dyn_mass_get(n, 2).y == 4);
    scene_must(dyn_clamps_step(c, n, 1.0 / 256, 256));
    assert_true(dyn_mass_get(n, 2).x == 3 && dyn_mass_get(n, 2).y == 5);
    assert_true(dyn_mass_get(n, 3).x > 2); /* the rest comes along */
    scene_must(dyn_clamps_step(c, n, 1.0 / 256, 130));
    assert_true(dyn_mass_get(n, 2).hold == DYN_FREE);
    scene_must(dyn_clamps_step(c, n, 1.0 / 256, 1000));
    assert_true(dyn_mass_get(n, 2).hold == DYN_HELD && dyn_mass_get(n, 2).x == 6);
    dyn_clamps_destroy(c);
    dyn_network_destroy(n);
}

/* A mass that a clamp moves at constant speed keeps that speed when it is released. */
static void mass_let_go_keeps_its_speed(void **unused)
{
    (void)unused;
    struct dyn_clamps *c = clamps_make();
    struct dyn_network *n;
    struct dyn_mass mass = dyn_mass_usual();
    scene_must(dyn_network_create(&n));
    struct dyn_world w = dyn_world_usual();
    w.gravity = w.drag = 0;
    scene_must(dyn_network_world_set(n, &w));
    mass.y = 5;
    scene_must(dyn_mass_add(n, &mass, NULL));
    for (int i = 0; i <= 2; i++)
        scene_must(dyn_clamps_key(c, 0, i, 2 * i, 5));
    scene_must(dyn_clamps_free(c, 0, 2 + 1 / 64.0));
    scene_must(dyn_clamps_step(c, n, 1.0 / 256, 256 * 2 + 3));
    assert_true(dyn_mass_get(n, 0).hold == DYN_HELD && dyn_mass_get(n, 0).x == 4);
    scene_must(dyn_clamps_step(c, n, 1.0 / 256, 256 + 1));
    assert_true(dyn_mass_get(n, 0).vx == 2);
    assert_near(dyn_mass_get(n, 0).x, 4 + 2 * (256 + 1) / 256.0, 1e-9);
    /* the mass is clamped again and released much later */
    scene_must(dyn_clamps_key(c, 0, 4, 0, 5));
    scene_must(dyn_clamps_key(c, 0, 5, 3, 5));
    scene_must(dyn_clamps_free(c, 0, 5.5));
    scene_must(dyn_clamps_step(c, n, 1.0 / 256, 256 * 4));
    assert_true(dyn_mass_get(n, 0).hold == DYN_FREE && dyn_mass_get(n, 0).x == 3);
    dyn_clamps_destroy(c);
    dyn_network_destroy(n);
}

static void clamps_as_text_come_back(void **unused)
{
    (void)unused;
    struct dyn_clamps *c = clamps_make(), *again;
    uint64_t state = 8;
    for (int i = 0; i < 500; i++) {
        int mass = (int)(sample_word(&state) % 20);
        double time = scene_chance(&state, -5, 5);
        scene_must(sample_word(&state) % 5 ? dyn_clamps_key(c, mass, time, 1 / 3.0, -time / 7)
                                           : dyn_clamps_free(c, mass, time));
    }
    char *text[2];
    size_t bytes[2];
    for (int i = 0; i < 2; i++) {
        FILE *to = open_memstream(&text[i], &bytes[i]);
        scene_must(dyn_clamps_print(i ? again : c, to));
        fclose(to);
        if (i == 0)
            scene_must(dyn_clamps_parse(text[0], bytes[0], "text", &again));
    }
    assert_int_equal(dyn_clamps_count(again), dyn_clamps_count(c));
    assert_int_equal(bytes[0], bytes[1]);
    assert_memory_equal(text[0], text[1], bytes[0]);
    for (int i = 0; i < 2; i++)
        free(text[i]);
    dyn_clamps_destroy(c);
    dyn_clamps_destroy(again);
}

static void bad_clamps_are_refused_in_one_line(void **unused)
{
    (void)unused;
    static const struct {
        const char *text, *error;
    } bad[] = {
        {"clamp 1\nend\n", "bad:1: its first line must be 'clamps 1'"},
        {"clamps 1\nkey 0 0 nan 0\nend\n", "bad:2: x must be -1e+06..1e+06 units (got nan)"},
        {"clamps 1\nkey 0 inf 0 0\nend\n",
         "bad:2: a key's time must be -1e+12..1e+12 s (got inf)"},
        {"clamps 1\nkey 0 1 2\nend\n", "bad:2: there is no y"},
        {"clamps 1\nfree -1 0\nend\n", "bad:2: mass: '-1' is no mass's number"},
        {"clamps 1\nhold 1 0\nend\n",
         "bad:2: a line begins with one of: key free end (got 'hold')"},
        {"clamps 1\nfree 1 0\n", "bad:2: the file is cut short: there is no 'end'"},
    };
    struct dyn_clamps *c;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(dyn_clamps_parse(bad[i].text, strlen(bad[i].text), "bad", &c),
                         DYN_BAD_FILE);
        assert_null(c);
        assert_string_equal(dyn_error(), bad[i].error);
    }
    struct dyn_network *n = scene_letter(0, 1, 10, 0);
    c = clamps_make();
    scene_must(dyn_clamps_key(c, 4, 0, 1, 1));
    assert_int_equal(dyn_clamps_step(c, n, 0.01, 1), DYN_BAD_ARGUMENT);
    assert_string_equal(dyn_error(), "there is no mass 4 (of 4)");
    assert_true(dyn_network_time_s(n) == 0);
    dyn_clamps_destroy(c);
    dyn_network_destroy(n);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_are_met_and_the_way_is_smooth),
        cmocka_unit_test(network_follows_and_is_let_go),
        cmocka_unit_test(mass_let_go_keeps_its_speed),
        cmocka_unit_test(clamps_as_text_come_back),
        cmocka_unit_test(bad_clamps_are_refused_in_one_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
