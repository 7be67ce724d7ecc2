/* error_text.c - see error_text.h. */
#include "error_text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

__attribute__((format(printf, 2, 0))) static void keep(struct error_text *e, const char *format,
                                                       va_list arguments)
{
    char text[ERROR_TEXT_BYTES] = "";
    vsnprintf(text, sizeof text, format, arguments);
    memcpy(e->text, text, sizeof text);
}

int error_text_fail(struct error_text *e, int status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    keep(e, format, arguments);
    va_end(arguments);
    return status;
}

bool error_text_false(struct error_text *e, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    keep(e, format, arguments);
    va_end(arguments);
    return false;
}

void error_text_list(char *text, size_t room, const char *between, const char *word)
{
    const size_t length = strlen(text);
    if (length + (length ? strlen(between) : 0) + strlen(word) < room)
        snprintf(text + length, room - length, "%s%s", length ? between : "", word);
}
