/* reader.h - reads our text files line by line: networks and clamps.
 *
 * A line consists of words between blanks; a line that begins with `#` is a comment. The
 * first line is a heading, the last word is `end`. The first word of every other line is
 * looked up in a table, and the function found there reads the rest.
 */
#ifndef LUTETIA_DYN_READER_H
#define LUTETIA_DYN_READER_H

#include "internal.h"

enum { DYN_READER_LINE_BYTES = 1000 };

struct dyn_reader {
    const char *name; /* the file's name, for errors */
    long line;
    char text[DYN_READER_LINE_BYTES + 1]; /* the line's words, separated by zeros */
    char *next;                           /* the next unread word */
    bool ended;
};

struct dyn_reader_line {
    const char *word;
    enum dyn_status (*read)(struct dyn_reader *r, void *context);
};

/* Prefixes the last error message with the file's name and the line's number; BAD_ARGUMENT
 * becomes BAD_FILE. */
enum dyn_status dyn_reader_wrong(const struct dyn_reader *r, enum dyn_status status);
#define dyn_reader_fail(r, ...)                                                                \
    (dyn_fail(DYN_BAD_ARGUMENT, __VA_ARGS__), dyn_reader_wrong((r), DYN_BAD_ARGUMENT))

/* The next word of the line; NULL: none. */
char *dyn_reader_word(struct dyn_reader *r);
/* word may be NULL. Errors: BAD_FILE; the message names what was expected. */
enum dyn_status dyn_reader_number(const struct dyn_reader *r, const char *what,
                                  const char *word, double *value);
enum dyn_status dyn_reader_mass(const struct dyn_reader *r, const char *what, const char *word,
                                int *value);

/* Reads all lines of a text. Numbers have a decimal point, whatever the program's locale. */
enum dyn_status dyn_reader_run(struct dyn_reader *r, const char *text, size_t bytes,
                               const char *heading, const struct dyn_reader_line *lines,
                               int lines_count, void *context);

/* Reads the bytes of a file, and appends a 0. Owns: the caller frees *text. Errors:
 * BAD_FILE, TOO_LARGE, NO_MEMORY. */
enum dyn_status dyn_file_bytes(const char *path, char **text, size_t *bytes);

#endif
