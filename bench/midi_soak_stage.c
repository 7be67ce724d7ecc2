/* midi_soak_stage.c - see midi_soak_stage.h. */
#include "midi_soak_stage.h"
#include "bench.h"
#include "harness.h"
#include "midi_live.h"

#include <live_player.h>
#include <osc.h>
#include <output_file.h>

#include <arpa/inet.h>
#include <errno.h>
#include <math.h>
#include <netinet/in.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FPS = 60, CONTROLLER = 7, SETTLE_MS = 5000, VALUES = 900, WAITING_MAX = 400 };

#define SET_CONTROL "/control/restitution"
#define KNOB_CONTROL_NAME "safety"
/* The ends of the way of "safety", which is linear. */
#define KNOB_LEAST 0.05
#define KNOB_MOST 0.95

/* ---- the stage's process ---- */

static void stage_play(const struct midi_scene *scene, const char *knobs, int listen, int send)
{
    char heard[16], sent[16];
    snprintf(heard, sizeof heard, "%d", listen);
    snprintf(sent, sizeof sent, "%d", send);
    const struct live_source_def source_def = {
        .server = scene->path, .device = "keys", .lowest = 48, .no_computer = true};
    struct live_source *source;
    struct stage *stage;
    struct live_player *player;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    close(scene->port);
    if (live_source_open(&source_def, &source) != MIDI_OK || !midi_live_masses(&stage))
        _exit(1);
    const struct live_player_def def = {.source = source,
                                        .knobs = &knobs,
                                        .knobs_count = 1,
                                        .osc = {.listen = heard, .send = sent}};
    if (live_player_create(&def, stage, &player) != STAGE_OK)
        _exit(1);
    const uint64_t began_ns = midi_now_ns();
    for (uint64_t picture = 1;; picture++) {
        const double now_s = (double)(midi_now_ns() - began_ns) / 1e9;
        if (live_player_before(player, stage, now_s) != STAGE_OK ||
            stage_frame(stage, now_s, NULL) != STAGE_OK)
            _exit(1);
        const double left_s = (double)picture / FPS - (double)(midi_now_ns() - began_ns) / 1e9;
        if (left_s > 0)
            usleep((useconds_t)(1e6 * left_s));
        else
            picture += (uint64_t)(-left_s * FPS); /* pictures that were not made in time */
    }
}

/* ---- its beginning ---- */

/* A socket of this computer's own, at any port that is free. */
static int socket_make(int *port)
{
    struct sockaddr_in at = {.sin_family = AF_INET,
                             .sin_addr = {.s_addr = htonl(INADDR_LOOPBACK)}};
    socklen_t bytes = sizeof at;
    const int file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (file >= 0 && (bind(file, (struct sockaddr *)&at, sizeof at) != 0 ||
                      getsockname(file, (struct sockaddr *)&at, &bytes) != 0)) {
        close(file);
        return -1;
    }
    *port = ntohs(at.sin_port);
    return file;
}

static bool knobs_write(const char *path)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return bench_fail("%s: %s", path, out.why);
    fprintf(out.stream, "knobs 1\nknob control * %d " KNOB_CONTROL_NAME " 0 1\nend\n",
            CONTROLLER);
    return output_file_commit(&out) || bench_fail("%s: %s", path, out.why);
}

static size_t packet_next(int file, uint8_t bytes[OSC_PACKET_MAX])
{
    const ssize_t count = recv(file, bytes, OSC_PACKET_MAX, 0);
    return count > 0 ? (size_t)count : 0;
}

bool soak_stage_begin(struct soak_stage *s, const struct midi_scene *scene)
{
    struct sockaddr_in to = {.sin_family = AF_INET,
                             .sin_addr = {.s_addr = htonl(INADDR_LOOPBACK)}};
    int port = 0, heard_port = 0, own_port = 0;
    uint8_t bytes[OSC_PACKET_MAX];
    *s = (struct soak_stage){.asks = -1, .hears = -1, .wanted = -1, .told = NAN};
    snprintf(s->knobs, sizeof s->knobs, "%s/soak.knobs", scene->folder);
    s->hears = socket_make(&heard_port);
    s->asks = socket_make(&own_port);
    const int free_port = socket_make(&port); /* one that is free just now */
    if (free_port < 0 || s->hears < 0 || s->asks < 0)
        return bench_fail("no socket for OSC: %s", strerror(errno));
    close(free_port);
    to.sin_port = htons((uint16_t)port);
    if (connect(s->asks, (struct sockaddr *)&to, sizeof to) != 0)
        return bench_fail("no socket for OSC: %s", strerror(errno));
    if (!knobs_write(s->knobs))
        return false;
    s->process = fork();
    if (s->process == 0)
        stage_play(scene, s->knobs, port, heard_port);
    if (s->process < 0)
        return bench_fail("no process: %s", strerror(errno));
    struct pollfd p = {s->hears, POLLIN, 0}; /* it tells all controls when it is there */
    if (poll(&p, 1, SETTLE_MS) != 1)
        return bench_fail("the stage did not start");
    while (packet_next(s->hears, bytes))
        ;
    return true;
}

/* ---- what is asked, and told ---- */

/* The value of the question of that number: not the one before it. */
static float value_of(uint64_t number)
{
    return (float)(number % VALUES) / 1000;
}

static void answer_take(void *context, const struct osc_message *m)
{
    struct soak_stage *s = context;
    if (strcmp(m->address, SET_CONTROL) != 0 || m->count != 1 ||
        (float)m->arguments[0].number != value_of(s->answered))
        s->wrong++;
    s->answered++;
}

static void told_take(void *context, const struct osc_message *m)
{
    struct soak_stage *s = context;
    if (strcmp(m->address, "/control/" KNOB_CONTROL_NAME) == 0 && m->count == 1) {
        s->told = m->arguments[0].number;
        s->moved++;
    }
}

static void packets_take(struct soak_stage *s)
{
    uint8_t bytes[OSC_PACKET_MAX];
    for (size_t count; (count = packet_next(s->asks, bytes)) > 0;)
        s->wrong += osc_packet_read(bytes, count, answer_take, s) != NULL;
    for (size_t count; (count = packet_next(s->hears, bytes)) > 0;)
        s->wrong += osc_packet_read(bytes, count, told_take, s) != NULL;
}

void soak_stage_ask(struct soak_stage *s)
{
    uint8_t bytes[OSC_PACKET_MAX];
    packets_take(s);
    if (s->asked - s->answered > WAITING_MAX)
        return; /* more than a socket is sure to hold; settling tells whether they come */
    size_t count =
        osc_message_write(bytes, sizeof bytes, SET_CONTROL, "f", (double)value_of(s->asked));
    bool sent = send(s->asks, bytes, count, MSG_NOSIGNAL) == (ssize_t)count;
    count = osc_message_write(bytes, sizeof bytes, SET_CONTROL, "");
    sent = sent && send(s->asks, bytes, count, MSG_NOSIGNAL) == (ssize_t)count;
    s->asked += sent;
}

void soak_stage_played(struct soak_stage *s, const struct midi_message *m)
{
    if ((m->bytes[0] & 0xf0) == MIDI_CONTROL && m->bytes[1] == CONTROLLER)
        s->wanted = m->bytes[2];
}

static bool settled(const struct soak_stage *s)
{
    const double wanted = KNOB_LEAST + (KNOB_MOST - KNOB_LEAST) * s->wanted / 127;
    return s->answered == s->asked && (s->wanted < 0 || fabs(s->told - wanted) < 1e-6);
}

void soak_stage_settle(struct soak_stage *s)
{
    const uint64_t until_ns = midi_now_ns() + SETTLE_MS * UINT64_C(1000000);
    packets_take(s);
    while (!settled(s) && midi_now_ns() < until_ns) {
        poll(NULL, 0, 2);
        packets_take(s);
    }
    if (settled(s))
        return;
    s->wrong += s->asked - s->answered + (s->answered == s->asked);
    s->answered = s->asked;
}

void soak_stage_end(struct soak_stage *s)
{
    if (s->process > 0) {
        kill(s->process, SIGKILL);
        waitpid(s->process, NULL, 0);
        close(s->asks);
        close(s->hears);
    }
    if (*s->knobs)
        unlink(s->knobs);
    *s = (struct soak_stage){.asks = -1, .hears = -1};
}
