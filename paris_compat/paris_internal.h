/* paris_internal.h - what the rest of the project may ask of the Paris library besides
 * <cm/paris.h>.
 *
 *     struct machine_config config = machine_config_default();
 *     config.eager = 1;
 *     if (paris_reset(&config)) {
 *         ... CM_ calls ...
 *         machine_finish(paris_machine());
 *         machine_stats_get(paris_machine(), &stats);
 *     }
 *
 * Paris has one machine, made by CM_init, CM_attach, CM_cold_boot or the first instruction,
 * from the environment or from the configuration last given to paris_reset(). Threads. All of
 * it belongs to the one thread that makes CM_ calls. */
#ifndef PARIS_INTERNAL_H
#define PARIS_INTERNAL_H

#include "machine.h"

/* The machine, made if there is none. Errors: where none can be made, one line is printed and
 * the program exits with 1. Owns: the library does; valid until paris_reset(), CM_cold_boot()
 * or CM_detach(). */
struct machine *paris_machine(void);

/* Destroys the machine with all that is on it and makes another. Errors: false, and
 * paris_error() says why; there is no machine then. config NULL: from the environment. */
bool paris_reset(const struct machine_config *config);

/* The text of the last failure, one line; "" if none. */
const char *paris_error(void);

/* The lights of the front panel: one byte, 0 or 1, for each processor of the VP set that
 * latched last, in row-major order. Returns how many there are and writes at most limit; 0
 * before the first CM_latch_leds. */
uint64_t paris_leds_read(uint8_t *out, uint64_t limit);

#endif
