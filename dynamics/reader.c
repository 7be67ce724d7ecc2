/* reader.c - see reader.h. */
#include "reader.h"

#include <input_file.h>
#include <number_text.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_MAX_BYTES = 2000000000 };

enum dyn_status dyn_reader_wrong(const struct dyn_reader *r, enum dyn_status status)
{
    status = status == DYN_BAD_ARGUMENT ? DYN_BAD_FILE : status;
    return dyn_fail(status, "%.200s:%ld: %s", r->name, r->line, dyn_error());
}

char *dyn_reader_word(struct dyn_reader *r)
{
    char *word = r->next + strspn(r->next, " \t");
    if (!*word)
        return NULL;
    r->next = word + strcspn(word, " \t");
    if (*r->next)
        *r->next++ = '\0';
    return word;
}

enum dyn_status dyn_reader_number(const struct dyn_reader *r, const char *what,
                                  const char *word, double *value)
{
    char *end = NULL;
    if (!word)
        return dyn_reader_fail(r, "there is no %s", what);
    *value = strtod(word, &end);
    if (end == word || *end)
        return dyn_reader_fail(r, "%s: '%.40s' is no number", what, word);
    return DYN_OK;
}

enum dyn_status dyn_reader_mass(const struct dyn_reader *r, const char *what, const char *word,
                                int *value)
{
    char *end = NULL;
    errno = 0;
    long number = word ? strtol(word, &end, 10) : 0;
    if (!word)
        return dyn_reader_fail(r, "there is no %s", what);
    if (end == word || *end || errno || number < 0 || number >= DYN_MASSES_MAX)
        return dyn_reader_fail(r, "%s: '%.40s' is no mass's number", what, word);
    *value = (int)number;
    return DYN_OK;
}

/* ---- lines ---- */

static enum dyn_status word_unknown(const struct dyn_reader *r, const char *word,
                                    const struct dyn_reader_line *lines, int count)
{
    char all[200] = "";
    for (int i = 0; i < count; i++)
        error_text_list(all, sizeof all, " ", lines[i].word);
    return dyn_reader_fail(r, "a line begins with one of: %s end (got '%.40s')", all, word);
}

static enum dyn_status line_read(struct dyn_reader *r, const struct dyn_reader_line *lines,
                                 int count, void *context)
{
    r->next = r->text;
    const char *first = dyn_reader_word(r), *more;
    enum dyn_status status = DYN_OK;
    if (!first || *first == '#')
        return DYN_OK;
    if (r->ended)
        return dyn_reader_fail(r, "after 'end' there can be nothing more");
    int i = 0;
    while (i < count && strcmp(first, lines[i].word) != 0)
        i++;
    if (i < count)
        status = lines[i].read(r, context);
    else if (strcmp(first, "end") == 0)
        r->ended = true;
    else
        return word_unknown(r, first, lines, count);
    more = status == DYN_OK ? dyn_reader_word(r) : NULL;
    return more ? dyn_reader_fail(r, "'%.40s' is one word too many", more) : status;
}

/* Copies a line, without its end, into r->text. Returns where the next line begins; NULL: it
 * is not text. */
static const char *line_take(struct dyn_reader *r, const char *text, const char *end)
{
    const char *newline = memchr(text, '\n', (size_t)(end - text));
    size_t length = (size_t)((newline ? newline : end) - text);
    r->line++;
    if (length > DYN_READER_LINE_BYTES) {
        dyn_reader_fail(r, "a line has at most %d bytes", DYN_READER_LINE_BYTES);
        return NULL;
    }
    memcpy(r->text, text, length);
    length -= length > 0 && r->text[length - 1] == '\r';
    r->text[length] = '\0';
    for (size_t i = 0; i < length; i++) {
        unsigned char byte = (unsigned char)r->text[i];
        if ((byte < ' ' && byte != '\t') || byte == 127) {
            dyn_reader_fail(r, "a byte of value %d is no text", byte);
            return NULL;
        }
    }
    return newline ? newline + 1 : end;
}

static enum dyn_status lines_read(struct dyn_reader *r, const char *text, const char *end,
                                  const char *heading, const struct dyn_reader_line *lines,
                                  int count, void *context)
{
    const char *next = line_take(r, text, end);
    if (next && strcmp(r->text, heading) != 0)
        return dyn_reader_fail(r, "its first line must be '%s'", heading);
    enum dyn_status status = next ? DYN_OK : DYN_BAD_FILE;
    while (status == DYN_OK && next < end) {
        next = line_take(r, next, end);
        status = next ? line_read(r, lines, count, context) : DYN_BAD_FILE;
    }
    if (status == DYN_OK && !r->ended)
        return dyn_reader_fail(r, "the file is cut short: there is no 'end'");
    return status;
}

enum dyn_status dyn_reader_run(struct dyn_reader *r, const char *text, size_t bytes,
                               const char *heading, const struct dyn_reader_line *lines,
                               int lines_count, void *context)
{
    struct number_text_locale locale;
    if (!number_text_begin(&locale))
        return dyn_fail(DYN_NO_MEMORY, "no memory for a locale");
    enum dyn_status status =
        lines_read(r, text, text + bytes, heading, lines, lines_count, context);
    number_text_end(&locale);
    return status;
}

/* ---- files ---- */

enum dyn_status dyn_file_bytes(const char *path, char **text, size_t *bytes)
{
    const char *why;
    *text = input_file_read(path, FILE_MAX_BYTES, bytes, &why);
    if (*text)
        return DYN_OK;
    if (errno == EFBIG)
        return dyn_fail(DYN_TOO_LARGE, "%.200s: a file has at most %d bytes", path,
                        FILE_MAX_BYTES);
    return dyn_fail(errno == ENOMEM ? DYN_NO_MEMORY : DYN_BAD_FILE,
                    "%.200s: cannot be read: %s", path, why);
}
