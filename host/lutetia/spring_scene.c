/* spring_scene.c - see spring_scene.h. */
#include "spring_scene.h"

#include <network_file.h>
#include <springs.h>

enum stage_status spring_scene_make(const struct spring_scene_def *def,
                                    struct spring_scene *out)
{
    struct stage_springs_def springs = stage_springs_def_default();
    struct stage_def stage = stage_def_default();
    *out = (struct spring_scene){0};
    stage.theme = def->theme;
    springs.extent = (struct font_box){def->view[0], def->view[1], def->view[2], def->view[3]};
    if (dyn_network_read(def->network, &springs.network) != DYN_OK)
        return stage_fail(STAGE_BAD_FILE, "%s", dyn_error());
    enum stage_status status = stage_springs_create(&springs, &stage.actor);
    return status == STAGE_OK ? stage_create(&stage, &out->stage) : status;
}

void spring_scene_finish(struct spring_scene *scene)
{
    stage_destroy(scene->stage);
    *scene = (struct spring_scene){0};
}
