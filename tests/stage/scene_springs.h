/* scene_springs.h - letters of a word on a network made by hand: what tests of the stage look at.
 *
 * Each letter stands on four masses of its own with springs along edges and diagonals; two springs join it to the next. Its box
 * is one unit wide and 1.2 high; the first is at (0, bottom). */
#ifndef LUTETIA_TEST_SCENE_SPRINGS_H
#define LUTETIA_TEST_SCENE_SPRINGS_H

#include <face.h>
#include <springs.h>
#include <stage.h>

/* A stage with the word on it. face: borrowed, must outlive it. */
struct stage *scene_springs(const char *word, double bottom, struct font_face *face);

#endif
