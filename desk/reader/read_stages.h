/* read_stages.h - demonstrations in the page, shared by the files that run them (read_stages.c)
 * and hand them input (read_stages_hand.c). */
#ifndef LUTETIA_READ_STAGES_H
#define LUTETIA_READ_STAGES_H

#include "read_desk.h"

#include <demonstration.h>

struct stage {
    int block;    /* of the document's */
    char *called; /* its number in the document, and the heading that it stands under */
    int width, height;
    GtkWidget *strip, *button, *line;
    struct read_controls *controls;
    struct read_stages *stages;
    struct demonstration *run; /* NULL: it does not run */
    GdkTexture *texture;       /* its last picture; NULL: none */
    GBytes *pixels;            /* of that */
    long textures;             /* how many it has had */
    bool seen;
    struct reader_stage place; /* in the window, while it is seen */
    gint64 seen_us;
};

struct read_stages {
    struct read_desk *desk;
    GPtrArray *all;      /* struct stage */
    struct stage *held;  /* the button that was pressed on it is still down */
    struct stage *keyed; /* keys go to it */
    guint filling, tick;
    gint64 tick_us;
};

/* That of a block of the document; NULL: it has not been seen yet. */
struct stage *read_stage_of(const struct read_stages *stages, int block);
/* Runs it, or stops it: its button. */
void read_stage_toggle(struct stage *s);

#endif
