/* status.c - see status.h. */
#include "internal.h"

#include <patience.h>

#include <stdlib.h>

_Thread_local struct error_text font_last_error;

const char *font_error(void)
{
    return font_last_error.text;
}

enum font_status font_patience_ask(int i)
{
    enum { EACH = 16 };
    return i % EACH == 0 && patience_over() ? font_fail(FONT_NO_MEMORY, "stopped") : FONT_OK;
}

uint32_t font_hash(const void *key, size_t bytes_count)
{
    const unsigned char *bytes = key;
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < bytes_count; i++)
        hash = (hash ^ bytes[i]) * 16777619u;
    return hash ^ hash >> 15;
}
