/* spring_wet.c - see spring_wet.h. */
#include "spring_wet.h"

#include "lutetia.h"

#include <exact.h>
#include <ink.h>
#include <sheet.h>
#include <techniques.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS_A_SECOND = 120 };

/* How much of what a fiber still takes a print gives it. So letters that hang still do not
 * give more and more: all their prints together give 1 / part of one. */
static const double part = 0.3;

struct spring_wet {
    struct spring_wet_def def;
    struct paper_sheet *sheet;
    struct stage_exact *exact;
    struct stage_draw_list letters;
    struct display_image covered; /* the letters in black on white */
    uint8_t *gray;                /* how far they cover */
    uint8_t *print;               /* how far a print covers what still takes ink */
    float *given;                 /* of what a fiber takes from prints, 0..1 */
    uint16_t *view;
    long frames, printed; /* prints so far */
    uint8_t cover_of[256];
};

struct spring_wet_def spring_wet_def_default(void)
{
    return (struct spring_wet_def){
        .pigment = PAPER_PIGMENT_USUAL, .every_s = 0.1, .water = 0.3, .ink = 0.25};
}

static int pigment_unknown(const char *name)
{
    char known[PAPER_PIGMENT_NAMES_ROOM];
    paper_pigment_names(known, sizeof known);
    return fail_usage("spring", "there is no pigment '%.40s'; there are %s", name, known);
}

static int sheet_make(struct spring_wet *w)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    const struct paper_pigment *pigment = paper_pigment_find(w->def.pigment);
    if (!pigment)
        return pigment_unknown(w->def.pigment);
    config.width = w->def.width;
    config.height = w->def.height;
    config.pigments[config.pigments_count++] = *pigment;
    int status =
        machine_prepare("spring", config.width, config.height,
                        paper_sheet_bytes(config.width, config.height, config.pigments_count));
    if (status != EXIT_SUCCESS)
        return status;
    return paper_sheet_create(&config, &w->sheet) == PAPER_OK ? EXIT_SUCCESS
                                                              : fail_paper("spring");
}

int spring_wet_create(const struct spring_wet_def *def, struct spring_wet **out)
{
    const size_t count = (size_t)def->width * (size_t)def->height;
    struct spring_wet *w = calloc(1, sizeof *w);
    *out = w;
    if (!w)
        return fail("spring", "no memory for paper");
    w->def = *def;
    w->gray = malloc(count);
    w->print = malloc(count);
    w->given = calloc(count, sizeof *w->given);
    w->view = malloc(3 * count * sizeof *w->view);
    w->covered =
        (struct display_image){.width_px = def->width, .height_px = def->height, .channels = 3};
    /* light is mixed in the picture, so that what is left of it is what is not covered */
    for (int i = 0; i < 256; i++)
        w->cover_of[i] = (uint8_t)lround(255 * (1 - font_light(i / 255.0, 0)));
    if (!w->gray || !w->print || !w->given || !w->view ||
        display_image_create(&w->covered) != DISPLAY_OK)
        return fail("spring", "no memory for paper");
    if (stage_exact_create("box", &w->exact) != STAGE_OK)
        return fail("spring", "%s", stage_error());
    return sheet_make(w);
}

void spring_wet_destroy(struct spring_wet *w)
{
    if (!w)
        return;
    paper_sheet_destroy(w->sheet);
    stage_exact_destroy(w->exact);
    stage_draw_finish(&w->letters);
    display_image_destroy(&w->covered);
    free(w->gray);
    free(w->print);
    free(w->given);
    free(w->view);
    free(w);
}

/* How far the letters cover each pixel. */
static enum stage_status cover_draw(struct spring_wet *w, const struct stage_draw_list *list)
{
    static const struct stage_color black = {0, 0, 0, 1}, white = {1, 1, 1, 1};
    stage_draw_begin(&w->letters, STAGE_VIEW_PIXELS);
    stage_draw_again(&w->letters, list, 0, 0, &black, 1, true);
    enum stage_status status = stage_exact_draw(w->exact, &w->letters, white, &w->covered);
    const size_t count = (size_t)w->def.width * (size_t)w->def.height;
    for (size_t i = 0; i < count; i++)
        w->gray[i] = w->cover_of[w->covered.pixels[3 * i]];
    return status;
}

static enum paper_status letters_print(struct spring_wet *w)
{
    const struct paper_screen screen = {
        .width_px = w->def.width, .height_px = w->def.height, .gray = w->print};
    const double amount[2] = {w->def.water, w->def.ink};
    const size_t count = (size_t)w->def.width * (size_t)w->def.height;
    for (size_t i = 0; i < count; i++) {
        const double takes = w->gray[i] * (1 - (double)w->given[i]);
        w->print[i] = (uint8_t)lround(takes);
        w->given[i] += (float)(part * takes / 255);
    }
    return paper_sheet_put(w->sheet, &screen, 0, 0, amount);
}

static enum paper_status sheet_go_on(struct spring_wet *w)
{
    enum paper_status status = PAPER_OK;
    if ((double)w->frames >= (double)w->printed * w->def.every_s * w->def.fps) {
        w->printed++;
        status = letters_print(w);
    }
    const long before = w->frames * STEPS_A_SECOND / w->def.fps;
    w->frames++;
    for (long i = before; i < w->frames * STEPS_A_SECOND / w->def.fps && status == PAPER_OK;
         i++)
        status = paper_sheet_step(w->sheet);
    const struct paper_sheet_view view = {.show = PAPER_SHOW_WET, .high = 1};
    return status == PAPER_OK ? paper_sheet_view(w->sheet, &view, w->view) : status;
}

enum stage_status spring_wet_picture(struct spring_wet *w, const struct stage_draw_list *list,
                                     struct display_image *image)
{
    enum stage_status status = cover_draw(w, list);
    if (status != STAGE_OK)
        return status;
    if (sheet_go_on(w) != PAPER_OK)
        return stage_fail(STAGE_FAILED, "%s", paper_error());
    const size_t count = (size_t)w->def.width * (size_t)w->def.height;
    for (size_t i = 0; i < 3 * count; i++) {
        const double paper = w->view[i] / 65535.0, left = 1 - w->gray[i / 3] / 255.0;
        const double seen =
            w->gray[i / 3] ? font_number(left * font_light(paper, 0), 0) : paper;
        image->pixels[i] = (uint8_t)lround(255 * fmin(1, fmax(0, seen)));
    }
    return STAGE_OK;
}
