/* bounce.h - bounces at the sides, in the middle of a part.
 *
 * A part moves masses along straight lines, by forces of its beginning; in its middle a mass
 * bounces, and forces change as they would not have. What the bounce reckons with is the motion
 * that the parts' places lie on. In a part of length h, of which the fraction r has passed, a
 * mass that began with the velocity v, the acceleration a and its change J has
 *
 *     p = v + r h a + (r h)2 J / 2
 *     x = x0 + r h v + (r h)2 a / 2 + (r3 - r) h3 J / 6,    and the speed  w = p - h2 J / 6
 *
 * (p is a moment of the energy that symplectic parts keep, H + h2 (p V'' p / 6 - a2 m / 12) /
 * 2; w is how fast x is). The bounce turns w round, times the restitution, at the same x: this
 * keeps that energy exactly. With K the stiffness between the mass and another, J = sum K
 * (p_other - p) / m jumps, for the others, too. From the new p the part's own numbers are
 * computed back: the velocity in its middle and the place at its end, of the mass and of those
 * that hang on it. */
#ifndef LUTETIA_DYN_BOUNCE_H
#define LUTETIA_DYN_BOUNCE_H

#include "internal.h"

/* There are sides, and something that bounces. */
bool dyn_bounces_possible(const struct dyn_world *world);

/* Makes room for the bounces of a part, and finds the springs of each mass, where anything can
 * bounce. False: no memory. */
bool dyn_bounces_prepare(struct dyn_network *n);
void dyn_bounces_finish(struct dyn_prepared *p);

/* Makes the part's bounces, all from the state before them, and reports them. */
void dyn_bounces_make(struct dyn_job *job);

#endif
