/* voice.c - frames of a voice from samples in pieces.
 *
 *     samples ----------------------> level, envelope
 *        |
 *        '-- low-pass, every n-th --> pitch, formants, energy's upper part        about 11,000
 *                                                                                 a second
 *
 * Both streams are kept as far back as the next frame needs.
 */
#include "voice.h"

#include "voice_attack.h"
#include "voice_formants.h"
#include "voice_pitch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846
#define LEVEL_S 0.02
#define FORMANT_S 0.032
#define LOW_HZ 10000.0 /* the lower sampling rate is at least this */

/* Samples from number `begin` on. */
struct samples {
    float *at;
    long begin;
    size_t count, room;
};

struct voice {
    struct voice_def def;
    double rate_hz, low_hz; /* of the two streams */
    int factor;             /* samples for each sample of the lower rate */
    int taps;               /* of the low-pass, odd */
    float *low_pass;
    struct samples full, low;
    double envelope;
    struct voice_attack attack;
    struct voice_frame *frames; /* begun, and not taken */
    size_t frames_count, frames_room, frames_decided;
    long next; /* the number of the next frame */
    bool ended;
    int low_window; /* window of pitch and formants, in samples of the lower rate */
    float *piece, *pitch_room;
    double *formant_room;
};

struct voice_def voice_def_default(void)
{
    return (struct voice_def){.frames_hz = 100,
                              .rise_s = 0.01,
                              .fall_s = 0.08,
                              .pitch_hz = {70, 1100},
                              .attack = 1,
                              .attack_gap_s = 0.1,
                              .silence = 0.004};
}

static bool within(double x, double least, double most)
{
    return x >= least && x <= most;
}

const char *voice_def_wrong(const struct voice_def *def)
{
    if (!within(def->frames_hz, 20, 500))
        return "frames a second must be 20..500";
    if (!within(def->rise_s, 0, 2) || !within(def->fall_s, 0, 2))
        return "an envelope's rise and fall must be 0..2 seconds";
    if (!within(def->pitch_hz[0], 40, 2000) || !within(def->pitch_hz[1], 40, 2000) ||
        def->pitch_hz[1] < 1.5 * def->pitch_hz[0])
        return "pitches must be 40..2000 Hz, the highest 1.5 times the lowest or more";
    if (!within(def->attack, 0.05, 10) || !within(def->attack_gap_s, 0.01, 2))
        return "an attack must be 0.05..10 nepers, and the time between two 0.01..2 seconds";
    return within(def->silence, 0, 1) ? NULL : "silence must be 0..1";
}

/* ---- life ---- */

/* A windowed sinc (Hann), which passes frequencies below 0.45 of the lower rate. */
static void low_pass_make(float *taps, int count, int factor)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        double t = i - (count - 1) / 2.0, x = 2 * PI * 0.45 / factor * t;
        double value = (t == 0 ? 1 : sin(x) / x) * (1 + cos(2 * PI * t / (count + 1)));
        taps[i] = (float)value;
        sum += value;
    }
    for (int i = 0; i < count; i++)
        taps[i] /= (float)sum;
}

bool voice_create(const struct voice_def *def, int rate_hz, struct voice **out)
{
    struct voice *v = calloc(1, sizeof *v);
    *out = NULL;
    if (!v)
        return false;
    v->def = *def;
    v->rate_hz = rate_hz;
    v->factor = (int)fmax(1, floor(rate_hz / LOW_HZ));
    v->low_hz = v->rate_hz / v->factor;
    v->taps = v->factor > 1 ? 24 * v->factor + 1 : 1;
    int window = (int)fmax(ceil(2 * v->low_hz / def->pitch_hz[0]) + 4, FORMANT_S * v->low_hz);
    v->low_window = window + window % 2;
    v->low_pass = malloc(sizeof *v->low_pass * (size_t)v->taps);
    v->piece = malloc(sizeof *v->piece * (size_t)v->low_window);
    v->pitch_room = malloc(sizeof *v->pitch_room * (size_t)v->low_window);
    v->formant_room = malloc(sizeof *v->formant_room * 2 * (size_t)v->low_window);
    if (!v->low_pass || !v->piece || !v->pitch_room || !v->formant_room) {
        voice_destroy(v);
        return false;
    }
    low_pass_make(v->low_pass, v->taps, v->factor);
    voice_attack_init(&v->attack, def->frames_hz, def->attack, def->attack_gap_s);
    *out = v;
    return true;
}

void voice_destroy(struct voice *v)
{
    if (!v)
        return;
    free(v->low_pass);
    free(v->piece);
    free(v->pitch_room);
    free(v->formant_room);
    free(v->full.at);
    free(v->low.at);
    free(v->frames);
    free(v);
}

/* ---- streams ---- */

static bool samples_add(struct samples *s, const float *more, size_t count)
{
    if (s->count + count > s->room) {
        size_t room = 2 * s->room + count + 1024;
        float *grown = realloc(s->at, room * sizeof *grown);
        if (!grown)
            return false;
        s->at = grown;
        s->room = room;
    }
    if (count > 0)
        memcpy(s->at + s->count, more, count * sizeof *more);
    s->count += count;
    return true;
}

static void samples_forget(struct samples *s, long before)
{
    long old = before - s->begin;
    if (old <= (long)s->count / 2) /* moved seldom */
        return;
    size_t gone = old < (long)s->count ? (size_t)old : s->count;
    memmove(s->at, s->at + gone, (s->count - gone) * sizeof *s->at);
    s->begin += (long)gone;
    s->count -= gone;
}

static long samples_end(const struct samples *s)
{
    return s->begin + (long)s->count;
}

/* The sample of that number; 0 before the first and after the last. */
static float sample(const struct samples *s, long number)
{
    long at = number - s->begin;
    return at >= 0 && at < (long)s->count ? s->at[at] : 0;
}

/* Computes the lower-rate stream as far as the low-pass has its inputs, or to the end. */
static bool low_follow(struct voice *v)
{
    int reach = (v->taps - 1) / 2;
    long end = samples_end(&v->full);
    for (long next = samples_end(&v->low);; next++) {
        long middle = next * v->factor;
        if (v->ended ? middle >= end : middle + reach >= end)
            return true;
        float sum = 0;
        for (int i = 0; i < v->taps; i++)
            sum += v->low_pass[i] * sample(&v->full, middle + i - reach);
        if (!samples_add(&v->low, &sum, 1))
            return false;
    }
}

/* ---- frames ---- */

static double level_at(const struct voice *v, double time_s)
{
    int count = (int)fmax(2, LEVEL_S * v->rate_hz);
    long first = lround(time_s * v->rate_hz) - count / 2;
    double sum = 0, weights = 0;
    for (int i = 0; i < count; i++) {
        double weight = 1 - cos(2 * PI * (i + 0.5) / count),
               x = (double)sample(&v->full, first + i);
        sum += weight * x * x;
        weights += weight;
    }
    return sqrt(sum / weights);
}

/* The mean square of differences between neighbours of the lower-rate stream. *part: of the
 * most that it could be. */
static double upper_energy(const struct voice *v, double time_s, double *part)
{
    int count = (int)fmax(2, LEVEL_S * v->low_hz);
    long first = lround(time_s * v->low_hz) - count / 2;
    double sum = 0, all = 0;
    for (int i = 0; i < count; i++) {
        double x = (double)sample(&v->low, first + i),
               d = x - (double)sample(&v->low, first + i - 1);
        sum += d * d;
        all += x * x;
    }
    *part = all > 0 ? fmin(1, sum / (4 * all)) : 0;
    return sum / count;
}

static void piece_take(struct voice *v, double time_s, int count)
{
    long first = lround(time_s * v->low_hz) - count / 2;
    for (int i = 0; i < count; i++)
        v->piece[i] = sample(&v->low, first + i);
}

static void pitch_and_vowel(struct voice *v, struct voice_frame *f)
{
    piece_take(v, f->time_s, v->low_window);
    f->pitch_hz = voice_pitch(v->piece, v->low_window, v->low_hz, v->def.pitch_hz[0],
                              v->def.pitch_hz[1], v->pitch_room, &f->clarity);
    if (f->pitch_hz == 0)
        return;
    int count = (int)(FORMANT_S * v->low_hz), order = 2 + 2 * (int)(v->low_hz / 2000);
    piece_take(v, f->time_s, count);
    voice_formants(v->piece, count, v->low_hz,
                   order < VOICE_ORDER_MAX ? order : VOICE_ORDER_MAX, v->formant_room,
                   f->formant_hz);
}

static double followed(const struct voice *v, double level)
{
    double time_s = level > v->envelope ? v->def.rise_s : v->def.fall_s;
    double kept = time_s > 0 ? exp(-1 / (time_s * v->def.frames_hz)) : 0;
    return level + (v->envelope - level) * kept;
}

static bool frame_room(struct voice *v)
{
    if (v->frames_count < v->frames_room)
        return true;
    size_t room = 2 * v->frames_room + 64;
    struct voice_frame *grown = realloc(v->frames, room * sizeof *grown);
    if (!grown)
        return false;
    v->frames = grown;
    v->frames_room = room;
    return true;
}

/* Adds a frame for the attacks, which decides about an earlier frame. */
static void attack_decide(struct voice *v, double energy, double upper)
{
    bool attack = voice_attack_next(&v->attack, energy, upper);
    if (v->attack.count > v->attack.around)
        v->frames[v->frames_decided++].attack = attack;
}

static bool frame_make(struct voice *v, double time_s)
{
    if (!frame_room(v))
        return false;
    struct voice_frame *f = &v->frames[v->frames_count++];
    *f = (struct voice_frame){.time_s = time_s, .level = level_at(v, time_s)};
    v->envelope = followed(v, f->level);
    f->envelope = v->envelope;
    if (f->level > v->def.silence)
        pitch_and_vowel(v, f);
    double least = fmax(1e-12, v->def.silence * v->def.silence),
           upper = upper_energy(v, time_s, &f->bright);
    attack_decide(v, log(fmax(least, f->level * f->level)), log(fmax(least / 4, upper)));
    return true;
}

/* Computes all frames whose samples are there. */
static bool frames_follow(struct voice *v)
{
    double back_s = fmax(LEVEL_S, v->low_window / v->low_hz) / 2 + 0.002;
    double end_s = (double)samples_end(&v->full) / v->rate_hz,
           low_end_s = (double)samples_end(&v->low) / v->low_hz;
    for (;; v->next++) {
        double time_s = (double)v->next / v->def.frames_hz;
        if (v->ended ? time_s > end_s : time_s + back_s > fmin(end_s, low_end_s))
            break;
        if (!frame_make(v, time_s))
            return false;
    }
    double from_s = (double)v->next / v->def.frames_hz - back_s;
    samples_forget(&v->low, (long)floor(from_s * v->low_hz) - 2);
    long full = (long)floor(from_s * v->rate_hz) - 2,
         low = samples_end(&v->low) * v->factor - (v->taps - 1) / 2 - 1;
    samples_forget(&v->full, full < low ? full : low);
    return true;
}

bool voice_hear(struct voice *v, const float *samples, size_t count)
{
    return samples_add(&v->full, samples, count) && low_follow(v) && frames_follow(v);
}

bool voice_end(struct voice *v)
{
    if (v->ended)
        return true;
    v->ended = true;
    if (!low_follow(v) || !frames_follow(v))
        return false;
    while (v->frames_decided < v->frames_count) /* nothing rises any more */
        attack_decide(v, -1e3, -1e3);
    return true;
}

bool voice_next(struct voice *v, struct voice_frame *out)
{
    if (v->frames_decided == 0)
        return false;
    *out = v->frames[0];
    v->frames_decided--;
    v->frames_count--;
    memmove(v->frames, v->frames + 1, v->frames_count * sizeof *v->frames);
    return true;
}

bool voice_frames(const struct voice_def *def, const float *samples, size_t count, int rate_hz,
                  struct voice_frame **frames, int *frames_count)
{
    struct voice *v;
    *frames = NULL;
    *frames_count = 0;
    if (!voice_create(def, rate_hz, &v))
        return false;
    bool done = voice_hear(v, samples, count) && voice_end(v);
    if (done) {
        *frames = v->frames;
        *frames_count = (int)v->frames_decided;
        v->frames = NULL;
        v->frames_count = v->frames_decided = 0;
    }
    voice_destroy(v);
    return done;
}
