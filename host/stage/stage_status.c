/* stage_status.c - see stage_status.h. */
#include "stage_status.h"

#include <error_text.h>

#include <stdarg.h>
#include <stdio.h>

static _Thread_local struct error_text stage_last_error;

const char *stage_error(void)
{
    return stage_last_error.text;
}

enum stage_status stage_fail(enum stage_status status, const char *format, ...)
{
    char text[ERROR_TEXT_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    error_text_fail(&stage_last_error, (int)status, "%s", text);
    return status;
}
