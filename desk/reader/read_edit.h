/* read_edit.h - editing in the page: what its files share.
 *
 *     read_edit.c       the mode, changes and what follows them
 *     read_edit_keys.c  keys, the caret's ways, the pointer
 *     read_edit_im.c    the input method, the caret as it is drawn
 *     read_save.c       saving, the journal, files that others change, closing */
#ifndef LUTETIA_READ_EDIT_H
#define LUTETIA_READ_EDIT_H

#include "read_desk.h"

#include <reader_edit.h>

struct read_editing {
    struct reader_edit *edit; /* of the document; NULL: there is none */
    bool on;
    size_t caret, from; /* from: where the selection begins; the caret itself: there is none */
    bool before;        /* the caret is at the letter before it, as at a line's end */
    double want_x;      /* where it goes up and down; negative: where it is */
    GtkIMContext *im;
    GtkEventController *keys;
    char *preedit;
    int preedit_caret; /* bytes */
    guint blink;
    bool hidden; /* by blinking */
    guint filling;
    /* saving */
    GPtrArray *saved; /* GBytes: what the file of each source is, as far as it is known */
    guint keeping;    /* the journals are written soon */
    int writing;      /* they are being written */
    bool asked;       /* the window may be closed */
    GtkWidget *asking;
    /* what the input method calls */
    void (*type)(struct read_desk *d, const char *text);
    void (*erase)(struct read_desk *d, size_t begin, size_t end);
};

/* read_edit.c */
/* Shows what has become of the document, puts the caret there, and finishes the change. status:
 * what the edit has said. */
void read_edit_changed(struct read_desk *d, enum reader_status status,
                       struct reader_edit_change *change);
void read_edit_caret(struct read_desk *d, size_t byte, bool before, bool select);
struct read_range read_edit_range(const struct read_desk *d); /* what is selected */
void read_edit_delete(struct read_desk *d, size_t begin, size_t end);
void read_edit_break(struct read_desk *d);

/* read_edit_im.c */
void read_edit_im_begin(struct read_desk *d);
void read_edit_im_place(struct read_desk *d);
void read_edit_blink(struct read_desk *d, bool on);
void read_edit_wanted(struct read_desk *d); /* the caret is in the window */
bool read_edit_caret_box(struct read_desk *d, struct reader_box *box);

#endif
