/* spring_scene.h - what `lutetia spring` puts on its stage: a network from a file. */
#ifndef LUTETIA_SPRING_SCENE_H
#define LUTETIA_SPRING_SCENE_H

#include <stage.h>

struct spring_scene_def {
    const char *network; /* a file of masses and springs */
    const char *theme;
    double view
        [4]; /* x0, y0, x1, y1: the part of the world that is seen; zeros: around what there is */
};

struct spring_scene {
    struct stage *stage;
};

/* Errors: those of what it is made of; *out is then zeros. */
enum stage_status spring_scene_make(const struct spring_scene_def *def,
                                    struct spring_scene *out);
void spring_scene_finish(struct spring_scene *scene);

#endif
