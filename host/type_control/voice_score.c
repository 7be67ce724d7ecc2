/* voice_score.c - see voice_score.h. */
#include "voice_score.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define OPEN_LEAST_HZ 250.0
#define OPEN_MOST_HZ 850.0
#define FRONT_LEAST_HZ 700.0
#define FRONT_MOST_HZ 2400.0
#define RISE_S 0.06 /* the longest rise of an attack */
#define SMOOTH 0.35 /* of the way to a new pitch or vowel in each frame */

/* ---- mappings ---- */

static const char *const features[VOICE_FEATURES] = {"nothing", "envelope", "level", "pitch",
                                                     "clarity", "open",     "front", "vowel"};
static const char *const properties[TYPE_PROPERTIES] = {"size",  "weight",   "width",
                                                        "slant", "baseline", "ink"};

struct voice_mapping voice_mapping_default(void)
{
    return (struct voice_mapping){.feature = {[TYPE_SIZE] = VOICE_ENVELOPE}};
}

static int name_find(const char *const *names, int count, const char *text, size_t length)
{
    for (int i = 0; i < count; i++)
        if (strlen(names[i]) == length && memcmp(names[i], text, length) == 0)
            return i;
    return -1;
}

static bool name_wrong(const char *what, const char *text, size_t length,
                       const char *const *names, int count, char *why, size_t room)
{
    int at = snprintf(why, room, "there is no %s '%.*s'; there are", what,
                      (int)(length < 40 ? length : 40), text);
    for (int i = 0; i < count && at >= 0 && (size_t)at < room; i++)
        at += snprintf(why + at, room - (size_t)at, "%s %s", i ? "," : "", names[i]);
    return false;
}

bool voice_mapping_read(struct voice_mapping *mapping, const char *text, char *why, size_t room)
{
    struct voice_mapping made = *mapping;
    for (;;) {
        size_t left = strcspn(text, "=,"), right = 0;
        if (text[left] != '=') {
            snprintf(why, room, "a mapping is like size=envelope,baseline=pitch (got '%.60s')",
                     text);
            return false;
        }
        const char *feature = text + left + 1;
        right = strcspn(feature, ",");
        int p = name_find(properties, TYPE_PROPERTIES, text, left),
            f = name_find(features, VOICE_FEATURES, feature, right);
        if (p < 0)
            return name_wrong("property", text, left, properties, TYPE_PROPERTIES, why, room);
        if (f < 0)
            return name_wrong("feature", feature, right, features, VOICE_FEATURES, why, room);
        if (f == VOICE_VOWEL && p != TYPE_INK) {
            snprintf(why, room,
                     "a vowel is two numbers and plays ink only; %s takes open or front",
                     properties[p]);
            return false;
        }
        made.feature[p] = (enum voice_feature)f;
        if (!feature[right])
            break;
        text = feature + right + 1;
    }
    *mapping = made;
    return true;
}

/* ---- scores ---- */

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Finds the range of the pitches, without rare ones. */
static bool pitches_measure(struct voice_score *s)
{
    double *octaves = malloc(sizeof *octaves * (size_t)(s->count ? s->count : 1));
    int count = 0;
    if (!octaves)
        return false;
    for (int i = 0; i < s->count; i++)
        if (s->frames[i].pitch_hz > 0)
            octaves[count++] = log2(s->frames[i].pitch_hz);
    qsort(octaves, (size_t)count, sizeof *octaves, ascending);
    s->pitch_octave[0] = count ? octaves[count / 20] : 0;
    s->pitch_octave[1] = count ? octaves[count - 1 - count / 20] : 1;
    if (s->pitch_octave[1] - s->pitch_octave[0] < 1.0 / 12) /* one note: its middle */
        s->pitch_octave[0] = (s->pitch_octave[0] + s->pitch_octave[1]) / 2 - 0.5,
        s->pitch_octave[1] = s->pitch_octave[0] + 1;
    free(octaves);
    return true;
}

static double part(double x, double least, double most)
{
    return fmin(1, fmax(0, (x - least) / (most - least)));
}

/* Missing values repeat the last one before; those at the beginning repeat the first. */
static void kept_make(double *kept, const double *values, int count)
{
    double now = -1;
    for (int i = 0; i < count; i++) {
        if (values[i] >= 0)
            now = now < 0 ? values[i] : now + SMOOTH * (values[i] - now);
        kept[i] = now;
    }
    double first = 0.5;
    for (int i = count - 1; i >= 0; i--)
        if (kept[i] >= 0)
            first = kept[i];
        else
            kept[i] = first;
}

static bool kept_all(struct voice_score *s)
{
    size_t bytes = sizeof(double) * (size_t)(s->count ? s->count : 1);
    double *values = malloc(bytes);
    s->pitch_kept = malloc(bytes);
    s->open_kept = malloc(bytes);
    s->front_kept = malloc(bytes);
    bool memory = values && s->pitch_kept && s->open_kept && s->front_kept;
    for (int what = 0; what < 3 && memory; what++) {
        for (int i = 0; i < s->count; i++) {
            const struct voice_frame *f = &s->frames[i];
            double hz = what == 0 ? f->pitch_hz : f->formant_hz[what - 1];
            values[i] = hz <= 0     ? -1
                        : what == 0 ? part(log2(hz), s->pitch_octave[0], s->pitch_octave[1])
                        : what == 1 ? part(hz, OPEN_LEAST_HZ, OPEN_MOST_HZ)
                                    : part(hz, FRONT_LEAST_HZ, FRONT_MOST_HZ);
        }
        kept_make(what == 0   ? s->pitch_kept
                  : what == 1 ? s->open_kept
                              : s->front_kept,
                  values, s->count);
    }
    free(values);
    return memory;
}

/* Where the envelope began to rise: an attack is known where a sound has risen most in 50 ms,
 * which is near the end of its rise. */
static double rise_begin_s(const struct voice_score *s, int attack)
{
    const struct voice_frame *f = s->frames;
    int i = attack;
    while (i > 0 && f[i - 1].envelope < f[i].envelope &&
           f[i - 1].time_s >= f[attack].time_s - RISE_S)
        i--;
    return s->begins ? fmax(f[i].time_s, s->begin_s[s->begins - 1]) : f[i].time_s;
}

/* Sounds begin at attacks; sound before the first attack begins where it becomes audible. */
static bool begins_find(struct voice_score *s, double silence)
{
    s->begin_s = malloc(sizeof *s->begin_s * (size_t)(s->count + 1));
    if (!s->begin_s)
        return false;
    for (int i = 0; i < s->count; i++) {
        const struct voice_frame *f = &s->frames[i];
        bool heard = f->envelope > silence * s->loudest;
        if (heard)
            s->end_s = f->time_s;
        if (f->attack || (heard && s->begins == 0))
            s->begin_s[s->begins++] = f->attack ? rise_begin_s(s, i) : f->time_s;
    }
    /* a sound that begins just after the voice becomes audible is the same one */
    if (s->begins > 1 && s->begin_s[1] - s->begin_s[0] < 0.1) {
        memmove(s->begin_s, s->begin_s + 1, sizeof *s->begin_s * (size_t)(s->begins - 1));
        s->begins--;
    }
    while (s->begins > 1 && s->begin_s[s->begins - 1] >= s->end_s)
        s->begins--;
    return true;
}

bool voice_score_make(const struct voice_frame *frames, int count, double silence,
                      struct voice_score *out, bool *empty)
{
    *out = (struct voice_score){.frames = frames, .count = count};
    *empty = true;
    for (int i = 0; i < count; i++) {
        out->loudest = fmax(out->loudest, frames[i].envelope);
        out->loudest_level = fmax(out->loudest_level, frames[i].level);
        out->seconds = frames[i].time_s;
    }
    if (out->loudest <= 0)
        return false;
    *empty = false;
    if (pitches_measure(out) && kept_all(out) && begins_find(out, silence))
        return true;
    voice_score_finish(out);
    return false;
}

void voice_score_finish(struct voice_score *s)
{
    free(s->pitch_kept);
    free(s->open_kept);
    free(s->front_kept);
    free(s->begin_s);
    *s = (struct voice_score){0};
}

static double frame_value(const struct voice_score *s, enum voice_feature feature, int i)
{
    switch (feature) {
    case VOICE_ENVELOPE:
        return s->frames[i].envelope / s->loudest;
    case VOICE_LEVEL:
        return s->loudest_level > 0 ? s->frames[i].level / s->loudest_level : 0;
    case VOICE_PITCH:
        return s->pitch_kept[i];
    case VOICE_CLARITY:
        return s->frames[i].clarity;
    case VOICE_OPEN:
    case VOICE_VOWEL:
        return s->open_kept[i];
    case VOICE_FRONT:
        return s->front_kept[i];
    case VOICE_NOTHING:
    case VOICE_FEATURES:
        break;
    }
    return 0;
}

double voice_score_at(const struct voice_score *s, enum voice_feature feature, double time_s)
{
    double at = s->seconds > 0 ? time_s / s->seconds * (s->count - 1) : 0;
    at = fmin(s->count - 1, fmax(0, at));
    int i = (int)at, next = i + 1 < s->count ? i + 1 : i;
    return frame_value(s, feature, i) +
           (at - i) * (frame_value(s, feature, next) - frame_value(s, feature, i));
}
