/* read_stages.h - demonstrations in the page, shared by the files that run them
 * (read_stages.c), draw them (read_stages_draw.c) and hand them input (read_stages_hand.c). */
#ifndef LUTETIA_READ_STAGES_H
#define LUTETIA_READ_STAGES_H

#include "read_desk.h"

#include <demonstration.h>

struct stage {
    int block;    /* of the document's */
    int number;   /* of a program: which of the document's programs, from 0 */
    char *called; /* its number in the document, and the heading that it stands under */
    int width, height;
    bool program; /* in C/Paris, not a script */
    GtkWidget *strip, *button, *line;
    GtkWidget *printed; /* what a program prints; NULL: a script */
    long printed_lines; /* that are seen there, of all */
    int printed_most;   /* for how many there is room */
    struct read_controls *controls;
    struct read_stages *stages;
    struct demonstration *run; /* NULL: it does not run */
    GdkTexture *texture;       /* its last picture; NULL: none */
    GBytes *pixels;            /* of that */
    long textures;             /* how many it has had */
    bool seen;
    struct reader_stage place; /* in the window, while it is seen */
    gint64 seen_us;
    bool uncompiled; /* its compiler has said no: with other text it is tried again */
};

struct read_stages {
    struct read_desk *desk;
    GPtrArray *all;      /* struct stage */
    struct stage *held;  /* the button that was pressed on it is still down */
    struct stage *keyed; /* keys go to it */
    guint filling, tick;
    gint64 tick_us;
    GArray *again;  /* of the programs that the document had, those that were running */
    GArray *edited; /* numbers of those whose text is being edited */
    guint resting;  /* they are compiled when nothing was typed for a while */
};

/* That of a block of the document; NULL: it has not been seen yet. */
struct stage *read_stage_of(const struct read_stages *stages, int block);
/* read_printed.c */
GtkWidget *read_printed_new(const char *called);
/* True: there are more lines than there is room for. */
bool read_printed_fill(struct stage *s);
/* For recorded input: its lines. number: of the demonstration. */
void read_printed_tell(const struct stage *s, guint number, GString *to);
int read_printed_height(const struct stage *s); /* 0: nothing was printed */

/* Runs it, or stops it: its button. */
void read_stage_toggle(struct stage *s);

#endif
