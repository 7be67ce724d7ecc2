/* edit_internal.h - what the files of editing share: where letters of a block stand in its
 * source (edit_map.c), lines read alone (edit_alone.c), one block set in place (edit_block.c),
 * whether what is read is what was meant (edit_meant.c), changes and undo (edit.c), typing
 * (edit_type.c). */
#ifndef LUTETIA_READER_EDIT_INTERNAL_H
#define LUTETIA_READER_EDIT_INTERNAL_H

#include "reader_edit.h"
#include "reader_internal.h"

#include <stdio.h>

/* For each byte of a block's text, the bytes of the source that are it. */
struct edit_map {
    int *begin, *end;
    int count;       /* of the text's bytes: those behind are not known */
    int first, last; /* the block's lines, without the last one's end */
    int head;        /* behind the signs of items and quotes, and a heading's */
};
/* False: no memory. Owns: the caller finishes *out. */
bool edit_map_make(const struct reader_block *block, const struct reader_bytes *source,
                   struct edit_map *out);
void edit_map_finish(struct edit_map *map);
/* Where lines first..last (from 1) of a source are, without the last one's end. */
void edit_lines_find(const struct reader_bytes *source, int first, int last, int *begin,
                     int *end);
/* Behind blanks and signs of quotes and items at a line's begin. next: what a line of the next
 * item begins with, more: one that goes on; either may be NULL, else has room for
 * EDIT_PREFIX_BYTES. */
enum { EDIT_PREFIX_BYTES = 256 };
int edit_prefix(const char *text, int at, int end, char *next, char *more);

/* A link whose words are its name, [words] or [words][], in lines first..last of a text: what
 * stands in place of bytes end..*behind where bytes begin..end of its words change and it leads
 * where it led, words][name]. NULL: there is none, or no memory. Owns: the caller frees it. */
char *edit_link_name(const char *text, int first, int last, int begin, int end, int *behind);

/* A change of one source. */
struct edit_splice {
    int source;
    size_t at, removed;
    const char *text;
    size_t bytes;
};
/* What is meant: bytes begin..end of the plain text become these. */
struct edit_meant {
    size_t begin, end;
    const char *text;
    size_t bytes;
    bool any;     /* whatever comes of it */
    size_t caret; /* then */
    bool typed;
};

/* Whether the new plain text is what is meant, but for how many blanks there are in a row, and
 * none at ends. */
bool edit_meant_text(const char *before, size_t before_bytes, const struct edit_meant *meant,
                     const char *now, size_t now_bytes);
bool edit_meant_document(const struct reader_document *before, const struct edit_meant *meant,
                         const struct reader_document *now);
/* What moves remarks from one document to the other. False: no memory. */
bool edit_moves_find(const struct reader_document *before, const struct reader_document *now,
                     struct reader_edit_change *change);
bool edit_move_add(struct reader_edit_change *change, size_t at, size_t removed,
                   size_t inserted);

/* Lines of a source that are read alone, as they were and as they become. */
struct edit_alone {
    size_t begin, end; /* of the source, with blank lines behind them */
    int line;          /* the first of them */
    int more;          /* by so many lines they become more */
    bool code;         /* a fence */
    bool notes;        /* a note's text: */
    int note;          /* of the document's; else -1 */
    int ahead;         /* lines that are read before them */
    struct reader_document *was, *now;
    /* edit_block.c: */
    int first;   /* block of the document's; those of `was` are it and the next ones */
    int changed; /* of their blocks */
    int lines;   /* by so many that one has more */
};
/* False: they cannot be read alone. The caller finishes *out. */
bool edit_alone_read(const struct reader_document *d, const struct reader_bytes *source,
                     const struct edit_splice *splice, struct edit_alone *out);
void edit_alone_finish(struct edit_alone *alone);
/* edit_defined.c: */
/* Whether a tag in a text may begin what goes on over blank lines. */
bool edit_goes_on(const char *text, size_t bytes);
/* Writes what a source defines links to be, but for its bytes begin..end. False: it is not
 * certain. */
bool edit_defined(const struct reader_document *d, int number,
                  const struct reader_bytes *source, size_t begin, size_t end, FILE *to);
/* The note of that name in a source of the document's; -1: there is none. */
int edit_note_of(const struct reader_document *d, int source, const struct reader_note *note);

/* The block that the splice is in, read with the lines around it alone, in place. *done: it
 * was; else others have to do with it. Errors: BAD_ARGUMENT: whatever is read, it is not what
 * is meant; NO_MEMORY. */
enum reader_status edit_block_try(struct reader_document *d, struct reader_files *files,
                                  const struct edit_splice *splice,
                                  const struct edit_meant *meant,
                                  struct reader_edit_change *change, bool *done);

/* One that can be undone. */
struct edit_done {
    int source;
    size_t at;
    char *removed, *inserted;
    size_t removed_bytes, inserted_bytes;
    size_t caret_before, caret_after;
    unsigned group;
    bool typed; /* letters alone: more may be added */
    struct reader_edit_move *moves;
    int moves_count;
    /* where remarks were that have lost letters by doing it, and by undoing it */
    struct reader_remark_place *touched[2];
    int touched_count[2];
};

struct reader_edit {
    struct reader_document **document;
    struct reader_files *files;
    struct reader_remarks *remarks;
    struct edit_done *done;
    int done_count, done_capacity, at; /* at: behind the last one that is not undone */
    unsigned group, groups;            /* group: 0: each by itself */
    int depth;                         /* groups that have begun */
    bool part;
    enum reader_edit_waits waits;
    size_t waits_at;
};

/* Tries the splice; *done: it is what is meant, and is done and kept for undo. */
enum reader_status edit_try(struct reader_edit *e, const struct edit_splice *splice,
                            const struct edit_meant *meant, struct reader_edit_change *change,
                            bool *done);

#endif
