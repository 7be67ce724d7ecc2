/* test_server.c - the server with instruments on pseudo-terminals: who receives which messages,
 * and what happens when one of them goes away. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <midi_notes.h>
#include <midi_parser.h>
#include <midi_server.h>
#include <midi_song.h>
#include <midi_time.h>

#include "../display/scratch.h"
#include "../sample.h"
#include "oracle.h"
#include "server_support.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/time.h>

/* ---- both directions ---- */

static void every_client_hears_what_it_asked_for(void **unused)
{
    (void)unused;
    struct instrument keys = instrument_plug("keys");
    struct served s = served_begin(one_device(&keys), 0, NULL);
    struct midi_client *all = client_of(&s, "all", ""), *few = client_of(&s, "few", NULL);
    struct midi_client *deaf = client_of(&s, "deaf", NULL);
    struct midi_client_event e;
    assert_int_equal(midi_client_listen(few, "keys", "channels=2 transpose=12"), MIDI_OK);
    wait_up(all, "keys");
    const uint64_t before_ns = midi_now_ns();
    instrument_send(&keys, "\x90\x3c\x64\x91\x3e\x50\xf8", 7);
    struct midi_message m = next_message(all, NULL);
    check_text(&m, "note-on 1 c4 100");
    assert_true(m.time_ns >= before_ns && m.time_ns <= midi_now_ns());
    m = next_message(all, NULL);
    check_text(&m, "note-on 2 d4 80");
    m = next_message(all, NULL);
    check_text(&m, "clock");
    m = next_message(few, NULL);
    check_text(&m, "note-on 2 d5 80");
    m = next_message(few, NULL);
    check_text(&m, "clock");
    assert_int_equal(midi_client_next(deaf, 0, &e), MIDI_OK);
    while (e.kind == MIDI_CLIENT_DEVICE)
        assert_int_equal(midi_client_next(deaf, 0, &e), MIDI_OK);
    assert_int_equal(e.kind, MIDI_CLIENT_NOTHING);
    midi_client_close(all);
    midi_client_close(few);
    midi_client_close(deaf);
    served_end(&s);
    instrument_unplug(&keys);
}

static void nothing_to_do(int signal_number)
{
    (void)signal_number;
}

/* As Ctrl-C does; signal() sets SA_RESTART, with which a usual read would go on waiting. */
static void a_signal_ends_the_wait(void **unused)
{
    (void)unused;
    struct served s = served_begin((const char *const[]){"through=loop", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "c", "");
    struct midi_client_event e;
    const struct itimerval soon = {.it_value = {.tv_usec = 30000}, .it_interval = {0, 30000}};
    const struct itimerval never = {.it_value = {0, 0}};
    void (*before)(int) = signal(SIGALRM, nothing_to_do);
    wait_up(c, "through");
    do
        assert_int_equal(midi_client_next(c, 0, &e), MIDI_OK);
    while (e.kind != MIDI_CLIENT_NOTHING);
    assert_int_equal(setitimer(ITIMER_REAL, &soon, NULL), 0);
    assert_int_equal(midi_client_next(c, -1, &e), MIDI_OK);
    assert_int_equal(e.kind, MIDI_CLIENT_NOTHING);
    assert_int_equal(setitimer(ITIMER_REAL, &never, NULL), 0);
    signal(SIGALRM, before);
    midi_client_close(c);
    served_end(&s);
}

static void a_device_plays_what_clients_send(void **unused)
{
    (void)unused;
    uint8_t bytes[600];
    struct instrument keys = instrument_plug("keys");
    struct served s = served_begin(one_device(&keys), 0, NULL);
    struct midi_client *a = client_of(&s, "a", NULL), *b = client_of(&s, "b", NULL);
    wait_up(a, "keys");
    silence_skip(&keys);
    const int device = midi_client_device(a, "keys");
    assert_int_equal(device, 0);
    assert_int_equal(midi_client_device(a, "other"), -1);
    struct midi_message m = midi_message_make(0, 0x90, 60, 100);
    assert_int_equal(midi_client_send(a, device, &m), MIDI_OK);
    assert_int_equal(instrument_hear(&keys, bytes, 3, 2000), 3);
    assert_memory_equal(bytes, "\x90\x3c\x64", 3);
    /* filters on the way out */
    assert_int_equal(midi_client_command(b, "send keys transpose=1 channel=1", NULL, 0),
                     MIDI_OK);
    assert_int_equal(midi_client_send(b, device, &m), MIDI_OK);
    assert_int_equal(instrument_hear(&keys, bytes, 2, 2000), 2);
    assert_memory_equal(bytes, "\x3d\x64", 2);
    /* Another client's notes wait for the end of a system exclusive; real-time messages do
     * not. */
    struct midi_message first = {.count = MIDI_BYTES_MAX, .bytes = {0xf0}};
    struct midi_message last = {.count = 2, .bytes = {1, 0xf7}},
                        clock = {.count = 1, .bytes = {0xf8}};
    assert_int_equal(midi_client_send(a, device, &first), MIDI_OK);
    assert_int_equal(instrument_hear(&keys, bytes, MIDI_BYTES_MAX, 2000), MIDI_BYTES_MAX);
    assert_int_equal(midi_client_send(b, device, &clock), MIDI_OK);
    assert_int_equal(midi_client_send(b, device, &m), MIDI_OK);
    assert_int_equal(instrument_hear(&keys, bytes, 2, 50), 1);
    assert_int_equal(bytes[0], 0xf8);
    assert_int_equal(midi_client_send(a, device, &last), MIDI_OK);
    assert_int_equal(instrument_hear(&keys, bytes, 5, 2000), 5);
    assert_memory_equal(bytes, "\x01\xf7\x90\x3d\x64", 5);
    midi_client_close(a);
    midi_client_close(b);
    served_end(&s);
    instrument_unplug(&keys);
}

/* Some thousand messages arrive whole and in order at each of several clients. */
static void nothing_is_lost_or_altered(void **unused)
{
    (void)unused;
    enum { BYTES = 20000, CLIENTS = 4, CHUNK = 64 };
    static uint8_t bytes[BYTES];
    struct taken expected = {0};
    struct midi_parser_counts counts;
    uint64_t seed = 23;
    oracle_bytes(&seed, bytes, BYTES);
    bytes[BYTES - 1] = 0xf6; /* nothing is left open */
    oracle_parse(bytes, BYTES, &expected, &counts);
    struct instrument keys = instrument_plug("keys");
    struct served s = served_begin(one_device(&keys), 0, NULL);
    struct midi_client *clients[CLIENTS];
    for (int i = 0; i < CLIENTS; i++)
        clients[i] = client_of(&s, "one of many", "");
    wait_up(clients[0], "keys");
    size_t got[CLIENTS] = {0};
    for (size_t at = 0; at < BYTES || got[0] < expected.count;) {
        if (at < BYTES) {
            const size_t count = BYTES - at < CHUNK ? BYTES - at : CHUNK;
            instrument_send(&keys, bytes + at, count);
            at += count;
        }
        for (int i = 0; i < CLIENTS; i++) {
            struct midi_client_event e;
            do {
                assert_int_equal(midi_client_next(clients[i], at < BYTES ? 0 : 1000, &e),
                                 MIDI_OK);
                if (e.kind == MIDI_CLIENT_LOST)
                    fail_msg("%u lost", e.lost);
                if (e.kind != MIDI_CLIENT_MESSAGE)
                    continue;
                assert_true(got[i] < expected.count);
                assert_true(midi_message_equal(&e.message, &expected.messages[got[i]]));
                got[i]++;
            } while (e.kind != MIDI_CLIENT_NOTHING && got[i] < expected.count);
        }
    }
    for (int i = 0; i < CLIENTS; i++) {
        assert_int_equal(got[i], expected.count);
        midi_client_close(clients[i]);
    }
    served_end(&s);
    instrument_unplug(&keys);
    taken_finish(&expected);
}

static void songs_are_played_in_time(void **unused)
{
    (void)unused;
    struct midi_song_def def = midi_song_def_default();
    struct midi_song *song;
    const char *path = scratch_path("played.mid");
    char file[300];
    assert_int_equal(midi_song_create(&def, &song), MIDI_OK);
    for (int i = 0; i < 5; i++) {
        struct midi_message m =
            midi_message_make((uint64_t)(i * 40) * 1000000, (uint8_t)(i & 1 ? 0x80 : 0x90),
                              (uint8_t)(60 + i / 2), 90);
        assert_int_equal(midi_song_record(song, 0, &m, 0), MIDI_OK);
    }
    assert_int_equal(midi_song_write(song, path), MIDI_OK);
    midi_song_destroy(song);
    snprintf(file, sizeof file, "song=file:%s@loop", path);
    struct served s = served_begin((const char *[]){file, NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "listener", "");
    struct midi_message first = next_message(c, NULL);
    while (first.bytes[1] != 60 || first.bytes[0] != 0x90) /* the beginning of a round */
        first = next_message(c, NULL);
    for (int i = 1; i < 5; i++) {
        const struct midi_message m = next_message(c, NULL);
        const uint64_t at_ns = m.time_ns - first.time_ns;
        assert_int_equal(m.bytes[1], 60 + i / 2);
        assert_true(at_ns >= (uint64_t)i * 40000000 - 60000 &&
                    at_ns <= (uint64_t)i * 40000000 + 60000);
    }
    midi_client_close(c);
    served_end(&s);
}

/* ---- gone and back ---- */

static void unplugged_and_back(void **unused)
{
    (void)unused;
    struct instrument keys = instrument_plug("keys");
    struct served s = served_begin(one_device(&keys), 0, NULL);
    struct midi_client *c = client_of(&s, "listener", "");
    wait_up(c, "keys");
    instrument_send(&keys, "\x90\x3c\x64\xb0\x40\x7f\xf0\x01", 8);
    (void)next_message(c, NULL);
    (void)next_message(c, NULL);
    instrument_unplug(&keys);
    /* When the instrument goes, its open system exclusive is ended, and its notes and pedals
     * are released. */
    struct midi_message m = next_message(c, NULL);
    check_text(&m, "sysex f0 01 f7");
    m = next_message(c, NULL);
    check_text(&m, "note-off 1 c4 64");
    m = next_message(c, NULL);
    check_text(&m, "control 1 64 0");
    struct midi_client_event e = next_event(c, MIDI_CLIENT_DEVICE);
    assert_non_null(strstr(e.text, "keys serial"));
    assert_non_null(strstr(e.text, "down"));
    instrument_again(&keys);
    e = next_event(c, MIDI_CLIENT_DEVICE);
    assert_non_null(strstr(e.text, "up"));
    instrument_send(&keys, "\x90\x3d\x64", 3);
    m = next_message(c, NULL);
    check_text(&m, "note-on 1 c#4 100");
    midi_client_close(c);
    served_end(&s);
    instrument_unplug(&keys);
}

static void the_server_killed_and_back(void **unused)
{
    (void)unused;
    struct instrument keys = instrument_plug("keys");
    const char *const *devices = one_device(&keys);
    struct served s = served_begin(devices, 0, NULL);
    struct midi_client *c = client_of(&s, "listener", "drop=clock");
    wait_up(c, "keys");
    instrument_send(&keys, "\x90\x3c\x64", 3);
    (void)next_message(c, NULL);
    served_kill(&s);
    struct midi_message m = next_message(c, NULL);
    check_text(&m, "note-off 1 c4 64");
    (void)next_event(c, MIDI_CLIENT_GONE);
    m = midi_message_make(0, 0x90, 60, 100);
    assert_int_equal(midi_client_send(c, 0, &m), MIDI_NO_SERVER);
    served_again(&s, devices);
    (void)next_event(c, MIDI_CLIENT_BACK);
    wait_up(c, "keys");
    instrument_send(&keys, "\xf8\x90\x3d\x64", 4); /* with the filters of before */
    m = next_message(c, NULL);
    check_text(&m, "note-on 1 c#4 100");
    midi_client_close(c);
    served_end(&s);
    instrument_unplug(&keys);
}

static void no_note_hangs(void **unused)
{
    (void)unused;
    uint8_t bytes[64];
    struct instrument keys = instrument_plug("keys");
    const char *const *devices = one_device(&keys);
    struct served s = served_begin(devices, 0, NULL);
    struct midi_client *a = client_of(&s, "a", NULL), *b = client_of(&s, "b", NULL);
    wait_up(a, "keys");
    silence_skip(&keys);
    struct midi_message m = midi_message_make(0, 0x90, 60, 100);
    assert_int_equal(midi_client_send(a, 0, &m), MIDI_OK);
    m.bytes[1] = 62;
    assert_int_equal(midi_client_send(a, 0, &m), MIDI_OK);
    assert_int_equal(instrument_hear(&keys, bytes, 5, 2000), 5);
    assert_int_equal(midi_client_send(b, 0, &m), MIDI_OK);
    assert_int_equal(instrument_hear(&keys, bytes, 2, 2000), 2);
    midi_client_close(a); /* b still holds 62 */
    assert_int_equal(instrument_hear(&keys, bytes, 64, 200), 3);
    assert_memory_equal(bytes, "\x80\x3c\x40", 3);
    /* When the server ends, it releases all notes. */
    served_end(&s);
    assert_int_equal(instrument_hear(&keys, bytes, 64, 200), 2);
    assert_memory_equal(bytes, "\x3e\x40", 2);
    midi_client_close(b);
    instrument_unplug(&keys);
}

/* ---- the rest ---- */

static void status_tells(void **unused)
{
    (void)unused;
    char text[8000];
    char away[300];
    snprintf(away, sizeof away, "away=serial:%s", scratch_path("never there"));
    struct served s = served_begin((const char *[]){"loop", away, "loop", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "curious", "");
    struct midi_message m = midi_message_make(0, 0x90, 1, 2);
    assert_int_equal(midi_client_send(c, 0, &m), MIDI_OK);
    (void)next_message(c, NULL);
    assert_int_equal(midi_client_command(c, "status", text, sizeof text), MIDI_OK);
    static const char *const wanted[] = {"device loop loop in,out up: in 1",
                                         "device loop2 loop",
                                         "never there: No such file",
                                         "curious: sent 1, received 1",
                                         "latency: 1 deliveries",
                                         "usual priority"};
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        if (!strstr(text, wanted[i]))
            fail_msg("%s is not in: %s", wanted[i], text);
    assert_int_equal(midi_client_command(c, "listen nothing", text, sizeof text), MIDI_REFUSED);
    assert_non_null(strstr(midi_error(), "known are loop, away, loop2"));
    assert_int_equal(midi_client_listen(c, "loop", "loud"), MIDI_REFUSED);
    assert_non_null(strstr(midi_error(), "no filter 'loud'"));
    midi_client_close(c);
    served_end(&s);
}

/* The server makes a pseudo-terminal of its own; programs open its link like a serial port. */
static void a_terminal_of_the_servers_own(void **unused)
{
    (void)unused;
    char device[300], link[250];
    uint8_t bytes[100];
    snprintf(link, sizeof link, "%s", scratch_path("port"));
    snprintf(device, sizeof device, "port=pty:%s", link);
    struct served s = served_begin((const char *[]){device, NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "listener", "");
    for (int turn = 0; turn < 2; turn++) { /* opened, closed, and opened again */
        struct instrument other = {.file = open(link, O_RDWR | O_NOCTTY)};
        assert_true(other.file >= 0);
        instrument_send(&other, "\x90\x3c\x64", 3);
        struct midi_message m = next_message(c, NULL);
        check_text(&m, "note-on 1 c4 100");
        silence_skip(&other);
        assert_int_equal(midi_client_send(c, 0, &m), MIDI_OK);
        assert_int_equal(instrument_hear(&other, bytes, 3, 2000), 3);
        close(other.file);
        m = next_message(c, NULL);
        check_text(&m, "note-off 1 c4 64");
    }
    midi_client_close(c);
    served_end(&s);
    assert_int_not_equal(access(link, F_OK), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_client_hears_what_it_asked_for),
        cmocka_unit_test(a_signal_ends_the_wait),
        cmocka_unit_test(a_device_plays_what_clients_send),
        cmocka_unit_test(nothing_is_lost_or_altered),
        cmocka_unit_test(songs_are_played_in_time),
        cmocka_unit_test(unplugged_and_back),
        cmocka_unit_test(the_server_killed_and_back),
        cmocka_unit_test(no_note_hangs),
        cmocka_unit_test(status_tells),
        cmocka_unit_test(a_terminal_of_the_servers_own),
    };
    return cmocka_run_group_tests_name("server", tests, NULL, NULL);
}
