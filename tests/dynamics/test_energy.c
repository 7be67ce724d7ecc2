/* test_energy.c - springs without damping keep their energy: free, and on a floor. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

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

/* The mean over a second. */
static double energy_about(struct dyn_network *n)
{
    double sum = 0;
    for (int i = 0; i < 240; i++) {
        scene_must(dyn_network_step(n, 1.0 / 240, 1));
        sum += energy_of(n);
    }
    return sum / 240;
}

/* A letter turns, swings, and bounces on a floor that takes no energy. Compares its energy before and after a minute. */
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

/* Letters fall from forty heights on a floor that takes no energy, for half a minute. If a bounce only reversed the speed of a
 * part's middle, the root mean square drift of their energies would be 17, 6.5 and 3.4 % with one, two and three parts. */
static void bounces_keep_energy(void **unused)
{
    (void)unused;
    static const struct {
        double safety, drift;
        int parts;
    } cases[] = {{0.4, 0.08, 1}, {0.1, 0.022, 2}, {0.05, 0.01, 3}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++)
        for (int integrator = DYN_SYMPLECTIC; integrator <= DYN_VERLET; integrator++) {
            double squares = 0;
            for (int height = 0; height < 40; height++) {
                struct dyn_network *n = scene_letter(0, 1 + 0.013 * height, 400, 0);
                struct dyn_world w;
                struct dyn_plan plan;
                world_of(n, &w)->integrator = integrator;
                w.drag = w.friction = 0;
                w.restitution = w.floor_on = 1;
                w.gravity = 9.81;
                w.safety = cases[c].safety;
                scene_must(dyn_network_world_set(n, &w));
                struct dyn_mass mass = dyn_mass_get(n, 0);
                mass.vx = 2, mass.vy = -1;
                scene_must(dyn_mass_set(n, 0, &mass));
                scene_must(dyn_network_plan(n, 1.0 / 240, &plan));
                assert_int_equal(plan.parts, cases[c].parts);
                double before = energy_about(n);
                scene_must(dyn_network_step(n, 1.0 / 240, 240 * 28));
                double drift = energy_about(n) / before - 1;
                squares += drift * drift / 40;
                dyn_network_destroy(n);
            }
            print_message("integrator %d, %d parts: energies drift by %.2f%%\n", integrator,
                          cases[c].parts, 100 * sqrt(squares));
            assert_true(sqrt(squares) < cases[c].drift);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letter_keeps_its_energy),
        cmocka_unit_test(bounces_keep_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
