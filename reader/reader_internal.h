/* reader_internal.h - what the files of reader/ share. */
#ifndef LUTETIA_READER_INTERNAL_H
#define LUTETIA_READER_INTERNAL_H

#include "reader_files.h"

#include <array.h>
#include <error_text.h>

extern _Thread_local struct error_text reader_last_error;
#define reader_fail(status, ...)                                                               \
    ((enum reader_status)error_text_fail(&reader_last_error, (int)(status), __VA_ARGS__))

/* ---- guard.c ---- */

/* Whether cmark-gfm is to read it. Errors: TOO_LARGE, with the line. */
enum reader_status reader_guard_check(const char *source, int bytes);

/* ---- tag.c ---- */

/* The name in <a id="NAME">, a tag that says nothing else, and its length; NULL: it is none. */
const char *reader_tag_label(const char *tag, size_t *bytes);
/* Behind a <br> that the text begins with, which ends a line; the text: there is none. */
const char *reader_tag_break(const char *text);

/* ---- bibliography.c ---- */

/* Sorts the entries of each file's bibliography, the list that has that label or stands under a
 * heading that has it, and numbers them. entry_of: of each block, the first one of the entry
 * that it is of; else -1. Before labels are made. Errors: NO_MEMORY. */
enum reader_status reader_bibliography_sort(struct reader_document *d, int *entry_of);

/* ---- cited.c ---- */

/* Where an entry is cited: the blocks that both begin with, or are. */
struct reader_citation {
    int entry, where;
};
/* In the order of entries and places, each once. Errors: NO_MEMORY. Owns: the caller frees
 * *list. */
enum reader_status reader_citations_find(struct reader_document *d,
                                         const struct reader_files *files, const int *entry_of,
                                         struct reader_citation **list, int *count);

/* ---- labels.c ---- */

/* The place that a link of a source leads to, in that or another one of the document's; NULL:
 * it leads to none. files: NULL: paths lead nowhere. */
const struct reader_block *reader_place_find(const struct reader_document *d,
                                             const struct reader_files *files,
                                             const char *target, int source);

/* What a place is called that an entry leads back to; no label of a document's is so. */
enum { READER_CITED_BYTES = 24 };
void reader_cited_name(int block, char to[READER_CITED_BYTES]);
/* Those blocks have such names, too. Errors: NO_MEMORY. */
enum reader_status reader_labels_cited(struct reader_document *d,
                                       const struct reader_citation *list, int count);

/* Headings have their names, and labels are sorted by their names. Errors: NO_MEMORY. */
enum reader_status reader_labels_make(struct reader_document *d);
/* The same once a heading has another name. */
enum reader_status reader_labels_again(struct reader_document *d);

/* ---- mask.c: formulas out of cmark's way ---- */

/* Whether a document's block is what was cut off the one before it, for its length. */
static inline bool reader_block_is_cut_off(const struct reader_block *block)
{
    return block->continues && block[-1].kind != READER_MATH;
}

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
/* Whether behind these bytes, the begin of a source, a fence is open in which no formulas are
 * looked for; true: or nobody knows. */
bool reader_mask_is_fenced(const char *source, int bytes);

#endif
