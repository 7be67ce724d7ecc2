/* test_live.c - live playing: songs, the computer's keyboard, letters that follow notes, maps
 * in Lua. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <computer_keys.h>
#include <exact.h>
#include <keys_actor.h>
#include <live_player.h>
#include <springs.h>
#include <stage_window.h>

#include "../display/scratch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct font_face *face;

static struct midi_song *song_of(const uint8_t (*bytes)[3], const int *ms, int count)
{
    const struct midi_song_def def = midi_song_def_default();
    struct midi_song *song;
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    for (int i = 0; i < count; i++) {
        struct midi_message m =
            midi_message_make((uint64_t)ms[i] * 1000000, bytes[i][0], bytes[i][1], bytes[i][2]);
        assert_int_equal(midi_song_record(song, 0, &m, 0), MIDI_OK);
    }
    return song;
}

static struct stage *keys_stage(struct keys_actor_def def)
{
    struct stage_def stage_def = stage_def_default();
    struct stage *stage;
    def.face = face;
    assert_int_equal(keys_actor_create(&def, &stage_def.actor), STAGE_OK);
    assert_int_equal(stage_create(&stage_def, &stage), STAGE_OK);
    return stage;
}

static const char *map_of(const char *text)
{
    const char *path = scratch_path("map.lua");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    return path;
}

static char told[400];
static int told_count;

static void tell(void *context, const char *text)
{
    (void)context;
    snprintf(told, sizeof told, "%s", text);
    told_count++;
}

static double value_of(struct stage *stage, const char *name)
{
    int count;
    const struct control *rows = stage_controls(stage, &count);
    return control_read(stage_control_find(rows, count, name), stage);
}

/* ---- the computer's keyboard ---- */

static void keys_of_the_computer_are_two_octaves(void **unused)
{
    (void)unused;
    static const char low[] = "ZSXDCVGBHNJM", high[] = "Q2W3ER5T6Y7UI9O0P";
    struct computer_keys keys = {.lowest = 48};
    struct midi_message m;
    for (int i = 0; low[i]; i++) {
        struct input_event e = {.kind = INPUT_KEY_DOWN, .key = low[i]};
        assert_true(computer_keys_take(&keys, &e, &m));
        assert_int_equal(m.bytes[0], MIDI_NOTE_ON);
        assert_int_equal(m.bytes[1], 48 + i);
        assert_false(computer_keys_take(&keys, &e, &m)); /* it is down */
        e.kind = INPUT_KEY_UP;
        assert_true(computer_keys_take(&keys, &e, &m));
        assert_int_equal(m.bytes[0], MIDI_NOTE_OFF);
    }
    for (int i = 0; high[i]; i++) {
        struct input_event e = {
            .kind = INPUT_KEY_DOWN, .key = high[i], .modifiers = i % 2 ? INPUT_SHIFT : 0};
        assert_true(computer_keys_take(&keys, &e, &m));
        assert_int_equal(m.bytes[1], 60 + i);
        assert_true(i % 2 ? m.bytes[2] == 127 : m.bytes[2] < 127);
    }
    static const int others[] = {'A', '1', ' ', INPUT_KEY_ESCAPE, 0};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        struct input_event e = {.kind = INPUT_KEY_DOWN, .key = others[i]};
        assert_false(computer_keys_take(&keys, &e, &m));
    }
    int released = 0;
    while (computer_keys_release(&keys, &m))
        released += m.bytes[0] == MIDI_NOTE_OFF;
    assert_int_equal(released, (int)strlen(high));
    struct input_event undo = {.kind = INPUT_KEY_DOWN, .key = 'Z', .modifiers = INPUT_CONTROL};
    assert_false(computer_keys_take(&keys, &undo, &m));
}

/* ---- letters ---- */

/* The height of the ink on a picture of the stage, in pixels. */
static int ink_height(struct stage *stage)
{
    struct stage_draw_list list = {0};
    struct stage_exact *exact;
    struct display_image image = {.width_px = 960, .height_px = 400, .channels = 3};
    assert_int_equal(display_image_create(&image), DISPLAY_OK);
    assert_int_equal(stage_exact_create("box", &exact), STAGE_OK);
    stage_picture(stage, image.width_px, image.height_px, 1, &list);
    assert_int_equal(stage_exact_draw(exact, &list, stage_background(stage), &image), STAGE_OK);
    int top = image.height_px, bottom = 0;
    for (int y = 0; y < image.height_px; y++)
        for (int x = 0; x < image.width_px; x++)
            if (image.pixels[3 * (y * image.width_px + x)] < 128) {
                top = y < top ? y : top;
                bottom = y + 1;
            }
    stage_exact_destroy(exact);
    stage_draw_finish(&list);
    display_image_destroy(&image);
    return bottom > top ? bottom - top : 0;
}

static void letters_are_as_high_as_keys_are_struck(void **unused)
{
    (void)unused;
    enum { COUNT = 12 };
    double x[COUNT], y[COUNT], mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
    struct keys_actor_def def = keys_actor_def_default();
    def.text = "H";
    struct stage *stage = keys_stage(def);
    const struct stage_actor actor = stage_actor(stage);
    double now_s = 0;
    stage_frame(stage, now_s, NULL);
    for (int i = 0; i < COUNT; i++) {
        const uint8_t velocity = (uint8_t)(20 + 9 * i);
        assert_int_equal(keys_actor_play(&actor, (const uint8_t[]){0x90, 60, velocity}),
                         STAGE_OK);
        stage_frame(stage, now_s += 0.1, NULL);
        x[i] = velocity;
        y[i] = ink_height(stage);
        assert_int_equal(keys_actor_play(&actor, (const uint8_t[]){0x80, 60, 127}), STAGE_OK);
        for (int k = 0; k < 20; k++)
            stage_frame(stage, now_s += 0.1, NULL);
        assert_int_equal(ink_height(stage), 0); /* let go, it has gone */
        mx += x[i] / COUNT;
        my += y[i] / COUNT;
    }
    for (int i = 0; i < COUNT; i++) {
        xx += (x[i] - mx) * (x[i] - mx);
        yy += (y[i] - my) * (y[i] - my);
        xy += (x[i] - mx) * (y[i] - my);
    }
    assert_true(xy / sqrt(xx * yy) >= 0.99);
    assert_true(y[COUNT - 1] > 40);
    stage_destroy(stage);
}

static void keys_outside_are_played_by_octaves(void **unused)
{
    (void)unused;
    struct stage *stage = keys_stage(keys_actor_def_default());
    const struct stage_actor actor = stage_actor(stage);
    stage_frame(stage, 0, NULL);
    keys_actor_play(&actor, (const uint8_t[]){0x90, 24, 127}); /* c1: c3 is the lowest */
    keys_actor_play(&actor, (const uint8_t[]){0x91, 98, 127}); /* d7: d4 */
    stage_frame(stage, 0.1, NULL);
    assert_true(keys_actor_level(&actor, 48) == 1);
    assert_true(keys_actor_level(&actor, 62) == 1);
    assert_true(keys_actor_level(&actor, 60) == 0);
    /* "All notes off" releases the whole channel. Messages that are no channel messages do
     * nothing. */
    keys_actor_play(&actor, (const uint8_t[]){0xf8, 0, 0});
    keys_actor_play(&actor, (const uint8_t[]){0xb0, 123, 0}); /* all notes off */
    stage_frame(stage, 3, NULL);
    for (int i = 0; i < 40; i++)
        stage_frame(stage, 3 + 0.1 * i, NULL);
    assert_true(keys_actor_level(&actor, 48) < 1e-3);
    assert_true(keys_actor_level(&actor, 62) == 1);
    stage_destroy(stage);
}

/* Forgetting the old notes of a long performance does not change its letters. */
static void forgotten_notes_make_no_difference(void **unused)
{
    (void)unused;
    const struct keys_def def = keys_def_default();
    struct keys_score all, forgets;
    assert_true(keys_score_begin(&def, &all) && keys_score_begin(&def, &forgets));
    uint32_t seed = 1990;
    double time_s = 0;
    int most = 0;
    for (int i = 0; i < 20000; i++) {
        seed = seed * 1664525 + 1013904223;
        static const uint8_t kinds[] = {0x90, 0x90, 0x80, 0x80, 0xa0, 0xd0, 0xb0, 0x80};
        const uint8_t kind = kinds[seed >> 29];
        const uint8_t bytes[3] = {(uint8_t)(kind | (seed >> 20 & 1)),
                                  kind == 0xb0 ? 64 : (uint8_t)(48 + (seed >> 22) % 24),
                                  (uint8_t)(seed >> 8 & 127)};
        time_s += (seed >> 4 & 15) * 0.01;
        assert_true(keys_score_take(&all, time_s, bytes));
        assert_true(keys_score_take(&forgets, time_s, bytes));
        if (i % 50 == 0) {
            keys_score_forget(&forgets, time_s);
            most = forgets.notes_count > most ? forgets.notes_count : most;
        }
        if (i % 100 == 0 && i < 4000)
            for (int key = 48; key < 72; key++)
                assert_true(fabs(keys_key_level(&all, key, time_s, NULL) -
                                 keys_key_level(&forgets, key, time_s, NULL)) < 2e-3);
    }
    assert_true(most < 400);
    keys_score_finish(&all);
    keys_score_finish(&forgets);
}

/* ---- maps ---- */

static const uint8_t played[][3] = {{0x90, 60, 127}, {0xb0, 1, 127}, {0xb0, 2, 64},
                                    {0xe0, 0, 0},    {0x90, 60, 0},  {0xc0, 5, 0}};
static const int played_ms[] = {0, 100, 200, 300, 400, 500};

static struct live_player *player_of(struct stage *stage, struct live_source *source,
                                     const char *map)
{
    struct live_player *player;
    const struct live_player_def def = {.source = source, .script = map_of(map), .tell = tell};
    told[0] = '\0';
    told_count = 0;
    return live_player_create(&def, stage, &player) == STAGE_OK ? player : NULL;
}

/* A cue that waits is due with the picture after the key; a letter with Shift is none. */
static void cues_wait_for_a_key(void **unused)
{
    (void)unused;
    static const struct {
        int key;
        unsigned modifiers;
        bool goes;
    } keys[] = {{'G', 0, true},
                {'G', INPUT_SHIFT, false},
                {'H', 0, false},
                {INPUT_KEY_PAGE_DOWN, 0, true},
                {'G', INPUT_CONTROL, true}};
    struct midi_song *song = song_of(played, played_ms, 6);
    struct live_source_def source_def = {.song = song};
    struct live_source *source;
    struct live_player *player;
    assert_int_equal(live_source_open(&source_def, &source), MIDI_OK);
    struct stage *stage = keys_stage(keys_actor_def_default());
    const char *path = scratch_path("live.cues");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("go set size=0.5\ngo set size=0.25\ngo set size=1.5\n", file);
    fclose(file);
    struct live_player_def def = {.source = source, .cues = path, .tell = tell};
    assert_int_equal(live_player_create(&def, stage, &player), STAGE_OK);
    assert_true(live_player_leads(player));
    static const double sizes[] = {0.5, 0.25, 1.5};
    int due = 0;
    int count;
    assert_int_equal(live_player_before(player, stage, 0), STAGE_OK);
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        const struct input_event event = {
            .kind = INPUT_KEY_DOWN, .key = keys[i].key, .modifiers = keys[i].modifiers};
        const struct control *rows = stage_controls(stage, &count);
        const struct control *size = stage_control_find(rows, count, "size");
        const double before = control_read(size, stage);
        assert_int_equal(live_player_key(player, &event), keys[i].goes);
        assert_true(control_read(size, stage) == before);
        assert_int_equal(live_player_before(player, stage, (double)i), STAGE_OK);
        assert_true(control_read(size, stage) == (keys[i].goes ? sizes[due++] : before));
    }
    live_player_destroy(player);
    def.no_go = true;
    assert_int_equal(live_player_create(&def, stage, &player), STAGE_BAD_FILE);
    live_source_close(source);
    stage_destroy(stage);
    midi_song_destroy(song);
}

static void maps_set_controls(void **unused)
{
    (void)unused;
    struct midi_song *song = song_of(played, played_ms, 6);
    struct live_source_def source_def = {.song = song};
    struct live_source *source;
    assert_int_equal(live_source_open(&source_def, &source), MIDI_OK);
    struct stage *stage = keys_stage(keys_actor_def_default());
    struct live_player *player = player_of(
        stage, source,
        "local frames = 0\n"
        "function message(m)\n"
        "  if m.kind == 'note-on' then set('size', 1 + m.value) assert(m.note == 60 and "
        "m.channel == 1) end\n"
        "  if m.kind == 'note-off' then set('size', get('size') / 4) end\n"
        "  if m.kind == 'control' and m.control == 1 then along('slant', m.value) end\n"
        "  if m.kind == 'control' and m.control == 2 then set('shadow', true) end\n"
        "  if m.kind == 'bend' then set('attack', -m.value) end\n"
        "  if m.kind == 'program' then set('skin_of', 'all') end\n"
        "end\n"
        "function frame(time) frames = frames + 1 set('release', frames / 100) end\n");
    assert_non_null(player);
    static const struct {
        double now_s;
        const char *name;
        double value;
    } rows[] = {{0, "size", 2},        {0.1, "slant", 1},  {0.2, "shadow", 1},
                {0.3, "attack", 1},    {0.4, "size", 0.5}, {0.5, "skin_of", 1},
                {0.6, "release", 0.07}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_int_equal(
            live_player_before(player, stage, 100.01 + rows[i].now_s - 0.01 * (i == 0)),
            STAGE_OK);
        if (fabs(value_of(stage, rows[i].name) - rows[i].value) > 1e-12)
            fail_msg("%s is %g, not %g: %s", rows[i].name, value_of(stage, rows[i].name),
                     rows[i].value, told);
    }
    assert_int_equal(told_count, 0);
    live_player_destroy(player);
    live_source_close(source);
    stage_destroy(stage);
    midi_song_destroy(song);
}

/* An error is reported in one line, and the following events are played all the same. */
static void what_maps_do_wrong_is_told(void **unused)
{
    (void)unused;
    static const struct {
        const char *map, *said;
        bool opens;
    } rows[] = {
        {"x = ", "map.lua:1: unexpected symbol", false},
        {"function messages(m) end", "a map has a function message(m)", false},
        {"while true do end", "stopped after 0.1 seconds", false},
        {"function message(m) set('gravy', 1) end", "gravy", true},
        {"function message(m) set('size', 100) end", "size must be 0.05..4", true},
        {"function message(m) along('size', 2) end", "how far along it is", true},
        {"function message(m) get('none') end", "none", true},
        {"function message(m) while true do end end", "stopped after 0.1 seconds", true},
        {"function message(m) local s = ('x'):rep(1e9) end", "not enough memory", true},
        {"function message(m) error{} end", "error: (a table)", true},
        {"function message(m) error(('long '):rep(100)) end", "long long", true},
        {"function message(m) os.exit() end", "os", true},
        {"function message(m) io.open('/etc/passwd') end", "io", true},
        {"function message(m) load('x = 1')() end", "load", true},
        {"function message(m) paper{} end", "paper", true},
        {"message = 1 function frame() end", "a map has a function message(m)", false},
    };
    struct stage *stage = keys_stage(keys_actor_def_default());
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct midi_song *song = song_of(played, played_ms, 6);
        struct live_source_def source_def = {.song = song};
        struct live_source *source;
        assert_int_equal(live_source_open(&source_def, &source), MIDI_OK);
        struct live_player *player = player_of(stage, source, rows[i].map);
        assert_int_equal(player != NULL, rows[i].opens);
        if (player) {
            assert_int_equal(live_player_before(player, stage, 0), STAGE_OK);
            assert_int_equal(live_player_before(player, stage, 0.1), STAGE_OK);
            if (told_count != 1) /* the same is told once */
                fail_msg("%s: told %d times, last: %s", rows[i].map, told_count, told);
        } else {
            snprintf(told, sizeof told, "%s", stage_error());
        }
        if (!strstr(told, rows[i].said))
            fail_msg("%s: told: %s", rows[i].map, told);
        live_player_destroy(player);
        live_source_close(source);
        midi_song_destroy(song);
    }
    stage_destroy(stage);
}

/* ---- who hears notes ---- */

static struct stage *springs_stage(void)
{
    struct stage_springs_def springs = stage_springs_def_default();
    struct stage_def def = stage_def_default();
    struct stage *stage;
    assert_int_equal(dyn_network_create(&springs.network), DYN_OK);
    assert_int_equal(stage_springs_create(&springs, &def.actor), STAGE_OK);
    assert_int_equal(stage_create(&def, &stage), STAGE_OK);
    return stage;
}

/* Where nobody hears notes, the letters of the keyboard are the window's own keys. */
static void the_computer_plays_for_who_hears(void **state)
{
    (void)state;
    static const struct {
        bool keys;
        const char *map;
        bool plays;
    } rows[] = {{false, "function frame(time) end", false},
                {false, "function osc(address) end", false},
                {false, "function message(m) end", true},
                {true, "function frame(time) end", true}};
    setenv("XDG_RUNTIME_DIR", scratch_path("none"), 1); /* no server's */
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct stage *stage =
            rows[i].keys ? keys_stage(keys_actor_def_default()) : springs_stage();
        struct live_source *source;
        assert_int_equal(live_source_open(&(struct live_source_def){.lowest = 48}, &source),
                         MIDI_OK);
        struct live_player *player = player_of(stage, source, rows[i].map);
        assert_non_null(player);
        const struct input_event v = {.kind = INPUT_KEY_DOWN, .key = 'V'};
        assert_int_equal(live_source_by_computer(source), rows[i].plays);
        assert_int_equal(live_player_key(player, &v), rows[i].plays);
        live_player_destroy(player);
        live_source_close(source);
        stage_destroy(stage);
    }
    unsetenv("XDG_RUNTIME_DIR");
}

/* ---- the help ---- */

/* From where to where the glyphs of a row's half stand; the other half is empty. */
static void half_ends(struct stage_panel *panel, const struct stage *stage, const char *name,
                      const char *does, double *from, double *to)
{
    const struct help_row row = {name, does};
    struct help_sheet sheet = {.shown = true};
    struct stage_draw_list list = {0};
    stage_draw_begin(&list, STAGE_VIEW_PIXELS);
    help_sheet_draw(&sheet, &row, 1, panel, stage_theme(stage), 900, 600, 1, &list);
    *from = 900;
    *to = 0;
    for (int i = 0; i < list.count; i++)
        if (list.items[i].kind == STAGE_DRAW_GLYPH) {
            const struct stage_glyph *g = &list.items[i].glyph;
            *from = fmin(*from, g->x_px);
            *to = fmax(*to, g->x_px + 0.6 * g->size_px);
        }
    assert_true(*to < sheet.box.x1);
    stage_draw_finish(&list);
}

/* No key's name runs into what it does. */
static void help_names_have_room(void **state)
{
    (void)state;
    struct stage *stage = keys_stage(keys_actor_def_default());
    const char *knobs = scratch_path("help.knobs"), *cues = scratch_path("help.cues"), *does;
    struct live_source *source;
    struct live_player *player;
    struct stage_panel *panel;
    int count;
    FILE *file = fopen(cues, "w");
    assert_non_null(file);
    fputs("go set size=0.5\n", file);
    fclose(file);
    struct midi_song *song = song_of(played, played_ms, 6);
    assert_int_equal(live_source_open(&(struct live_source_def){.song = song}, &source),
                     MIDI_OK);
    const struct live_player_def def = {
        .source = source, .knobs = &knobs, .knobs_count = 1, .cues = cues, .tell = tell};
    assert_int_equal(live_player_create(&def, stage, &player), STAGE_OK);
    assert_int_equal(stage_panel_create("DejaVuSans", &panel), STAGE_OK);
    const struct help_row *rows = live_player_keys(player, &count);
    assert_in_range(count, 7, STAGE_WINDOW_KEYS_MAX);
    for (int i = 0; i < 100; i++) {
        const char *name = i < count ? rows[i].name : stage_window_key(i - count, &does);
        double from[2], to[2];
        if (!name)
            break;
        does = i < count ? rows[i].does : does;
        half_ends(panel, stage, name, "", &from[0], &to[0]);
        half_ends(panel, stage, "", does, &from[1], &to[1]);
        if (to[0] > from[1])
            fail_msg("%s runs into: %s", name, does);
    }
    stage_panel_destroy(panel);
    live_player_destroy(player);
    stage_destroy(stage);
    live_source_close(source);
    midi_song_destroy(song);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_of_the_computer_are_two_octaves),
        cmocka_unit_test(letters_are_as_high_as_keys_are_struck),
        cmocka_unit_test(keys_outside_are_played_by_octaves),
        cmocka_unit_test(forgotten_notes_make_no_difference),
        cmocka_unit_test(cues_wait_for_a_key),
        cmocka_unit_test(maps_set_controls),
        cmocka_unit_test(what_maps_do_wrong_is_told),
        cmocka_unit_test(the_computer_plays_for_who_hears),
        cmocka_unit_test(help_names_have_room),
    };
    if (font_face_open("DejaVuSans", 0, &face) != FONT_OK)
        return 1;
    const int failed = cmocka_run_group_tests_name("live", tests, NULL, NULL);
    font_face_close(face);
    return failed;
}
