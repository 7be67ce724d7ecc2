/* scene_springs.h - a word's letters on a network made by hand, for the tests of the stage.
 *
 * Each letter stands on four masses of its own with springs along edges and diagonals. Two
 * springs join it to the next letter. A letter's box is one unit wide and 1.2 high; the first
 * is at (0, bottom). */
#ifndef LUTETIA_TEST_SCENE_SPRINGS_H
#define LUTETIA_TEST_SCENE_SPRINGS_H

#include <face.h>
#include <springs.h>
#include <stage.h>

/* Makes a stage with the word on it. face: borrowed, must outlive the stage. */
struct stage *scene_springs(const char *word, double bottom, struct font_face *face);

#endif
