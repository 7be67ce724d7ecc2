/* studio_selecting.h - a paused session and a hand that selects in it, for the tests of
 * selections. Each function fails the test where the session refuses. */
#ifndef LUTETIA_TEST_STUDIO_SELECTING_H
#define LUTETIA_TEST_STUDIO_SELECTING_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdbool.h>

#include "studio_scene.h"
#include "studio_selection.h"

enum { FIBERS = SCENE_WIDTH * SCENE_HEIGHT };
/* What selecting_rectangle() selects. */
enum { LEFT = 20, TOP = 12, RIGHT = 70, BOTTOM = 52 };

#define good(call) assert_int_equal(call, PAPER_OK)

/* An empty sheet of the scene's size. Owns: the caller destroys it. */
struct studio_session *selecting_begin(void);
void selecting_point(struct studio_session *s, enum studio_point_kind kind, double time_s,
                     double x, double y);
/* A tool from one point to another, one second long. */
void selecting_drag(struct studio_session *s, enum studio_tool_number tool, double x1,
                    double y1, double x2, double y2);
void selecting_rectangle(struct studio_session *s);
/* Whether anything is selected. */
bool selecting_has(struct studio_session *s);
/* FIBERS numbers. Owns: the caller frees them. */
float *selecting_layer(struct studio_session *s, enum paper_layer layer, int pigment);

#endif
