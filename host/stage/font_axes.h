/* font_axes.h - the axes of a variable font as an actor's controls, and what leads them: a
 * letter's strain, a note's velocity.
 *
 *     static const struct stage_lead leads[] = {{"strain", "..."}};
 *     stage_axes_find(&axes, &set, face, leads, 1);
 *     rows_count += stage_axes_rows(&axes, rows + rows_count, axis_read, axis_write);
 *     ...axis_read: *stage_axes_setting(&set, index); axis_write: stage_axes_write()...
 *     stage_axes_of(&axes, &set, parts, &letter.axes);       // of one letter, for drawing
 *
 * Each axis has a control of its value, and for each lead one that says how far that moves it:
 * `weight` and `weight_strain`. A lead's part is -1..1. Of a control that is 1, a part of 1
 * moves the axis from where it is to its most, a part of -1 to its least; a control below 0
 * turns that round. What leads are moved by has steps, so that a letter at rest is one letter.
 *
 * Threads. As the face. */
#ifndef LUTETIA_STAGE_FONT_AXES_H
#define LUTETIA_STAGE_FONT_AXES_H

#include "control_table.h"
#include "draw_list.h"

enum { STAGE_AXES_MAX = 16, STAGE_LEADS_MAX = 3, STAGE_AXIS_NAME_BYTES = 32 };

/* What leads axes: the end of its controls' names, and what they say. */
struct stage_lead {
    const char *name, *does;
};

/* Does not change once it is found. */
struct stage_axes {
    struct font_face *face;
    int count, leads_count;
    const struct stage_lead *leads;
    char tags[STAGE_AXES_MAX][5];
    double least[STAGE_AXES_MAX], most[STAGE_AXES_MAX], usual[STAGE_AXES_MAX];
    char names[STAGE_AXES_MAX][1 + STAGE_LEADS_MAX][STAGE_AXIS_NAME_BYTES];
};

/* What changes: an actor keeps it with its other settings. Indices of rows are places in it. */
struct stage_axes_set {
    double values[STAGE_AXES_MAX][1 + STAGE_LEADS_MAX];
};

/* The first STAGE_AXES_MAX axes of the face that have a name; none where it is NULL or has
 * none. leads: borrowed, STAGE_LEADS_MAX at most. taken: another control's name, for an axis
 * that would be called so and is called by its tag; NULL is fine. */
void stage_axes_find(struct stage_axes *axes, struct stage_axes_set *set,
                     struct font_face *face, const struct stage_lead *leads, int leads_count,
                     const char *taken);

/* Writes their rows and returns how many, at most STAGE_AXES_MAX (1 + STAGE_LEADS_MAX). The
 * rows' names are the axes'. */
int stage_axes_rows(const struct stage_axes *axes, struct control *rows,
                    double (*read)(void *actor, int index),
                    unsigned (*write)(void *actor, int index, double value));

double *stage_axes_setting(struct stage_axes_set *set, int index);
/* Sets the axis of the face, or what leads it. Errors: BAD_ARGUMENT, where more axes would be
 * led at once than a letter can have (STAGE_LETTER_AXES_MAX); nothing has changed then. */
enum stage_status stage_axes_write(const struct stage_axes *axes, struct stage_axes_set *set,
                                   int index, double value);
/* Sets all axes of the face as the settings have them. */
void stage_axes_put(const struct stage_axes *axes, const struct stage_axes_set *set);

/* Whether anything leads an axis now. */
bool stage_axes_led(const struct stage_axes *axes, const struct stage_axes_set *set);
/* The axes of a letter, where leads have those parts (leads_count of them): only those that
 * are not where the face has them. */
void stage_axes_of(const struct stage_axes *axes, const struct stage_axes_set *set,
                   const double *parts, struct stage_letter_axes *out);

bool stage_letter_axes_same(const struct stage_letter_axes *a,
                            const struct stage_letter_axes *b);

/* Sets a letter's axes on its face. before: becomes what they were, to be put back; NULL is
 * fine. */
void stage_letter_axes_put(struct font_face *face, const struct stage_letter_axes *axes,
                           struct stage_letter_axes *before);

#endif
