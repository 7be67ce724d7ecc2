/* debug.h - what a debugger calls and reads in a running program: `lutetia debug`, whose other
 * half is Python within gdb (host/lutetia/debug).
 *
 *     (gdb) field heat        ->  CM_debug_field (heat, 0, 0, 0)      an answer in the program's memory
 *
 * An answer begins with two numbers of 64 bits, the bytes of all of it and those of the text;
 * the text follows, JSON; then the arrays that it names by their place. It is there until the
 * next is asked for.
 *
 * What is asked of fields is computed in a child of fork(), so the program's own machine, its
 * plans and the calls that it foresees stay as they are. Where the device has memory of its
 * own, a child has no machine: there the machine itself is asked, which computes what waits, as
 * each look of the program's does.
 *
 * Threads: the one that makes CM_ calls. A wrong question is answered by a text with
 * "error". */
#ifndef PARIS_DEBUG_H
#define PARIS_DEBUG_H

#include <stdint.h>

#define PARIS_SEEN __attribute__((visibility("default")))

/* The debugger stops here; CM_debug_text says why. */
PARIS_SEEN void CM_debug_stop(void);
PARIS_SEEN extern char CM_debug_text[1600];
/* The debugger sets it before it asks: 1, the program has crashed, or is in a library, and may
 * hold the C library's locks. Then those are not waited for. */
PARIS_SEEN extern unsigned int CM_debug_locked;

/* The values of a field of any VP set, and that set's context. letter: 'u', 's', 'f'; 0: as it
 * was stored. len 0: all from here on. */
PARIS_SEEN const void *CM_debug_field(unsigned int field, unsigned int letter, unsigned int len,
                                      unsigned int e);
/* A flag (enum machine_flag) of the current VP set. */
PARIS_SEEN const void *CM_debug_flag(unsigned int flag);
/* What there is, and what waits. Computes nothing. */
PARIS_SEEN const void *CM_debug_state(void);

enum paris_watched { PARIS_WATCH_CHANGES = 1, PARIS_WATCH_NAN = 2 };
/* From now on, after each call, the debugger is stopped if the value of a processor (row-major
 * index; PARIS_WATCH_NAN: ~0ul, any) has changed, or has become a NaN. Returns the watch's
 * number, from 1 on; 0: CM_debug_text says why not. */
PARIS_SEEN unsigned int CM_debug_watch(unsigned int field, unsigned int letter,
                                       unsigned int len, unsigned int e, unsigned long index,
                                       unsigned int how);
PARIS_SEEN void CM_debug_unwatch(unsigned int watch);

/* Tells a debugger. */
void paris_debug_tell(const char *text);

#endif
