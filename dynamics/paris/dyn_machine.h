/* dyn_machine.h - large networks as a program in C/Paris: a processor for each mass and one for
 * each spring.
 *
 *     struct dyn_machine *machine;
 *     if (dyn_machine_create(network, 1.0 / 240, &machine) != DYN_OK || dyn_machine_step(machine, 240) != DYN_OK ||
 *         dyn_machine_read(machine, network) != DYN_OK)
 *         die(dyn_error());
 *     dyn_machine_destroy(machine);
 *
 * It makes the symplectic step of step.h, in doubles, in the same parts: each spring gets the
 * states of its two masses and finds its force; each mass gets the forces of its springs, adds
 * them, moves and meets the sides. A mass of very many springs has no room for the addresses of
 * all: the forces of the rest are sent to it. Springs break. What differs from
 * dyn_network_step(): the order in which a mass's forces are added (first those of springs
 * whose first end it is); nothing is heard.
 *
 * In parts in which masses bounce, the machine waits while the front end reads them, makes the
 * bounces with the library's function and writes them back.
 *
 * Errors: functions that can fail return a status and leave one line in dyn_error().
 *
 * Ownership: the network's parameters are copied at creation; later changes have no effect.
 *
 * Threads: all calls of Paris and of this header are made by one thread. */
#ifndef LUTETIA_DYN_MACHINE_H
#define LUTETIA_DYN_MACHINE_H

#include <network.h>

struct dyn_machine;

/* Errors: BAD_ARGUMENT (no masses or no springs; another integrator than symplectic; a hand
 * pulls; dt_s as in step.h), NO_MEMORY. Errors of the machine are BAD_ARGUMENT, too, with
 * the machine's message. Owns: the caller destroys *out. */
enum dyn_status dyn_machine_create(struct dyn_network *n, double dt_s,
                                   struct dyn_machine **out);
void dyn_machine_destroy(struct dyn_machine *m); /* NULL is fine */

/* Requests that many steps; the machine computes them when they are observed. Errors: those
 * of the machine. */
enum dyn_status dyn_machine_step(struct dyn_machine *m, int count);

/* Waits until all steps are computed. Errors: those of the machine. */
enum dyn_status dyn_machine_finish(struct dyn_machine *m);

/* Copies states, broken springs and the time to a network like the one at creation. Errors:
 * those of the machine, NO_MEMORY, BAD_ARGUMENT: the network has other counts. */
enum dyn_status dyn_machine_read(struct dyn_machine *m, struct dyn_network *n);

#endif
