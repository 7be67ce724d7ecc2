/* test_energy.c - springs without damping keep their energy: free, and on a floor. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include <energy.h>
#include <math.h>
#include <step.h>

#include "scenes.h"

static struct dyn_world *world_of(struct dyn_network *n, struct dyn_world *w)
{
    *w = *dyn_network_world(n);
    return w;
}

static double energy_of(const struct dyn_network *n)
{
    struct dyn_energy e = dyn_network_energy(n);
    return e.motion + e.gravity + e.springs + e.pulls;
}

/* The mean energy over a second. */
static double energy_about(struct dyn_network *n)
{
    double sum = 0;
    for (int i = 0; i < 240; i++) {
        scene_must(dyn_network_step(n, 1.0 / 240, 1));
        sum += energy_of(n);
    }
    return sum / 240;
}

/* A letter turns, swings, and bounces on a floor that takes no energy. Compares its energy
 * before and after a minute. */
static void letter_keeps_its_energy(void **unused)
{
    (void)unused;
    for (int integrator = DYN_SYMPLECTIC; integrator <= DYN_VERLET; integrator++)
        for (int falls = 0; falls < 2; falls++) {
            struct dyn_network *n = scene_letter(0, 1, 400, 0);
            struct dyn_world w;
            world_of(n, &w)->integrator = integrator;
            w.drag = w.friction = 0;
            w.restitution = 1;
            w.gravity = falls ? 9.81 : 0;
            w.floor_on = falls;
            w.safety = falls ? 0.1 : 0.5;
            scene_must(dyn_network_world_set(n, &w));
            struct dyn_mass mass = dyn_mass_get(n, 0);
            mass.vx = 2, mass.vy = -1;
            scene_must(dyn_mass_set(n, 0, &mass));
            double before = energy_about(n);
            scene_must(dyn_network_step(n, 1.0 / 240, 240 * 58));
            double drift = energy_about(n) / before - 1;
            print_message("integrator %d, %s: energy drifts by %.3f%% in a minute\n",
                          integrator, falls ? "bouncing" : "free", 100 * drift);
            assert_true(fabs(drift) < (falls ? 0.1 : 0.01));
            dyn_network_destroy(n);
        }
}

/* Draws a word on a floor: thrown, turned, tilted, and of letters that no fall turns inside
 * out. Masses that bounce keep `restitution` of their speed. */
static struct dyn_network *word_by_chance(uint64_t *state, int letters, int integrator,
                                          double restitution)
{
    static const int ends[8][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0},
                                   {0, 2}, {1, 3}, {1, 4}, {2, 7}};
    struct dyn_network *n;
    scene_must(dyn_network_create(&n));
    struct dyn_world w;
    world_of(n, &w)->integrator = integrator;
    w.drag = w.friction = 0;
    w.restitution = restitution;
    scene_must(dyn_network_world_set(n, &w));
    double mass = scene_chance(state, 0.1, 1), wide = scene_chance(state, 0.4, 1);
    double k = mass * exp(scene_chance(state, log(1500), log(40000)));
    double high = scene_chance(state, 0.5, 1.2), y = scene_chance(state, 1.8, 4.5);
    double tilt = scene_chance(state, -1, 1) * (letters == 1 ? M_PI : 0.3);
    double vx = scene_chance(state, -2, 2), vy = scene_chance(state, -2, 2);
    for (int i = 0; i < 4 * letters; i++) {
        struct dyn_mass m = dyn_mass_usual();
        double px = (i / 4) * (wide + 0.2) + (i % 4 == 1 || i % 4 == 2 ? wide : 0);
        double py = i % 4 > 1 ? high : 0;
        m.x = px * cos(tilt) - py * sin(tilt);
        m.y = y + (letters > 1 ? 0.4 * letters : 0) + px * sin(tilt) + py * cos(tilt);
        m.vx = i ? vx : 2 * vx;
        m.vy = i ? vy : -vy;
        m.mass = mass;
        scene_must(dyn_mass_add(n, &m, NULL));
    }
    for (int i = 0; i < letters; i++)
        for (int e = 0; e < (i + 1 < letters ? 8 : 6); e++)
            scene_spring(n, 4 * i + ends[e][0], 4 * i + ends[e][1], k, 0);
    return n;
}

/* Letters and words on a floor that takes no energy, for a minute with the default settings:
 * some hundreds of bounces of each corner. */
static void bounces_keep_energy(void **unused)
{
    (void)unused;
    for (int letters = 1; letters <= 7; letters += 3)
        for (int integrator = DYN_SYMPLECTIC; integrator <= DYN_VERLET; integrator++) {
            uint64_t state = 5;
            double most = 0;
            for (int i = 0; i < 24 / letters; i++) {
                struct dyn_network *n = word_by_chance(&state, letters, integrator, 1);
                double before = energy_about(n);
                scene_must(dyn_network_step(n, 1.0 / 240, 240 * 58));
                most = fmax(most, fabs(energy_about(n) / before - 1));
                dyn_network_destroy(n);
            }
            print_message("integrator %d, words of %d: energy drifts by at most %.2f%%\n",
                          integrator, letters, 100 * most);
            assert_true(most < 0.01);
        }
}

static int ascending(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* The distance of letters from their places with much shorter steps, after 0.8 s with some
 * bounces. Takes the median, because for a few letters the smallest difference at a bounce
 * decides the rest of the motion. */
static double bounces_error(int integrator, int finer)
{
    enum { WORDS = 41 };
    uint64_t state = 6;
    double far[WORDS];
    for (int i = 0; i < WORDS; i++) {
        struct dyn_network *n = word_by_chance(&state, 1, integrator, 0.9), *exact;
        scene_must(dyn_network_create(&exact));
        scene_must(dyn_network_copy(exact, n));
        scene_must(dyn_network_step(n, 1.0 / 480 / finer, 384 * finer));
        scene_must(dyn_network_step(exact, 1.0 / 480 / 30, 384 * 30));
        far[i] = 0;
        for (int k = 0; k < 4; k++) {
            const struct dyn_state *a = &dyn_network_states(n)[k],
                                   *b = &dyn_network_states(exact)[k];
            far[i] = fmax(far[i], hypot(a->x - b->x, a->y - b->y));
        }
        dyn_network_destroy(n);
        dyn_network_destroy(exact);
    }
    qsort(far, WORDS, sizeof *far, ascending);
    return far[WORDS / 2];
}

/* A bounce within a part has an error of second order, like the parts. If it used the part's
 * speed, it would not. */
static void bounces_are_where_short_steps_lead(void **unused)
{
    (void)unused;
    for (int integrator = DYN_SYMPLECTIC; integrator <= DYN_VERLET; integrator++) {
        double once = bounces_error(integrator, 1), twice = bounces_error(integrator, 2);
        print_message("integrator %d: %.5f units apart, with half the step %.5f\n", integrator,
                      once, twice);
        assert_true(once < 0.03 && twice < once / 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letter_keeps_its_energy),
        cmocka_unit_test(bounces_keep_energy),
        cmocka_unit_test(bounces_are_where_short_steps_lead),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
