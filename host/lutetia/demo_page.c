/* demo_page.c - the demonstration page.
 *
 *     a town in a marsh ...          crisp: the sheet is dry there
 *
 *      Lu te tia                     wet letters on dry paper, each syllable in an ink of its
 *                                    own
 *     ~~~~~~~~~~~~~~~~  waterline
 *      (reflected)                   bleeding, the deeper the longer
 *
 * Lutetia was a town in a marsh.  The word stands on the water's edge. Its mirror image is
 * screened into the wet half in DEMO_BANDS bands, one after the other, the deepest first.
 * Water stands in that half: it carries the inks, mixes those that meet, and leaves dark edges
 * where it dries.
 */
#include "demo_page.h"
#include "demo_scenery.h"
#include "lutetia.h"

#include <face.h>
#include <techniques.h>

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
/* Three, since a step's time grows with them; reeds are blue and yellow. */
static const char *const pigments[] = {"french ultramarine", "quinacridone rose",
                                       "hansa yellow"};
enum { PIGMENTS = sizeof pigments / sizeof *pigments };

/* Amounts of water, and of each pigment. */
struct ink {
    double amount[1 + PAPER_PIGMENTS_MAX];
};
static const struct ink inks[SYLLABLES] = {
    {{0, 1.6, 0.12, 0}},   /* indigo */
    {{0, 0.15, 1.4, 0}},   /* madder */
    {{0, 0.02, 0.3, 1.4}}, /* ochre */
};
static const struct ink caption_ink = {{0, 1.2, 0.3, 0.1}};

/* The letters' water: strong colour spreads in it. */
static const double letters_water = 0.35;
/* A reflection is a little paler than the letters, and its ink brings water. */
static const double reflection_strength = 0.7, reflection_water = 0.5;
/* Steps from one band to the next; all bands take four fifths of the time. */
enum { BAND_STEPS = DEMO_MOMENT };

static const struct {
    enum demo_mask_kind kind;
    struct ink ink;
} marsh[] = {
    {DEMO_WATER, {{0.7}}},
    {DEMO_DEEP, {{0, 0.3, 0, 0.05}}},
    {DEMO_CLAY, {{0, 0, 0.12, 0.08}}},
    {DEMO_REED, {{0, 0.12, 0, 0.3}}},
};

struct demo_page {
    struct demo_letter letters[LETTERS];
    struct demo_letter caption;
};

struct paper_sheet_config demo_page_config(void)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = DEMO_WIDTH;
    config.height = DEMO_HEIGHT;
    config.pigments_count = PIGMENTS;
    config.deckled = true;
    for (int i = 0; i < PIGMENTS; i++)
        config.pigments[i] = *paper_pigment_find(pigments[i]);
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

static enum paper_status letter_screen(struct paper_sheet *sheet,
                                       const struct demo_letter *letter, const struct ink *ink)
{
    return paper_sheet_put(sheet, &letter->screen, letter->x_px, letter->y_px, ink->amount);
}

/* A syllable is one screen, so that drops of strong colour fall over it as a whole: first a
 * thin wash, then the drops. */
static enum paper_status syllable_put(const struct demo_page *page, struct paper_sheet *sheet,
                                      int syllable)
{
    struct paper_screen screen = {.width_px = DEMO_WIDTH, .height_px = DEMO_HEIGHT};
    struct ink ink = inks[syllable];
    screen.gray = calloc((size_t)DEMO_WIDTH, DEMO_HEIGHT);
    if (!screen.gray)
        return PAPER_NO_MEMORY;
    for (int i = 0; i < LETTERS; i++)
        if (syllable_of[i] == syllable)
            demo_letter_blend(&page->letters[i], &screen);
    ink.amount[0] = letters_water;
    enum paper_status status =
        paper_sheet_put_charged(sheet, &screen, 0, 0, ink.amount, word_size_px);
    paper_screen_destroy(&screen);
    return status;
}

enum paper_status demo_page_begin(struct demo_page *page, struct paper_sheet *sheet)
{
    const struct demo_mask mask = {DEMO_WIDTH, DEMO_HEIGHT, WATERLINE_PX};
    enum paper_status status = PAPER_OK;
    for (size_t i = 0; i < sizeof marsh / sizeof *marsh && status == PAPER_OK; i++) {
        struct paper_screen screen;
        if (!demo_mask_screen(&mask, marsh[i].kind, &screen))
            return PAPER_NO_MEMORY;
        status = paper_sheet_put(sheet, &screen, 0, 0, marsh[i].ink.amount);
        paper_screen_destroy(&screen);
    }
    for (int i = 0; i < SYLLABLES && status == PAPER_OK; i++)
        status = syllable_put(page, sheet, i);
    if (status == PAPER_OK)
        status = letter_screen(sheet, &page->caption, &caption_ink);
    return status == PAPER_OK ? paper_sheet_finish(sheet) : status;
}

static enum paper_status reflection_screen(struct demo_page *page, struct paper_sheet *sheet,
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
        struct ink ink = {{reflection_water}};
        for (int i = 1; i <= PIGMENTS; i++)
            ink.amount[i] = inks[syllable].amount[i] * reflection_strength;
        status = paper_sheet_put(sheet, &screen, 0, 0, ink.amount);
        if (status == PAPER_OK)
            status = paper_sheet_finish(sheet);
    }
    paper_screen_destroy(&screen);
    return status;
}

enum paper_status demo_page_step(struct demo_page *page, struct paper_sheet *sheet, int step)
{
    enum paper_status status = PAPER_OK;
    if (step % BAND_STEPS == 0 && step / BAND_STEPS < DEMO_BANDS)
        status = reflection_screen(page, sheet, step / BAND_STEPS);
    if (status == PAPER_OK)
        status = paper_sheet_step(sheet);
    if (status == PAPER_OK && (step + 1) % STEPS_AT_ONCE == 0)
        status = paper_sheet_finish(sheet);
    return status;
}
