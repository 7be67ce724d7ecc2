/* paper_scene.h - the same wet sheet, in Paris and in plain C.
 *
 *     struct paper_scene scene;
 *     if (!paper_scene_init(&scene, 1024, 1024, 6, false, NULL))
 *         ...bench_error()
 *     paper_sheet_step(scene.sheet);
 *     paper_openmp_steps(scene.peer, 1);
 *     bool same = paper_scene_agrees(&scene, "1024x1024");
 *     paper_scene_finish(&scene);
 *
 * A sheet of cold press with washes of all pigments, half dry. The thesis's scene is the sheet
 * without parts with cyan, magenta and yellow, beside diffusion_openmp_* of scene.h. Errors.
 * false, and bench_error() says why. */
#ifndef LUTETIA_BENCH_PAPER_SCENE_H
#define LUTETIA_BENCH_PAPER_SCENE_H

#include "paper_peer.h"
#include "scene.h"

struct paper_scene {
    struct paper_sheet *sheet;
    struct paper_openmp *peer;       /* NULL: the thesis's */
    struct diffusion_openmp *thesis; /* NULL: the full rule */
    int width, height, pigments_count;
};

/* air: NULL: the default. */
bool paper_scene_init(struct paper_scene *s, int width, int height, int pigments_count,
                      bool torus, const struct paper_air *air);
bool paper_scene_init_thesis(struct paper_scene *s, int width, int height);
/* All amounts, bit by bit. */
bool paper_scene_agrees(const struct paper_scene *s, const char *of_case);
void paper_scene_finish(struct paper_scene *s); /* of one that is all 0, too */

#endif
