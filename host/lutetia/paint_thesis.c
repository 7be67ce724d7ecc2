/* paint_thesis.c - `lutetia paint --model thesis`: a sheet after the thesis, in cyan, magenta
 * and yellow. */
#include "verb_paint.h"

#include <string.h>

static enum paper_status paint_apply(const struct paint *paint, struct paper *sheet)
{
    struct paper_ink ink = {paint->ink[0], paint->ink[1], paint->ink[2], paint->water};
    enum paper_status status = paper_rectangle(sheet, 0, 0, paint->size[0], paint->size[1],
                                               &(struct paper_ink){.water = paint->wet});
    for (int i = 0; i < paint->pools.count && status == PAPER_OK; i++) {
        const double *pool = paint->pools.numbers[i];
        status = paper_rectangle(sheet, (int)pool[0], (int)pool[1], (int)pool[2], (int)pool[3],
                                 &(struct paper_ink){.water = pool[4] / 100});
    }
    if (status == PAPER_OK)
        status = paper_screen_ink(sheet, &paint->screen,
                                  (paint->size[0] - paint->screen.width_px) / 2,
                                  (paint->size[1] - paint->screen.height_px) / 2, &ink);
    return status;
}

static int paint_run(const struct paint *paint, struct paper *sheet)
{
    enum paper_view view =
        strcmp(paint->view, "water") == 0 ? PAPER_VIEW_WATER : PAPER_VIEW_COLOR;
    struct paper_weather weather = {
        .gravity_x = paint->gravity_x,
        .gravity_y = paint->gravity,
        .humidity = paint->humidity,
        .molecular_weight = {paint->weights[0], paint->weights[1], paint->weights[2]}};
    int status = EXIT_SUCCESS;
    if (paint_apply(paint, sheet) != PAPER_OK || paper_finish(sheet) != PAPER_OK)
        status = fail_paper("paint");
    struct progress progress = progress_begin("painting", paint->steps);
    for (int step = 0; step <= paint->steps && status == EXIT_SUCCESS; step++) {
        if (interrupted())
            break;
        char path[PAINT_PATH_MAX];
        if (paint->frames_dir && step % paint->every == 0) {
            status = paint_frames_path(paint, step, path);
            status = status == EXIT_SUCCESS ? sheet_write("paint", sheet, view, path) : status;
        }
        if (step == paint->steps || status != EXIT_SUCCESS)
            break;
        if (paper_disperse(sheet, &weather) != PAPER_OK ||
            ((step + 1) % STEPS_AT_ONCE == 0 && paper_finish(sheet) != PAPER_OK))
            status = fail_paper("paint");
        if ((step + 1) % STEPS_AT_ONCE == 0)
            progress_show(&progress, step + 1);
    }
    progress_end(&progress);
    if (interrupted())
        return EXIT_INTERRUPTED;
    return status == EXIT_SUCCESS ? sheet_write("paint", sheet, view, paint->out_path) : status;
}

int paint_thesis(const struct paint *paint)
{
    struct paper_config config = paper_config_default();
    struct paper *sheet;
    config.width = paint->size[0];
    config.height = paint->size[1];
    config.seed = (uint64_t)paint->seed;
    config.absorbency = paint->absorbency;
    const int ready = machine_prepare("paint", config.width, config.height,
                                      page_bytes(config.width, config.height));
    if (ready != EXIT_SUCCESS)
        return ready;
    if (paper_create(&config, &sheet) != PAPER_OK)
        return fail_paper("paint");
    const int status = paint_run(paint, sheet);
    paper_destroy(sheet);
    return status;
}
