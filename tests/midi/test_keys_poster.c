/* test_keys_poster.c - songs as posters: each note is a letter that stands alone, on lines of
 * the width that is asked for. Letters are counted in the picture, as pieces of ink that touch.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <keys_poster.h>

#include "../sample.h"

#include <math.h>

enum { SONGS = 12, NOTES = 60, MARGIN = 40 };

struct made {
    struct midi_song *song;
    struct keys_score score;
    struct keys_letters letters;
    struct font_face *face;
    struct keys_type *type;
    struct keys_poster *poster;
};

static void note_put(struct midi_song *song, double at_s, int channel, int key, int velocity)
{
    struct midi_message m =
        midi_message_make((uint64_t)llround(at_s * 1e9), (uint8_t)(0x90 | channel),
                          (uint8_t)key, (uint8_t)velocity);
    assert_int_equal(midi_song_record(song, 0, &m, 0), MIDI_OK);
}

static struct midi_song *song_new(void)
{
    const struct midi_song_def def = midi_song_def_default();
    struct midi_song *song;
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    return song;
}

/* Letters of one piece each: C, D, E, ... without accidentals. */
static void poster_make(struct midi_song *song, double second_px, double line_px,
                        struct made *m)
{
    const struct keys_def def = keys_def_default();
    struct keys_type_def type = keys_type_def_default();
    bool empty;
    *m = (struct made){.song = song};
    assert_true(keys_score_make(&def, song, &m->score, &empty));
    keys_letters_names(&m->letters);
    assert_true(keys_letters_text(&m->score, "CDEFGAB", &m->letters));
    assert_int_equal(font_face_open("DejaVuSans", 0, &m->face), FONT_OK);
    type.size_px[1] = 80;
    memset(type.inks, 0, sizeof type.inks);
    assert_int_equal(keys_type_create(&type, m->face, &m->score, &m->letters, &m->type),
                     FONT_OK);
    assert_int_equal(keys_poster_create(m->type, second_px, line_px, &m->poster), FONT_OK);
}

static void poster_finish(struct made *m)
{
    keys_poster_destroy(m->poster);
    keys_type_destroy(m->type);
    font_face_close(m->face);
    keys_score_finish(&m->score);
    midi_song_destroy(m->song);
}

/* Owns: the caller frees out->rgb. */
static void line_draw(struct made *m, int line, struct font_picture *out)
{
    const int width = (int)ceil(keys_poster_width(m->poster)) + 2 * MARGIN;
    const int height = (int)ceil(keys_poster_height(m->poster)) + 2 * MARGIN;
    *out = (struct font_picture){width, height, 3 * width,
                                 malloc(3 * (size_t)width * (size_t)height)};
    assert_non_null(out->rgb);
    keys_type_paper(m->type, out);
    assert_int_equal(keys_poster_draw(m->poster, line, MARGIN, MARGIN, out), FONT_OK);
}

static bool inked(const struct font_picture *p, int x, int y)
{
    return x >= 0 && y >= 0 && x < p->width_px && y < p->height_px &&
           p->rgb[(size_t)y * (size_t)p->pitch + 3 * (size_t)x] < 170;
}

/* How many pieces of ink there are whose pixels touch, and which columns have some. */
static int pieces_count(struct font_picture *p, int *leftmost, int *rightmost)
{
    int pieces = 0;
    int *stack = malloc(sizeof *stack * 8 * (size_t)p->width_px * (size_t)p->height_px);
    assert_non_null(stack);
    for (int y = 0; y < p->height_px; y++)
        for (int x = 0; x < p->width_px; x++) {
            int depth = 0;
            if (!inked(p, x, y))
                continue;
            pieces++;
            stack[depth++] = y * p->width_px + x;
            while (depth > 0) {
                const int at = stack[--depth], ax = at % p->width_px, ay = at / p->width_px;
                if (!inked(p, ax, ay))
                    continue;
                p->rgb[(size_t)ay * (size_t)p->pitch + 3 * (size_t)ax] = 255;
                *leftmost = ax < *leftmost ? ax : *leftmost;
                *rightmost = ax > *rightmost ? ax : *rightmost;
                for (int k = 0; k < 9; k++)
                    if (inked(p, ax + k % 3 - 1, ay + k / 3 - 1))
                        stack[depth++] = (ay + k / 3 - 1) * p->width_px + ax + k % 3 - 1;
            }
        }
    free(stack);
    return pieces;
}

/* Draws all lines; each note is one piece of ink, and no line is wider than it may be. */
static int lines_check(struct made *m, double line_px)
{
    int pieces = 0;
    for (int i = 0; i < keys_poster_lines(m->poster); i++) {
        struct font_picture picture;
        int left = 1 << 30, right = -1;
        line_draw(m, i, &picture);
        pieces += pieces_count(&picture, &left, &right);
        assert_in_range(left, MARGIN - 2, MARGIN + 90); /* a line begins with a note */
        assert_true(right <= MARGIN + line_px + 3 * 80);
        free(picture.rgb);
    }
    return pieces;
}

/* Runs of single notes, an eighth of a second apart at the least, where a letter of a third
 * of its size has room. */
static void no_letter_covers_another_in_runs(void **unused)
{
    (void)unused;
    uint64_t seed = 77;
    for (int i = 0; i < SONGS; i++) {
        struct midi_song *song = song_new();
        struct made m;
        double at_s = 0;
        const int channels = 1 + (int)(sample_word(&seed) % 3);
        for (int k = 0; k < NOTES; k++) {
            at_s += 0.125 + (double)(sample_word(&seed) % 300) / 1000;
            note_put(song, at_s, (int)(sample_word(&seed) % (uint64_t)channels),
                     48 + (int)(sample_word(&seed) % 24), 60 + (int)(sample_word(&seed) % 67));
        }
        const double line_px = 500 + (double)(sample_word(&seed) % 3000);
        poster_make(song, 240, line_px, &m);
        assert_int_equal(lines_check(&m, line_px), NOTES);
        poster_finish(&m);
    }
}

/* Chords of up to five notes, also of one key in several channels. */
static void no_letter_covers_another_in_chords(void **unused)
{
    (void)unused;
    uint64_t seed = 78;
    for (int i = 0; i < SONGS; i++) {
        struct midi_song *song = song_new();
        struct made m;
        int notes = 0;
        for (int k = 0; k < NOTES / 3; k++) {
            const double at_s = k * 0.6;
            const int channel = (int)(sample_word(&seed) % 4);
            uint64_t keys = 0;
            for (uint64_t n = sample_word(&seed) % 5 + 1; n > 0; n--)
                keys |= (uint64_t)1 << (sample_word(&seed) % 24);
            for (int key = 0; key < 24; key++)
                if (keys >> key & 1) {
                    note_put(song, at_s + 0.001 * (double)(sample_word(&seed) % 20), channel,
                             48 + key, 50 + (int)(sample_word(&seed) % 77));
                    notes++;
                }
        }
        const double line_px = 800 + (double)(sample_word(&seed) % 2000);
        poster_make(song, 240, line_px, &m);
        assert_int_equal(lines_check(&m, line_px), notes);
        poster_finish(&m);
    }
}

/* Nine minutes are lines of about one length; an hour of silence is no line. */
static void lines_are_as_many_as_needed(void **unused)
{
    (void)unused;
    struct midi_song *song = song_new();
    struct made m;
    for (int i = 0; i < 9 * 60 * 2; i++)
        note_put(song, i * 0.5, 0, 60 + i % 12, 100);
    poster_make(song, 160, 4800, &m);
    assert_int_equal(keys_poster_lines(m.poster), 18); /* 86,320 px */
    assert_in_range((int)keys_poster_width(m.poster), 4700, 5600);
    poster_finish(&m);
    song = song_new();
    note_put(song, 0, 0, 60, 127);
    note_put(song, 3600, 0, 62, 127);
    poster_make(song, 160, 4800, &m);
    assert_int_equal(keys_poster_lines(m.poster), 2);
    assert_int_equal(lines_check(&m, 4800), 2);
    poster_finish(&m);
}

static void channels_have_inks_of_their_own(void **unused)
{
    (void)unused;
    const struct keys_type_def def = keys_type_def_default();
    for (int i = 0; i < KEYS_INKS; i++)
        for (int k = 0; k < i; k++) {
            double apart = 0;
            for (int c = 0; c < 3; c++)
                apart += fabs(def.inks[i][c] - def.inks[k][c]);
            assert_true(apart > 0.25);
        }
    for (int i = 0; i < KEYS_INKS; i++) { /* WCAG's contrast to white */
        double light[3];
        for (int c = 0; c < 3; c++)
            light[c] = def.inks[i][c] <= 0.04045 ? def.inks[i][c] / 12.92
                                                 : pow((def.inks[i][c] + 0.055) / 1.055, 2.4);
        assert_true(1.05 / (0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2] + 0.05) >=
                    4.5);
    }
    assert_int_equal(KEYS_INKS, MIDI_CHANNELS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_letter_covers_another_in_runs),
        cmocka_unit_test(no_letter_covers_another_in_chords),
        cmocka_unit_test(lines_are_as_many_as_needed),
        cmocka_unit_test(channels_have_inks_of_their_own),
    };
    return cmocka_run_group_tests_name("keys_poster", tests, NULL, NULL);
}
