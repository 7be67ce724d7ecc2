/* visible_text.h - makes untrusted text safe to print: no control sequence reaches the
 * terminal.
 *
 *     char line[1200];
 *     // no font '\x1b]0;x\x07', in letters
 *     visible_text(line, sizeof line, "no font '\x1b]0;x\x07'");
 *     fprintf(stderr, "%s\n", line);
 *
 * A name, an error of a script, a log or a font's name may hold escapes that recolour,
 * retitle or remote-control a terminal, carriage returns that hide what stands before them,
 * and marks that turn the direction of what follows. Such characters are printed as escapes.
 */
#ifndef LUTETIA_VISIBLE_TEXT_H
#define LUTETIA_VISIBLE_TEXT_H

#include <stddef.h>

/* Prints the text as one line on the standard error: the way out for all that names files,
 * variables, devices or what was read. What is longer than some two thousand bytes is cut off.
 * Threads: any. */
__attribute__((format(printf, 1, 2))) void visible_say(const char *format, ...);

/* Prints on the standard output, and keeps line ends and tabs: the way out for what holds such
 * names. What is longer than some four thousand bytes is cut off. Threads: any. */
__attribute__((format(printf, 1, 2))) void visible_print(const char *format, ...);

/* Writes the text as a line. Line ends and tabs become spaces; other control characters, and
 * bytes that are no UTF-8, become \xNN; invisible characters (direction marks, joiners, C1
 * controls, line separators) become \u{NNNN}. The rest is unchanged. Text that does not fit
 * is cut off between characters. Returns the length. `out` and `text` do not overlap. */
size_t visible_text(char *out, size_t size, const char *text);

/* The same for `length` bytes, which may include zeros. Line ends and tabs are kept. */
size_t visible_text_lines(char *out, size_t size, const char *text, size_t length);

#endif
