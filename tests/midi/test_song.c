/* test_song.c - Standard MIDI Files: reading, writing, times, damage. Other programs read our
 * files, and we read theirs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <midi_song.h>

#include "../display/scratch.h"
#include "../sample.h"
#include "../skip.h"
#include "song_support.h"
#include "taken.h"

/* ---- a file by hand ---- */

#define HEADER(format, tracks, high, low) "MThd\0\0\0\6\0" format "\0" tracks high low

/* Two tracks, 96 ticks to a quarter note, 120 quarter notes a minute and from tick 192 on
 * 60. */
static const char two_tracks[] = HEADER(
    "\1", "\2", "\0",
    "\x60") "MTrk\0\0\0\x13\0\xff\x51\3\7\xa1\x20\x81\x40\xff\x51\3\x0f\x42\x40\0\xff\x2f\0"
            "MTrk\0\0\0\x12\0\x90\x3c\x64\x81\x40\x3c\0\x60\x3e\x50\x60\x3e\0\0\xff\x2f\0";

static struct midi_song *parsed(const char *bytes, size_t count)
{
    struct midi_song *song;
    if (midi_song_parse("song", (const uint8_t *)bytes, count, &song) != MIDI_OK)
        fail_msg("%s", midi_error());
    return song;
}

static void a_file_is_read(void **unused)
{
    (void)unused;
    struct midi_song *song = parsed(two_tracks, sizeof two_tracks - 1);
    struct midi_song_info info = midi_song_info(song);
    static const uint64_t ms[] = {0, 0, 1000, 1000, 2000, 3000};
    assert_int_equal(info.format, 1);
    assert_int_equal(info.tracks_count, 2);
    assert_int_equal(info.division, 96);
    assert_int_equal(info.events_count, 6);
    assert_int_equal(info.end_tick, 384);
    assert_int_equal(info.end_ns, UINT64_C(3000000000));
    for (size_t i = 0; i < 6; i++)
        assert_int_equal(midi_song_event(song, i).time_ns, ms[i] * 1000000);
    struct midi_song_event e = midi_song_event(song, 3); /* running status */
    assert_memory_equal(e.bytes, "\x90\x3c\0", 3);
    assert_int_equal(midi_song_time_ns(song, 288), UINT64_C(2000000000));
    assert_int_equal(midi_song_tick(song, UINT64_C(2000000000)), 288);
    assert_int_equal(midi_song_tick(song, UINT64_C(500000000)), 96);
    midi_song_destroy(song);
}

/* Times are exact to a nanosecond at any distance from the last tempo; converting back gives
 * the tick. */
static void time_is_exact(void **unused)
{
    (void)unused;
    static const struct {
        int division;
        uint32_t tick;
        uint64_t ns;
    } cases[] = {{480, 1, 1041666},
                 {480, 480000000, UINT64_C(500000000000000)},
                 {3, 1000001, UINT64_C(166666833333333)},
                 {-(25 << 8 | 40), 1000, 1000000000},
                 {-(30 << 8 | 80), 2400, 1000000000},
                 {-(29 << 8 | 80), 2400, 1001000000},
                 {-(24 << 8 | 1), 24, 1000000000}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct midi_song_def def = {.format = 1, .division = cases[i].division};
        struct midi_song *song;
        assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
        assert_int_equal(midi_song_time_ns(song, cases[i].tick), cases[i].ns);
        assert_int_equal(midi_song_tick(song, cases[i].ns), cases[i].tick);
        midi_song_destroy(song);
    }
}

static void what_is_written_is_read(void **unused)
{
    (void)unused;
    uint64_t seed = 4;
    for (int turn = 0; turn < 60; turn++) {
        struct midi_song *song = song_by_chance(&seed, turn * 8), *back;
        uint8_t *bytes;
        size_t count;
        assert_int_equal(midi_song_bytes(song, &bytes, &count), MIDI_OK);
        back = parsed((const char *)bytes, count);
        const char *differs = songs_differ(song, back);
        if (differs)
            fail_msg("turn %d: %s differs", turn, differs);
        midi_song_destroy(back);
        midi_song_destroy(song);
        free(bytes);
    }
}

/* Messages as a server gives them, with a system exclusive in pieces and a clock between. */
static void recordings_hold_what_was_played(void **unused)
{
    (void)unused;
    struct midi_song_def def = midi_song_def_default();
    struct midi_song *song, *back;
    struct midi_parser parser;
    struct taken in = {0}, out = {0};
    uint8_t long_one[1000] = {0xf0};
    long_one[999] = 0xf7;
    long_one[500] = 0xf8;
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    midi_parser_init(&parser);
    midi_parser_take(&parser, 1000000000, (const uint8_t *)"\x90\x3c\x40", 3, taken_add, &in);
    midi_parser_take(&parser, 1500000000, long_one, sizeof long_one, taken_add, &in);
    midi_parser_take(&parser, 1800000000, (const uint8_t *)"\xf6\x90\x3c", 3, taken_add, &in);
    midi_parser_take(&parser, 2000000000, (const uint8_t *)"\0", 1, taken_add, &in);
    for (size_t i = 0; i < in.count; i++)
        assert_int_equal(midi_song_record(song, 0, &in.messages[i], 1000000000), MIDI_OK);
    const char *path = scratch_path("recorded.mid");
    assert_int_equal(midi_song_write(song, path), MIDI_OK);
    if (midi_song_read(path, &back) != MIDI_OK)
        fail_msg("%s", midi_error());
    assert_int_equal(midi_song_info(back).events_count, 3);
    midi_parser_init(&parser);
    for (size_t i = 0; i < 3; i++) {
        struct midi_song_event e = midi_song_event(back, i);
        midi_song_play(&e, &parser, taken_add, &out);
    }
    /* The messages are the recorded ones except the clock and the tune request. */
    size_t next = 0;
    for (size_t i = 0; i < in.count; i++) {
        if (in.messages[i].bytes[0] == 0xf8 || in.messages[i].bytes[0] == 0xf6)
            continue;
        assert_true(next < out.count);
        assert_true(midi_message_equal(&in.messages[i], &out.messages[next]));
        const int64_t late = (int64_t)(in.messages[i].time_ns - 1000000000) -
                             (int64_t)out.messages[next].time_ns;
        assert_true(llabs(late) <= 26042); /* half a tick */
        next++;
    }
    assert_int_equal(next, out.count);
    assert_int_equal(next, 7);
    taken_finish(&in);
    taken_finish(&out);
    midi_song_destroy(song);
    midi_song_destroy(back);
}

/* ---- what is wrong ---- */

#define TRACK(length, content) HEADER("\0", "\1", "\0", "\x60") "MTrk\0\0\0" length content
#define WRONG(bytes, result)                                                                   \
    {                                                                                          \
        bytes, sizeof bytes - 1, result                                                        \
    }

static void damaged_files_are_refused(void **unused)
{
    (void)unused;
    static const struct {
        const char *bytes;
        size_t count;
        const char *says;
    } wrongs[] = {
        WRONG("", "MThd"),
        WRONG("RIFF and other music", "MThd"),
        WRONG("MThd\0\0\0\6\0\1", "cut off"),
        WRONG("MThd\0\0\0\2\0\1\0\1\0\1", "cut off"),
        WRONG(HEADER("\2", "\1", "\0", "\x60"), "format 2"),
        WRONG(HEADER("\0", "\1", "\0", "\0"), "division"),
        WRONG(HEADER("\0", "\1", "\xe0", "\x10"), "division"),
        WRONG(HEADER("\0", "\1", "\0", "\x60"), "no track"),
        WRONG(HEADER("\0", "\1", "\0", "\x60") "MTrk\0\0\1\0\0\xff\x2f\0",
              "longer than the file"),
        WRONG(TRACK("\3", "\0\x90\x3c"), "track 1 ends within an event"),
        WRONG(TRACK("\5", "\0\x90\x3c\x90\x40"), "status byte where data must be, at byte 25"),
        WRONG(TRACK("\3", "\0\x3c\x40"), "without a status"),
        WRONG(TRACK("\6", "\x81\x81\x81\x81\x81\0"), "more than four bytes"),
        WRONG(TRACK("\3", "\0\xf8\0"), "no file can have"),
        WRONG(TRACK("\4", "\0\xff\x90\0"), "above 7f"),
        WRONG(TRACK("\4", "\0\xff\1\x7f"), "ends within"),
        WRONG(TRACK("\4", "\0\xf0\x7f\1"), "ends within"),
        WRONG(TRACK("\5", "\x81\x81\x81\x81\1"), "more than four bytes"),
    };
    for (size_t i = 0; i < sizeof wrongs / sizeof *wrongs; i++) {
        struct midi_song *song;
        if (midi_song_parse("song", (const uint8_t *)wrongs[i].bytes, wrongs[i].count, &song) !=
                MIDI_BAD_FILE ||
            !strstr(midi_error(), wrongs[i].says))
            fail_msg("%zu (%s): %s", i, wrongs[i].says, midi_error());
        assert_null(song);
    }
    struct midi_song *song;
    assert_int_equal(midi_song_read("/nowhere/song.mid", &song), MIDI_IO_FAILED);
    assert_int_equal(midi_song_read("/dev/null", &song), MIDI_IO_FAILED);
    assert_non_null(strstr(midi_error(), "Is not a regular file"));
    struct midi_song_def def = {.format = 2, .division = 96};
    assert_int_equal(midi_song_create(&def, &song), MIDI_BAD_ARGUMENT);
}

/* Files as some programs write them. */
static void odd_files_are_read(void **unused)
{
    (void)unused;
    static const struct {
        const char *bytes;
        size_t count, events;
    } odd[] = {
        WRONG(TRACK("\4", "\0\x90\x3c\x40"), 1),   /* no end */
        WRONG(TRACK("\5", "\0\x90\x3c\x40\0"), 1), /* a delta and no end */
        WRONG(TRACK("\x0b", "\0\x90\x3c\x40\0\xff\1\0\0\x3d\x40"),
              3), /* status kept by a text */
        WRONG(HEADER("\1", "\5", "\0", "\x60") "MTrk\0\0\0\4\0\xff\x2f\0", 0), /* one of five */
        WRONG(HEADER("\0", "\1", "\0", "\x60") "XFIH\0\0\0\1zMTrk\0\0\0\4\0\xff\x2f\0", 0),
        WRONG("MThd\0\0\0\10\0\0\0\1\0\x60..MTrk\0\0\0\4\0\xff\x2f\0", 0), /* a longer header */
        WRONG(TRACK("\7", "\0\xf7\0\0\xff\x2f\0"), 1), /* an escape of nothing */
        WRONG("RIFF....RMIDdata....MThd\0\0\0\6\0\0\0\1\0\x60MTrk\0\0\0\4\0\xff\x2f\0", 0),
    };
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        struct midi_song *song = parsed(odd[i].bytes, odd[i].count);
        assert_int_equal(midi_song_info(song).events_count, odd[i].events);
        midi_song_destroy(song);
    }
    /* A system exclusive in two packets is played as one. */
    static const char packets[] = TRACK("\x0e", "\0\xf0\2\1\2\5\xf7\2\3\xf7\0\xff\x2f\0");
    struct midi_song *song = parsed(packets, sizeof packets - 1);
    struct midi_parser parser;
    struct taken out = {0};
    midi_parser_init(&parser);
    for (size_t i = 0; i < 2; i++) {
        struct midi_song_event e = midi_song_event(song, i);
        midi_song_play(&e, &parser, taken_add, &out);
    }
    assert_int_equal(out.count, 1);
    assert_memory_equal(out.messages[0].bytes, "\xf0\1\2\3\xf7", 5);
    taken_finish(&out);
    midi_song_destroy(song);
}

static void wrong_events_are_refused(void **unused)
{
    (void)unused;
    struct midi_song_def def = {.format = 0, .division = 96};
    struct midi_song *song;
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    struct midi_song_event wrong[] = {
        {.kind = MIDI_SONG_MESSAGE, .count = 2, .bytes = (const uint8_t *)"\x90\x3c"},
        {.kind = MIDI_SONG_MESSAGE, .count = 1, .bytes = (const uint8_t *)"\xf8"},
        {.kind = MIDI_SONG_MESSAGE, .count = 0},
        {.kind = MIDI_SONG_SYSEX, .count = 1, .bytes = (const uint8_t *)"\1"},
        {.kind = MIDI_SONG_META, .meta = 0x2f},
        {.kind = MIDI_SONG_META, .meta = 0x80},
        {.kind = MIDI_SONG_META, .meta = 1, .track = 1},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(midi_song_add(song, &wrong[i]), MIDI_BAD_ARGUMENT);
    assert_int_equal(midi_song_info(song).events_count, 0);
    midi_song_destroy(song);
}

/* ---- other programs ---- */

static bool runs(const char *command)
{
    return system(command) == 0;
}

static bool have(const char *program)
{
    char command[100];
    snprintf(command, sizeof command, "command -v %s >/dev/null", program);
    return runs(command);
}

static int lines_with(const char *path, const char *part)
{
    char line[1000];
    int count = 0;
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file))
        count += strstr(line, part) != NULL;
    fclose(file);
    return count;
}

/* A random song whose meta events other programs understand. */
static struct midi_song *plain_song(int notes)
{
    struct midi_song_def def = {.format = 1, .division = 480};
    struct midi_song *song;
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    struct midi_song_event tempo = {.kind = MIDI_SONG_META,
                                    .meta = 0x51,
                                    .count = 3,
                                    .bytes = (const uint8_t *)"\6\x1a\x80"};
    assert_int_equal(midi_song_add(song, &tempo), MIDI_OK);
    struct midi_song_event sysex = {.kind = MIDI_SONG_SYSEX,
                                    .count = 6,
                                    .bytes = (const uint8_t *)"\xf0\x7e\x7f\x09\x01\xf7"};
    assert_int_equal(midi_song_add(song, &sysex), MIDI_OK);
    for (int i = 0; i < notes; i++) {
        const uint8_t on[] = {0x90, (uint8_t)(60 + i % 12), 100},
                      off[] = {0x80, (uint8_t)(60 + i % 12), 64};
        struct midi_song_event e = {
            .tick = (uint32_t)(60 * i), .track = 1, .count = 3, .bytes = on};
        assert_int_equal(midi_song_add(song, &e), MIDI_OK);
        e.tick += 50;
        e.bytes = off;
        assert_int_equal(midi_song_add(song, &e), MIDI_OK);
    }
    return song;
}

static void others_read_what_we_write(void **unused)
{
    (void)unused;
    char command[2000], csv[400], mid[400], back[400];
    if (!have("midicsv") || !have("csvmidi")) {
        skip_because("midicsv is not installed");
    }
    struct midi_song *song = plain_song(40), *theirs;
    snprintf(mid, sizeof mid, "%s", scratch_path("ours.mid"));
    snprintf(csv, sizeof csv, "%s", scratch_path("ours.csv"));
    snprintf(back, sizeof back, "%s", scratch_path("theirs.mid"));
    assert_int_equal(midi_song_write(song, mid), MIDI_OK);
    snprintf(command, sizeof command, "midicsv '%s' '%s' && csvmidi '%s' '%s'", mid, csv, csv,
             back);
    assert_true(runs(command));
    assert_int_equal(lines_with(csv, "Note_on_c"), 40);
    assert_int_equal(lines_with(csv, "Note_off_c"), 40);
    assert_int_equal(lines_with(csv, "2, 60, Note_on_c, 0, 61, 100"), 1);
    assert_int_equal(lines_with(csv, "Tempo, 400000"), 1);
    assert_int_equal(lines_with(csv, "System_exclusive, 5, 126, 127, 9, 1, 247"), 1);
    /* That program writes the same song. */
    if (midi_song_read(back, &theirs) != MIDI_OK)
        fail_msg("%s", midi_error());
    const char *differs = songs_differ(song, theirs);
    if (differs)
        fail_msg("%s differs", differs);
    midi_song_destroy(theirs);
    midi_song_destroy(song);
}

static void fluidsynth_plays_what_we_write(void **unused)
{
    (void)unused;
    static const char font[] = "/usr/share/sounds/sf2/TimGM6mb.sf2";
    char command[2000], wav[600], mid[600];
    if (!have("fluidsynth") || access(font, R_OK) != 0) {
        skip_because("fluidsynth or its SoundFont is not installed");
    }
    struct midi_song *song = plain_song(8);
    snprintf(mid, sizeof mid, "%s", scratch_path("played.mid"));
    snprintf(wav, sizeof wav, "%s", scratch_path("played.raw"));
    assert_int_equal(midi_song_write(song, mid), MIDI_OK);
    midi_song_destroy(song);
    snprintf(
        command, sizeof command,
        "fluidsynth -q -ni -R 0 -C 0 -r 8000 -O s16 -T raw -F '%s' %s '%s' >/dev/null 2>&1",
        wav, font, mid);
    assert_true(runs(command));
    /* Eight notes, 50 ms apart, give more than 0.4 s of sound, which is not silent. */
    FILE *file = fopen(wav, "rb");
    assert_non_null(file);
    long count = 0;
    int loudest = 0;
    for (int16_t sample; fread(&sample, sizeof sample, 1, file) == 1; count++)
        loudest = abs(sample) > loudest ? abs(sample) : loudest;
    fclose(file);
    assert_true(count > 2 * 8000 * 2 / 5);
    assert_true(loudest > 300);
}

static void we_read_what_others_write(void **unused)
{
    (void)unused;
    static const char folder[] = "/usr/share/doc/abcmidi/examples";
    char command[2000];
    if (!have("abc2midi") || access(folder, R_OK) != 0) {
        skip_because("abcmidi is not installed, or its examples are not");
    }
    (void)scratch_path("x");
    snprintf(command, sizeof command,
             "cd '%s' && for tune in %s/*.abc; do n=$(basename $tune .abc); abc2midi $tune 1 "
             "-o abc-$n.mid >/dev/null 2>&1; done; true",
             scratch_dir, folder);
    assert_true(runs(command));
    DIR *dir = opendir(scratch_dir);
    int count = 0;
    assert_non_null(dir);
    for (struct dirent *entry; (entry = readdir(dir));) {
        struct midi_song *song, *back;
        uint8_t *bytes;
        size_t bytes_count;
        if (strncmp(entry->d_name, "abc-", 4) != 0)
            continue;
        if (midi_song_read(scratch_path(entry->d_name), &song) != MIDI_OK)
            fail_msg("%s", midi_error());
        count += midi_song_info(song).events_count > 10;
        assert_int_equal(midi_song_bytes(song, &bytes, &bytes_count), MIDI_OK);
        assert_int_equal(midi_song_parse(entry->d_name, bytes, bytes_count, &back), MIDI_OK);
        assert_null(songs_differ(song, back));
        midi_song_destroy(song);
        midi_song_destroy(back);
        free(bytes);
    }
    closedir(dir);
    assert_true(count >= 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_is_read),
        cmocka_unit_test(time_is_exact),
        cmocka_unit_test(what_is_written_is_read),
        cmocka_unit_test(recordings_hold_what_was_played),
        cmocka_unit_test(damaged_files_are_refused),
        cmocka_unit_test(odd_files_are_read),
        cmocka_unit_test(wrong_events_are_refused),
        cmocka_unit_test(others_read_what_we_write),
        cmocka_unit_test(fluidsynth_plays_what_we_write),
        cmocka_unit_test(we_read_what_others_write),
    };
    return cmocka_run_group_tests_name("song", tests, NULL, NULL);
}
