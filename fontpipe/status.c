/* status.c - see status.h. */
#include "internal.h"

#include <patience.h>

#include <stdlib.h>
#include <string.h>

_Thread_local struct error_text font_last_error;

const char *font_error(void)
{
    return font_last_error.text;
}

enum { LEFT_OUT_KNOWN = 64 };

/* The first glyph that was left out, how many were, and which the first of them are. */
static _Thread_local struct error_text left_out, left_out_said;
static _Thread_local int left_out_count;
static _Thread_local uint32_t left_out_known[LEFT_OUT_KNOWN];

void font_left_out_add(const char *path, const char *glyph)
{
    uint32_t hash = font_hash(path, strlen(path)) * 31 + font_hash(glyph, strlen(glyph));
    for (int i = 0; i < left_out_count && i < LEFT_OUT_KNOWN; i++)
        if (left_out_known[i] == hash)
            return;
    if (left_out_count < LEFT_OUT_KNOWN)
        left_out_known[left_out_count] = hash;
    if (!left_out_count++)
        error_text_fail(&left_out, 0, "glyph %s of %.200s is left out (%.200s)", glyph, path,
                        font_error());
}

const char *font_left_out(void)
{
    int more = left_out_count - 1;
    left_out_count = 0;
    if (more < 0)
        return NULL;
    if (more > 0)
        error_text_fail(&left_out_said, 0, "%s; so are %d more", left_out.text, more);
    else
        error_text_fail(&left_out_said, 0, "%s", left_out.text);
    return left_out_said.text;
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
