/* midi_scene.c - see midi_scene.h. */
#include "midi_scene.h"
#include "harness.h"
#include "latency.h"
#include "user_folder.h"

#include <midi_client.h>
#include <midi_notes.h>
#include <midi_server.h>
#include <server_workers.h>

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

enum { PRIORITY = 30, READY_MS = 5000 };

static void real_time_set(bool real_time)
{
    const struct sched_param priority = {.sched_priority = real_time ? PRIORITY : 0};
    (void)sched_setscheduler(0, real_time ? SCHED_FIFO : SCHED_OTHER, &priority);
}

bool midi_real_time_allowed(void)
{
    const pid_t child = fork();
    int status = 1;
    if (child == 0) {
        const struct sched_param priority = {.sched_priority = PRIORITY};
        _exit(sched_setscheduler(0, SCHED_FIFO, &priority) == 0 ? 0 : 1);
    }
    return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

bool midi_awake_allowed(void)
{
    return access(LATENCY_PATH, W_OK) == 0;
}

bool midi_terminals_first_allowed(void)
{
    const char *why;
    struct server_workers *workers = workers_create("/proc", &why);
    workers_destroy(workers);
    return workers != NULL;
}

/* splitmix64's finaliser. */
static uint64_t mixed(uint64_t z)
{
    z = (z + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

struct midi_message midi_scene_message(uint32_t i)
{
    const uint64_t any = mixed(i);
    if (any % 64 == 0) { /* a system exclusive of up to 40 bytes */
        struct midi_message m = {.count = (uint16_t)(3 + (any >> 8) % 38), .bytes = {0xf0}};
        for (int k = 1; k < m.count - 1; k++)
            m.bytes[k] = (uint8_t)(mixed(any + (uint64_t)k) & 0x7f);
        m.bytes[m.count - 1] = 0xf7;
        return m;
    }
    /* Mostly notes, on few channels, so that running status is used. */
    const uint8_t kinds[8] = {0x90, 0x90, 0x90, 0x80, 0xa0, 0xb0, 0xd0, 0xe0};
    return midi_message_make(0, (uint8_t)(kinds[any >> 8 & 7] | (any >> 16 & 1)),
                             (uint8_t)(any >> 24 & 0x3f), (uint8_t)(any >> 32 & 0x7f));
}

/* ---- processes ---- */

static struct midi_server *serving;

static void serve_stop(int signal_number)
{
    (void)signal_number;
    midi_server_stop(serving);
}

static void serve(const struct midi_scene *s)
{
    char device[128];
    const char *devices[] = {device};
    if (s->def.player == MIDI_FROM_INSTRUMENT)
        snprintf(device, sizeof device, "keys=serial:%s", s->link);
    else
        snprintf(device, sizeof device, "keys=loop");
    const struct midi_server_def def = {.path = s->path,
                                        .devices = devices,
                                        .devices_count = 1,
                                        .real_time = s->def.real_time,
                                        .awake = !s->def.may_sleep,
                                        .terminals_first = s->def.terminals_first};
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(s->port);
    if (midi_server_create(&def, &serving) != MIDI_OK)
        _exit(1);
    signal(SIGTERM, serve_stop);
    midi_server_run(serving);
    midi_server_destroy(serving);
    _exit(0);
}

/* A device has come or gone: no note may sound then. */
static void device_told(struct midi_listener *l, struct midi_notes *notes, const char *text,
                        uint32_t next)
{
    const size_t length = strlen(text);
    const bool up = length > 3 && strcmp(text + length - 3, " up") == 0;
    if (!l->wrong && midi_notes_count(notes) > 0)
        l->wrong = 1 + next;
    if (up)
        l->back++;
    else
        l->away++;
}

/* The end of a note that sounds, because the instrument is being unplugged. */
static bool is_end(const struct midi_scene *s, const struct midi_notes *notes,
                   const struct midi_message *m, uint32_t next)
{
    struct midi_notes left = *notes;
    if (next != s->shared->unplugged || (m->bytes[0] & 0xf0) != MIDI_NOTE_OFF)
        return false;
    midi_notes_take(&left, m);
    return midi_notes_count(&left) == midi_notes_count(notes) - 1;
}

static void listen_on(const struct midi_scene *s, struct midi_listener *l, uint32_t next)
{
    struct midi_notes notes = {0};
    struct midi_client_def def = {.name = "listener", .address = s->path};
    struct midi_client *client;
    struct midi_client_event e;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(s->port);
    if (midi_client_open(&def, &client) != MIDI_OK ||
        midi_client_listen(client, "keys", "") != MIDI_OK)
        _exit(1);
    l->ready = true;
    while (midi_client_next(client, -1, &e) == MIDI_OK) {
        if (e.kind == MIDI_CLIENT_LOST)
            l->lost += e.lost;
        if (e.kind == MIDI_CLIENT_DEVICE)
            device_told(l, &notes, e.text, next);
        if (e.kind != MIDI_CLIENT_MESSAGE)
            continue;
        const bool end = is_end(s, &notes, &e.message, next);
        midi_notes_take(&notes, &e.message);
        if (end)
            continue;
        const uint64_t now_ns = midi_now_ns();
        const struct midi_message wanted = midi_scene_message(next);
        if (!midi_message_equal(&e.message, &wanted) && !l->wrong)
            l->wrong = 1 + next;
        const uint64_t sent_ns = s->shared->sent_ns[next % MIDI_TIMES];
        midi_histogram_add(&l->took, now_ns - sent_ns);
        if (e.message.time_ns > sent_ns)
            midi_histogram_add(&l->read, e.message.time_ns - sent_ns);
        next++;
        l->heard++;
    }
    _exit(0);
}

/* ---- the scene ---- */

static bool port_open(struct midi_scene *s)
{
    char other[64];
    struct termios t;
    s->port = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (s->port < 0 || grantpt(s->port) != 0 || unlockpt(s->port) != 0 ||
        ptsname_r(s->port, other, sizeof other) != 0 || tcgetattr(s->port, &t) != 0)
        return bench_fail("no pseudo-terminal: %s", strerror(errno));
    cfmakeraw(&t);
    return (tcsetattr(s->port, TCSANOW, &t) == 0 && symlink(other, s->link) == 0) ||
           bench_fail("%s: %s", s->link, strerror(errno));
}

/* Until the server says that its device is there. */
static bool server_ready(const struct midi_scene *s)
{
    const struct midi_client_def def = {.name = "look", .address = s->path};
    const uint64_t until_ns = midi_now_ns() + READY_MS * UINT64_C(1000000);
    struct midi_client *client;
    char text[400] = "";
    while (midi_client_open(&def, &client) != MIDI_OK) {
        if (midi_now_ns() > until_ns || waitpid(s->server, NULL, WNOHANG) != 0)
            return bench_fail("the server did not start: %s", midi_error());
        poll(NULL, 0, 5);
    }
    while (!strstr(text, " up") && midi_now_ns() < until_ns &&
           midi_client_command(client, "devices", text, sizeof text) == MIDI_OK)
        poll(NULL, 0, 5);
    midi_client_close(client);
    return strstr(text, " up") || bench_fail("the server's device did not come: %s", text);
}

bool midi_scene_begin(struct midi_scene *s, const struct midi_scene_def *def)
{
    *s = (struct midi_scene){
        .def = *def, .port = -1, .server = -1, .encoder = {.running_status = true}};
    if (!user_folder_temporary("midi", s->folder, sizeof s->folder))
        return bench_fail("%s: no folder can be made", s->folder);
    snprintf(s->link, sizeof s->link, "%s/keys", s->folder);
    snprintf(s->path, sizeof s->path, "%s/socket", s->folder);
    s->shared = mmap(NULL, sizeof *s->shared, PROT_READ | PROT_WRITE,
                     MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (s->shared == MAP_FAILED) {
        s->shared = NULL;
        return bench_fail("no memory for %zu bytes", sizeof *s->shared);
    }
    if (!port_open(s))
        return false;
    real_time_set(def->real_time);
    s->server = fork();
    if (s->server == 0)
        serve(s);
    if (s->server < 0)
        return bench_fail("no process: %s", strerror(errno));
    const struct midi_client_def player = {.name = "player", .address = s->path};
    return server_ready(s) &&
           (def->player == MIDI_FROM_INSTRUMENT ||
            midi_client_open(&player, &s->client) == MIDI_OK || bench_fail("%s", midi_error()));
}

bool midi_scene_listeners(struct midi_scene *s, int count, uint32_t from)
{
    for (int i = 0; i < count; i++) {
        struct midi_listener *l = &s->shared->listeners[i];
        s->listeners[i] = fork();
        if (s->listeners[i] == 0)
            listen_on(s, l, from);
        s->listeners_count = i + 1;
        if (s->listeners[i] < 0)
            return bench_fail("no process: %s", strerror(errno));
    }
    const uint64_t until_ns = midi_now_ns() + READY_MS * UINT64_C(1000000);
    for (int i = 0; i < count; i++)
        while (!s->shared->listeners[i].ready) {
            if (midi_now_ns() > until_ns)
                return bench_fail("listener %d did not reach the server", i + 1);
            poll(NULL, 0, 2);
        }
    return true;
}

size_t midi_scene_play(struct midi_scene *s, uint32_t i)
{
    uint8_t bytes[MIDI_ENCODED_MAX];
    const struct midi_message m = midi_scene_message(i);
    const size_t count = midi_encoder_put(&s->encoder, &m, bytes);
    s->shared->sent_ns[i % MIDI_TIMES] = midi_now_ns();
    if (s->client)
        return midi_client_send(s->client, 0, &m) == MIDI_OK ? count : 0;
    return write(s->port, bytes, count) == (ssize_t)count ? count : 0;
}

bool midi_scene_wait(struct midi_scene *s, uint32_t count)
{
    uint64_t until_ns = midi_now_ns() + READY_MS * UINT64_C(1000000), sum = 0;
    for (;;) {
        uint64_t now_sum = 0;
        bool all = true;
        for (int i = 0; i < s->listeners_count; i++) {
            const struct midi_listener *l = &s->shared->listeners[i];
            now_sum += l->heard;
            all = all && l->heard >= count;
            if (l->wrong)
                return bench_fail("listener %d: message %u is not what was played", i + 1,
                                  l->wrong - 1);
            if (l->lost)
                return bench_fail("listener %d lost %u messages", i + 1, l->lost);
        }
        if (all)
            return true;
        if (now_sum != sum)
            until_ns = midi_now_ns() + READY_MS * UINT64_C(1000000);
        if (midi_now_ns() > until_ns)
            return bench_fail("%llu messages of %llu arrived", (unsigned long long)now_sum,
                              (unsigned long long)count * (unsigned)s->listeners_count);
        sum = now_sum;
        poll(NULL, 0, 2);
    }
}

/* Until all listeners have been told that the instrument has gone, or is there, so often. */
static bool listeners_told(const struct midi_scene *s, uint32_t away, uint32_t back)
{
    const uint64_t until_ns = midi_now_ns() + READY_MS * UINT64_C(1000000);
    for (int i = 0; i < s->listeners_count; i++)
        while (s->shared->listeners[i].away < away || s->shared->listeners[i].back < back) {
            if (midi_now_ns() > until_ns)
                return bench_fail("listener %d was not told that the instrument %s", i + 1,
                                  s->shared->listeners[i].away < away ? "has gone" : "is back");
            poll(NULL, 0, 2);
        }
    return true;
}

bool midi_scene_replug(struct midi_scene *s, uint32_t i)
{
    if (!midi_scene_wait(s, i))
        return false;
    const uint32_t away = s->shared->listeners[0].away + 1,
                   back = s->shared->listeners[0].back + 1;
    s->shared->unplugged = i;
    close(s->port);
    unlink(s->link);
    s->port = -1;
    s->encoder = (struct midi_encoder){.running_status = true};
    if (!listeners_told(s, away, back - 1) || !port_open(s) || !listeners_told(s, away, back))
        return false;
    s->shared->unplugged = 0;
    return true;
}

static void process_end(pid_t process, int signal_number)
{
    if (process > 0) {
        kill(process, signal_number);
        waitpid(process, NULL, 0);
    }
}

void midi_scene_end(struct midi_scene *s)
{
    real_time_set(false);
    for (int i = 0; i < s->listeners_count; i++)
        process_end(s->listeners[i], SIGKILL);
    midi_client_close(s->client);
    process_end(s->server, SIGTERM);
    if (s->port >= 0)
        close(s->port);
    if (s->shared)
        munmap(s->shared, sizeof *s->shared);
    char lock[128];
    snprintf(lock, sizeof lock, "%s.lock", s->path);
    unlink(lock);
    unlink(s->link);
    rmdir(s->folder);
    s->shared = NULL;
}
