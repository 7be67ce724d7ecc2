/* test_voice_letters.c - the letters that a voice plays: their choice, sizes and places,
 * measured on the pictures. */
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
#include <voice_cry.h>
#include <voice_picture.h>

enum { WIDTH = 480, HEIGHT = 300 };

static uint8_t pixels[HEIGHT][WIDTH][3];
static struct font_picture picture = {WIDTH, HEIGHT, 3 * WIDTH, &pixels[0][0][0]};

static struct voice_frame *frames;
static int frames_count;
static struct voice_score score;

static void cry(void)
{
    struct voice_cry cry = voice_cry_default();
    struct voice_def def = voice_def_default();
    size_t count;
    bool empty;
    float *samples = voice_cry_make(&cry, &count);
    assert_non_null(samples);
    assert_true(voice_frames(&def, samples, count, cry.rate_hz, &frames, &frames_count));
    assert_true(voice_score_make(frames, frames_count, 0.03, &score, &empty));
    free(samples);
}

/* Periodic bursts of half a second, with a silence after each. */
enum { BURST = 50, GAP = 50 };

static void bursts_time(const char *text, int count, struct voice_words *words,
                        struct voice_timing *timing)
{
    static struct voice_frame played[16 * (BURST + GAP)];
    bool empty;
    for (int i = 0; i < count * (BURST + GAP); i++) {
        const bool heard = i % (BURST + GAP) < BURST;
        played[i] = (struct voice_frame){.time_s = i / 100.0,
                                         .level = heard ? 0.1 : 0,
                                         .envelope = heard ? 0.1 : 0,
                                         .pitch_hz = heard ? 120 : 0};
    }
    assert_true(voice_words_make(text, words, &empty));
    assert_true(voice_align(words, played, count * (BURST + GAP), 0.004, timing));
}

/* What is shown in each burst, by |, and in no silence. */
static void shown(const char *text, int count, const char *expected)
{
    struct voice_words words;
    struct voice_timing timing;
    char found[300] = "";
    bursts_time(text, count, &words, &timing);
    for (int i = 0; i < count; i++) {
        for (int k = 2, last = -1; k < BURST - 2; k++) {
            const int word = voice_word_at(&timing, i + k / 100.0);
            int begin, end;
            if (word == last)
                continue;
            assert_true(word >= 0);
            voice_word_bytes(&words, word, &begin, &end);
            snprintf(found + strlen(found), sizeof found - strlen(found), "%s%.*s",
                     last >= 0 ? " " : "", end - begin, text + begin);
            last = word;
        }
        strcat(found, "|");
        for (int k = BURST + 2; k < BURST + GAP - 2; k++)
            assert_int_equal(voice_word_at(&timing, i + k / 100.0), -1);
    }
    assert_string_equal(found, expected);
    voice_timing_finish(&timing);
    voice_words_finish(&words);
}

static void words_are_spread_over_sounds(void **state)
{
    (void)state;
    struct voice_words words;
    bool empty;
    shown("Aagh", 4, "Aagh|Aagh|Aagh|Aagh|");
    shown("elephant. Why", 2, "elephant.|Why|");
    shown("  one,\n\"two\"!  three. four ", 4, "one,|\"two\"!|three.|four|");
    shown("we saw. They all left, and then? No", 4, "we saw.|They all left,|and then?|No|");
    shown("oh. oh", 4, "oh.|oh.|oh|oh|");
    assert_false(voice_words_make(" \t\xe2\x80\x83", &words, &empty));
    assert_true(empty);
}

static void letters_share_the_time(void **state)
{
    (void)state;
    struct voice_words words;
    struct voice_timing timing;
    bool empty;
    /* one word is spread over both sounds, a quarter of a second for each letter, and none is
     * in the silence */
    bursts_time("\xc2\xab"
                "Aa\xcc\x81gh!\xc2\xbb",
                2, &words, &timing);
    assert_int_equal(words.letters_count, 4);
    for (int i = 0; i < 4; i++) {
        const double from_s = i / 2 + i % 2 * 0.25;
        assert_true(fabs(timing.letters[i].begin_s - from_s) < 0.011);
        assert_true(fabs(timing.letters[i].end_s - from_s - 0.25) < 0.011);
    }
    const struct voice_letter *l = words.letters;
    assert_true(l[0].before == 0 && l[0].begin == 2 &&
                l[0].end == 3);                     /* the quotation mark goes before */
    assert_true(l[1].begin == 3 && l[1].end == 6);  /* with its accent */
    assert_true(l[3].end == 8 && l[3].after == 11); /* "!»" comes after */
    voice_timing_finish(&timing);
    voice_words_finish(&words);
    bursts_time("wow !!!", 2, &words, &timing); /* nothing but punctuation is letters */
    assert_int_equal(words.letters_count, 6);
    assert_true(timing.letters[5].end_s <= 1.51 && timing.letters[5].begin_s > 1);
    voice_timing_finish(&timing);
    voice_words_finish(&words);
    assert_true(voice_words_make("\xff\xfe\x80", &words, &empty)); /* no UTF-8: as many signs */
    assert_true(words.letters_count >= 1 && words.letters[words.letters_count - 1].after == 3);
    voice_words_finish(&words);
}

static void joined_words_are_whole(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool joins, to_left;
    } texts[] = {{"Aagh!", false, false},
                 {"\xd8\xa7\xd9\x84\xd8\xa8\xd8\xa7\xd8\xa8", true, true},
                 {"\xe0\xa4\xb9\xe0\xa4\xbf\xe0\xa4\xa8", true, false},
                 {"\xd0\x94\xd0\xb0", false, false}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct voice_words words;
        bool empty;
        assert_true(voice_words_make(texts[i].text, &words, &empty));
        assert_int_equal(voice_word_joins(&words, 0), texts[i].joins);
        assert_int_equal(voice_words_to_left(&words), texts[i].to_left);
        voice_words_finish(&words);
    }
}

static void mappings_are_read(void **state)
{
    (void)state;
    char why[200];
    struct voice_mapping mapping = voice_mapping_default();
    assert_int_equal(mapping.feature[TYPE_SIZE], VOICE_ENVELOPE);
    assert_true(voice_mapping_read(
        &mapping, "size=nothing,ink=vowel,baseline=pitch,width=level", why, sizeof why));
    assert_int_equal(mapping.feature[TYPE_SIZE], VOICE_NOTHING);
    assert_int_equal(mapping.feature[TYPE_INK], VOICE_VOWEL);
    assert_int_equal(mapping.feature[TYPE_BASELINE], VOICE_PITCH);
    assert_int_equal(mapping.feature[TYPE_WIDTH], VOICE_LEVEL);
    static const char *const wrong[][2] = {
        {"", "a mapping is like"},
        {"size", "a mapping is like"},
        {"size=", "no feature ''"},
        {"size=loud", "there are nothing, envelope, level"},
        {"colour=pitch", "there are size, weight, width, slant, baseline, ink"},
        {"size=vowel", "plays ink only"},
        {"size=pitch,", "a mapping is like"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_false(voice_mapping_read(&mapping, wrong[i][0], why, sizeof why));
        assert_non_null(strstr(why, wrong[i][1]));
    }
    assert_int_equal(mapping.feature[TYPE_INK], VOICE_VOWEL); /* as it was */
}

static double correlation(const double *x, const double *y, int n)
{
    double sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
    for (int i = 0; i < n; i++) {
        sx += x[i];
        sy += y[i];
        sxx += x[i] * x[i];
        syy += y[i] * y[i];
        sxy += x[i] * y[i];
    }
    return (n * sxy - sx * sy) / sqrt((n * sxx - sx * sx) * (n * syy - sy * sy));
}

/* The height of the ink in rows; the first and last row count by their darkness. */
static double ink_height(double *middle)
{
    int first = -1, last = -1;
    double darkest[HEIGHT];
    for (int y = 0; y < HEIGHT; y++) {
        darkest[y] = 0;
        for (int x = 0; x < WIDTH; x++)
            darkest[y] = fmax(darkest[y], 1 - pixels[y][x][1] / 255.0);
        if (darkest[y] > 0.02) {
            first = first < 0 ? y : first;
            last = y;
        }
    }
    *middle = (first + last) / 2.0;
    return first < 0 ? 0 : last - first + 1;
}

static void heights_follow_the_envelope(void **state)
{
    (void)state;
    enum { MOMENTS = 84 };
    struct voice_type_def def = voice_type_def_default();
    struct voice_type *type;
    struct voice_words words;
    struct font_face *face;
    double heights[MOMENTS], envelope[MOMENTS], middles[MOMENTS], pitch[MOMENTS];
    int count = 0;
    bool empty;
    assert_int_equal(font_face_open("DejaVuSans", 0, &face), FONT_OK);
    struct voice_timing timing;
    assert_true(voice_words_make("H", &words, &empty));
    assert_true(voice_align(&words, frames, frames_count, 0.004, &timing));
    def.size_px[0] = 8;
    def.size_px[1] = 220;
    for (int played = 0; played < 2; played++) {
        if (played) { /* the size is constant, the baseline follows the pitch */
            assert_true(voice_mapping_read(&def.mapping, "size=nothing,baseline=pitch",
                                           (char[200]){0}, 200));
            def.size_px[1] = 60;
            def.rise_em = 2;
        }
        assert_int_equal(voice_type_create(&def, face, &words, &timing, &score, &type),
                         FONT_OK);
        count = 0;
        for (int i = 0; i < MOMENTS; i++) {
            double time_s = i * score.seconds / MOMENTS;
            if (played &&
                voice_word_at(&timing, time_s) < 0) /* nothing is shown in a silence */
                continue;
            assert_int_equal(voice_type_moment(type, time_s, &picture), FONT_OK);
            heights[count] = ink_height(&middles[count]);
            envelope[count] = voice_score_at(&score, VOICE_ENVELOPE, time_s);
            pitch[count] = -voice_score_at(&score, VOICE_PITCH, time_s);
            count++;
        }
        if (played)
            assert_true(correlation(middles, pitch, count) > 0.99);
        else
            assert_true(correlation(heights, envelope, count) > 0.99);
        voice_type_destroy(type);
    }
    voice_timing_finish(&timing);
    voice_words_finish(&words);
    font_face_close(face);
}

/* An attack is marked where a sound has risen most. It begins where it began to rise, if that
 * is not long ago. */
static void sounds_begin_where_they_rise(void **state)
{
    (void)state;
    enum { FRAMES = 300 };
    static const struct {
        int from, to, attack;
        double begins_s;
    } rises[] = {{50, 56, 54, 0.5}, {120, 124, 124, 1.2}, {160, 200, 195, 1.89}};
    static struct voice_frame played[FRAMES];
    struct voice_score made;
    bool empty;
    for (int i = 0; i < FRAMES; i++) {
        played[i] = (struct voice_frame){.time_s = i / 100.0};
        for (int k = 0; k < 3; k++)
            if (i >= rises[k].from && i < rises[k].from + 60)
                played[i].envelope =
                    i <= rises[k].to ? (i - rises[k].from) / 100.0 : (280 - i) / 1e4;
    }
    for (int k = 0; k < 3; k++)
        played[rises[k].attack].attack = true;
    assert_true(voice_score_make(played, FRAMES, 0.02, &made, &empty));
    assert_int_equal(made.begins, 3);
    for (int k = 0; k < 3; k++)
        if (fabs(made.begin_s[k] - rises[k].begins_s) > 0.011)
            fail_msg("sound %d begins at %g, not %g", k, made.begin_s[k], rises[k].begins_s);
    voice_score_finish(&made);
}

/* Lines of a text in the cry: their widths are added. */
static double lines_of(const struct voice_type_def *def, struct font_face *face,
                       const char *text, double second_px, double most_px, int *lines_count,
                       bool draw)
{
    struct voice_words words;
    struct voice_timing timing;
    struct voice_type *type;
    struct voice_line *lines;
    double width = 0, middle;
    bool empty;
    int word = 0;
    assert_true(voice_words_make(text, &words, &empty));
    assert_true(voice_align(&words, frames, frames_count, 0.004, &timing));
    assert_int_equal(voice_type_create(def, face, &words, &timing, &score, &type), FONT_OK);
    assert_int_equal(voice_type_lines(type, second_px, most_px, &lines, lines_count), FONT_OK);
    for (int i = 0; i < *lines_count; i++) {
        assert_int_equal(lines[i].first_word, word);
        assert_true(lines[i].end_word > word);
        assert_true(lines[i].width_px <= most_px || lines[i].end_word == word + 1);
        word = lines[i].end_word;
        width += lines[i].width_px;
    }
    assert_int_equal(word, words.count);
    if (draw) {
        voice_type_paper(type, &picture);
        assert_int_equal(voice_type_line(type, second_px, lines, 10, 100, &picture), FONT_OK);
        assert_true(ink_height(&middle) > 20);
    }
    free(lines);
    voice_type_destroy(type);
    voice_timing_finish(&timing);
    voice_words_finish(&words);
    return width;
}

static void every_letter_is_on_the_line(void **state)
{
    (void)state;
    static const char fox[] = "the quick brown fox jumps over the lazy dog and the quick "
                              "brown fox jumps over the lazy dog";
    struct voice_type_def def = voice_type_def_default();
    struct font_face *face;
    int count;
    assert_int_equal(font_face_open("DejaVuSans", 0, &face), FONT_OK);
    def.size_px[0] = 4;
    def.size_px[1] = 40;
    const double narrow = lines_of(&def, face, "Aagh", 100, 1e6, &count, false),
                 wide = lines_of(&def, face, "Aagh", 200, 1e6, &count, false);
    const double seconds = score.end_s - score.begin_s[0];
    assert_true(fabs(narrow - 100 * seconds) < 60 && fabs(wide - 200 * seconds) < 60);
    /* more letters than fit into the time */
    const double longer = lines_of(&def, face, fox, 10, 1e6, &count, true);
    assert_int_equal(count, 1);
    assert_true(longer > 3 * 10 * seconds);
    /* and broken into lines, nothing but the spaces between them is lost */
    const double broken = lines_of(&def, face, fox, 10, 200, &count, true);
    assert_true(count >= 4 && broken < longer && broken > longer - 30 * count);
    font_face_close(face);
}

static double always(double t)
{
    (void)t;
    return 1;
}
static double low(double t)
{
    (void)t;
    return 110;
}
static void open_vowel(double t, double formant_hz[2])
{
    (void)t;
    formant_hz[0] = 730;
    formant_hz[1] = 1090;
}

static void vowels_are_inks(void **state)
{
    (void)state;
    struct voice_cry man = {0.5, 22050, always, low, open_vowel};
    struct voice_def hearing = voice_def_default();
    struct voice_frame *said;
    struct voice_score spoken;
    size_t samples_count;
    int said_count;
    float *samples = voice_cry_make(&man, &samples_count);
    assert_non_null(samples);
    assert_true(
        voice_frames(&hearing, samples, samples_count, man.rate_hz, &said, &said_count));
    struct voice_type_def def = voice_type_def_default();
    struct voice_type *type;
    struct voice_words words;
    struct font_face *face;
    bool empty;
    int reddest = 0;
    assert_int_equal(font_face_open("DejaVuSans", 0, &face), FONT_OK);
    assert_true(voice_words_make("H", &words, &empty));
    assert_true(voice_score_make(said, said_count, 0.03, &spoken, &empty));
    def.inks[0][0] = 1; /* [a] is red */
    assert_true(voice_mapping_read(&def.mapping, "ink=vowel", (char[200]){0}, 200));
    assert_int_equal(voice_type_create(&def, face, &words, NULL, &spoken, &type), FONT_OK);
    assert_int_equal(voice_type_moment(type, 0.25, &picture), FONT_OK);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            reddest = pixels[y][x][0] - pixels[y][x][2] > reddest
                          ? pixels[y][x][0] - pixels[y][x][2]
                          : reddest;
    assert_true(reddest > 100);
    voice_type_destroy(type);
    voice_words_finish(&words);
    voice_score_finish(&spoken);
    free(said);
    free(samples);
    font_face_close(face);
}

int main(void)
{
    cry();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_are_spread_over_sounds),
        cmocka_unit_test(letters_share_the_time),
        cmocka_unit_test(joined_words_are_whole),
        cmocka_unit_test(mappings_are_read),
        cmocka_unit_test(heights_follow_the_envelope),
        cmocka_unit_test(sounds_begin_where_they_rise),
        cmocka_unit_test(every_letter_is_on_the_line),
        cmocka_unit_test(vowels_are_inks),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    voice_score_finish(&score);
    free(frames);
    return failed;
}
