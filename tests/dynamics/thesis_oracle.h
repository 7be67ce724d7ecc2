/* thesis_oracle.h - the thesis's step, with the thesis's names, for test_thesis.c. It is
 * written again operation by operation (thesis_oracle.c), and compiled from the thesis's text
 * where that is present (listing.py). */
#ifndef LUTETIA_TESTS_THESIS_ORACLE_H
#define LUTETIA_TESTS_THESIS_ORACLE_H

struct thesis_mass {
    double Wx, Wy, VelX, VelY, AccelX, AccelY, ForceX, ForceY, mass;
    int sticky;
};

struct thesis_spring {
    double Theta, Distance, k, rest_length, ForceX, ForceY;
    int end[2];
};

struct thesis_params {
    int springs, masses, selected; /* selected: -1 none */
    double gravity, damping, floor, dTime;
};

/* Makes one step and sets the springs' angles and lengths. */
typedef void thesis_step(const struct thesis_params *params, struct thesis_mass *masses,
                         struct thesis_spring *springs, void (*clank)(int velocity));

thesis_step thesis_step_oracle, thesis_step_listing;

#endif
