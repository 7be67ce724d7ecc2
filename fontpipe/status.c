/* status.c - see status.h. */
#include "internal.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

static _Thread_local char error_text[512];

enum font_status font_fail(enum font_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error_text, sizeof error_text, format, arguments);
    va_end(arguments);
    return status;
}

const char *font_error(void)
{
    return error_text;
}

bool font_array_reserve(void **array, int *capacity, int count, size_t element_bytes)
{
    if (count <= *capacity)
        return true;
    int64_t wanted = *capacity ? 2 * (int64_t)*capacity : 16;
    while (wanted < count)
        wanted *= 2;
    if (wanted > INT32_MAX)
        wanted = INT32_MAX;
    void *grown = realloc(*array, (size_t)wanted * element_bytes);
    if (!grown)
        return false;
    *array = grown;
    *capacity = (int)wanted;
    return true;
}

uint32_t font_hash(const void *key, size_t bytes_count)
{
    const unsigned char *bytes = key;
    uint32_t hash = 2166136261u;
    for (size_t i = 0; i < bytes_count; i++)
        hash = (hash ^ bytes[i]) * 16777619u;
    return hash ^ hash >> 15;
}
