/* demo_page.c - the demonstration page.
 *
 *     a town in a marsh ...          crisp: the sheet is dry there
 *
 *      Lu te tia                     crisp, each syllable in an ink of its own
 *     ~~~~~~~~~~~~~~~~  waterline
 *      (reflected)                   bleeding, the deeper the longer
 *
 * Lutetia was a town in a marsh.  The word stands on the water's edge. Its mirror image is
 * screened into the wet half in DEMO_BANDS bands, one after the other, the deepest first.
 * The light pigment of each ink moves furthest: cyan around the indigo, yellow around the
 * ochre.
 */
#include "demo_page.h"
#include "demo_scenery.h"
#include "lutetia.h"

#include <face.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WORD "Lutetia"
#define CAPTION "a town in a marsh, in ink on wet paper"

enum {
    LETTERS = sizeof WORD - 1,
    SYLLABLES = 3,
    WATERLINE_PX = 640,
    CAPTION_BASELINE_PX = 147
};

static const double word_size_px = 472, caption_size_px = 34, caption_tracking_em = 0.01;

static const char *const word_fonts[] = {"EBGaramond12-Regular", "LinLibertine_R",
                                         "DejaVuSerif", NULL};
static const char *const caption_fonts[] = {"EBGaramond12-Italic", "LinLibertine_RI",
                                            "DejaVuSerif-Italic", "DejaVuSerif", NULL};

static const int syllable_of[LETTERS] = {0, 0, 1, 1, 2, 2, 2};
static const struct paper_ink inks[SYLLABLES] = {
    {.cyan = 0.94, .magenta = 0.80, .yellow = 0.36}, /* indigo */
    {.cyan = 0.36, .magenta = 0.93, .yellow = 0.50}, /* madder */
    {.cyan = 0.15, .magenta = 0.50, .yellow = 0.93}, /* ochre */
};
static const struct paper_ink caption_ink = {.cyan = 0.82, .magenta = 0.76, .yellow = 0.48};

/* A reflection is a little paler than the letters, and its ink brings water. */
static const double reflection_strength = 0.95, reflection_water = 0.6;
/* Steps from one band to the next; all bands take four fifths of the time. */
enum { BAND_STEPS = 5 * DEMO_MOMENT };

static const struct {
    enum demo_mask_kind kind;
    struct paper_ink ink;
} marsh[] = {
    {DEMO_WATER, {.water = 1}},
    {DEMO_DEEP, {.cyan = 0.27, .magenta = 0.15, .yellow = 0.09}},
    {DEMO_CLAY, {.cyan = 0.05, .magenta = 0.13, .yellow = 0.13}},
    {DEMO_REED, {.cyan = 0.12, .magenta = 0.06, .yellow = 0.16}},
};

struct demo_page {
    struct demo_letter letters[LETTERS];
    struct demo_letter caption;
    struct paper_weather weather;
};

struct paper_config demo_page_config(void)
{
    struct paper_config config = paper_config_default();
    config.width = DEMO_WIDTH;
    config.height = DEMO_HEIGHT;
    config.absorbency = 0.22;
    config.absorbency_variation = 0.5;
    return config;
}

/* The length of the line's first `count` letters, kerned. */
static enum paper_status advance_of(const struct paper_line *line, int count,
                                    double *advance_px)
{
    char text[sizeof WORD] = WORD;
    text[count] = '\0';
    struct paper_line part = *line;
    part.text = text;
    struct paper_screen screen;
    enum paper_status status = paper_line_screen(&part, &screen, NULL);
    *advance_px = screen.advance_px;
    paper_screen_destroy(&screen);
    return status;
}

/* Draws each letter of the word on its own screen, at its place in the line. */
static enum paper_status word_set(struct demo_page *page)
{
    /* Letters are set one by one: none may join. */
    struct paper_line line = {.font = font_face_first(word_fonts),
                              .size_px = word_size_px,
                              .features = "-liga,-clig,-calt"};
    double length_px, advance_px;
    enum paper_status status = advance_of(&line, LETTERS, &length_px);
    for (int i = 0; i < LETTERS && status == PAPER_OK; i++) {
        struct demo_letter *letter = &page->letters[i];
        char text[2] = {WORD[i], '\0'};
        struct paper_line one = line;
        one.text = text;
        status = advance_of(&line, i + 1, &advance_px);
        if (status == PAPER_OK)
            status = paper_line_screen(&one, &letter->screen, NULL);
        double begin_px = (DEMO_WIDTH - length_px) / 2 + advance_px - letter->screen.advance_px;
        letter->x_px = (int)lround(begin_px) - letter->screen.origin_x_px;
        letter->y_px = WATERLINE_PX - letter->screen.baseline_y_px;
    }
    return status;
}

/* The caption's left edge is that of the first letter's ink. */
static enum paper_status caption_set(struct demo_page *page)
{
    struct paper_line line = {.text = CAPTION,
                              .font = font_face_first(caption_fonts),
                              .size_px = caption_size_px,
                              .tracking_em = caption_tracking_em};
    enum paper_status status = paper_line_screen(&line, &page->caption.screen, NULL);
    page->caption.x_px = page->letters[0].x_px;
    page->caption.y_px = CAPTION_BASELINE_PX - page->caption.screen.baseline_y_px;
    return status;
}

enum paper_status demo_page_create(struct demo_page **out)
{
    *out = NULL;
    struct demo_page *page = calloc(1, sizeof *page);
    if (!page)
        return PAPER_NO_MEMORY;
    page->weather = (struct paper_weather){.gravity_x = 1,
                                           .gravity_y = 1.3,
                                           .humidity = 0.0003,
                                           .molecular_weight = {1, 0.25, 0.6}};
    enum paper_status status = word_set(page);
    if (status == PAPER_OK)
        status = caption_set(page);
    if (status != PAPER_OK) {
        demo_page_destroy(page);
        return status;
    }
    *out = page;
    return PAPER_OK;
}

void demo_page_destroy(struct demo_page *page)
{
    if (!page)
        return;
    for (int i = 0; i < LETTERS; i++)
        paper_screen_destroy(&page->letters[i].screen);
    paper_screen_destroy(&page->caption.screen);
    free(page);
}

static enum paper_status letter_screen(struct paper *sheet, const struct demo_letter *letter,
                                       const struct paper_ink *ink)
{
    return paper_screen_ink(sheet, &letter->screen, letter->x_px, letter->y_px, ink);
}

enum paper_status demo_page_begin(struct demo_page *page, struct paper *sheet)
{
    const struct demo_mask mask = {DEMO_WIDTH, DEMO_HEIGHT, WATERLINE_PX};
    enum paper_status status = PAPER_OK;
    for (size_t i = 0; i < sizeof marsh / sizeof *marsh && status == PAPER_OK; i++) {
        struct paper_screen screen;
        if (!demo_mask_screen(&mask, marsh[i].kind, &screen))
            return PAPER_NO_MEMORY;
        status = paper_screen_ink(sheet, &screen, 0, 0, &marsh[i].ink);
        paper_screen_destroy(&screen);
    }
    for (int i = 0; i < LETTERS && status == PAPER_OK; i++)
        status = letter_screen(sheet, &page->letters[i], &inks[syllable_of[i]]);
    if (status == PAPER_OK)
        status = letter_screen(sheet, &page->caption, &caption_ink);
    return status == PAPER_OK ? paper_finish(sheet) : status;
}

static enum paper_status reflection_screen(struct demo_page *page, struct paper *sheet,
                                           int band)
{
    struct paper_screen screen = {.width_px = DEMO_WIDTH, .height_px = DEMO_HEIGHT};
    enum paper_status status = PAPER_OK;
    screen.gray = malloc((size_t)DEMO_WIDTH * DEMO_HEIGHT);
    if (!screen.gray)
        return PAPER_NO_MEMORY;
    for (int syllable = 0; syllable < SYLLABLES && status == PAPER_OK; syllable++) {
        memset(screen.gray, 0, (size_t)DEMO_WIDTH * DEMO_HEIGHT);
        for (int i = 0; i < LETTERS; i++)
            if (syllable_of[i] == syllable)
                demo_reflection_blend(&page->letters[i], band, &screen);
        struct paper_ink ink = {.cyan = inks[syllable].cyan * reflection_strength,
                                .magenta = inks[syllable].magenta * reflection_strength,
                                .yellow = inks[syllable].yellow * reflection_strength,
                                .water = reflection_water};
        status = paper_screen_ink(sheet, &screen, 0, 0, &ink);
        if (status == PAPER_OK)
            status = paper_finish(sheet);
    }
    paper_screen_destroy(&screen);
    return status;
}

enum paper_status demo_page_step(struct demo_page *page, struct paper *sheet, int step)
{
    enum paper_status status = PAPER_OK;
    if (step % BAND_STEPS == 0 && step / BAND_STEPS < DEMO_BANDS)
        status = reflection_screen(page, sheet, step / BAND_STEPS);
    if (status == PAPER_OK)
        status = paper_disperse(sheet, &page->weather);
    if (status == PAPER_OK && (step + 1) % STEPS_AT_ONCE == 0)
        status = paper_finish(sheet);
    return status;
}
