/* device_alsa.c - a port of ALSA's sequencer, to which other programs and instruments connect.
 *
 * With an address ("20:0", or a client's name) the port is connected to that one, both ways as
 * far as it allows; the device is away while there is no such port. Without one the port waits
 * for aconnect or a patch bay.
 *
 * An event's time is that of its read: the sequencer delivers at once what has no queue.
 */
#include "alsa_library.h"
#include "device_kinds.h"

#include <midi_internal.h>
#include <midi_time.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { CODER_BYTES = 4096, MESSAGE_BYTES = 16, EVENTS_TOGETHER = 256 };

struct alsa_device {
    const struct alsa_library *alsa;
    void *sequencer, *in_coder, *out_coder;
    int port;
    struct alsa_address peer;
    bool has_peer;
    struct server_watch watch;
    struct alsa_event
        event; /* encoded, and not yet accepted by the kernel: its last byte is not taken */
    bool waits;
};

static bool same(struct alsa_address a, struct alsa_address b)
{
    return a.client == b.client && a.port == b.port;
}

/* Whether an announcement says that the peer is gone. */
static bool peer_leaves(const struct alsa_device *a, const struct alsa_event *e)
{
    if (!a->has_peer || e->source.client != 0)
        return false;
    return e->type == ALSA_CLIENT_EXIT
               ? e->data.address.client == a->peer.client
               : e->type == ALSA_PORT_EXIT && same(e->data.address, a->peer);
}

static void event_heard(struct server_device *d, const struct alsa_event *e, uint64_t now_ns)
{
    struct alsa_device *a = d->own;
    uint8_t bytes[MESSAGE_BYTES];
    if (e->type == ALSA_SYSEX) { /* any length; long ones come as several events */
        const void *long_bytes;
        memcpy(&long_bytes, (const char *)&e->data.long_data.bytes, sizeof long_bytes);
        device_input(d, now_ns, long_bytes, e->data.long_data.count);
        return;
    }
    const long count =
        a->alsa->snd_midi_event_decode(a->in_coder, bytes, sizeof bytes, e); /* < 0: no MIDI */
    if (count > 0)
        device_input(d, now_ns, bytes, (size_t)count);
}

static void events_read(struct server_device *d)
{
    struct alsa_device *a = d->own;
    const uint64_t now_ns = midi_now_ns();
    struct alsa_event *e;
    int error = 0;
    for (int i = 0; i < EVENTS_TOGETHER; i++) {
        error = a->alsa->snd_seq_event_input(a->sequencer, &e);
        if (error ==
            -ENOSPC) { /* the kernel's queue was full: some events are lost, one at least */
            device_lost(d, 1, 0);
            continue;
        }
        if (error < 0 || !e)
            break;
        if (peer_leaves(a, e)) {
            device_read_end(d);
            device_down(d, "its port is gone");
            return;
        }
        event_heard(d, e, now_ns);
        if (!d->up)
            return;
    }
    device_read_end(d);
    if (d->up && error < 0 && error != -EAGAIN && error != -EINTR && error != -ENOSPC)
        device_down(d, a->alsa->snd_strerror(error));
}

static void alsa_ready(struct server_watch *w, uint32_t events)
{
    struct server_device *d = w->owner;
    const struct alsa_device *a = d->own;
    if (events & EPOLLOUT)
        device_write_out(d);
    if (!d->up || !(events & (EPOLLIN | EPOLLHUP | EPOLLERR)))
        return;
    do
        events_read(d); /* the library holds events that it has read with others */
    while (d->up && a->alsa->snd_seq_event_input_pending(a->sequencer, 0) > 0);
}

static enum midi_status peer_connect(struct server_device *d, struct alsa_device *a)
{
    const struct alsa_library *alsa = a->alsa;
    int error = alsa->snd_seq_parse_address(a->sequencer, &a->peer, d->argument);
    if (error < 0)
        return midi_fail(MIDI_NO_DEVICE,
                         "ALSA's sequencer has no port %s: `aconnect -l` lists them",
                         d->argument);
    const int from =
        alsa->snd_seq_connect_from(a->sequencer, a->port, a->peer.client, a->peer.port);
    const int to =
        alsa->snd_seq_connect_to(a->sequencer, a->port, a->peer.client, a->peer.port);
    if (from < 0 && to < 0)
        return midi_fail(MIDI_NO_DEVICE, "port %s: %s", d->argument, alsa->snd_strerror(from));
    d->hears = from >= 0;
    d->plays = to >= 0;
    a->has_peer = true;
    return MIDI_OK;
}

static enum midi_status sequencer_open(struct server_device *d, struct alsa_device *a)
{
    const struct alsa_library *alsa = a->alsa;
    enum { SYSTEM = 0, ANNOUNCE = 1 };
    struct pollfd p;
    int error = alsa->snd_seq_open(&a->sequencer, "default", ALSA_DUPLEX, ALSA_NONBLOCK);
    if (error < 0) {
        a->sequencer = NULL;
        return midi_fail(MIDI_NO_DEVICE, "ALSA's sequencer: %s%s", alsa->snd_strerror(error),
                         error == -ENOENT ? " (/dev/snd/seq; root loads it by modprobe snd-seq)"
                                          : "");
    }
    error = alsa->snd_seq_set_client_name(a->sequencer, "lutetia");
    if (error >= 0)
        error = a->port = alsa->snd_seq_create_simple_port(a->sequencer, d->name, ALSA_PORT_ALL,
                                                           ALSA_PORT_MIDI);
    if (error >= 0)
        error = alsa->snd_midi_event_new(CODER_BYTES, &a->in_coder);
    if (error >= 0)
        error = alsa->snd_midi_event_new(CODER_BYTES, &a->out_coder);
    if (error >= 0 && alsa->snd_seq_poll_descriptors(a->sequencer, &p, 1, POLLIN) != 1)
        error = -ENODEV;
    if (error < 0)
        return midi_fail(MIDI_NO_DEVICE, "ALSA's sequencer: %s", alsa->snd_strerror(error));
    alsa->snd_midi_event_no_status(a->in_coder, 1); /* each message whole */
    a->watch = (struct server_watch){p.fd, alsa_ready, d};
    d->hears = d->plays = true;
    if (!d->argument[0])
        return MIDI_OK;
    alsa->snd_seq_connect_from(a->sequencer, a->port, SYSTEM, ANNOUNCE);
    return peer_connect(d, a);
}

static enum midi_status alsa_open(struct server_device *d)
{
    const struct alsa_library *alsa;
    /* permanent: it will not be installed while the server runs */
    if (alsa_load(&alsa) != MIDI_OK)
        return MIDI_BAD_ARGUMENT;
    struct alsa_device *a = calloc(1, sizeof *a);
    if (!a)
        return midi_fail(MIDI_NO_MEMORY, "no memory");
    d->own = a;
    a->alsa = alsa;
    a->watch.file = -1;
    enum midi_status status = sequencer_open(d, a);
    if (status == MIDI_OK && !loop_watch(d->loop, &a->watch, EPOLLIN))
        status = midi_fail(MIDI_NO_DEVICE, "ALSA's sequencer: %s", strerror(errno));
    return status;
}

static void alsa_close(struct server_device *d)
{
    struct alsa_device *a = d->own;
    if (!a)
        return;
    loop_unwatch(d->loop, &a->watch);
    if (a->in_coder)
        a->alsa->snd_midi_event_free(a->in_coder);
    if (a->out_coder)
        a->alsa->snd_midi_event_free(a->out_coder);
    if (a->sequencer)
        a->alsa->snd_seq_close(a->sequencer);
    free(a);
    d->own = NULL;
}

/* Hands the event that waits to the kernel. False: not now, or the device is down. */
static bool event_say(struct server_device *d, struct alsa_device *a)
{
    const int error = a->alsa->snd_seq_event_output_direct(a->sequencer, &a->event);
    a->waits = error == -EAGAIN || error == -EINTR;
    if (error < 0 && !a->waits)
        device_down(d, a->alsa->snd_strerror(error));
    return error >= 0;
}

static size_t alsa_write(struct server_device *d, const uint8_t *bytes, size_t count)
{
    struct alsa_device *a = d->own;
    size_t taken = a->waits ? 1 : 0;
    if (a->waits && !event_say(d, a))
        return 0;
    while (taken < count) {
        const long used = a->alsa->snd_midi_event_encode(a->out_coder, bytes + taken,
                                                         (long)(count - taken), &a->event);
        if (used <= 0)
            break;
        taken += (size_t)used;
        if (a->event.type == ALSA_NONE)
            continue;
        a->event.source.port = (uint8_t)a->port;
        a->event.to = (struct alsa_address){ALSA_SUBSCRIBERS, ALSA_ADDRESS_UNKNOWN};
        a->event.queue = ALSA_DIRECT;
        if (!event_say(d, a))
            return d->up ? taken - 1 : 0;
    }
    return taken;
}

static void alsa_more(struct server_device *d, bool wanted)
{
    struct alsa_device *a = d->own;
    loop_change(d->loop, &a->watch, EPOLLIN | (wanted ? EPOLLOUT : 0u));
}

const struct device_kind device_kind_alsa = {
    .name = "alsa",
    .argument = "[ADDRESS]",
    .help =
        "a port of ALSA's sequencer, connected to the port ADDRESS (20:0, or a client's name)",
    .retry_ms = 1000,
    .open = alsa_open,
    .close = alsa_close,
    .write = alsa_write,
    .more = alsa_more,
};
