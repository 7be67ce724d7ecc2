/* keys_actor.c - see keys_actor.h. */
#include "keys_actor.h"
#include "keys_places.h"

#include <font_axes.h>
#include <keys_picture.h>
#include <text.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { OWN_ROWS = 5, CHANNEL_COLORS = 4 };
enum { VELOCITY, PRESSURE, PITCH, LEADS };

static const struct stage_lead leads[LEADS] = {
    [VELOCITY] = {"velocity", "how far a note's velocity moves that axis"},
    [PRESSURE] = {"pressure", "how far its aftertouch moves that axis"},
    [PITCH] = {"pitch", "how far its key moves that axis: the lowest -1, the highest 1"}};

static const double FILL = 0.94; /* of a picture's width is for letters, as in keys_picture.c */
static const double FORGET_S = 0.5; /* between looks for notes that have faded */

/* All doubles, for the table's sake. */
struct settings {
    double size, attack, release, pressure, slant;
    struct stage_axes_set axes;
};

struct keys_actor {
    struct font_face *face;
    struct font_shaper *shaper;
    struct keys_score score;
    struct keys_letters letters;
    struct settings set;
    struct control rows[OWN_ROWS + STAGE_AXES_MAX * (1 + STAGE_LEADS_MAX)];
    int rows_count;
    struct stage_axes axes; /* of the font */
    double time_s, forgotten_s;
    int fit_px[2]; /* the picture that fit_size_px is for */
    double fit_size_px;
};

struct keys_actor_def keys_actor_def_default(void)
{
    return (struct keys_actor_def){.range = {48, 72}, .keys = keys_def_default()};
}

/* ---- controls ---- */

static double *setting(struct keys_actor *k, int index)
{
    struct settings *s = &k->set;
    double *const all[OWN_ROWS] = {&s->size, &s->attack, &s->release, &s->pressure, &s->slant};
    return all[index];
}

static double row_read(void *actor, int index)
{
    return *setting(actor, index);
}

static unsigned row_write(void *actor, int index, double value)
{
    struct keys_actor *k = actor;
    *setting(k, index) = value;
    k->score.def = (struct keys_def){
        .attack_s = k->set.attack, .release_s = k->set.release, .pressure = k->set.pressure};
    return STAGE_OK;
}

static const struct control own_rows[OWN_ROWS] = {
    {"size", "", 0.05, 4, 1, CONTROL_LOGARITHMIC, NULL, "of all letters; 1 is as large as fits",
     row_read, row_write, 0},
    {"attack", "s", 0, 2, 0.03, CONTROL_LOGARITHMIC, NULL,
     "until a letter is as large as its velocity", row_read, row_write, 1},
    {"release", "s", 0, 10, 0.25, CONTROL_LOGARITHMIC, NULL, "until it is a third, once let go",
     row_read, row_write, 2},
    {"pressure", "", 0, 1, 1, CONTROL_LINEAR, NULL, "what aftertouch adds", row_read, row_write,
     3},
    {"slant", "", -1, 1, 0, CONTROL_LINEAR, NULL, "to the right for each up", row_read,
     row_write, 4}};

static double axis_read(void *actor, int index)
{
    return *stage_axes_setting(&((struct keys_actor *)actor)->set.axes, index);
}

static unsigned axis_write(void *actor, int index, double value)
{
    struct keys_actor *k = actor;
    return stage_axes_write(&k->axes, &k->set.axes, index, value);
}

static const struct control *keys_controls(void *actor, int *count)
{
    const struct keys_actor *k = actor;
    *count = k->rows_count;
    return k->rows;
}

/* ---- time ---- */

static enum stage_status keys_step(void *actor, double dt_s)
{
    struct keys_actor *k = actor;
    k->time_s += dt_s;
    if (k->time_s > k->forgotten_s + FORGET_S) {
        keys_score_forget(&k->score, k->time_s);
        k->forgotten_s = k->time_s;
    }
    return STAGE_OK;
}

/* What sounds goes on with these letters. */
static void letters_put(struct keys_actor *k, const struct keys_letters *letters)
{
    if (memcmp(&k->letters, letters, sizeof *letters) == 0)
        return;
    k->letters = *letters;
    k->fit_px[0] = k->fit_px[1] = 0; /* they may be wider */
}

static enum stage_status keys_text(void *actor, const char *words)
{
    struct keys_actor *k = actor;
    struct keys_letters letters;
    const enum stage_status status = keys_places_text(&k->score, words, &letters);
    if (status == STAGE_OK)
        letters_put(k, &letters);
    return status;
}

/* Nothing sounds any more; its keys have their places still. */
static enum stage_status silence(struct keys_actor *k)
{
    struct keys_score fresh;
    if (!keys_score_begin(&k->score.def, &fresh)) {
        keys_score_finish(&fresh);
        return stage_fail(STAGE_NO_MEMORY, "no memory for notes");
    }
    memcpy(fresh.keys, k->score.keys, sizeof fresh.keys);
    memcpy(fresh.rank, k->score.rank, sizeof fresh.rank);
    fresh.keys_count = k->score.keys_count;
    keys_score_finish(&k->score);
    k->score = fresh;
    return STAGE_OK;
}

struct kept {
    struct settings set;
    struct keys_letters letters;
};

static enum stage_status keys_keep(void *actor, void **state)
{
    const struct keys_actor *k = actor;
    struct kept *kept = malloc(sizeof *kept);
    *state = kept;
    if (!kept)
        return stage_fail(STAGE_NO_MEMORY, "no memory to keep letters as they are");
    kept->set = k->set;
    kept->letters = k->letters;
    return STAGE_OK;
}

static enum stage_status keys_restore(void *actor, const void *state)
{
    struct keys_actor *k = actor;
    const struct kept *kept = state;
    enum stage_status status = silence(k);
    if (status != STAGE_OK)
        return status;
    letters_put(k, &kept->letters);
    k->set = kept->set;
    stage_axes_put(&k->axes, &k->set.axes);
    return row_write(k, 0, k->set.size); /* all that the score is told of */
}

static enum stage_status keys_play(void *actor, const uint8_t *bytes)
{
    struct keys_actor *k = actor;
    uint8_t played[3] = {bytes[0], bytes[1], 0};
    if (bytes[0] < MIDI_NOTE_OFF || bytes[0] >= MIDI_SYSEX)
        return STAGE_OK;
    const int kind = bytes[0] & 0xf0;
    if (kind != MIDI_PRESSURE && kind != MIDI_PROGRAM)
        played[2] = bytes[2];
    if (kind == MIDI_NOTE_ON || kind == MIDI_NOTE_OFF || kind == MIDI_POLY_PRESSURE)
        played[1] = (uint8_t)keys_places_near(&k->score, bytes[1]);
    return keys_score_take(&k->score, k->time_s, played)
               ? STAGE_OK
               : stage_fail(STAGE_NO_MEMORY, "no memory for notes");
}

/* ---- pictures ---- */

static void size_fit(struct keys_actor *k, const struct stage_look *look)
{
    if (k->fit_px[0] == look->width_px && k->fit_px[1] == look->height_px)
        return;
    k->fit_px[0] = look->width_px;
    k->fit_px[1] = look->height_px;
    if (keys_type_fit(k->face, &k->score, &k->letters, look->width_px, look->height_px,
                      &k->fit_size_px) != FONT_OK)
        k->fit_size_px = look->height_px / 4.0;
}

/* Sheared along its baseline, and with the axes that its note leads to. */
static void glyphs_finish(const struct keys_actor *k, struct stage_draw_list *list, int begin,
                          const struct stage_letter_axes *axes)
{
    for (int i = begin; i < list->count; i++) {
        struct stage_glyph *g = &list->items[i].glyph;
        g->map = (struct font_map){FONT_AFFINE, {1, -k->set.slant, 0, 0, 1, 0}};
        if (g->face == k->face)
            g->axes = *axes;
    }
}

/* The axes of the letter of the key at a place, which that note plays. */
static struct stage_letter_axes axes_of(const struct keys_actor *k, int place, int note,
                                        double time_s)
{
    struct stage_letter_axes axes = {0};
    if (note < 0 || !stage_axes_led(&k->axes, &k->set.axes))
        return axes;
    const double last = k->score.keys_count - 1;
    const double parts[LEADS] = {[VELOCITY] = k->score.notes[note].velocity,
                                 [PRESSURE] = keys_note_pressure(&k->score, note, time_s),
                                 [PITCH] = last > 0 ? 2 * place / last - 1 : 0};
    stage_axes_of(&k->axes, &k->set.axes, parts, &axes);
    return axes;
}

static void letter_draw(struct keys_actor *k, int key, double size, double x, double y,
                        const struct stage_look *look, const struct stage_letter_axes *axes,
                        struct stage_color color, struct stage_draw_list *list)
{
    struct stage_letter_axes before;
    struct font_layout layout = {0};
    const char *letter = k->letters.of[key];
    if (size < 0.5 || !letter[0])
        return;
    size = fmin(size, FONT_SIDE_MAX / 2);
    stage_letter_axes_put(k->face, axes, &before); /* it may be wider so */
    if (font_shaper_layout(k->shaper, letter, strlen(letter), size, NULL, &layout) == FONT_OK) {
        const double half = layout.width_px / 2; /* whole, also at the edges */
        const int begin = list->count;
        x = fmax(half, fmin(x, look->width_px - half)) - half;
        stage_draw_text(list, &layout, x, y, color);
        glyphs_finish(k, list, begin, axes);
    }
    stage_letter_axes_put(k->face, &before, NULL);
    font_layout_finish(&layout);
}

static void keys_draw(void *actor, const struct stage_look *look, struct stage_draw_list *list)
{
    static const enum stage_theme_color inks[CHANNEL_COLORS] = {
        STAGE_COLOR_LETTER, STAGE_COLOR_SPRING_STRETCHED, STAGE_COLOR_SPRING_SQUEEZED,
        STAGE_COLOR_MASS_HELD};
    struct keys_actor *k = actor;
    const double time_s = k->time_s + look->fraction * look->step_s;
    size_fit(k, look);
    const double most = k->fit_size_px * k->set.size,
                 part = FILL * look->width_px / k->score.keys_count;
    const double left = (1 - FILL) / 2 * look->width_px;
    stage_draw_view(list, STAGE_VIEW_PIXELS);
    for (int i = 0; i < k->score.keys_count; i++) {
        int note;
        const double level = keys_key_level(&k->score, k->score.keys[i], time_s, &note);
        const int channel = note < 0 ? 0 : k->score.notes[note].channel;
        const struct stage_letter_axes axes = axes_of(k, i, note, time_s);
        letter_draw(k, k->score.keys[i], most * level, left + (i + 0.5) * part,
                    look->height_px / 2.0 + 0.25 * most, look, &axes,
                    look->theme->colors[inks[channel % CHANNEL_COLORS]], list);
    }
}

/* ---- an actor ---- */

static void keys_destroy(void *actor)
{
    struct keys_actor *k = actor;
    font_shaper_destroy(k->shaper);
    keys_score_finish(&k->score);
    free(k);
}

static const struct stage_actor_kind keys_kind = {.name = "keys",
                                                  .controls = keys_controls,
                                                  .step = keys_step,
                                                  .draw = keys_draw,
                                                  .play = keys_play,
                                                  .keep = keys_keep,
                                                  .restore = keys_restore,
                                                  .forget = free,
                                                  .text = keys_text,
                                                  .destroy = keys_destroy};

enum stage_status keys_actor_create(const struct keys_actor_def *def, struct stage_actor *out)
{
    *out = (struct stage_actor){0};
    struct keys_actor *k = calloc(1, sizeof *k);
    if (!k)
        return stage_fail(STAGE_NO_MEMORY, "no memory for letters");
    k->face = def->face;
    k->set = (struct settings){.size = 1,
                               .attack = def->keys.attack_s,
                               .release = def->keys.release_s,
                               .pressure = def->keys.pressure};
    memcpy(k->rows, own_rows, sizeof own_rows);
    k->rows_count = OWN_ROWS;
    stage_axes_find(&k->axes, &k->set.axes, k->face, leads, LEADS, "slant");
    k->rows_count += stage_axes_rows(&k->axes, k->rows + OWN_ROWS, axis_read, axis_write);
    enum stage_status status = STAGE_OK;
    if (!keys_score_begin(&def->keys, &k->score) ||
        font_shaper_create(k->face, &k->shaper) != FONT_OK)
        status = stage_fail(STAGE_NO_MEMORY, "no memory for letters");
    if (status == STAGE_OK)
        status = keys_places_make(def, &k->score, &k->letters);
    if (status != STAGE_OK) {
        keys_destroy(k);
        return status;
    }
    *out = (struct stage_actor){&keys_kind, k};
    return STAGE_OK;
}

enum stage_status keys_actor_play(const struct stage_actor *actor, const uint8_t *bytes)
{
    return keys_play(actor->self, bytes);
}

double keys_actor_level(const struct stage_actor *actor, int key)
{
    const struct keys_actor *k = actor->self;
    return keys_key_level(&k->score, key, k->time_s, NULL);
}
