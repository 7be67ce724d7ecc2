/* studio_paper_internal.h - what the files of the paper's thread share. */
#ifndef LUTETIA_STUDIO_PAPER_INTERNAL_H
#define LUTETIA_STUDIO_PAPER_INTERNAL_H

#include "studio_keeper.h"
#include "studio_paper.h"
#include "studio_stamp.h"

enum { POINTS_UNSEEN = 3 }; /* samples at a stroke's end that its way is not settled for */

struct studio_paper {
    struct studio_paper_def def;
    struct paper_sheet_config config; /* of the first sheet */
    pthread_t thread;
    bool started;
    struct studio_messages messages;
    /* the thread's own */
    struct studio_session *session;
    struct studio_keeper keeper;
    bool kept; /* there is a keeper */
    bool dirty, end, forget;
    bool shown_ends; /* with the next picture nothing is shown any more */
    double due, looked_s;
    unsigned long heard;
    struct studio_message *later; /* what waits until the hand is lifted */
    int later_count, later_capacity;
    uint8_t *view;                                    /* the picture, 3 bytes a fiber */
    bool view_other;                                  /* the whole sheet is to be looked at */
    unsigned long points[POINTS_UNSEEN], before_hand; /* numbers of messages */
    struct studio_stamp stamp; /* the picture that was put or shown last */
    double rested_s, worked_s; /* when the hand was heard last; what its stroke has taken */
    bool flows;                /* the past has to flow anew before time goes on */
    bool looking, interrupted; /* a look is under way; the watch has ended it */
    double flow_told_s, pictured_s;
    int past_done, past_undone, past_capacity;
    unsigned long past_sheet;
    struct studio_report now;
    /* shared */
    pthread_mutex_t lock;
    struct studio_report report;
    struct studio_pictures *pictures; /* of this sheet */
    struct studio_shown shown;
    bool shown_new;
    struct studio_past past;
    struct studio_outlined outline;
    atomic_bool stop;
    /* the window's own */
    struct studio_pictures *looked; /* those that it looks at */
    uint8_t *shown_gray;
};

/* The last failure is reported. */
void studio_paper_complain(struct studio_paper *p);
/* Sheets (studio_paper_sheets.c): a new one; a file with the journal beside it, or a journal
 * alone. They take the place of the one before, unless they cannot be made. */
void studio_paper_sheet_make(struct studio_paper *p, const struct paper_sheet_config *config);
void studio_paper_sheet_open(struct studio_paper *p, const char *path, const char *journal);
/* Whether another studio has the file open; then that is the failure. */
bool studio_paper_held(struct studio_paper *p, const char *path);
/* From here on what is done with the sheet is kept: beside its file, or in the folder of those
 * that have none. found NULL: none was read. */
void studio_paper_journal(struct studio_paper *p, const char *path, const char *journal,
                          const struct paper_journal_found *found);

/* The past (studio_paper_past.c): watches the sheet's, after a look that went well or not,
 * takes a small picture, forgets small pictures from a deed on, lists the deeds where there are
 * others. */
void studio_paper_flow_watch(struct studio_paper *p);
void studio_paper_flowed(struct studio_paper *p, bool good);
void studio_paper_pictured(struct studio_paper *p);
void studio_paper_past_forget(struct studio_paper *p, int from);
void studio_paper_past_look(struct studio_paper *p);
/* A film of all that was done; the hand waits meanwhile. */
enum paper_status studio_paper_film(struct studio_paper *p, const char *path, double seconds,
                                    char *written, size_t room);
/* What is shown on the sheet as it would be, type or a stamp; its gray is the window's now. */
void studio_paper_show(struct studio_paper *p, const struct studio_shown *shown);
/* Puts a stamp, or shows one. */
enum paper_status studio_paper_stamp(struct studio_paper *p, const struct studio_message *m);
/* The window gets the selection's outline where it is another one. */
void studio_paper_outline_look(struct studio_paper *p);
/* Makes a picture of what has changed, and gives it to the window. */
void studio_paper_look(struct studio_paper *p);

#endif
