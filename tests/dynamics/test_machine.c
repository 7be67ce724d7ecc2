/* test_machine.c - networks as a program in C/Paris give the results of C except for
 * rounding. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <dyn_machine.h>
#include <hand.h>
#include <math.h>
#include <step.h>

#include "scenes.h"

static struct dyn_network *copy_of(const struct dyn_network *n)
{
    struct dyn_network *copy;
    scene_must(dyn_network_create(&copy));
    scene_must(dyn_network_copy(copy, n));
    return copy;
}

static void compare(struct dyn_network *n, int steps, double least)
{
    struct dyn_network *on_machine = copy_of(n);
    struct dyn_machine *machine;
    scene_must(dyn_machine_create(on_machine, 1.0 / 240, &machine));
    scene_must(dyn_machine_step(machine, steps));
    scene_must(dyn_machine_read(machine, on_machine));
    scene_must(dyn_network_step(n, 1.0 / 240, steps));
    assert_true(dyn_network_time_s(n) == dyn_network_time_s(on_machine));
    for (int i = 0; i < dyn_masses_count(n); i++) {
        const struct dyn_state *a = &dyn_network_states(n)[i],
                               *b = &dyn_network_states(on_machine)[i];
        double far = fmax(hypot(a->x - b->x, a->y - b->y), hypot(a->vx - b->vx, a->vy - b->vy));
        if (!(far < least))
            fail_msg("mass %d of %d: %g apart", i, dyn_masses_count(n), far);
    }
    for (int i = 0; i < dyn_springs_count(n); i++)
        assert_int_equal(dyn_spring_get(n, i).broken, dyn_spring_get(on_machine, i).broken);
    dyn_machine_destroy(machine);
    dyn_network_destroy(on_machine);
}

/* With sides, friction, wind, drag and tacks. No spring breaks, because that would change a
 * step's number of parts. */
static void machine_steps_as_c_does(void **unused)
{
    (void)unused;
    uint64_t state = 51;
    for (int round = 0; round < 3;) {
        struct dyn_network *n = scene_by_chance(&state);
        struct dyn_world w = *dyn_network_world(n);
        w.integrator = DYN_SYMPLECTIC;
        w.breaking = 1000;
        scene_must(dyn_network_world_set(n, &w));
        scene_must(dyn_pull_end(n, 0));
        if (dyn_springs_count(n)) {
            compare(n, 20, 1e-9);
            round++;
        }
        dyn_network_destroy(n);
    }
}

/* A cloth of several blocks whose springs come in any order and direction, with constants of
 * their own, and masses that have more springs than there are slots: their forces are sent. */
static void springs_come_in_any_order(void **unused)
{
    (void)unused;
    enum { SIDE = 70, MASSES = SIDE * SIDE, HUBS = 3, OF_HUB = 40 };
    uint64_t state = 7;
    struct dyn_network *n;
    scene_must(dyn_network_create(&n));
    for (int i = 0; i < MASSES; i++) {
        struct dyn_mass mass = dyn_mass_usual();
        mass.x = i % SIDE;
        mass.y = 100 - i / SIDE;
        mass.vx = scene_chance(&state, -1, 1);
        mass.hold = i < SIDE ? DYN_STUCK : DYN_FREE;
        scene_must(dyn_mass_add(n, &mass, NULL));
    }
    for (int i = 0; i < 4 * MASSES + HUBS * OF_HUB; i++) {
        int hub = i - 4 * MASSES, a = (int)scene_chance(&state, 0, MASSES);
        int b = (a + (i % 2 ? 1 : SIDE)) % MASSES;
        if (hub >= 0) {
            a = 5000 - 1500 * (hub % HUBS) - 400;
            b = (int)scene_chance(&state, 0, MASSES);
        }
        if (a == b)
            continue;
        struct dyn_spring spring = dyn_spring_usual();
        spring.end[0] = i % 3 ? a : b;
        spring.end[1] = i % 3 ? b : a;
        spring.constant = scene_chance(&state, 10, 100);
        spring.damping = 0.1;
        scene_must(dyn_spring_add(n, &spring, NULL));
    }
    compare(n, 20, 1e-9);
    dyn_network_destroy(n);
}

/* A cloth is torn from its rail: springs snap, and the remaining springs go on moving. */
static void springs_break_on_the_machine(void **unused)
{
    (void)unused;
    enum { SIDE = 12 };
    struct dyn_network *n;
    scene_must(dyn_network_create(&n));
    for (int i = 0; i < SIDE * SIDE; i++) {
        struct dyn_mass mass = dyn_mass_usual();
        mass.x = i % SIDE;
        mass.y = 20 - i / SIDE;
        mass.vy = i < SIDE ? 0 : -8.0 * (i % 3);
        mass.hold = i < SIDE ? DYN_STUCK : DYN_FREE;
        scene_must(dyn_mass_add(n, &mass, NULL));
    }
    for (int i = 0; i < SIDE * (SIDE - 1); i++) {
        struct dyn_spring spring = dyn_spring_usual();
        spring.end[0] = i;
        spring.end[1] = i + SIDE;
        spring.constant = 800;
        spring.breaking_strain = 0.3;
        scene_must(dyn_spring_add(n, &spring, NULL));
    }
    compare(n, 60, 1e-9);
    int broken = 0;
    for (int i = 0; i < dyn_springs_count(n); i++)
        broken += dyn_spring_get(n, i).broken;
    assert_true(broken > 3 && broken < dyn_springs_count(n));
    dyn_network_destroy(n);
}

static void what_the_machine_does_not_do_is_refused(void **unused)
{
    (void)unused;
    struct dyn_network *n = scene_letter(0, 1, 10, 0), *other = scene_letter(0, 1, 10, 0);
    struct dyn_machine *machine;
    struct dyn_world w = *dyn_network_world(n);
    w.integrator = DYN_VERLET;
    scene_must(dyn_network_world_set(n, &w));
    assert_int_equal(dyn_machine_create(n, 0.01, &machine), DYN_BAD_ARGUMENT);
    assert_string_equal(dyn_error(), "the machine makes symplectic steps only");
    w.integrator = DYN_SYMPLECTIC;
    scene_must(dyn_network_world_set(n, &w));
    scene_must(dyn_pull_begin(n, 0, 1, 1, 10));
    assert_int_equal(dyn_machine_create(n, 0.01, &machine), DYN_BAD_ARGUMENT);
    assert_string_equal(dyn_error(), "the machine knows no hands that pull");
    scene_must(dyn_pull_end(n, 0));
    assert_int_equal(dyn_machine_create(n, -1, &machine), DYN_BAD_ARGUMENT);
    assert_null(machine);
    scene_must(dyn_machine_create(n, 0.01, &machine));
    struct dyn_mass mass = dyn_mass_usual();
    scene_must(dyn_mass_add(other, &mass, NULL));
    assert_int_equal(dyn_machine_read(machine, other), DYN_BAD_ARGUMENT);
    assert_int_equal(dyn_machine_step(machine, -1), DYN_BAD_ARGUMENT);
    dyn_machine_destroy(machine);
    dyn_network_destroy(n);
    dyn_network_destroy(other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(machine_steps_as_c_does),
        cmocka_unit_test(springs_come_in_any_order),
        cmocka_unit_test(springs_break_on_the_machine),
        cmocka_unit_test(what_the_machine_does_not_do_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
