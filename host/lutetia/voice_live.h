/* voice_live.h - `lutetia voice --microphone`: letters that a voice plays in a window, while it
 * is heard. */
#ifndef LUTETIA_VOICE_LIVE_H
#define LUTETIA_VOICE_LIVE_H

#include <microphone.h>
#include <voice_picture.h>
#include <voice_sound.h>

struct voice_live_def {
    const char *source; /* jack, pulse, or any */
    const char *text;
    struct font_face *face;
    struct voice_def hearing;
    struct voice_type_def type; /* its most size 0: as fits */
    int picture[2];
    const char *screen; /* as window.h */
    /* As picture_stream_read(); NULL: none. Pictures are drawn for its size. */
    const char *stream;
    const char *osc_to; /* as voice_osc_open(); NULL: nowhere */
};

/* Until somebody closes the window. Each sound that begins shows the text's next word. Exit
 * statuses; what is wrong has been said. */
int voice_live_window(const struct voice_live_def *def);

/* So many seconds of a microphone, from jack, pulse or any. */
int voice_live_record(const char *source, double seconds, struct voice_sound *out);

#endif
