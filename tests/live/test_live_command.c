/* test_live_command.c - `lutetia keys` and `lutetia spring`, played live. A film with a map
 * differs from one without where the song has events. Errors get one line. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <display.h>
#include <midi_song.h>

#include "../display/scratch.h"
#include "../lutetia/child.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *lutetia, *maps;

/* Writes a song with a note at 0.5 s and the wheel at 1 s. */
static const char *song_written(void)
{
    static char path[400];
    static const uint8_t bytes[][3] = {{0x90, 60, 100}, {0xb0, 1, 127}, {0x80, 60, 64}};
    static const int ms[] = {500, 1000, 1500};
    const struct midi_song_def def = midi_song_def_default();
    struct midi_song *song;
    snprintf(path, sizeof path, "%s", scratch_path("song.mid"));
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    for (int i = 0; i < 3; i++) {
        struct midi_message m =
            midi_message_make((uint64_t)ms[i] * 1000000, bytes[i][0], bytes[i][1], bytes[i][2]);
        assert_int_equal(midi_song_record(song, 0, &m, 0), MIDI_OK);
    }
    assert_int_equal(midi_song_write(song, path), MIDI_OK);
    midi_song_destroy(song);
    return path;
}

static const char *map_written(const char *text)
{
    static char path[400];
    snprintf(path, sizeof path, "%s", scratch_path("map.lua"));
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    return path;
}

static void must_run(struct child *child)
{
    child_run(child);
    if (child->status != 0)
        fail_msg("exit %d: %s", child->status, child->errors);
}

/* Whether two pictures of a film are the same. */
static bool same(const char *a, const char *b)
{
    struct display_image one = {0}, other = {0};
    assert_int_equal(display_png_read_rgb(a, &one), DISPLAY_OK);
    assert_int_equal(display_png_read_rgb(b, &other), DISPLAY_OK);
    const size_t bytes = (size_t)one.width_px * (size_t)one.height_px * (size_t)one.channels;
    const bool alike = one.width_px == other.width_px && one.height_px == other.height_px &&
                       one.channels == other.channels &&
                       memcmp(one.pixels, other.pixels, bytes) == 0;
    display_image_destroy(&one);
    display_image_destroy(&other);
    return alike;
}

static const char *frame_of(const char *folder, int frame)
{
    static char paths[2][400];
    static int at;
    at = !at;
    snprintf(paths[at], sizeof paths[at], "%s/frame-%06d.png", folder, frame);
    return paths[at];
}

/* Gravity turns with the wheel, at 1 s and not before. */
static void words_do_what_a_song_says(void **unused)
{
    (void)unused;
    char folders[2][300];
    const char *song = song_written();
    static const char *const texts[2] = {
        "function message(m) end",
        "function message(m) if m.kind == 'control' then set('gravity', -9.81) end end"};
    for (int i = 0; i < 2; i++) {
        snprintf(folders[i], sizeof folders[i], "%s", scratch_path(i ? "with" : "without"));
        struct child child = {.arguments = {lutetia, "spring", "wo", "--size", "200x160",
                                            "--fps", "10", "--seconds", "1.5", "--song", song,
                                            "--map", map_written(texts[i]), "--frames",
                                            folders[i]}};
        must_run(&child);
    }
    for (int frame = 0; frame <= 15; frame++)
        if (frame != 10) /* the wheel's frame: the message may come before or after it */
            assert_int_equal(same(frame_of(folders[0], frame), frame_of(folders[1], frame)),
                             frame < 10);
}

static void letters_do_what_a_song_says(void **unused)
{
    (void)unused;
    char folder[300], map[400];
    snprintf(folder, sizeof folder, "%s", scratch_path("letters"));
    snprintf(map, sizeof map, "%s/type.lua", maps);
    struct child child = {.arguments = {lutetia, "keys", song_written(), "--map", map,
                                        "--picture", "200x160", "--fps", "10", "--frames",
                                        folder}};
    must_run(&child);
    assert_true(same(frame_of(folder, 0), frame_of(folder, 4)));  /* nothing yet */
    assert_false(same(frame_of(folder, 4), frame_of(folder, 7))); /* a letter */
    assert_true(same(frame_of(folder, 7), frame_of(folder, 9)));  /* that stays */
    assert_false(
        same(frame_of(folder, 9), frame_of(folder, 12))); /* and grows with the wheel */
}

/* The song's letter, from 0.5 s on, is another one from 0.8 s on. */
static void letters_are_those_that_cues_say(void **unused)
{
    (void)unused;
    char folders[2][300], cues[400];
    static const char *const texts[2] = {"0.1 text \"O\"\n",
                                         "0.1 text \"O\"\n0.8 text \"X\"\n"};
    for (int i = 0; i < 2; i++) {
        snprintf(folders[i], sizeof folders[i], "%s", scratch_path(i ? "other" : "one"));
        snprintf(cues, sizeof cues, "%s", map_written(texts[i]));
        struct child child = {.arguments = {lutetia, "keys", song_written(), "--cues", cues,
                                            "--picture", "200x160", "--fps", "10", "--set",
                                            "size=0.5", "--frames", folders[i]}};
        must_run(&child);
    }
    for (int frame = 0; frame < 15; frame++)
        if (frame != 8) /* the cue's frame: it may be a little before or after it */
            assert_int_equal(same(frame_of(folders[0], frame), frame_of(folders[1], frame)),
                             frame < 8);
}

static void chords_tighten_words(void **unused)
{
    (void)unused;
    char map[400];
    const char *still = scratch_path("chord.png");
    snprintf(map, sizeof map, "%s/chord.lua", maps);
    struct child child = {.arguments = {lutetia, "spring", "wo", "--size", "200x160",
                                        "--seconds", "1", "--song", song_written(), "--map",
                                        map, "--param", "loose=50", "--still", still}};
    must_run(&child);
    struct child wrong = child;
    wrong.arguments[12] = "lose=50";
    child_run(&wrong);
    assert_int_equal(wrong.status, 1);
    assert_non_null(strstr(wrong.errors, "chord.lua asked for no 'lose'"));
}

static void what_cannot_be_is_said(void **unused)
{
    (void)unused;
    const char *song = song_written();
    const char *by_messages = map_written("function message(m) end");
    const struct {
        const char *arguments[10], *said;
        int status;
    } rows[] = {
        {{"keys", "--poster", "x.png"}, "of a song", 2},
        {{"keys", song, "--map", "none.lua", "--poster", "x.png"}, "--still, --frames", 2},
        {{"keys", song, "--map", "none.lua", "--still", "x.png"}, "none.lua: cannot read", 1},
        {{"keys", song, "--cues", "none", "--still", "x.png"}, "none: cannot be read", 1},
        {{"keys", song, "--cues", "none", "--poster", "x.png"}, "--still, --frames", 2},
        {{"keys", song, "--watch", "none", "--still", "x.png"}, "--watch", 2},
        {{"keys", "--range", "c3-d3"}, "an octave or more", 2},
        {{"keys", "--server", "/nowhere/socket"}, "/nowhere/socket", 1},
        {{"spring", "x", "--song", song, "--still", "x.png"}, "--map FILE.lua", 2},
        {{"spring", "x", "--map", "m.lua", "--still", "x.png"}, "m.lua: cannot read", 1},
        {{"spring", "x", "--map", by_messages, "--still", "x.png"}, "--song FILE.mid", 1},
        {{"spring", "x", "--map", "m.lua", "--song", "none.mid", "--still", "x.png"},
         "none.mid",
         1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct child child = {.arguments = {lutetia}};
        for (int k = 0; rows[i].arguments[k]; k++)
            child.arguments[1 + k] = rows[i].arguments[k];
        child_run(&child);
        if (child.status != rows[i].status || !strstr(child.errors, rows[i].said))
            fail_msg("row %zu: exit %d: %s", i, child.status, child.errors);
        assert_true(strchr(child.errors, '\n') == child.errors + strlen(child.errors) - 1);
    }
}

/* A Lua pattern that would take years; no hook of Lua interrupts it. */
static void maps_that_hang_are_ended(void **unused)
{
    (void)unused;
    const char *song = song_written(),
               *map = map_written("function message(m) string.find(string.rep('a', 40), "
                                  "string.rep('a?', 40) .. string.rep('a', 40)) end");
    struct child child = {.arguments = {lutetia, "keys", song, "--map", map, "--still",
                                        scratch_path("hangs.png"), "--at", "1"}};
    child_run(&child);
    assert_int_equal(child.status, 1);
    assert_string_equal(child.errors,
                        "lutetia: the map did not come to an end with a message; ended\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_do_what_a_song_says),
        cmocka_unit_test(letters_do_what_a_song_says),
        cmocka_unit_test(letters_are_those_that_cues_say),
        cmocka_unit_test(chords_tighten_words),
        cmocka_unit_test(what_cannot_be_is_said),
        cmocka_unit_test(maps_that_hang_are_ended),
    };
    lutetia = getenv("LUTETIA");
    maps = getenv("MAPS");
    if (!lutetia || !maps)
        return 77;
    unsetenv("XDG_RUNTIME_DIR");
    return cmocka_run_group_tests_name("live command", tests, NULL, NULL);
}
