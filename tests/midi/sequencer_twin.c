/* sequencer_twin.c - an imitation of the part of ALSA's library that talks to the kernel's
 * sequencer, for machines whose kernel has none. It is found as libasound.so.2; the coders of
 * MIDI bytes are the real library's.
 *
 * One other port exists, 20:0. It sends back each event that it receives. It disappears when it
 * receives the note-on G9 (127) with velocity 127, and is back after half a second. Each fifth
 * event is refused at first, as by a full queue. */
#include <alsa_library.h>

#include <dlfcn.h>
#include <errno.h>
#include <glob.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { PEER_CLIENT = 20, NOTE_ON = 6, BYTES_MOST = 1 << 16, AWAY_MS = 500 };

#define OF_ALSA __attribute__((visibility("default")))

struct sequencer {
    int ends[2]; /* the program reads from ends[0] what is written to ends[1] */
    bool from, to;
    int said;
    struct packet {
        struct alsa_event event;
        unsigned char bytes[BYTES_MOST];
    } heard, sent;
};

static int64_t back_ms;

static int64_t now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000 + t.tv_nsec / 1000000;
}

/* ---- the real coders ---- */

static void *real(const char *name)
{
    static void *library;
    glob_t found;
    if (!library && glob("/usr/lib/*/libasound.so.2", 0, NULL, &found) == 0) {
        library = dlopen(found.gl_pathv[0], RTLD_NOW | RTLD_LOCAL);
        globfree(&found);
    }
    void *function = library ? dlsym(library, name) : NULL;
    if (!function)
        abort();
    return function;
}

/* The functions below have the names and the types of ALSA's. */
OF_ALSA int snd_midi_event_new(size_t bytes, void **coder);
OF_ALSA void snd_midi_event_free(void *coder);
OF_ALSA void snd_midi_event_no_status(void *coder, int on);
OF_ALSA long snd_midi_event_encode(void *coder, const unsigned char *bytes, long count,
                                   struct alsa_event *event);
OF_ALSA long snd_midi_event_decode(void *coder, unsigned char *bytes, long room,
                                   const struct alsa_event *event);
OF_ALSA int snd_seq_open(void **out, const char *name, int streams, int mode);
OF_ALSA int snd_seq_close(void *sequencer);
OF_ALSA int snd_seq_set_client_name(void *sequencer, const char *name);
OF_ALSA int snd_seq_create_simple_port(void *sequencer, const char *name, unsigned int can,
                                       unsigned int type);
OF_ALSA int snd_seq_parse_address(void *sequencer, struct alsa_address *out, const char *text);
OF_ALSA int snd_seq_connect_from(void *sequencer, int port, int client, int client_port);
OF_ALSA int snd_seq_connect_to(void *sequencer, int port, int client, int client_port);
OF_ALSA int snd_seq_poll_descriptors(void *sequencer, struct pollfd *out, unsigned int room,
                                     short events);
OF_ALSA int snd_seq_event_input(void *sequencer, struct alsa_event **event);
OF_ALSA int snd_seq_event_input_pending(void *sequencer, int fetch);
OF_ALSA int snd_seq_event_output_direct(void *sequencer, struct alsa_event *event);
OF_ALSA const char *snd_strerror(int error);
OF_ALSA int snd_lib_error_set_handler(void (*told)(const char *, int, const char *, int,
                                                   const char *, ...));

int snd_midi_event_new(size_t bytes, void **coder)
{
    int (*function)(size_t, void **);
    *(void **)&function = real("snd_midi_event_new");
    return function(bytes, coder);
}

void snd_midi_event_free(void *coder)
{
    void (*function)(void *);
    *(void **)&function = real("snd_midi_event_free");
    function(coder);
}

void snd_midi_event_no_status(void *coder, int on)
{
    void (*function)(void *, int);
    *(void **)&function = real("snd_midi_event_no_status");
    function(coder, on);
}

long snd_midi_event_encode(void *coder, const unsigned char *bytes, long count,
                           struct alsa_event *event)
{
    long (*function)(void *, const unsigned char *, long, struct alsa_event *);
    *(void **)&function = real("snd_midi_event_encode");
    return function(coder, bytes, count, event);
}

long snd_midi_event_decode(void *coder, unsigned char *bytes, long room,
                           const struct alsa_event *event)
{
    long (*function)(void *, unsigned char *, long, const struct alsa_event *);
    *(void **)&function = real("snd_midi_event_decode");
    return function(coder, bytes, room, event);
}

/* ---- the imitated sequencer ---- */

int snd_seq_open(void **out, const char *name, int streams, int mode)
{
    struct sequencer *s = calloc(1, sizeof *s);
    if (!s || strcmp(name, "default") != 0 || streams != ALSA_DUPLEX || mode != ALSA_NONBLOCK ||
        socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, s->ends)) {
        free(s);
        return -ENOENT;
    }
    *out = s;
    return 0;
}

int snd_seq_close(void *sequencer)
{
    struct sequencer *s = sequencer;
    close(s->ends[0]);
    close(s->ends[1]);
    free(s);
    return 0;
}

int snd_seq_set_client_name(void *sequencer, const char *name)
{
    (void)sequencer;
    return name[0] ? 0 : -EINVAL;
}

int snd_seq_create_simple_port(void *sequencer, const char *name, unsigned int can,
                               unsigned int type)
{
    (void)sequencer;
    return name[0] && can == ALSA_PORT_ALL && type == ALSA_PORT_MIDI ? 3 : -EINVAL;
}

int snd_seq_parse_address(void *sequencer, struct alsa_address *out, const char *text)
{
    (void)sequencer;
    if (strcmp(text, "20:0") != 0 || now_ms() < back_ms)
        return -ENOENT;
    *out = (struct alsa_address){PEER_CLIENT, 0};
    return 0;
}

int snd_seq_connect_from(void *sequencer, int port, int client, int client_port)
{
    struct sequencer *s = sequencer;
    if (client == 0)
        return client_port == 1 ? 0 : -EINVAL; /* announcements */
    s->from = port == 3 && client == PEER_CLIENT && client_port == 0;
    return s->from ? 0 : -EINVAL;
}

int snd_seq_connect_to(void *sequencer, int port, int client, int client_port)
{
    struct sequencer *s = sequencer;
    s->to = port == 3 && client == PEER_CLIENT && client_port == 0;
    return s->to ? 0 : -EINVAL;
}

int snd_seq_poll_descriptors(void *sequencer, struct pollfd *out, unsigned int room,
                             short events)
{
    const struct sequencer *s = sequencer;
    if (!room)
        return 0;
    *out = (struct pollfd){.fd = s->ends[0], .events = events};
    return 1;
}

int snd_seq_event_input(void *sequencer, struct alsa_event **event)
{
    struct sequencer *s = sequencer;
    *event = NULL;
    if (recv(s->ends[0], &s->heard, sizeof s->heard, 0) < 0)
        return -errno;
    if (s->heard.event.type == ALSA_SYSEX)
        s->heard.event.data.long_data.bytes = s->heard.bytes;
    *event = &s->heard.event;
    return 1;
}

int snd_seq_event_input_pending(void *sequencer, int fetch)
{
    (void)sequencer, (void)fetch;
    return 0;
}

static int hand_over(struct sequencer *s, size_t bytes)
{
    return send(s->ends[1], &s->sent, sizeof s->sent.event + bytes, 0) < 0 ? -errno : 0;
}

int snd_seq_event_output_direct(void *sequencer, struct alsa_event *event)
{
    struct sequencer *s = sequencer;
    if (event->to.client != ALSA_SUBSCRIBERS || event->to.port != ALSA_ADDRESS_UNKNOWN ||
        event->queue != ALSA_DIRECT || event->source.port != 3)
        return -EINVAL;
    if (++s->said % 5 == 0)
        return -EAGAIN;
    if (!s->to || !s->from)
        return 0;
    s->sent.event = *event;
    s->sent.event.source = (struct alsa_address){PEER_CLIENT, 0};
    size_t bytes = 0;
    if (event->type == ALSA_SYSEX) {
        bytes = event->data.long_data.count;
        if (bytes > BYTES_MOST)
            return -EINVAL;
        memcpy(s->sent.bytes, event->data.long_data.bytes, bytes);
    }
    if (event->type == NOTE_ON && event->data.bytes[1] == 127 && event->data.bytes[2] == 127) {
        s->sent.event = (struct alsa_event){.type = ALSA_PORT_EXIT, .source = {0, 1}};
        s->sent.event.data.address = (struct alsa_address){PEER_CLIENT, 0};
        back_ms = now_ms() + AWAY_MS;
    }
    return hand_over(s, bytes);
}

const char *snd_strerror(int error)
{
    return strerror(-error);
}

int snd_lib_error_set_handler(void (*told)(const char *, int, const char *, int, const char *,
                                           ...))
{
    (void)told;
    return 0;
}
