/* test_alsa.c - the server's port of ALSA's sequencer. Where libasound.so.2 is
 * sequencer_twin.c, messages go to a port and come back. With the real library and a kernel
 * without a sequencer, the device reports that. */
#include "../skip.h"
#include "server_support.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <alsa_library.h>
#include <midi_time.h>

#include <glob.h>
#include <unistd.h>

static bool library_installed(void)
{
    glob_t found;
    const bool there = glob("/usr/lib/*/libasound.so.2", 0, NULL, &found) == 0;
    if (there)
        globfree(&found);
    return there;
}

/* Sends a note until it comes back; messages that silence all channels come first. */
static void notes_come_back(struct midi_client *c, int device)
{
    struct midi_message m, note = midi_message_make(0, 0x90, 60, 100);
    assert_int_equal(midi_client_send(c, device, &note), MIDI_OK);
    do
        m = next_message(c, NULL);
    while (!midi_message_equal(&m, &note));
}

/* Sends a system exclusive in that many pieces. */
static void piece_make(struct midi_message *m, int number, int count)
{
    memset(m, 0, sizeof *m);
    m->count = MIDI_BYTES_MAX;
    memset(m->bytes, 1 + number, MIDI_BYTES_MAX);
    if (number == 0)
        m->bytes[0] = 0xf0;
    if (number == count - 1)
        m->bytes[MIDI_BYTES_MAX - 1] = 0xf7;
}

static void messages_go_through_the_sequencer(void **unused)
{
    (void)unused;
    enum { PIECES = 21 }; /* more than the server's coder holds */
    struct midi_message m, piece;
    if (!library_installed())
        skip_because("libasound is not installed");
    struct served s = served_begin((const char *[]){"seq=alsa:20:0", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "listener", "");
    wait_up(c, "seq");
    const int device = midi_client_device(c, "seq");
    notes_come_back(c, device);
    static const char *const words[] = {
        "note-on 10 c#2 90",   "note-off 1 c4 64", "bend 3 -200",        "program 16 127",
        "pressure 2 5",        "control 1 7 127",  "song-position 1200", "clock",
        "poly-pressure 4 g9 3"};
    for (size_t i = 0; i < 400; i++) {
        struct midi_message sent;
        assert_int_equal(midi_message_read(words[i % (sizeof words / sizeof *words)], &sent),
                         MIDI_OK);
        const uint64_t before_ns = midi_now_ns();
        assert_int_equal(midi_client_send(c, device, &sent), MIDI_OK);
        m = next_message(c, NULL);
        assert_true(midi_message_equal(&m, &sent));
        assert_true(m.time_ns >= before_ns && m.time_ns <= midi_now_ns());
    }
    for (int i = 0; i < PIECES; i++) {
        piece_make(&piece, i, PIECES);
        assert_int_equal(midi_client_send(c, device, &piece), MIDI_OK);
    }
    for (int i = 0; i < PIECES; i++) {
        piece_make(&piece, i, PIECES);
        m = next_message(c, NULL);
        assert_true(midi_message_equal(&m, &piece));
    }
    midi_client_close(c);
    served_end(&s);
}

static void a_port_that_goes_is_connected_again(void **unused)
{
    (void)unused;
    const struct midi_message unplugs = midi_message_make(0, 0x90, 127, 127);
    if (!library_installed())
        skip_because("libasound is not installed");
    struct served s = served_begin((const char *[]){"seq=alsa:20:0", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "listener", "");
    wait_up(c, "seq");
    const int device = midi_client_device(c, "seq");
    notes_come_back(c, device);
    assert_int_equal(midi_client_send(c, device, &unplugs), MIDI_OK);
    struct midi_client_event e = next_event(c, MIDI_CLIENT_DEVICE);
    assert_non_null(strstr(e.text, "down"));
    e = next_event(c, MIDI_CLIENT_DEVICE);
    assert_non_null(strstr(e.text, "up"));
    notes_come_back(c, device);
    midi_client_close(c);
    served_end(&s);
}

static void a_port_that_is_not_there_is_named(void **unused)
{
    (void)unused;
    char text[1000];
    if (!library_installed())
        skip_because("libasound is not installed");
    struct served s =
        served_begin((const char *[]){"seq=alsa:Piano", "open=alsa", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "look", NULL);
    assert_int_equal(midi_client_command(c, "devices", text, sizeof text), MIDI_OK);
    assert_non_null(
        strstr(text, "ALSA's sequencer has no port Piano: `aconnect -l` lists them"));
    assert_non_null(strstr(text, "open alsa in,out up"));
    midi_client_close(c);
    served_end(&s);
}

static void without_a_sequencer_that_is_said(void **unused)
{
    (void)unused;
    char text[1000];
    if (!library_installed() || access("/dev/snd/seq", F_OK) == 0)
        skip_because("libasound is not installed, or there is a sequencer");
    struct served s = served_begin((const char *[]){"alsa", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "look", NULL);
    assert_int_equal(midi_client_command(c, "devices", text, sizeof text), MIDI_OK);
    assert_non_null(strstr(text, "down: ALSA's sequencer: No such file or directory "
                                 "(/dev/snd/seq; root loads it by modprobe snd-seq)"));
    midi_client_close(c);
    served_end(&s);
}

int main(int argc, char **argv)
{
    (void)argv;
    const struct CMUnitTest with_twin[] = {
        cmocka_unit_test(messages_go_through_the_sequencer),
        cmocka_unit_test(a_port_that_goes_is_connected_again),
        cmocka_unit_test(a_port_that_is_not_there_is_named),
    };
    const struct CMUnitTest real[] = {cmocka_unit_test(without_a_sequencer_that_is_said)};
    return argc > 1 ? cmocka_run_group_tests_name("alsa twin", with_twin, NULL, NULL)
                    : cmocka_run_group_tests_name("alsa", real, NULL, NULL);
}
