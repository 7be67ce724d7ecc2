/* test_jack.c - the server's JACK ports. The test runs its own JACK server with the dummy
 * driver, and skips where there is none. (security.md 24) */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <jack_library.h>
#include <message_ring.h>
#include <midi_notes.h>
#include <midi_time.h>

#include "../skip.h"
#include "server_support.h"

#include <fcntl.h>
#include <glob.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { ENDS = 4 /* of JACK, while the server runs */ };

static char server_name[32];
/* JACK is made for it: the test, its JACK and the server run so where that is allowed */
static bool realtime;

static pid_t jackd_begin(const char *period)
{
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const int quiet = open("/dev/null", O_RDWR);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        dup2(quiet, STDOUT_FILENO);
        dup2(quiet, STDERR_FILENO);
        execlp("jackd", "jackd", realtime ? "--realtime" : "--no-realtime", "--no-mlock", "-n",
               server_name, "-d", "dummy", "-r", "48000", "-p", period, (char *)NULL);
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

/* Another program of JACK's in the test: an ear at the server's output, and a mouth at its
 * input. */
struct patch {
    const struct jack_library *jack;
    void *client, *ear, *mouth;
    struct message_ring heard, said;
    uint32_t last_frame;
    _Atomic uint32_t
        missed; /* periods, since this machine is busy: what came in them is lost here */
    _Atomic uint32_t late; /* times that JACK said that some program was late */
};

static int patch_late(void *context)
{
    struct patch *p = context;
    p->late++;
    return 0;
}

static int patch_process(uint32_t frames, void *context)
{
    struct patch *p = context;
    void *in = p->jack->jack_port_get_buffer(p->ear, frames);
    void *out = p->jack->jack_port_get_buffer(p->mouth, frames);
    uint8_t bytes[16];
    uint64_t time_ns;
    struct jack_event e;
    const uint32_t now = p->jack->jack_last_frame_time(p->client);
    p->missed += p->last_frame && now - p->last_frame > frames;
    p->last_frame = now;
    for (uint32_t i = 0; i < p->jack->jack_midi_get_event_count(in); i++)
        if (p->jack->jack_midi_event_get(&e, in, i) == 0)
            (void)ring_put(&p->heard, 0, e.buffer, e.size);
    p->jack->jack_midi_clear_buffer(out);
    for (size_t count; (count = ring_look(&p->said, &time_ns, bytes, sizeof bytes)) > 0;) {
        if (p->jack->jack_midi_event_write(out, 0, bytes, count) != 0)
            break;
        (void)ring_take(&p->said, &time_ns, bytes, sizeof bytes);
    }
    return 0;
}

static struct patch patch;
static pid_t jackd;

/* Which JACK is meant, here and in children. */
static void jack_name(void)
{
    snprintf(server_name, sizeof server_name, "lutetia%d", (int)getpid());
    setenv("JACK_DEFAULT_SERVER", server_name, 1);
    setenv("JACK_NO_START_SERVER", "1", 1);
}

/* Starts JACK and connects the patch; false: there is none here. */
static bool jack_begin(const char *period)
{
    jack_name();
    if (jack_load(&patch.jack) != MIDI_OK) {
        print_message("%s\n", midi_error());
        return false;
    }
    jackd = jackd_begin(period);
    patch.client = jack_client(patch.jack, jackd);
    if (!patch.client) {
        kill(jackd, SIGKILL);
        waitpid(jackd, NULL, 0);
        print_message("no JACK server can be started here\n");
        return false;
    }
    return true;
}

/* With an ear the patch waits for the server in each period; with a mouth alone the server
 * waits for it. */
static void patch_begin(bool hears)
{
    const struct jack_library *jack = patch.jack;
    memset(&patch.heard, 0, sizeof patch.heard);
    memset(&patch.said, 0, sizeof patch.said);
    patch.last_frame = 0;
    patch.missed = 0;
    patch.late = 0;
    patch.ear = jack->jack_port_register(patch.client, "ear", JACK_MIDI_TYPE, JACK_PORT_IN, 0);
    patch.mouth =
        jack->jack_port_register(patch.client, "mouth", JACK_MIDI_TYPE, JACK_PORT_OUT, 0);
    assert_true(patch.ear && patch.mouth);
    assert_int_equal(jack->jack_set_process_callback(patch.client, patch_process, &patch), 0);
    assert_int_equal(jack->jack_set_xrun_callback(patch.client, patch_late, &patch), 0);
    assert_int_equal(jack->jack_activate(patch.client), 0);
    if (hears)
        assert_int_equal(jack->jack_connect(patch.client, "lutetia:out", "patch:ear"), 0);
    assert_int_equal(jack->jack_connect(patch.client, "patch:mouth", "lutetia:in"), 0);
}

/* ended: its server has ended; its library goes on for a moment, and is not to be disturbed
 * (device_jack.c). */
static void jack_end(bool ended)
{
    if (ended)
        poll(NULL, 0, 1000);
    patch.jack->jack_client_close(patch.client);
    if (!ended) {
        kill(jackd, SIGTERM);
        waitpid(jackd, NULL, 0);
    }
    leftovers_remove();
}

/* The number after a word in the server's status. */
static unsigned long counted(struct midi_client *c, const char *word)
{
    char text[4000];
    if (midi_client_command(c, "status", text, sizeof text) != MIDI_OK)
        fail_msg("%s", midi_error());
    const char *at = strstr(text, word);
    assert_non_null(at);
    return strtoul(at + strlen(word), NULL, 10);
}

/* Takes what the ear has heard, for so long; follows the notes that sound. */
static unsigned long ear_take(struct midi_notes *sounding, int wait_ms, unsigned long most)
{
    struct midi_message m = {.count = 0};
    unsigned long count = 0;
    uint64_t time_ns, until_ns = midi_now_ns() + (uint64_t)wait_ms * 1000000;
    while (count < most && midi_now_ns() < until_ns) {
        const size_t bytes = ring_take(&patch.heard, &time_ns, m.bytes, MIDI_BYTES_MAX);
        if (!bytes) {
            poll(NULL, 0, 1);
            continue;
        }
        m.count = (uint16_t)bytes;
        midi_notes_take(sounding, &m);
        count += m.bytes[0] == 0x90 || m.bytes[0] == 0x80;
    }
    return count;
}

/* ---- trials: 0, or the line that was not so ---- */

#define must(condition)                                                                        \
    do {                                                                                       \
        if (!(condition))                                                                      \
            return __LINE__;                                                                   \
    } while (0)

/* Waits for the next message; false: none has come in two seconds. */
static bool message_wait(struct midi_client *c, struct midi_message *m)
{
    const uint64_t until_ns = midi_now_ns() + UINT64_C(2000000000);
    struct midi_client_event e;
    while (midi_now_ns() < until_ns)
        if (midi_client_next(c, 100, &e) == MIDI_OK && e.kind == MIDI_CLIENT_MESSAGE) {
            *m = e.message;
            return true;
        }
    return false;
}

static bool lost_wait(struct midi_client *c)
{
    const uint64_t until_ns = midi_now_ns() + UINT64_C(2000000000);
    struct midi_client_event e;
    while (midi_now_ns() < until_ns)
        if (midi_client_next(c, 100, &e) == MIDI_OK && e.kind == MIDI_CLIENT_LOST)
            return e.lost > 0;
    return false;
}

struct trial {
    struct served s;
    struct midi_client *c;
    bool expects_loss, jack_ended;
};

static int still_try(struct trial *t);

/* On a busy machine periods are missed, by the test or by the server: a trial that fails then
 * is made again. */
static void tried(int (*run)(struct trial *t), const char *period, bool expects_loss)
{
    for (int i = 0; i < 30; i++) {
        jack_name();
        /* The server first: it is a fork() of this process, and JACK's library does not know
         * that it has been forked. */
        struct trial t = {.s = served_begin((const char *[]){"jack", NULL}, 0, NULL),
                          .expects_loss = expects_loss};
        if (!jack_begin(period)) {
            served_end(&t.s);
            skip_because("no JACK server can be started here");
        }
        t.c = client_of(&t.s, "patch", "");
        wait_up(t.c, "jack");
        patch_begin(run != still_try);
        const int line = run(&t);
        const unsigned long lost =
            expects_loss || !t.s.process || t.jack_ended ? 0 : counted(t.c, "refused), lost ");
        midi_client_close(t.c);
        if (t.s.process)
            served_end(&t.s);
        const uint32_t missed = patch.missed, late = patch.late;
        jack_end(t.jack_ended);
        if (!line)
            return;
        print_message("line %d; the test missed %u periods, the server lost %lu, JACK was late "
                      "%u times\n",
                      line, missed, lost, late);
        if (!missed && !lost && !late)
            fail_msg("line %d", line);
    }
    fail_msg("every trial was spoiled");
}

/* Faster than JACK takes them: the sender waits, and all arrive. Where the server missed
 * periods that is told, and no note hangs. */
static int fast_try(struct trial *t)
{
    enum { MESSAGES = 20000 };
    struct midi_notes sounding = {0};
    unsigned long heard = 0, more = 1;
    for (int i = 0; i < MESSAGES; i++) {
        const struct midi_message m =
            midi_message_make(0, i % 2 ? 0x80 : 0x90, (uint8_t)(i / 2 % 128), 64);
        must(midi_client_send(t->c, 0, &m) == MIDI_OK);
        if (i % 500 == 0)
            heard += ear_take(&sounding, 1, MESSAGES);
    }
    while (heard < MESSAGES && more)
        heard += more = ear_take(&sounding, 1000, MESSAGES - heard);
    const unsigned long lost = counted(t->c, "refused), lost ");
    print_message("%lu of %d arrived, %lu were told as lost\n", heard, MESSAGES, lost);
    must(heard >= MESSAGES || lost > 0);
    (void)ear_take(&sounding, lost ? 1500 : 1, MESSAGES);
    must(midi_notes_count(&sounding) == 0);
    return 0;
}

static void a_fast_player_waits(void **unused)
{
    (void)unused;
    tried(fast_try, "1024", false);
}

/* The server stands still for a while: what comes meanwhile is lost, that is told, and its
 * notes end. */
static int still_try(struct trial *t)
{
    static const uint8_t on[3] = {0x90, 60, 100}, off[3] = {0x80, 60, 64};
    struct midi_message m;
    must(ring_put(&patch.said, 0, on, 3));
    must(message_wait(t->c, &m) && m.bytes[0] == 0x90 && m.bytes[1] == 60);
    const unsigned long before = counted(t->c, "refused), lost ");
    kill(t->s.process, SIGSTOP);
    poll(NULL, 0, 200);
    const bool put = ring_put(&patch.said, 0, off, 3);
    poll(NULL, 0, 200);
    kill(t->s.process, SIGCONT);
    must(put && ring_used(&patch.said) == 0);
    must(lost_wait(t->c));
    must(message_wait(t->c, &m) && m.bytes[0] == 0x80 && m.bytes[1] == 60);
    must(counted(t->c, "refused), lost ") > before);
    return 0;
}

static void what_is_lost_is_told_and_ends(void **unused)
{
    (void)unused;
    tried(still_try, "1024", true);
}

/* The end of a note may be lost at the ear: after a loss it is sent again, and a note that is
 * held goes on. */
static int again_try(struct trial *t)
{
    struct midi_notes sounding = {0};
    const struct midi_message on = midi_message_make(0, 0x90, 60, 64),
                              off = midi_message_make(0, 0x80, 60, 64),
                              held = midi_message_make(0, 0x90, 61, 64);
    must(midi_client_send(t->c, 0, &on) == MIDI_OK &&
         midi_client_send(t->c, 0, &held) == MIDI_OK &&
         midi_client_send(t->c, 0, &off) == MIDI_OK);
    (void)ear_take(&sounding, 5000, 3);
    sounding = (struct midi_notes){0};
    midi_notes_take(&sounding, &on); /* as if its end had not come */
    midi_notes_take(&sounding, &held);
    kill(t->s.process, SIGSTOP);
    poll(NULL, 0, 200);
    kill(t->s.process, SIGCONT);
    (void)ear_take(&sounding, 3000, 1);
    must(midi_notes_count(&sounding) == 1 && sounding.on[0][0] == UINT64_C(1) << 61);
    return 0;
}

static void ends_are_sent_again(void **unused)
{
    (void)unused;
    tried(again_try, "1024", true);
}

/* What the server ends when it stops arrives before its ports go. */
static int stopped_try(struct trial *t)
{
    struct midi_notes sounding = {0};
    for (int i = 0; i < 100; i++) {
        const struct midi_message m = midi_message_make(0, 0x90, (uint8_t)i, 64);
        must(midi_client_send(t->c, 0, &m) == MIDI_OK);
    }
    (void)ear_take(&sounding, 5000, 100);
    must(midi_notes_count(&sounding) == 100);
    must(counted(t->c, "refused), lost ") == 0);
    served_end(&t->s);
    t->s.process = 0;
    (void)ear_take(&sounding, 5000, 100);
    must(midi_notes_count(&sounding) == 0);
    return 0;
}

static void a_stopped_server_ends_its_notes(void **unused)
{
    (void)unused;
    tried(stopped_try, "1024", false);
}

static int through_try(struct trial *t)
{
    struct midi_message note = midi_message_make(0, 0x90, 60, 100), m;
    struct midi_message first = {.count = MIDI_BYTES_MAX, .bytes = {0xf0}};
    struct midi_message last = {.count = 2, .bytes = {1, 0xf7}};
    must(patch.jack->jack_connect(patch.client, "lutetia:out", "lutetia:in") == 0);
    do { /* messages that silence all channels come first */
        must(midi_client_send(t->c, 0, &note) == MIDI_OK);
        must(message_wait(t->c, &m));
    } while (!midi_message_equal(&m, &note));
    const uint64_t before_ns = midi_now_ns();
    note.bytes[1] = 61;
    must(midi_client_send(t->c, 0, &note) == MIDI_OK);
    while (m.bytes[1] != 61)
        must(message_wait(t->c, &m));
    must(midi_message_equal(&m, &note));
    /* its time lies between sending and now, within two periods of 10.7 ms */
    must(m.time_ns + 22000000 > before_ns && m.time_ns <= midi_now_ns());
    must(midi_client_send(t->c, 0, &first) == MIDI_OK);
    must(midi_client_send(t->c, 0, &last) == MIDI_OK);
    must(message_wait(t->c, &m) && midi_message_equal(&m, &first));
    must(message_wait(t->c, &m) && midi_message_equal(&m, &last));
    must(counted(t->c, "refused), lost ") == 0);
    /* When JACK ends, sounding notes end and the device is reported as away. */
    kill(jackd, SIGTERM);
    waitpid(jackd, NULL, 0);
    t->jack_ended = true;
    assert_true(message_wait(t->c, &m));
    check_text(&m, "note-off 1 c4 64");
    const struct midi_client_event e = next_event(t->c, MIDI_CLIENT_DEVICE);
    assert_non_null(strstr(e.text, "jack jack in,out down"));
    return 0;
}

static void messages_go_through_jack(void **unused)
{
    (void)unused;
    tried(through_try, "512", false);
}

/* What JACK's server says last is still being handled by its library when the server is told:
 * that must not hold the server. */
static void jack_ends_and_comes_again(void **unused)
{
    (void)unused;
    if (!jack_begin("512"))
        skip_because("no JACK server can be started here");
    jack_end(false);
    struct served s = served_begin((const char *[]){"jack", NULL}, 0, NULL);
    struct midi_client *c = client_of(&s, "look", "");
    const struct midi_message note = midi_message_make(0, 0x90, 60, 100);
    for (int i = 0; i < ENDS; i++) {
        jackd = jackd_begin("512");
        wait_up(c, "jack");
        for (int k = 0; k < 8; k++)
            assert_int_equal(midi_client_send(c, 0, &note), MIDI_OK);
        kill(jackd, i % 4 == 3 ? SIGKILL : SIGTERM);
        waitpid(jackd, NULL, 0);
        while (!strstr(next_event(c, MIDI_CLIENT_DEVICE).text, "jack jack in,out down"))
            continue;
        leftovers_remove();
    }
    midi_client_close(c);
    served_end(&s);
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
    const struct sched_param priority = {.sched_priority = 5};
    realtime = sched_setscheduler(0, SCHED_RR, &priority) == 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(
            without_a_server_that_is_said), /* first: children would inherit a client */
        cmocka_unit_test(jack_ends_and_comes_again),
        cmocka_unit_test(messages_go_through_jack),
        cmocka_unit_test(a_fast_player_waits),
        cmocka_unit_test(what_is_lost_is_told_and_ends),
        cmocka_unit_test(ends_are_sent_again),
        cmocka_unit_test(a_stopped_server_ends_its_notes),
    };
    return cmocka_run_group_tests_name("jack", tests, NULL, NULL);
}
