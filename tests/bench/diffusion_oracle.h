/* diffusion_oracle.h - the diffusion step as a plain double loop, operation by operation as the
 * listing: what the benchmark's peers are compared with. */
#ifndef TEST_DIFFUSION_ORACLE_H
#define TEST_DIFFUSION_ORACLE_H

#include "scene.h"

struct oracle {
    const struct diffusion_scene *s;
    float *field[DIFFUSION_FIELDS_COUNT], *inflow, *inward, *outward;
};

/* A scene; rim: the rectangle's distance from each edge: left, top, right, bottom. */
void oracle_scene_init(struct diffusion_scene *s, int width, int height, const int rim[4]);

/* s: borrowed until oracle_finish. */
void oracle_init(struct oracle *o, const struct diffusion_scene *s);
void oracle_steps(struct oracle *o, int steps_count);
void oracle_finish(struct oracle *o);
/* Fails the test where a bit of field differs from the oracle's; mine: row-major. */
void oracle_compare(const struct oracle *o, const char *what, int field, const float *mine);

#endif
