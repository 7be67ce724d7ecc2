/* microphone_jack.c - a port of JACK's that hears. */
#include "microphone_internal.h"

#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { NO_START = 1, PORT_IN = 1, PORT_OUT = 2, PORT_PHYSICAL = 4 };
#define AUDIO_TYPE "32 bit float mono audio"

/* The functions that we call, as JACK declares them. */
struct jack {
    void *library, *client, *port;
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

static bool functions_find(struct jack *j)
{
    const struct {
        const char *name;
        void *at;
    } all[] = {{"jack_client_open", &j->client_open},
               {"jack_client_close", &j->client_close},
               {"jack_activate", &j->activate},
               {"jack_connect", &j->connect},
               {"jack_port_register", &j->port_register},
               {"jack_port_name", &j->port_name},
               {"jack_port_get_buffer", &j->port_get_buffer},
               {"jack_get_ports", &j->get_ports},
               {"jack_free", &j->free},
               {"jack_set_process_callback", &j->set_process_callback},
               {"jack_on_shutdown", &j->on_shutdown},
               {"jack_get_sample_rate", &j->get_sample_rate},
               {"jack_set_error_function", &j->set_error_function},
               {"jack_set_info_function", &j->set_info_function}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (!(*(void **)all[i].at = dlsym(j->library, all[i].name)))
            return false;
    return true;
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
    if (j)
        j->library = dlopen("libjack.so.0", RTLD_NOW | RTLD_LOCAL);
    if (!j || !j->library || !functions_find(j)) {
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
