/* microphone_pulse.c - what PulseAudio records, read by a thread of ours through its simple
 * library. */
#include "microphone_internal.h"

#include <library.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { RATE_HZ = 48000, PIECE = 256 /* samples, 5 ms */, RECORD = 2, FLOAT32_LE = 5 };

struct sample_spec {
    int format;
    uint32_t rate_hz;
    uint8_t channels;
};

/* How much the server keeps before it hands it out. */
struct buffer_attr {
    uint32_t maxlength, tlength, prebuf, minreq, fragsize;
};

struct pulse {
    void *stream;
    pthread_t thread;
    atomic_bool over;
    void *(*pa_simple_new)(const char *server, const char *name, int direction,
                           const char *device, const char *stream,
                           const struct sample_spec *spec, const void *map,
                           const struct buffer_attr *attr, int *error);
    int (*pa_simple_read)(void *stream, void *data, size_t bytes, int *error);
    void (*pa_simple_free)(void *stream);
};

static void *hear(void *context)
{
    struct microphone *m = context;
    struct pulse *p = m->own;
    float piece[PIECE];
    int error;
    while (!atomic_load(&p->over)) {
        if (p->pa_simple_read(p->stream, piece, sizeof piece, &error) < 0) {
            atomic_store(&m->gone, true);
            break;
        }
        microphone_put(m, piece, PIECE);
    }
    return NULL;
}

static void pulse_close(struct microphone *m)
{
    struct pulse *p = m->own;
    atomic_store(&p->over, true);
    pthread_join(p->thread, NULL); /* a piece's time at most */
    p->pa_simple_free(p->stream);
    free(p);
}

bool microphone_pulse_open(struct microphone *m, char *why, size_t room)
{
    const struct sample_spec spec = {FLOAT32_LE, RATE_HZ, 1};
    const struct buffer_attr attr = {UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX,
                                     PIECE * sizeof(float)};
    static const struct library_function functions[] = {
        LIBRARY_FUNCTION(struct pulse, pa_simple_new),
        LIBRARY_FUNCTION(struct pulse, pa_simple_read),
        LIBRARY_FUNCTION(struct pulse, pa_simple_free)};
    const char *missing;
    struct pulse *p = calloc(1, sizeof *p);
    int error;
    if (!p || !library_load("libpulse-simple.so.0", functions,
                            sizeof functions / sizeof *functions, p, &missing)) {
        snprintf(why, room, "PulseAudio is not installed: install libpulse0");
        free(p);
        return false;
    }
    m->own = p;
    m->rate_hz = RATE_HZ;
    p->stream =
        p->pa_simple_new(NULL, "lutetia", RECORD, NULL, "voice", &spec, NULL, &attr, &error);
    if (!p->stream || pthread_create(&p->thread, NULL, hear, m) != 0) {
        snprintf(why, room, "no PulseAudio server runs, or it has no microphone");
        if (p->stream)
            p->pa_simple_free(p->stream);
        free(p);
        m->own = NULL;
        return false;
    }
    m->close = pulse_close;
    return true;
}
