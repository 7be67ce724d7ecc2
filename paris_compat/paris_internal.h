/* paris_internal.h - the Paris library's functions for the rest of the project, besides
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
 * from the environment or from the configuration last given to paris_reset(). Threads. All
 * functions must be called by the one thread that makes CM_ calls.
 */
#ifndef PARIS_INTERNAL_H
#define PARIS_INTERNAL_H

#include "machine.h"

/* Returns the machine, and makes it if there is none. Errors: if none can be made, prints
 * one line and exits with 1. Owns: the library; valid until paris_reset(), CM_cold_boot() or
 * CM_detach(). */
struct machine *paris_machine(void);

/* Destroys the machine with its whole content, and makes another. Errors: false, with
 * paris_error(); there is no machine then. config NULL: from the environment. */
bool paris_reset(const struct machine_config *config);

/* Sets the initial safety mode of programs: strict, but without the checks that
 * CM_set_safety_mode (1) adds; lenient if LUTETIA_LENIENT=1. CM_set_safety_mode (0) is
 * lenient. */
void paris_safety_usual(void);

/* The text of the last failure, one line; "" if none. */
const char *paris_error(void);

/* The lights of the front panel: one byte, 0 or 1, for each processor of the VP set that
 * latched last, in row-major order. Returns how many there are and writes at most limit; 0
 * before the first CM_latch_leds. */
uint64_t paris_leds_read(uint8_t *out, uint64_t limit);

/* ---- the 4096 lights of the machine's front ---- */

enum { PARIS_LIGHTS = 4096, PARIS_LIGHTS_COLUMNS = 64, PARIS_LIGHTS_BYTES = PARIS_LIGHTS / 8 };

/* The lights for that pattern: light l is bit l mod 8 of byte l div 8; leds.c defines the
 * processors of each light. False: nothing has been latched. */
bool paris_lights_read(uint8_t lights[PARIS_LIGHTS_BYTES]);

/* The system's own patterns, by their modes: all on; each light for itself, drawn anew in
 * each step; rows of random lights that move one step, odd ones to the left and even ones to
 * the right. All come from a shift register, and are the same each time. */
enum paris_pattern_mode {
    PARIS_PATTERN_ON = 1,
    PARIS_PATTERN_NOISE = 5,
    PARIS_PATTERN_RANDOM = 7,
    PARIS_PATTERNS_LAST = 7 /* modes between are as RANDOM */
};
struct paris_pattern {
    unsigned int mode;
    uint16_t shift;
    bool begun;
    uint64_t rows[64]; /* column 0 in bit 63 */
};
struct paris_pattern paris_pattern_begin(unsigned int mode);
void paris_pattern_step(struct paris_pattern *p, uint8_t lights[PARIS_LIGHTS_BYTES]);

#endif
