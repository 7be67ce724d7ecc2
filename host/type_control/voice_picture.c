/* voice_picture.c - see voice_picture.h. */
#include "voice_picture.h"

#include <edges.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SILENT_STEP_S 0.005
#define WORD_SPACE_EM 0.3

struct voice_type {
    struct voice_type_def def;
    struct font_face *face;
    const struct voice_words *words;
    const struct voice_timing *timing;
    const struct voice_score *score;
    bool to_left;
    struct font_shaper *shaper;
    struct font_painter *painter;
    struct font_axis weight, width, slant; /* tag "": the font lacks the axis */
    uint8_t *gray;                         /* of what is set at once */
    size_t gray_room;
    double light[256]; /* of sRGB numbers */
};

struct voice_type_def voice_type_def_default(void)
{
    return (struct voice_type_def){.filter = "box",
                                   .size_px = {12, 300},
                                   .rise_em = 0.6,
                                   .slant = 0.4,
                                   .paper = {1, 1, 1},
                                   .inks = {{0, 0, 0}, {0.72, 0.11, 0.07}, {0.05, 0.2, 0.55}},
                                   .silence = 0.03,
                                   .mapping = voice_mapping_default()};
}

/* ---- life ---- */

static bool axis_find(const struct font_face *face, const char *tag, struct font_axis *out)
{
    struct font_face_info info;
    font_face_describe(face, &info);
    for (int i = 0; i < info.axes_count; i++)
        if (font_face_axis(face, i, out) == FONT_OK && strcmp(out->tag, tag) == 0)
            return true;
    *out = (struct font_axis){0};
    return false;
}

enum font_status voice_type_create(const struct voice_type_def *def, struct font_face *face,
                                   const struct voice_words *words,
                                   const struct voice_timing *timing,
                                   const struct voice_score *score, struct voice_type **out)
{
    struct voice_type *t = calloc(1, sizeof *t);
    struct font_painter_def painter = font_painter_def_default();
    *out = NULL;
    if (!t)
        return FONT_NO_MEMORY;
    t->def = *def;
    t->face = face;
    t->words = words;
    t->timing = timing;
    t->to_left = voice_words_to_left(words);
    t->score = score;
    for (int i = 0; i < 256; i++)
        t->light[i] = font_light(i / 255.0, 0);
    axis_find(face, "wght", &t->weight);
    axis_find(face, "wdth", &t->width);
    axis_find(face, "slnt", &t->slant);
    painter.filter = def->filter;
    enum font_status status = font_painter_create(&painter, &t->painter);
    if (status == FONT_OK)
        status = font_shaper_create(face, &t->shaper);
    if (status != FONT_OK) {
        voice_type_destroy(t);
        return status;
    }
    *out = t;
    return FONT_OK;
}

void voice_type_destroy(struct voice_type *t)
{
    if (!t)
        return;
    font_painter_destroy(t->painter);
    font_shaper_destroy(t->shaper);
    free(t->gray);
    free(t);
}

/* ---- what is played ---- */

static double played(const struct voice_type *t, enum voice_property property, double time_s,
                     double otherwise)
{
    enum voice_feature feature = t->def.mapping.feature[property];
    return feature == VOICE_NOTHING ? otherwise : voice_score_at(t->score, feature, time_s);
}

double voice_type_size(const struct voice_type *t, double time_s)
{
    return t->def.size_px[0] +
           (t->def.size_px[1] - t->def.size_px[0]) * played(t, TYPE_SIZE, time_s, 1);
}

static void ink_at(const struct voice_type *t, double time_s, double ink[3])
{
    double open = played(t, TYPE_INK, time_s, 0), share[3] = {1 - open, open, 0};
    if (t->def.mapping.feature[TYPE_INK] == VOICE_VOWEL) {
        double front = voice_score_at(t->score, VOICE_FRONT, time_s);
        share[0] = open;
        share[1] = (1 - open) * front;
        share[2] = (1 - open) * (1 - front);
    }
    for (int c = 0; c < 3; c++) {
        double light = 0;
        for (int i = 0; i < 3; i++)
            light += share[i] * font_light(t->def.inks[i][c], 0);
        ink[c] = font_number(light, 0);
    }
}

/* ---- drawing ---- */

void voice_type_paper(const struct voice_type *t, struct font_picture *picture)
{
    for (int y = 0; y < picture->height_px; y++)
        for (int x = 0; x < picture->width_px; x++)
            for (int c = 0; c < 3; c++)
                picture->rgb[(size_t)y * (size_t)picture->pitch + 3 * (size_t)x + (size_t)c] =
                    (uint8_t)lround(255 * t->def.paper[c]);
}

/* Mixes ink into a picture by the gray coverage, as light. */
static void ink_mix(const struct voice_type *t, const struct font_cover *cover, int left,
                    int top, const double ink[3], struct font_picture *picture)
{
    const double *light = t->light;
    double inked[3];
    for (int c = 0; c < 3; c++)
        inked[c] = font_light(ink[c], 0);
    for (int y = 0; y < cover->height_px; y++)
        for (int x = 0; x < cover->width_px; x++) {
            double part = cover->gray[(size_t)y * (size_t)cover->pitch + (size_t)x] / 255.0;
            uint8_t *at = picture->rgb + (size_t)(top + y) * (size_t)picture->pitch +
                          3 * (size_t)(left + x);
            for (int c = 0; part > 0 && c < 3; c++)
                at[c] = (uint8_t)lround(
                    255 * font_number(light[at[c]] + part * (inked[c] - light[at[c]]), 0));
        }
}

/* From the axis's least to its most, in steps, so that glyphs can be reused; a part below 0
 * leaves it. */
static enum font_status axis_play(struct voice_type *t, const struct font_axis *axis,
                                  double part)
{
    if (part < 0 || !axis->tag[0])
        return FONT_OK;
    return font_face_axis_set(t->face, axis->tag,
                              axis->least + (axis->most - axis->least) * round(part * 32) / 32);
}

/* Computes the axes and the shear of a moment. */
static enum font_status instrument_set(struct voice_type *t, double time_s,
                                       struct font_map *map)
{
    double slant = played(t, TYPE_SLANT, time_s, -1);
    *map = font_map_shear(0);
    enum font_status status = axis_play(t, &t->weight, played(t, TYPE_WEIGHT, time_s, -1));
    if (status == FONT_OK)
        status = axis_play(t, &t->width, played(t, TYPE_WIDTH, time_s, -1));
    if (slant >= 0 && t->slant.tag[0] && status == FONT_OK) {
        double to = fabs(t->slant.least) > fabs(t->slant.most) ? t->slant.least : t->slant.most;
        status = font_face_axis_set(t->face, "slnt", to * round(slant * 32) / 32);
    } else if (slant >= 0) {
        *map = font_map_shear(t->def.slant * slant);
    }
    return status;
}

/* Draws a layout with its origin at x, y. */
static enum font_status layout_draw(struct voice_type *t, const struct font_layout *layout,
                                    const struct font_map *map, double x, double y,
                                    const double ink[3], struct font_picture *picture)
{
    struct font_box box;
    enum font_status status = font_painter_measure(t->painter, layout, map, x, y, &box);
    if (status != FONT_OK)
        return status;
    int left = (int)fmax(0, floor(box.x0) - 1), top = (int)fmax(0, floor(box.y0) - 1);
    int right = (int)fmin(picture->width_px, ceil(box.x1) + 1),
        bottom = (int)fmin(picture->height_px, ceil(box.y1) + 1);
    if (right <= left || bottom <= top)
        return FONT_OK;
    size_t bytes = (size_t)(right - left) * (size_t)(bottom - top);
    if (bytes > t->gray_room) {
        uint8_t *grown = realloc(t->gray, bytes);
        if (!grown)
            return FONT_NO_MEMORY;
        t->gray = grown;
        t->gray_room = bytes;
    }
    memset(t->gray, 0, bytes);
    struct font_cover cover = {right - left, bottom - top, right - left, t->gray};
    status = font_painter_cover(t->painter, layout, map, x - left, y - top, &cover);
    ink_mix(t, &cover, left, top, ink, picture);
    return status;
}

static double baseline_rise(const struct voice_type *t, double time_s)
{
    return t->def.rise_em * t->def.size_px[1] * played(t, TYPE_BASELINE, time_s, 0);
}

enum font_status voice_type_moment(struct voice_type *t, double time_s,
                                   struct font_picture *picture)
{
    struct font_layout layout = {0};
    struct font_map map;
    double ink[3], size = voice_type_size(t, time_s);
    const int word = t->timing ? voice_word_at(t->timing, time_s) : 0;
    int begin, end;
    voice_type_paper(t, picture);
    if (size < 0.5 || word < 0) /* nothing is heard */
        return FONT_OK;
    voice_word_bytes(t->words, word, &begin, &end);
    if (!t->timing) {
        begin = t->words->letters[0].before;
        end = t->words->letters[t->words->letters_count - 1].after;
    }
    enum font_status status = instrument_set(t, time_s, &map);
    if (status == FONT_OK)
        status = font_shaper_layout(t->shaper, t->words->text + begin, (size_t)(end - begin),
                                    size, NULL, &layout);
    if (status == FONT_OK) {
        /* centred: the ascent and descent of letters are at equal distances from the middle */
        double x = (picture->width_px - layout.width_px) / 2,
               y = picture->height_px / 2.0 + 0.25 * size - baseline_rise(t, time_s) +
                   (t->def.mapping.feature[TYPE_BASELINE]
                        ? t->def.rise_em * t->def.size_px[1] / 2
                        : 0);
        ink_at(t, time_s, ink);
        status = layout_draw(t, &layout, &map, x, y, ink, picture);
    }
    font_layout_finish(&layout);
    return status;
}

/* ---- lines ---- */

/* The present position on a line, and its time. */
struct line {
    double x, time_s, second_px;
    double origin_px, baseline_px;
    struct font_picture *picture; /* NULL: it is only measured */
};

/* Sets bytes of the text at the line's position, and moves the position on. Nothing else on the
 * line is of that time. */
static enum font_status bytes_set(struct voice_type *t, struct line *line, int begin, int end)
{
    struct font_layout layout = {0};
    struct font_map map;
    double ink[3];
    if (end <= begin)
        return FONT_OK;
    enum font_status status = instrument_set(t, line->time_s, &map);
    if (status == FONT_OK)
        status = font_shaper_layout(t->shaper, t->words->text + begin, (size_t)(end - begin),
                                    voice_type_size(t, line->time_s), NULL, &layout);
    if (status == FONT_OK && line->picture) {
        const double x = t->to_left ? line->origin_px - line->x - layout.width_px
                                    : line->origin_px + line->x;
        ink_at(t, line->time_s, ink);
        status =
            layout_draw(t, &layout, &map, x, line->baseline_px - baseline_rise(t, line->time_s),
                        ink, line->picture);
    }
    line->x += layout.width_px;
    font_layout_finish(&layout);
    return status;
}

static bool audible(const struct voice_type *t, double time_s)
{
    return voice_score_at(t->score, VOICE_ENVELOPE, time_s) >= t->def.silence;
}

static double loudest_in(const struct voice_type *t, struct voice_span span)
{
    double best_s = span.begin_s, best = -1;
    for (double at = span.begin_s; at < span.end_s; at += SILENT_STEP_S) {
        const double level = voice_score_at(t->score, VOICE_ENVELOPE, at);
        if (level > best) {
            best = level;
            best_s = at;
        }
    }
    return best_s;
}

/* Moves over silence, at most up to a time. */
static void silence_go(const struct voice_type *t, struct line *line, double until_s)
{
    while (line->time_s < until_s && !audible(t, line->time_s)) {
        line->time_s += SILENT_STEP_S;
        line->x += SILENT_STEP_S * line->second_px;
    }
}

/* Sets a letter once, and again as often as its width corresponds to its time. A letter that
 * cannot be heard is as large as its loudest moment. So each letter is set, and where many
 * letters share a short time, the line becomes longer. */
static enum font_status letter_set(struct voice_type *t, struct line *line, int letter)
{
    const struct voice_letter *l = &t->words->letters[letter];
    const struct voice_span span = t->timing->letters[letter];
    enum font_status status = bytes_set(t, line, l->before, l->begin);
    bool set = false;
    while (status == FONT_OK) {
        silence_go(t, line, span.end_s);
        const bool late = line->time_s >= span.end_s;
        if (late && set)
            break;
        if (late)
            line->time_s = loudest_in(t, span);
        const double begun = line->x;
        status = bytes_set(t, line, l->begin, l->end);
        const double lasts = fmax(line->x - begun, 1) / line->second_px;
        line->time_s += lasts;
        if (late || line->time_s + lasts / 2 > span.end_s)
            line->time_s = span.end_s;
        set = true;
    }
    if (status == FONT_OK) { /* what follows is as large as the letter's end */
        line->time_s = fmax(span.begin_s, span.end_s - SILENT_STEP_S);
        status = bytes_set(t, line, l->end, l->after);
        line->time_s = span.end_s;
    }
    return status;
}

static enum font_status whole_set(struct voice_type *t, struct line *line, int word)
{
    const struct voice_span span = t->timing->words[word];
    const double begun = line->x;
    int begin, end;
    voice_word_bytes(t->words, word, &begin, &end);
    line->time_s = loudest_in(t, span);
    enum font_status status = bytes_set(t, line, begin, end);
    line->x = fmax(line->x, begun + (span.end_s - span.begin_s) * line->second_px);
    line->time_s = span.end_s;
    return status;
}

/* Moves from one word's end to the next one's beginning: as long as the silence, and a space at
 * least. */
static void space_go(const struct voice_type *t, struct line *line, int word)
{
    const struct voice_span *words = t->timing->words;
    const double quiet_s = words[word].begin_s - words[word - 1].end_s,
                 size = voice_type_size(t, loudest_in(t, words[word - 1]));
    line->x += fmax(WORD_SPACE_EM * size, quiet_s * line->second_px);
    line->time_s = words[word].begin_s;
}

static enum font_status word_set(struct voice_type *t, struct line *line, int word)
{
    enum font_status status = FONT_OK;
    line->time_s = t->timing->words[word].begin_s;
    if (t->to_left || voice_word_joins(t->words, word))
        return whole_set(t, line, word);
    for (int i = t->words->first[word]; i < t->words->first[word + 1] && status == FONT_OK; i++)
        status = letter_set(t, line, i);
    return status;
}

enum font_status voice_type_lines(struct voice_type *t, double second_px, double most_px,
                                  struct voice_line **lines, int *count)
{
    struct line line = {.second_px = second_px};
    enum font_status status = FONT_OK;
    *count = 0;
    *lines = malloc(sizeof **lines * (size_t)t->words->count);
    if (!*lines)
        return FONT_NO_MEMORY;
    for (int word = 0; word < t->words->count && status == FONT_OK; word++) {
        const double ended = line.x;
        if (word > 0)
            space_go(t, &line, word);
        const double begins = line.x;
        status = word_set(t, &line, word);
        if (*count == 0 || line.x > most_px) { /* another line begins with this word */
            if (*count > 0)
                (*lines)[*count - 1].width_px = ended;
            line.x -= begins;
            (*lines)[(*count)++] = (struct voice_line){.first_word = word};
        }
        (*lines)[*count - 1].end_word = word + 1;
    }
    (*lines)[*count - 1].width_px = line.x;
    return status;
}

enum font_status voice_type_line(struct voice_type *t, double second_px,
                                 const struct voice_line *which, double x_px,
                                 double baseline_px, struct font_picture *picture)
{
    struct line line = {.second_px = second_px,
                        .origin_px = x_px,
                        .baseline_px = baseline_px,
                        .picture = picture};
    enum font_status status = FONT_OK;
    for (int word = which->first_word; word < which->end_word && status == FONT_OK; word++) {
        if (word > which->first_word)
            space_go(t, &line, word);
        status = word_set(t, &line, word);
    }
    return status;
}

bool voice_type_to_left(const struct voice_type *t)
{
    return t->to_left;
}

/* ---- the envelope ---- */

void voice_type_envelope(const struct voice_type *t, double margin_px,
                         struct font_picture *picture)
{
    enum { PARTS = 8 }; /* samples for each pixel's width */
    const struct voice_score *s = t->score;
    double width = picture->width_px - 2 * margin_px,
           height = picture->height_px - 3 * margin_px;
    double bottom = picture->height_px - 2 * margin_px, seconds = fmax(s->seconds, 1e-6);
    voice_type_paper(t, picture);
    for (int x = 0; x < picture->width_px; x++) {
        double tops[PARTS];
        for (int k = 0; k < PARTS; k++) {
            double part = (x + (k + 0.5) / PARTS - margin_px) / width;
            tops[k] = part < 0 || part > 1
                          ? bottom
                          : bottom - height * voice_score_at(s, VOICE_ENVELOPE, part * seconds);
        }
        for (int y = 0; y < picture->height_px; y++) {
            double covered = 0, at = x - margin_px;
            for (int k = 0; k < PARTS; k++)
                covered += fmax(0, fmin(y + 1, bottom) - fmax(y, tops[k])) / PARTS;
            if (y == (int)bottom && at >= 0 && at <= width) /* the line of silence */
                covered = 1;
            for (int i = 0; i < s->begins && y > bottom && y < bottom + margin_px / 2; i++)
                covered = fmax(covered, 1 - fabs(at - width * s->begin_s[i] / seconds));
            if (covered <= 0)
                continue;
            uint8_t gray = (uint8_t)lround(255 * fmin(1, covered));
            struct font_cover cover = {1, 1, 1, &gray};
            ink_mix(t, &cover, x, y, t->def.inks[0], picture);
        }
    }
}
