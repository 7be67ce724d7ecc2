/* clamps.h - masses that follow keyframes: animation by hand or by script; the rest of the
 * network moves by the springs.
 *
 *     dyn_clamps_key(clamps, 3, 0.0, 1, 2);       // mass 3 is at (1, 2) at the beginning,
 *     dyn_clamps_key(clamps, 3, 1.5, 4, 2);       // a second and a half later at (4, 2),
 *     dyn_clamps_free(clamps, 3, 2.0);            // and then let go
 *     dyn_clamps_step(clamps, network, 1.0 / 240, 480);
 *
 * Before its first key a mass moves freely. Between two keys it follows a Catmull-Rom spline
 * (cubic, through the keys; a key's velocity is that between its neighbours, 0 at the ends).
 * After the last key it stays. If it is released within a twentieth of a second after its last
 * key, it keeps the mean velocity between the last two; later it starts at rest.
 *
 * Source: Catmull and Rom, A class of local interpolating splines, 1974.
 *
 * Errors, ownership and threads: as network.h says; clamps belong to one thread at a time, too.
 */
#ifndef LUTETIA_DYN_CLAMPS_H
#define LUTETIA_DYN_CLAMPS_H

#include "network.h"

#include <stdio.h>

enum { DYN_KEYS_MAX = 1000000 };

struct dyn_clamps;

/* Without keys. Errors: NO_MEMORY; *out is then NULL. Owns: the caller destroys *out. */
enum dyn_status dyn_clamps_create(struct dyn_clamps **out);
void dyn_clamps_destroy(struct dyn_clamps *c); /* NULL is fine */

/* Keys may come in any order; a second one for the same mass and time replaces the first.
 * Errors: BAD_ARGUMENT (numbers outside of their ranges: places as masses have them, times
 * -1e12..1e12), TOO_LARGE past DYN_KEYS_MAX, NO_MEMORY; nothing changes. */
enum dyn_status dyn_clamps_key(struct dyn_clamps *c, int mass, double time_s, double x,
                               double y);
enum dyn_status dyn_clamps_free(struct dyn_clamps *c, int mass, double time_s);
int dyn_clamps_count(const struct dyn_clamps *c);

/* Steps as dyn_network_step() does, and moves masses to their places at each step's end.
 * Errors: as dyn_network_step(), and BAD_ARGUMENT for keys of masses that the network lacks;
 * nothing changes. */
enum dyn_status dyn_clamps_step(const struct dyn_clamps *c, struct dyn_network *n, double dt_s,
                                int count);

/* The place of a clamped mass at a time. False: it is not clamped then. */
bool dyn_clamps_at(const struct dyn_clamps *c, int mass, double time_s, double *x, double *y);

/* As text: `clamps 1`, then lines `key MASS TIME X Y` and `free MASS TIME`, then `end`. Errors:
 * as dyn_network_read() and dyn_network_write(). Owns: the caller destroys *out. */
enum dyn_status dyn_clamps_parse(const char *text, size_t bytes, const char *name,
                                 struct dyn_clamps **out);
enum dyn_status dyn_clamps_read(const char *path, struct dyn_clamps **out);
enum dyn_status dyn_clamps_write(const struct dyn_clamps *c, const char *path);
enum dyn_status dyn_clamps_print(const struct dyn_clamps *c, FILE *to);

#endif
