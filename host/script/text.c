/* text.c - see script_text.h. */
#include "script_text.h"

#include <number_text.h>

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SAID_ROOM = 16384 };

void script_text_say(struct event_bytes *text, const char *format, ...)
{
    char said[SAID_ROOM];
    va_list list;
    va_start(list, format);
    const int length = vsnprintf(said, sizeof said, format, list);
    va_end(list);
    if (length < 0 || length >= SAID_ROOM)
        text->short_of_memory = true;
    else
        event_put_bytes(text, said, (size_t)length);
}

void script_text_number(struct event_bytes *text, double number)
{
    char said[NUMBER_TEXT_BYTES];
    number_text(number, said);
    event_put_bytes(text, said, strlen(said));
}

void script_text_quoted(struct event_bytes *text, const char *string)
{
    script_text_say(text, "\"");
    for (const char *c = string; *c; c++)
        if (*c == '"' || *c == '\\' || (unsigned char)*c < ' ' || *c == 127)
            script_text_say(text, "\\%03u", (unsigned)(unsigned char)*c);
        else
            event_put_bytes(text, c, 1);
    script_text_say(text, "\"");
}

/* ---- fields ---- */

/* The script's number whose quotient by per_unit is the value. */
static bool in_units(double value, double per_unit, double *out)
{
    double below = value * per_unit, above = below;
    for (int i = 0; i < 4;
         i++, below = nextafter(below, -INFINITY), above = nextafter(above, INFINITY)) {
        const double backs[2] = {below / per_unit, above / per_unit};
        for (int k = 0; k < 2; k++)
            if (memcmp(&backs[k], &value, sizeof value) == 0) {
                *out = k ? above : below;
                return true;
            }
    }
    return false;
}

static bool number_say(struct event_bytes *text, const struct member *m, int at, const void *of)
{
    const void *start = (const char *)of + m->offset;
    double value;
    if (m->kind == MEMBER_INT) {
        script_text_say(text, "%d", ((const int *)start)[at]);
        return true;
    }
    value = ((const double *)start)[at];
    if (m->per_unit != 0 && !in_units(value, m->per_unit, &value))
        return false;
    script_text_number(text, value);
    return true;
}

/* One row, or the `count` rows that are one field. */
static bool field_say(struct event_bytes *text, const struct member *m, int rows,
                      const void *of)
{
    bool good = true;
    const bool first = text->count > 0 && text->at[text->count - 1] == '{';
    script_text_say(text, "%s%s = ", first ? "" : ", ", m->field);
    if (m->kind == MEMBER_FLAG) {
        script_text_say(text, *(const bool *)((const char *)of + m->offset) ? "true" : "false");
        return true;
    }
    const bool list = m->element > 0 || m->count > 1;
    const int numbers = m->element > 0 ? rows : m->count;
    script_text_say(text, list ? "{" : "");
    for (int i = 0; i < numbers; i++) {
        script_text_say(text, i > 0 ? ", " : "");
        good &= number_say(text, m->element > 0 ? m + i : m, m->element > 0 ? 0 : i, of);
    }
    script_text_say(text, list ? "}" : "");
    return good;
}

bool script_text_fields(struct event_bytes *text, const struct members *members, const void *of)
{
    const struct member *end = members->first + members->count;
    bool good = true;
    for (const struct member *m = members->first; m < end;) {
        int rows = 1;
        while (m->element > 0 && m + rows < end && m[rows].element == rows + 1)
            rows++;
        if (m->field)
            good &= field_say(text, m, rows, of);
        m += rows;
    }
    return good;
}

/* ---- base64 ---- */

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void script_text_base64(struct event_bytes *text, const uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i += 3) {
        const size_t left = count - i;
        const uint32_t word = (uint32_t)bytes[i] << 16 |
                              (left > 1 ? (uint32_t)bytes[i + 1] << 8 : 0) |
                              (left > 2 ? bytes[i + 2] : 0);
        const char four[4] = {digits[word >> 18], digits[word >> 12 & 63],
                              left > 1 ? digits[word >> 6 & 63] : '=',
                              left > 2 ? digits[word & 63] : '='};
        event_put_bytes(text, four, sizeof four);
    }
}

bool script_text_bytes(const char *text, size_t length, uint8_t **bytes, size_t *count)
{
    struct event_bytes out = {0};
    bool good = length % 4 == 0;
    for (size_t i = 0; i < length && good; i += 4) {
        uint32_t word = 0;
        size_t some = 0;
        for (; some < 4 && text[i + some] != '='; some++) {
            const char *digit = text[i + some] ? strchr(digits, text[i + some]) : NULL;
            good &= digit != NULL;
            word |= digit ? (uint32_t)(digit - digits) << (18 - 6 * some) : 0;
        }
        const bool last = i + 4 == length;
        good &= some == 4 || (last && some >= 2 && text[i + 3] == '=');
        for (size_t j = 0; j + 1 < some && good; j++)
            event_put_number(&out, word >> (16 - 8 * j) & 255, 1);
    }
    *bytes = out.at;
    *count = out.count;
    if (good && !out.short_of_memory && out.count > 0)
        return true;
    free(out.at);
    *bytes = NULL;
    *count = 0;
    return false;
}
