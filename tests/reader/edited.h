/* edited.h - a document that tests edit, and its slow twin.
 *
 *     struct edited e;
 *     edited_begin(&e, "A *word*.\n", NULL);
 *     reader_edit_insert(e.edit, caret_at(&e, "wo|rd"), ...);
 *     as_from_scratch(&e);
 *     edited_end(&e); */
#ifndef LUTETIA_TEST_READER_EDITED_H
#define LUTETIA_TEST_READER_EDITED_H

#include <reader_edit.h>

/* A document that is edited. */
struct edited {
    struct reader_document *document;
    struct reader_files files;
    struct reader_remarks *remarks;
    struct reader_edit *edit;
};

/* Of one source, or two (NULL: one). */
void edited_begin(struct edited *e, const char *one, const char *two);
void edited_end(struct edited *e);
/* It is what its sources are when they are read from the beginning. */
void as_from_scratch(const struct edited *e);
/* The first place of `at` in the plain text, with | where the caret is. */
size_t caret_at(const struct edited *e, const char *at);

#endif
