/* stage_stream.c - see stage_stream.h. */
#include "stage_stream.h"

#include <picture_stream.h>

#include <math.h>
#include <stdlib.h>

struct stage_stream {
    struct picture_stream_def def;
    struct picture_stream *stream;
    struct stage_draw_list list;
    struct display_image image;
    double due_s; /* 0: at once */
};

enum stage_status stage_stream_open(const char *to, int width_px, int height_px, bool alpha,
                                    struct stage_stream **out)
{
    struct stage_stream *s = calloc(1, sizeof *s);
    *out = NULL;
    if (!s)
        return stage_fail(STAGE_NO_MEMORY, "no memory for a stream");
    enum display_status status = picture_stream_read(to, &s->def);
    if (status == DISPLAY_OK && !s->def.width_px) {
        s->def.width_px = width_px & ~1;
        s->def.height_px = height_px & ~1;
    }
    s->def.alpha = alpha;
    if (status == DISPLAY_OK)
        status = picture_stream_open(&s->def, &s->stream);
    if (status == DISPLAY_OK) {
        *out = s;
        return STAGE_OK;
    }
    stage_stream_close(s);
    return stage_fail(status == DISPLAY_BAD_ARGUMENT ? STAGE_BAD_ARGUMENT
                      : status == DISPLAY_NO_MEMORY  ? STAGE_NO_MEMORY
                                                     : STAGE_FAILED,
                      "%s", display_error());
}

void stage_stream_close(struct stage_stream *s)
{
    if (!s)
        return;
    picture_stream_close(s->stream);
    stage_draw_finish(&s->list);
    display_image_destroy(&s->image);
    free(s);
}

enum stage_status stage_stream_take(struct stage_stream *s, struct stage_renderer *renderer,
                                    const struct stage_draw_list *list, int width_px,
                                    int height_px, struct stage_color background, double now_s)
{
    const double apart_s = 1 / s->def.fps, early_s = 0.1 * apart_s;
    if (now_s < s->due_s - early_s)
        return STAGE_OK;
    s->due_s += apart_s; /* at a steady rate; what was missed is not made up for */
    if (s->due_s < now_s)
        s->due_s = now_s + apart_s;
    const double scale =
        fmin((double)s->def.width_px / width_px, (double)s->def.height_px / height_px);
    stage_draw_begin(&s->list, STAGE_VIEW_PIXELS);
    stage_draw_scaled(&s->list, list, scale, (s->def.width_px - scale * width_px) / 2,
                      (s->def.height_px - scale * height_px) / 2);
    enum stage_status status =
        stage_renderer_apart(renderer, &s->list, background, s->def.width_px, s->def.height_px,
                             s->def.alpha, &s->image);
    if (status == STAGE_OK && picture_stream_put(s->stream, &s->image) != DISPLAY_OK)
        status = stage_fail(STAGE_FAILED, "%s", display_error());
    return status;
}

const char *stage_stream_said(struct stage_stream *s)
{
    return picture_stream_said(s->stream);
}
