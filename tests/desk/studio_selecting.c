/* studio_selecting.c - see studio_selecting.h. */
#include "studio_selecting.h"

#include <stdlib.h>

struct studio_session *selecting_begin(void)
{
    const struct paper_sheet_config config = scene_config();
    struct studio_session *s;
    good(studio_session_create(&config, 64e6, &s));
    good(studio_session_set(s, STUDIO_PAUSED, 1));
    return s;
}

void selecting_point(struct studio_session *s, enum studio_point_kind kind, double time_s,
                     double x, double y)
{
    good(studio_session_point(
        s, &(struct studio_point){
               .kind = kind, .time_s = time_s, .x = x, .y = y, .pressure = 0.6}));
}

void selecting_drag(struct studio_session *s, enum studio_tool_number tool, double x1,
                    double y1, double x2, double y2)
{
    good(studio_session_set(s, STUDIO_TOOL, tool));
    selecting_point(s, STUDIO_POINT_DOWN, 1, x1, y1);
    selecting_point(s, STUDIO_POINT_UP, 2, x2, y2);
}

void selecting_rectangle(struct studio_session *s)
{
    good(studio_session_set(s, STUDIO_OUTLINE, STUDIO_OUTLINE_RECTANGLE));
    selecting_drag(s, STUDIO_TOOL_SELECT, LEFT, TOP, RIGHT, BOTTOM);
}

bool selecting_has(struct studio_session *s)
{
    int count;
    return studio_session_selected(s, &count) != NULL;
}

float *selecting_layer(struct studio_session *s, enum paper_layer layer, int pigment)
{
    float *values = malloc(FIBERS * sizeof *values);
    assert_non_null(values);
    good(paper_sheet_layer_read(studio_session_sheet(s), layer, pigment, values));
    return values;
}
