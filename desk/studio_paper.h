/* studio_paper.h - the paper's thread: it owns the machine, the sheet and its history, paints
 * what the window tells it, lets time go by, and makes pictures as fast as they are looked at.
 *
 *     struct studio_paper *paper = studio_paper_start(&(struct studio_paper_def){.config = config, .wake = wake, .context = window});
 *     studio_paper_send(paper, (struct studio_message){.kind = STUDIO_MESSAGE_POINT, .point = point});
 *     const struct studio_picture *picture = studio_paper_picture(paper);
 *     studio_paper_report(paper, &report);
 *     studio_paper_end(paper, true, &report);
 *
 * Threads: all functions belong to the thread that started it. `wake` is called by the paper's
 * thread when there is a new picture or another report; it returns at once. */
#ifndef LUTETIA_STUDIO_PAPER_H
#define LUTETIA_STUDIO_PAPER_H

#include "studio_messages.h"
#include "studio_pictures.h"

enum { STUDIO_TEXT_MAX = 1100 };

struct studio_paper_def {
    const struct paper_sheet_config
        *config;       /* of a new sheet; not looked at where a file is opened */
    const char *path;  /* a saved sheet; NULL: a new one */
    const char *found; /* the journal of one that was never saved; NULL: none */
    const char
        *folder; /* for journals of sheets that have no file yet; NULL: they are not kept */
    double budget_bytes; /* of the past's checkpoints */
    void (*wake)(void *context);
    void *context;
};

struct studio_report {
    unsigned long
        sheets; /* another number: another sheet, whose pictures may have another size */
    struct paper_sheet_config config;
    struct studio_settings settings; /* with `sheets`: what the window has to show */
    bool ready;                      /* there is a sheet */
    bool failed;                     /* there is none, and will be none: `error` says why */
    bool can_undo, can_redo, held, wet, working;
    bool changed;         /* since it was saved */
    long steps;           /* gone by */
    int operations;       /* done */
    double history_bytes; /* of the past */
    double budget_bytes;
    unsigned long answered;      /* the number of the last message that was done */
    bool looked;                 /* and the newest picture is of after it */
    bool found_again;            /* the sheet is as a journal told, not as it was saved */
    unsigned long errors, notes; /* another number: another text */
    char error[STUDIO_TEXT_MAX];
    char note[STUDIO_TEXT_MAX]; /* the file that was written */
    bool note_other;            /* which was a picture or a script, not the sheet */
    int deeds, deeds_done;      /* of the past, with those that are undone */
    unsigned long past;         /* another number: studio_paper_past() is another */
    bool visits, inserts;       /* studio_session_visits() */
    bool selected;              /* something is */
    unsigned long outlines;     /* another number: studio_paper_outline() is another */
    bool way;                   /* the hand's next stroke is another one's way */
    long flow_done, flow_total; /* steps, while the past flows anew; total 0: it does not */
    bool films;                 /* that is no past, but a film that is being made */
    bool stopped;               /* it was stopped; the picture is of before */
    char path[STUDIO_TEXT_MAX]; /* of the file; "": none yet */
};

struct studio_paper;

/* NULL: there is no thread, or no memory. */
struct studio_paper *studio_paper_start(const struct studio_paper_def *def);
/* All that was told is done first. *last (may be NULL) gets what is reported at the end.
 * forget: what is not saved may go; else its journal stays, and the sheet can be found again.
 * NULL is fine. */
void studio_paper_end(struct studio_paper *paper, bool forget, struct studio_report *last);

unsigned long studio_paper_send(struct studio_paper *paper, struct studio_message message);
/* The number of the last message that was sent. */
unsigned long studio_paper_sent(const struct studio_paper *paper);
/* Once a picture of the window's: what found no room goes on. */
void studio_paper_flush(struct studio_paper *paper);
void studio_paper_report(struct studio_paper *paper, struct studio_report *out);
/* NULL: no new one. It stays as it is until the next call. */
const struct studio_picture *studio_paper_picture(struct studio_paper *paper);

/* Stops a past that flows anew; the picture stays that of before, until something else is done
 * or STUDIO_MESSAGE_FLOW comes. */
void studio_paper_stop(struct studio_paper *paper);

/* The deeds of the past, with a small picture of the sheet after each that has been seen. */
enum { STUDIO_SMALL_WIDTH = 64, STUDIO_SMALL_HEIGHT = 48 };
struct studio_past {
    int count;
    struct studio_past_deed {
        char what[16];
        long time, steps;          /* studio_session.h */
        bool marked;               /* with a bookmark, */
        char name[PAPER_NAME_MAX]; /* whose name is this; "": none */
        bool pictured;
        uint8_t rgb[3 * STUDIO_SMALL_WIDTH * STUDIO_SMALL_HEIGHT];
    } * deeds;
};
/* Fills *past, which began as zeros. False: no memory; it is as it was. Owns: the caller frees
 * past->deeds. */
bool studio_paper_past(struct studio_paper *paper, struct studio_past *past);

/* The outline of what is selected, in fibers; count 0: nothing is. Fills *outline, which began
 * as zeros. False: no memory; it is as it was. Owns: studio_outlined_free(). */
struct studio_outlined {
    int count;
    double *points; /* pairs of x, y */
    int loops;
    int *ends; /* of each loop: how many points there are up to its end */
};
void studio_outlined_free(struct studio_outlined *outline);
bool studio_paper_outline(struct studio_paper *paper, struct studio_outlined *outline);

/* The type that is shown, as a screen with its place. False: none, or the same as at the last
 * call (*same). gray belongs to the paper until the next call. */
struct studio_shown {
    int x, y, width, height;
    const uint8_t *gray;
};
bool studio_paper_shown(struct studio_paper *paper, struct studio_shown *out);
/* From here on this is shown, whatever the paper does meanwhile; gray is the paper's then. */
void studio_paper_show_now(struct studio_paper *paper, const struct studio_shown *shown);

#endif
