/* paper_actor.c - see paper_actor.h. */
#include "paper_actor.h"
#include "keys_places.h"

#include <brush.h>
#include <history.h>
#include <paint.h>
#include <picture.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Numbers of the sheet's brushes: the one that controls lead, and the pointer's. */
enum { MAPPED, POINTED, BRUSHES };
enum { CHOICES_BYTES = PAPER_ACTOR_PIGMENTS * (PAPER_NAME_MAX + 1) };
static const double FILL = 0.94; /* of the sheet's width is for letters, as in keys_actor.c */
static const double REACH = 1e5; /* fibers: a brush that is down does not run dry */
static const double PRESSED_MOST = 1.2; /* water that the most aftertouch gives a second */

/* All doubles, for the table's sake. */
struct settings {
    double gravity, tilt, humidity, edge, pace, size, height, water, ink, pigment;
    double brush_x, brush_y, brush_size, brush_water, brush_ink;
};
enum { ROWS = sizeof(struct settings) / sizeof(double) };

struct brush {
    double x, y; /* fibers, y downwards */
    bool down;
};

/* What a brush was dipped in. */
struct dip {
    double size, pigment, water, ink;
};

/* How far a brush has been led. */
struct led {
    struct brush at;
    struct dip dip;
};

/* A key that is held: where its letter is, and how hard it is pressed. */
struct held {
    bool down;
    double size_px, pressed;
};

struct paper_actor {
    struct paper_sheet *sheet;
    struct keys_score score;
    struct keys_letters letters;
    struct font_shaper *shaper;
    struct font_painter *painter;
    struct settings set;
    struct control rows[ROWS];
    char choices[CHOICES_BYTES];
    double fit_px; /* the size of a letter of the most velocity */
    double due;    /* steps of the sheet that are due, a fraction */
    struct brush pointer;
    bool tapped; /* the pointer has been down since the last step, if only for a moment */
    struct led led[BRUSHES];
    double pressure;
    struct held held[MIDI_NOTES];
    struct font_cover cover; /* of a letter, as large as the sheet */
    uint8_t *rgb;
};

struct paper_actor_def paper_actor_def_default(void)
{
    return (struct paper_actor_def){
        .keys = keys_actor_def_default(),
        .width = 480,
        .height = 180,
        .stock = "cold press",
        .pigments = {PAPER_PIGMENT_USUAL, "quinacridone rose", "hansa yellow", "indian red"},
        .pigments_count = 4,
        .seed = 1};
}

static enum stage_status paper_failed(enum paper_status status)
{
    return status == PAPER_OK ? STAGE_OK
                              : stage_fail(status == PAPER_NO_MEMORY      ? STAGE_NO_MEMORY
                                           : status == PAPER_BAD_ARGUMENT ? STAGE_BAD_ARGUMENT
                                                                          : STAGE_FAILED,
                                           "%s", paper_error());
}

/* ---- controls ---- */

static double *setting(struct settings *s, int index)
{
    double *const all[ROWS] = {&s->gravity,    &s->tilt,        &s->humidity, &s->edge,
                               &s->pace,       &s->size,        &s->height,   &s->water,
                               &s->ink,        &s->pigment,     &s->brush_x,  &s->brush_y,
                               &s->brush_size, &s->brush_water, &s->brush_ink};
    return all[index];
}

static double row_read(void *actor, int index)
{
    return *setting(&((struct paper_actor *)actor)->set, index);
}

static enum stage_status air_set(struct paper_actor *a)
{
    struct paper_air air = *paper_sheet_get_air(a->sheet);
    const struct paper_air before = air;
    air.gravity[0] = a->set.tilt;
    air.gravity[1] = a->set.gravity;
    air.humidity = a->set.humidity;
    air.edge = a->set.edge;
    return memcmp(&air, &before, sizeof air) ? paper_failed(paper_sheet_air(a->sheet, &air))
                                             : STAGE_OK;
}

static unsigned row_write(void *actor, int index, double value)
{
    struct paper_actor *a = actor;
    const double before = *setting(&a->set, index);
    *setting(&a->set, index) = value;
    enum stage_status status = air_set(a);
    if (status != STAGE_OK)
        *setting(&a->set, index) = before;
    return status;
}

static void rows_make(struct paper_actor *a)
{
    static const struct control rows[ROWS] = {
        {"gravity", "", -0.95, 0.95, 0, CONTROL_LINEAR, NULL, "pulls water down the sheet", 0,
         0, 0},
        {"tilt", "", -0.95, 0.95, 0, CONTROL_LINEAR, NULL, "pulls water to the right", 0, 0, 0},
        {"humidity", "", 0, 0.05, 0, CONTROL_LOGARITHMIC, NULL, "water that dries in a step", 0,
         0, 0},
        {"edge", "", 0, 200, 0, CONTROL_LINEAR, NULL, "how much faster wet edges dry", 0, 0, 0},
        {"pace", "/s", 0, 400, 60, CONTROL_LINEAR, NULL, "steps of the paper in a second", 0, 0,
         0},
        {"size", "", 0.05, 4, 1, CONTROL_LOGARITHMIC, NULL,
         "of all letters; 1 is as large as fits", 0, 0, 0},
        {"height", "", 0, 1, 0.5, CONTROL_LINEAR, NULL, "where letters are, from the bottom", 0,
         0, 0},
        {"water", "", 0, 4, 0.8, CONTROL_LINEAR, NULL, "of a letter", 0, 0, 0},
        {"ink", "", 0, 4, 0.6, CONTROL_LINEAR, NULL, "of a letter", 0, 0, 0},
        {"pigment", "", 0, 0, 0, CONTROL_CHOICE, NULL, "what letters and brushes are of", 0, 0,
         0},
        {"brush_x", "", 0, 1, 0.5, CONTROL_LINEAR, NULL, "where the brush is, from the left", 0,
         0, 0},
        {"brush_y", "", 0, 1, 0.5, CONTROL_LINEAR, NULL, "where the brush is, from the bottom",
         0, 0, 0},
        {"brush_size", "", 1, 100, 12, CONTROL_LOGARITHMIC, NULL,
         "how many fibers a brush is wide", 0, 0, 0},
        {"brush_water", "", 0, 4, 0, CONTROL_LINEAR, NULL, "that the brush leaves", 0, 0, 0},
        {"brush_ink", "", 0, 4, 0, CONTROL_LINEAR, NULL, "that the brush leaves", 0, 0, 0}};
    const struct paper_air *air = paper_sheet_get_air(a->sheet);
    const struct paper_sheet_config *config = paper_sheet_get_config(a->sheet);
    const double usual[4] = {air->gravity[1], air->gravity[0], air->humidity, air->edge};
    memcpy(a->rows, rows, sizeof rows);
    size_t at = 0;
    for (int i = 0; i < config->pigments_count; i++) {
        at += (size_t)snprintf(a->choices + at, sizeof a->choices - at, "%s%s", i ? " " : "",
                               config->pigments[i].name);
        for (char *c = a->choices + at - strlen(config->pigments[i].name); *c; c++)
            *c = *c == ' ' ? '-' : *c; /* blanks separate choices */
    }
    for (int i = 0; i < ROWS; i++) {
        struct control *r = &a->rows[i];
        r->read = row_read;
        r->write = row_write;
        r->at = i;
        if (i < 4)
            r->usual = usual[i];
        if (r->curve == CONTROL_CHOICE) {
            r->choices = a->choices;
            r->most = config->pigments_count - 1;
        }
        *setting(&a->set, i) = r->usual;
    }
}

static const struct control *actor_controls(void *actor, int *count)
{
    *count = ROWS;
    return ((struct paper_actor *)actor)->rows;
}

/* ---- ink ---- */

/* Puts what the cover has gathered, and clears it. */
static enum stage_status cover_put(struct paper_actor *a, double water, double ink)
{
    double amount[1 + PAPER_PIGMENTS_MAX] = {water};
    const struct paper_screen screen = {
        .width_px = a->cover.width_px, .height_px = a->cover.height_px, .gray = a->cover.gray};
    amount[1 + (int)a->set.pigment] = ink;
    enum stage_status status = paper_failed(paper_sheet_put(a->sheet, &screen, 0, 0, amount));
    memset(a->cover.gray, 0, (size_t)a->cover.pitch * (size_t)a->cover.height_px);
    return status;
}

/* A key's letter, in the middle of its place. */
static enum stage_status letter_print(struct paper_actor *a, int key, double size_px,
                                      double water, double ink)
{
    struct font_layout layout = {0};
    const char *letter = a->letters.of[key];
    const double part = FILL * a->cover.width_px / a->score.keys_count,
                 left = (1 - FILL) / 2 * a->cover.width_px;
    if (!letter[0] || size_px < 1)
        return STAGE_OK;
    enum font_status drawn =
        font_shaper_layout(a->shaper, letter, strlen(letter), size_px, NULL, &layout);
    if (drawn == FONT_OK) {
        const double half = layout.width_px / 2,
                     middle = left + (a->score.rank[key] + 0.5) * part,
                     x = fmax(half, fmin(middle, a->cover.width_px - half)) - half,
                     y = (1 - a->set.height) * a->cover.height_px + 0.3 * size_px;
        drawn = font_painter_cover(a->painter, &layout, NULL, x, y, &a->cover);
    }
    font_layout_finish(&layout);
    if (drawn == FONT_NO_MEMORY)
        return stage_fail(STAGE_NO_MEMORY, "%s", font_error());
    return cover_put(a, water, ink);
}

/* ---- brushes: those of the paper ---- */

/* What the brush is dipped in; a change is a new dip. */
static struct dip dip_of(const struct paper_actor *a, double water, double ink)
{
    return (struct dip){a->set.brush_size, a->set.pigment, water, ink};
}

static enum paper_status brush_dip(struct paper_actor *a, int number, const struct dip *dip)
{
    struct paper_brush brush = paper_brush_default();
    struct paper_dip paint = {
        .number = number, .part = 1, .side = {-1, 1}, .amount = {fmin(1, dip->water)}};
    brush.number = number;
    /* as dense when it is wide as when it is narrow, with at most so many bristles */
    const double wide = fmax(1, dip->size / brush.width);
    brush.bristles = (int)fmin(PAPER_BRISTLES_MAX, brush.bristles * wide);
    brush.thickness *= sqrt(wide);
    brush.width = brush.depth = dip->size;
    brush.load = fmin(2, fmax(0.01, dip->water));
    brush.reach = REACH;
    paint.amount[1 + (int)dip->pigment] = dip->ink;
    enum paper_status status = paper_sheet_brush(a->sheet, &brush);
    return status == PAPER_OK ? paper_sheet_dip(a->sheet, &paint) : status;
}

/* From where the brush was to where it is, within that time. */
static enum stage_status brush_lead(struct paper_actor *a, int number, const struct brush *is,
                                    double pressure, const struct dip *dip, double dt_s)
{
    struct led *led = &a->led[number];
    const bool began = led->at.down && is->down;
    const struct brush from = began ? led->at : *is;
    led->at = *is;
    if (!is->down || (dip->water <= 0 && dip->ink <= 0))
        return STAGE_OK;
    enum paper_status status = PAPER_OK;
    if (!began || memcmp(&led->dip, dip, sizeof *dip))
        status = brush_dip(a, number, dip);
    led->dip = *dip;
    const struct paper_stroke_sample samples[2] = {
        {.x = from.x, .y = from.y, .pressure = pressure},
        {.time_s = dt_s, .x = is->x, .y = is->y, .pressure = pressure}};
    const struct paper_stroke stroke = {
        .number = number, .samples_count = 2, .samples = samples};
    if (status == PAPER_OK)
        status = paper_sheet_stroke(a->sheet, &stroke, NULL);
    return paper_failed(status);
}

static enum stage_status brushes_lead(struct paper_actor *a, double dt_s)
{
    const struct dip mapped_dip = dip_of(a, a->set.brush_water, a->set.brush_ink),
                     pointer_dip = dip_of(a, a->set.water, a->set.ink);
    const struct brush mapped = {a->set.brush_x * a->cover.width_px,
                                 (1 - a->set.brush_y) * a->cover.height_px,
                                 a->set.brush_water > 0 || a->set.brush_ink > 0};
    struct brush pointer = a->pointer;
    pointer.down |= a->tapped;
    a->tapped = false;
    enum stage_status status = brush_lead(a, MAPPED, &mapped, 1, &mapped_dip, dt_s);
    return status == STAGE_OK
               ? brush_lead(a, POINTED, &pointer, a->pressure, &pointer_dip, dt_s)
               : status;
}

/* ---- time ---- */

static enum stage_status held_press(struct paper_actor *a, double dt_s)
{
    enum stage_status status = STAGE_OK;
    for (int key = 0; key < MIDI_NOTES && status == STAGE_OK; key++) {
        const struct held *h = &a->held[key];
        if (h->down && h->pressed > 0)
            status = letter_print(a, key, h->size_px, PRESSED_MOST * h->pressed * dt_s, 0);
    }
    return status;
}

static enum stage_status actor_step(void *actor, double dt_s)
{
    struct paper_actor *a = actor;
    a->due += a->set.pace * dt_s;
    const int steps = (int)a->due;
    if (steps < 1)
        return STAGE_OK;
    a->due -= steps;
    const double gone_s = a->set.pace > 0 ? steps / a->set.pace : 0;
    enum stage_status status = brushes_lead(a, gone_s);
    if (status == STAGE_OK)
        status = held_press(a, gone_s);
    for (int i = 0; i < steps && status == STAGE_OK; i++)
        status = paper_failed(paper_sheet_step(a->sheet));
    return status;
}

static enum stage_status actor_play(void *actor, const uint8_t *bytes)
{
    struct paper_actor *a = actor;
    const int kind = bytes[0] & 0xf0, data = bytes[1] & 0x7f;
    if (bytes[0] < MIDI_NOTE_OFF || bytes[0] >= MIDI_SYSEX)
        return STAGE_OK;
    if (kind == MIDI_PRESSURE) {
        for (int i = 0; i < MIDI_NOTES; i++)
            a->held[i].pressed = data / 127.0;
        return STAGE_OK;
    }
    if (kind != MIDI_NOTE_ON && kind != MIDI_NOTE_OFF && kind != MIDI_POLY_PRESSURE)
        return STAGE_OK;
    const int key = keys_places_near(&a->score, data);
    struct held *h = &a->held[key];
    if (a->score.rank[key] < 0)
        return STAGE_OK;
    if (kind == MIDI_POLY_PRESSURE) {
        h->pressed = bytes[2] / 127.0;
        return STAGE_OK;
    }
    *h = (struct held){0};
    if (kind == MIDI_NOTE_OFF || bytes[2] == 0)
        return STAGE_OK;
    *h = (struct held){.down = true, .size_px = a->fit_px * a->set.size * bytes[2] / 127.0};
    return letter_print(a, key, h->size_px, a->set.water, a->set.ink);
}

/* ---- pictures ---- */

/* rgb becomes the sheet's picture, as far as that has changed. */
static enum stage_status sheet_look(struct paper_actor *a)
{
    struct paper_sheet_view view = paper_sheet_view_default(paper_sheet_get_config(a->sheet));
    struct paper_area areas[PAPER_AREAS_MAX];
    const size_t pitch = 3 * (size_t)a->cover.width_px;
    view.show = PAPER_SHOW_WET;
    const int count = paper_sheet_changed(a->sheet, areas);
    enum paper_status status = PAPER_OK;
    for (int i = 0; i < count && status == PAPER_OK; i++)
        status = paper_sheet_view_area(
            a->sheet, &view, &areas[i],
            a->rgb + (size_t)areas[i].y * pitch + 3 * (size_t)areas[i].x, pitch);
    return paper_failed(status);
}

static void actor_draw(void *actor, const struct stage_look *look, struct stage_draw_list *list)
{
    struct paper_actor *a = actor;
    (void)look;
    if (sheet_look(a) != STAGE_OK) /* the next step says what is wrong */
        return;
    stage_draw_image(list, a->rgb, a->cover.width_px, a->cover.height_px, 0, 0,
                     a->cover.width_px, a->cover.height_px);
}

static struct font_box actor_extent(void *actor)
{
    const struct paper_actor *a = actor;
    return (struct font_box){0, 0, a->cover.width_px, a->cover.height_px};
}

/* ---- a hand ---- */

static bool actor_event(void *actor, const struct stage_event *event)
{
    struct paper_actor *a = actor;
    const bool inside = event->x >= 0 && event->y >= 0 && event->x <= a->cover.width_px &&
                        event->y <= a->cover.height_px;
    if (event->kind == STAGE_POINTER_DOWN && !inside)
        return false;
    a->pointer =
        (struct brush){event->x, a->cover.height_px - event->y,
                       event->kind == STAGE_POINTER_DOWN || event->kind == STAGE_POINTER_MOVE};
    if (a->pointer.down)
        a->pressure = event->pressure > 0 ? event->pressure : 0.5;
    if (event->kind == STAGE_POINTER_DOWN) {
        a->led[POINTED].at.down = false;
        a->tapped = true;
    }
    return true;
}

/* What is printed stays. */
static enum stage_status actor_text(void *actor, const char *words)
{
    struct paper_actor *a = actor;
    return keys_places_text(&a->score, words, &a->letters);
}

/* ---- going back: a state as it is saved, in memory ---- */

struct kept {
    struct settings set;
    struct keys_letters letters;
    uint8_t *bytes;
    size_t count;
    float *planes;
    size_t plane;
};

static void actor_forget(void *state)
{
    struct kept *k = state;
    if (!k)
        return;
    free(k->bytes);
    free(k->planes);
    free(k);
}

static enum stage_status actor_keep(void *actor, void **state)
{
    struct paper_actor *a = actor;
    struct paper_plane planes[PAPER_PLANES_MAX];
    struct kept *k = calloc(1, sizeof *k);
    *state = NULL;
    if (!k)
        return stage_fail(STAGE_NO_MEMORY, "no memory to keep the paper as it is");
    const int count = paper_sheet_planes(a->sheet, planes);
    k->set = a->set;
    k->letters = a->letters;
    k->plane = (size_t)a->cover.width_px * (size_t)a->cover.height_px;
    k->planes = malloc((size_t)count * k->plane * sizeof *k->planes);
    enum stage_status status =
        k->planes ? paper_failed(paper_history_encode(a->sheet, &k->bytes, &k->count))
                  : stage_fail(STAGE_NO_MEMORY, "no memory to keep the paper as it is");
    for (int i = 0; i < count && status == STAGE_OK; i++)
        status =
            paper_failed(paper_sheet_plane_read(a->sheet, i, k->planes + (size_t)i * k->plane));
    if (status == STAGE_OK)
        *state = k;
    else
        actor_forget(k);
    return status;
}

static enum paper_status kept_plane(void *context, int number, void *words)
{
    const struct kept *k = context;
    memcpy(words, k->planes + (size_t)number * k->plane, k->plane * sizeof *k->planes);
    return PAPER_OK;
}

static enum stage_status actor_restore(void *actor, const void *state)
{
    struct paper_actor *a = actor;
    struct kept k = *(const struct kept *)state;
    struct paper_sheet *sheet;
    enum stage_status status =
        paper_failed(paper_history_decode(k.bytes, k.count, false, 0, kept_plane, &k, &sheet));
    if (status != STAGE_OK)
        return status;
    paper_sheet_destroy(a->sheet);
    a->sheet = sheet;
    a->set = k.set;
    a->letters = k.letters;
    a->due = 0;
    memset(a->held, 0, sizeof a->held);
    memset(a->led, 0, sizeof a->led);
    a->pointer.down = a->tapped = false;
    return air_set(a);
}

/* ---- an actor ---- */

static void actor_destroy(void *actor)
{
    struct paper_actor *a = actor;
    paper_sheet_destroy(a->sheet);
    keys_score_finish(&a->score);
    font_shaper_destroy(a->shaper);
    font_painter_destroy(a->painter);
    free(a->cover.gray);
    free(a->rgb);
    free(a);
}

static const struct stage_actor_kind paper_kind = {.name = "paper",
                                                   .controls = actor_controls,
                                                   .step = actor_step,
                                                   .draw = actor_draw,
                                                   .play = actor_play,
                                                   .event = actor_event,
                                                   .extent = actor_extent,
                                                   .keep = actor_keep,
                                                   .restore = actor_restore,
                                                   .forget = actor_forget,
                                                   .text = actor_text,
                                                   .destroy = actor_destroy};

static enum stage_status sheet_make(struct paper_actor *a, const struct paper_actor_def *def)
{
    char known[PAPER_PIGMENT_NAMES_ROOM];
    struct paper_sheet_config config = paper_sheet_config_default();
    const struct paper_stock *stock = paper_stock_find(def->stock);
    if (!stock) {
        paper_stock_names(known, sizeof known);
        return stage_fail(STAGE_BAD_ARGUMENT, "there is no paper '%.40s'; there are %s",
                          def->stock, known);
    }
    config.stock = *stock;
    config.width = def->width;
    config.height = def->height;
    config.seed = def->seed;
    for (int i = 0; i < def->pigments_count; i++) {
        const struct paper_pigment *pigment = paper_pigment_find(def->pigments[i]);
        if (!pigment) {
            paper_pigment_names(known, sizeof known);
            return stage_fail(STAGE_BAD_ARGUMENT, "there is no pigment '%.40s'; there are %s",
                              def->pigments[i], known);
        }
        config.pigments[config.pigments_count++] = *pigment;
    }
    enum paper_status status = paper_sheet_create(&config, &a->sheet);
    if (status == PAPER_OK)
        status = paper_history_begin(a->sheet, 0);
    return paper_failed(status);
}

static enum stage_status type_make(struct paper_actor *a, const struct paper_actor_def *def)
{
    const struct font_painter_def painter = font_painter_def_default();
    if (!keys_score_begin(&def->keys.keys, &a->score) ||
        font_shaper_create(def->keys.face, &a->shaper) != FONT_OK ||
        font_painter_create(&painter, &a->painter) != FONT_OK)
        return stage_fail(STAGE_NO_MEMORY, "no memory for letters");
    return keys_places_make(&def->keys, &a->score, &a->letters);
}

static enum stage_status pictures_make(struct paper_actor *a)
{
    const struct paper_sheet_config *config = paper_sheet_get_config(a->sheet);
    const size_t count = (size_t)config->width * (size_t)config->height;
    a->cover = (struct font_cover){.width_px = config->width,
                                   .height_px = config->height,
                                   .pitch = config->width,
                                   .gray = calloc(count, 1)};
    a->rgb = malloc(3 * count);
    return a->cover.gray && a->rgb
               ? STAGE_OK
               : stage_fail(STAGE_NO_MEMORY, "no memory for a picture of the paper");
}

enum stage_status paper_actor_create(const struct paper_actor_def *def, struct stage_actor *out)
{
    struct paper_actor *a = calloc(1, sizeof *a);
    *out = (struct stage_actor){0};
    if (!a)
        return stage_fail(STAGE_NO_MEMORY, "no memory for paper");
    enum stage_status status = sheet_make(a, def);
    if (status == STAGE_OK)
        status = pictures_make(a);
    if (status == STAGE_OK)
        status = type_make(a, def);
    if (status != STAGE_OK) {
        actor_destroy(a);
        return status;
    }
    rows_make(a);
    /* a letter of the most velocity: two thirds of the height, and not much wider than its
     * place */
    a->fit_px = fmin(0.66 * def->height, 4.0 * FILL * def->width / a->score.keys_count);
    *out = (struct stage_actor){&paper_kind, a};
    return STAGE_OK;
}

enum stage_status paper_actor_play(const struct stage_actor *actor, const uint8_t *bytes)
{
    return actor_play(actor->self, bytes);
}

struct paper_sheet *paper_actor_sheet(const struct stage_actor *actor)
{
    return ((struct paper_actor *)actor->self)->sheet;
}
