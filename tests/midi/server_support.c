/* server_support.c - see server_support.h. */
#include "server_support.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <midi_server.h>
#include <midi_time.h>

#include "../display/scratch.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <termios.h>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

static struct midi_server *running;

static void end_asked(int signal_number)
{
    (void)signal_number;
    midi_server_stop(running);
}

static void serve(const struct midi_server_def *def)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    closefrom(3); /* the server must not hold the test's instruments open */
    if (midi_server_create(def, &running) != MIDI_OK) {
        fprintf(stderr, "server: %s\n", midi_error());
        _exit(1);
    }
    signal(SIGTERM, end_asked);
    midi_server_run(running);
    midi_server_destroy(running);
#ifdef __SANITIZE_ADDRESS__
    __lsan_do_leak_check(); /* not exit(), which would remove the test's scratch folders */
#endif
    _exit(0);
}

static void begin(struct served *s, const char *const *devices, int tcp_port, const char *token)
{
    struct midi_server_def def = {
        .path = s->path, .tcp_port = tcp_port, .token = token, .devices = devices};
    while (devices[def.devices_count])
        def.devices_count++;
    s->process = fork();
    assert_true(s->process >= 0);
    if (s->process == 0)
        serve(&def);
    struct midi_client_def client_def = {.name = "look", .address = s->path};
    const uint64_t until_ns = midi_now_ns() + UINT64_C(10000000000);
    struct midi_client *c = NULL;
    while (midi_client_open(&client_def, &c) != MIDI_OK) {
        if (midi_now_ns() > until_ns || waitpid(s->process, NULL, WNOHANG) != 0)
            fail_msg("the server did not start: %s", midi_error());
        poll(NULL, 0, 2);
    }
    midi_client_close(c);
}

struct served served_begin(const char *const *devices, int tcp_port, const char *token)
{
    static int count;
    struct served s;
    char name[32];
    snprintf(name, sizeof name, "socket%d", count++);
    snprintf(s.path, sizeof s.path, "%s", scratch_path(name));
    begin(&s, devices, tcp_port, token);
    return s;
}

void served_again(struct served *s, const char *const *devices)
{
    begin(s, devices, 0, NULL);
}

void served_kill(struct served *s)
{
    kill(s->process, SIGKILL);
    waitpid(s->process, NULL, 0);
}

void served_end(struct served *s)
{
    int status;
    kill(s->process, SIGTERM);
    assert_int_equal(waitpid(s->process, &status, 0), s->process);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    assert_int_not_equal(access(s->path, F_OK), 0);
}

/* ---- instruments ---- */

void instrument_again(struct instrument *i)
{
    char other[128];
    struct termios t;
    i->file = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    assert_true(i->file >= 0 && grantpt(i->file) == 0 && unlockpt(i->file) == 0);
    assert_int_equal(ptsname_r(i->file, other, sizeof other), 0);
    assert_int_equal(tcgetattr(i->file, &t), 0);
    cfmakeraw(&t); /* raw before the server opens it, so that no byte is changed */
    assert_int_equal(tcsetattr(i->file, TCSANOW, &t), 0);
    unlink(i->link); /* of a test that failed */
    assert_int_equal(symlink(other, i->link), 0);
}

struct instrument instrument_plug(const char *name)
{
    struct instrument i;
    snprintf(i.link, sizeof i.link, "%s", scratch_path(name));
    instrument_again(&i);
    return i;
}

void instrument_unplug(struct instrument *i)
{
    unlink(i->link);
    close(i->file);
}

void instrument_send(const struct instrument *i, const void *bytes, size_t count)
{
    assert_int_equal(write(i->file, bytes, count), count);
}

size_t instrument_hear(const struct instrument *i, uint8_t *bytes, size_t count, int wait_ms)
{
    size_t at = 0;
    struct pollfd p = {i->file, POLLIN, 0};
    while (at < count && poll(&p, 1, wait_ms) > 0) {
        const ssize_t got = read(i->file, bytes + at, count - at);
        if (got <= 0)
            break;
        at += (size_t)got;
    }
    return at;
}

/* ---- clients ---- */

struct midi_client *client_of(const struct served *s, const char *name, const char *filters)
{
    struct midi_client_def def = midi_client_def_default(name);
    struct midi_client *c;
    def.address = s->path;
    if (midi_client_open(&def, &c) != MIDI_OK ||
        (filters && midi_client_listen(c, "*", filters) != MIDI_OK))
        fail_msg("%s: %s", name, midi_error());
    return c;
}

struct midi_client_event next_event(struct midi_client *c, enum midi_client_kind kind)
{
    const uint64_t until_ns = midi_now_ns() + UINT64_C(5000000000);
    struct midi_client_event e;
    do {
        if (midi_client_next(c, 100, &e) != MIDI_OK)
            fail_msg("%s", midi_error());
        if (e.kind == kind)
            return e;
    } while (midi_now_ns() < until_ns);
    fail_msg("no event of kind %d came", (int)kind);
    return e;
}

struct midi_message next_message(struct midi_client *c, int *device)
{
    const struct midi_client_event e = next_event(c, MIDI_CLIENT_MESSAGE);
    if (device)
        *device = e.device;
    return e.message;
}

void wait_up(struct midi_client *c, const char *device)
{
    char text[4000], line[100];
    const uint64_t until_ns = midi_now_ns() + UINT64_C(5000000000);
    do {
        if (midi_client_command(c, "devices", text, sizeof text) != MIDI_OK)
            fail_msg("%s", midi_error());
        snprintf(line, sizeof line, "%s ", device);
        const char *at = strstr(text, line);
        if (at && strstr(at, " up") && strstr(at, " up") < at + strcspn(at, "\n"))
            return;
        poll(NULL, 0, 2);
    } while (midi_now_ns() < until_ns);
    fail_msg("%s did not come up: %s", device, text);
}

const char *const *one_device(const struct instrument *i)
{
    static char spec[300];
    static const char *specs[2] = {spec, NULL};
    snprintf(spec, sizeof spec, "keys=serial:%s@31250", i->link);
    return specs;
}

/* All channels, with running status. */
void silence_skip(const struct instrument *i)
{
    uint8_t bytes[80];
    assert_int_equal(instrument_hear(i, bytes, 80, 2000), 80);
    assert_memory_equal(bytes, "\xb0\x40\0\x7b\0", 5);
}

void check_text(const struct midi_message *m, const char *words)
{
    char text[MIDI_TEXT_MAX];
    midi_message_text(m, text);
    assert_string_equal(text, words);
}
