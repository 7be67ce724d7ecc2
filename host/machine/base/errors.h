/* errors.h - what went wrong: of the caller's, as a status and a line of text; of ours, the end. */
#ifndef LUTETIA_MACHINE_ERRORS_H
#define LUTETIA_MACHINE_ERRORS_H

#include "machine.h"

/* Stays in release builds: a broken invariant of ours, never of the caller. */
#define INVARIANT(condition)                                                                   \
    ((condition) ? (void)0 : machine_invariant_failed(#condition, __FILE__, __LINE__))
_Noreturn void machine_invariant_failed(const char *what, const char *file, int line);
enum machine_status machine_fail(struct machine *m, enum machine_status status,
                                 const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
