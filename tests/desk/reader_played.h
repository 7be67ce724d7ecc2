/* reader_played.h - the reader's window with recorded input in place of a hand: for tests.
 *
 *     played_write("a.md", "# A title");
 *     played_run("0.2 scroll 30\n0.3 tell /tmp/x\n", played_path("a.md"));
 *     played_well();
 *     assert_string_equal(played_told("x", "file"), "a.md");
 */
#ifndef LUTETIA_TEST_READER_PLAYED_H
#define LUTETIA_TEST_READER_PLAYED_H

#include "../lutetia/child.h"

extern struct child played; /* the window that was run last */

/* A folder for a group of tests, and its end. */
int played_begin(void **state);
int played_end(void **state);
/* A path in the folder; valid until seven more were asked for. */
const char *played_path(const char *name);
void played_write(const char *name, const char *text);
/* Runs the window with these lines on a document, and closes it. */
void played_run(const char *lines, const char *document);
/* Runs it with the arguments that `played` has; it must end well. */
void played_window(void);
/* The value of a line of what the window told in a file. */
const char *played_told(const char *name, const char *what);
/* It has ended well, and said nothing; or with a status, and one line that says this. */
void played_well(void);
void played_says(int status, const char *what);

#endif
