/* errors.c - errors: see errors.h. */
#include "base/errors.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/parts.h"

_Noreturn void machine_invariant_failed(const char *what, const char *file, int line)
{
    fprintf(stderr, "lutetia: broken invariant: %s (%s:%d)\n", what, file, line);
    abort();
}

/* Any thread may come here, so nothing is waited for; but what the program has printed is not
 * lost. */
_Noreturn void machine_memory_failed(void)
{
    fflush(NULL);
    fprintf(stderr, "lutetia: not enough memory for the machine's own tables: take fewer "
                    "processors, or leave the program more memory\n");
    _exit(EXIT_FAILURE);
}

enum machine_status machine_fail(struct machine *m, enum machine_status status,
                                 const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(m->error, sizeof m->error, format, arguments);
    va_end(arguments);
    m->status = status;
    return status;
}

enum machine_status machine_status_last(const struct machine *m)
{
    return m->status;
}

const char *machine_error(const struct machine *m)
{
    return m ? m->error : "not enough memory for a machine";
}

void machine_error_clear(struct machine *m)
{
    m->status = MACHINE_OK;
    m->error[0] = 0;
}
