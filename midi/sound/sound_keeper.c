/* sound_keeper.c - see sound_keeper.h. */
#include "sound_keeper.h"

#include <midi_internal.h>
#include <midi_time.h>

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>

enum { LOOK_MS = 500, LOOKS_STILL = 6 }; /* as often nothing is taken, and the server is gone */

enum server { SERVER_THERE, SERVER_GONE, SERVER_BACK };

struct sound_keeper {
    struct sound *sound;
    pthread_t thread;
    pthread_mutex_t mutex;
    pthread_cond_t wake;
    bool running, ending; /* ending: of the mutex */
    atomic_int server;    /* enum server, as the thread has seen it */
    int said;             /* what it was at the last call */
};

/* Until the next look. False: the end. */
static bool look_wait(struct sound_keeper *k)
{
    const uint64_t until = midi_now_ns() + LOOK_MS * 1000000u;
    const struct timespec t = {(time_t)(until / 1000000000u), (long)(until % 1000000000u)};
    pthread_mutex_lock(&k->mutex);
    while (!k->ending && midi_now_ns() < until)
        pthread_cond_timedwait(&k->wake, &k->mutex, &t);
    const bool on = !k->ending;
    pthread_mutex_unlock(&k->mutex);
    return on;
}

static void *keeper_run(void *context)
{
    struct sound_keeper *k = context;
    unsigned taken_ms = sound_taken_ms(k->sound);
    bool gone = atomic_load(&k->server) == SERVER_GONE;
    int still = gone ? LOOKS_STILL : 0;
    while (look_wait(k)) {
        const unsigned now_ms = sound_taken_ms(k->sound);
        still = now_ms == taken_ms ? still + 1 : 0;
        taken_ms = now_ms;
        if (gone && still == 0) {
            gone = false;
            atomic_store(&k->server, SERVER_BACK);
        }
        if (still < LOOKS_STILL)
            continue;
        if (!gone)
            atomic_store(&k->server, SERVER_GONE);
        gone = true;
        if (sound_listen_again(k->sound) == MIDI_OK)
            still = 0; /* the next looks say whether it is heard */
        taken_ms = sound_taken_ms(k->sound);
    }
    return NULL;
}

static enum midi_status keeper_begin(struct sound *sound, enum server server,
                                     struct sound_keeper **out)
{
    pthread_condattr_t monotonic;
    struct sound_keeper *k = calloc(1, sizeof *k);
    if (!k)
        return midi_fail(MIDI_NO_MEMORY, "no memory for sounds");
    k->sound = sound;
    k->said = (int)server;
    atomic_store(&k->server, (int)server);
    pthread_mutex_init(&k->mutex, NULL); /* on Linux it cannot fail, nor can the others */
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_cond_init(&k->wake, &monotonic);
    pthread_condattr_destroy(&monotonic);
    k->running = pthread_create(&k->thread, NULL, keeper_run, k) == 0;
    if (!k->running) {
        sound_keeper_end(k);
        return midi_fail(MIDI_NO_MEMORY, "no thread for sounds");
    }
    *out = k;
    return MIDI_OK;
}

enum midi_status sound_keeper_begin(struct sound *sound, struct sound_keeper **out)
{
    *out = NULL;
    return sound_is_live(sound) ? keeper_begin(sound, SERVER_THERE, out) : MIDI_OK;
}

enum midi_status sound_keeper_wait(struct sound *sound, struct sound_keeper **out)
{
    *out = NULL;
    return keeper_begin(sound, SERVER_GONE, out);
}

void sound_keeper_end(struct sound_keeper *k)
{
    if (!k)
        return;
    if (k->running) {
        pthread_mutex_lock(&k->mutex);
        k->ending = true;
        pthread_cond_signal(&k->wake);
        pthread_mutex_unlock(&k->mutex);
        pthread_join(k->thread, NULL);
    }
    pthread_cond_destroy(&k->wake);
    pthread_mutex_destroy(&k->mutex);
    free(k);
}

const char *sound_keeper_said(struct sound_keeper *k)
{
    const int now = k ? atomic_load(&k->server) : SERVER_THERE;
    if (!k || now == k->said)
        return NULL;
    k->said = now;
    return now == SERVER_GONE ? "the sound server is gone; it is looked for"
                              : "the sound server is back";
}
