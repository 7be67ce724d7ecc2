/* studio_session_common.c - what the files of a session use: failures, the deed in the hand,
 * the air. */
#include "studio_session_internal.h"

#include <array.h>
#include <error_text.h>

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
        studio_session_selection_forget(s);
    }
    s->down = false;
    s->way = -1;
    s->samples_count = 0;
}

/* ---- deeds among the operations ---- */

enum paper_status studio_session_deed_done(struct studio_session *s, enum paper_status status)
{
    s->held = false;
    s->wet = true;
    return status;
}

enum studio_part studio_session_part(const struct studio_session *s, int number)
{
    struct paper_moment moment;
    if (!paper_history_moment(s->sheet, number, &moment))
        return STUDIO_PART_AFTER;
    if (!strcmp(moment.what, "brush") || !strcmp(moment.what, "dip"))
        return STUDIO_PART_BEFORE;
    return !strcmp(moment.what, "step") || !strcmp(moment.what, "air") ||
                   !strcmp(moment.what, "bookmark") ||
                   (!strcmp(moment.what, "resist") &&
                    studio_session_selects(s, number) == STUDIO_SELECTS_SECOND)
               ? STUDIO_PART_AFTER
               : STUDIO_PART_DEED;
}

static enum studio_selects selects_look(const struct studio_session *s, int number)
{
    if (studio_selection_begins(s->sheet, number))
        return STUDIO_SELECTS;
    return studio_selection_ends(s->sheet, number) ? STUDIO_SELECTS_SECOND
                                                   : STUDIO_SELECTS_NOTHING;
}

enum studio_selects studio_session_selects(const struct studio_session *s, int number)
{
    struct studio_pairs *pairs = s->pairs;
    if (!array_reserve(&pairs->at, &pairs->capacity, number + 1, sizeof *pairs->at))
        return selects_look(s, number);
    for (; pairs->count <= number; pairs->count++)
        pairs->at[pairs->count] = STUDIO_SELECTS_UNKNOWN;
    if (pairs->at[number] == STUDIO_SELECTS_UNKNOWN)
        pairs->at[number] = (unsigned char)selects_look(s, number);
    return (enum studio_selects)pairs->at[number];
}

bool studio_session_inserted(const struct studio_session *s)
{
    return s->inserted >= 0 && paper_history_done(s->sheet) == s->inserted &&
           paper_sheet_steps(s->sheet) == s->inserted_steps;
}

/* ---- bookmarks ---- */

/* Airs that are the air of before are bookmarks, too: older studios made them so. */
static enum paper_status bookmark_read(const struct studio_session *s, int number,
                                       struct paper_air *air, struct studio_bookmark *bookmark,
                                       bool *is)
{
    struct paper_moment moment;
    void *arguments;
    *is = false;
    if (!paper_history_moment(s->sheet, number, &moment) ||
        (strcmp(moment.what, "air") != 0 && strcmp(moment.what, "bookmark") != 0))
        return PAPER_OK;
    const enum paper_status status = paper_history_arguments(s->sheet, number, &arguments);
    if (status != PAPER_OK)
        return status;
    *bookmark = (struct studio_bookmark){.operation = number};
    if (strcmp(moment.what, "air") == 0) {
        *is = memcmp(arguments, air, sizeof *air) == 0;
        memcpy(air, arguments, sizeof *air);
    } else {
        *is = true;
        snprintf(bookmark->name, sizeof bookmark->name, "%s",
                 ((const struct paper_bookmark *)arguments)->name);
    }
    paper_history_arguments_free(moment.what, arguments);
    return PAPER_OK;
}

enum paper_status studio_session_bookmarks(const struct studio_session *s,
                                           struct studio_bookmark **bookmarks, int *count)
{
    const int all = paper_history_done(s->sheet) + paper_history_undone(s->sheet);
    struct paper_air air = paper_air_default();
    enum paper_status status = PAPER_OK;
    int capacity = 0;
    *bookmarks = NULL;
    *count = 0;
    for (int i = 0; i < all && status == PAPER_OK; i++) {
        struct studio_bookmark bookmark;
        bool is;
        status = bookmark_read(s, i, &air, &bookmark, &is);
        if (status != PAPER_OK || !is)
            continue;
        if (!array_reserve(bookmarks, &capacity, *count + 1, sizeof **bookmarks))
            status = studio_session_failed(PAPER_NO_MEMORY, "no memory for bookmarks");
        else
            (*bookmarks)[(*count)++] = bookmark;
    }
    if (status != PAPER_OK) {
        free(*bookmarks);
        *bookmarks = NULL;
        *count = 0;
    }
    return status;
}

/* ---- air ---- */

enum paper_status studio_session_air(struct studio_session *s)
{
    if (s->inserting >= 0) /* the air is that of what follows, too */
        return PAPER_OK;
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
