/* midi_client.c - see midi_client.h. What was received stays bytes until it is asked for, frame
 * by frame; while a command waits for its reply, other frames become events in a queue. */
#include "midi_client.h"
#include "midi_connect.h"
#include "midi_events.h"
#include "midi_proof.h"
#include "midi_wire.h"

#include <midi_internal.h>
#include <midi_notes.h>
#include <midi_time.h>

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum {
    LISTENS_MAX = MIDI_WIRE_DEVICES,
    NAME_MAX_BYTES = 64,
    FILTERS_MAX_BYTES = 512,
    REPLY_WAIT_MS = 5000,
    RETRY_MS = 200
};

struct listen_to {
    char device[NAME_MAX_BYTES], filters[FILTERS_MAX_BYTES];
};

struct midi_client {
    char name[NAME_MAX_BYTES], address[256], token[128];
    bool usual, stays;
    int file; /* -1: gone */
    int port; /* TCP; 0: a socket whose owner was checked */
    uint64_t retry_ns;
    uint8_t in[MIDI_WIRE_HEAD + MIDI_WIRE_REPLY_MAX + 16384];
    size_t in_at, in_count; /* from in_at on they have not become events yet */
    struct midi_events events;
    struct listen_to listens[LISTENS_MAX];
    int listens_count;
    char devices[MIDI_WIRE_DEVICES][NAME_MAX_BYTES]; /* "": none */
    struct midi_notes heard[MIDI_WIRE_DEVICES];
    /* the command whose reply is awaited */
    uint32_t command, sent;
    bool welcome, replied, refused;
    /* while it connects over TCP: what the server asked, and must show */
    bool challenged, shown;
    char challenge[MIDI_PROOF_DIGITS + 1];
    struct midi_proof proof;
    char *reply;
    size_t reply_room;
    char farewell[160]; /* the server's last message */
    char why[160];      /* the connection ended before the welcome, ... */
    bool strange;       /* ... for who answered is no server */
};

struct midi_client_def midi_client_def_default(const char *name)
{
    return (struct midi_client_def){.name = name, .stays = true};
}

/* ---- events ---- */

struct released {
    struct midi_client *client;
    int device;
};

static void release_take(void *context, const struct midi_message *m)
{
    const struct released *r = context;
    struct midi_client_event *e = midi_events_add(&r->client->events);
    if (!e)
        return;
    e->kind = MIDI_CLIENT_MESSAGE;
    e->device = r->device;
    e->message = *m;
}

static void gone(struct midi_client *c, const char *why)
{
    if (c->file < 0)
        return;
    close(c->file);
    c->file = -1;
    c->in_at = c->in_count = 0;
    if (!c->welcome) { /* connect_to() tells it */
        snprintf(c->why, sizeof c->why, "%s", why);
        return;
    }
    c->retry_ns = midi_now_ns() + RETRY_MS * UINT64_C(1000000);
    for (int i = 0; i < MIDI_WIRE_DEVICES; i++) {
        struct released r = {c, i};
        midi_notes_release(&c->heard[i], midi_now_ns(), release_take, &r);
        c->devices[i][0] = '\0';
    }
    struct midi_client_event *e = midi_events_add(&c->events);
    if (!e)
        return;
    e->kind = MIDI_CLIENT_GONE;
    snprintf(e->text, sizeof e->text, "%s", why);
}

/* ---- what arrives ---- */

static void payload_text(const struct midi_wire_frame *f, char *text, size_t room)
{
    const size_t count = f->count < room ? f->count : room - 1;
    memcpy(text, f->payload, count);
    text[count] = '\0';
}

static void device_take(struct midi_client *c, const struct midi_wire_frame *f)
{
    struct midi_client_event *e = midi_events_add(&c->events);
    char text[160];
    payload_text(f, text, sizeof text);
    if (f->device < MIDI_WIRE_DEVICES)
        snprintf(c->devices[f->device], NAME_MAX_BYTES, "%.*s", (int)strcspn(text, " "), text);
    if (!e)
        return;
    e->kind = MIDI_CLIENT_DEVICE;
    e->device = f->device;
    memcpy(e->text, text, sizeof text);
}

static bool challenge_take(struct midi_client *c, const struct midi_wire_frame *f)
{
    if (!c->port || c->challenged || f->count != MIDI_PROOF_DIGITS)
        return false;
    payload_text(f, c->challenge, sizeof c->challenge);
    c->challenged = strlen(c->challenge) == MIDI_PROOF_DIGITS;
    return c->challenged;
}

/* Over TCP, who welcomes must know the token. */
static bool welcome_take(struct midi_client *c, const struct midi_wire_frame *f)
{
    char text[sizeof MIDI_PROOF_GREETING "\n" + MIDI_PROOF_DIGITS];
    static const char proved[] = MIDI_PROOF_GREETING "\n";
    payload_text(f, text, sizeof text);
    if (c->welcome || f->count != strlen(text))
        return false;
    if (!c->port)
        c->welcome = !strcmp(text, MIDI_WIRE_GREETING);
    else
        c->welcome = c->shown && !strncmp(text, proved, sizeof proved - 1) &&
                     midi_proof_right(&c->proof, c->token, "server", text + sizeof proved - 1);
    return c->welcome;
}

/* Handles a frame. False: it was malformed, or the server ends the connection. */
static bool frame_take(struct midi_client *c, const struct midi_wire_frame *f)
{
    struct midi_client_event *e;
    if (!c->welcome && f->kind != MIDI_WIRE_CHALLENGE && f->kind != MIDI_WIRE_WELCOME &&
        f->kind != MIDI_WIRE_ERROR)
        return false; /* nothing is believed before */
    switch (f->kind) {
    case MIDI_WIRE_MIDI:
        e = midi_events_add(&c->events);
        if (!e)
            return true;
        e->kind = MIDI_CLIENT_MESSAGE;
        e->device = f->device;
        if (f->device >= MIDI_WIRE_DEVICES || !midi_wire_message(f, &e->message)) {
            midi_events_drop(&c->events);
            return false;
        }
        midi_notes_take(&c->heard[f->device], &e->message);
        return true;
    case MIDI_WIRE_DEVICE:
        device_take(c, f);
        return true;
    case MIDI_WIRE_LOST:
        e = midi_events_add(&c->events);
        if (e) {
            e->kind = MIDI_CLIENT_LOST;
            e->lost = f->number;
        }
        return true;
    case MIDI_WIRE_CHALLENGE:
        return challenge_take(c, f);
    case MIDI_WIRE_WELCOME:
        return welcome_take(c, f);
    case MIDI_WIRE_REPLY:
    case MIDI_WIRE_ERROR:
        if (f->number != c->command && f->number)
            return true;
        c->refused = f->kind == MIDI_WIRE_ERROR;
        c->replied = true;
        if (c->reply_room)
            payload_text(f, c->reply, c->reply_room);
        else
            payload_text(f, c->farewell, sizeof c->farewell); /* and it closes */
        return true;
    default:
        return false;
    }
}

static const char *stranger(struct midi_client *c)
{
    c->strange = true;
    return c->port && !c->welcome
               ? "what answers there has not shown that it knows the token; it may be another "
                 "user's"
               : "what answers there is no MIDI server";
}

/* Takes the frames that have come: all of them, or as many as it takes until there is an event.
 * Calls gone() if they are malformed. */
static void frames_take(struct midi_client *c, bool all)
{
    struct midi_wire_frame f;
    while (all || !c->events.count) {
        const size_t used = midi_wire_read(c->in + c->in_at, c->in_count - c->in_at, &f);
        if (!used)
            break;
        c->in_at += used;
        if (!frame_take(c, &f)) {
            gone(c, stranger(c));
            return;
        }
    }
    if (c->in_at == c->in_count)
        c->in_at = c->in_count = 0;
}

/* Reads once, where no whole frame waits; flags: MSG_DONTWAIT, or 0 to wait. False: nothing
 * came, or a signal did. */
static bool input_take(struct midi_client *c, int flags)
{
    memmove(c->in, c->in + c->in_at, c->in_count - c->in_at);
    c->in_count -= c->in_at;
    c->in_at = 0;
    if (c->in_count == sizeof c->in) {
        gone(c, stranger(c));
        return true;
    }
    const ssize_t got = recv(c->file, c->in + c->in_count, sizeof c->in - c->in_count, flags);
    if (got < 0 && (errno == EAGAIN || errno == EINTR))
        return false;
    if (got <= 0) {
        gone(c, c->farewell[0] ? c->farewell : "the server is gone");
        return true;
    }
    c->in_count += (size_t)got;
    return true;
}

/* The server takes nothing any more; it may have said why. */
static void refused(struct midi_client *c, int error)
{
    frames_take(c, true);
    while (c->file >= 0 && input_take(c, MSG_DONTWAIT))
        frames_take(c, true);
    gone(c, c->farewell[0] ? c->farewell : strerror(error));
}

/* Waits until the socket is readable or writable, or the time is over. */
static bool wait_for(struct midi_client *c, short events, uint64_t until_ns)
{
    const uint64_t now_ns = midi_now_ns();
    struct pollfd p = {c->file, events, 0};
    if (until_ns != UINT64_MAX && now_ns >= until_ns)
        return poll(&p, 1, 0) > 0;
    struct timespec left = {(time_t)((until_ns - now_ns) / 1000000000),
                            (long)((until_ns - now_ns) % 1000000000)};
    return ppoll(&p, 1, until_ns == UINT64_MAX ? NULL : &left, NULL) > 0;
}

/* ---- what is sent ---- */

static enum midi_status gone_fail(const struct midi_client *c)
{
    return midi_fail(c->strange ? MIDI_REFUSED : MIDI_NO_SERVER, "%s",
                     c->why[0] ? c->why : "the server is gone");
}

static enum midi_status frame_send(struct midi_client *c, const struct midi_wire_frame *f)
{
    uint8_t bytes[MIDI_WIRE_HEAD + MIDI_WIRE_TEXT_MAX];
    const size_t count = MIDI_WIRE_HEAD + (size_t)f->count;
    midi_wire_head(f, bytes);
    memcpy(bytes + MIDI_WIRE_HEAD, f->payload, f->count);
    for (size_t at = 0; c->file >= 0 && at < count;) {
        const ssize_t sent = send(c->file, bytes + at, count - at, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent > 0)
            at += (size_t)sent;
        else if (errno == EAGAIN)
            wait_for(c, POLLOUT, midi_now_ns() + 100000000);
        else if (errno != EINTR)
            refused(c, errno);
    }
    return c->file >= 0 ? MIDI_OK : gone_fail(c);
}

static enum midi_status text_send(struct midi_client *c, uint8_t kind, const char *text)
{
    const size_t count = strlen(text);
    if (count > MIDI_WIRE_TEXT_MAX)
        return midi_fail(MIDI_BAD_ARGUMENT, "a command has at most %d bytes",
                         MIDI_WIRE_TEXT_MAX);
    c->replied = c->refused = false;
    c->command++;
    return frame_send(c, &(struct midi_wire_frame){.count = (uint16_t)count,
                                                   .kind = kind,
                                                   .device = MIDI_WIRE_NO_DEVICE,
                                                   .number = c->command,
                                                   .payload = (const uint8_t *)text});
}

/* Waits for a reply, until *done. A long turn is one in which this process was stopped, and the
 * server perhaps, too: it counts as a usual one. */
static enum midi_status reply_wait(struct midi_client *c, const bool *done, const char *text)
{
    const uint64_t turn_ns = 100000000;
    uint64_t left_ns = REPLY_WAIT_MS * UINT64_C(1000000);
    while (c->file >= 0 && !*done && !c->refused && left_ns) {
        const uint64_t began_ns = midi_now_ns();
        if (wait_for(c, POLLIN, began_ns + turn_ns) && input_take(c, MSG_DONTWAIT))
            frames_take(c, true);
        const uint64_t took_ns = midi_now_ns() - began_ns,
                       counts_ns = took_ns < turn_ns ? took_ns : turn_ns;
        left_ns -= counts_ns < left_ns ? counts_ns : left_ns;
    }
    if (c->refused)
        return midi_fail(MIDI_REFUSED, "%.300s",
                         text[0] ? text : "the server refuses, and does not say why");
    if (*done)
        return MIDI_OK;
    if (c->file >= 0)
        return midi_fail(MIDI_NO_SERVER, "the server does not answer");
    return gone_fail(c);
}

static enum midi_status command(struct midi_client *c, const char *text, char *reply,
                                size_t room)
{
    char usual[400];
    frames_take(c, true); /* what came before is no reply */
    c->reply = reply ? reply : usual;
    c->reply_room = reply ? room : sizeof usual;
    c->reply[0] = '\0';
    enum midi_status status = text_send(c, MIDI_WIRE_COMMAND, text);
    if (status == MIDI_OK)
        status = reply_wait(c, &c->replied, c->reply);
    c->reply_room = 0;
    return status;
}

enum midi_status midi_client_command(struct midi_client *c, const char *text, char *reply,
                                     size_t room)
{
    if (c->file < 0)
        return midi_fail(MIDI_NO_SERVER, "the server is gone");
    return command(c, text, reply, room);
}

static enum midi_status listen_say(struct midi_client *c, const struct listen_to *l)
{
    char text[NAME_MAX_BYTES + FILTERS_MAX_BYTES + 16];
    snprintf(text, sizeof text, "listen %s %s", l->device, l->filters);
    return command(c, text, NULL, 0);
}

/* ---- connecting ---- */

/* Says hello; over TCP, shows that the token is known, and asks the server to. *why: room for
 * its refusal. */
static enum midi_status greet(struct midi_client *c, const char *why)
{
    char hello[400], nonce[MIDI_PROOF_DIGITS + 1], code[MIDI_PROOF_DIGITS + 1];
    enum midi_status status;
    if (!c->port) {
        snprintf(hello, sizeof hello, "%s\n%s\n", MIDI_WIRE_GREETING, c->name);
        status = text_send(c, MIDI_WIRE_HELLO, hello);
        return status == MIDI_OK || c->refused ? reply_wait(c, &c->welcome, why) : status;
    }
    if (!c->token[0])
        return midi_fail(MIDI_REFUSED,
                         "%s: over TCP a server wants its token "
                         "(LUTETIA_MIDI_TOKEN)",
                         c->address);
    if (!midi_proof_nonce(nonce))
        return midi_fail(MIDI_IO_FAILED, "no random numbers: %s", strerror(errno));
    snprintf(hello, sizeof hello, "%s\n%s\n%s", MIDI_PROOF_GREETING, c->name, nonce);
    status = text_send(c, MIDI_WIRE_HELLO, hello);
    if (status == MIDI_OK || c->refused)
        status = reply_wait(c, &c->challenged, why);
    if (status != MIDI_OK)
        return status;
    midi_proof_begin(&c->proof, c->port, hello, c->challenge);
    midi_proof_code(&c->proof, c->token, "client", code);
    c->shown = true;
    status = text_send(c, MIDI_WIRE_PROOF, code);
    return status == MIDI_OK || c->refused ? reply_wait(c, &c->welcome, why) : status;
}

static enum midi_status connect_to(struct midi_client *c)
{
    char why[200] = "";
    enum midi_status status = midi_connect(c->usual ? NULL : c->address, &c->file, &c->port);
    if (status != MIDI_OK)
        return status;
    c->in_at = c->in_count = 0;
    c->farewell[0] = c->why[0] = '\0';
    c->welcome = c->challenged = c->shown = c->strange = false;
    c->reply = why;
    c->reply_room = sizeof why;
    status = greet(c, why);
    c->reply_room = 0;
    for (int i = 0; status == MIDI_OK && i < c->listens_count; i++)
        status = listen_say(c, &c->listens[i]);
    if (status == MIDI_OK) /* the reply comes after the list of all devices */
        status = command(c, "devices", NULL, 0);
    if (status != MIDI_OK && c->file >= 0) {
        close(c->file);
        c->file = -1;
    }
    return status;
}

enum midi_status midi_client_open(const struct midi_client_def *def, struct midi_client **out)
{
    struct midi_client *c = calloc(1, sizeof *c);
    *out = NULL;
    if (!c)
        return midi_fail(MIDI_NO_MEMORY, "no memory for a MIDI client");
    snprintf(c->name, sizeof c->name, "%s", def->name ? def->name : "unnamed");
    for (char *l = c->name; *l; l++)
        *l = *l == '\n' ? ' ' : *l;
    snprintf(c->address, sizeof c->address, "%s", def->address ? def->address : "");
    snprintf(c->token, sizeof c->token, "%s", def->token ? def->token : "");
    c->usual = !def->address;
    c->stays = def->stays;
    c->file = -1;
    enum midi_status status = connect_to(c);
    if (status != MIDI_OK) {
        midi_client_close(c);
        return status;
    }
    *out = c;
    return MIDI_OK;
}

void midi_client_close(struct midi_client *c)
{
    if (!c)
        return;
    if (c->file >= 0)
        close(c->file);
    midi_events_finish(&c->events);
    free(c);
}

/* ---- use ---- */

enum midi_status midi_client_listen(struct midi_client *c, const char *device,
                                    const char *filters)
{
    struct listen_to l;
    filters = filters ? filters : "";
    if (strlen(device) >= sizeof l.device || strlen(filters) >= sizeof l.filters ||
        strpbrk(device, " \n"))
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "a device's name has no spaces and %d bytes at most, filters %d",
                         NAME_MAX_BYTES - 1, FILTERS_MAX_BYTES - 1);
    snprintf(l.device, sizeof l.device, "%s", device);
    snprintf(l.filters, sizeof l.filters, "%s", filters);
    enum midi_status status =
        c->file >= 0 ? listen_say(c, &l) : midi_fail(MIDI_NO_SERVER, "the server is gone");
    if (status != MIDI_OK)
        return status;
    int i = 0;
    while (i < c->listens_count && strcmp(c->listens[i].device, device) != 0)
        i++;
    if (i == LISTENS_MAX)
        return MIDI_OK; /* it listens now, but will not after a reconnection */
    c->listens[i] = l;
    c->listens_count = i == c->listens_count ? i + 1 : c->listens_count;
    return MIDI_OK;
}

int midi_client_device(const struct midi_client *c, const char *name)
{
    for (int i = 0; i < MIDI_WIRE_DEVICES; i++)
        if (name[0] && !strcmp(c->devices[i], name))
            return i;
    return -1;
}

const char *midi_client_device_name(const struct midi_client *c, int device)
{
    const bool known = device >= 0 && device < MIDI_WIRE_DEVICES && c->devices[device][0];
    return known ? c->devices[device] : NULL;
}

enum midi_status midi_client_send(struct midi_client *c, int device,
                                  const struct midi_message *m)
{
    if (device < 0 || device >= MIDI_WIRE_DEVICES || !midi_message_good(m))
        return midi_fail(MIDI_BAD_ARGUMENT, "there is no such device, or that is no message");
    if (c->file < 0)
        return midi_fail(MIDI_NO_SERVER, "the server is gone");
    return frame_send(
        c, &(struct midi_wire_frame){m->count, MIDI_WIRE_MIDI, (uint8_t)device, c->sent++,
                                     m->time_ns ? m->time_ns : midi_now_ns(), m->bytes});
}

int midi_client_descriptor(const struct midi_client *c)
{
    return c->file;
}

/* While the server is gone: waits until the next attempt, and tries to connect. */
static void try_again(struct midi_client *c, uint64_t until_ns)
{
    const uint64_t now_ns = midi_now_ns();
    const uint64_t wake_ns = c->retry_ns < until_ns ? c->retry_ns : until_ns;
    if (wake_ns > now_ns) {
        const struct timespec left = {(time_t)((wake_ns - now_ns) / 1000000000),
                                      (long)((wake_ns - now_ns) % 1000000000)};
        nanosleep(&left, NULL);
    }
    if (midi_now_ns() < c->retry_ns)
        return;
    c->retry_ns = midi_now_ns() + RETRY_MS * UINT64_C(1000000);
    if (connect_to(c) != MIDI_OK)
        return;
    struct midi_client_event *e = midi_events_add(&c->events);
    if (e)
        e->kind = MIDI_CLIENT_BACK;
}

enum midi_status midi_client_next(struct midi_client *c, int wait_ms,
                                  struct midi_client_event *event)
{
    const uint64_t until_ns =
        wait_ms < 0 ? UINT64_MAX : midi_now_ns() + (uint64_t)wait_ms * 1000000;
    for (bool last = false;;) {
        frames_take(c, false);
        if (midi_events_take(&c->events, event))
            return MIDI_OK;
        if (last)
            return MIDI_OK; /* NOTHING: set by midi_events_take() */
        if (c->file < 0 && !c->stays)
            return midi_fail(MIDI_NO_SERVER, "the server is gone");
        last = midi_now_ns() >= until_ns;
        if (c->file < 0)
            try_again(c, until_ns);
        else if (until_ns == UINT64_MAX) /* waits in the read itself: a system call less */
            last = !input_take(c, 0) && errno == EINTR; /* a signal: return to the caller */
        else if (wait_for(c, POLLIN, until_ns))
            (void)input_take(c, MSG_DONTWAIT);
    }
}
