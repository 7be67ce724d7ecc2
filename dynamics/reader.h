/* reader.h - text files of ours, line by line: what networks and clamps are read by.
 *
 * A line is words between blanks; `#` begins one that says nothing. The first line is a heading, the last word is `end`. The first
 * word of every other line is looked up in a table, and the function found there reads the rest. */
#ifndef LUTETIA_DYN_READER_H
#define LUTETIA_DYN_READER_H

#include "internal.h"

enum { DYN_READER_LINE_BYTES = 1000 };

struct dyn_reader {
    const char *name; /* of the file, for errors */
    long line;
    char text[DYN_READER_LINE_BYTES + 1]; /* the line's words; blanks become ends of strings */
    char *next;                           /* of the words that are not read yet */
    bool ended;
};

struct dyn_reader_line {
    const char *word;
    enum dyn_status (*read)(struct dyn_reader *r, void *context);
};

/* Puts the file's name and the line's number before the failure that just was; what was a bad argument is now a bad file. */
enum dyn_status dyn_reader_wrong(const struct dyn_reader *r, enum dyn_status status);
#define dyn_reader_fail(r, ...)                                                                \
    (dyn_fail(DYN_BAD_ARGUMENT, __VA_ARGS__), dyn_reader_wrong((r), DYN_BAD_ARGUMENT))

/* The next word of the line; NULL: there is no more. */
char *dyn_reader_word(struct dyn_reader *r);
/* Of a word that may be NULL. Errors: BAD_FILE, with what it should be. */
enum dyn_status dyn_reader_number(const struct dyn_reader *r, const char *what,
                                  const char *word, double *value);
enum dyn_status dyn_reader_mass(const struct dyn_reader *r, const char *what, const char *word,
                                int *value);

/* All lines of a text. Numbers have a point, whatever the program's locale. */
enum dyn_status dyn_reader_run(struct dyn_reader *r, const char *text, size_t bytes,
                               const char *heading, const struct dyn_reader_line *lines,
                               int lines_count, void *context);

/* The bytes of a file, ended by a 0. Owns: the caller frees *text. Errors: BAD_FILE, TOO_LARGE, NO_MEMORY. */
enum dyn_status dyn_file_bytes(const char *path, char **text, size_t *bytes);

#endif
