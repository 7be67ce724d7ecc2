/* error.c - the last failure, in words. */
#include "base/base.h"

#include <stdarg.h>
#include <stdio.h>

static char error_text[1024];

const char *paper_error(void)
{
    return error_text;
}

enum paper_status paper_fail(enum paper_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error_text, sizeof error_text, format, arguments);
    va_end(arguments);
    return status;
}
