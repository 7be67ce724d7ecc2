/* server_route.c - see server_route.h. */
#include "server_route.h"

enum {
    SYSEX_WAIT_MS = 2000
}; /* the longest time that one client's system exclusive delays
                                * others */

struct hearing {
    struct server_client *client;
    int device;
};

static void hear_take(void *context, const struct midi_message *m)
{
    const struct hearing *h = context;
    client_put_message(h->client, h->device, m);
}

/* Sets the timer to the next value that a filter holds back, in all chains. */
static void thinned_set(struct midi_server *s)
{
    uint64_t due_ns = UINT64_MAX;
    for (const struct server_client *c = s->clients; c; c = c->next)
        for (int i = 0; i < s->devices_count; i++) {
            const struct midi_chain *both[2] = {c->hears[i], c->sends[i]};
            for (int k = 0; k < 2; k++) {
                const uint64_t one_ns = both[k] ? midi_chain_due_ns(both[k]) : UINT64_MAX;
                due_ns = one_ns < due_ns ? one_ns : due_ns;
            }
        }
    if (due_ns != s->thinned.due_ns)
        loop_timer(&s->loop, &s->thinned, due_ns);
}

/* ---- devices to clients ---- */

void route_received(struct server_device *d, const struct midi_message *m)
{
    struct midi_server *s = d->owner;
    s->messages += m->bytes[0] != MIDI_SENSING;
    for (struct server_client *c = s->clients; c; c = c->next) {
        struct hearing h = {c, d->number};
        if (c->hears[d->number])
            midi_chain_take(c->hears[d->number], m, hear_take, &h);
    }
}

void route_read(struct server_device *d)
{
    struct midi_server *s = d->owner;
    for (struct server_client *c = s->clients; c; c = c->next)
        if (c->batch)
            client_flush(c);
    thinned_set(s);
}

void route_hear(struct midi_server *s, struct server_client *c, int device,
                struct midi_chain *chain)
{
    struct hearing h = {c, device};
    if (c->hears[device]) {
        midi_chain_flush(c->hears[device], UINT64_MAX, hear_take, &h);
        midi_chain_destroy(c->hears[device]);
        client_release(c, device); /* the ends of notes must go through the same filters as
                                    * the notes */
    }
    c->hears[device] = chain;
    thinned_set(s);
}

void route_device_lost(struct midi_server *s, int device, uint32_t count)
{
    for (struct server_client *c = s->clients; c; c = c->next)
        if (c->hears[device])
            client_lose(c, count);
}

void route_device_away(struct midi_server *s, int device)
{
    s->owners[device] = NULL;
    for (struct server_client *c = s->clients; c; c = c->next) {
        struct hearing h = {c, device};
        if (c->hears[device])
            midi_chain_flush(c->hears[device], UINT64_MAX, hear_take, &h);
        client_release(c, device);
        c->played[device] = (struct midi_notes){0};
    }
}

/* ---- clients to devices ---- */

struct playing {
    struct midi_server *server;
    struct server_client *client;
    struct server_device *device;
};

static void play_take(void *context, const struct midi_message *m)
{
    const struct playing *p = context;
    const int device = p->device->number;
    if (!device_put(p->device, m))
        return;
    p->server->messages += m->bytes[0] != MIDI_SENSING;
    midi_notes_take(&p->client->played[device], m);
    if (midi_message_kind(m) == MIDI_KIND_REAL_TIME)
        return;
    const bool open = midi_message_open(m);
    p->server->owners[device] = open ? p->client : NULL;
    p->server->owned_ns[device] = midi_now_ns();
}

static bool owned_by_another(struct midi_server *s, const struct server_client *c, int device,
                             const struct midi_message *m)
{
    if (!s->owners[device] || s->owners[device] == c ||
        midi_message_kind(m) == MIDI_KIND_REAL_TIME)
        return false;
    if (midi_now_ns() < s->owned_ns[device] + SYSEX_WAIT_MS * UINT64_C(1000000))
        return true;
    s->owners[device] = NULL; /* the encoder ends that system exclusive before the next
                               * message */
    return false;
}

void route_drained(struct server_device *d)
{
    struct midi_server *s = d->owner;
    const uint64_t now_ns = midi_now_ns();
    while (!d->up || device_has_room(d)) { /* the client that has waited longest comes first */
        struct server_client *longest = NULL;
        for (struct server_client *c = s->clients; c; c = c->next)
            if (c->waits_for == d->number && c->waits_since_ns < now_ns && !c->dead &&
                (!longest || c->waits_since_ns < longest->waits_since_ns))
                longest = c;
        if (!longest)
            return;
        client_wake(longest);
    }
}

enum client_verdict route_message(struct midi_server *s, struct server_client *c,
                                  const struct midi_wire_frame *f)
{
    struct midi_message m;
    if (!midi_wire_message(f, &m)) {
        client_end(c, "a frame's payload was no MIDI message");
        return CLIENT_ENDS;
    }
    if (f->device >= s->devices_count) {
        client_end(c, "there is no device of that number");
        return CLIENT_ENDS;
    }
    struct server_device *d = s->devices[f->device];
    if (!d->up || !d->plays) {
        d->counts.refused++;
        return CLIENT_GOES_ON;
    }
    if (!device_has_room(d) || owned_by_another(s, c, f->device, &m)) {
        c->waits_for = f->device;
        c->waits_since_ns = midi_now_ns();
        return CLIENT_WAITS;
    }
    struct playing p = {s, c, d};
    const bool owned = s->owners[f->device] == c;
    c->received++;
    if (c->sends[f->device]) {
        midi_chain_take(c->sends[f->device], &m, play_take, &p);
        thinned_set(s);
    } else {
        play_take(&p, &m);
    }
    device_write_out(d);
    if (owned && !s->owners[f->device]) /* its system exclusive has ended: others may
                                         * continue */
        route_drained(d);
    return CLIENT_GOES_ON;
}

static void release_take(void *context, const struct midi_message *m)
{
    const struct playing *p = context;
    const int device = p->device->number, channel = m->bytes[0] & 15, note = m->bytes[1];
    const bool is_note = (m->bytes[0] & 0xf0) == MIDI_NOTE_OFF;
    for (const struct server_client *c = p->server->clients; c; c = c->next) {
        const struct midi_notes *n = &c->played[device];
        if (c == p->client || c->dead)
            continue;
        const uint64_t held =
            is_note ? n->on[channel][note >> 6] >> (note & 63) : (uint64_t)n->pedals >> channel;
        if (held & 1)
            return; /* another one holds it */
    }
    (void)device_put(p->device, m);
}

void route_client_away(struct midi_server *s, struct server_client *c)
{
    for (int i = 0; i < s->devices_count; i++) {
        struct playing p = {s, c, s->devices[i]};
        const bool owned = s->owners[i] == c;
        if (owned)
            s->owners[i] = NULL;
        midi_notes_release(&c->played[i], midi_now_ns(), release_take, &p);
        device_write_out(s->devices[i]);
        if (owned)
            route_drained(s->devices[i]);
    }
}

void route_send_filter(struct midi_server *s, struct server_client *c, int device,
                       struct midi_chain *chain)
{
    struct playing p = {s, c, s->devices[device]};
    if (c->sends[device])
        midi_chain_flush(c->sends[device], UINT64_MAX, play_take, &p);
    midi_chain_destroy(c->sends[device]);
    c->sends[device] = chain;
    midi_notes_release(&c->played[device], midi_now_ns(), release_take, &p);
    device_write_out(s->devices[device]);
    thinned_set(s);
}

void route_thinned(struct server_timer *t, uint64_t now_ns)
{
    struct midi_server *s = t->owner;
    for (struct server_client *c = s->clients; c; c = c->next)
        for (int i = 0; i < s->devices_count; i++) {
            struct hearing h = {c, i};
            struct playing p = {s, c, s->devices[i]};
            if (c->hears[i])
                midi_chain_flush(c->hears[i], now_ns, hear_take, &h);
            if (c->sends[i]) {
                midi_chain_flush(c->sends[i], now_ns, play_take, &p);
                device_write_out(s->devices[i]);
            }
        }
    for (struct server_client *c = s->clients; c; c = c->next)
        if (c->batch) {
            c->batch = 0; /* held back on purpose: not part of the server's latency */
            client_flush(c);
        }
    thinned_set(s);
}
