/* keys_picture.c - see keys_picture.h. */
#include "keys_picture_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double FILL = 0.94; /* the part of a picture's width for letters */
static const double OVERLAP =
    2.6; /* the largest ratio of a letter's width to its share: not all keys sound at once */
static const double LETTER_HIGH = 0.9; /* of the em, from the foot of a g to the head of an h */

struct keys_type_def keys_type_def_default(void)
{
    return (struct keys_type_def){
        .filter = "box",
        .size_px = {0, 300},
        .step_px = 12,
        /* each has a contrast of 4.5 to white at the least (WCAG AA) */
        .inks = {{0, 0, 0},
                 {0.72, 0.11, 0.07},
                 {0.05, 0.2, 0.55},
                 {0.1, 0.42, 0.2},
                 {0.68, 0.33, 0},
                 {0.45, 0.15, 0.55},
                 {0, 0.42, 0.48},
                 {0.45, 0.27, 0.13},
                 {0.75, 0.15, 0.45},
                 {0.35, 0.38, 0.02},
                 {0.15, 0.42, 0.78},
                 {0.4, 0, 0.12},
                 {0.4, 0.4, 0.4},
                 {0.8, 0.26, 0.2},
                 {0, 0.25, 0.23},
                 {0.45, 0.35, 0.75}},
        .paper = {1, 1, 1}};
}

enum font_status keys_type_create(const struct keys_type_def *def, struct font_face *face,
                                  const struct keys_score *score,
                                  const struct keys_letters *letters, struct keys_type **out)
{
    struct keys_type *t = calloc(1, sizeof *t);
    *out = NULL;
    if (!t)
        return FONT_NO_MEMORY;
    t->def = *def;
    t->score = score;
    t->letters = letters;
    enum font_status status = font_shaper_create(face, &t->shaper);
    for (int i = 0; i < KEYS_INKS && status == FONT_OK; i++) {
        struct font_painter_def painter = font_painter_def_default();
        painter.filter = def->filter;
        memcpy(painter.ink, def->inks[i], sizeof painter.ink);
        status = font_painter_create(&painter, &t->painters[i]);
    }
    if (status != FONT_OK) {
        keys_type_destroy(t);
        return status;
    }
    *out = t;
    return FONT_OK;
}

void keys_type_destroy(struct keys_type *t)
{
    if (!t)
        return;
    for (int i = 0; i < KEYS_INKS; i++)
        font_painter_destroy(t->painters[i]);
    font_shaper_destroy(t->shaper);
    free(t);
}

void keys_type_paper(const struct keys_type *t, struct font_picture *picture)
{
    uint8_t paper[3];
    for (int c = 0; c < 3; c++)
        paper[c] = (uint8_t)lround(255 * t->def.paper[c]);
    for (int y = 0; y < picture->height_px; y++)
        for (int x = 0; x < picture->width_px; x++)
            memcpy(picture->rgb + (size_t)y * (size_t)picture->pitch + 3 * (size_t)x, paper, 3);
}

double keys_type_size(const struct keys_type *t, double level)
{
    return t->def.size_px[0] + (t->def.size_px[1] - t->def.size_px[0]) * level;
}

enum font_status keys_type_shape(struct keys_type *t, int key, double size_px,
                                 struct font_layout *out)
{
    const char *letter = t->letters->of[key];
    *out = (struct font_layout){0};
    return letter[0] ? font_shaper_layout(t->shaper, letter, strlen(letter), size_px, NULL, out)
                     : FONT_OK;
}

/* Draws a key's letter at a level, with its middle at x, or as near to it as is entirely
 * visible. */
static enum font_status letter_draw(struct keys_type *t, int key, int channel, double level,
                                    double x, double y, struct font_picture *picture)
{
    struct font_layout layout;
    const double size = keys_type_size(t, level);
    if (size < 0.5)
        return FONT_OK;
    enum font_status status = keys_type_shape(t, key, size, &layout);
    const double half = layout.width_px / 2;
    x = fmax(half, fmin(x, picture->width_px - half)) - half;
    if (status == FONT_OK)
        status =
            font_painter_layout(t->painters[channel % KEYS_INKS], &layout, NULL, x, y, picture);
    font_layout_finish(&layout);
    return status;
}

enum font_status keys_type_moment(struct keys_type *t, double time_s,
                                  struct font_picture *picture)
{
    const struct keys_score *s = t->score;
    const double part = FILL * picture->width_px / s->keys_count;
    const double left = (1 - FILL) / 2 * picture->width_px;
    /* centred: the largest letters' ascent and descent are at equal distances from the
     * middle */
    const double baseline = picture->height_px / 2.0 + 0.25 * t->def.size_px[1];
    enum font_status status = FONT_OK;
    keys_type_paper(t, picture);
    for (int i = 0; i < s->keys_count && status == FONT_OK; i++) {
        int note;
        const double level = keys_key_level(s, s->keys[i], time_s, &note);
        status = letter_draw(t, s->keys[i], note < 0 ? 0 : s->notes[note].channel, level,
                             left + (i + 0.5) * part, baseline, picture);
    }
    return status;
}

enum font_status keys_type_fit(struct font_face *face, const struct keys_score *score,
                               const struct keys_letters *letters, int width_px, int height_px,
                               double *size_px)
{
    enum { TRY_PX = 100 };
    struct font_shaper *shaper;
    double widest = 0.1;
    enum font_status status = font_shaper_create(face, &shaper);
    if (status != FONT_OK)
        return status;
    for (int i = 0; i < score->keys_count && status == FONT_OK; i++) {
        struct font_layout layout = {0};
        const char *letter = letters->of[score->keys[i]];
        if (!letter[0])
            continue;
        status = font_shaper_layout(shaper, letter, strlen(letter), TRY_PX, NULL, &layout);
        widest = status == FONT_OK ? fmax(widest, layout.width_px / TRY_PX) : widest;
        font_layout_finish(&layout);
    }
    font_shaper_destroy(shaper);
    const double part = FILL * width_px / score->keys_count;
    const double overlap = score->keys_count > 1 ? OVERLAP : 1;
    *size_px = fmin(overlap * part / widest, LETTER_HIGH * height_px);
    return status;
}
