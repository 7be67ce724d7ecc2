/* studio_session_internal.h - what the files of a session share. */
#ifndef LUTETIA_STUDIO_SESSION_INTERNAL_H
#define LUTETIA_STUDIO_SESSION_INTERNAL_H

#include "studio_selection.h"
#include "studio_session.h"

#include <techniques.h>

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
    /* The past (studio_past.c): numbers of operations, -1: none. */
    int present;         /* that are done in the present, while an earlier moment is visited */
    int inserting;       /* before those that are inserted */
    int way;             /* the stroke whose way the hand draws anew */
    int inserted;        /* that were done when an insertion had ended, */
    long inserted_steps; /* and how many steps had gone by */
    /* The operation of the past that was taken out or changed last, if no deed has been begun
     * since. */
    struct {
        enum studio_change { CHANGE_NONE, CHANGE_DONE, CHANGE_UNDONE } state;
        int number;
        bool replaced; /* another one is in its place */
        bool removed;
        /* What comes back by undo; of what is changed, by redo after it. */
        struct studio_operation {
            uint8_t *bytes;
            size_t count;
        } operation, second; /* the second one of a pair that was taken out; NULL: none */
    } changed;
    /* What each operation is to a selection, as far as somebody has asked. */
    struct studio_pairs {
        unsigned char *at; /* an enum studio_selects */
        int count, capacity;
    } * pairs;
    bool wet;
    struct studio_selection selection;
};

/* Keeps the text where studio_session_error() finds it. */
enum paper_status studio_session_failed(enum paper_status status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* The deed that the hand is at is as if it had not begun. */
void studio_session_drop(struct studio_session *s);
/* The sheet gets the air that is set. */
enum paper_status studio_session_air(struct studio_session *s);

/* History was gone back or changed in: the selection is looked for anew. */
static inline void studio_session_selection_forget(struct studio_session *s)
{
    s->selection.operations = 0;
    s->pairs->count = 0;
}

/* The selection (studio_session_selection.c): what the hand has drawn is selected, a click
 * selects nothing; what a screen covers of the rest is left out of it; a place for what has no
 * screen of its own, whose gray the caller frees. */
enum paper_status studio_session_select(struct studio_session *s);
enum paper_status studio_session_selection_clip(struct studio_session *s,
                                                struct paper_screen *screen, int x, int y);
enum paper_status studio_session_selection_place(struct studio_session *s,
                                                 struct paper_screen *screen,
                                                 struct paper_place *place);

/* What an operation is to a deed: brushes and dips belong to the deed that follows, time and
 * air to the one before. */
enum studio_part { STUDIO_PART_BEFORE, STUDIO_PART_DEED, STUDIO_PART_AFTER };
enum studio_part studio_session_part(const struct studio_session *s, int number);

/* Nothing has been done since an insertion ended: one undo takes all of it out. */
bool studio_session_inserted(const struct studio_session *s);

/* After a deed that a hand has done. */
enum paper_status studio_session_deed_done(struct studio_session *s, enum paper_status status);
/* Goes to the moment after so many operations. */
void studio_session_visit_to(struct studio_session *s, int operations);
/* The bookmarks, in their order, with those that are undone. Owns: the caller frees *bookmarks.
 * Errors: NO_MEMORY, BAD_FILE. */
struct studio_bookmark {
    int operation;
    char name[PAPER_NAME_MAX]; /* "": none */
};
enum paper_status studio_session_bookmarks(const struct studio_session *s,
                                           struct studio_bookmark **bookmarks, int *count);
/* What was taken out of the past, or changed there, is as it was before; and is taken out or
 * changed again. False: nothing was, or it cannot be. */
bool studio_session_change_undo(struct studio_session *s);
bool studio_session_change_redo(struct studio_session *s);
/* From here on an undo takes back something else. */
void studio_session_change_forget(struct studio_session *s);
/* Before a deed: where an earlier moment is visited, what is done from now on is inserted
 * there. */
enum paper_status studio_session_insert(struct studio_session *s);
/* The stroke gets the way that the hand has drawn. */
enum paper_status studio_session_way_end(struct studio_session *s);
/* What operation `number` is to a selection (studio_selection.h): the second one of a pair
 * belongs to the one before it. */
enum studio_selects {
    STUDIO_SELECTS_UNKNOWN,
    STUDIO_SELECTS_NOTHING,
    STUDIO_SELECTS,
    STUDIO_SELECTS_SECOND
};
enum studio_selects studio_session_selects(const struct studio_session *s, int number);

#endif
