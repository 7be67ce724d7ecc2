/* stage_stream.h - a stage's pictures, without panel, help and messages, for programs that read
 * them as they come.
 *
 *     struct stage_stream *stream;
 *     if (stage_stream_open("pipewire,1280x720,30", 1280, 800, true, &stream) != STAGE_OK)
 *         die(stage_error());
 *     stage_stream_take(stream, renderer, &view, now_s);       // each turn
 *     stage_stream_close(stream);
 *
 * The picture is drawn anew at the stream's size: as large as it fits, in its middle, on the
 * background. Threads: the renderer's. */
#ifndef LUTETIA_STAGE_STREAM_H
#define LUTETIA_STAGE_STREAM_H

#include "renderer.h"

struct stage_stream;

/* to: as picture_stream_read() has it; without a size it is the one given here, made even.
 * alpha: the pictures have the background's. Errors: BAD_ARGUMENT, FAILED (no such device or
 * server), NO_MEMORY. Owns: the caller closes *out. */
enum stage_status stage_stream_open(const char *to, int width_px, int height_px, bool alpha,
                                    struct stage_stream **out);
void stage_stream_close(struct stage_stream *stream); /* NULL is fine */

/* Hands the list out, made for a picture of that size, if a picture is due. Errors: those of
 * stage_renderer_apart(). */
enum stage_status stage_stream_take(struct stage_stream *stream,
                                    struct stage_renderer *renderer,
                                    const struct stage_draw_list *list, int width_px,
                                    int height_px, struct stage_color background, double now_s);

/* As picture_stream_said(). */
const char *stage_stream_said(struct stage_stream *stream);

#endif
