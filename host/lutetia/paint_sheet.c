/* paint_sheet.c - `lutetia paint`: a sheet with layers, on which water flows. */
#include "sheet_picture.h"
#include "verb_paint.h"

#include <string.h>

/* Without --ink the type has one pigment; with it, the three that it names. */
#define PIGMENT_USUAL "french ultramarine"
#define PIGMENT_AMOUNT 1.2

static int sheet_make(const struct paint *paint, struct paper_sheet **out)
{
    static const char *const inks[] = {"cyan", "magenta", "yellow"};
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = paint->size[0];
    config.height = paint->size[1];
    config.seed = (uint64_t)paint->seed;
    config.stock = *paper_stock_find(paint->stock);
    config.pigments_count = paint->ink_is_given ? 3 : 1;
    for (int i = 0; i < config.pigments_count; i++)
        config.pigments[i] = *paper_pigment_find(paint->ink_is_given ? inks[i] : PIGMENT_USUAL);
    return paper_sheet_create(&config, out) == PAPER_OK ? EXIT_SUCCESS : fail_paper("paint");
}

static enum paper_status pool_put(const struct paint *paint, struct paper_sheet *sheet,
                                  const double *pool)
{
    const double left = pool[0], top = pool[1], right = left + pool[2], bottom = top + pool[3];
    const double corners[] = {left, top, right, top, right, bottom, left, bottom};
    const double amount[1 + PAPER_PIGMENTS_MAX] = {pool[4] / 100};
    struct paper_screen screen;
    int x, y;
    enum paper_status status =
        paper_polygon_screen(corners, 4, paint->size[0], paint->size[1], &screen, &x, &y);
    if (status == PAPER_OK && screen.gray)
        status = paper_sheet_put(sheet, &screen, x, y, amount);
    paper_screen_destroy(&screen);
    return status;
}

static enum paper_status all_put(const struct paint *paint, struct paper_sheet *sheet)
{
    struct paper_air air = paper_air_default();
    const double wet[1 + PAPER_PIGMENTS_MAX] = {paint->wet};
    double amount[1 + PAPER_PIGMENTS_MAX] = {paint->water, PIGMENT_AMOUNT};
    air.gravity[0] = paint->gravity_x;
    air.gravity[1] = paint->gravity;
    air.humidity = paint->humidity;
    if (paint->ink_is_given)
        memcpy(amount + 1, paint->ink, sizeof paint->ink);
    enum paper_status status = paper_sheet_air(sheet, &air);
    if (status == PAPER_OK && paint->wet > 0)
        status = paper_sheet_put(sheet, NULL, 0, 0, wet);
    for (int i = 0; i < paint->pools.count && status == PAPER_OK; i++)
        status = pool_put(paint, sheet, paint->pools.numbers[i]);
    if (status == PAPER_OK)
        status = paper_sheet_put(sheet, &paint->screen,
                                 (paint->size[0] - paint->screen.width_px) / 2,
                                 (paint->size[1] - paint->screen.height_px) / 2, amount);
    return status == PAPER_OK ? paper_sheet_finish(sheet) : status;
}

static int sheet_run(const struct paint *paint, struct paper_sheet *sheet)
{
    int status = all_put(paint, sheet) == PAPER_OK ? EXIT_SUCCESS : fail_paper("paint");
    const enum paper_show show =
        strcmp(paint->view, "water") == 0 ? PAPER_SHOW_WATER : PAPER_SHOW_COLOR;
    struct progress progress = progress_begin("painting", paint->steps);
    for (int step = 0; step <= paint->steps && status == EXIT_SUCCESS; step++) {
        char path[PAINT_PATH_MAX];
        if (interrupted())
            break;
        if (paint->frames_dir && step % paint->every == 0) {
            status = paint_frames_path(paint, step, path);
            status = status == EXIT_SUCCESS ? sheet_picture_write("paint", sheet, show, path)
                                            : status;
        }
        if (step == paint->steps || status != EXIT_SUCCESS)
            break;
        const bool wait = (step + 1) % STEPS_AT_ONCE == 0;
        if (paper_sheet_step(sheet) != PAPER_OK ||
            (wait && paper_sheet_finish(sheet) != PAPER_OK))
            status = fail_paper("paint");
        if (wait)
            progress_show(&progress, step + 1);
    }
    progress_end(&progress);
    if (interrupted())
        return EXIT_INTERRUPTED;
    return status == EXIT_SUCCESS ? sheet_picture_write("paint", sheet, show, paint->out_path)
                                  : status;
}

int paint_sheet(const struct paint *paint)
{
    struct paper_sheet *sheet = NULL;
    int status = sheet_make(paint, &sheet);
    if (status == EXIT_SUCCESS)
        status = sheet_run(paint, sheet);
    paper_sheet_destroy(sheet);
    return status;
}
