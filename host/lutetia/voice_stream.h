/* voice_stream.h - pictures of `lutetia voice --microphone --stream` for other programs. */
#ifndef LUTETIA_VOICE_STREAM_H
#define LUTETIA_VOICE_STREAM_H

#include <picture_stream.h>

struct voice_stream {
    struct picture_stream_def def;
    struct picture_stream *stream; /* NULL: none is wanted */
    struct display_image image;
    double due_s;
};

/* Reads TO[,WIDTHxHEIGHT][,FPS]; without a size it is size_px, which becomes the stream's. An
 * exit status; what is wrong has been said. */
int voice_stream_read(const char *to, int size_px[2], struct voice_stream *out);
/* Begins what was read, and ends it. */
int voice_stream_open(struct voice_stream *s);
void voice_stream_close(struct voice_stream *s);

/* Hands out the picture, which has the stream's size, where one is due; says where the stream
 * is interrupted and where it goes on. An exit status. */
int voice_stream_take(struct voice_stream *s, const struct display_image *picture,
                      double now_s);

#endif
