/* status.c - see status.h. */
#include "internal.h"

_Thread_local struct error_text dyn_last_error;

const char *dyn_error(void)
{
    return dyn_last_error.text;
}
