/* dyn_machine.h - large networks as a program in C/Paris: a processor for each mass and one for each spring.
 *
 *     struct dyn_machine *machine;
 *     if (dyn_machine_create(network, 1.0 / 240, &machine) != DYN_OK || dyn_machine_step(machine, 240) != DYN_OK ||
 *         dyn_machine_read(machine, network) != DYN_OK)
 *         die(dyn_error());
 *     dyn_machine_destroy(machine);
 *
 * It makes the symplectic step of step.h, in doubles, in the same parts: each spring gets the states of its two masses and finds its
 * force; each mass gets the forces of its springs, adds them, moves and meets the sides. A mass of very many springs has no room for
 * the addresses of all: the forces of the rest are sent to it. Springs break. What differs from dyn_network_step(): the order in
 * which a mass's forces are added (first those of springs whose first end it is); at the edge of the plane, where there is no
 * side, masses stop and do not bounce; nothing is heard.
 *
 * The network's parameters are copied when it is made; later changes of them are not seen.
 *
 * Threads. Paris's calls belong to one thread, and so do these. */
#ifndef LUTETIA_DYN_MACHINE_H
#define LUTETIA_DYN_MACHINE_H

#include <network.h>

struct dyn_machine;

/* Errors: BAD_ARGUMENT (no masses or no springs; another integrator than symplectic; a hand pulls; dt_s as in step.h), NO_MEMORY,
 * and BAD_FILE never: what the machine says, too, is BAD_ARGUMENT, with its words. */
enum dyn_status dyn_machine_create(struct dyn_network *n, double dt_s,
                                   struct dyn_machine **out);
void dyn_machine_destroy(struct dyn_machine *m); /* NULL is fine */

/* Asks for so many steps; the machine computes them when they are looked at. Errors: what the machine says. */
enum dyn_status dyn_machine_step(struct dyn_machine *m, int count);

/* Waits until all that was asked for is computed. Errors: what the machine says. */
enum dyn_status dyn_machine_finish(struct dyn_machine *m);

/* Puts states and broken springs into a network like the one it was made of, and its time on. Errors: what the machine says,
 * NO_MEMORY, BAD_ARGUMENT: the network has other counts. */
enum dyn_status dyn_machine_read(struct dyn_machine *m, struct dyn_network *n);

#endif
