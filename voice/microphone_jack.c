/* microphone_jack.c - a port of JACK's that hears. */
#include "microphone_internal.h"

#include <library.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { NO_START = 1, PORT_IN = 1, PORT_OUT = 2, PORT_PHYSICAL = 4 };
#define AUDIO_TYPE "32 bit float mono audio"

/* The functions that we call, as JACK declares them. */
struct jack {
    void *client, *port;
    void *(*client_open)(const char *name, int options, int *status, ...);
    int (*client_close)(void *client);
    int (*activate)(void *client);
    int (*connect)(void *client, const char *from, const char *to);
    void *(*port_register)(void *client, const char *name, const char *type,
                           unsigned long flags, unsigned long bytes);
    const char *(*port_name)(void *port);
    void *(*port_get_buffer)(void *port, uint32_t frames);
    const char **(*get_ports)(void *client, const char *name, const char *type,
                              unsigned long flags);
    void (*free)(void *memory);
    int (*set_process_callback)(void *client, int (*process)(uint32_t frames, void *context),
                                void *context);
    void (*on_shutdown)(void *client, void (*gone)(void *context), void *context);
    uint32_t (*get_sample_rate)(void *client);
    void (*set_error_function)(void (*told)(const char *text));
    void (*set_info_function)(void (*told)(const char *text));
};

static void told(const char *text)
{
    (void)text; /* what fails we say ourselves */
}

/* JACK's thread: nothing here waits or asks for memory. */
static int process(uint32_t frames, void *context)
{
    struct microphone *m = context;
    struct jack *j = m->own;
    const float *heard = j->port_get_buffer(j->port, frames);
    if (heard)
        microphone_put(m, heard, frames);
    return 0;
}

static void shut_down(void *context)
{
    struct microphone *m = context;
    atomic_store(&m->gone, true);
}

static bool jack_load(struct jack *j)
{
    static const struct library_function functions[] = {
        {"jack_client_open", offsetof(struct jack, client_open)},
        {"jack_client_close", offsetof(struct jack, client_close)},
        {"jack_activate", offsetof(struct jack, activate)},
        {"jack_connect", offsetof(struct jack, connect)},
        {"jack_port_register", offsetof(struct jack, port_register)},
        {"jack_port_name", offsetof(struct jack, port_name)},
        {"jack_port_get_buffer", offsetof(struct jack, port_get_buffer)},
        {"jack_get_ports", offsetof(struct jack, get_ports)},
        {"jack_free", offsetof(struct jack, free)},
        {"jack_set_process_callback", offsetof(struct jack, set_process_callback)},
        {"jack_on_shutdown", offsetof(struct jack, on_shutdown)},
        {"jack_get_sample_rate", offsetof(struct jack, get_sample_rate)},
        {"jack_set_error_function", offsetof(struct jack, set_error_function)},
        {"jack_set_info_function", offsetof(struct jack, set_info_function)}};
    const char *missing;
    return library_load("libjack.so.0", functions, sizeof functions / sizeof *functions, j,
                        &missing);
}

/* The first port that captures, where there is a sound card. */
static void port_connect(struct jack *j)
{
    const char **ports = j->get_ports(j->client, NULL, AUDIO_TYPE, PORT_PHYSICAL | PORT_OUT);
    if (ports && ports[0])
        (void)j->connect(j->client, ports[0], j->port_name(j->port));
    if (ports)
        j->free(ports);
}

static void jack_close(struct microphone *m)
{
    struct jack *j = m->own;
    if (j->client)
        j->client_close(j->client);
    free(j); /* the library stays: it has threads of its own */
}

bool microphone_jack_open(struct microphone *m, char *why, size_t room)
{
    struct jack *j = calloc(1, sizeof *j);
    if (!j || !jack_load(j)) {
        snprintf(why, room, "JACK is not installed: install libjack-jackd2-0");
        free(j);
        return false;
    }
    j->set_error_function(told);
    j->set_info_function(told);
    m->own = j;
    j->client = j->client_open("lutetia-voice", NO_START, NULL);
    if (j->client) {
        m->rate_hz = (int)j->get_sample_rate(j->client);
        j->port = j->port_register(j->client, "in", AUDIO_TYPE, PORT_IN, 0);
        j->on_shutdown(j->client, shut_down, m);
    }
    if (!j->client || !j->port || m->rate_hz <= 0 ||
        j->set_process_callback(j->client, process, m) != 0 || j->activate(j->client) != 0) {
        snprintf(why, room, "no JACK server runs");
        jack_close(m);
        m->own = NULL;
        return false;
    }
    m->close = jack_close;
    port_connect(j);
    return true;
}
