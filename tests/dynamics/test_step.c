/* test_step.c - the motion of masses agrees with a plain loop and with formulas, and has the
 * same bits under every instruction set. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <events.h>
#include <fields.h>
#include <hand.h>
#include <math.h>
#include <step.h>

#include "sample.h"
#include "scenes.h"

static struct dyn_world *world_of(struct dyn_network *n, struct dyn_world *w)
{
    *w = *dyn_network_world(n);
    return w;
}

/* ---- a second way ---- */

/* The forces by plain loops over the network's public functions, without prepared tables and
 * vectors. */
static void force_of(struct dyn_network *n, int i, const struct dyn_world *w, double (*f)[2])
{
    struct dyn_spring s = dyn_spring_get(n, i);
    struct dyn_mass a = dyn_mass_get(n, s.end[0]), b = dyn_mass_get(n, s.end[1]);
    double dx = b.x - a.x, dy = b.y - a.y, length = hypot(dx, dy),
           rest = s.rest_length * w->rest;
    if (s.broken || !(length > 0))
        return;
    double along = ((b.vx - a.vx) * dx + (b.vy - a.vy) * dy) / length;
    double pull = s.constant * w->stiffness * (length - rest) + s.damping * w->damping * along;
    if (rest > 0 && (length - rest) / rest > s.breaking_strain * w->breaking) {
        s.broken = true;
        scene_must(dyn_spring_set(n, i, &s));
        return;
    }
    f[s.end[0]][0] += pull * dx / length;
    f[s.end[0]][1] += pull * dy / length;
    f[s.end[1]][0] -= pull * dx / length;
    f[s.end[1]][1] -= pull * dy / length;
}

/* Puts a mass back from beyond a side at 0. v is its velocity across the side, t along it. It
 * does not bounce but stops there. */
static void side(double mu, double *p, double *v, double *t)
{
    double grip = -mu * *v;
    if (!(*p < 0 && *v < 0))
        return;
    *p = *v = 0;
    *t -= fmax(fmin(*t, grip), -grip);
}

static void sides(struct dyn_mass *m, const struct dyn_world *w)
{
    double mu = m->friction * w->friction, p, v;
    if (w->floor_on > 0) {
        p = m->y - w->floor;
        side(mu, &p, &m->vy, &m->vx);
        m->y = p + w->floor;
    }
    if (w->ceiling_on > 0) {
        p = w->ceiling - m->y, v = -m->vy;
        side(mu, &p, &v, &m->vx);
        m->y = w->ceiling - p, m->vy = -v;
    }
    if (w->left_on > 0) {
        p = m->x - w->left;
        side(mu, &p, &m->vx, &m->vy);
        m->x = p + w->left;
    }
    if (w->right_on > 0) {
        p = w->right - m->x, v = -m->vx;
        side(mu, &p, &v, &m->vy);
        m->x = w->right - p, m->vx = -v;
    }
}

enum { PLAIN_MASSES = 64 };

static double limited(double v, double limit)
{
    return fmax(fmin(v, limit), -limit);
}

static void plain_part(struct dyn_network *n, double h)
{
    double f[PLAIN_MASSES][2] = {{0}};
    struct dyn_world w;
    world_of(n, &w);
    for (int i = 0; i < dyn_springs_count(n); i++)
        force_of(n, i, &w, f);
    for (int i = 0; i < dyn_masses_count(n); i++) {
        struct dyn_mass m = dyn_mass_get(n, i);
        double mass = m.mass * w.mass, drag = (m.drag + w.drag) / mass;
        if (m.hold) {
            m.vx = m.vy = 0;
        } else {
            m.vx = (m.vx + h * (f[i][0] / mass + drag * w.wind_x)) / (1 + h * drag);
            m.vy = (m.vy + h * (f[i][1] / mass + drag * w.wind_y - w.gravity * m.gravity)) /
                   (1 + h * drag);
            m.vx = limited(m.vx, w.speed_limit);
            m.vy = limited(m.vy, w.speed_limit);
            m.x += h * m.vx;
            m.y += h * m.vy;
            sides(&m, &w);
        }
        scene_must(dyn_mass_set(n, i, &m));
    }
}

static void step_does_what_plain_loops_do(void **unused)
{
    (void)unused;
    uint64_t state = 3;
    int compared = 0;
    for (int round = 0; round < 300; round++) {
        struct dyn_network *n = scene_by_chance(&state), *plain;
        struct dyn_world w;
        world_of(n, &w)->integrator = DYN_SYMPLECTIC;
        w.restitution = 0; /* bounces are compared with a fine step's: test_energy.c */
        scene_must(dyn_network_world_set(n, &w));
        scene_must(dyn_pull_end(n, 0));
        scene_must(dyn_network_create(&plain));
        scene_must(dyn_network_copy(plain, n));
        for (int step = 0; step < 20; step++) {
            struct dyn_plan plan;
            scene_must(dyn_network_plan(n, 1.0 / 240, &plan));
            scene_must(dyn_network_step(n, 1.0 / 240, 1));
            for (int part = 0; part < plan.parts; part++)
                plain_part(plain, 1.0 / 240 / plan.parts);
            for (int i = 0; i < dyn_masses_count(n); i++, compared++) {
                const struct dyn_state *a = &dyn_network_states(n)[i];
                const struct dyn_state *b = &dyn_network_states(plain)[i];
                double far = fmax(fmax(fabs(a->x - b->x), fabs(a->y - b->y)),
                                  fmax(fabs(a->vx - b->vx), fabs(a->vy - b->vy)));
                if (!(far < 1e-9))
                    fail_msg("round %d, step %d, mass %d: %g apart", round, step, i, far);
            }
            for (int i = 0; i < dyn_springs_count(n); i++)
                assert_int_equal(dyn_spring_get(n, i).broken, dyn_spring_get(plain, i).broken);
        }
        dyn_network_destroy(n);
        dyn_network_destroy(plain);
    }
    assert_true(compared > 50000);
}

/* ---- the same bits ---- */

static void networks_same(struct dyn_network *a, struct dyn_network *b, const char *what)
{
    size_t bytes = (size_t)dyn_masses_count(a) * sizeof(struct dyn_state);
    if (memcmp(dyn_network_states(a), dyn_network_states(b), bytes) != 0)
        fail_msg("%s: states differ", what);
    for (int i = 0; i < dyn_springs_count(a); i++)
        assert_int_equal(dyn_spring_get(a, i).broken, dyn_spring_get(b, i).broken);
    struct dyn_event x, y;
    int more;
    while ((more = dyn_events_take(a, &x, 1)) == dyn_events_take(b, &y, 1) && more) {
        assert_int_equal(x.kind, y.kind);
        assert_int_equal(x.mass, y.mass);
        assert_int_equal(x.spring, y.spring);
        assert_true(x.time_s == y.time_s && x.strength == y.strength);
    }
    assert_int_equal(more, 0);
}

static void step_has_the_same_bits_with_every_instruction_set(void **unused)
{
    (void)unused;
    uint64_t state = 11;
    enum dyn_simd best = dyn_simd_use(DYN_SIMD_AVX512);
    int snaps = 0, clanks = 0;
    print_message("%s\n", dyn_simd_name(best));
    for (int round = 0; round < 300; round++) {
        struct dyn_network *plain = scene_by_chance(&state);
        struct dyn_network *other[2];
        for (int i = 0; i < 2; i++) {
            scene_must(dyn_network_create(&other[i]));
            scene_must(dyn_network_copy(other[i], plain));
            dyn_simd_use(i ? DYN_SIMD_AVX512 : DYN_SIMD_AVX2);
            scene_must(dyn_network_step(other[i], 1.0 / 240, 240));
        }
        dyn_simd_use(DYN_SIMD_PLAIN);
        scene_must(dyn_network_step(plain, 1.0 / 240, 240));
        dyn_simd_use(best);
        networks_same(other[1], other[0], "AVX-512 and AVX2");
        scene_must(dyn_network_copy(other[1], plain));
        struct dyn_event event;
        while (dyn_events_take(other[1], &event, 1)) {
            snaps += event.kind == DYN_SNAP;
            clanks += event.kind == DYN_CLANK;
        }
        size_t bytes = (size_t)dyn_masses_count(plain) * sizeof(struct dyn_state);
        assert_memory_equal(dyn_network_states(plain), dyn_network_states(other[0]), bytes);
        for (int i = 0; i < 2; i++)
            dyn_network_destroy(other[i]);
        dyn_network_destroy(plain);
    }
    assert_true(snaps > 100 && clanks > 1000);
}

static void step_has_the_same_bits_one_by_one_and_from_a_copy(void **unused)
{
    (void)unused;
    uint64_t state = 12;
    for (int round = 0; round < 200; round++) {
        struct dyn_network *n = scene_by_chance(&state), *single, *copy;
        scene_must(dyn_network_create(&single));
        scene_must(dyn_network_copy(single, n));
        scene_must(dyn_network_step(n, 1.0 / 240, 100));
        for (int i = 0; i < 50; i++)
            scene_must(dyn_network_step(single, 1.0 / 240, 1));
        copy = scene_by_chance(&state); /* used for another network before */
        scene_must(dyn_network_copy(copy, single));
        scene_must(dyn_network_step(copy, 1.0 / 240, 50));
        scene_must(dyn_network_step(single, 1.0 / 240, 50));
        assert_true(dyn_network_time_s(n) == dyn_network_time_s(copy));
        networks_same(single, n, "one by one");
        assert_memory_equal(dyn_network_states(copy), dyn_network_states(n),
                            (size_t)dyn_masses_count(n) * sizeof(struct dyn_state));
        dyn_network_destroy(n);
        dyn_network_destroy(single);
        dyn_network_destroy(copy);
    }
}

/* ---- formulas ---- */

static struct dyn_network *one_mass(double y, double vx, double restitution, double friction)
{
    struct dyn_network *n;
    scene_must(dyn_network_create(&n));
    struct dyn_world w = dyn_world_usual();
    w.drag = 0;
    w.restitution = restitution;
    w.friction = friction;
    scene_must(dyn_network_world_set(n, &w));
    struct dyn_mass mass = dyn_mass_usual();
    mass.y = y;
    mass.vx = vx;
    scene_must(dyn_mass_add(n, &mass, NULL));
    return n;
}

static void mass_falls_bounces_and_lies(void **unused)
{
    (void)unused;
    struct dyn_network *n = one_mass(1, 0, 0.5, 0);
    struct dyn_event event;
    double fall = sqrt(2 / 9.81);
    scene_must(dyn_network_step(n, 1e-4, 60000));
    /* each bounce is half as fast, until it is too slow to be heard */
    double speed = 9.81 * fall, time = fall;
    int heard = 0;
    for (; dyn_events_take(n, &event, 1); heard++) {
        speed /= 2;
        assert_int_equal(event.kind, DYN_CLANK);
        assert_int_equal(event.side, DYN_FLOOR);
        assert_near(event.time_s, time, 2e-3);
        assert_near(event.strength, speed, 5e-3);
        assert_true(dyn_clank_velocity(event.strength) == (int)(20 * event.strength));
        time += 2 * speed / 9.81;
    }
    assert_int_equal(heard, 4); /* 4.43 / 2, / 4, / 8 and / 16 exceed 0.2 */
    struct dyn_mass rest = dyn_mass_get(n, 0);
    assert_true(rest.y == 0 && rest.vy == 0);
    dyn_network_destroy(n);
}

static void mass_slides_as_far_as_friction_lets_it(void **unused)
{
    (void)unused;
    struct dyn_network *n = one_mass(0, 2, 0, 0.3);
    scene_must(dyn_network_step(n, 1e-3, 3000));
    struct dyn_mass mass = dyn_mass_get(n, 0);
    assert_true(mass.vx == 0);
    assert_near(mass.x, 2.0 * 2 / (2 * 0.3 * 9.81), 5e-3);
    dyn_network_destroy(n);
}

static void drag_never_overshoots(void **unused)
{
    (void)unused;
    for (double drag = 0.01; drag <= 1000; drag *= 10) {
        struct dyn_network *n = one_mass(100, 5, 0.5, 0);
        struct dyn_world w;
        world_of(n, &w)->drag = drag;
        w.wind_x = -1;
        scene_must(dyn_network_world_set(n, &w));
        double before = 5;
        for (int i = 0; i < 600; i++) {
            scene_must(dyn_network_step(n, 1.0 / 60, 1));
            double now = dyn_mass_get(n, 0).vx;
            assert_true(now <= before && now >= -1);
            before = now;
        }
        double exact = -1 + 6 * exp(-drag * 10);
        assert_near(before, exact, 0.02);
        assert_true(dyn_mass_get(n, 0).vy >= -9.81 / drag * 1.0001);
        dyn_network_destroy(n);
    }
}

/* Two masses, one fixed: the period is 2 pi sqrt(m / k), and the damping is that of the
 * formula. */
static void spring_swings_as_its_formula_says(void **unused)
{
    (void)unused;
    for (int integrator = DYN_SYMPLECTIC; integrator <= DYN_VERLET; integrator++) {
        struct dyn_network *n = one_mass(0, 0, 0, 0);
        struct dyn_world w;
        world_of(n, &w)->integrator = integrator;
        w.gravity = 0;
        w.floor_on = 0;
        scene_must(dyn_network_world_set(n, &w));
        struct dyn_mass mass = dyn_mass_usual();
        mass.x = 2;
        mass.mass = 2;
        scene_must(dyn_mass_add(n, &mass, NULL));
        scene_must(dyn_mass_tack(n, 0));
        struct dyn_spring spring = dyn_spring_usual();
        spring.end[0] = 0, spring.end[1] = 1;
        spring.constant = 50;
        spring.damping = 0.4;
        spring.rest_length = 1.5;
        scene_must(dyn_spring_add(n, &spring, NULL));
        double slowing = 0.4 / (2 * 2), turn = sqrt(50.0 / 2 - slowing * slowing);
        for (int i = 1; i <= 20; i++) {
            scene_must(dyn_network_step(n, 1e-4, 1000));
            double t = 0.1 * i;
            double exact = 1.5 + 0.5 * exp(-slowing * t) *
                                     (cos(turn * t) + slowing / turn * sin(turn * t));
            assert_near(dyn_mass_get(n, 1).x, exact, 3e-4);
        }
        dyn_network_destroy(n);
    }
}

/* Without sides, gravity and drag the momentum and the angular momentum stay the same. */
static void letter_keeps_its_momentum(void **unused)
{
    (void)unused;
    struct dyn_network *n = scene_letter(0, 1, 400, 3);
    struct dyn_world w;
    world_of(n, &w)->gravity = 0;
    w.drag = w.floor_on = 0;
    scene_must(dyn_network_world_set(n, &w));
    struct dyn_mass mass = dyn_mass_get(n, 0);
    mass.vx = 2, mass.vy = -1;
    scene_must(dyn_mass_set(n, 0, &mass));
    scene_must(dyn_network_step(n, 1.0 / 240, 2400));
    double p[2] = {0}, turn = 0, centre[2] = {0};
    for (int i = 0; i < 4; i++) {
        const struct dyn_state *s = &dyn_network_states(n)[i];
        p[0] += s->vx, p[1] += s->vy;
        turn += s->x * s->vy - s->y * s->vx;
        centre[0] += s->x / 4, centre[1] += s->y / 4;
    }
    assert_near(p[0], 2, 1e-9);
    assert_near(p[1], -1, 1e-9);
    assert_near(turn, 0 * -1 - 1 * 2.0, 1e-9);
    assert_near(centre[0], 0.5 + 10 * 0.5, 1e-9);
    dyn_network_destroy(n);
}

/* ---- stability ---- */

/* Neither very stiff letters nor a mass of a gram between two of a ton explode. */
static void stiff_springs_divide_the_step(void **unused)
{
    (void)unused;
    for (double k = 1; k <= 1e9; k *= 10) {
        struct dyn_network *n = scene_letter(0, 0.5, k, sqrt(k) / 10);
        struct dyn_plan plan;
        scene_must(dyn_mass_write(n, 1, dyn_mass_field_find("mass"), 0.001));
        scene_must(dyn_network_plan(n, 1.0 / 60, &plan));
        scene_must(dyn_network_step(n, 1.0 / 60, 200));
        for (int i = 0; i < 4; i++) {
            const struct dyn_state *s = &dyn_network_states(n)[i];
            assert_true(fabs(s->x) < 10 && s->y > -0.1 && s->y < 10);
        }
        /* the least stable mass has a gram and three springs of 2 k; diagonals damp as well */
        double c = 6 * sqrt(k) / 10 / 0.001, kk = 6 * k / 0.001;
        assert_near(plan.stable_s * (c + sqrt(c * c + 4 * kk)), 4, 1e-6);
        bool many = 1.0 / 60 / (0.5 * plan.stable_s) > DYN_PARTS_MAX;
        assert_int_equal(plan.softened >= 3, many);
        assert_true(many || plan.softened == 0);
        assert_true(many ? plan.parts == DYN_PARTS_MAX
                         : plan.parts == (int)ceil(1.0 / 60 / (0.5 * plan.stable_s)) ||
                               plan.parts == 1);
        dyn_network_destroy(n);
    }
}

/* The bound for stability is sharp: just beyond it, a chain whose neighbouring masses move in
 * opposite directions explodes. */
static void step_beyond_the_bound_would_explode(void **unused)
{
    (void)unused;
    enum { CHAIN = 20 };
    for (int beyond = 0; beyond < 2; beyond++) {
        double x[CHAIN], v[CHAIN] = {0}, h = 2 / sqrt(4 * 100.0) * (beyond ? 1.05 : 0.99);
        struct dyn_network *n;
        scene_must(dyn_network_create(&n));
        for (int i = 0; i < CHAIN; i++) {
            struct dyn_mass mass = dyn_mass_usual();
            mass.x = i;
            scene_must(dyn_mass_add(n, &mass, NULL));
            x[i] = i + 1e-3 * (i % 2 ? 1 : -1);
        }
        for (int i = 0; i < CHAIN; i++)
            scene_spring(n, i, (i + 1) % CHAIN, 100, 0);
        struct dyn_plan plan;
        scene_must(dyn_network_plan(n, 1.0 / 60, &plan));
        assert_near(plan.stable_s, 2 / sqrt(4 * 100.0), 1e-12);
        for (int step = 0; step < 2000; step++) {
            double f[CHAIN] = {0};
            for (int i = 0; i + 1 < CHAIN; i++) {
                double pull = 100 * (x[i + 1] - x[i] - 1);
                f[i] += pull;
                f[i + 1] -= pull;
            }
            double around = 100 * (x[0] - x[CHAIN - 1] + (CHAIN - 1)); /* the ring is closed */
            f[CHAIN - 1] += around;
            f[0] -= around;
            for (int i = 0; i < CHAIN; i++) {
                v[i] += h * f[i];
                x[i] += h * v[i];
            }
        }
        assert_int_equal(!(fabs(x[0]) < 1), beyond); /* may be NaN */
        dyn_network_destroy(n);
    }
}

/* ---- hands ---- */

static void hand_pulls_tacks_and_lets_go(void **unused)
{
    (void)unused;
    struct dyn_network *n = scene_letter(0, 2, 100, 2);
    struct dyn_event event;
    scene_must(dyn_pull_begin(n, 3, 3, 4, 500));
    scene_must(dyn_network_step(n, 1.0 / 240, 480));
    struct dyn_mass mass = dyn_mass_get(n, 3);
    assert_true(hypot(mass.x - 3, mass.y - 4) < 0.5);
    while (dyn_events_take(n, &event, 1))
        ;
    scene_must(dyn_mass_tack(n, 3));
    assert_int_equal(dyn_events_take(n, &event, 1), 1);
    assert_true(event.kind == DYN_CLICK && event.mass == 3);
    scene_must(dyn_mass_tack(n, 3)); /* no second click */
    assert_int_equal(dyn_events_take(n, &event, 1), 0);
    mass = dyn_mass_get(n, 3);
    scene_must(dyn_network_step(n, 1.0 / 240, 480));
    struct dyn_mass after = dyn_mass_get(n, 3);
    assert_true(after.x == mass.x && after.y == mass.y && after.hold == DYN_STUCK);
    scene_must(dyn_mass_untack(n, 3));
    scene_must(dyn_mass_hold(n, 3, 6, 6));
    scene_must(dyn_mass_release(n, 3));
    int twangs = 0;
    while (dyn_events_take(n, &event, 1))
        twangs += event.kind == DYN_TWANG && event.mass == 3 && event.strength > 0.5;
    assert_int_equal(twangs, 1);
    scene_must(dyn_network_step(n, 1.0 / 240, 240));
    assert_true(dyn_mass_get(n, 3).y < 6);
    assert_int_equal(dyn_pull_move(n, 3, 0, 0), DYN_BAD_ARGUMENT);
    assert_string_equal(dyn_error(), "nobody pulls mass 3");
    dyn_network_destroy(n);
}

static void springs_snap_are_cut_and_plucked(void **unused)
{
    (void)unused;
    struct dyn_network *n = scene_letter(0, 2, 100, 2);
    struct dyn_event event;
    scene_must(dyn_spring_write(n, 0, dyn_spring_field_find("breaking_strain"), 0.2));
    scene_must(dyn_mass_hold(n, 1, 1.19, 2)); /* of the spring to mass 0 at (0, 2) */
    scene_must(dyn_mass_tack(n, 0));
    scene_must(dyn_network_step(n, 1e-3, 5));
    assert_false(dyn_spring_get(n, 0).broken);
    scene_must(dyn_mass_hold(n, 1, 1.21, 2));
    scene_must(dyn_network_step(n, 1e-3, 5));
    assert_true(dyn_spring_get(n, 0).broken);
    int snaps = 0;
    while (dyn_events_take(n, &event, 1))
        if (event.kind == DYN_SNAP) {
            snaps++;
            assert_int_equal(event.spring, 0);
            assert_near(event.strength, 0.21, 1e-12);
            assert_near(event.time_s, 0.006, 1e-12);
        }
    assert_int_equal(snaps, 1);
    int cut;
    struct dyn_network *letter = scene_letter(0, 2, 100, 2);
    scene_must(
        dyn_network_cut(letter, -0.5, 2.25, 1.5, 2.25, &cut)); /* both sides, both diagonals */
    assert_int_equal(cut, 4);
    scene_must(dyn_network_cut(letter, -0.5, 2.25, 1.5, 2.25, &cut));
    assert_int_equal(cut, 0);
    scene_must(dyn_spring_pluck(letter, 0, 3));
    assert_true(dyn_mass_get(letter, 0).vy == -3 && dyn_mass_get(letter, 1).vy == 3);
    dyn_network_destroy(letter);
    dyn_network_destroy(n);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(step_does_what_plain_loops_do),
        cmocka_unit_test(step_has_the_same_bits_with_every_instruction_set),
        cmocka_unit_test(step_has_the_same_bits_one_by_one_and_from_a_copy),
        cmocka_unit_test(mass_falls_bounces_and_lies),
        cmocka_unit_test(mass_slides_as_far_as_friction_lets_it),
        cmocka_unit_test(drag_never_overshoots),
        cmocka_unit_test(spring_swings_as_its_formula_says),
        cmocka_unit_test(letter_keeps_its_momentum),
        cmocka_unit_test(stiff_springs_divide_the_step),
        cmocka_unit_test(step_beyond_the_bound_would_explode),
        cmocka_unit_test(hand_pulls_tacks_and_lets_go),
        cmocka_unit_test(springs_snap_are_cut_and_plucked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
