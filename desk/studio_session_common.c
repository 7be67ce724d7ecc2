/* studio_session_common.c - what the files of a session use: failures, the deed in the hand, the air. */
#include "studio_session_internal.h"

#include <error_text.h>

#include <stdarg.h>
#include <stdio.h>

/* ---- failures ---- */

static _Thread_local struct error_text own; /* "": the paper's */

enum paper_status studio_session_failed(enum paper_status status, const char *format, ...)
{
    char text[ERROR_TEXT_BYTES];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    error_text_fail(&own, (int)status, "%s", text);
    return status;
}

const char *studio_session_error(void)
{
    return own.text[0] ? own.text : paper_error();
}

void studio_session_error_forget(void)
{
    own.text[0] = '\0';
}

void studio_session_drop(struct studio_session *s)
{
    if (paper_sheet_stroke_growing(s->sheet))
        paper_sheet_stroke_drop(s->sheet);
    if (s->down && paper_history_done(s->sheet) > s->operations) { /* its brush, its dip */
        paper_history_undo(s->sheet, paper_history_done(s->sheet) - s->operations);
        s->has_brush = false;
    }
    s->down = false;
    s->samples_count = 0;
}

/* ---- air ---- */

enum paper_status studio_session_air(struct studio_session *s)
{
    struct paper_air air = *paper_sheet_get_air(s->sheet);
    const double *value = s->settings.value;
    if (air.gravity[0] == value[STUDIO_TILT_X] && air.gravity[1] == value[STUDIO_TILT_Y] &&
        air.humidity == value[STUDIO_HUMIDITY] && air.edge == value[STUDIO_EDGE])
        return PAPER_OK;
    air.gravity[0] = value[STUDIO_TILT_X];
    air.gravity[1] = value[STUDIO_TILT_Y];
    air.humidity = value[STUDIO_HUMIDITY];
    air.edge = value[STUDIO_EDGE];
    return paper_sheet_air(s->sheet, &air);
}
