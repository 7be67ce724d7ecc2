/* test_keys.c - keys as letters: their sizes, times and choice, also measured in pixels. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <keys_picture.h>

#include "../display/scratch.h"
#include "../sample.h"

#include <math.h>

struct played {
    int ms;
    uint8_t bytes[3];
};

static struct midi_song *song_of(const struct played *played, int count)
{
    const struct midi_song_def def = midi_song_def_default();
    struct midi_song *song;
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    for (int i = 0; i < count; i++) {
        struct midi_message m =
            midi_message_make((uint64_t)played[i].ms * 1000000, played[i].bytes[0],
                              played[i].bytes[1], played[i].bytes[2]);
        assert_int_equal(midi_song_record(song, 0, &m, 0), MIDI_OK);
    }
    return song;
}

#define near(a, b) assert_true(fabs((a) - (b)) < 1e-3)

static void levels_follow_what_is_played(void **unused)
{
    (void)unused;
    static const struct played played[] = {
        {0, {0x90, 60, 127}},   {1000, {0x80, 60, 64}},  /* the middle release */
        {2000, {0x90, 60, 64}}, {2500, {0xa0, 60, 127}}, /* pressed on: as large as can be */
        {2600, {0xa0, 60, 0}},  {3000, {0x80, 60, 127}}, /* let go at once */
        {4000, {0x91, 62, 32}}, {4000, {0xb1, 64, 127}},
        {4100, {0x91, 62, 0}},  {5000, {0xb1, 64, 0}}, /* the pedal kept it */
    };
    struct midi_song *song = song_of(played, sizeof played / sizeof *played);
    struct keys_def def = {.attack_s = 0.1, .release_s = 0.2, .pressure = 1};
    struct keys_score s;
    bool empty;
    assert_true(keys_score_make(&def, song, &s, &empty));
    assert_int_equal(s.notes_count, 3);
    assert_int_equal(s.keys_count, 2);
    assert_int_equal(s.rank[62], 1);
    assert_int_equal(s.rank[61], -1);
    near(keys_key_level(&s, 60, -0.1, NULL), 0);
    near(keys_key_level(&s, 60, 0.05, NULL), 0.5);
    near(keys_key_level(&s, 60, 0.5, NULL), 1);
    near(keys_key_level(&s, 60, 1.2, NULL), exp(-1 / exp2(1 - 2 * 64 / 127.0)));
    near(keys_key_level(&s, 60, 2.3, NULL), 64 / 127.0);
    near(keys_key_level(&s, 60, 2.55, NULL), 1);
    near(keys_key_level(&s, 60, 2.9, NULL), 64 / 127.0);
    near(keys_key_level(&s, 60, 3.1, NULL), 64 / 127.0 * exp(-1)); /* twice as fast */
    near(keys_key_level(&s, 62, 4.9, NULL), 32 / 127.0);
    assert_true(keys_key_level(&s, 62, 5.3, NULL) < 32 / 127.0 * 0.4);
    near(keys_note_most(&s, 1), 1);
    near(keys_note_most(&s, 2), 32 / 127.0);
    keys_score_finish(&s);
    midi_song_destroy(song);
}

static void letters_go_to_keys(void **unused)
{
    (void)unused;
    static const struct played played[] = {
        {0, {0x90, 60, 1}}, {1, {0x90, 64, 1}}, {2, {0x90, 67, 1}}, {3, {0x90, 72, 1}}};
    struct midi_song *song = song_of(played, 4);
    struct keys_def def = keys_def_default();
    struct keys_score s;
    static struct keys_letters l;
    char why[200];
    bool empty;
    assert_true(keys_score_make(&def, song, &s, &empty));
    keys_letters_names(&l);
    assert_string_equal(l.of[60], "C");
    assert_string_equal(l.of[61], "C♯");
    assert_true(keys_letters_text(&s, " o\xcc\x81 n", &l)); /* a mark stays with its letter */
    assert_string_equal(l.of[60], "o\xcc\x81");
    assert_string_equal(l.of[64], "n");
    assert_string_equal(l.of[67], "o\xcc\x81");
    assert_string_equal(l.of[61], "");
    assert_false(keys_letters_text(&s, " \n\t", &l));
    /* Arabic: from the highest key, each letter as its neighbours in the word have it. Bab: beh
     * alef beh, then meem alone */
    assert_true(keys_letters_text(&s, "\u0628\u0627\u0628 \u0645", &l));
    assert_string_equal(l.of[72], "\u0628\u200d"); /* initial */
    assert_string_equal(l.of[67], "\u200d\u0627"); /* final: an alef joins nothing after it */
    assert_string_equal(l.of[64], "\u0628");       /* so this beh is alone */
    assert_string_equal(l.of[60], "\u0645");
    /* Devanagari: a conjunct and its vowel sign are one letter: ksha, hi, sta */
    assert_true(
        keys_letters_text(&s, "\u0915\u094d\u0937\u0939\u093f\u0938\u094d\u0924\u0940", &l));
    assert_string_equal(l.of[60], "\u0915\u094d\u0937");
    assert_string_equal(l.of[64], "\u0939\u093f");
    assert_string_equal(l.of[67], "\u0938\u094d\u0924\u0940");
    const char *path = scratch_path("map");
    FILE *file = fopen(path, "w");
    fputs("# keys\nc4 Ag\n\n72 z\n", file);
    fclose(file);
    assert_true(keys_letters_file(path, &l, why, sizeof why));
    assert_string_equal(l.of[60], "Ag");
    assert_string_equal(l.of[72], "z");
    file = fopen(path, "w");
    fputs("c4 A\nh4 B\n", file);
    fclose(file);
    assert_false(keys_letters_file(path, &l, why, sizeof why));
    assert_non_null(strstr(why, "map:2: "));
    assert_false(keys_letters_file("/nowhere/map", &l, why, sizeof why));
    keys_score_finish(&s);
    midi_song_destroy(song);
    song = song_of(&(struct played){0, {0xb0, 7, 1}}, 1);
    assert_false(keys_score_make(&def, song, &s, &empty));
    assert_true(empty);
    midi_song_destroy(song);
}

/* The height of a picture's ink. */
static int ink_height(const struct font_picture *p)
{
    int top = p->height_px, bottom = -1;
    for (int y = 0; y < p->height_px; y++)
        for (int x = 0; x < p->width_px; x++)
            if (p->rgb[y * p->pitch + 3 * x] < 128) {
                top = y < top ? y : top;
                bottom = y;
            }
    return bottom < top ? 0 : bottom - top + 1;
}

/* Pearson's correlation. */
static double correlation(const double *x, const double *y, int count)
{
    double mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
    for (int i = 0; i < count; i++) {
        mx += x[i] / count;
        my += y[i] / count;
    }
    for (int i = 0; i < count; i++) {
        xx += (x[i] - mx) * (x[i] - mx);
        yy += (y[i] - my) * (y[i] - my);
        xy += (x[i] - mx) * (y[i] - my);
    }
    return xy / sqrt(xx * yy);
}

static void heights_in_pixels_follow_velocity(void **unused)
{
    (void)unused;
    enum { NOTES = 40, SIDE = 320 };
    static uint8_t rgb[SIDE * SIDE * 3];
    struct font_picture picture = {SIDE, SIDE, 3 * SIDE, rgb};
    struct played played[2 * NOTES];
    double velocities[NOTES], heights[NOTES];
    uint64_t seed = 31;
    for (int i = 0; i < NOTES; i++) {
        const uint8_t velocity = (uint8_t)(1 + sample_word(&seed) % 127);
        played[2 * i] = (struct played){1000 * i, {0x90, 60, velocity}};
        played[2 * i + 1] = (struct played){1000 * i + 500, {0x80, 60, 64}};
        velocities[i] = velocity;
    }
    struct midi_song *song = song_of(played, 2 * NOTES);
    struct keys_def def = {.attack_s = 0.03, .release_s = 0.02, .pressure = 1};
    struct keys_type_def type_def = keys_type_def_default();
    static struct keys_letters letters;
    struct keys_score s;
    struct keys_type *type;
    struct font_face *face;
    bool empty;
    assert_true(keys_score_make(&def, song, &s, &empty));
    keys_letters_names(&letters);
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK)
        fail_msg("%s", font_error());
    assert_int_equal(keys_type_fit(face, &s, &letters, SIDE, SIDE, &type_def.size_px[1]),
                     FONT_OK);
    assert_int_equal(keys_type_create(&type_def, face, &s, &letters, &type), FONT_OK);
    for (int i = 0; i < NOTES; i++) {
        assert_int_equal(keys_type_moment(type, i + 0.25, &picture), FONT_OK);
        heights[i] = ink_height(&picture);
    }
    assert_true(correlation(velocities, heights, NOTES) >= 0.99);
    /* After its release the letter is gone. */
    assert_int_equal(keys_type_moment(type, 0.9, &picture), FONT_OK);
    assert_int_equal(ink_height(&picture), 0);
    keys_type_destroy(type);
    font_face_close(face);
    keys_score_finish(&s);
    midi_song_destroy(song);
}

/* A note that is held for hours, with aftertouch all the time: what is kept has an end, and
 * sounds the same. */
static void hours_of_aftertouch_are_not_kept(void **unused)
{
    (void)unused;
    enum { HOUR_S = 3600, HERTZ = 100, CHANNELS = 3 };
    struct keys_def def = keys_def_default();
    struct keys_score forgets, keeps;
    int most = 0;
    assert_true(keys_score_begin(&def, &forgets) && keys_score_begin(&def, &keeps));
    for (int i = 0; i < HOUR_S * HERTZ; i++) {
        const double time_s = (double)i / HERTZ;
        const uint8_t channel = (uint8_t)(i % CHANNELS);
        const uint8_t value = (uint8_t)(i / 7 % 128);
        const uint8_t all[3] = {(uint8_t)(0xd0 | channel), value},
                      one[3] = {(uint8_t)(0xa0 | channel), 60, (uint8_t)(127 - value)};
        const uint8_t on[3] = {(uint8_t)(0x90 | channel), 60, 30},
                      off[3] = {(uint8_t)(0x80 | channel), 60, 64};
        struct keys_score *both[] = {&forgets, &keeps};
        for (int k = 0; k < (i < 60 * HERTZ ? 2 : 1); k++) {
            const bool rests =
                i / HERTZ % 20 == 19 && channel == 2; /* one channel's note ends now and then */
            if (i < CHANNELS || (channel == 2 && i % (20 * HERTZ) < CHANNELS))
                assert_true(keys_score_take(both[k], time_s, on));
            if (rests)
                assert_true(keys_score_take(both[k], time_s, off));
            assert_true(keys_score_take(both[k], time_s, i % 5 ? all : one));
        }
        if (i % HERTZ == 0)
            keys_score_forget(&forgets, time_s);
        most = forgets.pressures_count > most ? forgets.pressures_count : most;
        if (i < 60 * HERTZ) {
            const double level = keys_key_level(&forgets, 60, time_s, NULL);
            assert_true(fabs(level - keys_key_level(&keeps, 60, time_s, NULL)) < 1e-3);
        }
    }
    assert_in_range(most, HERTZ, 4 * HERTZ);
    keys_score_finish(&forgets);
    keys_score_finish(&keeps);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_follow_what_is_played),
        cmocka_unit_test(letters_go_to_keys),
        cmocka_unit_test(hours_of_aftertouch_are_not_kept),
        cmocka_unit_test(heights_in_pixels_follow_velocity),
    };
    return cmocka_run_group_tests_name("keys", tests, NULL, NULL);
}
