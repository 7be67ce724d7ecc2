/* test_server_bad.c - clients that send garbage, flood or never read, and sockets in the way.
 * They get clear messages, and others notice nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <midi_notes.h>
#include <midi_server.h>
#include <midi_time.h>
#include <midi_wire.h>

#include "../display/scratch.h"
#include "../sample.h"
#include "server_support.h"

#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>

static int raw_connection(const struct served *s)
{
    struct sockaddr_un name = {.sun_family = AF_UNIX};
    snprintf(name.sun_path, sizeof name.sun_path, "%s", s->path);
    int file = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_true(file >= 0);
    assert_int_equal(connect(file, (const struct sockaddr *)&name, sizeof name), 0);
    return file;
}

static void frame_write(int file, uint8_t kind, uint8_t device, const void *payload,
                        size_t count)
{
    uint8_t bytes[MIDI_WIRE_HEAD + 2000];
    const struct midi_wire_frame f = {.count = (uint16_t)count, .kind = kind, .device = device};
    midi_wire_head(&f, bytes);
    memcpy(bytes + MIDI_WIRE_HEAD, payload, count);
    ssize_t written = send(file, bytes, MIDI_WIRE_HEAD + count, MSG_NOSIGNAL);
    (void)written;
}

/* Checks that the connection ends with an error frame with this text. */
static void ends_with(int file, const char *says)
{
    uint8_t bytes[8192];
    size_t count = 0, at = 0;
    ssize_t got;
    struct pollfd p = {file, POLLIN, 0};
    while (count < sizeof bytes && poll(&p, 1, 3000) > 0 &&
           (got = recv(file, bytes + count, sizeof bytes - count, 0)) > 0)
        count += (size_t)got;
    char text[1000] = "";
    struct midi_wire_frame f;
    for (size_t used; (used = midi_wire_read(bytes + at, count - at, &f)); at += used)
        if (f.kind == MIDI_WIRE_ERROR)
            snprintf(text, sizeof text, "%.*s", (int)f.count, (const char *)f.payload);
    if (!strstr(text, says))
        fail_msg("said '%s', not '%s'", text, says);
    close(file);
}

static void garbage_is_answered_and_others_go_on(void **unused)
{
    (void)unused;
    static const char hello[] = MIDI_WIRE_GREETING "\nx\n";
    static const char browser[] = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
    struct instrument keys = instrument_plug("keys");
    struct served s = served_begin(one_device(&keys), 0, NULL);
    struct midi_client *good = client_of(&s, "good", "");
    wait_up(good, "keys");
    uint64_t seed = 77;
    int file = raw_connection(&s);
    assert_true(send(file, browser, sizeof browser - 1, MSG_NOSIGNAL) > 0);
    ends_with(file, "no frame");
    file = raw_connection(&s);
    frame_write(file, MIDI_WIRE_MIDI, 0, "\x90\x3c\x64", 3);
    ends_with(file, "greeting must come first");
    file = raw_connection(&s);
    frame_write(file, MIDI_WIRE_HELLO, 0, "hello", 5);
    ends_with(file, "the greeting must be");
    file = raw_connection(&s);
    frame_write(file, MIDI_WIRE_HELLO, 0, hello, sizeof hello - 1);
    frame_write(file, MIDI_WIRE_HELLO, 0, hello, sizeof hello - 1);
    ends_with(file, "second greeting");
    file = raw_connection(&s);
    frame_write(file, MIDI_WIRE_HELLO, 0, hello, sizeof hello - 1);
    frame_write(file, MIDI_WIRE_MIDI, 0, "\x90\x3c\xff", 3);
    ends_with(file, "no MIDI message");
    file = raw_connection(&s);
    frame_write(file, MIDI_WIRE_HELLO, 0, hello, sizeof hello - 1);
    frame_write(file, MIDI_WIRE_MIDI, 200, "\x90\x3c\x64", 3);
    ends_with(file, "no device of that number");
    file = raw_connection(&s);
    frame_write(file, MIDI_WIRE_HELLO, 0, hello, sizeof hello - 1);
    frame_write(file, MIDI_WIRE_COMMAND, 0, "dance", 5);
    shutdown(file, SHUT_WR);
    ends_with(file, "known are listen");
    for (int turn = 0; turn < 100; turn++) { /* random bytes, with or without a greeting */
        uint8_t bytes[200];
        file = raw_connection(&s);
        if (turn & 1)
            frame_write(file, MIDI_WIRE_HELLO, 0, hello, sizeof hello - 1);
        for (size_t i = 0; i < sizeof bytes; i++)
            bytes[i] = (uint8_t)sample_word(&seed);
        if (turn & 2) /* heads that may be right */
            for (size_t i = 0; i < sizeof bytes; i += 20) {
                bytes[i] = 4;
                bytes[i + 1] = 0;
                bytes[i + 2] &= 3;
                bytes[i + 3] = 0;
            }
        ssize_t written = send(file, bytes, sizeof bytes, MSG_NOSIGNAL);
        (void)written;
        close(file);
    }
    instrument_send(&keys, "\x90\x3c\x64", 3);
    struct midi_message m = next_message(good, NULL);
    check_text(&m, "note-on 1 c4 100");
    midi_client_close(good);
    served_end(&s);
    instrument_unplug(&keys);
}

/* A client that never reads loses messages, is told so when it reads at last, and its notes
 * end. The others receive everything. */
static void who_does_not_read_is_told_what_it_lost(void **unused)
{
    (void)unused;
    enum { NOTES = 30000 };
    struct served s = served_begin((const char *[]){"loop", NULL}, 0, NULL);
    struct midi_client *player = client_of(&s, "player", NULL),
                       *good = client_of(&s, "good", "");
    struct midi_client *slow = client_of(&s, "slow", "");
    struct midi_client_event e;
    uint32_t heard = 0;
    for (int i = 0; i < NOTES; i++) {
        struct midi_message m =
            midi_message_make(0, 0x90, (uint8_t)(i % 100), (uint8_t)(1 + i % 120));
        if (i == NOTES / 2)
            m = midi_message_make(0, 0x91, 127, 1); /* sounds when it begins to lose */
        assert_int_equal(midi_client_send(player, 0, &m), MIDI_OK);
        while (midi_client_next(good, 0, &e) == MIDI_OK && e.kind != MIDI_CLIENT_NOTHING)
            heard += e.kind == MIDI_CLIENT_MESSAGE;
    }
    while (heard < NOTES && midi_client_next(good, 1000, &e) == MIDI_OK &&
           e.kind != MIDI_CLIENT_NOTHING)
        heard += e.kind == MIDI_CLIENT_MESSAGE;
    assert_int_equal(heard, NOTES);
    struct midi_notes notes = {0};
    uint32_t got = 0, lost = 0;
    while (midi_client_next(slow, 700, &e) == MIDI_OK && e.kind != MIDI_CLIENT_NOTHING) {
        if (e.kind == MIDI_CLIENT_MESSAGE) {
            got += !lost;
            midi_notes_take(&notes, &e.message);
        }
        lost += e.kind == MIDI_CLIENT_LOST ? e.lost : 0;
    }
    assert_true(lost > 0 && got > 0);
    assert_int_equal(got + lost, NOTES);
    assert_int_equal(midi_notes_count(&notes), 0);
    midi_client_close(player);
    midi_client_close(good);
    midi_client_close(slow);
    served_end(&s);
}

/* One client floods a device that accepts nothing; another client's device is not affected. */
static void a_flood_stays_where_it_is(void **unused)
{
    (void)unused;
    static const char hello[] = MIDI_WIRE_GREETING "\nflood\n";
    struct instrument keys = instrument_plug("keys"), synth = instrument_plug("synth");
    char a[300], b[300];
    snprintf(a, sizeof a, "keys=raw:%s", keys.link);
    snprintf(b, sizeof b, "synth=raw:%s", synth.link);
    struct served s = served_begin((const char *[]){a, b, NULL}, 0, NULL);
    struct midi_client *good = client_of(&s, "good", "");
    wait_up(good, "keys");
    wait_up(good, "synth");
    const int file = raw_connection(&s);
    frame_write(file, MIDI_WIRE_HELLO, 0, hello, sizeof hello - 1);
    uint8_t frame[MIDI_WIRE_HEAD + 3];
    const struct midi_wire_frame f = {3, MIDI_WIRE_MIDI, 1, 0, 0, NULL};
    midi_wire_head(&f, frame);
    memcpy(frame + MIDI_WIRE_HEAD, "\x90\x3c\x64", 3);
    const pid_t flood = fork();
    if (flood == 0)
        while (send(file, frame, sizeof frame, MSG_NOSIGNAL) > 0)
            ;
    assert_true(flood > 0);
    struct pollfd p = {file, POLLOUT, 0};
    while (poll(&p, 1, 50) > 0)
        ; /* until it is not read from any more */
    struct midi_message m = midi_message_make(0, 0x90, 60, 100);
    const uint64_t before_ns = midi_now_ns();
    instrument_send(&keys, "\x90\x3e\x64", 3);
    m = next_message(good, NULL);
    check_text(&m, "note-on 1 d4 100");
    assert_int_equal(midi_client_send(good, 0, &m), MIDI_OK);
    silence_skip(&keys);
    uint8_t bytes[5000];
    assert_int_equal(instrument_hear(&keys, bytes, 3, 2000), 3);
    assert_true(midi_now_ns() - before_ns < UINT64_C(1000000000));
    /* Both clients play the full device. They take turns, so the other client's note comes soon
     * after there is room. */
    m = midi_message_make(0, 0x95, 1, 2);
    assert_int_equal(midi_client_send(good, 1, &m), MIDI_OK);
    size_t total = 0;
    bool there = false;
    while (!there && total < 100000) { /* a terminal keeps 64 KiB */
        const size_t count = instrument_hear(&synth, bytes, sizeof bytes, 500);
        assert_true(count > 0);
        total += count;
        there = memmem(bytes, count, "\x95\x01\x02", 3) != NULL;
    }
    assert_true(there);
    kill(flood, SIGKILL);
    waitpid(flood, NULL, 0);
    close(file);
    midi_client_close(good);
    served_end(&s);
    instrument_unplug(&keys);
    instrument_unplug(&synth);
}

/* ---- sockets ---- */

static enum midi_status create_at(const char *path, const char *const *devices, int count)
{
    struct midi_server_def def = {.path = path, .devices = devices, .devices_count = count};
    struct midi_server *server;
    enum midi_status status = midi_server_create(&def, &server);
    midi_server_destroy(server);
    return status;
}

static void sockets_in_the_way(void **unused)
{
    (void)unused;
    struct served s = served_begin((const char *[]){"loop", NULL}, 0, NULL);
    struct stat about;
    assert_int_equal(stat(s.path, &about), 0);
    assert_int_equal(about.st_mode & 0777, 0600);
    assert_int_equal(create_at(s.path, NULL, 0), MIDI_REFUSED);
    assert_non_null(strstr(midi_error(), "listens there already"));
    served_kill(&s); /* its socket stays */
    assert_int_equal(stat(s.path, &about), 0);
    struct midi_client_def client_def = {.name = "x", .address = s.path};
    struct midi_client *c;
    assert_int_equal(midi_client_open(&client_def, &c), MIDI_NO_SERVER);
    assert_non_null(strstr(midi_error(), "lutetia midi serve"));
    assert_int_equal(create_at(s.path, NULL, 0), MIDI_OK); /* and is replaced */
    const char *file = scratch_path("a file");
    fclose(fopen(file, "w"));
    assert_int_equal(create_at(file, NULL, 0), MIDI_REFUSED);
    assert_non_null(strstr(midi_error(), "no socket"));
    assert_int_equal(create_at("/nowhere/socket", NULL, 0), MIDI_IO_FAILED);
    /* Another user may not connect; tested only as root. */
    if (getuid() == 0) {
        s = served_begin((const char *[]){"loop", NULL}, 0, NULL);
        assert_int_equal(chmod(scratch_dir, 0755), 0);
        static const mode_t modes[] = {0600, 0666}; /* the kernel refuses; the server does */
        for (int i = 0; i < 2; i++) {
            assert_int_equal(chmod(s.path, modes[i]), 0);
            pid_t other = fork();
            if (other == 0) {
                bool ok = setuid(65534) == 0;
                client_def.address = s.path;
                for (int k = 0; k < 20; k++)
                    ok = ok && midi_client_open(&client_def, &c) == MIDI_REFUSED &&
                         strstr(midi_error(), "another user's");
                ok = ok && create_at(s.path, NULL, 0) == MIDI_REFUSED &&
                     strstr(midi_error(), "another user's");
                _exit(ok ? 0 : 1);
            }
            int status;
            waitpid(other, &status, 0);
            assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        }
        served_end(&s);
    }
}

static void tcp_needs_its_token(void **unused)
{
    (void)unused;
    const int port = 20000 + (int)(getpid() % 20000);
    char address[40];
    struct midi_server_def def = {.path = scratch_path("no token"), .tcp_port = port};
    struct midi_server *server;
    assert_int_equal(midi_server_create(&def, &server), MIDI_BAD_ARGUMENT);
    struct served s = served_begin((const char *[]){"loop", NULL}, port, "sesame");
    snprintf(address, sizeof address, "127.0.0.1:%d", port);
    struct midi_client_def client_def = {.name = "x", .address = address, .token = "sesame"};
    struct midi_client *c;
    assert_int_equal(midi_client_open(&client_def, &c), MIDI_OK);
    struct midi_message m = midi_message_make(0, 0x90, 1, 2);
    assert_int_equal(midi_client_listen(c, "loop", ""), MIDI_OK);
    assert_int_equal(midi_client_send(c, 0, &m), MIDI_OK);
    m = next_message(c, NULL);
    check_text(&m, "note-on 1 c#-1 2");
    midi_client_close(c);
    static const char *const wrong[] = {"", "sesam", "sesame ", "open"};
    for (size_t i = 0; i < 4; i++) {
        client_def.token = wrong[i];
        assert_int_equal(midi_client_open(&client_def, &c), MIDI_REFUSED);
        assert_non_null(strstr(midi_error(), "token"));
    }
    served_end(&s);
    client_def.address = "example.org:80";
    assert_int_equal(midi_client_open(&client_def, &c), MIDI_BAD_ARGUMENT);
}

static void wrong_devices_are_refused(void **unused)
{
    (void)unused;
    const char *path = scratch_path("wrong");
    const char *file = scratch_path("some.txt");
    char as_raw[300], as_serial[300];
    fclose(fopen(file, "w"));
    snprintf(as_raw, sizeof as_raw, "raw:%s", file);
    snprintf(as_serial, sizeof as_serial, "serial:/dev/null@3");
    const struct {
        const char *device, *says;
    } wrong[] = {{"piano:grand", "known kinds are raw"},
                 {"keys=", "known kinds are raw"},
                 {"serial", "needs its PATH"},
                 {as_raw, "no device"},
                 {as_serial, "50..4000000"},
                 {"file:/nowhere/song.mid", "No such file"},
                 {"raw:/dev/null", "not a stream"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const enum midi_status status = create_at(path, &wrong[i].device, 1);
        if (status == MIDI_OK || !strstr(midi_error(), wrong[i].says))
            fail_msg("%s: %s", wrong[i].device, status ? midi_error() : "it was taken");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(garbage_is_answered_and_others_go_on),
        cmocka_unit_test(who_does_not_read_is_told_what_it_lost),
        cmocka_unit_test(a_flood_stays_where_it_is),
        cmocka_unit_test(sockets_in_the_way),
        cmocka_unit_test(tcp_needs_its_token),
        cmocka_unit_test(wrong_devices_are_refused),
    };
    return cmocka_run_group_tests_name("server, troubled", tests, NULL, NULL);
}
