/* midi_server.c - see midi_server.h: connects devices, clients and sockets. */
#include "midi_server.h"
#include "device_kinds.h"
#include "latency.h"
#include "server_commands.h"
#include "server_route.h"
#include "server_socket.h"

#include <midi_internal.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

enum { HOUSEKEEPING_MS = 500 };

/* ---- devices ---- */

static void device_announce(const struct midi_server *s, struct server_client *c, int device)
{
    char text[160];
    (void)s;
    command_device_text(s->devices[device], text);
    (void)client_put_text(c, MIDI_WIRE_DEVICE, device, 0, text);
}

static void device_changed(struct server_device *d)
{
    struct midi_server *s = d->owner;
    log_tell(&s->lines, d->up ? "device %s is there" : "device %s is away: %s", d->name,
             d->why);
    if (!d->up)
        route_device_away(s, d->number);
    for (struct server_client *c = s->clients; c; c = c->next)
        if (c->greeted && !c->dead) {
            device_announce(s, c, d->number);
            client_flush(c);
        }
}

static void device_loses(struct server_device *d, uint32_t in, uint32_t out)
{
    struct midi_server *s = d->owner;
    if (in)
        log_tell(&s->lines, "device %s: %u messages that came are lost; notes are ended",
                 d->name, in);
    if (out)
        log_tell(&s->lines, "device %s: %u messages are longer than it takes, and lost",
                 d->name, out);
    if (in)
        route_device_lost(s, d->number, in);
}

static enum midi_status device_add(struct midi_server *s, const char *spec)
{
    struct server_device *d;
    if (s->devices_count == MIDI_WIRE_DEVICES)
        return midi_fail(MIDI_BAD_ARGUMENT, "a server has at most %d devices",
                         MIDI_WIRE_DEVICES);
    enum midi_status status = device_create(device_kinds, spec, &s->loop, &d);
    if (status != MIDI_OK)
        return status;
    const size_t length = strlen(d->name);
    for (int i = 0, count = 2; i < s->devices_count; i++)
        if (!strcmp(s->devices[i]->name, d->name)) { /* make the name unique: serial, serial2 */
            snprintf(d->name + length, sizeof d->name - length, "%d", count++);
            i = -1;
        }
    d->number = s->devices_count;
    d->owner = s;
    d->received = route_received;
    d->read = route_read;
    d->changed = device_changed;
    d->lost = device_loses;
    d->drained = route_drained;
    s->devices[s->devices_count++] = d;
    return device_start(d);
}

/* ---- clients ---- */

/* Who has come by TCP and has not shown the token is a stranger: another user, perhaps. */
static bool is_stranger(const struct server_client *c)
{
    return c->tcp && !c->greeted;
}

/* Strangers, or all others. */
static int clients_count(const struct midi_server *s, bool strangers)
{
    int count = 0;
    for (const struct server_client *c = s->clients; c; c = c->next)
        count += !c->dead && is_stranger(c) == strangers;
    return count;
}

/* Strangers have few places, and none of the owner's. The one that has waited longest leaves:
 * who knows the token says so at once. */
static void strangers_bound(struct midi_server *s)
{
    enum { STRANGERS_MAX = 8 };
    struct server_client *oldest = NULL;
    for (struct server_client *c = s->clients; c; c = c->next)
        if (!c->dead && is_stranger(c))
            oldest = c; /* new ones come first in the list */
    if (clients_count(s, true) > STRANGERS_MAX)
        client_end(oldest, "there are others who wait");
}

static enum client_verdict ends(struct server_client *c, const char *why)
{
    client_end(c, why);
    return CLIENT_ENDS;
}

static enum client_verdict welcome(struct midi_server *s, struct server_client *c)
{
    char text[sizeof MIDI_PROOF_GREETING "\n" + MIDI_PROOF_DIGITS] = MIDI_WIRE_GREETING;
    if (c->tcp && clients_count(s, false) >= SERVER_CLIENTS_MAX)
        return ends(c, "the server has as many clients as it can");
    if (c->tcp) {
        static const char proved[] = MIDI_PROOF_GREETING "\n";
        memcpy(text, proved, sizeof proved);
        midi_proof_code(&c->proof, s->token, "server", text + sizeof proved - 1);
    }
    c->greeted = true;
    (void)client_put_text(c, MIDI_WIRE_WELCOME, MIDI_WIRE_NO_DEVICE, 0, text);
    for (int i = 0; i < s->devices_count; i++)
        device_announce(s, c, i);
    client_flush(c);
    return CLIENT_GOES_ON;
}

/* Over TCP: the hello has a nonce, and is answered by another one. */
static enum client_verdict challenge(struct midi_server *s, struct server_client *c,
                                     const char *hello, const char *nonce)
{
    char ours[MIDI_PROOF_DIGITS + 1];
    if (!nonce || strlen(nonce) != MIDI_PROOF_DIGITS)
        return ends(c, "the greeting must be: " MIDI_PROOF_GREETING
                       ", a line with a name, a line with 64 digits by chance");
    if (!midi_proof_nonce(ours))
        return ends(c, "the server has no random numbers");
    midi_proof_begin(&c->proof, s->tcp_port, hello, ours);
    c->challenged = true;
    (void)client_put_text(c, MIDI_WIRE_CHALLENGE, MIDI_WIRE_NO_DEVICE, 0, ours);
    client_flush(c);
    return CLIENT_GOES_ON;
}

static enum client_verdict greet(struct midi_server *s, struct server_client *c,
                                 const char *hello)
{
    char text[MIDI_WIRE_TEXT_MAX + 1];
    snprintf(text, sizeof text, "%s", hello);
    char *rest = text;
    const char *greeting = strsep(&rest, "\n"), *name = strsep(&rest, "\n");
    if (c->tcp && !strcmp(greeting, MIDI_WIRE_GREETING))
        return ends(c, "this client is too old: over TCP the server does not take a token any "
                       "more, but asks "
                       "for a proof that it is known (" MIDI_PROOF_GREETING ")");
    if (strcmp(greeting, c->tcp ? MIDI_PROOF_GREETING : MIDI_WIRE_GREETING) != 0 || !name)
        return ends(c, c->tcp ? "the greeting must be: " MIDI_PROOF_GREETING
                                ", a line with a name, a line with 64 digits by chance"
                              : "the greeting must be: " MIDI_WIRE_GREETING
                                ", a line with a name");
    for (size_t i = 0; name[i] && i + 1 < sizeof c->name; i++) /* for terminals */
        c->name[i] = (char)((unsigned char)name[i] < 0x20 || name[i] == 0x7f ? '?' : name[i]);
    return c->tcp ? challenge(s, c, hello, rest) : welcome(s, c);
}

static enum client_verdict prove(struct midi_server *s, struct server_client *c,
                                 const char *code)
{
    if (!midi_proof_right(&c->proof, s->token, "client", code))
        return ends(c, "the token is not right");
    return welcome(s, c);
}

static enum client_verdict frame_take(struct server_client *c, const struct midi_wire_frame *f)
{
    struct midi_server *s = c->owner;
    char text[MIDI_WIRE_TEXT_MAX + 1];
    const bool greets = f->kind == MIDI_WIRE_HELLO || f->kind == MIDI_WIRE_PROOF;
    if (c->greeted == greets || (greets && c->challenged != (f->kind == MIDI_WIRE_PROOF)))
        return ends(c, !greets                       ? "a greeting must come first"
                       : c->greeted || c->challenged ? "a second greeting"
                                                     : "a greeting must come first");
    if (f->kind == MIDI_WIRE_MIDI)
        return route_message(s, c, f);
    memcpy(text, f->payload, f->count);
    text[f->count] = '\0';
    if (f->kind == MIDI_WIRE_HELLO)
        return greet(s, c, text);
    if (f->kind == MIDI_WIRE_PROOF)
        return prove(s, c, text);
    command_do(s, c, f->number, text);
    return CLIENT_GOES_ON;
}

static void clients_sweep(struct midi_server *s)
{
    for (struct server_client **at = &s->clients; *at;) {
        struct server_client *c = *at;
        if (!c->dead) {
            at = &c->next;
            continue;
        }
        *at = c->next;
        s->clients_count--;
        client_destroy(c);
    }
}

static void client_ended(struct server_client *c)
{
    struct midi_server *s = c->owner;
    route_client_away(s, c);
    loop_timer(&s->loop, &s->second, midi_now_ns()); /* destroyed when it is no longer in use */
}

static void accept_ready(struct server_watch *w, uint32_t events)
{
    struct midi_server *s = w->owner;
    const bool tcp = w == &s->tcp_watch;
    bool ours;
    (void)events;
    const int file = socket_accept(w->file, tcp, &ours);
    if (file < 0)
        return;
    struct server_client *c = client_create(&s->loop, file, tcp);
    if (!c)
        return;
    c->owner = s;
    c->frame = frame_take;
    c->ended = client_ended;
    c->latency = &s->latency;
    c->number = ++s->clients_seen;
    c->next = s->clients;
    s->clients = c;
    s->clients_count++;
    if (!ours)
        client_end(c, "this server is another user's");
    else if (clients_count(s, false) > SERVER_CLIENTS_MAX)
        client_end(c, "the server has as many clients as it can");
    else if (!client_begin(c))
        client_end(c, "no memory");
    strangers_bound(s);
}

/* ---- now and then ---- */

static void rates_take(struct midi_server *s, uint64_t now_ns)
{
    const double seconds = (double)(now_ns - s->rates_ns) / 1e9;
    if (seconds < HOUSEKEEPING_MS / 1e3)
        return;
    s->rates_ns = now_ns;
    for (int i = 0; i < s->devices_count; i++) {
        const struct device_counts *n = &s->devices[i]->counts;
        s->in_hz[i] = (double)(n->in - s->in_before[i]) / seconds;
        s->out_hz[i] = (double)(n->out - s->out_before[i]) / seconds;
        s->in_before[i] = n->in;
        s->out_before[i] = n->out;
    }
}

static void second_fire(struct server_timer *t, uint64_t now_ns)
{
    struct midi_server *s = t->owner;
    for (struct server_client *c = s->clients; c; c = c->next) {
        const bool was_dead = c->dead;
        client_look(c, now_ns);
        if (c->dead && !was_dead) {
            s->dropped++;
            if (!is_stranger(c)) /* who may write no line */
                log_tell(&s->lines, "client %u %s is dropped: it does nothing", c->number,
                         c->name);
        }
        if (!c->dead && c->waits_for >= 0) /* a system exclusive that is never ended */
            route_drained(s->devices[c->waits_for]);
    }
    for (int i = 0; i < s->devices_count; i++)
        device_look(s->devices[i]);
    clients_sweep(s);
    rates_take(s, now_ns);
    awake_look(&s->awake, s->messages, now_ns);
    workers_look(s->workers, s->messages, now_ns);
    loop_timer(&s->loop, t, now_ns + HOUSEKEEPING_MS * UINT64_C(1000000));
}

static void stop_ready(struct server_watch *w, uint32_t events)
{
    struct midi_server *s = w->owner;
    (void)events;
    s->loop.stops = true;
}

/* ---- the server ---- */

static void real_time_begin(struct midi_server *s, bool wanted)
{
    if (wanted)
        midi_real_time_begin(s->real_time);
    else
        snprintf(s->real_time, sizeof s->real_time, "usual priority");
    log_tell(&s->lines, "%s", s->real_time);
}

static void awake_set(struct midi_server *s, bool wanted)
{
    if (!awake_begin(&s->awake, wanted ? LATENCY_PATH : NULL))
        snprintf(s->sleep, sizeof s->sleep, "processors may sleep: " LATENCY_PATH ": %s",
                 strerror(errno));
    else
        snprintf(s->sleep, sizeof s->sleep, "%s",
                 wanted ? "processors are kept awake while messages come"
                        : "processors may sleep");
    log_tell(&s->lines, "%s", s->sleep);
}

static void workers_set(struct midi_server *s, bool wanted)
{
    const char *why;
    if (!wanted)
        return;
    s->workers = workers_create("/proc", &why);
    if (s->workers)
        snprintf(s->terminals, sizeof s->terminals,
                 ", terminals' bytes go before other programs while messages come");
    else
        snprintf(s->terminals, sizeof s->terminals,
                 ", terminals' bytes have the usual priority: %s", why);
    log_tell(&s->lines, "%s", s->terminals + strlen(", "));
}

static enum midi_status listen_begin(struct midi_server *s, const struct midi_server_def *def)
{
    const char *why;
    if (def->tcp_port && (!def->token || !def->token[0]))
        return midi_fail(MIDI_BAD_ARGUMENT, "a TCP port needs a token");
    if (def->token && strlen(def->token) >= sizeof s->token)
        return midi_fail(MIDI_BAD_ARGUMENT, "a token has at most %zu bytes",
                         sizeof s->token - 1);
    snprintf(s->token, sizeof s->token, "%s", def->token ? def->token : "");
    s->tcp_port = def->tcp_port;
    if (!def->path) {
        if (!midi_wire_usual_path(s->path, &why))
            return midi_fail(MIDI_REFUSED, "%s: %s", s->path, why);
    } else if (strlen(def->path) >= sizeof s->path) {
        return midi_fail(MIDI_BAD_ARGUMENT, "%s: a socket's path has at most %zu bytes",
                         def->path, sizeof s->path - 1);
    } else {
        snprintf(s->path, sizeof s->path, "%s", def->path);
    }
    enum midi_status status = socket_listen_unix(s->path, &s->unix_watch.file, &s->lock);
    if (status == MIDI_OK && def->tcp_port)
        status = socket_listen_tcp(def->tcp_port, &s->tcp_watch.file);
    if (status == MIDI_OK && (!loop_watch(&s->loop, &s->unix_watch, EPOLLIN) ||
                              (def->tcp_port && !loop_watch(&s->loop, &s->tcp_watch, EPOLLIN))))
        status = midi_fail(MIDI_IO_FAILED, "cannot wait for clients: %s", strerror(errno));
    return status;
}

enum midi_status midi_server_create(const struct midi_server_def *def, struct midi_server **out)
{
    struct midi_server *s = calloc(1, sizeof *s);
    *out = NULL;
    if (!s)
        return midi_fail(MIDI_NO_MEMORY, "no memory for a MIDI server");
    log_begin(&s->lines, def->log, def->context);
    s->began_ns = s->rates_ns = midi_now_ns();
    s->lock = s->awake.file = -1;
    s->unix_watch = (struct server_watch){-1, accept_ready, s};
    s->tcp_watch = (struct server_watch){-1, accept_ready, s};
    s->stop_watch =
        (struct server_watch){eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK), stop_ready, s};
    s->thinned = (struct server_timer){.due_ns = UINT64_MAX, .fire = route_thinned, .owner = s};
    s->second = (struct server_timer){.due_ns = UINT64_MAX, .fire = second_fire, .owner = s};
    enum midi_status status = MIDI_OK;
    if (!loop_create(&s->loop) || s->stop_watch.file < 0 ||
        !loop_watch(&s->loop, &s->stop_watch, EPOLLIN))
        status = midi_fail(MIDI_IO_FAILED, "no descriptors for a server: %s", strerror(errno));
    if (status == MIDI_OK)
        status = listen_begin(s, def);
    loop_timer(&s->loop, &s->second, midi_now_ns() + HOUSEKEEPING_MS * UINT64_C(1000000));
    for (int i = 0; status == MIDI_OK && i < def->devices_count; i++)
        status = device_add(s, def->devices[i]);
    if (status != MIDI_OK) {
        midi_server_destroy(s);
        return status;
    }
    enum { TOKEN_BYTES_GOOD = 16 };
    if (def->tcp_port && strlen(s->token) < TOKEN_BYTES_GOOD)
        log_tell(&s->lines,
                 "the token is short: who has the port can try tokens; take %d characters by "
                 "chance",
                 TOKEN_BYTES_GOOD);
    real_time_begin(s, def->real_time);
    awake_set(s, def->awake);
    workers_set(s, def->terminals_first);
    *out = s;
    return MIDI_OK;
}

void midi_server_run(struct midi_server *s)
{
    loop_run(&s->loop);
}

void midi_server_stop(struct midi_server *s)
{
    const uint64_t one = 1;
    ssize_t written = write(s->stop_watch.file, &one, sizeof one);
    (void)written;
}

void midi_server_destroy(struct midi_server *s)
{
    if (!s)
        return;
    log_begin(&s->lines, NULL, NULL);
    for (int i = 0; i < s->devices_count; i++)
        if (s->devices[i]->up)
            route_device_away(s, i);
    for (struct server_client *c = s->clients; c; c = c->next)
        client_end(c, "the server stops");
    for (int i = 0; i < s->devices_count; i++)
        device_destroy(s->devices[i]);
    s->devices_count = 0;
    clients_sweep(s);
    awake_end(&s->awake);
    workers_destroy(s->workers);
    socket_leave(s->path, s->unix_watch.file, s->lock);
    if (s->tcp_watch.file >= 0)
        close(s->tcp_watch.file);
    if (s->stop_watch.file >= 0)
        close(s->stop_watch.file);
    loop_finish(&s->loop);
    free(s);
}

const char *midi_server_path(const struct midi_server *s)
{
    return s->path;
}

const char *midi_server_kind(int i, const char **argument, const char **help)
{
    if (!device_kinds[i])
        return NULL;
    *argument = device_kinds[i]->argument ? device_kinds[i]->argument : "";
    *help = device_kinds[i]->help;
    return device_kinds[i]->name;
}
