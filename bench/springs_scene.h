/* springs_scene.h - the measured networks, as plain arrays, and other implementations of the
 * step: C loops, OpenMP, Chipmunk, Box2D.
 *
 *     struct springs_scene scene;
 *     if (!springs_scene_grid(&scene, 100, 100))
 *         return false;
 *     struct springs_plain *plain = springs_plain_create(&scene);
 *     springs_plain_step(plain, 1.0 / 240, 240);
 *     springs_plain_destroy(plain);
 *     springs_scene_finish(&scene);
 *
 * Errors. Functions that can fail return false or NULL, and bench_error() says why; for the
 * two engines, memory was short.
 */
#ifndef LUTETIA_BENCH_SPRINGS_SCENE_H
#define LUTETIA_BENCH_SPRINGS_SCENE_H

#include <stdbool.h>

struct springs_mass {
    double x, y, vx, vy, mass;
    bool fixed;
};

struct springs_spring {
    int a, b;
    double constant, rest_length, damping;
};

struct springs_scene {
    struct springs_mass *masses;
    struct springs_spring *springs;
    int masses_count, springs_count;
    double gravity;
    bool has_floor; /* at 0 */
    double restitution, friction;
};

/* width x height masses a unit apart that hang from the upper row, with springs along rows,
 * columns and both diagonals. */
bool springs_scene_grid(struct springs_scene *s, int width, int height);
/* Letters as springy words have them, four masses and six springs each, linked by pairs, that
 * fall onto a floor. */
bool springs_scene_word(struct springs_scene *s, int letters);
void springs_scene_finish(struct springs_scene *s);

/* Straightforward loops over structs, in doubles: semi-implicit Euler. */
struct springs_plain;
struct springs_plain *springs_plain_create(const struct springs_scene *s);
void springs_plain_destroy(struct springs_plain *p); /* NULL is fine */
void springs_plain_step(struct springs_plain *p, double dt_s, int count);
/* x, y, vx, vy of a mass. */
void springs_plain_state(const struct springs_plain *p, int mass, double state[4]);

/* The same with OpenMP: threads share the springs, whose forces are kept, and then the masses,
 * which add up those of their springs. */
struct springs_openmp;
struct springs_openmp *springs_openmp_create(const struct springs_scene *s);
void springs_openmp_destroy(struct springs_openmp *p);
void springs_openmp_step(struct springs_openmp *p, double dt_s, int count);
void springs_openmp_state(const struct springs_openmp *p, int mass, double state[4]);

/* Chipmunk: a body for each mass and a damped spring for each spring, one iteration. NULL, too,
 * where it was not there when this was built: springs_chipmunk_built. */
extern const bool springs_chipmunk_built;
struct springs_chipmunk;
struct springs_chipmunk *springs_chipmunk_create(const struct springs_scene *s);
void springs_chipmunk_destroy(struct springs_chipmunk *p);
void springs_chipmunk_step(struct springs_chipmunk *p, double dt_s, int count);
void springs_chipmunk_state(const struct springs_chipmunk *p, int mass, double state[4]);

/* Box2D: a body for each mass and a soft distance joint for each spring, one iteration of each
 * kind. */
extern const bool springs_box2d_built;
struct springs_box2d;
struct springs_box2d *springs_box2d_create(const struct springs_scene *s);
void springs_box2d_destroy(struct springs_box2d *p);
void springs_box2d_step(struct springs_box2d *p, double dt_s, int count);
void springs_box2d_state(const struct springs_box2d *p, int mass, double state[4]);

#endif
