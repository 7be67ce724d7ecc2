/* paint_sheet.c - `lutetia paint`: a sheet with layers, on which water flows. */
#include "sheet_picture.h"
#include "verb_paint.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <techniques.h>

#define AMOUNT_USUAL 0.5 /* of a pigment that is named alone */

/* NAME=AMOUNT */
static int pigment_add(const char *text, struct paper_sheet_config *config, double *amount)
{
    char name[PAPER_NAME_MAX], known[PAPER_PIGMENT_NAMES_ROOM], *end = NULL;
    const char *equals = strchr(text, '=');
    const size_t length = equals ? (size_t)(equals - text) : strlen(text);
    snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : 0), text);
    const struct paper_pigment *pigment = paper_pigment_find(name);
    if (!pigment) {
        paper_pigment_names(known, sizeof known);
        return fail_usage("paint", "--pigment: there is no '%.*s'; there are %s",
                          (int)(length < 60 ? length : 60), text, known);
    }
    const double value = equals ? strtod(equals + 1, &end) : AMOUNT_USUAL;
    if (equals && (end == equals + 1 || *end || !(fabs(value) <= 4)))
        return fail_usage("paint", "--pigment: an amount must be -4..4 (got '%.60s')", text);
    for (int i = 0; i < config->pigments_count; i++)
        if (strcmp(config->pigments[i].name, pigment->name) == 0)
            return fail_usage("paint", "--pigment: %s is there twice", pigment->name);
    if (config->pigments_count == PAPER_PIGMENTS_MAX)
        return fail_usage("paint", "--pigment: there are at most %d", PAPER_PIGMENTS_MAX);
    amount[1 + config->pigments_count] = value;
    config->pigments[config->pigments_count++] = *pigment;
    return EXIT_SUCCESS;
}

static int pigments_add(const struct paint *paint, struct paper_sheet_config *config,
                        double *amount)
{
    static const char *const inks[] = {"cyan", "magenta", "yellow"};
    static const char usual[] = PAPER_PIGMENT_USUAL "=1.2";
    int status = EXIT_SUCCESS;
    for (int i = 0; i < 3 && !isnan(paint->ink[0]) && status == EXIT_SUCCESS; i++) {
        status = pigment_add(inks[i], config, amount);
        amount[1 + i] = paint->ink[i];
    }
    for (int i = 0; i < paint->pigments.count && status == EXIT_SUCCESS; i++)
        status = pigment_add(paint->pigments.texts[i], config, amount);
    return status == EXIT_SUCCESS && !config->pigments_count
               ? pigment_add(usual, config, amount)
               : status;
}

int paint_sheet_config(const struct paint *paint, struct paper_sheet_config *config,
                       double amount[1 + PAPER_PIGMENTS_MAX])
{
    char known[200];
    *config = paper_sheet_config_default();
    memset(amount, 0, sizeof *amount * (1 + PAPER_PIGMENTS_MAX));
    amount[0] = paint->water;
    config->width = paint->size[0];
    config->height = paint->size[1];
    config->seed = (uint64_t)paint->seed;
    config->deckled = paint->deckled;
    const struct paper_stock *stock =
        paint->stock ? paper_stock_find(paint->stock) : &config->stock;
    if (!stock) {
        paper_stock_names(known, sizeof known);
        return fail_usage("paint", "there is no paper stock '%.40s'; there are %s",
                          paint->stock, known);
    }
    config->stock = *stock;
    return pigments_add(paint, config, amount);
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

static enum paper_status all_put(const struct paint *paint, struct paper_sheet *sheet,
                                 const double *amount)
{
    struct paper_air air = paper_air_default();
    const double wet[1 + PAPER_PIGMENTS_MAX] = {paint->wet};
    air.gravity[0] = paint->gravity_x;
    air.gravity[1] = paint->gravity;
    air.humidity = paint->humidity;
    enum paper_status status = paper_sheet_air(sheet, &air);
    if (status == PAPER_OK && paint->wet > 0)
        status = paper_sheet_put(sheet, NULL, 0, 0, wet);
    for (int i = 0; i < paint->pools.count && status == PAPER_OK; i++)
        status = pool_put(paint, sheet, paint->pools.numbers[i]);
    const int x = (paint->size[0] - paint->screen.width_px) / 2,
              y = (paint->size[1] - paint->screen.height_px) / 2;
    const bool usual =
        isnan(paint->ink[0]) && paint->pigments.count == 0; /* no amount was named */
    if (status == PAPER_OK && usual && paint->letter_px > 0)
        status = paper_sheet_put_charged(sheet, &paint->screen, x, y, amount, paint->letter_px);
    else if (status == PAPER_OK)
        status = paper_sheet_put(sheet, &paint->screen, x, y, amount);
    return status == PAPER_OK ? paper_sheet_finish(sheet) : status;
}

static int sheet_run(const struct paint *paint, struct paper_sheet *sheet, const double *amount)
{
    int status = all_put(paint, sheet, amount) == PAPER_OK ? EXIT_SUCCESS : fail_paper("paint");
    const struct paper_sheet_view view = {
        .show = strcmp(paint->view, "water") == 0 ? PAPER_SHOW_WATER
                : strcmp(paint->view, "wet") == 0 ? PAPER_SHOW_WET
                                                  : PAPER_SHOW_COLOR,
        .high = 1,
        .light = paint->light,
        .ground = isnan(paint->ground[0]) ? NULL : paint->ground};
    struct progress progress = progress_begin("painting", paint->steps);
    for (int step = 0; step <= paint->steps && status == EXIT_SUCCESS; step++) {
        char path[PAINT_PATH_MAX];
        if (interrupted())
            break;
        if (paint->frames_dir && step % paint->every == 0) {
            status = paint_frames_path(paint, step, path);
            status = status == EXIT_SUCCESS ? sheet_picture_write("paint", sheet, &view, path)
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
    return status == EXIT_SUCCESS ? sheet_picture_write("paint", sheet, &view, paint->out_path)
                                  : status;
}

int paint_sheet(const struct paint *paint)
{
    struct paper_sheet *sheet = NULL;
    struct paper_sheet_config config;
    double amount[1 + PAPER_PIGMENTS_MAX];
    int status = paint_sheet_config(paint, &config, amount);
    if (status == EXIT_SUCCESS)
        status = machine_prepare(
            "paint", config.width, config.height,
            paper_sheet_bytes(config.width, config.height, config.pigments_count));
    if (status == EXIT_SUCCESS)
        status = paper_sheet_create(&config, &sheet) == PAPER_OK
                     ? sheet_run(paint, sheet, amount)
                     : fail_paper("paint");
    paper_sheet_destroy(sheet);
    return status;
}
