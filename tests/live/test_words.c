/* test_words.c - other words on a stage of springs, or of keys, while it is played: typed, from
 * a watched file, undone, and in a session; and the axes of their fonts. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <exact.h>
#include <keys_actor.h>
#include <midi_message.h>
#include <springs.h>
#include <typed_words.h>
#include <watched_text.h>

#include "../display/scratch.h"
#include "../fontpipe/made_font.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static struct font_face *face;
static struct font_shaper *shaper;
static char made_of[2000]; /* the words that were made last */

static enum stage_status word_make(void *context, const char *words,
                                   struct stage_springs_def *out)
{
    struct dyn_word_def word = dyn_word_def_usual();
    (void)context;
    snprintf(made_of, sizeof made_of, "%s", words);
    word.text = words;
    word.shaper = shaper;
    word.y = 2;
    if (dyn_network_create(&out->network) != DYN_OK)
        return STAGE_NO_MEMORY;
    out->style = word.style;
    if (dyn_word_create(out->network, &word, &out->word) == DYN_OK)
        return STAGE_OK;
    dyn_network_destroy(out->network);
    return stage_fail(STAGE_BAD_ARGUMENT, "%s", dyn_error());
}

static struct stage *word_stage(const char *words)
{
    struct stage_springs_def springs = stage_springs_def_default();
    struct stage_def def = stage_def_default();
    struct stage *stage;
    assert_int_equal(word_make(NULL, words, &springs), STAGE_OK);
    springs.maker.make = word_make;
    assert_int_equal(stage_springs_create(&springs, &def.actor), STAGE_OK);
    assert_int_equal(stage_create(&def, &stage), STAGE_OK);
    return stage;
}

static struct dyn_network *network_of(struct stage *stage)
{
    const struct stage_actor actor = stage_actor(stage);
    return stage_springs_network(&actor);
}

static int glyphs_of(struct stage *stage)
{
    struct stage_draw_list list = {0};
    int glyphs = 0;
    stage_picture(stage, 640, 480, 1, &list);
    for (int i = 0; i < list.count; i++)
        glyphs += list.items[i].kind == STAGE_DRAW_GLYPH;
    stage_draw_finish(&list);
    return glyphs;
}

static void frames(struct stage *stage, int from, int to)
{
    for (int i = from; i < to; i++)
        assert_int_equal(stage_frame(stage, i / 30.0, NULL), STAGE_OK);
}

static void letters_that_stay_go_on_moving(void **unused)
{
    (void)unused;
    enum { MASSES = 12 };
    struct stage *stage = word_stage("sea");
    assert_int_equal(stage_set(stage, "gravity=3"), STAGE_OK);
    frames(stage, 0, 20);
    struct dyn_state before[MASSES];
    assert_int_equal(dyn_masses_count(network_of(stage)), MASSES);
    memcpy(before, dyn_network_states(network_of(stage)), sizeof before);
    const double time_s = dyn_network_time_s(network_of(stage));
    assert_int_equal(stage_text(stage, "seat"), STAGE_OK);
    assert_int_equal(dyn_masses_count(network_of(stage)), MASSES + 4);
    assert_memory_equal(before, dyn_network_states(network_of(stage)), sizeof before);
    assert_true(dyn_network_time_s(network_of(stage)) == time_s);
    assert_true(dyn_network_world(network_of(stage))->gravity == 3);
    /* the new letter is beside the last one, and falls with it */
    const struct dyn_state *states = dyn_network_states(network_of(stage));
    for (int i = MASSES; i < MASSES + 4; i++) {
        assert_true(states[i].y < 2.5 && states[i].vy < -1);
        assert_true(states[i].x > before[8].x);
    }
    /* another beginning: the word falls anew */
    assert_int_equal(stage_text(stage, "no"), STAGE_OK);
    assert_int_equal(dyn_masses_count(network_of(stage)), 8);
    for (int i = 0; i < 8; i++)
        assert_true(dyn_network_states(network_of(stage))[i].vy == 0);
    frames(stage, 20, 40);
    stage_destroy(stage);
}

/* A word that stands on its end goes on upwards, and what is tacked lower is raised. */
static void new_letters_stand_as_the_last_one_does(void **unused)
{
    (void)unused;
    struct stage *stage = word_stage("mm");
    struct dyn_network *n = network_of(stage);
    for (int i = 0; i < 8; i++) { /* turned by 90 degrees */
        struct dyn_mass mass = dyn_mass_get(n, i);
        const double x = mass.x, y = mass.y - 2;
        mass.x = -y, mass.y = 2 + x;
        assert_int_equal(dyn_mass_set(n, i, &mass), DYN_OK);
    }
    const struct dyn_state last = dyn_network_states(n)[5]; /* lower right: now at the top */
    assert_int_equal(stage_text(stage, "mmm"), STAGE_OK);
    const struct dyn_state *states = dyn_network_states(network_of(stage));
    for (int k = 8; k < 12; k++)
        assert_true(states[k].y > last.y && states[k].x <= last.x + 1e-9);
    for (int k = 0; k < 4;
         k++) { /* as the letter before, and as far from it as that from the first */
        assert_true(fabs(states[8 + k].x - states[4 + k].x) < 1e-9);
        assert_true(fabs(states[8 + k].y - 2 * states[4 + k].y + states[k].y) < 1e-9);
    }
    stage_destroy(stage);
}

static void undo_brings_words_back(void **unused)
{
    (void)unused;
    struct stage *stage = word_stage("sea");
    frames(stage, 0, 5);
    assert_int_equal(glyphs_of(stage), 3);
    assert_int_equal(stage_text(stage, "ocean"), STAGE_OK);
    assert_int_equal(glyphs_of(stage), 5);
    assert_int_equal(stage_text(stage, "\xff"), STAGE_BAD_ARGUMENT);
    assert_int_equal(stage_text(stage, ""), STAGE_BAD_ARGUMENT);
    assert_int_equal(stage_text(stage, "a\x01"), STAGE_BAD_ARGUMENT);
    assert_int_equal(stage_text(stage, "   "), STAGE_BAD_ARGUMENT); /* no ink */
    char much[STAGE_TEXT_BYTES + 2];
    memset(much, 'a', sizeof much);
    much[sizeof much - 1] = '\0';
    assert_int_equal(stage_text(stage, much), STAGE_BAD_ARGUMENT);
    assert_int_equal(glyphs_of(stage), 5); /* nothing has changed */
    frames(stage, 5, 10);
    assert_true(stage_undo(stage));
    assert_int_equal(glyphs_of(stage), 3);
    assert_int_equal(dyn_masses_count(network_of(stage)), 12);
    frames(stage, 10, 15);
    assert_int_equal(stage_text(stage, "be\ncause"), STAGE_OK);
    assert_int_equal(stage_reset(stage), STAGE_OK);
    assert_int_equal(glyphs_of(stage), 3);
    for (int i = 0; i < 100; i++) /* more than are kept for undo */
        assert_int_equal(stage_text(stage, i % 2 ? "sea" : "seas"), STAGE_OK);
    while (stage_undo(stage))
        ;
    frames(stage, 15, 20);
    stage_destroy(stage);
}

static void sessions_have_the_words(void **unused)
{
    (void)unused;
    const char *path = scratch_path("words.session");
    static const char words[] = "a\\b\nsecond  line\\n \xc3\xa9";
    struct stage *stage = word_stage("sea"), *again = word_stage("sea"), *third;
    frames(stage, 0, 10);
    assert_int_equal(stage_text(stage, "seal"), STAGE_OK);
    frames(stage, 10, 20);
    assert_int_equal(stage_text(stage, words), STAGE_OK);
    frames(stage, 20, 30);
    assert_true(stage_undo(stage));
    frames(stage, 30, 40);
    assert_int_equal(stage_text(stage, words), STAGE_OK);
    frames(stage, 40, 50);
    assert_int_equal(stage_session_save(stage, path), STAGE_OK);
    assert_int_equal(stage_session_replay(again, path), STAGE_OK);
    made_of[0] = '\0';
    frames(again, 0, 50);
    assert_string_equal(made_of, words);
    const size_t bytes = (size_t)dyn_masses_count(network_of(stage)) * sizeof(struct dyn_state);
    assert_int_equal(dyn_masses_count(network_of(stage)), dyn_masses_count(network_of(again)));
    assert_memory_equal(dyn_network_states(network_of(stage)),
                        dyn_network_states(network_of(again)), bytes);
    stage_destroy(stage);
    stage_destroy(again);
    static const char *const wrong[] = {"session 1\n0 text\nend\n",
                                        "session 1\n0 text a\\b\nend\n",
                                        "session 1\n0 text a\\\nend\n"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        FILE *file = fopen(path, "w");
        fputs(wrong[i], file);
        fclose(file);
        third = word_stage("sea");
        assert_int_equal(stage_session_replay(third, path), STAGE_BAD_FILE);
        assert_non_null(strstr(stage_error(), ":2: must be `STEP text WORDS`"));
        stage_destroy(third);
    }
}

static void file_write(const char *path, const char *text, size_t count)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fwrite(text, 1, count, file);
    fclose(file);
}

/* A font with an axis: DejaVu Sans, whose outlines widen along it. */
static struct font_face *wide_open(void)
{
    const char *path = scratch_path("wide.ttf");
    struct font_face_info info;
    struct font_face *wide;
    size_t count, made_count;
    font_face_describe(face, &info);
    FILE *file = fopen(info.path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    count = (size_t)ftell(file);
    rewind(file);
    uint8_t *bytes = malloc(count);
    assert_int_equal(fread(bytes, 1, count, file), count);
    fclose(file);
    uint8_t *made = made_wide(bytes, count, &made_count);
    file_write(path, (const char *)made, made_count);
    free(made);
    free(bytes);
    assert_int_equal(font_face_open(path, 0, &wide), FONT_OK);
    return wide;
}

static void picture_of(struct stage *stage, struct display_image *image)
{
    struct stage_draw_list list = {0};
    struct stage_exact *exact;
    *image = (struct display_image){.width_px = 320, .height_px = 200, .channels = 3};
    assert_int_equal(display_image_create(image), DISPLAY_OK);
    assert_int_equal(stage_exact_create("box", &exact), STAGE_OK);
    stage_picture(stage, image->width_px, image->height_px, 1, &list);
    assert_int_equal(stage_exact_draw(exact, &list, stage_background(stage), image), STAGE_OK);
    stage_exact_destroy(exact);
    stage_draw_finish(&list);
}

static void axes_of_a_font_are_controls(void **unused)
{
    (void)unused;
    struct stage_springs_def springs = stage_springs_def_default();
    struct stage_def def = stage_def_default();
    struct stage *stage;
    struct display_image pictures[4];
    struct font_shaper *usual = shaper;
    springs.face = wide_open();
    assert_int_equal(font_shaper_create(springs.face, &shaper), FONT_OK);
    assert_int_equal(word_make(NULL, "sea", &springs), STAGE_OK);
    assert_int_equal(stage_springs_create(&springs, &def.actor), STAGE_OK);
    assert_int_equal(stage_create(&def, &stage), STAGE_OK);
    picture_of(stage, &pictures[0]);
    assert_int_equal(stage_set(stage, "width=120"), STAGE_BAD_ARGUMENT);
    assert_int_equal(stage_mark(stage), STAGE_OK);
    assert_int_equal(stage_set(stage, "width=110"), STAGE_OK);
    picture_of(stage, &pictures[1]);
    assert_int_equal(stage_set(stage, "width=90"), STAGE_OK);
    picture_of(stage, &pictures[2]);
    assert_true(stage_undo(stage));
    picture_of(stage, &pictures[3]);
    const size_t bytes = (size_t)3 * 320 * 200;
    assert_memory_not_equal(pictures[0].pixels, pictures[1].pixels, bytes);
    assert_memory_not_equal(pictures[0].pixels, pictures[2].pixels, bytes);
    assert_memory_not_equal(pictures[1].pixels, pictures[2].pixels, bytes);
    assert_memory_equal(pictures[0].pixels, pictures[3].pixels, bytes);
    for (int i = 0; i < 4; i++)
        display_image_destroy(&pictures[i]);
    stage_destroy(stage);
    font_shaper_destroy(shaper);
    font_face_close(springs.face);
    shaper = usual;
}

/* The first letter's width as it is drawn, and whether the face is left as it was. */
static double width_drawn(struct stage *stage, struct font_face *wide)
{
    struct stage_draw_list list = {0};
    struct font_axis axis;
    double width = -1;
    stage_picture(stage, 320, 200, 1, &list);
    assert_int_equal(font_face_axis(wide, 0, &axis), FONT_OK);
    assert_true(axis.value == 100);
    for (int i = 0; i < list.count && width < 0; i++)
        if (list.items[i].kind == STAGE_DRAW_GLYPH) {
            const struct stage_letter_axes *axes = &list.items[i].glyph.axes;
            width = axes->count ? axes->axes[0].value : axis.value;
            assert_true(axes->count <= 1);
        }
    stage_draw_finish(&list);
    return width;
}

/* All letters, squeezed or stretched to a part of their width and height. */
static void letters_stretch(struct stage *stage, double part)
{
    struct dyn_network *network = network_of(stage);
    for (int i = 0; i < dyn_masses_count(network); i++) {
        struct dyn_mass mass = dyn_mass_get(network, i);
        mass.x *= part;
        mass.y *= part;
        assert_int_equal(dyn_mass_set(network, i, &mass), DYN_OK);
    }
}

static void strain_leads_axes(void **unused)
{
    (void)unused;
    struct stage_springs_def springs = stage_springs_def_default();
    struct stage_def def = stage_def_default();
    struct stage *stage;
    struct display_image pictures[3];
    struct font_shaper *usual = shaper;
    springs.face = wide_open();
    assert_int_equal(font_shaper_create(springs.face, &shaper), FONT_OK);
    assert_int_equal(word_make(NULL, "sé", &springs), STAGE_OK);
    assert_int_equal(stage_springs_create(&springs, &def.actor), STAGE_OK);
    assert_int_equal(stage_create(&def, &stage), STAGE_OK);
    assert_int_equal(stage_set(stage, "width_strain=1.5"), STAGE_BAD_ARGUMENT);
    letters_stretch(stage, 1.1);
    assert_true(width_drawn(stage, springs.face) == 100); /* nothing leads */
    picture_of(stage, &pictures[0]);
    assert_int_equal(stage_mark(stage), STAGE_OK);
    assert_int_equal(stage_set(stage, "width_strain=1"), STAGE_OK);
    assert_int_equal(stage_set(stage, "full_strain=0.2"), STAGE_OK);
    const double half = width_drawn(stage, springs.face); /* of 90 to 110, in steps */
    assert_true(fabs(half - 105) < 0.5);
    picture_of(stage, &pictures[1]);
    assert_int_equal(stage_set(stage, "full_strain=0.05"), STAGE_OK);
    assert_true(width_drawn(stage, springs.face) == 110); /* its most, no further */
    assert_int_equal(stage_set(stage, "width_strain=-0.5"), STAGE_OK);
    assert_true(fabs(width_drawn(stage, springs.face) - 90) < 0.5 + 5);
    assert_int_equal(stage_set(stage, "width_strain=1"), STAGE_OK);
    letters_stretch(stage, 0.8 / 1.1);
    assert_true(width_drawn(stage, springs.face) == 90); /* squeezed: its least */
    assert_true(stage_undo(stage));
    picture_of(stage, &pictures[2]);
    const size_t bytes = (size_t)3 * 320 * 200;
    assert_memory_not_equal(pictures[0].pixels, pictures[1].pixels, bytes);
    assert_memory_equal(pictures[0].pixels, pictures[2].pixels, bytes);
    for (int i = 0; i < 3; i++)
        display_image_destroy(&pictures[i]);
    stage_destroy(stage);
    font_shaper_destroy(shaper);
    font_face_close(springs.face);
    shaper = usual;
}

/* ---- letters that keys play ---- */

static struct stage *keys_stage(struct font_face *of, struct stage_actor *actor)
{
    struct keys_actor_def keys = keys_actor_def_default();
    struct stage_def def = stage_def_default();
    struct stage *stage;
    keys.face = of;
    keys.text = "abc";
    keys.keys.attack_s = 0;
    assert_int_equal(keys_actor_create(&keys, actor), STAGE_OK);
    def.actor = *actor;
    assert_int_equal(stage_create(&def, &stage), STAGE_OK);
    return stage;
}

static void play(const struct stage_actor *actor, int status, int first, int second)
{
    const uint8_t bytes[3] = {(uint8_t)status, (uint8_t)first, (uint8_t)second};
    assert_int_equal(keys_actor_play(actor, bytes), STAGE_OK);
}

static void notes_lead_axes(void **unused)
{
    (void)unused;
    struct stage_actor actor;
    struct font_face *wide = wide_open();
    struct stage *stage = keys_stage(wide, &actor);
    play(&actor, MIDI_NOTE_ON, 60, 127);
    assert_true(width_drawn(stage, wide) == 100);
    assert_int_equal(stage_set(stage, "width_velocity=1"), STAGE_OK);
    assert_true(width_drawn(stage, wide) == 110);
    assert_int_equal(stage_set(stage, "width_velocity=-1"), STAGE_OK);
    assert_true(width_drawn(stage, wide) == 90);
    assert_int_equal(stage_set(stage, "width_velocity=0"), STAGE_OK);
    assert_int_equal(stage_set(stage, "width_pressure=1"), STAGE_OK);
    assert_true(width_drawn(stage, wide) == 100);
    play(&actor, MIDI_PRESSURE, 127, 0);
    assert_true(width_drawn(stage, wide) == 110);
    assert_int_equal(stage_set(stage, "width_pressure=0"), STAGE_OK);
    assert_int_equal(stage_set(stage, "width_pitch=1"), STAGE_OK);
    assert_true(width_drawn(stage, wide) == 100); /* the middle of the range c3 to c5 */
    play(&actor, MIDI_NOTE_OFF, 60, 64);
    assert_int_equal(stage_reset(stage), STAGE_OK);
    play(&actor, MIDI_NOTE_ON, 72, 127);
    assert_int_equal(stage_set(stage, "width_pitch=1"), STAGE_OK);
    assert_true(width_drawn(stage, wide) == 110);
    stage_destroy(stage);
    font_face_close(wide);
}

/* The glyph of what sounds loudest. */
static uint32_t glyph_drawn(struct stage *stage)
{
    struct stage_draw_list list = {0};
    uint32_t glyph = 0;
    stage_picture(stage, 320, 200, 1, &list);
    for (int i = 0; i < list.count; i++)
        if (list.items[i].kind == STAGE_DRAW_GLYPH)
            glyph = list.items[i].glyph.glyph;
    stage_draw_finish(&list);
    return glyph;
}

static void keys_have_other_words_while_they_sound(void **unused)
{
    (void)unused;
    struct stage_actor actor;
    struct stage *stage = keys_stage(face, &actor);
    play(&actor, MIDI_NOTE_ON, 48, 100);
    assert_int_equal(glyph_drawn(stage), font_face_glyph(face, 'a'));
    assert_int_equal(stage_text(stage, "xyz"), STAGE_OK);
    assert_int_equal(glyph_drawn(stage), font_face_glyph(face, 'x')); /* it goes on */
    assert_true(keys_actor_level(&actor, 48) > 0.7);
    assert_int_equal(stage_text(stage, " \n\t"), STAGE_BAD_ARGUMENT); /* no letter */
    assert_int_equal(stage_text(stage, "\xff"), STAGE_BAD_ARGUMENT);
    assert_int_equal(glyph_drawn(stage), font_face_glyph(face, 'x'));
    assert_true(stage_undo(stage));
    play(&actor, MIDI_NOTE_ON, 48, 100);
    assert_int_equal(glyph_drawn(stage), font_face_glyph(face, 'a'));
    stage_destroy(stage);
}

static bool key(struct typed_words *w, struct stage *stage, int code, unsigned modifiers)
{
    enum stage_status status;
    const struct input_event e = {.kind = INPUT_KEY_DOWN, .key = code, .modifiers = modifiers};
    const bool took = typed_words_input(w, stage, &e, &status);
    assert_int_equal(status, STAGE_OK);
    return took;
}

static void character(struct typed_words *w, struct stage *stage, uint32_t c)
{
    enum stage_status status;
    const struct input_event e = {.kind = INPUT_TEXT, .character = c};
    assert_true(typed_words_input(w, stage, &e, &status));
}

static void typed_words_are_the_stages(void **unused)
{
    (void)unused;
    struct stage *stage = word_stage("sea");
    struct typed_words w = {0};
    assert_false(key(&w, stage, INPUT_KEY_ENTER, 0));
    typed_words_begin(&w, true);
    character(&w, stage, 'h');
    character(&w, stage, 0xe9);
    character(&w, stage, 0x20ac);
    character(&w, stage, 0x1d11e);
    assert_string_equal(w.text, "h\xc3\xa9\xe2\x82\xac\xf0\x9d\x84\x9e");
    assert_true(key(&w, stage, INPUT_KEY_BACKSPACE, 0));
    assert_true(key(&w, stage, INPUT_KEY_BACKSPACE, 0));
    assert_true(key(&w, stage, INPUT_KEY_ENTER, INPUT_SHIFT));
    character(&w, stage, 'x');
    assert_true(key(&w, stage, 'R', 0)); /* no key does anything else meanwhile */
    assert_true(key(&w, stage, INPUT_KEY_ENTER, 0));
    assert_string_equal(made_of, "h\xc3\xa9\nx");
    assert_false(w.typing);
    typed_words_begin(&w, true);
    character(&w, stage, 'q');
    assert_true(key(&w, stage, INPUT_KEY_ESCAPE, 0));
    assert_string_equal(made_of, "h\xc3\xa9\nx");
    typed_words_begin(&w, true);
    for (int i = 0; i < 2000; i++)
        character(&w, stage, 0x20ac);
    assert_int_equal(strlen(w.text), 999); /* whole characters */
    stage_destroy(stage);
}

/* security.md 6: a pipe in the file's place holds nothing up. */
static void a_watched_file_is_read_when_it_has_changed(void **unused)
{
    (void)unused;
    const char *path = scratch_path("cue.txt"), *other = scratch_path("other.txt");
    struct watched_text *w;
    assert_int_equal(watched_text_open(scratch_path("none.txt"), &w), STAGE_BAD_FILE);
    file_write(path, "one\r\n\n", 6);
    assert_int_equal(watched_text_open(path, &w), STAGE_OK);
    assert_string_equal(watched_text_look(w, 0), "one");
    assert_null(watched_text_look(w, 1));
    file_write(path, "two lines\nhere\n", 15);
    assert_null(watched_text_look(w, 2)); /* it may still be written */
    assert_string_equal(watched_text_look(w, 3), "two lines\nhere");
    assert_null(watched_text_look(w, 4));
    unlink(path);
    assert_null(watched_text_look(w, 5));
    assert_null(watched_text_look(w, 6));
    file_write(other, "three", 5);
    assert_int_equal(rename(other, path), 0);
    assert_null(watched_text_look(w, 7));
    assert_null(watched_text_look(w, 7.05)); /* ten times a second */
    assert_string_equal(watched_text_look(w, 7.2), "three");
    file_write(path, "a\0b", 3);
    watched_text_look(w, 8);
    assert_null(watched_text_look(w, 9));
    assert_non_null(strstr(watched_text_wrong(w), "must be text of 1000 bytes"));
    assert_null(watched_text_wrong(w));
    unlink(path);
    assert_int_equal(mkfifo(path, 0600), 0);
    watched_text_look(w, 10);
    assert_null(watched_text_look(w, 11));
    assert_non_null(strstr(watched_text_wrong(w), "cannot be read"));
    watched_text_close(w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(letters_that_stay_go_on_moving),
        cmocka_unit_test(new_letters_stand_as_the_last_one_does),
        cmocka_unit_test(undo_brings_words_back),
        cmocka_unit_test(sessions_have_the_words),
        cmocka_unit_test(axes_of_a_font_are_controls),
        cmocka_unit_test(strain_leads_axes),
        cmocka_unit_test(notes_lead_axes),
        cmocka_unit_test(keys_have_other_words_while_they_sound),
        cmocka_unit_test(typed_words_are_the_stages),
        cmocka_unit_test(a_watched_file_is_read_when_it_has_changed)};
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK ||
        font_shaper_create(face, &shaper) != FONT_OK)
        return 1;
    const int failed = cmocka_run_group_tests_name("words", tests, NULL, NULL);
    font_shaper_destroy(shaper);
    font_face_close(face);
    return failed;
}
