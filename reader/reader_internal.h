/* reader_internal.h - what the files of reader/ share. */
#ifndef LUTETIA_READER_INTERNAL_H
#define LUTETIA_READER_INTERNAL_H

#include "reader_document.h"

#include <array.h>
#include <error_text.h>

extern _Thread_local struct error_text reader_last_error;
#define reader_fail(status, ...)                                                               \
    ((enum reader_status)error_text_fail(&reader_last_error, (int)(status), __VA_ARGS__))

/* ---- guard.c ---- */

/* Whether cmark-gfm is to read it. Errors: TOO_LARGE, with the line. */
enum reader_status reader_guard_check(const char *source, int bytes);

/* ---- labels.c ---- */

/* Headings have their names, and labels are sorted by their names. Errors: NO_MEMORY. */
enum reader_status reader_labels_make(struct reader_document *d);

/* ---- mask.c: formulas out of cmark's way ---- */

/* A formula in the source: with its dollars, and without. */
struct reader_formula {
    int begin, end, inner_begin, inner_end, line;
    bool display;
};

struct reader_mask {
    /* as long as the source, and with the same lines: each formula is U+0091 and letters */
    char *masked;
    struct reader_formula *formulas; /* in the order of the source */
    int formulas_count, formulas_capacity;
};

/* What stands for a formula's first two bytes. */
#define READER_MASK_SIGN "\xc2\x91"

/* The letter of a formula's others, by its number: so that one is known whose sign nobody
 * showed, as in a link's address. */
char reader_mask_letter(int formula);
/* Errors: TOO_LARGE, NO_MEMORY. Owns: the caller finishes *out. */
enum reader_status reader_mask_make(const char *source, int bytes, struct reader_mask *out);
void reader_mask_finish(struct reader_mask *mask);

#endif
