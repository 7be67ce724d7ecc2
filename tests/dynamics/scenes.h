/* scenes.h - networks that several tests use. */
#ifndef LUTETIA_TESTS_DYNAMICS_SCENES_H
#define LUTETIA_TESTS_DYNAMICS_SCENES_H

#include <network.h>
#include <stdint.h>

/* Draws a number from least to most. */
double scene_chance(uint64_t *state, double least, double most);

/* Draws a network: random masses, springs between some of them, a random world (with walls,
 * wind, breaking springs), and tacked and pulled masses. A step of 1/240 s has at most a few
 * parts, so that tests are quick. */
struct dyn_network *scene_by_chance(uint64_t *state);

/* A square of four masses with springs along its edges and diagonals; its lower left corner is
 * at (x, y). k: the springs' constant; c: their damping. */
struct dyn_network *scene_letter(double x, double y, double k, double c);

void scene_spring(struct dyn_network *n, int a, int b, double k, double c);

/* Compares doubles; cmocka's own macro compares floats. Include after <cmocka.h>. */
#define assert_near(is, want, epsilon)                                                         \
    do {                                                                                       \
        double is_ = (is), want_ = (want);                                                     \
        if (!(is_ - want_ <= (epsilon) && want_ - is_ <= (epsilon)))                           \
            fail_msg("%s is %.17g, not %.17g", #is, is_, want_);                               \
    } while (0)

/* Aborts if status is not DYN_OK. */
void scene_must(enum dyn_status status);

#endif
