/* watched_text.h - a text file that somebody else writes while the stage is played.
 *
 *     struct watched_text *watched;
 *     if (watched_text_open("cue.txt", &watched) != STAGE_OK)
 *         die(stage_error());
 *     const char *words = watched_text_look(watched, now_s);          // before each picture
 *     if (words)
 *         stage_text(stage, words);
 *     watched_text_close(watched);
 *
 * The file is looked at ten times a second, by its time, length and number, and read when they
 * have changed and stand still: an editor may write it in place or rename another one over it.
 * Line ends and blanks at its end are left out. The file need not be there all the time.
 *
 * Threads: one.
 */
#ifndef LUTETIA_LIVE_WATCHED_TEXT_H
#define LUTETIA_LIVE_WATCHED_TEXT_H

#include <stage_status.h>

struct watched_text;
/* Errors: BAD_FILE (it cannot be read, or is longer than a stage's text), NO_MEMORY. Owns: the
 * caller closes *out. */
enum stage_status watched_text_open(const char *path, struct watched_text **out);
void watched_text_close(struct watched_text *watched); /* NULL is fine */

/* What the file says, when that is new; the first call gives what it says at first. NULL:
 * nothing new. The text lasts until the next call. */
const char *watched_text_look(struct watched_text *watched, double now_s);
/* What was wrong with the file since the last call; NULL: nothing. */
const char *watched_text_wrong(struct watched_text *watched);

#endif
