/* keys_score.c - see keys_score.h. */
#include "keys_score.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SUSTAIN = 64, ALL_SOUND_OFF = 120, ALL_NOTES_OFF = 123 };

/* Relative size below which a letter is invisible. */
#define FADED 1e-3

struct keys_def keys_def_default(void)
{
    return (struct keys_def){.attack_s = 0.03, .release_s = 0.25, .pressure = 1};
}

/* The keys that are down while messages are read. */
struct keys_hands {
    int notes_room, pressures_room;
    int sounding[MIDI_CHANNELS][MIDI_NOTES]; /* 1 + the note's index; 0: none */
    bool kept[MIDI_CHANNELS][MIDI_NOTES];    /* released while the pedal is down */
    bool pedal[MIDI_CHANNELS];
    double time_s;
    bool failed;
};

static void *one_more(struct keys_hands *r, void *items, int count, int *room, size_t bytes)
{
    if (count < *room)
        return items;
    const int wanted = *room ? 2 * *room : 256;
    void *grown = realloc(items, (size_t)wanted * bytes);
    if (!grown) {
        r->failed = true;
        return items;
    }
    *room = wanted;
    return grown;
}

static void note_end(struct keys_score *s, int channel, int note)
{
    struct keys_hands *r = s->hands;
    const int index = r->sounding[channel][note] - 1;
    if (index >= 0)
        s->notes[index].end_s = r->time_s;
    r->sounding[channel][note] = 0;
    r->kept[channel][note] = false;
}

static void note_begin(struct keys_score *s, int channel, int note, int velocity)
{
    struct keys_hands *r = s->hands;
    note_end(s, channel, note);
    s->notes = one_more(r, s->notes, s->notes_count, &r->notes_room, sizeof *s->notes);
    if (r->failed)
        return;
    s->notes[s->notes_count++] = (struct keys_note){.note = note,
                                                    .channel = channel,
                                                    .begin_s = r->time_s,
                                                    .end_s = INFINITY,
                                                    .velocity = velocity / 127.0,
                                                    .release = 0.5};
    r->sounding[channel][note] = s->notes_count;
}

static void note_let_go(struct keys_score *s, int channel, int note, int velocity)
{
    struct keys_hands *r = s->hands;
    const int index = r->sounding[channel][note] - 1;
    if (index < 0)
        return;
    s->notes[index].release = velocity / 127.0;
    if (r->pedal[channel])
        r->kept[channel][note] = true;
    else
        note_end(s, channel, note);
}

static void pedal_set(struct keys_score *s, int channel, bool down)
{
    struct keys_hands *r = s->hands;
    r->pedal[channel] = down;
    for (int i = 0; i < MIDI_NOTES && !down; i++)
        if (r->kept[channel][i])
            note_end(s, channel, i);
}

static void pressure_add(struct keys_score *s, int channel, int note, int value)
{
    struct keys_hands *r = s->hands;
    s->pressures =
        one_more(r, s->pressures, s->pressures_count, &r->pressures_room, sizeof *s->pressures);
    if (!r->failed)
        s->pressures[s->pressures_count++] =
            (struct keys_pressure){r->time_s, value / 127.0, note, channel};
}

static void control_take(struct keys_score *s, int channel, int control, int value)
{
    if (control == SUSTAIN)
        pedal_set(s, channel, value >= 64);
    if (control != ALL_SOUND_OFF && control != ALL_NOTES_OFF)
        return;
    for (int i = 0; i < MIDI_NOTES; i++)
        note_let_go(s, channel, i, 64);
}

bool keys_score_take(struct keys_score *s, double time_s, const uint8_t *bytes)
{
    const int channel = bytes[0] & 15, data = bytes[1];
    s->hands->time_s = time_s;
    switch (bytes[0] & 0xf0) {
    case MIDI_NOTE_ON:
        if (bytes[2])
            note_begin(s, channel, data, bytes[2]);
        else
            note_let_go(s, channel, data, 64);
        break;
    case MIDI_NOTE_OFF:
        note_let_go(s, channel, data, bytes[2]);
        break;
    case MIDI_POLY_PRESSURE:
        pressure_add(s, channel, data, bytes[2]);
        break;
    case MIDI_PRESSURE:
        pressure_add(s, channel, -1, data);
        break;
    case MIDI_CONTROL:
        control_take(s, channel, data, bytes[2]);
        break;
    default:
        break;
    }
    return !s->hands->failed;
}

bool keys_score_begin(const struct keys_def *def, struct keys_score *out)
{
    *out = (struct keys_score){.def = *def, .hands = calloc(1, sizeof *out->hands)};
    return out->hands != NULL;
}

void keys_score_range(struct keys_score *s, int lowest, int highest)
{
    s->keys_count = 0;
    for (int i = 0; i < MIDI_NOTES; i++) {
        const bool in = i >= lowest && i <= highest;
        s->rank[i] = in ? s->keys_count : -1;
        if (in)
            s->keys[s->keys_count++] = i;
    }
}

/* Pressures matter from the beginning of a sounding note on; of those before `last_s`, the last
 * one of each key and channel. */
static void pressures_forget(struct keys_score *s, double before_s, double last_s)
{
    bool seen[MIDI_CHANNELS][1 + MIDI_NOTES] = {{false}};
    int first = s->pressures_count;
    for (int i = s->pressures_count - 1; i >= 0; i--) {
        const struct keys_pressure p = s->pressures[i];
        bool *later = &seen[p.channel][1 + p.note];
        if (p.time_s < before_s || (p.time_s < last_s && *later))
            continue;
        *later = *later || p.time_s < last_s;
        s->pressures[--first] = p;
    }
    s->pressures_count -= first;
    if (first > 0)
        memmove(s->pressures, s->pressures + first,
                (size_t)s->pressures_count * sizeof *s->pressures);
}

void keys_score_forget(struct keys_score *s, double time_s)
{
    double first_s = time_s, last_s = time_s;
    int kept = 0;
    for (int i = 0; i < s->notes_count; i++) {
        const struct keys_note n = s->notes[i];
        if (n.end_s < time_s && keys_note_level(s, i, time_s) < FADED)
            continue;
        if (s->hands->sounding[n.channel][n.note] == i + 1)
            s->hands->sounding[n.channel][n.note] = kept + 1;
        first_s = fmin(first_s, n.begin_s);
        last_s = fmin(last_s, n.end_s); /* a note that fades has the pressure of its end */
        s->notes[kept++] = n;
    }
    s->notes_count = kept;
    pressures_forget(s, first_s, last_s);
}

/* Finds the keys that are played, from the lowest; notes without an end last to the song's
 * end. */
static void keys_find(struct keys_score *s)
{
    bool played[MIDI_NOTES] = {false};
    for (int i = 0; i < s->notes_count; i++) {
        played[s->notes[i].note] = true;
        s->notes[i].end_s = fmin(s->notes[i].end_s, s->seconds);
    }
    for (int i = 0; i < MIDI_NOTES; i++) {
        s->rank[i] = played[i] ? s->keys_count : -1;
        if (played[i])
            s->keys[s->keys_count++] = i;
    }
}

bool keys_score_make(const struct keys_def *def, struct midi_song *song, struct keys_score *out,
                     bool *empty)
{
    const struct midi_song_info info = midi_song_info(song);
    bool good = keys_score_begin(def, out);
    for (size_t i = 0; good && i < info.events_count; i++) {
        const struct midi_song_event e = midi_song_event(song, i);
        if (e.kind == MIDI_SONG_MESSAGE)
            good = keys_score_take(out, (double)e.time_ns / 1e9, e.bytes);
    }
    out->seconds = (double)info.end_ns / 1e9;
    *empty = good && out->notes_count == 0;
    if (!good || *empty) {
        keys_score_finish(out);
        return false;
    }
    keys_find(out);
    return true;
}

void keys_score_finish(struct keys_score *s)
{
    free(s->notes);
    free(s->pressures);
    free(s->hands);
    *s = (struct keys_score){0};
}

/* The first aftertouch at a time or after it. */
static int pressure_first(const struct keys_score *s, double time_s)
{
    int first = 0, end = s->pressures_count;
    while (first < end) {
        const int middle = first + (end - first) / 2;
        if (s->pressures[middle].time_s < time_s)
            first = middle + 1;
        else
            end = middle;
    }
    return first;
}

/* The last aftertouch of the key or its channel since the note began; 0: none. */
static double pressure_at(const struct keys_score *s, const struct keys_note *n, double time_s)
{
    double value = 0;
    for (int i = pressure_first(s, n->begin_s);
         i < s->pressures_count && s->pressures[i].time_s <= time_s; i++) {
        const struct keys_pressure *p = &s->pressures[i];
        if (p->channel == n->channel && (p->note == n->note || p->note < 0))
            value = p->value;
    }
    return value;
}

double keys_note_level(const struct keys_score *s, int index, double time_s)
{
    const struct keys_note *n = &s->notes[index];
    if (time_s < n->begin_s)
        return 0;
    const double until_s = fmin(time_s, n->end_s);
    const double rise =
        s->def.attack_s > 0 ? fmin(1, (until_s - n->begin_s) / s->def.attack_s) : 1;
    const double held =
        n->velocity + (1 - n->velocity) * s->def.pressure * pressure_at(s, n, until_s);
    if (time_s <= n->end_s)
        return rise * held;
    /* released quickly, it shrinks twice as fast as at the middle velocity; slowly, half as
     * fast */
    const double fall_s = s->def.release_s * exp2(1 - 2 * n->release);
    return fall_s > 0 ? rise * held * exp(-(time_s - n->end_s) / fall_s) : 0;
}

double keys_note_pressure(const struct keys_score *s, int index, double time_s)
{
    return pressure_at(s, &s->notes[index], fmin(time_s, s->notes[index].end_s));
}

double keys_key_level(const struct keys_score *s, int key, double time_s, int *index)
{
    double most = 0;
    int which = -1;
    for (int i = 0; i < s->notes_count && s->notes[i].begin_s <= time_s; i++) {
        const double level = s->notes[i].note == key ? keys_note_level(s, i, time_s) : 0;
        if (level > most) {
            most = level;
            which = i;
        }
    }
    if (index)
        *index = which;
    return most;
}

double keys_note_most(const struct keys_score *s, int index)
{
    const struct keys_note *n = &s->notes[index];
    double most = n->velocity;
    for (int i = pressure_first(s, n->begin_s);
         i < s->pressures_count && s->pressures[i].time_s <= n->end_s; i++) {
        const struct keys_pressure *p = &s->pressures[i];
        if (p->channel == n->channel && (p->note == n->note || p->note < 0))
            most = fmax(most, n->velocity + (1 - n->velocity) * s->def.pressure * p->value);
    }
    return most;
}
