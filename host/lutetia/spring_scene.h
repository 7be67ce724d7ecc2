/* spring_scene.h - what `lutetia spring` puts on its stage: a word, or a network from a file.
 *
 *     struct spring_scene_def def = spring_scene_def_default();
 *     def.text = "breakdown";
 *     def.preset = "breakdown";
 *     struct spring_scene scene;
 *     if (spring_scene_make(&def, &scene) != STAGE_OK)
 *         die(stage_error());
 *     ...scene.stage...
 *     spring_scene_finish(&scene); */
#ifndef LUTETIA_SPRING_SCENE_H
#define LUTETIA_SPRING_SCENE_H

#include <face.h>
#include <stage.h>
#include <text.h>

struct spring_scene_def {
    bool forgets;        /* no session will be saved */
    const char *text;    /* UTF-8; or */
    const char *network; /* a file of masses and springs */
    const char *font;    /* as font_face_open() has it */
    const char *preset;  /* NULL: none */
    const char *script;  /* a file of clamps that lead masses; NULL: none */
    const char *theme;
    /* NAME=VALUE: controls of the stage, the word's style, the world; after the preset */
    const char *const *sets;
    int sets_count;
    /* where the baseline begins, in ems; the floor is at 0; at[1] is NaN: as high as the text
     * needs */
    double at[2];
    double turn;   /* degrees, to the left, round there */
    double column; /* lines are broken for so many ems; 0: only where the text has line ends */
    /* the baseline goes round a circle of that radius, over the place; 0: it is straight */
    double circle;
    /* x0, y0, x1, y1: the part of the world that is seen; x0 is NaN: around what there is */
    double view[4];
};
struct spring_scene_def spring_scene_def_default(void);

struct spring_scene {
    struct stage *stage;
    struct font_face *face;
    struct font_shaper *shaper;
    struct spring_scene_def def; /* for other words in place of its own */
};

/* *out stays where it is as long as the stage lives, and what def points to stays, too: the
 * words may be changed by stage_text(). Errors: BAD_ARGUMENT (a preset, a control or a number
 * that cannot be), those of fonts and files; *out is then zeros. */
enum stage_status spring_scene_make(const struct spring_scene_def *def,
                                    struct spring_scene *out);
void spring_scene_finish(struct spring_scene *scene);

#endif
