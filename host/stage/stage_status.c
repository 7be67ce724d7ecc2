/* stage_status.c - see stage_status.h. */
#include "stage_status.h"

#include <stdarg.h>
#include <stdio.h>

static _Thread_local char error_text[512];

const char *stage_error(void)
{
    return error_text;
}

enum stage_status stage_fail(enum stage_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error_text, sizeof error_text, format, arguments);
    va_end(arguments);
    return status;
}
