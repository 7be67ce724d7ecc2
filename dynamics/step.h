/* step.h - steps of time.
 *
 *     dyn_network_step(network, 1.0 / 60, 1);
 *
 * Forces. A spring between a and b with d = b - a, of length l, and dv the difference of their
 * velocities, pulls a towards b with
 *     F = k (l - rest) + c (dv . d) / l
 * and b towards a. A mass has its weight, m g, and the air's drag, b (wind - v).
 *
 * Symplectic (usual): v += h F / m, then p += h v: semi-implicit Euler, which keeps energy.
 * Drag is taken implicitly: v = (v + h F/m) / (1 + h b/m), which cannot overshoot.
 *
 * Verlet: half of that to v, p += h v, forces again at the new place, the other half to v.
 * Second order; a step finds the forces once more than it has parts.
 *
 * Parts. h is the step divided by the number of parts that stability requires. Of the mass i
 * with K = sum 2 k / m and C = sum 2 c / m over its springs (1 instead of 2 where the other end
 * is not free), a step is stable while h C / 2 + h2 K / 4 < 1 (Gershgorin's bound on the
 * quadratic form 4 M - 2 h C - h2 K), which for one oscillator is dt < 2 (sqrt(1 + z2) - z) /
 * w. h is at most `safety` times the least of these. If more than DYN_PARTS_MAX parts would be
 * needed, springs on the masses that need them are softened until that many suffice, and
 * counted.
 *
 * If a mass can bounce with a restitution above 0.95, h is at most a 32nd of that least: then
 * only the length of parts decides how energy is kept.
 *
 * Sides. A mass that is below the floor and moves down bounces as bounce.h says: at the place
 * and the speed of the smooth motion on which the parts' places lie. If it is slower than
 * gravity makes a mass in two parts, or its springs both turned it round and brought it there
 * in one part, and its restitution is at most 0.95, it comes to rest. Friction reduces the
 * tangential velocity by at most the coefficient of friction times the change of the normal
 * velocity. Walls and ceiling act in the same way.
 *
 * Thesis: the listing in its appendix 7.1, operation for operation, in doubles: one part;
 * floor, gravity and drag; no wind, walls, friction, damping of springs or pulls, and a
 * restitution and clank that are the world's. See docs/springs.md.
 *
 * AVX-512, AVX2 and plain C give the same bits.
 *
 * Errors, ownership and threads: as network.h says. */
#ifndef LUTETIA_DYN_STEP_H
#define LUTETIA_DYN_STEP_H

#include "network.h"

enum { DYN_PARTS_MAX = 1024 };

/* Makes `count` steps of dt_s each. Errors: BAD_ARGUMENT: dt_s is not 1e-9..1, or count is
 * negative; NO_MEMORY; the network is unchanged. */
enum dyn_status dyn_network_step(struct dyn_network *n, double dt_s, int count);

/* For steps of dt_s with the present parameters: the number of parts, and of softened
 * springs. Errors: BAD_ARGUMENT (dt_s as above), NO_MEMORY. */
struct dyn_plan {
    double stable_s; /* the longest stable part; INFINITY without springs */
    int parts, softened;
};
enum dyn_status dyn_network_plan(struct dyn_network *n, double dt_s, struct dyn_plan *out);

enum dyn_simd { DYN_SIMD_PLAIN, DYN_SIMD_AVX2, DYN_SIMD_AVX512 };

/* From now on all threads use the best of the variants up to `most` that this processor
 * supports. Returns it. At first it is the fastest: AVX2 where AVX-512 is computed in halves.
 * Threads: not while another one steps. */
enum dyn_simd dyn_simd_use(enum dyn_simd most);
/* "AVX2" and so on: a constant, valid for ever; never NULL. */
const char *dyn_simd_name(enum dyn_simd simd);

#endif
