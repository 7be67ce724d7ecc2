/* test_jack.c - the server's JACK ports. The test runs its own JACK server with the dummy driver, and skips where there is
 * none. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <jack_library.h>
#include <midi_time.h>

#include "../skip.h"
#include "server_support.h"

#include <fcntl.h>
#include <glob.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

static char server_name[32];

static pid_t jackd_begin(void)
{
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const int quiet = open("/dev/null", O_RDWR);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        dup2(quiet, STDOUT_FILENO);
        dup2(quiet, STDERR_FILENO);
        execlp("jackd", "jackd", "--no-realtime", "-n", server_name, "-d", "dummy", "-r",
               "48000", "-p", "128", (char *)NULL);
        _exit(127);
    }
    return child;
}

/* Opens a JACK client; NULL: no server came within five seconds, or there is no jackd. */
static void *jack_client(const struct jack_library *jack, pid_t jackd)
{
    const uint64_t until_ns = midi_now_ns() + UINT64_C(5000000000);
    void *client = NULL;
    while (!client && midi_now_ns() < until_ns && waitpid(jackd, NULL, WNOHANG) == 0) {
        poll(NULL, 0, 50);
        client = jack->jack_client_open("patch", JACK_NO_START, NULL);
    }
    return client;
}

/* Removes the semaphores that a killed server and its clients leave. */
static void leftovers_remove(void)
{
    char pattern[100];
    glob_t found;
    snprintf(pattern, sizeof pattern, "/dev/shm/jack*%s*", server_name);
    if (glob(pattern, 0, NULL, &found) == 0) {
        for (size_t i = 0; i < found.gl_pathc; i++)
            unlink(found.gl_pathv[i]);
        globfree(&found);
    }
}

static void messages_go_through_jack(void **unused)
{
    (void)unused;
    const struct jack_library *jack;
    snprintf(server_name, sizeof server_name, "lutetia%d", (int)getpid());
    setenv("JACK_DEFAULT_SERVER", server_name, 1);
    setenv("JACK_NO_START_SERVER", "1", 1);
    if (jack_load(&jack) != MIDI_OK) {
        skip_because("%s", midi_error());
    }
    const pid_t jackd = jackd_begin();
    void *patch = jack_client(jack, jackd);
    if (!patch) {
        kill(jackd, SIGKILL);
        waitpid(jackd, NULL, 0);
        skip_because("no JACK server can be started here");
    }
    struct served s = served_begin((const char *[]){"jack", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "listener", "");
    wait_up(c, "jack");
    /* connects output to input */
    assert_int_equal(jack->jack_activate(patch), 0);
    assert_int_equal(jack->jack_connect(patch, "lutetia:out", "lutetia:in"), 0);
    struct midi_message note = midi_message_make(0, 0x90, 60, 100), m;
    struct midi_message first = {.count = MIDI_BYTES_MAX, .bytes = {0xf0}};
    struct midi_message last = {.count = 2, .bytes = {1, 0xf7}};
    do { /* messages that silence all channels come first */
        assert_int_equal(midi_client_send(c, 0, &note), MIDI_OK);
        m = next_message(c, NULL);
    } while (!midi_message_equal(&m, &note));
    const uint64_t before_ns = midi_now_ns();
    note.bytes[1] = 61;
    assert_int_equal(midi_client_send(c, 0, &note), MIDI_OK);
    while (m.bytes[1] != 61)
        m = next_message(c, NULL);
    assert_true(midi_message_equal(&m, &note));
    /* its time lies between sending and now, within two periods of 2.7 ms */
    assert_true(m.time_ns + 6000000 > before_ns && m.time_ns <= midi_now_ns());
    assert_int_equal(midi_client_send(c, 0, &first), MIDI_OK);
    assert_int_equal(midi_client_send(c, 0, &last), MIDI_OK);
    m = next_message(c, NULL);
    assert_true(midi_message_equal(&m, &first));
    m = next_message(c, NULL);
    assert_true(midi_message_equal(&m, &last));
    /* When JACK ends, sounding notes end and the device is reported as away. */
    kill(jackd, SIGTERM);
    waitpid(jackd, NULL, 0);
    m = next_message(c, NULL);
    check_text(&m, "note-off 1 c4 64");
    const struct midi_client_event e = next_event(c, MIDI_CLIENT_DEVICE);
    assert_non_null(strstr(e.text, "jack jack in,out down"));
    midi_client_close(c);
    served_end(&s);
    leftovers_remove();
}

static void without_a_server_that_is_said(void **unused)
{
    (void)unused;
    const struct jack_library *jack;
    char text[1000];
    setenv("JACK_DEFAULT_SERVER", "lutetia-none", 1);
    if (jack_load(&jack) != MIDI_OK)
        skip_because("%s", midi_error());
    struct served s = served_begin((const char *[]){"jack", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "look", NULL);
    assert_int_equal(midi_client_command(c, "devices", text, sizeof text), MIDI_OK);
    assert_non_null(strstr(text, "down: no JACK server runs"));
    midi_client_close(c);
    served_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            without_a_server_that_is_said), /* first: children would inherit a client */
        cmocka_unit_test(messages_go_through_jack),
    };
    return cmocka_run_group_tests_name("jack", tests, NULL, NULL);
}
