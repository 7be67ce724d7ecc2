/* midi_soak.c - see midi_soak.h. */
#include "midi_soak.h"
#include "harness.h"
#include "input_file.h"
#include "midi_scene.h"
#include "midi_soak_stage.h"
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

enum {
    STEADY = 16,
    TROUBLED = 6,
    BYTE_US = 320,
    CHANGE_MS = 100,
    ASK_MS = 10,
    PLUG_MS = 10000
};

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

static double process_kib(pid_t process)
{
    char path[64];
    long all = 0, resident = 0;
    snprintf(path, sizeof path, "/proc/%ld/statm", (long)process);
    FILE *file = input_file_open(path, NULL);
    if (!file || fscanf(file, "%ld %ld", &all, &resident) != 2)
        resident = 0;
    if (file)
        fclose(file);
    return (double)resident * (double)sysconf(_SC_PAGESIZE) / 1024;
}

/* A process's memory: the most in the second quarter of the time, and in the last. */
struct grown {
    pid_t process;
    double first_kib, last_kib;
};

static void grown_look(struct grown *g, double part)
{
    const double kib = process_kib(g->process);
    g->first_kib = part > 0.25 && part < 0.5 ? fmax(g->first_kib, kib) : g->first_kib;
    g->last_kib = part > 0.75 ? fmax(g->last_kib, kib) : g->last_kib;
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

static void troubled_end(struct troubled *t)
{
    for (int k = 0; k < TROUBLED; k++)
        if (t->processes[k] > 0) {
            kill(t->processes[k], SIGKILL);
            waitpid(t->processes[k], NULL, 0);
        }
}

struct soak {
    struct midi_scene scene;
    struct soak_stage stage;
    struct troubled troubled;
    struct grown server, played; /* played: the stage's */
    uint64_t change_ns, ask_ns, plug_ns, plug_every_ns, plugged;
};

/* What is due besides the instrument's messages, of which i have been played. *due_ns: of the
 * next one. */
static bool soak_turn(struct soak *s, uint32_t i, double part, uint64_t *due_ns)
{
    const uint64_t now_ns = midi_now_ns();
    bool ok = true;
    if (now_ns > s->ask_ns) {
        soak_stage_ask(&s->stage);
        s->ask_ns = now_ns + ASK_MS * UINT64_C(1000000);
    }
    if (now_ns > s->change_ns) {
        trouble_change(&s->troubled, &s->scene);
        s->change_ns = now_ns + CHANGE_MS * UINT64_C(1000000);
        grown_look(&s->server, part);
        grown_look(&s->played, part);
        ok = (waitpid(s->scene.server, NULL, WNOHANG) == 0 ||
              bench_fail("the server is gone")) &&
             (waitpid(s->stage.process, NULL, WNOHANG) == 0 || bench_fail("the stage is gone"));
    }
    if (ok && now_ns > s->plug_ns) {
        soak_stage_settle(&s->stage);
        ok = midi_scene_replug(&s->scene, i);
        s->plugged++;
        *due_ns = midi_now_ns();
        s->plug_ns = *due_ns + s->plug_every_ns;
    }
    return ok;
}

static bool soak_run(struct soak *s, double seconds, struct midi_soak_result *out)
{
    const uint64_t begin_ns = midi_now_ns(), end_ns = begin_ns + (uint64_t)(1e9 * seconds);
    const uint64_t quarter_ns = (end_ns - begin_ns) / 4;
    uint64_t due_ns = begin_ns;
    uint32_t i = 0;
    bool ok = true;
    s->change_ns = s->ask_ns = begin_ns;
    s->plug_every_ns = PLUG_MS * UINT64_C(1000000);
    if (quarter_ns < s->plug_every_ns)
        s->plug_every_ns = quarter_ns;
    s->plug_ns = begin_ns + s->plug_every_ns;
    s->server.process = s->scene.server;
    s->played.process = s->stage.process;
    for (uint64_t now_ns; ok && (now_ns = midi_now_ns()) < end_ns;) {
        const struct midi_message m = midi_scene_message(i);
        const size_t bytes = midi_scene_play(&s->scene, i++);
        ok = bytes > 0 || bench_fail("the instrument cannot write");
        soak_stage_played(&s->stage, &m);
        due_ns += bytes * BYTE_US * 1000;
        port_drain(&s->scene);
        ok = ok && soak_turn(s, i, (double)(now_ns - begin_ns) / (double)(end_ns - begin_ns),
                             &due_ns);
        now_ns = midi_now_ns();
        if (due_ns > now_ns) {
            const struct timespec left = {0, (long)(due_ns - now_ns)};
            ppoll(NULL, 0, &left, NULL);
        }
    }
    troubled_end(&s->troubled);
    if (ok && !midi_scene_wait(&s->scene, i))
        visible_say("soak: %s", bench_error());
    soak_stage_settle(&s->stage);
    out->messages = i;
    out->killed = s->troubled.killed;
    out->plugged = s->plugged;
    out->answers = s->stage.answered;
    out->wrong_answers = s->stage.wrong;
    out->grown_kib = s->server.last_kib - s->server.first_kib;
    out->stage_grown_kib = s->played.last_kib - s->played.first_kib;
    out->server_kib = s->server.last_kib;
    out->stage_kib = s->played.last_kib;
    return ok;
}

bool midi_soak(double seconds, struct midi_soak_result *out)
{
    static struct soak soak;
    static struct midi_histogram all;
    *out = (struct midi_soak_result){0};
    memset(&soak, 0, sizeof soak);
    memset(&all, 0, sizeof all);
    const struct midi_scene_def def = {.player = MIDI_FROM_INSTRUMENT};
    bool ok = midi_scene_begin(&soak.scene, &def) &&
              midi_scene_listeners(&soak.scene, STEADY, 0) &&
              soak_stage_begin(&soak.stage, &soak.scene) && soak_run(&soak, seconds, out);
    for (int i = 0; ok && i < STEADY; i++) {
        const struct midi_listener *l = &soak.scene.shared->listeners[i];
        out->deliveries += l->heard;
        out->wrong += l->lost + (l->heard < out->messages ? out->messages - l->heard : 0) +
                      (l->wrong > 0);
        midi_histogram_join(&all, &l->took);
    }
    out->p50_us = midi_histogram_part(&all, 0.5) / 1e3;
    out->p99_us = midi_histogram_part(&all, 0.99) / 1e3;
    soak_stage_end(&soak.stage);
    midi_scene_end(&soak.scene);
    return ok;
}
