/* studio_session_internal.h - what the files of a session share. */
#ifndef LUTETIA_STUDIO_SESSION_INTERNAL_H
#define LUTETIA_STUDIO_SESSION_INTERNAL_H

#include "studio_session.h"

struct studio_session {
    struct paper_sheet *sheet;
    struct studio_settings settings;
    /* The brush that was made last, if nothing has been undone since. */
    bool has_brush;
    struct paper_brush brush;
    /* The deed that the hand is at: as it was when it began. */
    bool down;
    struct studio_settings at;
    double began_s;
    int operations;   /* that had been done before */
    int stroke_steps; /* that the paper has made under it */
    double pace_most; /* of strokes; 0: any */
    struct paper_stroke_sample *samples;
    int samples_count, samples_capacity;
    bool held; /* something was undone, and nothing done since */
    bool wet;
};

/* Keeps the text where studio_session_error() finds it. */
enum paper_status studio_session_failed(enum paper_status status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The deed that the hand is at is as if it had not begun. */
void studio_session_drop(struct studio_session *s);
/* The sheet gets the air that is set. */
enum paper_status studio_session_air(struct studio_session *s);
struct paper_sheet_view studio_session_view(const struct studio_session *s);

#endif
