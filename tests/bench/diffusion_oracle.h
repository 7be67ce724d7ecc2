/* diffusion_oracle.h - the diffusion step as a plain double loop with the listing's operations.
 * The benchmark's peers are compared with it. */
#ifndef TEST_DIFFUSION_ORACLE_H
#define TEST_DIFFUSION_ORACLE_H

#include "scene.h"

struct oracle {
    const struct diffusion_scene *s;
    float *field[DIFFUSION_FIELDS_COUNT], *inflow, *inward, *outward;
};

/* Makes a scene. rim: the rectangle's distances from the left, top, right and bottom edge. */
void oracle_scene_init(struct diffusion_scene *s, int width, int height, const int rim[4]);

/* s: borrowed until oracle_finish. */
void oracle_init(struct oracle *o, const struct diffusion_scene *s);
void oracle_steps(struct oracle *o, int steps_count);
void oracle_finish(struct oracle *o);
/* Fails if a bit of the field differs from the oracle's. mine: row-major. */
void oracle_compare(const struct oracle *o, const char *what, int field, const float *mine);

#endif
