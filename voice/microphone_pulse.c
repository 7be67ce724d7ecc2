/* microphone_pulse.c - what PulseAudio records, by its library with a main loop that a thread
 * of ours runs.
 *
 * Its simple library (libpulse-simple) would be shorter. It keeps a piece of shared memory
 * between two reads, and where the server ends in between, its two threads wait for each other
 * for ever (version 16.1). Here one thread does both, and keeps nothing. */
#include "microphone_internal.h"

#include <library.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { RATE_HZ = 48000, PIECE = 256 /* samples, 5 ms */, FLOAT32_LE = 5 };
enum { ADJUST_LATENCY = 0x2000, NO_AUTOSPAWN = 1 /* of a server that nobody ends */ };
enum { CONTEXT_READY = 4, STREAM_READY = 2 };

struct sample_spec {
    int format;
    uint32_t rate_hz;
    uint8_t channels;
};

/* How much the server keeps before it hands it out. */
struct buffer_attr {
    uint32_t maxlength, tlength, prebuf, minreq, fragsize;
};

static struct {
    void *(*pa_mainloop_new)(void);
    void *(*pa_mainloop_get_api)(void *loop);
    int (*pa_mainloop_iterate)(void *loop, int block, int *result);
    void (*pa_mainloop_wakeup)(void *loop);
    void (*pa_mainloop_free)(void *loop);
    void *(*pa_context_new)(void *api, const char *name);
    int (*pa_context_connect)(void *context, const char *server, int flags, const void *spawn);
    int (*pa_context_get_state)(const void *context);
    void (*pa_context_disconnect)(void *context);
    void (*pa_context_unref)(void *context);
    void *(*pa_stream_new)(void *context, const char *name, const struct sample_spec *spec,
                           const void *map);
    int (*pa_stream_connect_record)(void *stream, const char *device,
                                    const struct buffer_attr *attr, int flags);
    int (*pa_stream_get_state)(const void *stream);
    int (*pa_stream_peek)(void *stream, const void **data, size_t *bytes);
    int (*pa_stream_drop)(void *stream);
    void (*pa_stream_unref)(void *stream);
} pa;

#define PA(function) LIBRARY_FUNCTION(pa, function)
static const struct library_function functions[] = {
    PA(pa_mainloop_new),     PA(pa_mainloop_get_api),  PA(pa_mainloop_iterate),
    PA(pa_mainloop_wakeup),  PA(pa_mainloop_free),     PA(pa_context_new),
    PA(pa_context_connect),  PA(pa_context_get_state), PA(pa_context_disconnect),
    PA(pa_context_unref),    PA(pa_stream_new),        PA(pa_stream_connect_record),
    PA(pa_stream_get_state), PA(pa_stream_peek),       PA(pa_stream_drop),
    PA(pa_stream_unref),
};

struct pulse {
    void *loop, *context, *stream;
    pthread_t thread;
    atomic_bool over;
};

/* Puts what has come. False: the stream has ended. */
static bool pieces_take(struct microphone *m, void *stream)
{
    static const float silence[PIECE];
    const void *data;
    size_t bytes;
    while (pa.pa_stream_get_state(stream) == STREAM_READY) {
        if (pa.pa_stream_peek(stream, &data, &bytes) < 0)
            return false;
        if (bytes == 0)
            return true;
        size_t count = bytes / sizeof(float);
        for (; !data && count > PIECE; count -= PIECE) /* a hole: nothing was recorded */
            microphone_put(m, silence, PIECE);
        microphone_put(m, data ? data : silence, count);
        pa.pa_stream_drop(stream);
    }
    return false;
}

static void *hear(void *context)
{
    struct microphone *m = context;
    struct pulse *p = m->own;
    while (!atomic_load(&p->over))
        if (pa.pa_mainloop_iterate(p->loop, 1, NULL) < 0 || !pieces_take(m, p->stream)) {
            atomic_store(&m->gone, true);
            break;
        }
    return NULL;
}

static void pulse_free(struct pulse *p)
{
    if (p->stream)
        pa.pa_stream_unref(p->stream);
    if (p->context) {
        pa.pa_context_disconnect(p->context);
        pa.pa_context_unref(p->context);
    }
    if (p->loop)
        pa.pa_mainloop_free(p->loop);
    free(p);
}

static void pulse_close(struct microphone *m)
{
    struct pulse *p = m->own;
    atomic_store(&p->over, true);
    pa.pa_mainloop_wakeup(p->loop);
    pthread_join(p->thread, NULL);
    pulse_free(p);
}

/* Runs the loop until a state is reached. Larger states are failures. */
static bool state_reach(void *loop, int (*state)(const void *of), const void *of, int reached)
{
    while (state(of) < reached)
        if (pa.pa_mainloop_iterate(loop, 1, NULL) < 0)
            return false;
    return state(of) == reached;
}

static bool stream_open(struct pulse *p)
{
    const struct sample_spec spec = {FLOAT32_LE, RATE_HZ, 1};
    const struct buffer_attr attr = {UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX,
                                     PIECE * sizeof(float)};
    p->loop = pa.pa_mainloop_new();
    p->context = p->loop ? pa.pa_context_new(pa.pa_mainloop_get_api(p->loop), "lutetia") : NULL;
    if (!p->context || pa.pa_context_connect(p->context, NULL, NO_AUTOSPAWN, NULL) < 0 ||
        !state_reach(p->loop, pa.pa_context_get_state, p->context, CONTEXT_READY))
        return false;
    p->stream = pa.pa_stream_new(p->context, "voice", &spec, NULL);
    return p->stream &&
           pa.pa_stream_connect_record(p->stream, NULL, &attr, ADJUST_LATENCY) >= 0 &&
           state_reach(p->loop, pa.pa_stream_get_state, p->stream, STREAM_READY);
}

bool microphone_pulse_open(struct microphone *m, char *why, size_t room)
{
    const char *missing;
    if (!library_load("libpulse.so.0", functions, sizeof functions / sizeof *functions, &pa,
                      &missing)) {
        snprintf(why, room, "PulseAudio is not installed: install libpulse0");
        return false;
    }
    struct pulse *p = calloc(1, sizeof *p);
    m->own = p;
    m->rate_hz = RATE_HZ;
    if (!p || !stream_open(p) || pthread_create(&p->thread, NULL, hear, m) != 0) {
        snprintf(why, room, "no PulseAudio server runs, or it has no microphone");
        if (p)
            pulse_free(p);
        m->own = NULL;
        return false;
    }
    m->close = pulse_close;
    return true;
}
