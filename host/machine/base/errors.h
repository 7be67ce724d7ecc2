/* errors.h - errors: the caller's are a status and a line of text; a broken invariant of
 * ours ends the program. */
#ifndef LUTETIA_MACHINE_ERRORS_H
#define LUTETIA_MACHINE_ERRORS_H

#include "machine.h"

/* Checks an invariant of ours, never the caller's arguments. Stays in release builds. */
#define INVARIANT(condition)                                                                   \
    ((condition) ? (void)0 : machine_invariant_failed(#condition, __FILE__, __LINE__))
_Noreturn void machine_invariant_failed(const char *what, const char *file, int line);
/* Of memory for small objects: without it there is no state to go back to, so the program ends
 * with a line. */
#define NEEDS_MEMORY(there) ((there) ? (void)0 : machine_memory_failed())
_Noreturn void machine_memory_failed(void);
enum machine_status machine_fail(struct machine *m, enum machine_status status,
                                 const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
