/* edit_lines.h - lines of a source, for edit_alone.c and edit_defined.c. */
#ifndef LUTETIA_READER_EDIT_LINES_H
#define LUTETIA_READER_EDIT_LINES_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

static inline bool is_blank_line(const char *s, size_t at, size_t bytes)
{
    while (at < bytes && (s[at] == ' ' || s[at] == '\t'))
        at++;
    return at == bytes || s[at] == '\n';
}

static inline size_t line_begin(const char *s, size_t at)
{
    while (at > 0 && s[at - 1] != '\n')
        at--;
    return at;
}

static inline size_t line_end(const char *s, size_t at, size_t bytes)
{
    const char *end = memchr(s + at, '\n', bytes - at);
    return end ? (size_t)(end - s) : bytes;
}

/* Behind a note's name where a line defines one, "[^name]:"; 0: it does not. */
static inline size_t definition_end(const char *s, size_t at, size_t bytes)
{
    const size_t end = line_end(s, at, bytes);
    if (end - at < 5 || s[at] != '[' || s[at + 1] != '^')
        return 0;
    const char *close = memchr(s + at, ']', end - at);
    return close && close > s + at + 2 && close + 1 < s + end && close[1] == ':'
               ? (size_t)(close + 2 - s)
               : 0;
}

#endif
