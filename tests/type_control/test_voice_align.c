/* test_voice_align.c - words' times in a voice, against the account of the program that speaks
 * it (espeak-ng). LUTETIA_VOICE_HOURS=1 makes each language an hour long. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <voice_align.h>

#include "sentences.h"
#include "spoken.h"

enum { MIXES = 4 };
static const double SILENCE = 0.004, MEDIAN_S = 0.15, WITHIN_S = 0.25;

struct quiet {
    double begin_s, end_s;
};

static struct quiet quiets[1 << 16];
static int quiets_count;
static uint32_t chances;

static uint32_t chance(uint32_t below)
{
    chances = chances * 1103515245u + 12345u;
    return (chances >> 16) % below;
}

static double seconds_of(const struct spoken *s)
{
    return (double)s->count / s->rate_hz;
}

static void quiet_begin(const struct spoken *s)
{
    quiets[quiets_count].begin_s = seconds_of(s);
}

static void quiet_end(const struct spoken *s)
{
    quiets[quiets_count].end_s = seconds_of(s);
    quiets_count += quiets_count + 1 < (int)(sizeof quiets / sizeof *quiets);
}

/* Sentences with: 0 nothing, 1 silences, 2 silences and bursts of noise, 3 noise under all of
 * it, too. */
static void say(struct spoken *s, int language, int mix, double seconds)
{
    quiets_count = 0;
    chances = 7;
    for (int n = 0; n < SENTENCES || seconds_of(s) < seconds; n++) {
        spoken_say(s, sentences[language].of[n < SENTENCES ? (uint32_t)n : chance(SENTENCES)]);
        const uint32_t what = mix > 0 ? chance(4) : 3;
        quiet_begin(s);
        if (what == 0)
            spoken_silence(s, 0.3 + 0.1 * chance(40));
        else if (what == 1 && mix > 1)
            spoken_noise(s, 0.5 + 0.1 * chance(20), chance(2) ? 0.05 : 0.3);
        quiet_end(s);
    }
    if (mix == 3)
        spoken_noise_over(s, 0.01);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Each word and letter has a time, one after the other, within the sound. */
static void times_are_whole(const struct voice_words *words, const struct voice_timing *t,
                            double seconds)
{
    double before_s = -0.005; /* half a frame */
    assert_int_equal(t->words_count, words->count);
    assert_int_equal(t->letters_count, words->letters_count);
    for (int w = 0; w < words->count; w++) {
        if (t->words[w].begin_s < before_s - 1e-6 || t->words[w].end_s > seconds + 0.02)
            fail_msg("word %d is at %g..%g, after %g, of %g s", w, t->words[w].begin_s,
                     t->words[w].end_s, before_s, seconds);
        before_s = t->words[w].begin_s;
        for (int i = words->first[w]; i < words->first[w + 1]; i++) {
            if (!(t->letters[i].end_s > t->letters[i].begin_s) ||
                t->letters[i].begin_s < before_s - 1e-6 ||
                t->letters[i].end_s > t->words[w].end_s + 1e-6)
                fail_msg("letter %d of word %d is at %g..%g", i, w, t->letters[i].begin_s,
                         t->letters[i].end_s);
            before_s = t->letters[i].begin_s;
        }
        before_s = t->words[w].end_s;
    }
}

/* Errors of words' beginnings. Words that the speaker joins with the one before have no time of
 * their own. */
static int errors_find(const struct spoken *s, const struct voice_words *words,
                       const struct voice_timing *t, double *errors)
{
    int count = 0, w = 0;
    for (int i = 0; i < s->words_count; i++) {
        while (w < words->count && words->letters[words->first[w]].begin < s->words[i].byte)
            w++;
        if (w < words->count && words->letters[words->first[w]].before <= s->words[i].byte)
            errors[count++] = fabs(t->words[w].begin_s - s->words[i].begin_s);
    }
    return count;
}

/* The parts of all that is quiet in which a word is shown. */
static double shown_in_quiet(const struct voice_timing *t)
{
    int moments = 0, shown = 0;
    for (int i = 0; i < quiets_count; i++)
        for (double at = quiets[i].begin_s + WITHIN_S; at < quiets[i].end_s - WITHIN_S;
             at += 0.02, moments++)
            shown += voice_word_at(t, at) >= 0;
    return moments ? (double)shown / moments : 0;
}

static void language_is_aligned(int language, int mix, double seconds)
{
    struct spoken s;
    struct voice_def def = voice_def_default();
    struct voice_words words;
    struct voice_timing timing;
    struct voice_frame *frames;
    int frames_count;
    bool empty;
    if (!spoken_begin(&s, sentences[language].language))
        fail_msg("espeak-ng has no voice '%s'", sentences[language].language);
    say(&s, language, mix, seconds);
    assert_true(voice_frames(&def, s.samples, s.count, s.rate_hz, &frames, &frames_count));
    assert_true(voice_words_make(s.text, &words, &empty));
    assert_true(voice_align(&words, frames, frames_count, SILENCE, &timing));
    times_are_whole(&words, &timing, seconds_of(&s));
    double *errors = calloc((size_t)s.words_count + 1, sizeof *errors);
    assert_non_null(errors);
    const int count = errors_find(&s, &words, &timing, errors);
    assert_true(count > words.count * 8 / 10);
    qsort(errors, (size_t)count, sizeof *errors, ascending);
    const double median = errors[count / 2], quiet = shown_in_quiet(&timing);
    printf("%s, mix %d: %.0f s, %d words: median %.3f s, nine of ten %.3f s\n",
           sentences[language].language, mix, seconds_of(&s), words.count, median,
           errors[count * 9 / 10]);
    if (median > MEDIAN_S || quiet > 0)
        fail_msg("%s, mix %d: median %g s; %g of the silence shows words",
                 sentences[language].language, mix, median, quiet);
    free(errors);
    voice_timing_finish(&timing);
    voice_words_finish(&words);
    free(frames);
    spoken_end(&s);
}

static void words_are_where_they_are_said(void **state)
{
    (void)state;
    const char *hours = getenv("LUTETIA_VOICE_HOURS");
    for (int language = 0; language < LANGUAGES; language++)
        for (int mix = hours ? MIXES - 1 : 0; mix < MIXES; mix++)
            language_is_aligned(language, mix, hours ? 3600 * strtod(hours, NULL) : 0);
}

/* A transcript's cues are wrong by up to half a second at their edges, but words stay within
 * them, as near as without. */
static void transcripts_hold_words(void **state)
{
    (void)state;
    struct spoken s;
    struct voice_def def = voice_def_default();
    struct voice_words words;
    struct voice_timing timing;
    struct voice_frame *frames;
    struct voice_transcript cues;
    char text[8192] = "WEBVTT\n", why[300];
    double from_s[SENTENCES + 1], errors[400];
    int frames_count;
    bool empty;
    assert_true(spoken_begin(&s, "en"));
    for (int i = 0; i < SENTENCES; i++) {
        from_s[i] = seconds_of(&s);
        spoken_say(&s, sentences[0].of[i]);
        spoken_silence(&s, 1);
        const double to_s = seconds_of(&s) - 0.3;
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 "\n00:%06.3f --> 00:%06.3f\n%s\n", from_s[i], to_s, sentences[0].of[i]);
    }
    if (!voice_transcript_parse("x", text, strlen(text), &cues, why, sizeof why))
        fail_msg("%s", why);
    assert_true(voice_frames(&def, s.samples, s.count, s.rate_hz, &frames, &frames_count));
    assert_true(voice_words_make(cues.text, &words, &empty));
    assert_true(voice_align_cues(&words, &cues, frames, frames_count, SILENCE, &timing));
    times_are_whole(&words, &timing, seconds_of(&s));
    const int count = errors_find(&s, &words, &timing, errors);
    qsort(errors, (size_t)count, sizeof *errors, ascending);
    assert_true(count > 50 && errors[count / 2] < 0.1 && errors[count - 1] < 1);
    voice_timing_finish(&timing);
    voice_words_finish(&words);
    voice_transcript_finish(&cues);
    free(frames);
    spoken_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_are_where_they_are_said),
        cmocka_unit_test(transcripts_hold_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
