/* scenes.c - see scenes.h. */
#include "scenes.h"

#include <hand.h>
#include <stdio.h>
#include <stdlib.h>

#include "sample.h"

void scene_must(enum dyn_status status)
{
    if (status == DYN_OK)
        return;
    fprintf(stderr, "unexpected: %s\n", dyn_error());
    abort();
}

double scene_chance(uint64_t *state, double least, double most)
{
    return least + (most - least) * (double)(sample_word(state) >> 11) * 0x1p-53;
}

void scene_spring(struct dyn_network *n, int a, int b, double k, double c)
{
    struct dyn_spring spring = dyn_spring_usual();
    spring.end[0] = a;
    spring.end[1] = b;
    spring.constant = k;
    spring.damping = c;
    scene_must(dyn_spring_add(n, &spring, NULL));
}

struct dyn_network *scene_letter(double x, double y, double k, double c)
{
    struct dyn_network *n;
    scene_must(dyn_network_create(&n));
    for (int i = 0; i < 4; i++) {
        struct dyn_mass mass = dyn_mass_usual();
        mass.x = x + (i & 1);
        mass.y = y + (i >> 1);
        scene_must(dyn_mass_add(n, &mass, NULL));
    }
    static const int ends[6][2] = {{0, 1}, {1, 3}, {3, 2}, {2, 0}, {0, 3}, {1, 2}};
    for (int i = 0; i < 6; i++)
        scene_spring(n, ends[i][0], ends[i][1], k, c);
    return n;
}

static struct dyn_world world_by_chance(uint64_t *state)
{
    struct dyn_world w = dyn_world_usual();
    w.gravity = scene_chance(state, -5, 20);
    w.wind_x = scene_chance(state, -3, 3);
    w.wind_y = scene_chance(state, -3, 3);
    w.drag = scene_chance(state, 0, 2);
    w.stiffness = scene_chance(state, 0.2, 2);
    w.damping = scene_chance(state, 0, 2);
    w.rest = scene_chance(state, 0.5, 1.5);
    w.mass = scene_chance(state, 0.5, 2);
    w.restitution = scene_chance(state, 0, 1);
    w.friction = scene_chance(state, 0, 2);
    w.floor_on = sample_word(state) % 4 > 0;
    w.ceiling_on = sample_word(state) % 2 > 0;
    w.left_on = sample_word(state) % 2 > 0;
    w.right_on = sample_word(state) % 2 > 0;
    w.ceiling = 6;
    w.left = -0.5;
    w.right = 7;
    w.speed_limit = sample_word(state) % 4 ? 1000 : 5;
    w.safety = scene_chance(state, 0.1, 0.9);
    w.integrator = sample_word(state) % 3 ? DYN_SYMPLECTIC : DYN_VERLET;
    return w;
}

struct dyn_network *scene_by_chance(uint64_t *state)
{
    struct dyn_network *n;
    struct dyn_world world = world_by_chance(state);
    scene_must(dyn_network_create(&n));
    scene_must(dyn_network_world_set(n, &world));
    int masses = 1 + (int)(sample_word(state) % 40), springs = 2 * masses;
    for (int i = 0; i < masses; i++) {
        struct dyn_mass mass = {.x = scene_chance(state, 0, 6),
                                .y = scene_chance(state, -0.5, 6),
                                .vx = scene_chance(state, -4, 4),
                                .vy = scene_chance(state, -4, 4),
                                .mass = scene_chance(state, 0.3, 3),
                                .drag = scene_chance(state, 0, 0.5),
                                .gravity = scene_chance(state, -0.2, 2),
                                .restitution = scene_chance(state, 0, 2),
                                .friction = scene_chance(state, 0, 2),
                                .hold = sample_word(state) % 8 ? DYN_FREE : DYN_STUCK};
        scene_must(dyn_mass_add(n, &mass, NULL));
    }
    for (int i = 0; masses > 1 && i < springs; i++) {
        int a = (int)(sample_word(state) % (uint64_t)masses);
        struct dyn_spring spring = dyn_spring_usual();
        spring.end[0] = a;
        spring.end[1] = (a + 1 + (int)(sample_word(state) % (uint64_t)(masses - 1))) % masses;
        spring.constant = scene_chance(state, 0, 500);
        spring.damping = scene_chance(state, 0, 5);
        if (sample_word(state) % 4 == 0)
            spring.breaking_strain = scene_chance(state, 0.05, 1);
        scene_must(dyn_spring_add(n, &spring, NULL));
    }
    if (sample_word(state) % 2)
        scene_must(dyn_pull_begin(n, 0, scene_chance(state, 0, 6), 3, 100));
    return n;
}
