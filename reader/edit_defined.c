/* edit_defined.c - what brackets mean, and where what tags begin ends, as far as it is certain
 * without reading all of a source: see edit_internal.h.
 *
 * A definition is certain that is a line by itself,
 *     [name]: address "title"
 * moved in by nothing, between blank lines and others like it, and in no block. Else brackets
 * before a colon are none where one opens within their line. */
#include "edit_internal.h"
#include "edit_lines.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { DEFINED_BYTES = 32 << 10, DEFINED_LINES = 2000 };

bool edit_goes_on(const char *text, size_t bytes)
{
    static const char *const tags[] = {"!", "?", "script", "pre", "style", "textarea"};
    const char *const end = text + bytes;
    for (const char *at = text; (at = memchr(at, '<', (size_t)(end - at)));) {
        at++;
        for (size_t i = 0; i < sizeof tags / sizeof *tags; i++) {
            const size_t length = strlen(tags[i]);
            if ((size_t)(end - at) >= length && strncasecmp(at, tags[i], length) == 0)
                return true;
        }
    }
    return false;
}

static size_t blanks_behind(const char *s, size_t at, size_t end)
{
    while (at < end && (s[at] == ' ' || s[at] == '\t'))
        at++;
    return at;
}

/* Behind what is in quotes, or what has no blanks; `at`: something else. */
static size_t word_behind(const char *s, size_t at, size_t end)
{
    const size_t begin = at;
    if (at < end && (s[at] == '"' || s[at] == '\'')) {
        const char *close = memchr(s + at + 1, s[at], end - at - 1);
        return close && !memchr(s + at, '\\', (size_t)(close - s) - at)
                   ? (size_t)(close + 1 - s)
                   : begin;
    }
    while (at < end && (unsigned char)s[at] > ' ' && !strchr("\\<>()\"'", s[at]))
        at++;
    return at;
}

/* A line at..end that can be nothing but a definition. */
static bool defines(const char *s, size_t at, size_t end)
{
    if (at >= end || s[at] != '[' || at + 1 == end || s[at + 1] == '^')
        return false;
    size_t k = at + 1;
    bool any = false;
    for (; k < end && !strchr("[]\\", s[k]); k++)
        any = any || (s[k] != ' ' && s[k] != '\t');
    if (!any || k + 1 >= end || s[k] != ']' || s[k + 1] != ':')
        return false;
    k = blanks_behind(s, k + 2, end);
    if (k == end || s[k] == '"' || s[k] == '\'')
        return false;
    size_t next = word_behind(s, k, end);
    if (next == k)
        return false;
    k = next;
    next = blanks_behind(s, k, end);
    if (next == end)
        return true;
    if (next == k || (s[next] != '"' && s[next] != '\''))
        return false;
    k = word_behind(s, next, end);
    return k > next && blanks_behind(s, k, end) == end;
}

/* Whether the line there is blank, or another definition. */
static bool is_between(const char *s, size_t at, size_t bytes)
{
    return at >= bytes || is_blank_line(s, at, bytes) || defines(s, at, line_end(s, at, bytes));
}

/* A bracket before a colon, in the line begin..end: whether it is a definition's: 1, 0; -1: it
 * is not certain. */
static int is_definition(const char *s, size_t bytes, size_t begin, size_t end, size_t bracket)
{
    if (definition_end(s, begin, bytes) == bracket + 2)
        return 0;
    size_t open = bracket, first = blanks_behind(s, begin, end);
    while (open > begin && s[open - 1] != '[')
        open--;
    if (open == begin)
        return -1; /* it opens in another line */
    while (first < end && strchr("> \t-+*.)0123456789", s[first]))
        first++;
    if (first < open - 1)
        return 0;
    return defines(s, begin, end) && is_between(s, end + 1, bytes) &&
                   (begin == 0 || is_between(s, line_begin(s, begin - 1), bytes))
               ? 1
               : -1;
}

/* Whether one of the lines is in one of the blocks. */
static bool in_block(const struct reader_block *blocks, int count, int source, const int *lines,
                     int lines_count)
{
    for (int i = 0; i < count; i++) {
        int low = 0, high = lines_count;
        if (blocks[i].source != source)
            continue;
        while (low < high) { /* the first one at or behind its first line */
            const int half = low + (high - low) / 2;
            if (lines[half] < blocks[i].first_line)
                low = half + 1;
            else
                high = half;
        }
        if (low < lines_count && lines[low] <= blocks[i].last_line)
            return true;
    }
    return false;
}

bool edit_defined(const struct reader_document *d, int number,
                  const struct reader_bytes *source, size_t begin, size_t end, FILE *to)
{
    const char *s = source->text;
    const size_t bytes = source->bytes;
    size_t counted = 0, written = 0, last = bytes;
    int line = 1, count = 0, *lines = malloc(DEFINED_LINES * sizeof *lines);
    bool good = lines != NULL;
    for (size_t at = 0; good && at < bytes;) {
        const char *found = memmem(s + at, bytes - at, "]:", 2);
        if (!found)
            break;
        const size_t bracket = (size_t)(found - s), own = line_begin(s, bracket),
                     stop = line_end(s, bracket, bytes);
        const int is = is_definition(s, bytes, own, stop, bracket);
        at = bracket + 2;
        if (is == 0 || own == last)
            continue;
        for (; counted < own; counted++)
            line += s[counted] == '\n';
        written += stop - own + 1;
        good = is > 0 && (own >= end || own < begin) && count < DEFINED_LINES &&
               written <= DEFINED_BYTES;
        if (good) {
            fprintf(to, "%s%.*s\n", count ? "" : "\n\n", (int)(stop - own), s + own);
            lines[count++] = line;
        }
        last = own;
    }
    good = good &&
           (!count || (strncmp(s, "---", 3) != 0 && !edit_goes_on(s, bytes) &&
                       !in_block(d->blocks, d->blocks_count, number, lines, count) &&
                       !in_block(d->note_blocks, d->note_blocks_count, number, lines, count)));
    free(lines);
    return good;
}
