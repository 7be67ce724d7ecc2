/* energy.h - a network's energy, by kind.
 *
 *     struct dyn_energy e = dyn_network_energy(network);
 *     double all = e.motion + e.gravity + e.springs + e.pulls;
 *
 * Errors, ownership and threads: as network.h says. */
#ifndef LUTETIA_DYN_ENERGY_H
#define LUTETIA_DYN_ENERGY_H

#include "network.h"

/* kg units2/s2. */
struct dyn_energy {
    double motion; /* kinetic, of masses that are free */
    /* potential, against the floor's height (0 without a floor), of masses that are free */
    double gravity;
    double springs; /* potential, of springs that are not broken */
    double pulls;   /* potential, of the hand's springs */
};

/* The energy of the present state. */
struct dyn_energy dyn_network_energy(const struct dyn_network *n);

#endif
