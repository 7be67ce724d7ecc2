/* step.h - time goes on.
 *
 *     dyn_network_step(network, 1.0 / 60, 1);
 *
 * Forces. A spring between a and b with d = b - a, of length l, and dv the difference of their speeds, pulls a towards b with
 *     F = k (l - rest) + c (dv . d) / l
 * and b towards a. A mass has its weight, m g, and the air's drag, b (wind - v).
 *
 * Symplectic (usual): v += h F / m, then p += h v: semi-implicit Euler, which keeps energy. Drag is taken implicitly:
 * v = (v + h F/m) / (1 + h b/m), which cannot overshoot.
 *
 * Verlet: half of that to v, p += h v, forces again at the new place, the other half to v. Second order; a step finds
 * the forces once more than it has parts.
 *
 * Parts. h is the step over as many parts as stability asks for. Of the mass i with K = sum 2 k / m and C = sum 2 c / m over
 * its springs (1 instead of 2 where the other end is not free), a step is stable while h C / 2 + h2 K / 4 < 1 (Gershgorin's
 * bound on the quadratic form 4 M - 2 h C - h2 K), which for one oscillator is dt < 2 (sqrt(1 + z2) - z) / w. h is at most
 * `safety` times the least of these. Where that would be more than DYN_PARTS_MAX parts, springs on the masses that ask
 * for them are softened to what that many bear, and counted.
 *
 * Sides. A mass that is beyond the floor, going down, comes back: its speed is reversed times the restitution e, and its
 * place is as far above as it came below, times e. Where it hits more slowly than gravity makes it in two parts, e is 0: it lies. Friction
 * takes from the speed along the floor at most friction times the change of the other. Walls and ceiling are the same.
 *
 * Thesis: the listing in its appendix 7.1, operation for operation, in doubles: one part; floor, gravity and drag; no wind, walls,
 * friction, damping of springs or pulls, and a restitution and clank that are the world's. See docs/springs.md.
 *
 * The same bits come from AVX-512, AVX2 and plain C. */
#ifndef LUTETIA_DYN_STEP_H
#define LUTETIA_DYN_STEP_H

#include "network.h"

enum { DYN_PARTS_MAX = 1024 };

/* Makes `count` steps of dt_s each. Errors: BAD_ARGUMENT: dt_s is not 1e-9..1, or count is negative; NO_MEMORY; the network
 * is as it was. */
enum dyn_status dyn_network_step(struct dyn_network *n, double dt_s, int count);

/* Of steps of dt_s, as things are: how many parts, and how many springs are softened. */
struct dyn_plan {
    double stable_s; /* the longest part that is stable; INFINITY without springs */
    int parts, softened;
};
enum dyn_status dyn_network_plan(struct dyn_network *n, double dt_s, struct dyn_plan *out);

enum dyn_simd { DYN_SIMD_PLAIN, DYN_SIMD_AVX2, DYN_SIMD_AVX512 };

/* The best of those up to `most` that this processor has is used from now on, by all threads. Returns it. */
enum dyn_simd dyn_simd_use(enum dyn_simd most);
const char *dyn_simd_name(enum dyn_simd simd);

#endif
