/* keys_poster.c - see keys_poster.h. */
#include "keys_poster.h"

#include "keys_picture_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double TOGETHER_S = 0.03;  /* notes that begin within it are a chord */
static const double SMALLEST = 1.0 / 3; /* what a letter keeps of its size */
static const double CLEAR = 0.04;       /* of the largest em, between letters */
static const double ABOVE = 0.85;       /* of the em, above a staff's highest baseline */
static const double STAFF_EM = 1.25;    /* of a staff with one key: its letters, and a gap */

/* Where a letter's ink is from its origin, in ems, y downwards. */
struct reach {
    double left, right, top, bottom;
};

/* Where a note stands: from the beginning of time, and from the line's top. */
struct placed {
    double x_px, y_px, size_px;
};

struct line {
    double begin_px;
    int first, end; /* of the score's notes */
};

struct keys_poster {
    struct keys_type *type;
    struct placed *placed; /* of each note */
    struct line *lines;
    int lines_count;
    double second_px, width_px, height_px;
    struct reach reach[MIDI_NOTES];
    double baseline_px[MIDI_CHANNELS]; /* of a staff's lowest key */
    int rank[MIDI_CHANNELS][MIDI_NOTES];
};

/* ---- letters ---- */

/* Where the drawn picture differs from its paper. */
static struct reach reach_find(const struct font_picture *picture, double x, double y,
                               double em)
{
    int box[4] = {picture->width_px, 0, picture->height_px, 0};
    for (int row = 0; row < picture->height_px; row++)
        for (int column = 0; column < picture->width_px; column++) {
            const uint8_t *at =
                picture->rgb + (size_t)row * (size_t)picture->pitch + 3 * column;
            if (!memcmp(at, picture->rgb, 3)) /* the corner is paper */
                continue;
            box[0] = column < box[0] ? column : box[0];
            box[1] = column >= box[1] ? column + 1 : box[1];
            box[2] = row < box[2] ? row : box[2];
            box[3] = row >= box[3] ? row + 1 : box[3];
        }
    if (box[1] <= box[0])
        return (struct reach){0};
    return (struct reach){(box[0] - x) / em, (box[1] - x) / em, (box[2] - y) / em,
                          (box[3] - y) / em};
}

/* Draws a letter alone, and looks where its ink is. */
static enum font_status reach_measure(struct keys_type *t, int key, struct reach *out)
{
    enum { EM = 48, LEFT = EM, BASE = 2 * EM, HEIGHT = 3 * EM, WIDEST = 64 * EM };
    struct font_layout layout = {0};
    enum font_status status = keys_type_shape(t, key, EM, &layout);
    const int width = (int)fmin(WIDEST, ceil(layout.width_px)) + 2 * LEFT;
    struct font_picture picture = {width, HEIGHT, 3 * width,
                                   malloc(3 * (size_t)width * HEIGHT)};
    if (status == FONT_OK && !picture.rgb)
        status = FONT_NO_MEMORY;
    if (status == FONT_OK) {
        keys_type_paper(t, &picture);
        status = font_painter_layout(t->painters[0], &layout, NULL, LEFT, BASE, &picture);
        *out = reach_find(&picture, LEFT, BASE, EM);
    }
    free(picture.rgb);
    font_layout_finish(&layout);
    return status;
}

/* ---- staves ---- */

static void staves_make(struct keys_poster *p)
{
    const struct keys_type *t = p->type;
    const struct keys_score *s = t->score;
    const double em = t->def.size_px[1];
    bool plays[MIDI_CHANNELS] = {false};
    memset(p->rank, -1, sizeof p->rank);
    for (int i = 0; i < s->notes_count; i++) {
        plays[s->notes[i].channel] = true;
        p->rank[s->notes[i].channel][s->notes[i].note] = 0;
    }
    for (int c = 0; c < MIDI_CHANNELS; c++) {
        int keys = 0;
        for (int i = 0; i < MIDI_NOTES; i++)
            if (p->rank[c][i] >= 0)
                p->rank[c][i] = keys++;
        const double rise = plays[c] ? t->def.step_px * (keys - 1) : 0;
        p->baseline_px[c] = p->height_px + ABOVE * em + rise;
        p->height_px += plays[c] ? STAFF_EM * em + rise : 0;
    }
}

/* Whether two letters of a staff are so near in height that they would cover each other if they
 * stood at one place. */
static bool level_with(const struct keys_poster *p, int a, int b)
{
    const struct keys_note *notes = p->type->score->notes;
    const struct placed *i = &p->placed[a], *k = &p->placed[b];
    const struct reach *ri = &p->reach[notes[a].note], *rk = &p->reach[notes[b].note];
    const double clear = CLEAR * p->type->def.size_px[1];
    return i->y_px + i->size_px * ri->top < k->y_px + k->size_px * rk->bottom + clear &&
           k->y_px + k->size_px * rk->top < i->y_px + i->size_px * ri->bottom + clear;
}

/* The next note of the same staff after one, or notes_count. */
static int next_of(const struct keys_score *s, int i)
{
    const int channel = s->notes[i].channel;
    do
        i++;
    while (i < s->notes_count && s->notes[i].channel != channel);
    return i;
}

/* A chord: up to as many notes as there are keys, the lowest first. */
struct chord {
    int notes[MIDI_NOTES], count, next; /* next: what the staff has after it */
    double left_px, right_px;           /* of its ink, from where it begins */
};

static int by_key(const void *a, const void *b)
{
    const int *x = a, *y = b;
    return *x - *y;
}

/* The notes that begin with `first`. */
static void chord_find(const struct keys_score *s, int first, struct chord *c)
{
    int order[MIDI_NOTES][2];
    c->count = 0;
    int i = first;
    while (i < s->notes_count && c->count < MIDI_NOTES &&
           s->notes[i].begin_s < s->notes[first].begin_s + TOGETHER_S) {
        order[c->count][0] = s->notes[i].note;
        order[c->count++][1] = i;
        i = next_of(s, i);
    }
    c->next = i;
    qsort(order, (size_t)c->count, sizeof *order, by_key);
    for (int k = 0; k < c->count; k++)
        c->notes[k] = order[k][1];
}

/* Moves each letter of a chord to the right of those before it that it would cover. */
static void chord_spread(struct keys_poster *p, struct chord *c)
{
    const struct keys_note *notes = p->type->score->notes;
    const double begin_px = p->second_px * notes[c->notes[0]].begin_s;
    c->left_px = c->right_px = 0;
    for (int k = 0; k < c->count; k++) {
        struct placed *at = &p->placed[c->notes[k]];
        const struct reach *reach = &p->reach[notes[c->notes[k]].note];
        double x = 0;
        for (int i = 0; i < k; i++) {
            const struct placed *before = &p->placed[c->notes[i]];
            const double end = before->x_px - begin_px +
                               before->size_px * p->reach[notes[c->notes[i]].note].right +
                               CLEAR * p->type->def.size_px[1];
            if (level_with(p, c->notes[i], c->notes[k]))
                x = fmax(x, end - at->size_px * reach->left);
        }
        at->x_px = begin_px + x;
        c->left_px = fmin(c->left_px, x + at->size_px * reach->left);
        c->right_px = fmax(c->right_px, x + at->size_px * reach->right);
    }
}

/* How far it is from a chord to the first letter that it would cover. */
static double chord_room(const struct keys_poster *p, const struct chord *c)
{
    const struct keys_score *s = p->type->score;
    const double begin_px = p->second_px * s->notes[c->notes[0]].begin_s;
    for (int i = c->next; i < s->notes_count; i = next_of(s, i)) {
        const double away = p->second_px * s->notes[i].begin_s - begin_px;
        if (away >= c->right_px)
            break;
        for (int k = 0; k < c->count; k++)
            if (level_with(p, c->notes[k], i))
                return away;
    }
    return c->right_px;
}

static void staff_place(struct keys_poster *p, int first)
{
    const struct keys_score *s = p->type->score;
    struct chord c;
    for (int i = first; i < s->notes_count; i = c.next) {
        chord_find(s, i, &c);
        chord_spread(p, &c);
        const double begin_px = p->second_px * s->notes[c.notes[0]].begin_s;
        const double room = chord_room(p, &c);
        const double part =
            c.right_px > 0 ? fmax(SMALLEST, fmin(1, 0.96 * room / c.right_px)) : 1;
        for (int k = 0; k < c.count && room < c.right_px; k++) {
            struct placed *at = &p->placed[c.notes[k]];
            at->x_px = begin_px + part * (at->x_px - begin_px);
            at->size_px *= part;
        }
    }
}

static void notes_place(struct keys_poster *p)
{
    const struct keys_score *s = p->type->score;
    bool seen[MIDI_CHANNELS] = {false};
    for (int i = 0; i < s->notes_count; i++) {
        const struct keys_note *n = &s->notes[i];
        p->placed[i] = (struct placed){
            .x_px = p->second_px * n->begin_s,
            .y_px = p->baseline_px[n->channel] -
                    p->type->def.step_px * p->rank[n->channel][n->note],
            .size_px = keys_type_size(p->type, keys_note_most(s, i)),
        };
    }
    for (int i = 0; i < s->notes_count; i++) {
        if (!seen[s->notes[i].channel])
            staff_place(p, i);
        seen[s->notes[i].channel] = true;
    }
}

/* ---- lines ---- */

/* The note with which the line after one that begins with `first` begins: of those about
 * where it shall end, the one after the longest rest; of equal ones the nearest. */
static int line_end(const struct keys_poster *p, int first, double wanted_px, double most_px)
{
    const struct keys_score *s = p->type->score;
    const double begin_px = p->second_px * s->notes[first].begin_s;
    double longest_s = -1, nearest_px = INFINITY;
    int end = s->notes_count;
    for (int i = first + 1; i < s->notes_count; i++) {
        const double at = p->second_px * s->notes[i].begin_s - begin_px;
        const double rest_s = s->notes[i].begin_s - s->notes[i - 1].begin_s;
        const double away = fabs(at - wanted_px);
        const bool late = at > 1.15 * wanted_px || at > most_px;
        if (at < 0.85 * wanted_px)
            continue;
        if (longest_s >= 0 && late)
            break;
        if (rest_s > longest_s + TOGETHER_S ||
            (rest_s > longest_s - TOGETHER_S && away < nearest_px)) {
            longest_s = rest_s;
            nearest_px = away;
            end = i;
        }
        if (late)
            break;
    }
    return end;
}

static enum font_status lines_make(struct keys_poster *p, double most_px)
{
    const struct keys_score *s = p->type->score;
    const double last_px = p->second_px * s->notes[s->notes_count - 1].begin_s;
    int room = 0;
    for (int first = 0; first < s->notes_count;) {
        const double left_px = last_px - p->second_px * s->notes[first].begin_s;
        const double wanted = left_px / ceil(fmax(1, left_px / most_px));
        if (p->lines_count == room) {
            room = room ? 2 * room : 16;
            struct line *grown = realloc(p->lines, (size_t)room * sizeof *grown);
            if (!grown)
                return FONT_NO_MEMORY;
            p->lines = grown;
        }
        struct line *line = &p->lines[p->lines_count++];
        *line = (struct line){.begin_px = p->second_px * s->notes[first].begin_s,
                              .first = first,
                              .end = left_px <= most_px ? s->notes_count
                                                        : line_end(p, first, wanted, most_px)};
        for (int i = first; i < line->end; i++) {
            const double right =
                p->placed[i].size_px * p->reach[s->notes[i].note].right + p->placed[i].x_px;
            p->width_px = fmax(p->width_px, right - line->begin_px);
        }
        first = line->end;
    }
    return FONT_OK;
}

/* ---- the poster ---- */

enum font_status keys_poster_create(struct keys_type *type, double second_px, double line_px,
                                    struct keys_poster **out)
{
    const struct keys_score *s = type->score;
    struct keys_poster *p = calloc(1, sizeof *p);
    *out = NULL;
    if (!p || !(p->placed = calloc((size_t)s->notes_count + 1, sizeof *p->placed))) {
        free(p);
        return FONT_NO_MEMORY;
    }
    p->type = type;
    p->second_px = second_px;
    enum font_status status = FONT_OK;
    for (int i = 0; i < s->keys_count && status == FONT_OK; i++)
        status = reach_measure(type, s->keys[i], &p->reach[s->keys[i]]);
    if (status == FONT_OK) {
        staves_make(p);
        notes_place(p);
        status = lines_make(p, line_px);
    }
    if (status != FONT_OK) {
        keys_poster_destroy(p);
        return status;
    }
    *out = p;
    return FONT_OK;
}

void keys_poster_destroy(struct keys_poster *p)
{
    if (!p)
        return;
    free(p->placed);
    free(p->lines);
    free(p);
}

int keys_poster_lines(const struct keys_poster *p)
{
    return p->lines_count;
}

double keys_poster_width(const struct keys_poster *p)
{
    return p->width_px;
}

double keys_poster_height(const struct keys_poster *p)
{
    return p->height_px;
}

enum font_status keys_poster_draw(struct keys_poster *p, int number, double x_px, double y_px,
                                  struct font_picture *picture)
{
    const struct line *line = &p->lines[number];
    enum font_status status = FONT_OK;
    for (int i = line->first; i < line->end && status == FONT_OK; i++) {
        const struct keys_note *n = &p->type->score->notes[i];
        const struct placed *at = &p->placed[i];
        struct font_layout layout = {0};
        if (at->size_px >= 0.5)
            status = keys_type_shape(p->type, n->note, at->size_px, &layout);
        if (status == FONT_OK && layout.width_px > 0)
            status =
                font_painter_layout(p->type->painters[n->channel % KEYS_INKS], &layout, NULL,
                                    x_px + at->x_px - line->begin_px, y_px + at->y_px, picture);
        font_layout_finish(&layout);
    }
    return status;
}
