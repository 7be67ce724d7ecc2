/* midi_status.c - see midi_status.h. */
#include "midi_internal.h"

_Thread_local struct error_text midi_last_error;

const char *midi_error(void)
{
    return midi_last_error.text;
}
