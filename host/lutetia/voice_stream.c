/* voice_stream.c - see voice_stream.h. */
#include "voice_stream.h"

#include "lutetia.h"

#include <stdlib.h>
#include <string.h>

int voice_stream_read(const char *to, int size_px[2], struct voice_stream *out)
{
    *out = (struct voice_stream){0};
    if (picture_stream_read(to, &out->def) != DISPLAY_OK)
        return fail("voice", "%s", display_error());
    if (!out->def.width_px) {
        out->def.width_px = size_px[0];
        out->def.height_px = size_px[1];
    }
    size_px[0] = out->def.width_px;
    size_px[1] = out->def.height_px;
    return EXIT_SUCCESS;
}

int voice_stream_open(struct voice_stream *s)
{
    s->image = (struct display_image){
        .width_px = s->def.width_px, .height_px = s->def.height_px, .channels = 3};
    if (display_image_create(&s->image) != DISPLAY_OK ||
        picture_stream_open(&s->def, &s->stream) != DISPLAY_OK)
        return fail("voice", "%s", display_error());
    return EXIT_SUCCESS;
}

void voice_stream_close(struct voice_stream *s)
{
    picture_stream_close(s->stream);
    display_image_destroy(&s->image);
    *s = (struct voice_stream){0};
}

int voice_stream_take(struct voice_stream *s, const struct display_image *picture, double now_s)
{
    const double apart_s = s->stream ? 1 / s->def.fps : 0, early_s = 0.1 * apart_s;
    if (!s->stream)
        return EXIT_SUCCESS;
    const char *said = picture_stream_said(s->stream);
    if (said)
        tell("voice", "%s", said);
    if (now_s < s->due_s - early_s)
        return EXIT_SUCCESS;
    s->due_s += apart_s; /* at a steady rate; what was missed is not made up for */
    if (s->due_s < now_s)
        s->due_s = now_s + apart_s;
    memcpy(s->image.pixels, picture->pixels,
           (size_t)picture->width_px * (size_t)picture->height_px * 3);
    return picture_stream_put(s->stream, &s->image) == DISPLAY_OK
               ? EXIT_SUCCESS
               : fail("voice", "%s", display_error());
}
