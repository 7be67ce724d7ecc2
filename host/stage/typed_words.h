/* typed_words.h - words that are typed over a stage's picture, and then are the stage's.
 *
 *     struct typed_words words = {0};
 *     typed_words_begin(&words, true);
 *     if (typed_words_input(&words, stage, &event, &status))
 *         ...it took the event; a status that is not OK: the words cannot be the stage's...
 *     typed_words_draw(&words, panel, stage, height_px, px, &list);
 *
 * Enter gives the words to the stage, Shift and Enter is a line's end, Backspace takes a
 * character back, Esc gives up.
 */
#ifndef LUTETIA_STAGE_TYPED_WORDS_H
#define LUTETIA_STAGE_TYPED_WORDS_H

#include <input.h>

#include "panel.h"

/* All zeros: nothing is typed. */
struct typed_words {
    bool typing;
    char text[STAGE_TEXT_BYTES + 1]; /* UTF-8 */
};

void typed_words_begin(struct typed_words *words, bool can);

/* True: it took the event, as it does with all keys while words are typed. *status: of the
 * stage, where they were given to it. */
bool typed_words_input(struct typed_words *words, struct stage *stage,
                       const struct input_event *event, enum stage_status *status);

/* Draws the words at the bottom, if any are typed. True: it did. */
bool typed_words_draw(const struct typed_words *words, struct stage_panel *panel,
                      const struct stage *stage, int height_px, double px,
                      struct stage_draw_list *list);

#endif
