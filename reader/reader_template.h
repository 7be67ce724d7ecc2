/* reader_template.h - layout is a template on a grid: columns, gutters, and in which of them
 * text, notes, figures and demonstrations go; colours and sizes, each named once.
 *
 *     struct reader_template book;
 *     if (reader_template_named("book", &book) != READER_OK)
 *         die(reader_error());
 *     reader_template_grid(&book, window_px, em_px, has_notes, &setup.grid);
 *
 *     | left  |gutter|  text column 1  |gutter|  text column 2  |gutter| right |
 *        1                    2                        3                   4      columns 1 2 3 4
 *     notes 1               text 2                   text 3             notes 4
 *
 * A template is a text of lines, each a word and its values; docs/reader.md has all of them.
 * What it does not say is as a template has it that says only columns and text. Lengths are ems
 * of the text's letters, so a template is one for every size.
 *
 * Errors: BAD_ARGUMENT, with one line in reader_error() that says the template's line, what is
 * wrong, and what there would be.
 *
 * Threads: no function keeps anything. */
#ifndef LUTETIA_READER_TEMPLATE_H
#define LUTETIA_READER_TEMPLATE_H

#include "reader_colours.h"
#include "reader_pages.h"

enum {
    READER_TEMPLATE_COLUMNS_MAX = READER_GRID_COLUMNS_MAX,
    READER_TEMPLATE_BYTES_MAX = 1 << 16,
    READER_TEMPLATE_NAME_BYTES = 64
};

/* Columns first..last of the grid, from 0. */
struct reader_place_span {
    int first, last;
};

struct reader_template_column {
    double least_em, most_em; /* 0: it has only a share */
    double share;             /* of what the window has left; 0: none */
};

struct reader_template {
    char name[READER_TEMPLATE_NAME_BYTES];
    struct reader_template_column columns[READER_TEMPLATE_COLUMNS_MAX];
    int columns_count;
    double gutter_em;
    struct reader_place_span text[READER_TEXTS_MAX]; /* in the order in which one reads */
    int texts_count;
    /* none: notes open in place; else one for each text column */
    struct reader_place_span notes[READER_TEXTS_MAX];
    int notes_count;
    struct reader_place_span wide[READER_WIDES]; /* headings, figures, ... */
    struct reader_beside beside;                 /* of figures that do not say it themselves */
    double sizes[READER_SIZES];                  /* of the text's; 0: as usual */
    struct reader_colours colours[2];            /* light, dark */
};

#define READER_SIZE_LEAST 0.4 /* of the text's */
#define READER_SIZE_MOST 4.0
extern const char *const reader_size_names[READER_SIZES];

/* The names of those that are built in, NULL behind the last. */
extern const char *const reader_template_names[];
/* One of them. Errors: BAD_ARGUMENT, with their names. */
enum reader_status reader_template_named(const char *name, struct reader_template *out);
/* From a text. where: what messages call it: a file's name. Errors: BAD_ARGUMENT; *out is then
 * not changed. */
enum reader_status reader_template_parse(const char *text, size_t bytes, const char *where,
                                         struct reader_template *out);
/* One that is built in, or else the file of that name. Errors: BAD_ARGUMENT, FAILED (the file
 * cannot be read), TOO_LARGE. */
enum reader_status reader_template_open(const char *name_or_path, struct reader_template *out);
/* The text of a template: what it says is read again as the same template. Owns: the caller
 * frees it; NULL: no memory. */
char *reader_template_text(const struct reader_template *template);

/* Where everything is in a window so wide. What is too wide for it gives way: first the columns
 * that only notes have, then all columns but the first of text. notes: there are any, so that
 * their columns are of use. Nothing of a template or a width makes a place that is outside of
 * the window, or that overlaps another one but a wide one. */
void reader_template_grid(const struct reader_template *template, double width_px, double em_px,
                          bool notes, struct reader_grid *out);

/* How wide the first column of text is at most, gutters within it included; and to make all of
 * them wider or narrower by the same. */
double reader_template_text_em(const struct reader_template *template);
void reader_template_text_set(struct reader_template *template, double em);
/* Columns that may be of several widths are at most as wide as they are in this grid: before
 * they are dragged, so that none takes what another one has given. */
void reader_template_settle(struct reader_template *template, const struct reader_grid *grid,
                            double em_px);
/* Makes a column wider by so much, or narrower; what it takes, the other one gives (-1: none
 * does). None becomes narrower than one em, and none that has a share is changed. */
void reader_template_drag(struct reader_template *template, int column, int other,
                          double by_em);

#endif
