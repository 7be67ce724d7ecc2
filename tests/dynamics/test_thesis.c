/* test_thesis.c - the thesis's integrator gives the bits of the thesis's listing over 10,000
 * steps, for random networks whose masses are tacked, held and released. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <events.h>
#include <hand.h>
#include <math.h>
#include <network.h>
#include <step.h>

#include "../skip.h"
#include "sample.h"
#include "thesis_oracle.h"

enum { STEPS = 10000, MASSES = 12, SPRINGS = 24 };

struct scene {
    struct thesis_params params;
    struct thesis_mass masses[MASSES];
    struct thesis_spring springs[SPRINGS];
    struct dyn_network *network;
};

static int clanks[64 * MASSES], clanks_count;

static void clank(int velocity)
{
    clanks[clanks_count++] = velocity;
}

static double chance(uint64_t *state, double least, double most)
{
    return least + (most - least) * (double)(sample_word(state) >> 11) * 0x1p-53;
}

static void network_make(struct scene *s)
{
    struct dyn_world world = dyn_world_usual();
    assert_int_equal(dyn_network_create(&s->network), DYN_OK);
    world.integrator = DYN_THESIS;
    world.gravity = s->params.gravity;
    world.drag = s->params.damping;
    world.restitution = s->params.floor;
    world.floor = 0.5;
    assert_int_equal(dyn_network_world_set(s->network, &world), DYN_OK);
    for (int i = 0; i < MASSES; i++) {
        struct dyn_mass mass = dyn_mass_usual();
        mass.x = s->masses[i].Wx;
        mass.y = s->masses[i].Wy;
        mass.mass = s->masses[i].mass;
        assert_int_equal(dyn_mass_add(s->network, &mass, NULL), DYN_OK);
    }
    for (int i = 0; i < SPRINGS; i++) {
        struct dyn_spring spring = dyn_spring_usual();
        memcpy(spring.end, s->springs[i].end, sizeof spring.end);
        spring.constant = s->springs[i].k;
        spring.rest_length = s->springs[i].rest_length;
        assert_int_equal(dyn_spring_add(s->network, &spring, NULL), DYN_OK);
    }
}

static void scene_make(struct scene *s, uint64_t *state)
{
    s->params = (struct thesis_params){.springs = SPRINGS,
                                       .masses = MASSES,
                                       .selected = -1,
                                       .gravity = chance(state, 0, 20),
                                       .damping = chance(state, 0, 0.5),
                                       .floor = chance(state, 0, 1),
                                       .dTime = chance(state, 0.001, 0.02)};
    for (int i = 0; i < MASSES; i++)
        s->masses[i] = (struct thesis_mass){.Wx = chance(state, 0, 4),
                                            .Wy = chance(state, 0.3, 5),
                                            .mass = chance(state, 0.5, 3)};
    for (int i = 0; i < SPRINGS; i++) {
        int a = (int)(sample_word(state) % MASSES);
        int b = (a + 1 + (int)(sample_word(state) % (MASSES - 1))) % MASSES;
        s->springs[i] = (struct thesis_spring){
            .k = chance(state, 0, 60), .rest_length = chance(state, 0, 2), .end = {a, b}};
    }
    network_make(s);
}

/* Takes, moves, tacks and releases a random mass. */
static void hand(struct scene *s, uint64_t *state)
{
    int mass = (int)(sample_word(state) % MASSES), held = s->params.selected;
    double x = chance(state, 0, 4), y = chance(state, 0.2, 5);
    switch (sample_word(state) % 4) {
    case 0:
        dyn_mass_tack(s->network, mass);
        s->masses[mass].sticky = 1;
        s->masses[mass].VelX = s->masses[mass].VelY = 0;
        s->params.selected = held == mass ? -1 : held; /* tacked, it is let go of */
        break;
    case 1:
        dyn_mass_untack(s->network, mass);
        s->masses[mass].sticky = 0;
        break;
    case 2:
        if (held >= 0)
            dyn_mass_release(s->network, held);
        dyn_mass_hold(s->network, mass, x, y);
        s->params.selected = mass;
        s->masses[mass].Wx = x;
        s->masses[mass].Wy = y;
        s->masses[mass].VelX = s->masses[mass].VelY = 0;
        break;
    default:
        if (held >= 0)
            dyn_mass_release(s->network, held);
        s->params.selected = -1;
    }
}

static void springs_measure(struct scene *s)
{
    for (int i = 0; i < SPRINGS; i++) {
        struct thesis_spring *spring = &s->springs[i];
        const struct thesis_mass *a = &s->masses[spring->end[0]],
                                 *b = &s->masses[spring->end[1]];
        double dx = a->Wx - b->Wx, dy = a->Wy - b->Wy;
        spring->Theta = atan2(dy, dx);
        spring->Distance = sqrt(dx * dx + dy * dy);
    }
}

static void same(const struct scene *s, int step)
{
    const struct dyn_state *states = dyn_network_states(s->network);
    for (int i = 0; i < MASSES; i++) {
        double theirs[4] = {s->masses[i].Wx, s->masses[i].Wy, s->masses[i].VelX,
                            s->masses[i].VelY};
        if (memcmp(theirs, &states[i], sizeof theirs) != 0)
            fail_msg("step %d, mass %d: (%.17g %.17g %.17g %.17g), ours (%.17g %.17g %.17g "
                     "%.17g)",
                     step, i, theirs[0], theirs[1], theirs[2], theirs[3], states[i].x,
                     states[i].y, states[i].vx, states[i].vy);
    }
}

static int clanks_same(struct scene *s)
{
    struct dyn_event event;
    int heard = 0;
    while (dyn_events_take(s->network, &event, 1))
        if (event.kind == DYN_CLANK) {
            assert_true(heard < clanks_count);
            assert_int_equal(dyn_clank_velocity(event.strength), clanks[heard]);
            heard++;
        }
    assert_int_equal(heard, clanks_count);
    return heard;
}

static void agrees(thesis_step *theirs)
{
    uint64_t state = 71;
    int heard = 0;
    for (int round = 0; round < 6; round++) {
        struct scene s;
        scene_make(&s, &state);
        for (int step = 0; step < STEPS; step++) {
            if (sample_word(&state) % 100 == 0)
                hand(&s, &state);
            clanks_count = 0;
            springs_measure(&s);
            theirs(&s.params, s.masses, s.springs, clank);
            assert_int_equal(dyn_network_step(s.network, s.params.dTime, 1), DYN_OK);
            same(&s, step);
            heard += clanks_same(&s);
        }
        assert_true(isfinite(s.masses[0].Wx)); /* an exploded scene would prove nothing */
        dyn_network_destroy(s.network);
    }
    assert_true(heard > 100);
}

static void thesis_step_has_the_oracles_bits(void **unused)
{
    (void)unused;
    agrees(thesis_step_oracle);
}

#ifdef HAVE_LISTING
static void thesis_step_has_the_listings_bits(void **unused)
{
    (void)unused;
    agrees(thesis_step_listing);
}
#else
static void thesis_step_has_the_listings_bits(void **unused)
{
    (void)unused;
    skip_because("the thesis's text is not in ../shared/thesis.txt");
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thesis_step_has_the_oracles_bits),
        cmocka_unit_test(thesis_step_has_the_listings_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
