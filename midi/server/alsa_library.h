/* alsa_library.h - loads ALSA's library on first use, for its sequencer. */
#ifndef LUTETIA_MIDI_ALSA_LIBRARY_H
#define LUTETIA_MIDI_ALSA_LIBRARY_H

#include <midi_status.h>

#include <poll.h>
#include <stddef.h>
#include <stdint.h>

struct alsa_address {
    uint8_t client, port;
};

/* An event of the sequencer, as the kernel declares it (struct snd_seq_event, 28 bytes). */
struct alsa_event {
    uint8_t type, flags, tag, queue;
    uint32_t time[2];
    struct alsa_address source, to;
    union {
        uint8_t bytes[12];
        struct alsa_address address; /* of announcements */
        struct __attribute__((packed)) {
            uint32_t count;
            void *bytes;
        } long_data; /* of ALSA_SYSEX */
    } data;
};

enum {
    ALSA_CLIENT_EXIT = 61,
    ALSA_PORT_EXIT = 64,
    ALSA_SYSEX = 130,
    ALSA_NONE = 255,
    ALSA_DIRECT = 253,          /* the queue: none, at once */
    ALSA_SUBSCRIBERS = 254,     /* a destination's client: all that are connected */
    ALSA_ADDRESS_UNKNOWN = 253, /* ... and its port then */
    ALSA_DUPLEX = 3,
    ALSA_NONBLOCK = 1,
    ALSA_PORT_ALL =
        1 << 0 | 1 << 1 | 1 << 5 | 1 << 6, /* read, write, and both by subscription */
    ALSA_PORT_MIDI = 1 << 1 | 1 << 20      /* MIDI of any device, an application's */
};

/* The functions that we call, as ALSA declares them; its sequencer and coders are opaque
 * pointers. Results below 0 are negative errors. */
struct alsa_library {
    int (*snd_seq_open)(void **sequencer, const char *name, int streams, int mode);
    int (*snd_seq_close)(void *sequencer);
    int (*snd_seq_set_client_name)(void *sequencer, const char *name);
    int (*snd_seq_create_simple_port)(void *sequencer, const char *name, unsigned int can,
                                      unsigned int type);
    int (*snd_seq_parse_address)(void *sequencer, struct alsa_address *out, const char *text);
    int (*snd_seq_connect_from)(void *sequencer, int port, int client, int client_port);
    int (*snd_seq_connect_to)(void *sequencer, int port, int client, int client_port);
    int (*snd_seq_poll_descriptors)(void *sequencer, struct pollfd *out, unsigned int room,
                                    short events);
    int (*snd_seq_event_input)(void *sequencer, struct alsa_event **event);
    int (*snd_seq_event_input_pending)(void *sequencer, int fetch);
    int (*snd_seq_event_output_direct)(void *sequencer, struct alsa_event *event);
    int (*snd_midi_event_new)(size_t bytes, void **coder);
    void (*snd_midi_event_free)(void *coder);
    void (*snd_midi_event_no_status)(void *coder, int on);
    long (*snd_midi_event_encode)(void *coder, const unsigned char *bytes, long count,
                                  struct alsa_event *event);
    long (*snd_midi_event_decode)(void *coder, unsigned char *bytes, long room,
                                  const struct alsa_event *event);
    const char *(*snd_strerror)(int error);
    int (*snd_lib_error_set_handler)(void (*told)(const char *file, int line,
                                                  const char *function, int error,
                                                  const char *format, ...));
};

/* Errors: NO_DEVICE: it is not installed. Threads: the first call by one thread. */
enum midi_status alsa_load(const struct alsa_library **out);

#endif
