/* studio_messages.h - what a window tells the paper's thread: in order, none lost, none merged,
 * and without waiting.
 *
 *     window:  studio_messages_put(&ring, &message);          // as often as there are events
 *              studio_messages_flush(&ring);                  // once a picture
 *     paper:   while (studio_messages_take(&ring, &message)) ...
 *
 * A ring of STUDIO_MESSAGES_MAX places goes from one thread to the other. What finds no place
 * there waits in a list of the window's own, and moves on in its order when there is room
 * again.
 *
 * Threads: one that puts and flushes, one that takes. */
#ifndef LUTETIA_STUDIO_MESSAGES_H
#define LUTETIA_STUDIO_MESSAGES_H

#include "studio_session.h"

#include <semaphore.h>
#include <stdatomic.h>

enum studio_message_kind {
    STUDIO_MESSAGE_POINT,
    STUDIO_MESSAGE_SET,  /* setting, value */
    STUDIO_MESSAGE_CARE, /* setting: an enum studio_care */
    STUDIO_MESSAGE_STEP, /* value: how many */
    STUDIO_MESSAGE_GO_ON,
    STUDIO_MESSAGE_UNDO,
    STUDIO_MESSAGE_REDO,
    STUDIO_MESSAGE_VISIT, /* value: after how many deeds */
    STUDIO_MESSAGE_PRESENT,
    STUDIO_MESSAGE_FROM_HERE,
    STUDIO_MESSAGE_REMOVE,
    STUDIO_MESSAGE_DISH,
    STUDIO_MESSAGE_BOOKMARK,       /* text: its name; NULL: one, or none any more */
    STUDIO_MESSAGE_BOOKMARK_VISIT, /* value: not 0: a later one */
    STUDIO_MESSAGE_WAY,
    STUDIO_MESSAGE_FLOW, /* what was stopped goes on */
    STUDIO_MESSAGE_DRY,
    STUDIO_MESSAGE_SEAL,
    STUDIO_MESSAGE_SELECT_NONE,
    STUDIO_MESSAGE_SELECT_INVERT,
    STUDIO_MESSAGE_TYPE,      /* type: is let into the paper */
    STUDIO_MESSAGE_TYPE_SHOW, /* type: is shown as it would be; an empty text: nothing is */
    STUDIO_MESSAGE_SCREEN,    /* screen: takes what is in the dish at type_x, type_y */
    STUDIO_MESSAGE_STAMP, /* text: the picture's file; type_x, type_y: where its middle is */
    /* text: the file; is shown as it would be at 0, 0; "": none is; value: it is read anew */
    STUDIO_MESSAGE_STAMP_SHOW,
    STUDIO_MESSAGE_NEW,     /* config */
    STUDIO_MESSAGE_OPEN,    /* text: the file */
    STUDIO_MESSAGE_SAVE,    /* text: the file */
    STUDIO_MESSAGE_PICTURE, /* text: the file; value: pixels a fiber */
    STUDIO_MESSAGE_SCRIPT,  /* text: the file */
    STUDIO_MESSAGE_FILM,    /* text: the file; value: its seconds, at the most */
    STUDIO_MESSAGE_END
};

struct studio_message {
    enum studio_message_kind kind;
    int setting;
    double value;
    struct studio_point point;
    double type_x, type_y;
    char *text, *font, *features;      /* belong to the message; who takes it frees them */
    struct paper_sheet_config *config; /* likewise */
    struct paper_screen screen;        /* likewise, its gray */
    unsigned long number;              /* given when it is put: from 1 on */
};
void studio_message_free(struct studio_message *message);

enum { STUDIO_MESSAGES_MAX = 4096 };

struct studio_messages {
    /* private */
    struct studio_message ring[STUDIO_MESSAGES_MAX];
    atomic_ulong put, taken;
    sem_t come; /* posted with each message */
    struct studio_message *waiting;
    int waiting_first, waiting_count, waiting_capacity;
    unsigned long numbered;
};
void studio_messages_begin(struct studio_messages *m);
void studio_messages_finish(struct studio_messages *m);
/* Gives the message its number, which it returns, and takes what belongs to it over. 0: no
 * memory for a list; the message was freed. */
unsigned long studio_messages_put(struct studio_messages *m, struct studio_message message);
void studio_messages_flush(struct studio_messages *m);
/* False: there is none now. */
bool studio_messages_take(struct studio_messages *m, struct studio_message *out);
/* Whether there is one. For the thread that takes. */
bool studio_messages_waiting(const struct studio_messages *m);
/* Waits for one, so long at most. */
void studio_messages_wait(struct studio_messages *m, double seconds);

#endif
