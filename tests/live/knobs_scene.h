/* knobs_scene.h - a stage with an actor that has a control of each curve and does nothing, for
 * tests of what moves controls. */
#ifndef LUTETIA_TESTS_KNOBS_SCENE_H
#define LUTETIA_TESTS_KNOBS_SCENE_H

#include <stage.h>

#include <assert.h>

enum { SCENE_CONTROLS = 4 };
static double scene_values[SCENE_CONTROLS];

static inline double scene_read(void *actor, int index)
{
    (void)actor;
    return scene_values[index];
}

static inline unsigned scene_write(void *actor, int index, double value)
{
    (void)actor;
    scene_values[index] = value;
    return STAGE_OK;
}

static inline const struct control *scene_controls(void *actor, int *count)
{
    static const struct control rows[SCENE_CONTROLS] = {
        {"height", "em", 0, 10, 5, CONTROL_LINEAR, NULL, "how high", scene_read, scene_write,
         0},
        {"weight", "kg", 1, 10000, 100, CONTROL_LOGARITHMIC, NULL, "how heavy", scene_read,
         scene_write, 1},
        {"lit", "", 0, 1, 0, CONTROL_SWITCH, NULL, "whether", scene_read, scene_write, 2},
        {"way", "", 0, 2, 0, CONTROL_CHOICE, "left right round", "where", scene_read,
         scene_write, 3}};
    (void)actor;
    *count = SCENE_CONTROLS;
    return rows;
}

static inline enum stage_status scene_step(void *actor, double dt_s)
{
    (void)actor;
    (void)dt_s;
    return STAGE_OK;
}

static inline void scene_draw(void *actor, const struct stage_look *look,
                              struct stage_draw_list *list)
{
    (void)actor;
    (void)look;
    (void)list;
}

static inline struct stage *scene_stage(void)
{
    static const struct stage_actor_kind kind = {
        .name = "scene", .controls = scene_controls, .step = scene_step, .draw = scene_draw};
    struct stage_def def = stage_def_default();
    struct stage *stage = NULL;
    int count;
    const struct control *rows = scene_controls(NULL, &count);
    for (int i = 0; i < count; i++)
        scene_values[i] = rows[i].usual;
    def.actor = (struct stage_actor){&kind, NULL};
    const enum stage_status status = stage_create(&def, &stage);
    assert(status == STAGE_OK);
    (void)status;
    return stage;
}

/* The row of a control in the stage's table. */
static inline int scene_row(struct stage *stage, const char *name)
{
    int count;
    const struct control *rows = stage_controls(stage, &count);
    return (int)(stage_control_find(rows, count, name) - rows);
}

#endif
