/* device_jack.c - two ports of JACK's, one in and one out.
 *
 *     JACK's thread   process(): events of the period -> heard -> the server's loop, woken by
 *                     an eventfd
 *                                events to write      <- said  <-
 *
 * A received event keeps its time within the period. Events to send are written at the
 * beginning of the next period; what does not fit goes into the one after it, and who sends
 * more than that waits, as for a serial line. What JACK or the ring of what was heard has no
 * room for, periods that were missed and JACK's own word of an xrun are counted: the server
 * tells it, and ends the notes whose ends may be among what is lost, at both sides.
 */
#include "device_kinds.h"
#include "jack_library.h"
#include "message_ring.h"

#include <midi_internal.h>
#include <midi_time.h>

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

enum {
    EVENT_BYTES_MAX = 8192,
    /* bytes of the ring of what is to be said: further messages wait at their senders */
    SAID_USUAL = 4096
};

struct jack_device {
    const struct jack_library *jack;
    void *client, *in, *out;
    uint32_t rate_hz;
    struct server_watch watch;
    struct message_ring heard, said;
    _Atomic bool gone;
    _Atomic bool wanted;                /* the loop waits for room in `said` */
    _Atomic bool quiet;                 /* nothing was said in the last period */
    uint32_t last_frame;                /* process()'s own */
    _Atomic uint32_t in_lost, out_lost; /* and not yet told */
    struct midi_parser parser;          /* of output: JACK takes whole messages */
    uint8_t sysex[EVENT_BYTES_MAX];
    size_t sysex_count;
    uint8_t event[EVENT_BYTES_MAX]; /* process()'s own */
    uint64_t left_ns;               /* of the list below */
    struct jack_device *next;
};

/* Devices whose JACK has ended, and whose client is still open. JACK's library goes on handling
 * what its server said last. Who closes the client meanwhile ends the library's thread with a
 * lock in its hand, and waits for that lock for ever. So a client is closed when LEFT_MS have
 * passed, and no other is opened before. The loop's thread alone uses the list. */
static struct jack_device *left;
enum { LEFT_MS = 900 /* less than retry_ms: the first try finds them closed */ };

static void wake(const struct jack_device *j)
{
    const uint64_t one = 1;
    const ssize_t written = write(j->watch.file, &one, sizeof one);
    (void)written;
}

/* ---- JACK's thread: never blocks or allocates ---- */

/* Periods for which this thread was too late: what came in them is gone, and who was to read
 * what was said in the last one may not have. Each counts as a message. */
static uint32_t periods_missed(struct jack_device *j, uint32_t frames)
{
    const uint32_t now = j->jack->jack_last_frame_time(j->client), before = j->last_frame;
    const uint32_t ahead = now - before;
    j->last_frame = now;
    if (!before || ahead <= frames || ahead > UINT32_MAX / 2)
        return 0;
    return (ahead - 1) / frames;
}

/* Whether there is something for the loop. */
static bool period_hear(struct jack_device *j, uint32_t frames)
{
    const struct jack_library *jack = j->jack;
    void *in = jack->jack_port_get_buffer(j->in, frames);
    const uint64_t now_ns = midi_now_ns();
    const uint64_t ago = jack->jack_frames_since_cycle_start(j->client);
    const uint32_t count = jack->jack_midi_get_event_count(in);
    uint32_t lost = jack->jack_midi_get_lost_event_count(in) + periods_missed(j, frames);
    struct jack_event e;
    for (uint32_t i = 0; i < count; i++) {
        if (jack->jack_midi_event_get(&e, in, i) != 0)
            continue;
        /* events are of the previous period, and so that old */
        const uint64_t old = (uint64_t)frames + ago - (e.time < frames ? e.time : 0);
        lost += e.size > EVENT_BYTES_MAX ||
                !ring_put(&j->heard, now_ns - old * 1000000000 / j->rate_hz, e.buffer, e.size);
    }
    j->in_lost += lost;
    return count || lost;
}

/* Whether something was taken from the ring. */
static bool period_say(struct jack_device *j, uint32_t frames)
{
    const struct jack_library *jack = j->jack;
    void *out = jack->jack_port_get_buffer(j->out, frames);
    uint64_t time_ns;
    bool said = false, taken = false;
    jack->jack_midi_clear_buffer(out);
    for (size_t bytes;
         (bytes = ring_look(&j->said, &time_ns, j->event, sizeof j->event)) > 0;) {
        const bool fits = jack->jack_midi_event_write(out, 0, j->event, bytes) == 0;
        if (!fits && said)
            break; /* the period is full: the next one takes it */
        if (!fits) /* no period is as long */
            j->out_lost++;
        said = said || fits;
        if (said)
            j->quiet = false;
        (void)ring_take(&j->said, &time_ns, j->event, sizeof j->event);
        taken = true;
    }
    if (!taken)
        j->quiet = true;
    return taken;
}

static int process(uint32_t frames, void *context)
{
    struct jack_device *j = context;
    const bool heard = period_hear(j, frames), said = period_say(j, frames);
    if (heard || (said && (j->wanted || j->out_lost)))
        wake(j);
    return 0;
}

/* Some client was late, and JACK's count of frames may not show it: who was to read what was
 * said may not have. Nothing that was heard is told as lost: a note that is held shall go on
 * where another program was late. */
static int late(void *context)
{
    struct jack_device *j = context;
    j->out_lost++;
    wake(j);
    return 0;
}

static void shut_down(void *context)
{
    struct jack_device *j = context;
    j->gone = true;
    wake(j);
}

/* ---- the loop's thread ---- */

static void jack_ready(struct server_watch *w, uint32_t events)
{
    struct server_device *d = w->owner;
    struct jack_device *j = d->own;
    uint8_t bytes[EVENT_BYTES_MAX];
    uint64_t count, time_ns;
    (void)events;
    const ssize_t got = read(w->file, &count, sizeof count);
    (void)got;
    for (size_t size; (size = ring_take(&j->heard, &time_ns, bytes, sizeof bytes)) > 0;)
        device_input(d, time_ns, bytes, size);
    device_read_end(d);
    device_lost(d, atomic_exchange(&j->in_lost, 0), atomic_exchange(&j->out_lost, 0));
    device_write_out(d);
    if (j->gone)
        device_down(d, "the JACK server is gone");
}

static enum midi_status ports_open(struct server_device *d, struct jack_device *j)
{
    const struct jack_library *jack = j->jack;
    const char *name = d->argument[0] ? d->argument : "lutetia";
    j->client = jack->jack_client_open(name, JACK_NO_START, NULL);
    if (!j->client)
        return midi_fail(MIDI_NO_DEVICE, "no JACK server runs");
    j->rate_hz = jack->jack_get_sample_rate(j->client);
    j->in = jack->jack_port_register(j->client, "in", JACK_MIDI_TYPE, JACK_PORT_IN, 0);
    j->out = jack->jack_port_register(j->client, "out", JACK_MIDI_TYPE, JACK_PORT_OUT, 0);
    jack->jack_on_shutdown(j->client, shut_down, j);
    if (!j->in || !j->out || !j->rate_hz ||
        jack->jack_set_xrun_callback(j->client, late, j) != 0 ||
        jack->jack_set_process_callback(j->client, process, j) != 0 ||
        jack->jack_activate(j->client) != 0)
        return midi_fail(MIDI_NO_DEVICE, "JACK gives no MIDI ports");
    return MIDI_OK;
}

static void jack_free(struct jack_device *j)
{
    if (j->client)
        j->jack->jack_client_close(j->client);
    if (j->watch.file >= 0)
        close(j->watch.file);
    free(j);
}

/* Closes those of the list whose time has come; whether none is left. */
static bool left_end(void)
{
    const uint64_t now_ns = midi_now_ns();
    for (struct jack_device **at = &left; *at;) {
        struct jack_device *j = *at;
        if (now_ns - j->left_ns < LEFT_MS * UINT64_C(1000000)) {
            at = &j->next;
            continue;
        }
        *at = j->next;
        jack_free(j);
    }
    return !left;
}

static enum midi_status jack_open(struct server_device *d)
{
    const struct jack_library *jack;
    if (!left_end())
        return midi_fail(MIDI_NO_DEVICE, "the JACK server is gone");
    enum midi_status status = jack_load(&jack);
    if (status != MIDI_OK)
        return MIDI_BAD_ARGUMENT; /* permanent: JACK will not be installed while the server
                                   * runs */
    struct jack_device *j = calloc(1, sizeof *j);
    if (!j)
        return midi_fail(MIDI_NO_MEMORY, "no memory");
    d->own = j;
    j->jack = jack;
    midi_parser_init(&j->parser);
    j->watch = (struct server_watch){eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK), jack_ready, d};
    if (j->watch.file < 0 || !loop_watch(d->loop, &j->watch, EPOLLIN))
        return midi_fail(MIDI_NO_DEVICE, "no descriptor for JACK");
    return ports_open(d, j);
}

static void jack_close(struct server_device *d)
{
    struct jack_device *j = d->own;
    if (!j)
        return;
    d->own = NULL;
    loop_unwatch(d->loop, &j->watch);
    if (!j->client || !j->gone) {
        jack_free(j);
        return;
    }
    j->left_ns = midi_now_ns();
    j->next = left;
    left = j;
}

static void say(void *context, const struct midi_message *m)
{
    struct jack_device *j = context;
    bool good = true;
    if (midi_message_kind(m) != MIDI_KIND_SYSEX) {
        good = ring_put(&j->said, 0, m->bytes, m->count);
    } else {
        if (m->bytes[0] == MIDI_SYSEX)
            j->sysex_count = 0;
        if (j->sysex_count + m->count <= sizeof j->sysex)
            memcpy(j->sysex + j->sysex_count, m->bytes, m->count);
        j->sysex_count += m->count;
        if (!midi_message_open(m)) /* JACK's buffer cannot hold longer ones */
            good = j->sysex_count <= sizeof j->sysex &&
                   ring_put(&j->said, 0, j->sysex, j->sysex_count);
    }
    j->out_lost += !good;
}

static size_t jack_write(struct server_device *d, const uint8_t *bytes, size_t count)
{
    struct jack_device *j = d->own;
    size_t taken = 0;
    for (; taken < count && ring_used(&j->said) < SAID_USUAL; taken++)
        midi_parser_take(&j->parser, 0, bytes + taken, 1, say, j);
    if (j->out_lost)
        wake(j);
    return taken;
}

static void jack_more(struct server_device *d, bool wanted)
{
    struct jack_device *j = d->own;
    j->wanted = wanted;
    if (wanted && ring_used(&j->said) < SAID_USUAL) /* a period has come in between */
        wake(j);
}

static bool jack_busy(const struct server_device *d)
{
    const struct jack_device *j = d->own;
    return !j->gone && (ring_used(&j->said) > 0 || !j->quiet);
}

const struct device_kind device_kind_jack = {
    .name = "jack",
    .argument = "[CLIENT]",
    .help = "ports `in` and `out` of a JACK client, which is called lutetia",
    .plays = true,
    .hears = true,
    .retry_ms = 1000,
    .open = jack_open,
    .close = jack_close,
    .write = jack_write,
    .busy = jack_busy,
    .more = jack_more,
};
