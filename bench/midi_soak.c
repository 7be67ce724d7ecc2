/* midi_soak.c - see midi_soak.h. */
#include "midi_soak.h"
#include "harness.h"
#include "input_file.h"
#include "midi_scene.h"
#include <visible_text.h>

#include <midi_client.h>

#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { STEADY = 4, TROUBLED = 6, BYTE_US = 320, CHANGE_MS = 100 };

/* A program that gives trouble: listens, plays, and sometimes stops reading. */
static void trouble(const struct midi_scene *s, unsigned int kind)
{
    struct midi_client_def def = {.name = "trouble", .address = s->path};
    struct midi_client *client;
    struct midi_client_event e;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(s->port);
    if (midi_client_open(&def, &client) != MIDI_OK ||
        midi_client_listen(client, "*", kind & 1 ? "thin=20 drop=sysex" : "") != MIDI_OK)
        _exit(1);
    if (kind % 3 == 0)
        for (;;)
            pause(); /* never reads */
    for (uint32_t i = 0;; i++) {
        const struct midi_message m = midi_scene_message(i * 7);
        if (midi_client_next(client, 1, &e) != MIDI_OK ||
            (kind % 3 == 1 && midi_client_send(client, 0, &m) != MIDI_OK))
            _exit(0);
    }
}

/* What is played to the instrument has to go somewhere. */
static void port_drain(const struct midi_scene *s)
{
    uint8_t bytes[4096];
    struct pollfd p = {s->port, POLLIN, 0};
    while (poll(&p, 1, 0) > 0 && p.revents & POLLIN && read(s->port, bytes, sizeof bytes) > 0)
        ;
}

static double server_kib(const struct midi_scene *s)
{
    char path[64];
    long all = 0, resident = 0;
    snprintf(path, sizeof path, "/proc/%ld/statm", (long)s->server);
    FILE *file = input_file_open(path, NULL);
    if (!file || fscanf(file, "%ld %ld", &all, &resident) != 2)
        resident = 0;
    if (file)
        fclose(file);
    return (double)resident * (double)sysconf(_SC_PAGESIZE) / 1024;
}

struct troubled {
    pid_t processes[TROUBLED];
    uint64_t killed;
    unsigned int turn;
};

/* Another one is killed, stopped or let go on, or comes. */
static void trouble_change(struct troubled *t, const struct midi_scene *s)
{
    pid_t *p = &t->processes[t->turn % TROUBLED];
    const unsigned int kind = t->turn / TROUBLED + t->turn;
    t->turn++;
    if (*p > 0 && kind % 4 == 1) {
        kill(*p, SIGSTOP);
    } else if (*p > 0 && kind % 4 == 2) {
        kill(*p, SIGCONT);
    } else if (*p > 0) {
        kill(*p, SIGKILL);
        waitpid(*p, NULL, 0);
        t->killed++;
        *p = 0;
    } else {
        *p = fork();
        if (*p == 0)
            trouble(s, kind);
    }
}

static bool soak_run(struct midi_scene *s, double seconds, struct midi_soak_result *out)
{
    const uint64_t begin_ns = midi_now_ns(), end_ns = begin_ns + (uint64_t)(1e9 * seconds);
    uint64_t due_ns = begin_ns, change_ns = begin_ns;
    struct troubled t = {.turn = 0};
    double first_kib = 0, last_kib = 0; /* the most in the second quarter, and in the last */
    uint32_t i = 0;
    bool ok = true;
    for (uint64_t now_ns; ok && (now_ns = midi_now_ns()) < end_ns; i++) {
        const size_t bytes = midi_scene_play(s, i);
        ok = bytes > 0 || bench_fail("the instrument cannot write");
        due_ns += bytes * BYTE_US * 1000;
        port_drain(s);
        if (now_ns > change_ns) {
            trouble_change(&t, s);
            change_ns = now_ns + CHANGE_MS * UINT64_C(1000000);
            const double part = (double)(now_ns - begin_ns) / (double)(end_ns - begin_ns);
            const double kib = server_kib(s);
            first_kib = part > 0.25 && part < 0.5 ? fmax(first_kib, kib) : first_kib;
            last_kib = part > 0.75 ? fmax(last_kib, kib) : last_kib;
            ok = ok &&
                 (waitpid(s->server, NULL, WNOHANG) == 0 || bench_fail("the server is gone"));
        }
        now_ns = midi_now_ns();
        if (due_ns > now_ns) {
            const struct timespec left = {0, (long)(due_ns - now_ns)};
            ppoll(NULL, 0, &left, NULL);
        }
    }
    for (int k = 0; k < TROUBLED; k++)
        if (t.processes[k] > 0) {
            kill(t.processes[k], SIGKILL);
            waitpid(t.processes[k], NULL, 0);
        }
    if (ok && !midi_scene_wait(s, i))
        visible_say("soak: %s", bench_error());
    out->messages = i;
    out->killed = t.killed;
    out->grown_kib = last_kib - first_kib;
    return ok;
}

bool midi_soak(double seconds, struct midi_soak_result *out)
{
    struct midi_scene scene;
    static struct midi_histogram all;
    *out = (struct midi_soak_result){0};
    memset(&all, 0, sizeof all);
    const struct midi_scene_def def = {.player = MIDI_FROM_INSTRUMENT};
    bool ok = midi_scene_begin(&scene, &def) && midi_scene_listeners(&scene, STEADY, 0) &&
              soak_run(&scene, seconds, out);
    for (int i = 0; ok && i < STEADY; i++) {
        const struct midi_listener *l = &scene.shared->listeners[i];
        out->deliveries += l->heard;
        out->wrong += l->lost + (l->heard < out->messages ? out->messages - l->heard : 0) +
                      (l->wrong > 0);
        midi_histogram_join(&all, &l->took);
    }
    out->p99_us = midi_histogram_part(&all, 0.99) / 1e3;
    midi_scene_end(&scene);
    return ok;
}
