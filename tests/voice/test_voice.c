/* test_voice.c - analyses synthetic voices, whose pitch, level and vowels are known. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include <voice.h>
#include <voice_cry.h>

#define PI 3.14159265358979323846

static double three_cries(double t)
{
    static const double begin[3] = {0.2, 0.9, 1.5};
    double loud = 0;
    for (int i = 0; i < 3; i++)
        if (t >= begin[i] && t < begin[i] + 0.5)
            loud = fmin(1, (t - begin[i]) / 0.015) * fmin(1, (begin[i] + 0.5 - t) / 0.3) *
                   (1 - 0.2 * i);
    return loud;
}
static double steady(double t)
{
    (void)t;
    return 1;
}
static double swell(double t)
{
    return 0.05 + 0.95 * sin(PI * t / 2) * sin(PI * t / 2);
}
static double rising(double t)
{
    return 200 + 150 * t;
}
static double low(double t)
{
    (void)t;
    return 110;
}

static void vowel_700(double t, double formant_hz[2])
{
    (void)t;
    formant_hz[0] = 700;
    formant_hz[1] = 1200;
}
static void vowel_600(double t, double formant_hz[2])
{
    (void)t;
    formant_hz[0] = 600;
    formant_hz[1] = 1300;
}
static void vowel_a(double t, double formant_hz[2])
{
    (void)t;
    formant_hz[0] = 730;
    formant_hz[1] = 1090;
}
static void vowel_i(double t, double formant_hz[2])
{
    (void)t;
    formant_hz[0] = 300;
    formant_hz[1] = 2290;
}
static void vowel_u(double t, double formant_hz[2])
{
    (void)t;
    formant_hz[0] = 320;
    formant_hz[1] = 870;
}

static struct voice_frame *heard(const struct voice_cry *cry, int *count)
{
    struct voice_def def = voice_def_default();
    struct voice_frame *frames;
    size_t samples_count;
    float *samples = voice_cry_make(cry, &samples_count);
    assert_non_null(samples);
    assert_true(voice_frames(&def, samples, samples_count, cry->rate_hz, &frames, count));
    free(samples);
    return frames;
}

static void envelope_follows_the_loudness(void **state)
{
    (void)state;
    struct voice_cry cry = {2, 44100, swell, low, vowel_700};
    int count;
    struct voice_frame *f = heard(&cry, &count);
    double sums[5] = {0};
    assert_int_equal(count, 201);
    for (int i = 5; i < count - 5; i++) {
        double x = swell(f[i].time_s), y = f[i].envelope;
        sums[0] += x;
        sums[1] += y;
        sums[2] += x * x;
        sums[3] += y * y;
        sums[4] += x * y;
    }
    double n = count - 10, both = n * sums[4] - sums[0] * sums[1];
    double correlation =
        both / sqrt((n * sums[2] - sums[0] * sums[0]) * (n * sums[3] - sums[1] * sums[1]));
    assert_true(correlation > 0.99);
    free(f);
}

static void attacks_are_where_cries_begin(void **state)
{
    (void)state;
    static const int rates[] = {8000, 16000, 44100, 48000, 96000};
    static const double begin[3] = {0.2, 0.9, 1.5};
    for (size_t r = 0; r < sizeof rates / sizeof *rates; r++) {
        struct voice_cry cry = {2.2, rates[r], three_cries, rising, vowel_700};
        int count, found = 0;
        struct voice_frame *f = heard(&cry, &count);
        for (int i = 0; i < count; i++) {
            if (!f[i].attack)
                continue;
            assert_true(found < 3);
            assert_true(fabs(f[i].time_s - begin[found]) < 0.04);
            found++;
        }
        assert_int_equal(found, 3);
        free(f);
    }
}

static void pitch_is_right(void **state)
{
    (void)state;
    static const int rates[] = {8000, 11025, 44100, 48000};
    for (size_t r = 0; r < sizeof rates / sizeof *rates; r++) {
        struct voice_cry cry = {2, rates[r], steady, rising, vowel_600};
        int count;
        struct voice_frame *f = heard(&cry, &count);
        for (int i = 5; i < count - 5; i++) {
            assert_true(fabs(f[i].pitch_hz / rising(f[i].time_s) - 1) < 0.015);
            assert_true(f[i].clarity > 0.8);
        }
        free(f);
    }
}

static void noise_and_silence_have_no_pitch(void **state)
{
    (void)state;
    enum { COUNT = 44100 };
    struct voice_def def = voice_def_default();
    float *samples = calloc(COUNT, sizeof *samples);
    struct voice_frame *f;
    uint32_t chance = 1990;
    int count, pitched = 0, attacks = 0;
    assert_non_null(samples);
    for (int i = COUNT / 2; i < COUNT; i++) {
        chance = chance * 1664525u + 1013904223u;
        samples[i] = (float)((double)chance / 0x1p32 - 0.5);
    }
    assert_true(voice_frames(&def, samples, COUNT, 44100, &f, &count));
    for (int i = 0; i < count; i++) {
        pitched += f[i].pitch_hz > 0;
        attacks += f[i].attack;
        if (f[i].time_s < 0.48)
            assert_true(f[i].level == 0 && f[i].envelope == 0);
    }
    assert_true(pitched <= count / 20);
    assert_int_equal(attacks, 1);
    free(f);
    free(samples);
}

/* [a], [i], [u] of a grown man */
static void vowels_are_told_apart(void **state)
{
    (void)state;
    static const double vowels[3][2] = {{730, 1090}, {300, 2290}, {320, 870}};
    static void (*const vowels_make[3])(double, double *) = {vowel_a, vowel_i, vowel_u};
    for (int v = 0; v < 3; v++) {
        struct voice_cry cry = {0.6, 44100, steady, low, vowels_make[v]};
        int count, near = 0, all = 0;
        struct voice_frame *f = heard(&cry, &count);
        for (int i = 5; i < count - 5; i++, all++) {
            int nearest = -1;
            double least = 0.35; /* octaves; a sound farther from all three is no vowel */
            for (int k = 0; k < 3 && f[i].formant_hz[1] > 0; k++) {
                double away = hypot(log2(f[i].formant_hz[0] / vowels[k][0]),
                                    log2(f[i].formant_hz[1] / vowels[k][1]));
                if (away < least) {
                    least = away;
                    nearest = k;
                }
            }
            near += nearest == v;
        }
        assert_true(near >= 0.85 * all);
        free(f);
    }
}

static void pieces_make_no_difference(void **state)
{
    (void)state;
    /* the padding after the last member is not compared */
    const size_t whole = offsetof(struct voice_frame, attack) + sizeof(bool);
    struct voice_cry cry = {1.2, 22050, three_cries, rising, vowel_700};
    struct voice_def def = voice_def_default();
    size_t samples_count;
    float *samples = voice_cry_make(&cry, &samples_count);
    struct voice_frame *f, one;
    struct voice *voice;
    uint32_t chance = 7;
    int count, taken = 0;
    assert_non_null(samples);
    assert_true(voice_frames(&def, samples, samples_count, 22050, &f, &count));
    assert_true(voice_create(&def, 22050, &voice));
    for (size_t at = 0; at < samples_count;) {
        chance = chance * 1664525u + 1013904223u;
        size_t piece = chance >> 20 & 1 ? (chance >> 8) % 7 : (chance >> 8) % 3000;
        piece = piece < samples_count - at ? piece : samples_count - at;
        assert_true(voice_hear(voice, samples + at, piece));
        at += piece;
        while (voice_next(voice, &one)) {
            assert_true(one.time_s <= (double)at / 22050 + 1e-9);
            assert_memory_equal(&one, &f[taken++], whole);
        }
        /* the delay is within the header's bound */
        assert_true((double)at / 22050 - (double)taken / def.frames_hz <=
                    VOICE_DELAY_S + 0.011);
    }
    assert_true(voice_end(voice));
    while (voice_next(voice, &one))
        assert_memory_equal(&one, &f[taken++], whole);
    assert_int_equal(taken, count);
    voice_destroy(voice);
    free(f);
    free(samples);
}

static void anything_is_heard_without_harm(void **state)
{
    (void)state;
    struct voice_def def = voice_def_default();
    struct voice_frame *f;
    float samples[2000];
    uint32_t chance = 3;
    int count;
    for (int kind = 0; kind < 6; kind++)
        for (int length = 0; length <= 2000; length += length < 10 ? 1 : 331) {
            for (int i = 0; i < length; i++) {
                chance = chance * 1664525u + 1013904223u;
                samples[i] = kind == 0   ? 1
                             : kind == 1 ? (i & 1 ? 1.0f : -1.0f)
                             : kind == 2 ? (chance >> 31 ? 1.0f : -1.0f)
                             : kind == 3 ? (i == length / 2 ? 1.0f : 0)
                             : kind == 4 ? 1e-30f
                                         : (float)(i % 50) / 50;
            }
            assert_true(voice_frames(&def, samples, (size_t)length, 8000, &f, &count));
            assert_int_equal(count, length * 100 / 8000 + 1);
            for (int i = 0; i < count; i++)
                assert_true(f[i].level >= 0 && f[i].level <= 1 && f[i].envelope <= 1 &&
                            f[i].pitch_hz >= 0 && f[i].pitch_hz < 1300 && f[i].clarity >= 0 &&
                            f[i].clarity <= 1 && f[i].formant_hz[0] >= 0 &&
                            f[i].formant_hz[1] < 5001);
            free(f);
        }
}

static void descriptions_are_checked(void **state)
{
    (void)state;
    struct voice_def def = voice_def_default();
    assert_null(voice_def_wrong(&def));
    def.pitch_hz[1] = 80;
    assert_non_null(voice_def_wrong(&def));
    def = voice_def_default();
    def.frames_hz = NAN;
    assert_non_null(voice_def_wrong(&def));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(envelope_follows_the_loudness),
        cmocka_unit_test(attacks_are_where_cries_begin),
        cmocka_unit_test(pitch_is_right),
        cmocka_unit_test(noise_and_silence_have_no_pitch),
        cmocka_unit_test(vowels_are_told_apart),
        cmocka_unit_test(pieces_make_no_difference),
        cmocka_unit_test(anything_is_heard_without_harm),
        cmocka_unit_test(descriptions_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
