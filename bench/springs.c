/* springs.c - `lutetia bench springs`: ours beside plain loops, Chipmunk and Box2D, in one run;
 * a million springs beside OpenMP, on the machine, too; and how an undamped letter's energy
 * drifts.
 *
 * First, plain loops and our library must agree on the positions after a tenth of a second.
 * The engines also compute contacts and rotating bodies, which masses on springs do not
 * need. A row gives their distance from a finer solution of ours.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <dyn_machine.h>
#include <energy.h>
#include <network.h>
#include <step.h>

#include "bench.h"
#include "of_machine.h"
#include "springs_scene.h"

enum {
    REPEAT_MIN = 5,
    RATE_HZ = 240,
    AGREE_STEPS = 24,
    STEPS = 60,
    WORD_STEPS = 20000,
    LETTERS = 26,
    SIDE = 100
};
enum { MILLION_SIDE = 504, MILLION_STEPS = 4, ENGINES = 5 };

static const double dt_s = 1.0 / RATE_HZ;

/* ---- ours ---- */

static bool dyn_said(enum dyn_status status)
{
    return status == DYN_OK || bench_fail("%s", dyn_error());
}

static bool network_of(const struct springs_scene *s, struct dyn_network **out)
{
    bool ok = dyn_said(dyn_network_create(out));
    struct dyn_world world = dyn_world_usual();
    world.gravity = s->gravity;
    world.drag = 0;
    world.floor_on = s->has_floor;
    world.restitution = s->restitution;
    world.friction = s->friction;
    ok = ok && dyn_said(dyn_network_world_set(*out, &world));
    for (int i = 0; ok && i < s->masses_count; i++) {
        const struct springs_mass *m = &s->masses[i];
        struct dyn_mass mass = dyn_mass_usual();
        mass.x = m->x;
        mass.y = m->y;
        mass.vx = m->fixed ? 0 : m->vx;
        mass.vy = m->fixed ? 0 : m->vy;
        mass.mass = m->mass;
        mass.hold = m->fixed ? DYN_STUCK : DYN_FREE;
        ok = dyn_said(dyn_mass_add(*out, &mass, NULL));
    }
    for (int i = 0; ok && i < s->springs_count; i++) {
        const struct springs_spring *f = &s->springs[i];
        struct dyn_spring spring = dyn_spring_usual();
        spring.end[0] = f->a;
        spring.end[1] = f->b;
        spring.constant = f->constant;
        spring.rest_length = f->rest_length;
        spring.damping = f->damping;
        ok = dyn_said(dyn_spring_add(*out, &spring, NULL));
    }
    struct dyn_plan plan = {0};
    ok = ok && dyn_said(dyn_network_plan(*out, dt_s, &plan));
    return ok && (plan.parts == 1 || bench_fail("a step has %d parts, not 1", plan.parts));
}

/* ---- engines behind one face ---- */

struct engine {
    const char *what;
    const bool *built;
    void *(*create)(const struct springs_scene *s);
    void (*destroy)(void *engine);
    void (*step)(void *engine, double dt_s, int count);
    void (*state)(const void *engine, int mass, double state[4]);
};

#define FACE(name)                                                                             \
    static void *name##_create(const struct springs_scene *s)                                  \
    {                                                                                          \
        return springs_##name##_create(s);                                                     \
    }                                                                                          \
    static void name##_destroy(void *engine)                                                   \
    {                                                                                          \
        springs_##name##_destroy(engine);                                                      \
    }                                                                                          \
    static void name##_step(void *engine, double dt, int count)                                \
    {                                                                                          \
        springs_##name##_step(engine, dt, count);                                              \
    }                                                                                          \
    static void name##_state(const void *engine, int mass, double state[4])                    \
    {                                                                                          \
        springs_##name##_state(engine, mass, state);                                           \
    }

FACE(plain)
FACE(openmp)
FACE(chipmunk)
FACE(box2d)

static void *ours_create(const struct springs_scene *s)
{
    struct dyn_network *n = NULL;
    if (network_of(s, &n))
        return n;
    dyn_network_destroy(n);
    return NULL;
}

static void ours_destroy(void *engine)
{
    dyn_network_destroy(engine);
}

static void ours_step(void *engine, double dt, int count)
{
    (void)dyn_network_step(engine, dt, count); /* allocated before: it cannot fail */
}

static void ours_state(const void *engine, int mass, double state[4])
{
    const struct dyn_state *s = &dyn_network_states(engine)[mass];
    state[0] = s->x;
    state[1] = s->y;
    state[2] = s->vx;
    state[3] = s->vy;
}

static const bool always = true;
static const struct engine ours = {"springs",    &always,   ours_create,
                                   ours_destroy, ours_step, ours_state};
static const struct engine plain = {"plain C",     &always,    plain_create,
                                    plain_destroy, plain_step, plain_state};
static const struct engine openmp = {"openmp",       &always,     openmp_create,
                                     openmp_destroy, openmp_step, openmp_state};
static const struct engine chipmunk = {"chipmunk",      &springs_chipmunk_built,
                                       chipmunk_create, chipmunk_destroy,
                                       chipmunk_step,   chipmunk_state};
static const struct engine box2d = {"box2d",       &springs_box2d_built, box2d_create,
                                    box2d_destroy, box2d_step,           box2d_state};

/* The mean distance between masses (root of the mean square). */
static double apart(const struct engine *a, const void *of_a, const struct engine *b,
                    const void *of_b, int masses)
{
    double sum = 0, p[4], q[4];
    for (int i = 0; i < masses; i++) {
        a->state(of_a, i, p);
        b->state(of_b, i, q);
        sum += (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
    }
    return sqrt(sum / masses);
}

/* ---- rows ---- */

struct run {
    const struct engine *engine;
    void *of;
    int steps;
};

static bool run_work(void *context)
{
    struct run *run = context;
    run->engine->step(run->of, dt_s, run->steps);
    return true;
}

/* Measures the available engines on the same scene, alternately. scale: of a run's seconds. */
static bool engines_measure(struct bench_report *r, const struct springs_scene *s,
                            const struct engine *const *engines, int count, int steps,
                            int repeats, const char *of_case, bool rates)
{
    struct run runs[ENGINES];
    struct bench_contender contenders[ENGINES];
    int there = 0;
    bool ok = true;
    for (int i = 0; i < count && ok; i++) {
        if (!*engines[i]->built)
            continue;
        runs[there] = (struct run){engines[i], engines[i]->create(s), steps};
        ok = runs[there].of || bench_fail("%s: no memory", engines[i]->what);
        contenders[there] = (struct bench_contender){
            .what = engines[i]->what, .work = run_work, .context = &runs[there]};
        there += ok;
    }
    ok = ok && bench_measure_in_turns(contenders, there, repeats);
    double springs = (double)s->springs_count * steps;
    for (int i = 0; ok && i < there; i++) {
        struct bench_sample t = contenders[i].seconds;
        if (rates)
            t = (struct bench_sample){steps / t.median, steps / t.min};
        bench_report_add(r, rates && i == 0 ? "word" : contenders[i].what, of_case, t,
                         rates ? 1 : 1e9 / springs, rates ? "steps/s" : "ns/spring-step");
    }
    for (int i = 0; i < there; i++)
        runs[i].engine->destroy(runs[i].of);
    return ok;
}

/* After a tenth of a second, plain loops and our library differ only by rounding. (Later a
 * buckling network amplifies the rounding errors.) */
static bool agree(const struct springs_scene *s, const struct engine *other, double least)
{
    void *a = ours.create(s), *b = other->create(s);
    double far = INFINITY;
    if (a && b) {
        ours.step(a, dt_s, AGREE_STEPS);
        other->step(b, dt_s, AGREE_STEPS);
        far = apart(&ours, a, other, b, s->masses_count);
    }
    if (a)
        ours.destroy(a);
    if (b)
        other->destroy(b);
    return far < least ||
           (a && b &&
            bench_fail("%s and ours are %g apart after a tenth of a second", other->what, far));
}

/* RMS distance after a second from our solution with a thirtieth of the step. */
static bool errors_measure(struct bench_report *r, const struct springs_scene *s,
                           const struct engine *const *engines, int count)
{
    enum { FINER = 30 };
    void *exact = ours.create(s);
    bool ok = exact != NULL;
    if (ok)
        ours.step(exact, dt_s / FINER, RATE_HZ * FINER);
    for (int i = 0; i < count && ok; i++) {
        if (!*engines[i]->built)
            continue;
        void *of = engines[i]->create(s);
        ok = of || bench_fail("%s: no memory", engines[i]->what);
        if (!ok)
            break;
        engines[i]->step(of, dt_s, RATE_HZ);
        double far = apart(&ours, exact, engines[i], of, s->masses_count);
        bench_report_add(r, engines[i]->what, "error after 1 s",
                         (struct bench_sample){far, far}, 1, "units RMS");
        engines[i]->destroy(of);
    }
    if (exact)
        ours.destroy(exact);
    return ok;
}

static bool grid_measure(struct bench_report *r, int repeats)
{
    static const struct engine *const engines[] = {&ours, &plain, &chipmunk, &box2d};
    struct springs_scene s;
    bool ok =
        springs_scene_grid(&s, SIDE, SIDE) && agree(&s, &plain, 1e-9) &&
        engines_measure(r, &s, engines, 4, bench_many(STEPS, 2), repeats, "100x100", false) &&
        errors_measure(r, &s, engines, 4);
    springs_scene_finish(&s);
    return ok;
}

static bool word_measure(struct bench_report *r, int repeats)
{
    static const struct engine *const engines[] = {&ours, &plain};
    struct springs_scene s;
    bool ok =
        springs_scene_word(&s, LETTERS) && agree(&s, &plain, 1e-9) &&
        engines_measure(r, &s, engines, 2, bench_many(WORD_STEPS, 20), repeats, "word", true);
    springs_scene_finish(&s);
    return ok;
}

/* ---- a million springs ---- */

static bool machine_work(void *machine)
{
    return dyn_said(dyn_machine_step(machine, MILLION_STEPS)) &&
           dyn_said(dyn_machine_finish(machine));
}

static bool million_turns(struct bench_report *r, const struct springs_scene *s,
                          struct dyn_machine *machine, int repeats)
{
    static const struct engine *const engines[] = {&ours, &openmp};
    struct run runs[2];
    struct bench_contender contenders[3];
    bool ok = true;
    for (int i = 0; i < 2; i++) {
        runs[i] = (struct run){engines[i], engines[i]->create(s), MILLION_STEPS};
        ok = ok && runs[i].of;
        contenders[i] = (struct bench_contender){
            .what = engines[i]->what, .work = run_work, .context = &runs[i]};
    }
    contenders[2] =
        (struct bench_contender){.what = "machine", .work = machine_work, .context = machine};
    ok = ok && bench_measure_in_turns(contenders, 3, repeats);
    for (int i = 0; ok && i < 3; i++)
        bench_report_add(r, contenders[i].what, "a million springs", contenders[i].seconds,
                         1e9 / ((double)s->springs_count * MILLION_STEPS), "ns/spring-step");
    for (int i = 0; i < 2; i++)
        if (runs[i].of)
            engines[i]->destroy(runs[i].of);
    return ok;
}

static bool million_measure(struct bench_report *r, int repeats)
{
    struct springs_scene s;
    struct dyn_network *n = NULL;
    struct dyn_machine *machine = NULL;
    bool ok = springs_scene_grid(&s, MILLION_SIDE, MILLION_SIDE) && network_of(&s, &n) &&
              dyn_said(dyn_machine_create(n, dt_s, &machine)) &&
              million_turns(r, &s, machine, repeats);
    dyn_machine_destroy(machine);
    dyn_network_destroy(n);
    springs_scene_finish(&s);
    return ok;
}

/* ---- energy ---- */

/* The mean over a second. */
static double energy_about(struct dyn_network *n)
{
    double sum = 0;
    for (int i = 0; i < RATE_HZ; i++) {
        (void)dyn_network_step(n, dt_s, 1);
        struct dyn_energy e = dyn_network_energy(n);
        sum += e.motion + e.gravity + e.springs;
    }
    return sum / RATE_HZ;
}

/* The energy's drift for a letter that swings and turns for a minute. */
static bool drift_measure(struct bench_report *r)
{
    struct springs_scene s;
    struct dyn_network *n = NULL;
    bool ok = springs_scene_word(&s, 1);
    if (ok) {
        s.gravity = 0;
        s.has_floor = false;
        s.masses[0].vx = 2;
        s.masses[0].vy = -1;
        for (int i = 0; i < s.springs_count; i++)
            s.springs[i].damping = 0;
        ok = network_of(&s, &n);
    }
    if (ok) {
        double before = energy_about(n);
        ok = dyn_said(dyn_network_step(n, dt_s, 58 * RATE_HZ));
        double drift = 100 * fabs(energy_about(n) / before - 1);
        bench_report_add(r, "energy drift", "letter, 60 s", (struct bench_sample){drift, drift},
                         1, "%");
    }
    dyn_network_destroy(n);
    springs_scene_finish(&s);
    return ok;
}

int bench_springs_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {.name = "springs",
                                    .repeat_least = REPEAT_MIN,
                                    .repeat_count = 15,
                                    .thorough_does = "a million springs, on the machine, too"};
    int status = bench_machine_start(&report, &options, true, argc, argv);
    if (status >= 0)
        return status;
    bool ok = grid_measure(&report, options.repeat_count) &&
              word_measure(&report, options.repeat_count) && drift_measure(&report) &&
              (!options.thorough || million_measure(&report, REPEAT_MIN));
    return bench_options_finish(&options, &report, "plain C", ok);
}
