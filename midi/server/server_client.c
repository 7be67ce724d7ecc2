/* server_client.c - see server_client.h. */
#include "server_client.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

enum { ROOM_KEPT = 2048 /* room reserved for reports and the ends of notes */ };

static void client_ready(struct server_watch *w, uint32_t events);

struct server_client *client_create(struct server_loop *loop, int file, bool tcp)
{
    struct server_client *c = calloc(1, sizeof *c);
    if (!c) {
        close(file);
        return NULL;
    }
    c->watch = (struct server_watch){file, client_ready, c};
    c->loop = loop;
    c->tcp = tcp;
    c->waits_for = -1;
    c->came_ns = c->progress_ns = midi_now_ns();
    return c;
}

bool client_begin(struct server_client *c)
{
    c->watched = EPOLLIN;
    return loop_watch(c->loop, &c->watch, EPOLLIN);
}

void client_destroy(struct server_client *c)
{
    loop_unwatch(c->loop, &c->watch);
    close(c->watch.file);
    for (int i = 0; i < MIDI_WIRE_DEVICES; i++) {
        midi_chain_destroy(c->hears[i]);
        midi_chain_destroy(c->sends[i]);
    }
    free(c);
}

static void watched_set(struct server_client *c)
{
    const uint32_t wanted =
        (c->waits_for < 0 ? EPOLLIN : 0u) | (c->out_count ? (uint32_t)EPOLLOUT : 0u);
    if (wanted != c->watched && !c->dead)
        loop_change(c->loop, &c->watch, wanted);
    c->watched = wanted;
}

static void die(struct server_client *c)
{
    if (c->dead)
        return;
    c->dead = true;
    loop_unwatch(c->loop, &c->watch);
    c->ended(c);
}

void client_end(struct server_client *c, const char *why)
{
    if (c->dead)
        return;
    (void)client_put_text(c, MIDI_WIRE_ERROR, MIDI_WIRE_NO_DEVICE, 0, why);
    client_flush(c);
    die(c);
}

/* ---- out ---- */

static void ring_put(struct server_client *c, const uint8_t *bytes, size_t count)
{
    const size_t at = (c->out_first + c->out_count) % CLIENT_OUT_BYTES;
    const size_t to_end = CLIENT_OUT_BYTES - at;
    memcpy(c->out + at, bytes, count < to_end ? count : to_end);
    if (count > to_end)
        memcpy(c->out, bytes + to_end, count - to_end);
    c->out_count += count;
}

bool client_put(struct server_client *c, const struct midi_wire_frame *f)
{
    uint8_t head[MIDI_WIRE_HEAD];
    if (c->dead || c->out_count + MIDI_WIRE_HEAD + f->count > CLIENT_OUT_BYTES)
        return false;
    midi_wire_head(f, head);
    ring_put(c, head, sizeof head);
    ring_put(c, f->payload, f->count);
    return true;
}

bool client_put_text(struct server_client *c, uint8_t kind, int device, uint32_t number,
                     const char *text)
{
    const size_t count = strlen(text);
    return client_put(
        c, &(struct midi_wire_frame){
               .count = (uint16_t)(count < MIDI_WIRE_REPLY_MAX ? count : MIDI_WIRE_REPLY_MAX),
               .kind = kind,
               .device = (uint8_t)device,
               .number = number,
               .time_ns = midi_now_ns(),
               .payload = (const uint8_t *)text});
}

/* Whether a message may be dropped: a later one replaces it, or it is not missed. */
static bool spare(const struct midi_message *m)
{
    const uint8_t status = m->bytes[0] & 0xf0;
    if (midi_message_channel(m) < 0)
        return m->bytes[0] == MIDI_CLOCK || m->bytes[0] == MIDI_SENSING;
    return status == MIDI_POLY_PRESSURE || status == MIDI_PRESSURE || status == MIDI_BEND ||
           (status == MIDI_CONTROL && m->bytes[1] >= 1 && m->bytes[1] < 32);
}

static bool message_frame(struct server_client *c, int device, const struct midi_message *m)
{
    const struct midi_wire_frame f = {m->count,    MIDI_WIRE_MIDI, (uint8_t)device,
                                      c->messages, m->time_ns,     m->bytes};
    if (!client_put(c, &f))
        return false;
    c->messages++;
    c->sent++;
    if (!c->batch++ || m->time_ns < c->batch_ns)
        c->batch_ns = m->time_ns;
    midi_notes_take(&c->heard[device], m);
    return true;
}

void client_put_message(struct server_client *c, int device, const struct midi_message *m)
{
    const uint32_t bit = UINT32_C(1) << device;
    const bool goes_on = midi_message_kind(m) == MIDI_KIND_SYSEX && m->bytes[0] != MIDI_SYSEX;
    if (c->dead)
        return;
    if (c->out_count > CLIENT_OUT_BYTES / 4 * 3 && spare(m)) {
        c->thinned++;
        return;
    }
    if ((goes_on && c->cut & bit) || c->lost_untold ||
        c->out_count + MIDI_WIRE_HEAD + m->count + ROOM_KEPT > CLIENT_OUT_BYTES) {
        c->lost++;
        c->lost_untold++;
        if (midi_message_open(m))
            c->cut |= bit;
        return;
    }
    if (midi_message_kind(m) != MIDI_KIND_REAL_TIME)
        c->cut &= ~bit;
    (void)message_frame(c, device, m);
}

struct releasing {
    struct server_client *client;
    int device;
};

static void release_take(void *context, const struct midi_message *m)
{
    const struct releasing *r = context;
    if (message_frame(r->client, r->device, m))
        return;
    /* No room for the end: the note or pedal stays down, and is ended when the loss is
     * reported. */
    struct midi_message down = *m;
    const bool note = (m->bytes[0] & 0xf0) == MIDI_NOTE_OFF;
    down.bytes[0] = (uint8_t)(note ? m->bytes[0] | 0x10 : m->bytes[0]);
    down.bytes[2] = 127;
    midi_notes_take(&r->client->heard[r->device], &down);
    r->client->lost_untold++;
}

void client_release(struct server_client *c, int device)
{
    struct releasing r = {c, device};
    midi_notes_release(&c->heard[device], midi_now_ns(), release_take, &r);
}

/* When there is room again: reports how many messages were lost, and ends notes whose ends
 * may be among them. */
static void losses_tell(struct server_client *c)
{
    if (!c->lost_untold || c->out_count > CLIENT_OUT_BYTES / 2)
        return;
    const struct midi_wire_frame f = {.kind = MIDI_WIRE_LOST,
                                      .device = MIDI_WIRE_NO_DEVICE,
                                      .number = c->lost_untold,
                                      .time_ns = midi_now_ns(),
                                      .payload = c->in};
    if (!client_put(c, &f))
        return;
    c->lost_untold = 0;
    for (int i = 0; i < MIDI_WIRE_DEVICES; i++)
        client_release(c, i);
}

void client_lose(struct server_client *c, uint32_t count)
{
    c->lost += count;
    c->lost_untold += count;
    client_flush(c);
}

static bool written(struct server_client *c)
{
    const size_t to_end = CLIENT_OUT_BYTES - c->out_first;
    const size_t count = c->out_count < to_end ? c->out_count : to_end;
    const ssize_t sent =
        send(c->watch.file, c->out + c->out_first, count, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0) {
        if (errno != EAGAIN && errno != EINTR)
            die(c);
        return false;
    }
    c->out_first = (c->out_first + (size_t)sent) % CLIENT_OUT_BYTES;
    c->out_count -= (size_t)sent;
    c->progress_ns = midi_now_ns();
    return (size_t)sent == count;
}

void client_flush(struct server_client *c)
{
    while (!c->dead && c->out_count && written(c))
        ;
    if (c->dead)
        return;
    if (!c->out_count && c->batch && c->latency) {
        const uint64_t took_ns = c->progress_ns - c->batch_ns;
        for (uint32_t i = 0; i < c->batch && c->progress_ns >= c->batch_ns; i++)
            midi_histogram_add(c->latency, took_ns);
    }
    c->batch = 0;
    losses_tell(c);
    watched_set(c);
}

/* ---- in ---- */

static void frames_take(struct server_client *c)
{
    struct midi_wire_frame f;
    size_t at = 0;
    while (!c->dead) {
        if (c->in_count - at >= MIDI_WIRE_HEAD) {
            (void)midi_wire_read(c->in + at, c->in_count - at, &f);
            if (f.count > MIDI_WIRE_TEXT_MAX ||
                (f.kind != MIDI_WIRE_HELLO && f.kind != MIDI_WIRE_COMMAND &&
                 f.kind != MIDI_WIRE_MIDI && f.kind != MIDI_WIRE_PROOF)) {
                client_end(c, "that is no frame of lutetia-midi");
                return;
            }
        }
        const size_t used = midi_wire_read(c->in + at, c->in_count - at, &f);
        if (!used)
            break;
        const enum client_verdict verdict = c->frame(c, &f);
        if (verdict == CLIENT_ENDS || c->dead)
            return;
        if (verdict == CLIENT_WAITS)
            break;
        at += used;
    }
    memmove(c->in, c->in + at, c->in_count - at);
    c->in_count -= at;
    watched_set(c);
}

static void client_ready(struct server_watch *w, uint32_t events)
{
    struct server_client *c = w->owner;
    if (events & EPOLLOUT)
        client_flush(c);
    if (c->dead)
        return;
    if (!(events & (EPOLLIN | EPOLLHUP | EPOLLERR)))
        return;
    if (c->waits_for >= 0) { /* it hung up while one of its frames waits */
        if (events & (EPOLLHUP | EPOLLERR))
            die(c);
        return;
    }
    const ssize_t got =
        recv(w->file, c->in + c->in_count, sizeof c->in - c->in_count, MSG_DONTWAIT);
    if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) {
        die(c);
        return;
    }
    if (got > 0) {
        c->in_count += (size_t)got;
        frames_take(c);
    }
}

void client_wake(struct server_client *c)
{
    c->waits_for = -1;
    frames_take(c);
}

void client_look(struct server_client *c, uint64_t now_ns)
{
    if (c->dead)
        return;
    if (!c->out_count)
        c->progress_ns = now_ns;
    if (!c->greeted && now_ns > c->came_ns + CLIENT_GREET_MS * UINT64_C(1000000))
        client_end(c, "no greeting came");
    else if (now_ns > c->progress_ns + CLIENT_STALL_MS * UINT64_C(1000000))
        client_end(c, "it took nothing for ten seconds");
}
