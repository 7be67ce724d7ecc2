/* actor.h - what a stage has on it: something that moves, is drawn, and takes part in what people do.
 *
 * An actor is a struct of its module's and a table of functions. It knows the world, whose units are its own, and no window: a
 * stage hands it steps of time, places in the world, and a list to draw into. Everything adjustable about it is in its table of
 * controls; everything that it does is in the state that keep() copies, so that undo, reset and replay need nothing else.
 *
 * Functions that are NULL: the actor has no part in that.
 * Threads. An actor belongs to its stage's thread. */
#ifndef LUTETIA_STAGE_ACTOR_H
#define LUTETIA_STAGE_ACTOR_H

#include "control.h"
#include "draw_list.h"
#include "theme.h"

#include <stdbool.h>

/* How an actor is looked at. */
struct stage_look {
    const struct stage_theme *theme;
    struct stage_view view;
    int width_px, height_px;
    double
        px; /* pixels in one of a screen of 96 dpi: sizes of the theme are multiplied by it */
    double
        fraction; /* of a step that has passed since the last one, 0..1: places may be drawn so far ahead */
    double step_s; /* the length of that step */
};

enum stage_event_kind {
    STAGE_POINTER_DOWN,
    STAGE_POINTER_MOVE, /* with a button held */
    STAGE_POINTER_UP,
    STAGE_POINTER_CANCEL /* the window lost the pointer: let go of everything */
};

/* What a hand does, in the world. */
struct stage_event {
    enum stage_event_kind kind;
    double x, y; /* the pointer */
    double near; /* what is so far away is still touched: some pixels, in the world's units */
    double pressure;    /* of a pen, 0..1; 0 without one */
    int button;         /* as input.h has it */
    unsigned modifiers; /* as input.h has them */
};

/* What an actor does that is heard: for sound, and for scripts. */
struct stage_sound {
    const char *name; /* "clank", "click", "twang", "snap"; the actor's */
    double time_s;    /* of the actor */
    double strength;  /* as the actor says; 1 is usual */
    double x, y;      /* where */
};

struct stage_actor_kind {
    const char *name;
    /* Its controls; *count: how many. The same rows as long as the actor is there. */
    const struct stage_control *(*controls)(void *actor, int *count);
    enum stage_status (*step)(void *actor, double dt_s);
    void (*draw)(void *actor, const struct stage_look *look, struct stage_draw_list *list);
    /* True: it is the actor's; moves and the release of what it took are handed to it alone. */
    bool (*event)(void *actor, const struct stage_event *event);
    /* The box around all of it, in the world. */
    struct font_box (*extent)(void *actor);
    /* A copy of all that can change, which restore() puts back and forget() frees. Errors: NO_MEMORY; *state is then NULL. */
    enum stage_status (*keep)(void *actor, void **state);
    enum stage_status (*restore)(void *actor, const void *state);
    void (*forget)(void *state);
    /* A file of it, written whole or not at all; and what it is after reading one: as it was on failure. */
    enum stage_status (*save)(void *actor, const char *path);
    enum stage_status (*load)(void *actor, const char *path);
    /* The oldest that wait, at most `most`, which then wait no longer. Returns how many. */
    int (*heard)(void *actor, struct stage_sound *out, int most);
    void (*destroy)(void *actor);
};

struct stage_actor {
    const struct stage_actor_kind *kind;
    void *self;
};

#endif
