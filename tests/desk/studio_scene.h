/* studio_scene.h - a session that tests share: as what a hand does, and as calls of the paper's
 * library that leave the same sheet.
 *
 * The second way is the oracle: it uses nothing of the studio. A deed that is undone is not
 * done there at all. */
#ifndef LUTETIA_TEST_STUDIO_SCENE_H
#define LUTETIA_TEST_STUDIO_SCENE_H

#include <history.h>
#include <stdio.h>
#include <studio_session.h>

enum { SCENE_WIDTH = 96, SCENE_HEIGHT = 72, SCENE_SAMPLES = 6 };

enum scene_end {
    SCENE_KEPT,
    SCENE_UNDONE,
    SCENE_DROPPED
}; /* dropped: undone before the hand is lifted */

struct scene_deed {
    enum studio_tool_number tool;
    double width;
    int count;
    double way[SCENE_SAMPLES][3]; /* x, y in eighths of fibers, pressure */
    int steps;                    /* after it */
    enum scene_end end;
};

extern const struct scene_deed scene_deeds[];
extern const int scene_deeds_count;

struct paper_sheet_config scene_config(void);
/* The sheet after all deeds, by the paper's own functions. */
enum paper_status scene_paint(struct paper_sheet *sheet);
/* A hand from left to right in four points, from y on, `rises` fibers lower at each; its last
 * point lifts it, or only moves it on. */
enum paper_status scene_sweep(struct studio_session *session, double y, double rises,
                              bool lifted);
/* A hand's points. */
enum paper_status scene_play(struct studio_session *session);
/* The same as recorded input, at that zoom, with the sheet's middle in the canvas's. */
void scene_write(FILE *out, double zoom);

#endif
