/* knobs.c - see knobs.h. */
#include "knobs.h"

#include <midi_fine.h>
#include <midi_time.h>

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double save_after_s = 1, pair_within_s = 0.5;

struct knobs {
    struct stage *stage;
    const struct control *rows;
    int rows_count;
    char *path;
    struct knobs_text text;
    int learning; /* a row; -1: none */
    struct midi_fine fine;
    /* Upper bits whose lower ones have not come: they move their knobs at the next frame. */
    struct midi_fine_value upper;
    bool has_upper;
    /* What was just learnt, and when: lower bits that follow make it a pair. */
    int learnt_row;
    double learnt_s;
    double now_s;     /* of the last frame */
    double changed_s; /* NaN: all is saved */
    /* A scene that is being reached: from where each control began. */
    int fading; /* 0: none */
    double fade_began_s;
    double *from, *to; /* by row, along; to is NaN: the scene does not set it */
    char words[64], told[200];
    bool has_told;
};

__attribute__((format(printf, 2, 3))) static void told(struct knobs *k, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(k->told, sizeof k->told, format, arguments);
    va_end(arguments);
    k->has_told = true;
}

const char *knobs_said(struct knobs *k)
{
    const bool has = k->has_told;
    k->has_told = false;
    return has ? k->told : NULL;
}

static void changed(struct knobs *k)
{
    k->changed_s = k->now_s;
}

static void save(struct knobs *k)
{
    if (isnan(k->changed_s))
        return;
    k->changed_s = NAN;
    if (knobs_file_write(&k->text, k->path) != STAGE_OK)
        told(k, "%s", stage_error());
}

/* ---- opening ---- */

/* Each name must be a control's, and each value one of its. */
static enum stage_status names_check(const struct knobs *k)
{
    double value;
    for (int i = 0; i < k->text.rows_count; i++)
        if (!stage_control_find(k->rows, k->rows_count, k->text.rows[i].control))
            return stage_fail(STAGE_BAD_FILE, "%.200s: %.800s", k->path, stage_error());
    for (int i = 0; i < k->text.sets_count; i++) {
        const struct knobs_set *set = &k->text.sets[i];
        const struct control *row = stage_control_find(k->rows, k->rows_count, set->control);
        if (!row || stage_control_parse(row, set->value, &value) != STAGE_OK)
            return stage_fail(STAGE_BAD_FILE, "%.200s: scene %d: %.800s", k->path, set->scene,
                              stage_error());
        if (!(value >= row->least && value <= row->most))
            return stage_fail(STAGE_BAD_FILE, "%.200s: scene %d: %s must be %g..%g (got %g)",
                              k->path, set->scene, row->name, row->least, row->most, value);
    }
    return STAGE_OK;
}

enum stage_status knobs_open(struct stage *stage, const char *path, const char *theme,
                             bool is_there, struct knobs **out)
{
    struct knobs *k = calloc(1, sizeof *k);
    *out = NULL;
    if (!k)
        return stage_fail(STAGE_NO_MEMORY, "no memory for knobs");
    k->stage = stage;
    k->rows = stage_controls(stage, &k->rows_count);
    k->learning = k->learnt_row = -1;
    k->changed_s = NAN;
    k->path = strdup(path);
    k->from = calloc((size_t)k->rows_count, sizeof *k->from);
    k->to = calloc((size_t)k->rows_count, sizeof *k->to);
    enum stage_status status = k->path && k->from && k->to
                                   ? STAGE_OK
                                   : stage_fail(STAGE_NO_MEMORY, "no memory for knobs");
    const bool is_new = !is_there && access(path, F_OK) != 0 && errno == ENOENT;
    if (status == STAGE_OK && !is_new)
        status = knobs_file_read(path, &k->text);
    else if (theme && strlen(theme) < sizeof k->text.theme && !strpbrk(theme, " \t\r\n"))
        memcpy(k->text.theme, theme, strlen(theme) + 1);
    if (status == STAGE_OK)
        status = names_check(k);
    if (status == STAGE_OK)
        *out = k;
    else
        knobs_close(k);
    return status;
}

void knobs_close(struct knobs *k)
{
    if (!k)
        return;
    save(k);
    knobs_text_finish(&k->text);
    free(k->path);
    free(k->from);
    free(k->to);
    free(k);
}

/* ---- what moves ---- */

static struct knobs_row *row_of(struct knobs *k, int row)
{
    for (int i = 0; i < k->text.rows_count && row >= 0 && row < k->rows_count; i++)
        if (strcmp(k->text.rows[i].control, k->rows[row].name) == 0)
            return &k->text.rows[i];
    return NULL;
}

static void row_move(struct knobs *k, const struct knobs_row *r, double part)
{
    const struct control *row = stage_control_find(k->rows, k->rows_count, r->control);
    const double along = r->from + part * (r->to - r->from);
    if (row && stage_control_write(row, k->stage, control_at(row, along)) != STAGE_OK)
        told(k, "%s", stage_error());
}

static void knob_move(struct knobs *k, const struct knob *knob, double part)
{
    for (int i = 0; i < k->text.rows_count; i++) {
        const struct knobs_row *r = &k->text.rows[i];
        if (r->knob.kind == knob->kind && r->knob.number == knob->number &&
            (r->knob.channel < 0 || r->knob.channel == knob->channel))
            row_move(k, r, part);
    }
}

/* The knob that a message is of, and how far it is turned, 0..1. False: none. */
static bool knob_of(const struct midi_message *m, struct knob *knob, double *part)
{
    enum { MODES = 120 }; /* controllers from here on are channel modes, not knobs */
    *knob = (struct knob){.channel = midi_message_channel(m)};
    if (knob->channel < 0)
        return false;
    switch (m->bytes[0] & 0xf0) {
    case MIDI_CONTROL:
        knob->kind = KNOB_CONTROL;
        knob->number = m->bytes[1];
        *part = m->bytes[2] / 127.0;
        return knob->number < MODES;
    case MIDI_BEND:
        knob->kind = KNOB_BEND;
        *part = (m->bytes[1] + 128 * m->bytes[2]) / 16383.0;
        return true;
    case MIDI_PRESSURE:
        knob->kind = KNOB_PRESSURE;
        *part = m->bytes[1] / 127.0;
        return true;
    case MIDI_NOTE_ON:
        knob->kind = KNOB_NOTE;
        knob->number = m->bytes[1];
        *part = m->bytes[2] / 127.0;
        return midi_message_strikes(m);
    default:
        return false;
    }
}

/* ---- learning ---- */

void knobs_learn(struct knobs *k, int row)
{
    const bool waits = row == k->learning || row < 0 || row >= k->rows_count;
    k->learning = waits ? -1 : row;
    if (!waits)
        told(k, "turn a knob for %s", k->rows[row].name);
}

static void learnt(struct knobs *k, int row, const struct knob *knob)
{
    struct knobs_row *r = row_of(k, row);
    const char *name = k->rows[row].name;
    k->learning = -1;
    k->learnt_row = row;
    k->learnt_s = k->now_s;
    if (!r && k->text.rows_count == KNOBS_MAX) {
        told(k, "%d knobs are the most", KNOBS_MAX);
        return;
    }
    if (!r) {
        r = &k->text.rows[k->text.rows_count++];
        *r = (struct knobs_row){.from = 0, .to = 1};
        snprintf(r->control, sizeof r->control, "%s", name);
    }
    r->knob = *knob;
    knob_words(knob, k->words, sizeof k->words);
    told(k, "%s moves %s", k->words, name);
    changed(k);
}

void knobs_end(struct knobs *k, int row, double along)
{
    struct knobs_row *r = row_of(k, row);
    if (!r)
        return;
    along = fmin(1, fmax(0, along));
    if (fabs(along - r->from) < fabs(along - r->to))
        r->from = along;
    else
        r->to = along;
    changed(k);
}

void knobs_forget(struct knobs *k, int row)
{
    struct knobs_row *r = row_of(k, row);
    k->learning = k->learnt_row = -1;
    if (!r)
        return;
    told(k, "no knob moves %s", r->control);
    *r = k->text.rows[--k->text.rows_count];
    changed(k);
}

bool knobs_of(struct knobs *k, int row, struct stage_panel_knob *out)
{
    const struct knobs_row *r = row_of(k, row);
    *out = (struct stage_panel_knob){.text = "turn a knob", .waits = row == k->learning};
    if (out->waits || !r)
        return out->waits;
    knob_words(&r->knob, k->words, sizeof k->words);
    out->text = k->words;
    out->from = r->from;
    out->to = r->to;
    return true;
}

/* ---- scenes ---- */

/* Leaves out the scene's lines. */
static void scene_drop(struct knobs_text *text, int scene)
{
    int kept = 0;
    for (int i = 0; i < text->sets_count; i++)
        if (text->sets[i].scene != scene)
            text->sets[kept++] = text->sets[i];
    text->sets_count = kept;
}

static void value_print(const struct control *row, double value, char out[KNOBS_NAME_BYTES])
{
    if (row->curve == CONTROL_SWITCH || row->curve == CONTROL_CHOICE)
        control_text(row, value, out, KNOBS_NAME_BYTES);
    else
        snprintf(out, KNOBS_NAME_BYTES, "%.17g", value);
}

enum stage_status knobs_scene_keep(struct knobs *k, int scene)
{
    if (scene < 1 || scene > KNOBS_SCENES)
        return stage_fail(STAGE_BAD_ARGUMENT, "a scene is 1..%d (got %d)", KNOBS_SCENES, scene);
    const int before = k->text.sets_count;
    for (int i = 0; i < k->rows_count; i++) {
        struct knobs_set set = {.scene = KNOBS_SCENES + 1}; /* until all of it is there */
        snprintf(set.control, sizeof set.control, "%s", k->rows[i].name);
        value_print(&k->rows[i], control_read(&k->rows[i], k->stage), set.value);
        const enum stage_status status = knobs_set_add(&k->text, &set);
        if (status != STAGE_OK) {
            k->text.sets_count = before;
            return status;
        }
    }
    scene_drop(&k->text, scene);
    for (int i = 0; i < k->text.sets_count; i++)
        if (k->text.sets[i].scene > KNOBS_SCENES)
            k->text.sets[i].scene = scene;
    told(k, "scene %d kept", scene);
    changed(k);
    return STAGE_OK;
}

/* How far the scene is reached: 1 at its end. Switches and choices change there. */
static void scene_move(struct knobs *k, double part)
{
    for (int i = 0; i < k->rows_count; i++) {
        const struct control *row = &k->rows[i];
        const bool whole = row->curve == CONTROL_SWITCH || row->curve == CONTROL_CHOICE;
        if (isnan(k->to[i]) || (whole && part < 1))
            continue;
        const double value =
            part < 1 ? control_at(row, k->from[i] +
                                           part * (control_along(row, k->to[i]) - k->from[i]))
                     : k->to[i];
        if (stage_control_write(row, k->stage, value) != STAGE_OK)
            told(k, "%s", stage_error());
    }
    if (part >= 1)
        k->fading = 0;
}

enum stage_status knobs_scene_play(struct knobs *k, int scene)
{
    bool found = false;
    for (int i = 0; i < k->rows_count; i++) {
        k->to[i] = NAN;
        k->from[i] = control_along(&k->rows[i], control_read(&k->rows[i], k->stage));
    }
    for (int i = 0; i < k->text.sets_count; i++) {
        const struct knobs_set *set = &k->text.sets[i];
        const struct control *row =
            set->scene == scene ? stage_control_find(k->rows, k->rows_count, set->control)
                                : NULL;
        found = found || row;
        if (row)
            stage_control_parse(row, set->value, &k->to[row - k->rows]);
    }
    k->fading = 0;
    if (!found)
        return stage_fail(STAGE_BAD_ARGUMENT, "there is no scene %d: Control 1 to 9 keeps one",
                          scene);
    const enum stage_status status = stage_mark(k->stage);
    if (status != STAGE_OK)
        return status;
    told(k, "scene %d", scene);
    k->fading = scene;
    k->fade_began_s = k->now_s;
    if (!(k->text.fade_s[scene] > 0))
        scene_move(k, 1);
    return STAGE_OK;
}

/* ---- 14 bits ---- */

static struct knob fine_knob(const struct midi_fine_value *value)
{
    return (struct knob){.kind = value->is_parameter ? KNOB_NRPN : KNOB_FINE,
                         .channel = value->channel,
                         .number = value->number};
}

static void upper_move(struct knobs *k)
{
    const struct knob knob = fine_knob(&k->upper);
    if (k->has_upper)
        knob_move(k, &knob, k->upper.value / (double)MIDI_FINE_MOST);
    k->has_upper = false;
}

/* A knob that is learnt by its upper bits becomes one of 14 bits when its lower ones follow. */
static void pair_learn(struct knobs *k, const struct knob *knob)
{
    const struct knobs_row *r = row_of(k, k->learnt_row);
    if (r && knob->kind == KNOB_FINE && r->knob.kind == KNOB_CONTROL &&
        r->knob.channel == knob->channel && r->knob.number == knob->number &&
        k->now_s <= k->learnt_s + pair_within_s)
        learnt(k, k->learnt_row, knob);
}

/* True: the message was a part of a parameter, and of nothing else. */
static bool fine_message(struct knobs *k, const struct midi_message *m)
{
    struct midi_fine_value value;
    const bool has = midi_fine_take(&k->fine, m, &value);
    const bool parameter = midi_fine_chooses(&k->fine, m);
    if (!has)
        return parameter && k->learning >= 0; /* what chooses is not learnt */
    const struct knob knob = fine_knob(&value);
    if (value.is_parameter && k->learning >= 0)
        learnt(k, k->learning, &knob);
    if (!value.is_whole) {
        upper_move(k); /* another one's, that has waited */
        k->upper = value;
        k->has_upper = true;
        return value.is_parameter;
    }
    pair_learn(k, &knob);
    if (k->has_upper && k->upper.is_parameter == value.is_parameter &&
        k->upper.channel == value.channel && k->upper.number == value.number)
        k->has_upper = false;
    knob_move(k, &knob, value.value / (double)MIDI_FINE_MOST);
    return value.is_parameter;
}

/* ---- time ---- */

void knobs_message(struct knobs *k, const struct midi_message *m)
{
    struct knob knob;
    double part;
    if ((m->bytes[0] & 0xf0) == MIDI_PROGRAM && midi_message_channel(m) >= 0) {
        if (k->text.sets_count && knobs_scene_play(k, m->bytes[1] + 1) != STAGE_OK)
            told(k, "%s", stage_error());
        return;
    }
    if (fine_message(k, m) || !knob_of(m, &knob, &part))
        return;
    if (k->learning >= 0)
        learnt(k, k->learning, &knob);
    knob_move(k, &knob, part);
}

/* The tempo's way: all that people play. */
static const double tempo_least = 40, tempo_most = 240;

static void beat_move(struct knobs *k, const struct beat *beat)
{
    double phase, per_minute;
    if (!beat || !beat_now(beat, midi_now_ns(), &phase, &per_minute))
        return;
    const double tempo = (per_minute - tempo_least) / (tempo_most - tempo_least);
    knob_move(k, &(struct knob){.kind = KNOB_CLOCK, .channel = -1}, phase);
    knob_move(k, &(struct knob){.kind = KNOB_TEMPO, .channel = -1}, fmin(1, fmax(0, tempo)));
}

void knobs_frame(struct knobs *k, double now_s, const struct beat *beat)
{
    k->now_s = now_s;
    upper_move(k);
    if (k->fading)
        scene_move(k, (now_s - k->fade_began_s) / k->text.fade_s[k->fading]);
    beat_move(k, beat);
    if (now_s > k->changed_s + save_after_s)
        save(k);
}
