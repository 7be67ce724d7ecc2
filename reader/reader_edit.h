/* reader_edit.h - a document that is edited where it is read: letters are typed and deleted in
 * its plain text, and the bytes of its files follow.
 *
 *     struct reader_files files = {.keep = true};   // and the document read with them
 *     struct reader_edit *edit;
 *     struct reader_edit_change change;
 *     reader_edit_create(&document, &files, NULL, &edit);
 *     if (reader_edit_insert(edit, 120, 120, "heron", 5, &change) == READER_OK)
 *         show(change.caret);
 *     reader_edit_change_finish(&change);
 *     reader_edit_undo(edit, false, &change);
 *
 * An edit is a change of the bytes of one file; all others stay what they are. It is tried
 * first: the Markdown that comes of it is read, and the edit is done only if what is read then
 * is what was there with just these letters more or fewer. So a typed sign that would be markup
 * is written with a backslash before it, and what cannot be told in Markdown at that place is
 * refused, with a line that says so, and all is as it was.
 *
 * Where only one paragraph, fence of code or note is touched, whose Markdown nothing else can
 * depend on, it alone is read again, and the document is changed in place (change.block). Else
 * all files are read again, and there is another document.
 *
 * Markdown has no empty paragraph, and no blank at the end of one. So what is typed there
 * waits (change.waits) until the next letter comes.
 *
 * Errors: functions that can fail return a status and leave one line in reader_error().
 * Ownership: the document, the files and the remarks are borrowed. Threads: one at a time. */
#ifndef LUTETIA_READER_EDIT_H
#define LUTETIA_READER_EDIT_H

#include "reader_files.h"
#include "reader_remarks.h"

struct reader_edit;

enum reader_edit_waits {
    READER_WAITS_NOTHING,
    READER_WAITS_BLANK,
    READER_WAITS_PARAGRAPH, /* or an item, where the caret is in one */
    READER_WAITS_OUTSIDE    /* a paragraph behind the list or quote */
};

/* Bytes of the plain text at..at + removed have become `inserted` others. */
struct reader_edit_move {
    size_t at, removed, inserted;
};

struct reader_edit_change {
    int block; /* of the document's, and behind those of its notes, in place; else -1 */
    struct reader_document *before; /* that another one has come for; NULL: none has */
    struct reader_edit_move *moves; /* one after the other */
    int moves_count;
    size_t caret;
    bool more; /* of undo: the next one belongs to it */
};
/* Destroys the document that there was. All zeros are fine. */
void reader_edit_change_finish(struct reader_edit_change *change);
/* Where a byte of the plain text is after a change. */
size_t reader_edit_moved(const struct reader_edit_change *change, size_t byte);

/* document, files: variables, in which another document may come to be; files.keep is set, and
 * its plain text is made. remarks: those that move along; NULL: none. Errors: BAD_ARGUMENT,
 * NO_MEMORY. Owns: the caller destroys *out. */
enum reader_status reader_edit_create(struct reader_document **document,
                                      struct reader_files *files,
                                      struct reader_remarks *remarks, struct reader_edit **out);
void reader_edit_destroy(struct reader_edit *edit); /* NULL is fine */

/* Bytes begin..end of the plain text, of one block, become these, which have line ends only in
 * code. Errors: BAD_ARGUMENT (it cannot be told in Markdown there; all is as it was),
 * TOO_LARGE, NO_MEMORY. */
enum reader_status reader_edit_insert(struct reader_edit *edit, size_t begin, size_t end,
                                      const char *utf8, size_t bytes,
                                      struct reader_edit_change *change);
/* They go. Errors: the same. */
enum reader_status reader_edit_delete(struct reader_edit *edit, size_t begin, size_t end,
                                      struct reader_edit_change *change);
/* Return: a paragraph, item or line of code ends at the byte. Errors: the same. */
enum reader_status reader_edit_break(struct reader_edit *edit, size_t byte,
                                     struct reader_edit_change *change);
/* What waits is given up. False: nothing did. */
bool reader_edit_wait_end(struct reader_edit *edit);
enum reader_edit_waits reader_edit_waits(const struct reader_edit *edit);

/* Bytes of a source become others, whatever they say then. Errors: BAD_ARGUMENT, TOO_LARGE,
 * NO_MEMORY. */
enum reader_status reader_edit_source(struct reader_edit *edit, int source, size_t begin,
                                      size_t end, const char *utf8, size_t bytes,
                                      struct reader_edit_change *change);

/* The next edit is undone by itself, whatever came before. */
void reader_edit_part(struct reader_edit *edit);
/* Edits from one to the other are undone together. */
void reader_edit_group(struct reader_edit *edit, bool begins);
bool reader_edit_can(const struct reader_edit *edit, bool redo);
/* Undoes an edit, or does it again: bytes and remarks are what they were. Errors: as above. */
enum reader_status reader_edit_undo(struct reader_edit *edit, bool redo,
                                    struct reader_edit_change *change);

#endif
