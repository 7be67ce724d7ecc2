/* scenes.h - networks that several tests use. */
#ifndef LUTETIA_TESTS_DYNAMICS_SCENES_H
#define LUTETIA_TESTS_DYNAMICS_SCENES_H

#include <network.h>
#include <stdint.h>

/* From least to most. */
double scene_chance(uint64_t *state, double least, double most);

/* A number of masses by chance, springs between some, a world by chance (with walls, wind, breaking springs), tacked and
 * pulled masses. What could be slow is not in it: at most a few parts a step of 1/240 s. */
struct dyn_network *scene_by_chance(uint64_t *state);

/* A square of four masses with its edges and diagonals, lower left corner at (x, y). k: of the springs; c: their damping. */
struct dyn_network *scene_letter(double x, double y, double k, double c);

void scene_spring(struct dyn_network *n, int a, int b, double k, double c);

/* In doubles; cmocka's own is in floats. After <cmocka.h>. */
#define assert_near(is, want, epsilon)                                                         \
    do {                                                                                       \
        double is_ = (is), want_ = (want);                                                     \
        if (!(is_ - want_ <= (epsilon) && want_ - is_ <= (epsilon)))                           \
            fail_msg("%s is %.17g, not %.17g", #is, is_, want_);                               \
    } while (0)

/* Dies where what must be fine is not. */
void scene_must(enum dyn_status status);

#endif
