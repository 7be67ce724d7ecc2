/* stage_internal.h - shared by stage.c and stage_picture.c. */
#ifndef LUTETIA_STAGE_INTERNAL_H
#define LUTETIA_STAGE_INTERNAL_H

#include "session_file.h"
#include "stage.h"

/* The stage's own parameters, all doubles. */
struct stage_settings {
    double rate, skins, skin_every_s, skin_of, grid, shadow;
};

/* A state to go back to; actor: made by its keep(), NULL if it has none. */
struct stage_saved {
    struct stage_settings settings;
    void *actor;
    bool kept;
};

struct stage {
    struct stage_actor actor;
    struct stage_theme theme;
    struct frame_clock clock;
    bool began, forgets;
    struct stage_settings settings;
    struct control *controls; /* the stage's and the actor's */
    int controls_count;
    const struct control *actors_rows;
    /* The view, for a size. */
    struct stage_view view;
    int width_px, height_px;
    double px;
    /* Earlier frames: a ring, the newest at skins_last. */
    struct stage_draw_list own, skins[STAGE_SKINS_MAX];
    int skins_last, skins_count;
    double skin_taken_s;
    /* States to go back to. */
    struct stage_saved marks[STAGE_UNDO_MAX], beginning;
    int marks_count;
    bool handed; /* the actor took a press that has not been released yet */
    /* The actions so far; the actions to replay, and how many have been replayed. */
    struct stage_session session, replay;
    int replayed_count;
    struct stage_session_file *session_file; /* NULL: the session is in no file meanwhile */
};

/* After a step: keeps the letters where it ends a skin's interval. */
void stage_skin_take(struct stage *s);
/* The view shows more where the actor has grown out of it. */
void stage_view_grow(struct stage *s);
/* There are no earlier moments any more. */
void stage_skins_drop(struct stage *s);

#endif
