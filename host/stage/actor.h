/* actor.h - the object on a stage, which moves, is drawn, and reacts to input.
 *
 * An actor is a struct of its module and a table of functions. It has a world with its own
 * units, and knows no window: a stage passes it steps of time, places in the world, and a list
 * to draw into. Everything adjustable is in its table of controls. Its whole state is copied by
 * keep(), so that undo, reset and replay need nothing else.
 *
 * Functions that the actor does not need are NULL. Threads. An actor belongs to its stage's
 * thread.
 */
#ifndef LUTETIA_STAGE_ACTOR_H
#define LUTETIA_STAGE_ACTOR_H

#include "control_table.h"
#include "draw_list.h"
#include "theme.h"

#include <stdbool.h>
#include <stdint.h>

/* How a picture of the actor is drawn. */
struct stage_look {
    const struct stage_theme *theme;
    struct stage_view view;
    int width_px, height_px;
    double px; /* pixels for each pixel of a 96 dpi screen: sizes of the theme are multiplied by
             * it */
    double fraction; /* the part of a step since the last one, 0..1: places may be extrapolated
                   * by it */
    double step_s;   /* the length of that step */
};

enum stage_event_kind {
    STAGE_POINTER_DOWN,
    STAGE_POINTER_MOVE, /* with a button held */
    STAGE_POINTER_UP,
    STAGE_POINTER_CANCEL /* the window lost the pointer: release everything */
};

/* An action of the pointer, in the world. */
struct stage_event {
    enum stage_event_kind kind;
    double x, y;        /* the pointer */
    double near;        /* the distance at which something is still touched: some pixels, in the
                  * world's units */
    double pressure;    /* of a pen, 0..1; 0 if there is none */
    int button;         /* as input.h has it */
    unsigned modifiers; /* as input.h has them */
};

/* A sound of the actor, for synthesis and for scripts. */
struct stage_sound {
    const char *name; /* "clank", "click", "twang", "snap"; owned by the actor */
    double time_s;    /* of the actor */
    double strength;  /* strength; 1 is usual */
    double x, y;      /* where */
};

struct stage_actor_kind {
    const char *name;
    /* Returns the actor's controls; *count: how many. The rows stay the same as long as the
     * actor exists. */
    const struct control *(*controls)(void *actor, int *count);
    enum stage_status (*step)(void *actor, double dt_s);
    void (*draw)(void *actor, const struct stage_look *look, struct stage_draw_list *list);
    /* True: the actor took the event; then moves and the release go to it alone. */
    bool (*event)(void *actor, const struct stage_event *event);
    /* Takes what is played, between two steps: a MIDI channel message with its status byte. */
    enum stage_status (*play)(void *actor, const uint8_t *bytes);
    /* The box around the whole actor, in the world. */
    struct font_box (*extent)(void *actor);
    /* Copies everything that can change; restore() puts it back and forget() frees it.
     * Errors: NO_MEMORY; *state is then NULL. */
    enum stage_status (*keep)(void *actor, void **state);
    enum stage_status (*restore)(void *actor, const void *state);
    void (*forget)(void *state);
    /* Saves to a file, written whole or not at all; loads from a file: unchanged on failure. */
    enum stage_status (*save)(void *actor, const char *path);
    enum stage_status (*load)(void *actor, const char *path);
    /* Other words in place of those that are there. Errors: the actor is as it was. */
    enum stage_status (*text)(void *actor, const char *words);
    /* A number that differs where the words, places and files differ that it began with. */
    uint64_t (*digest)(void *actor);
    /* Takes the oldest waiting sounds, at most `most`; returns how many. */
    int (*heard)(void *actor, struct stage_sound *out, int most);
    void (*destroy)(void *actor);
    /* The name of the group that one of the actor's controls belongs to, for panels; groups
     * follow each other in the table. NULL: all belong to the actor's name. */
    const char *(*group)(void *actor, int row);
};

struct stage_actor {
    const struct stage_actor_kind *kind;
    void *self;
};

#endif
