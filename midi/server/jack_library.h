/* jack_library.h - loads JACK on first use. */
#ifndef LUTETIA_MIDI_JACK_LIBRARY_H
#define LUTETIA_MIDI_JACK_LIBRARY_H

#include <midi_status.h>

#include <stddef.h>
#include <stdint.h>

/* An event of a MIDI port's buffer, as JACK declares it. */
struct jack_event {
    uint32_t time; /* in samples from the period's beginning */
    size_t size;
    unsigned char *buffer;
};

enum { JACK_NO_START = 1, JACK_PORT_IN = 1, JACK_PORT_OUT = 2 };
#define JACK_MIDI_TYPE "8 bit raw midi"

/* The functions that we call, as JACK declares them; its clients and ports are opaque
 * pointers. */
struct jack_library {
    void *(*jack_client_open)(const char *name, int options, int *status, ...);
    int (*jack_client_close)(void *client);
    int (*jack_activate)(void *client);
    int (*jack_deactivate)(void *client);
    int (*jack_connect)(void *client, const char *from, const char *to);
    void *(*jack_port_register)(void *client, const char *name, const char *type,
                                unsigned long flags, unsigned long bytes);
    void *(*jack_port_get_buffer)(void *port, uint32_t frames);
    int (*jack_set_process_callback)(void *client,
                                     int (*process)(uint32_t frames, void *context),
                                     void *context);
    int (*jack_set_xrun_callback)(void *client, int (*late)(void *context), void *context);
    void (*jack_on_shutdown)(void *client, void (*gone)(void *context), void *context);
    uint32_t (*jack_get_sample_rate)(void *client);
    uint32_t (*jack_frames_since_cycle_start)(const void *client);
    uint32_t (*jack_last_frame_time)(const void *client);
    uint32_t (*jack_midi_get_event_count)(void *buffer);
    uint32_t (*jack_midi_get_lost_event_count)(void *buffer);
    int (*jack_midi_event_get)(struct jack_event *event, void *buffer, uint32_t index);
    void (*jack_midi_clear_buffer)(void *buffer);
    int (*jack_midi_event_write)(void *buffer, uint32_t time, const unsigned char *bytes,
                                 size_t count);
    void (*jack_set_error_function)(void (*told)(const char *text));
    void (*jack_set_info_function)(void (*told)(const char *text));
};

/* Errors: NO_DEVICE: it is not installed. Threads: the first call by one thread. */
enum midi_status jack_load(const struct jack_library **out);

#endif
