/* voice_align.c - see voice_align.h. */
#include "voice_align.h"

#include "voice_path.h"
#include "voice_units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FINE_S 0.01
#define AROUND_S 0.4 /* a frame's loudness is of the loudest so near */
#define UNIT_SPREAD 0.55
#define WORD_SPREAD 0.4
enum { SPEECH = VOICE_CLASSES, COSTS };

/* The length of a pass's frames, and how far from where a unit is about it looks. */
static const struct {
    double frame_s, reach_s;
    bool words; /* whole words are its units */
} passes[] = {{0.08, 60, true}, {0.03, 12, false}, {FINE_S, 1.5, false}};
enum { PASSES = sizeof passes / sizeof *passes };

/* What is heard, in frames of one length, as sums from the beginning. */
struct heard {
    int count;
    double frame_s, first_s;
    double *sums[COSTS]; /* of the cost of each class, and of speech of any kind */
    double *pause;
    double *spoken; /* how many seconds are spoken */
};

/* ---- costs of frames ---- */

struct frame_mean {
    double spoken, periodic, bright,
        loud; /* loud: nepers below the loudest around, 0 or less */
};

/* Nepers of cost for each frame of FINE_S. */
static void frame_costs(const struct frame_mean *f, double costs[COSTS], double *pause)
{
    const double quiet = fmin(3, -f->loud), noise = 1 - f->periodic;
    const double unspoken = 0.8 * (1 - f->spoken);
    costs[VOICE_CLASS_VOWEL] = 0.45 * noise + 0.16 * fmax(0, quiet - 0.6);
    costs[VOICE_CLASS_VOICED] = 0.22 * noise + 0.10 * fabs(quiet - 0.8);
    costs[VOICE_CLASS_HISS] =
        0.25 * f->periodic * (1 - f->bright) + 0.45 * fmax(0, 0.7 - f->bright);
    costs[VOICE_CLASS_BREATH] = 0.30 * f->periodic + 0.08 * fmax(0, 1.5 - quiet) + 0.05;
    costs[VOICE_CLASS_STOP] = 0.30 * f->periodic + 0.12 * fmax(0, 1.5 - quiet);
    costs[VOICE_CLASS_ANY] = 0.12;
    for (int i = 0; i < VOICE_CLASSES; i++)
        costs[i] = costs[i] * f->spoken + (i == VOICE_CLASS_STOP ? 0.4 : 1) * unspoken;
    costs[SPEECH] = unspoken;
    *pause = 1.0 * f->spoken;
}

/* The loudest level within AROUND_S of each frame: blocks of that length, and their
 * neighbours. */
static double *loudest_make(const struct voice_frame *frames, int count, int around)
{
    const int blocks = count / around + 1;
    double *of_block = calloc((size_t)blocks, sizeof *of_block),
           *out = malloc(sizeof *out * (size_t)(count + 1));
    for (int i = 0; i < count && of_block && out; i++)
        of_block[i / around] = fmax(of_block[i / around], frames[i].level);
    for (int i = 0; i < count && of_block && out; i++) {
        const int b = i / around;
        out[i] = fmax(of_block[b],
                      fmax(b > 0 ? of_block[b - 1] : 0, b + 1 < blocks ? of_block[b + 1] : 0));
    }
    if (!of_block) {
        free(out);
        out = NULL;
    }
    free(of_block);
    return out;
}

static void heard_finish(struct heard *h)
{
    for (int i = 0; i < COSTS; i++)
        free(h->sums[i]);
    free(h->pause);
    free(h->spoken);
    *h = (struct heard){0};
}

static bool heard_room(struct heard *h)
{
    const size_t bytes = sizeof(double) * ((size_t)h->count + 1);
    bool memory = true;
    for (int i = 0; i < COSTS; i++)
        memory = (h->sums[i] = malloc(bytes)) && memory;
    h->pause = malloc(bytes);
    h->spoken = malloc(bytes);
    return memory && h->pause && h->spoken;
}

static struct frame_mean mean_of(const struct voice_frame *frames, const bool *spoken,
                                 const double *loudest, int from, int to)
{
    struct frame_mean mean = {0};
    for (int i = from; i < to; i++) {
        const struct voice_frame *f = &frames[i];
        mean.spoken += spoken[i];
        mean.periodic += f->pitch_hz > 0;
        mean.bright += f->bright;
        mean.loud += log(fmax(f->level, 1e-6) / fmax(loudest[i], 1e-6));
    }
    const double n = fmax(1, to - from);
    return (struct frame_mean){mean.spoken / n, mean.periodic / n, mean.bright / n,
                               mean.loud / n};
}

/* False: no memory. `step` frames are one. */
static bool heard_make(const struct voice_frame *frames, int count, const bool *spoken,
                       double frame_s, int step, struct heard *out)
{
    const int around = (int)fmax(1, round(AROUND_S / frame_s));
    double *loudest = loudest_make(frames, count, around);
    *out = (struct heard){.count = (count + step - 1) / step,
                          .frame_s = frame_s * step,
                          .first_s = count ? frames[0].time_s - frame_s / 2 : 0};
    const bool memory = heard_room(out) && loudest;
    if (memory) {
        double costs[COSTS] = {0}, pause = 0;
        const double weight = out->frame_s / FINE_S;
        for (int i = 0; i < COSTS; i++)
            out->sums[i][0] = 0;
        out->pause[0] = out->spoken[0] = 0;
        for (int t = 0; t < out->count; t++) {
            const int from = t * step, to = from + step < count ? from + step : count;
            const struct frame_mean mean = mean_of(frames, spoken, loudest, from, to);
            frame_costs(&mean, costs, &pause);
            for (int i = 0; i < COSTS; i++)
                out->sums[i][t + 1] = out->sums[i][t] + weight * costs[i];
            out->pause[t + 1] = out->pause[t] + weight * pause;
            out->spoken[t + 1] = out->spoken[t] + mean.spoken * out->frame_s;
        }
    }
    free(loudest);
    return memory;
}

/* ---- places that are expected ---- */

/* Spreads units over what is spoken, by their expected lengths: one begins behind a silence,
 * and ends before the next. */
static void units_spread(const struct voice_unit *units, int count, const struct heard *h,
                         double rate, int *begin, int *end)
{
    const double near_s = h->frame_s * 1e-3;
    double before_s = 0;
    int t = 0;
    for (int i = 0; i < count; i++) {
        while (t < h->count && h->spoken[t + 1] <= before_s + near_s)
            t++;
        begin[i] = t;
        before_s += units[i].seconds * rate;
        while (t < h->count && h->spoken[t] < before_s - near_s)
            t++;
        end[i] = t;
    }
}

static double rate_of(const struct voice_unit *units, int count, const struct heard *h)
{
    double all = 0;
    for (int i = 0; i < count; i++)
        all += units[i].seconds;
    return h->spoken[h->count] / fmax(all, 1e-9);
}

/* ---- the two passes ---- */

static void breaks_set(struct voice_path_unit *unit, enum voice_break what)
{
    static const double pause[] = {4.0, 0.6, 0.0}, join[] = {0.0, 0.3, 2.5};
    unit->pause_after = true;
    unit->pause_cost = pause[what];
    unit->join_cost = join[what];
}

/* Words as units: their lengths are sums. */
static struct voice_unit *words_as_units(const struct voice_words *words,
                                         const struct voice_unit *units, int count)
{
    struct voice_unit *out = calloc((size_t)words->count, sizeof *out);
    for (int i = 0; i < count && out; i++)
        out[units[i].word].seconds += units[i].seconds;
    return out;
}

struct search {
    struct heard heard; /* of the last pass */
    struct voice_unit *units, *whole;
    int units_count;
    /* Frames of units, or of words: units are more. First where they are about, then where they
     * are. */
    int *begin_about, *end_about, *begin, *end;
};

static void search_finish(struct search *p)
{
    heard_finish(&p->heard);
    free(p->units);
    free(p->whole);
    free(p->begin_about);
    free(p->end_about);
    free(p->begin);
    free(p->end);
}

/* Finds units' first and last frames by the cheapest path; where there is none, they are
 * spread. `fine`: they are parts of words, else whole words. */
static enum voice_path_status units_find(const struct voice_words *words,
                                         const struct voice_unit *units, int count, bool fine,
                                         double reach_s, struct search *p)
{
    const struct heard *h = &p->heard;
    struct voice_path_unit *path = calloc((size_t)count, sizeof *path);
    const double rate = rate_of(units, count, h);
    if (!path)
        return VOICE_PATH_NO_MEMORY;
    for (int i = 0; i < count; i++) {
        path[i].what = fine ? (int)units[i].what : SPEECH;
        path[i].expected = fmax(0.3, units[i].seconds * rate / h->frame_s);
        path[i].spread = fine ? UNIT_SPREAD : WORD_SPREAD;
        if (!fine || i + 1 == count || units[i + 1].word != units[i].word)
            breaks_set(&path[i], voice_break_after(words, fine ? units[i].word : i));
    }
    struct voice_path_def def = {.units = path,
                                 .units_count = count,
                                 .costs = (const double *const *)h->sums,
                                 .pause = h->pause,
                                 .frames_count = h->count,
                                 .begins = p->begin_about,
                                 .ends = p->end_about,
                                 .reach = (int)ceil(reach_s / h->frame_s)};
    enum voice_path_status status = voice_path_find(&def, p->begin, p->end);
    free(path);
    for (int i = 0; i < count && status == VOICE_PATH_NONE; i++) {
        p->begin[i] = p->begin_about[i];
        p->end[i] = p->end_about[i];
    }
    return status;
}

/* From words' frames to where units are about: `ratio` frames of the next pass are one. */
static void words_to_units(struct search *p, double ratio)
{
    for (int i = 0; i < p->units_count;) {
        const int word = p->units[i].word;
        double all = 0, before = 0;
        int next = i;
        for (; next < p->units_count && p->units[next].word == word; next++)
            all += p->units[next].seconds;
        for (; i < next; i++) {
            const double lasts = (p->end[word] - p->begin[word]) / fmax(all, 1e-9);
            p->begin_about[i] = (int)round((p->begin[word] + before * lasts) * ratio);
            before += p->units[i].seconds;
            p->end_about[i] = (int)round((p->begin[word] + before * lasts) * ratio);
        }
    }
}

static void units_to_units(struct search *p, double ratio)
{
    for (int i = 0; i < p->units_count; i++) {
        p->begin_about[i] = (int)round(p->begin[i] * ratio);
        p->end_about[i] = (int)round(p->end[i] * ratio);
    }
}

static double seconds_of(const struct heard *h, double frame)
{
    return h->first_s + frame * h->frame_s;
}

/* A unit's letters share its time; a letter of several units has all of theirs. */
static void letters_time(const struct search *p, struct voice_timing *out)
{
    const struct heard *h = &p->heard;
    for (int i = 0; i < out->letters_count; i++)
        out->letters[i] = (struct voice_span){INFINITY, -INFINITY};
    for (int i = 0; i < p->units_count; i++) {
        const struct voice_unit *u = &p->units[i];
        const double n = u->letters_end - u->letters_begin, long_f = p->end[i] - p->begin[i];
        for (int letter = u->letters_begin; letter < u->letters_end; letter++) {
            const double part = (letter - u->letters_begin) / n;
            struct voice_span *s = &out->letters[letter];
            s->begin_s = fmin(s->begin_s, seconds_of(h, p->begin[i] + part * long_f));
            s->end_s = fmax(s->end_s, seconds_of(h, p->begin[i] + (part + 1 / n) * long_f));
        }
    }
}

static void words_time(const struct voice_words *words, struct voice_timing *out)
{
    for (int w = 0; w < words->count; w++)
        out->words[w] = (struct voice_span){out->letters[words->first[w]].begin_s,
                                            out->letters[words->first[w + 1] - 1].end_s};
}

static bool timing_room(const struct voice_words *words, struct voice_timing *out)
{
    *out = (struct voice_timing){
        .words = malloc(sizeof *out->words * (size_t)(words->count + 1)),
        .letters = malloc(sizeof *out->letters * (size_t)(words->letters_count + 1)),
        .words_count = words->count,
        .letters_count = words->letters_count};
    return out->words && out->letters;
}

static bool search_room(struct search *p, const struct voice_words *words)
{
    if (!voice_units_make(words, &p->units, &p->units_count))
        return false;
    p->whole = words_as_units(words, p->units, p->units_count);
    const size_t bytes = sizeof(int) * ((size_t)p->units_count + 1);
    p->begin_about = malloc(bytes);
    p->end_about = malloc(bytes);
    p->begin = malloc(bytes);
    p->end = malloc(bytes);
    return p->whole && p->begin_about && p->end_about && p->begin && p->end;
}

static double frame_seconds(const struct voice_frame *frames, int count)
{
    return count > 1 ? (frames[count - 1].time_s - frames[0].time_s) / (count - 1) : FINE_S;
}

/* How many frames are one, so that a slow voice has no more to look at than a quick one. */
static int step_of(double seconds, double frame_s, double rate)
{
    return (int)fmax(1, round(seconds * fmax(1, rate / 2) / frame_s));
}

static bool pass_go(struct search *p, const struct voice_words *words, int number, double rate)
{
    const bool whole = passes[number].words;
    return units_find(words, whole ? p->whole : p->units, whole ? words->count : p->units_count,
                      !whole, passes[number].reach_s * fmax(1, rate),
                      p) != VOICE_PATH_NO_MEMORY;
}

static bool passes_go(struct search *p, const struct voice_words *words,
                      const struct voice_frame *frames, int count, const bool *spoken)
{
    const double frame_s = frame_seconds(frames, count);
    double before_s = 0, rate = 1;
    for (int i = 0; i < PASSES; i++) {
        heard_finish(&p->heard);
        if (!heard_make(frames, count, spoken, frame_s,
                        step_of(passes[i].frame_s, frame_s, rate), &p->heard))
            return false;
        const double ratio = before_s / p->heard.frame_s;
        before_s = p->heard.frame_s;
        if (i == 0) {
            rate = rate_of(p->units, p->units_count, &p->heard);
            units_spread(p->whole, words->count, &p->heard, rate, p->begin_about, p->end_about);
        } else if (passes[i - 1].words) {
            words_to_units(p, ratio);
        } else {
            units_to_units(p, ratio);
        }
        if (!pass_go(p, words, i, rate))
            return false;
    }
    return true;
}

/* ---- the voice's sounds ---- */

/* Runs of frames that are spoken; all of it, where nothing is. */
static bool sounds_find(const struct voice_frame *frames, int count, bool *spoken,
                        struct voice_timing *out)
{
    const double half_s = frame_seconds(frames, count) / 2;
    if (count > 0 && !memchr(spoken, true, (size_t)count))
        memset(spoken, true, (size_t)count);
    out->sounds = malloc(sizeof *out->sounds * ((size_t)count / 2 + 1));
    for (int i = 0; i < count && out->sounds; i++) {
        if (!spoken[i])
            continue;
        if (i == 0 || !spoken[i - 1])
            out->sounds[out->sounds_count++].begin_s = frames[i].time_s - half_s;
        out->sounds[out->sounds_count - 1].end_s = frames[i].time_s + half_s;
    }
    return out->sounds != NULL;
}

/* The time when so many seconds of the sounds are over. */
static double sounded(const struct voice_timing *t, double seconds, bool end)
{
    for (int i = 0; i < t->sounds_count; i++) {
        const double lasts = t->sounds[i].end_s - t->sounds[i].begin_s;
        if (seconds < lasts - 1e-9 || (end && seconds <= lasts + 1e-9))
            return t->sounds[i].begin_s + fmin(seconds, lasts);
        seconds -= lasts;
    }
    return t->sounds_count ? t->sounds[t->sounds_count - 1].end_s : 0;
}

/* One word: its letters share the sounds alike. */
static void letters_share(struct voice_timing *t)
{
    double all = 0;
    for (int i = 0; i < t->sounds_count; i++)
        all += t->sounds[i].end_s - t->sounds[i].begin_s;
    for (int i = 0; i < t->letters_count; i++)
        t->letters[i] = (struct voice_span){sounded(t, all * i / t->letters_count, false),
                                            sounded(t, all * (i + 1) / t->letters_count, true)};
}

static bool text_align(const struct voice_words *words, const struct voice_frame *frames,
                       int count, const bool *spoken, struct voice_timing *out)
{
    struct search p = {0};
    bool memory = true;
    if (words->count == 1) {
        letters_share(out);
    } else {
        memory = search_room(&p, words) && passes_go(&p, words, frames, count, spoken);
        if (memory)
            letters_time(&p, out);
    }
    if (memory)
        words_time(words, out);
    search_finish(&p);
    return memory;
}

bool voice_align(const struct voice_words *words, const struct voice_frame *frames, int count,
                 double silence, struct voice_timing *out)
{
    bool *spoken = calloc((size_t)count + 1, sizeof *spoken);
    const bool memory = timing_room(words, out) && spoken &&
                        voice_frames_spoken(frames, count, silence, spoken) &&
                        sounds_find(frames, count, spoken, out) &&
                        text_align(words, frames, count, spoken, out);
    if (!memory)
        voice_timing_finish(out);
    free(spoken);
    return memory;
}

/* ---- a transcript ---- */

static int frame_at(const struct voice_frame *frames, int count, double time_s)
{
    int i = (int)fmax(0, fmin(count, ceil(time_s / frame_seconds(frames, count))));
    while (i > 0 && frames[i - 1].time_s >= time_s)
        i--;
    while (i < count && frames[i].time_s < time_s)
        i++;
    return i;
}

/* Aligns the words of one cue within its time; where the sound is not, they share the time
 * alike. */
static bool cue_align(const struct voice_cue *cue, const struct voice_frame *frames, int count,
                      double silence, int first_letter, struct voice_timing *out, int *letters)
{
    struct voice_words words;
    struct voice_timing timing = {0};
    bool empty;
    const int from = frame_at(frames, count, cue->begin_s),
              to = frame_at(frames, count, cue->end_s);
    if (!voice_words_make(cue->text, &words, &empty))
        return false;
    bool memory = true;
    if (to - from > 2 * words.letters_count) {
        memory = voice_align(&words, frames + from, to - from, silence, &timing);
        for (int i = 0; i < words.letters_count && memory; i++)
            out->letters[first_letter + i] = timing.letters[i];
    } else {
        const double each_s = (cue->end_s - cue->begin_s) / words.letters_count;
        for (int i = 0; i < words.letters_count; i++)
            out->letters[first_letter + i] =
                (struct voice_span){cue->begin_s + i * each_s, cue->begin_s + (i + 1) * each_s};
    }
    *letters = words.letters_count;
    voice_timing_finish(&timing);
    voice_words_finish(&words);
    return memory;
}

bool voice_align_cues(const struct voice_words *words, const struct voice_transcript *cues,
                      const struct voice_frame *frames, int count, double silence,
                      struct voice_timing *out)
{
    bool *spoken = calloc((size_t)count + 1, sizeof *spoken);
    bool memory = timing_room(words, out) && spoken &&
                  voice_frames_spoken(frames, count, silence, spoken) &&
                  sounds_find(frames, count, spoken, out);
    int letter = 0;
    for (int i = 0; i < cues->count && memory; i++) {
        int letters = 0;
        memory = cue_align(&cues->cues[i], frames, count, silence, letter, out, &letters);
        letter += letters;
    }
    if (memory)
        words_time(words, out);
    else
        voice_timing_finish(out);
    free(spoken);
    return memory;
}
