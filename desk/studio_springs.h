/* studio_springs.h - springy type in a hand: a text on masses and springs that lies on the
 * sheet, is taken by a letter, thrown, and slides until it rests.
 *
 *     struct studio_springs *springs;
 *     if (studio_springs_create(&type, &settings, 640, 480, &springs) != PAPER_OK)
 *         die(studio_session_error());
 *     if (studio_springs_take(springs, 140, 90))
 *         studio_springs_move(springs, 200, 60);
 *     studio_springs_step(springs, 1.0 / 60);
 *     studio_springs_let_go(springs);
 *     while (!studio_springs_rests(springs))
 *         studio_springs_step(springs, 1.0 / 60);
 *     studio_springs_screen(springs, &screen, &x, &y);   // to be printed
 *     studio_springs_destroy(springs);
 *
 * The sheet lies flat, so nothing falls; the paper slows what slides on it, and its edges are
 * walls. Places are in fibers from the sheet's upper left corner.
 *
 * Errors: a status, and the text where studio_session_error() finds it. Threads: one at a
 * time. */
#ifndef LUTETIA_STUDIO_SPRINGS_H
#define LUTETIA_STUDIO_SPRINGS_H

#include "studio_session.h"

/* The type where and as it is set, on a sheet of width x height fibers; the leading is the
 * font's. Errors: BAD_ARGUMENT (STUDIO_TYPE_SPRINGS is "none"), BAD_FONT, BAD_TEXT (no letter
 * with ink), NO_MEMORY. Owns: the caller destroys *out. */
struct studio_springs;
enum paper_status studio_springs_create(const struct studio_type *type,
                                        const struct studio_settings *settings, double width,
                                        double height, struct studio_springs **out);
void studio_springs_destroy(struct studio_springs *springs); /* NULL is fine */

/* Takes the letter at the place by its nearest corner. False: there is none. */
bool studio_springs_take(struct studio_springs *springs, double x, double y);
void studio_springs_move(struct studio_springs *springs, double x, double y);
void studio_springs_let_go(struct studio_springs *springs);
/* So much time goes by, a tenth of a second at most. */
void studio_springs_step(struct studio_springs *springs, double seconds);
/* Whether a hand has it; whether it was let go and has come to rest. */
bool studio_springs_held(const struct studio_springs *springs);
bool studio_springs_rests(const struct studio_springs *springs);

/* What the letters cover of the sheet; gray NULL: nothing of it. Errors: NO_MEMORY. Owns: the
 * caller destroys *screen. */
enum paper_status studio_springs_screen(struct studio_springs *springs,
                                        struct paper_screen *screen, int *x, int *y);

#endif
