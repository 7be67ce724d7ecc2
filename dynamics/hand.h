/* hand.h - a hand in a network: holds, pulls and tacks masses, and cuts springs.
 *
 *     int mass = dyn_network_nearest(network, x, y, 0.3);
 *     dyn_pull_begin(network, mass, x, y, 200);     // a light pull: a spring of the hand's own
 *     ... dyn_pull_move(network, mass, x, y) ...
 *     dyn_mass_tack(network, mass);                 // pressed harder: it stays, with a click
 *
 * Source: the thesis, section 2.1, with masses that a cursor holds and masses that stick.
 *
 * Errors: functions return a status and leave one line in dyn_error(); after an error nothing
 * has changed.
 *
 * Ownership and threads: as network.h says.
 */
#ifndef LUTETIA_DYN_HAND_H
#define LUTETIA_DYN_HAND_H

#include "network.h"

enum { DYN_PULLS_MAX = 32 };

/* Holds the mass at the point, from now on; called again, moves it. A held mass does not move
 * by itself. Errors: BAD_ARGUMENT (no such mass, or a place that is not a number within the
 * field's range). */
enum dyn_status dyn_mass_hold(struct dyn_network *n, int mass, double x, double y);
/* Releases a held mass: a twang, if one of its springs is strained by more than a fiftieth.
 * Errors: BAD_ARGUMENT (no such mass). */
enum dyn_status dyn_mass_release(struct dyn_network *n, int mass);

/* Pulls the mass to the point by a spring of that constant and zero length, damped to a third
 * of the critical damping. A mass has one pull: a second begin moves it. Errors: as
 * dyn_mass_hold(); TOO_LARGE past DYN_PULLS_MAX; to move a pull that there is not is
 * BAD_ARGUMENT. */
enum dyn_status dyn_pull_begin(struct dyn_network *n, int mass, double x, double y,
                               double constant);
enum dyn_status dyn_pull_move(struct dyn_network *n, int mass, double x, double y);
/* Ends the pull, if there is one, with a twang as for a release. Errors: as
 * dyn_mass_release(). */
enum dyn_status dyn_pull_end(struct dyn_network *n, int mass);

/* Tacks the mass where it is: a click, unless it is tacked already; ends a pull or hold on
 * it. Errors: as dyn_mass_release(). */
enum dyn_status dyn_mass_tack(struct dyn_network *n, int mass);
/* Takes the tack out. Errors: as dyn_mass_release(). */
enum dyn_status dyn_mass_untack(struct dyn_network *n, int mass);

/* Moves the mass to the point, at rest. Errors: as dyn_mass_hold(). */
enum dyn_status dyn_mass_place(struct dyn_network *n, int mass, double x, double y);

/* Moves the mass to the point and tacks it: to shape a word. Errors: as dyn_mass_hold(). */
enum dyn_status dyn_mass_clamp(struct dyn_network *n, int mass, double x, double y);

/* Cuts the spring: a snap, unless it is broken already. Errors: BAD_ARGUMENT (no such
 * spring). */
enum dyn_status dyn_spring_cut(struct dyn_network *n, int spring);
/* Cuts all springs that the line between the two points crosses; *cut: how many. Errors:
 * BAD_ARGUMENT (a point that is not finite). */
enum dyn_status dyn_network_cut(struct dyn_network *n, double x0, double y0, double x1,
                                double y1, int *cut);
/* Gives both ends a velocity across the spring, in opposite directions: a twang. Errors:
 * BAD_ARGUMENT (no such spring, or a speed that is not a number). */
enum dyn_status dyn_spring_pluck(struct dyn_network *n, int spring, double speed);

#endif
