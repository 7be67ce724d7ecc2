/* builder.h - blocks as they are made: text, how its letters look, and formulas put back where
 * letters stood for them. Knows nothing of cmark-gfm. */
#ifndef LUTETIA_READER_BUILDER_H
#define LUTETIA_READER_BUILDER_H

#include "reader_internal.h"

struct reader_builder {
    struct reader_document *document;
    const char *source;
    const struct reader_mask *mask;
    enum reader_status status;
    bool in_note; /* blocks are those of the last note */
    int note_bytes;
    int items, quotes;
    enum reader_align align;
    size_t targets_bytes; /* of links */
    char *marker;         /* of the item that has no block yet */
    int marker_items;     /* and how many lists that is in */
    /* The block that is being made. */
    struct reader_block block;
    int text_capacity, spans_capacity;
    bool open;
    int formula; /* the mask's next */
    int rest;    /* letters of a formula that are to be left out still */
    char letter; /* and which */
};

/* What one could not have memory for ends the making: builder->status. */
void reader_builder_fail(struct reader_builder *b);
/* A block begins, of these lines; one that is open ends first. */
void reader_block_open(struct reader_builder *b, enum reader_kind kind, int first_line,
                       int last_line);
/* It is the document's, or the note's. Nothing where none is open. */
void reader_block_close(struct reader_builder *b);
/* Appends letters to it. target: of a link; copied. */
void reader_text_add(struct reader_builder *b, const char *utf8, unsigned look,
                     const char *target);
/* A picture among letters, its caption as it is: all of one span. */
void reader_image_add(struct reader_builder *b, const char *caption, unsigned look,
                      const char *target, struct reader_asked asked);
/* The same as letters, formulas being what is written there: code. */
void reader_code_add(struct reader_builder *b, const char *utf8, unsigned look);
/* Blanks at the end of what there is say nothing. */
void reader_blanks_drop(struct reader_builder *b);
/* A cell of a row ends, and another begins. */
void reader_cell_end(struct reader_builder *b);
/* A note's number, from 1. */
void reader_number_add(struct reader_builder *b, int number);
/* What stands before the next block. A marker that has none yet has an empty one. */
void reader_marker_set(struct reader_builder *b, const char *marker, int line);
/* A label of the next block that is the document's: of the one that is open, if it says
 * something. Errors: NO_MEMORY, in b->status. */
void reader_label_set(struct reader_builder *b, const char *name, size_t bytes);
/* Labels that nothing follows are the last block's. */
void reader_labels_end(struct reader_builder *b);
void reader_block_finish(struct reader_block *block);

#endif
