/* anchor_internal.h - what an anchor is made of, for making and finding it (anchor.c) and
 * keeping it (anchor_kept.c). */
#ifndef LUTETIA_READER_ANCHOR_INTERNAL_H
#define LUTETIA_READER_ANCHOR_INTERNAL_H

#include "reader_anchor.h"

/* The quotation with one side or with both, as one row of bytes within the anchor's: how far it
 * reaches to the left and to the right. */
struct witness {
    size_t left, right;
    bool apart; /* it was there once when it was made */
};

struct reader_anchor {
    size_t begin, end, bytes; /* of the source: its length */
    uint64_t digest;          /* and its bytes */
    bool gone;
    char *text; /* the left side, the quotation, the right side */
    size_t left, quotation, right;
    struct witness before, behind, both;
    char *headings;
};

/* As reader_anchor_edit() has it, of bytes begin..end alone. False: all of them are gone. */
bool anchor_range_edit(size_t *begin, size_t *end, size_t at, size_t removed, size_t inserted);

#endif
