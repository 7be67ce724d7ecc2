/* midi_status.c - see midi_status.h. */
#include "midi_internal.h"

#include <stdarg.h>
#include <stdio.h>

static _Thread_local char error_text[512];

enum midi_status midi_fail(enum midi_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error_text, sizeof error_text, format, arguments);
    va_end(arguments);
    return status;
}

const char *midi_error(void)
{
    return error_text;
}
