/* reader_anchor.h - places in a text that are found again when others have changed the text:
 * what a note, a sketch or a link hangs on.
 *
 *     struct reader_anchor *anchor;
 *     // bytes 120 to 145 of a document
 *     reader_anchor_make(source, bytes, 120, 145, &anchor);
 *     ...                                                         // another program changes
 *                                                                 the document
 *     size_t begin, end;
 *     if (reader_anchor_find(anchor, changed, changed_bytes, &begin, &end) == READER_ANCHOR_ORPHAN)
 *         list(reader_anchor_quotation(anchor), reader_anchor_headings(anchor));
 *
 * An anchor keeps its bytes' place, the bytes themselves (the quotation), and what stands
 * before and behind them: at least 32 bytes, and as many more, up to 4,096, as it takes until
 * that side with the quotation is there once. In the same source, byte for byte, it is at its
 * place. In another one it is
 *   - where the quotation stands with both sides, if it does so once, and at least one side
 *     told it apart when it was made;
 *   - else where a quotation of 20 bytes or more stands with one side that told it apart, if it
 *     does so once, and stands nowhere else beside the nearest 32 bytes of a side;
 *   - else an orphan, which has its quotation and its headings still. Nothing is guessed: what
 *     only looks alike is never taken.
 * Where the same stands beside the same neighbours again (it was cut and put elsewhere, or
 * written anew), it is the text.
 *
 * Who changes the text himself tells each change (reader_anchor_edit()), and the anchor moves
 * with its letters, whatever stands beside them.
 *
 * Errors: functions that can fail return a status and leave one line in reader_error().
 * Ownership: what is passed is copied. Threads: anchors are independent of each other. */
#ifndef LUTETIA_READER_ANCHOR_H
#define LUTETIA_READER_ANCHOR_H

#include "reader_document.h"

#include <stdint.h>

struct reader_anchor;

enum {
    READER_ANCHOR_SIDE_LEAST = 32,
    READER_ANCHOR_SIDE_MOST = 4096,
    READER_ANCHOR_LONG = 20, /* bytes of a quotation that one side is enough for */
    READER_ANCHOR_QUOTATION_MOST = 1 << 16
};

/* Of bytes begin..end of the source, which may be none. Errors: BAD_ARGUMENT (not within the
 * source), TOO_LARGE (a quotation of more than READER_ANCHOR_QUOTATION_MOST bytes), NO_MEMORY.
 * Owns: the caller destroys *out. */
enum reader_status reader_anchor_make(const char *source, size_t bytes, size_t begin,
                                      size_t end, struct reader_anchor **out);
void reader_anchor_destroy(struct reader_anchor *anchor); /* NULL is fine */

enum reader_found { READER_ANCHOR_ORPHAN, READER_ANCHOR_SAME, READER_ANCHOR_MOVED };
/* Where it is in a source; *begin and *end as they were for an orphan. */
enum reader_found reader_anchor_find(const struct reader_anchor *anchor, const char *source,
                                     size_t bytes, size_t *begin, size_t *end);

/* Bytes at..at+removed of the source that it was made of, or last moved in, become `inserted`
 * others: it goes with its letters. What is put in at its beginning or its end stands outside.
 * False: all of its letters are gone (for an anchor of none: those around it), and it is an
 * orphan in whatever source. Make another of its place when the source is saved: its quotation
 * and its sides are what they were. */
bool reader_anchor_edit(struct reader_anchor *anchor, size_t at, size_t removed,
                        size_t inserted);

/* As bytes, to be kept in a file, and from them; the bytes may be anybody's. Not of an anchor
 * that reader_anchor_edit() has moved. Errors: NO_MEMORY, BAD_ARGUMENT (bytes that are no
 * anchor). Owns: the caller frees *out, destroys the anchor. */
enum reader_status reader_anchor_keep(const struct reader_anchor *anchor, unsigned char **out,
                                      size_t *count);
enum reader_status reader_anchor_restore(const unsigned char *kept, size_t count,
                                         struct reader_anchor **out);

/* Its place as it was made or moved. */
void reader_anchor_place(const struct reader_anchor *anchor, size_t *begin, size_t *end);
/* Never NULL. Owns: the anchor. */
const char *reader_anchor_quotation(const struct reader_anchor *anchor, size_t *bytes);
/* The headings that it stood under, the highest first, with " / " between: "Springs / Forces";
 * "" for none. Owns: the anchor. */
const char *reader_anchor_headings(const struct reader_anchor *anchor);

#endif
