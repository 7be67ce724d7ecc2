/* springs_internal.h - shared by springs.c, springs_hand.c and springs_draw.c. */
#ifndef LUTETIA_STAGE_SPRINGS_INTERNAL_H
#define LUTETIA_STAGE_SPRINGS_INTERNAL_H

#include "font_axes.h"
#include "springs.h"

/* The state of the hand.
 *
 *     NONE --press--> PULL      one mass by the hand's spring; Shift or pressure make it a HOLD
 *                     LETTER    four masses by springs, each as far from the pointer as it was
 *                     HOLD      a mass is where the pointer is; tacked when it is let go
 *                     CUT       springs that the pointer crosses
 */
enum springs_mode { SPRINGS_NONE, SPRINGS_PULL, SPRINGS_LETTER, SPRINGS_HOLD, SPRINGS_CUT };

struct springs_hand {
    enum springs_mode mode;
    int button;
    int masses[4], masses_count;
    double away_x[4], away_y[4]; /* offsets of the masses from the pointer when they were
                                  * taken */
    double x, y, near;           /* the pointer */
    double from_x, from_y;       /* where it was pressed */
    bool moved, untack;          /* moved further than a touch; if not, the tack is removed */
};

/* Parameters besides the network's world; all doubles, so that the tables can describe them. */
struct springs_settings {
    double hand, show_masses, show_springs, show_letters, full_strain, collide, record_hand;
    struct dyn_word_style style;
    struct stage_axes_set axes;
};

/* The strains of a letter's springs at this moment. */
struct springs_strain {
    double sum;
    int count;
};

/* A word and its letters. The actor and the states that it has kept share them. */
struct springs_text {
    int users;
    struct dyn_word *word; /* NULL: letters alone */
    struct stage_springs_letter *letters;
    int letters_count;
    struct font_box extent; /* as stage_springs_def has it */
    int *owners; /* for each mass: 1 and the number of the letter that it is a corner of; 0 */
    int owners_count;
    struct springs_strain *strains; /* for each letter; made anew for a picture */
};

struct springs {
    struct dyn_network *network;
    struct springs_text *text;
    struct control *rows;
    int rows_count;
    struct stage_springs_maker maker;
    struct dyn_clamps *clamps;
    struct dyn_clamps *recorded; /* keys of what hands held while recording; NULL: none */
    double recorded_s;           /* the last key's time */
    struct springs_settings set;
    struct stage_axes axes; /* of the font: see springs_axes.c */
    int axes_rows;          /* how many of the rows, the last ones, are the font's */
    struct springs_hand hand;
};

/* Owns: the word, also on failure; a user calls springs_text_let(). Errors: BAD_ARGUMENT (a
 * letter on a mass that does not exist), NO_MEMORY. */
enum stage_status springs_text_make(const struct stage_springs_def *def,
                                    struct springs_text **out);
/* One user less; NULL is fine. */
void springs_text_let(struct springs_text *text);

/* Finds the axes of the face, which is NULL or variable, and their rows: SPRINGS_AXES_ROWS at
 * most. Returns how many. */
enum { SPRINGS_AXES_ROWS = 2 * STAGE_AXES_MAX };
int springs_axes_find(struct springs *s, struct font_face *face, struct control *rows);

/* Finds whose corners the masses are. Errors: NO_MEMORY. */
enum stage_status springs_strains_make(struct springs_text *text, int masses_count);
/* Finds the letters' strains where an axis is led by them; false: none is. */
bool springs_strains_find(const struct springs *s);
/* Gives the letter the axes that its strain leads to; springs_strains_find() was true. */
void springs_letter_lead(const struct springs *s, struct stage_springs_letter *letter);

enum stage_status springs_text_set(void *actor, const char *words);
bool springs_event(void *actor, const struct stage_event *event);
enum stage_status springs_save(void *actor, const char *path);
enum stage_status springs_load(void *actor, const char *path);
uint64_t springs_digest(void *actor);
void springs_draw(void *actor, const struct stage_look *look, struct stage_draw_list *list);

/* A mass's place, extrapolated by that many seconds from the last step. */
struct font_point springs_place(const struct springs *s, int mass, double ahead_s);

/* After a step: adds keys of what the hand holds, thirty a second. */
enum dyn_status springs_record(struct springs *s);

/* Converts dynamics's error to the stage's. */
enum stage_status springs_fail(enum dyn_status status);

#endif
