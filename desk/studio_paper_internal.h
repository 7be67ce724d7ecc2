/* studio_paper_internal.h - what the files of the paper's thread share. */
#ifndef LUTETIA_STUDIO_PAPER_INTERNAL_H
#define LUTETIA_STUDIO_PAPER_INTERNAL_H

#include "studio_keeper.h"
#include "studio_paper.h"

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
    double due, looked_s;
    unsigned long heard;
    struct studio_message *later; /* what waits until the hand is lifted */
    int later_count, later_capacity;
    uint8_t *view;                                    /* the picture, 3 bytes a fiber */
    bool view_other;                                  /* the whole sheet is to be looked at */
    unsigned long points[POINTS_UNSEEN], before_hand; /* numbers of messages */
    double rested_s, worked_s; /* when the hand was heard last; what its stroke has taken */
    struct studio_report now;
    /* shared */
    pthread_mutex_t lock;
    struct studio_report report;
    struct studio_pictures *pictures; /* of this sheet */
    struct studio_shown shown;
    bool shown_new;
    /* the window's own */
    struct studio_pictures *looked; /* those that it looks at */
    uint8_t *shown_gray;
};

/* The last failure is reported. */
void studio_paper_complain(struct studio_paper *p);
/* Makes a picture of what has changed, and gives it to the window. */
void studio_paper_look(struct studio_paper *p);

#endif
