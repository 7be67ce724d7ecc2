/* error_text.h - a module's last failure in words, one for each thread.
 *
 *     _Thread_local struct error_text font_last_error;                     in one file of the
 *                                                                          module
 *     extern _Thread_local struct error_text font_last_error;              in its inner header
 *     #define font_fail(status, ...) ((enum font_status)error_text_fail(&font_last_error, (int)(status), __VA_ARGS__))
 *
 *     return font_fail(FONT_BAD_ARGUMENT, "a size is positive (got %g)", size);
 *
 * The module's public function hands out font_last_error.text. */
#ifndef LUTETIA_ERROR_TEXT_H
#define LUTETIA_ERROR_TEXT_H

#include <stdbool.h>
#include <stddef.h>

enum { ERROR_TEXT_BYTES = 1024 };

struct error_text {
    char text[ERROR_TEXT_BYTES]; /* "" before the first failure; longer texts are cut */
};

/* Keeps the text and returns the status. The arguments may point into e->text, so a message
 * can quote the failure before it. */
int error_text_fail(struct error_text *e, int status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same for functions that return a bool: returns false. */
bool error_text_false(struct error_text *e, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Adds a word to a list for such a text: behind `between`, unless it is the first; only whole,
 * so nothing where the room (bytes, the 0 included) does not suffice. text begins as "". */
void error_text_list(char *text, size_t room, const char *between, const char *word);

#endif
