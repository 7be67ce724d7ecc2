/* live_sound.c - see live_sound.h.
 *
 *     stage's thread    events -> messages -> waiting (ordered by time: a note's end waits
 *                       there)
 *     player's thread                          waiting -> synthesizer, MIDI server
 */
#include "live_sound.h"
#include "live_recording.h"

#include <midi_client.h>
#include <midi_internal.h>
#include <midi_message.h>
#include <sound_keeper.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { AT_ONCE = 64, WAITING_MAX = 4096, NAME_MAX_BYTES = 64, CHANNELS = 16 };
enum { ALL_NOTES_OFF = 123 };

struct waiting {
    struct midi_message message;
    bool song; /* of the song, and not of the stage */
};

struct live_sound {
    struct sound *synth, *song;
    struct sound_keeper *synth_keeper, *song_keeper;
    struct midi_client *client;
    char device[NAME_MAX_BYTES];
    pthread_t player;
    bool playing, mutex_made, wake_made;
    pthread_mutex_t mutex; /* of what follows */
    pthread_cond_t wake;
    struct waiting waiting[WAITING_MAX]; /* ascending times, by the monotonic clock */
    int waiting_count;
    bool ending;
    /* of the stage's thread */
    void (*heard)(void *context, const struct stage_sound *sound);
    void *heard_context;
    bool song_lost; /* messages of the song: its notes have to end */
    long played, dropped;
    char silent[300]; /* why nothing is heard yet */
    struct live_recording recording;
};

static uint64_t now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}

/* ---- the player's thread ---- */

static void message_play(struct live_sound *s, const struct waiting *w)
{
    const struct midi_message *m = &w->message;
    struct midi_client_event event;
    struct midi_message at_once = *m;
    at_once.time_ns = 0;
    if (w->song) {
        sound_message(s->song, m);
        return;
    }
    if (s->synth)
        sound_message(s->synth, m);
    if (!s->client)
        return;
    while (midi_client_next(s->client, 0, &event) == MIDI_OK &&
           event.kind != MIDI_CLIENT_NOTHING)
        ; /* devices that come and go, a server that is gone and back */
    const int device = midi_client_device(s->client, s->device);
    if (device >= 0)
        (void)midi_client_send(s->client, device, &at_once);
}

/* Takes the first message that is due, or waits for it. False: the end. */
static bool message_next(struct live_sound *s, struct waiting *out)
{
    pthread_mutex_lock(&s->mutex);
    for (;;) {
        const bool due = s->waiting_count > 0 && s->waiting[0].message.time_ns <= now_ns();
        if (due || (s->ending && s->waiting_count > 0)) /* at the end all notes end at once */
            break;
        if (s->ending) {
            pthread_mutex_unlock(&s->mutex);
            return false;
        }
        if (s->waiting_count == 0) {
            pthread_cond_wait(&s->wake, &s->mutex);
            continue;
        }
        const uint64_t until = s->waiting[0].message.time_ns;
        const struct timespec t = {(time_t)(until / 1000000000u), (long)(until % 1000000000u)};
        pthread_cond_timedwait(&s->wake, &s->mutex, &t);
    }
    *out = s->waiting[0];
    memmove(s->waiting, s->waiting + 1, (size_t)--s->waiting_count * sizeof *s->waiting);
    pthread_mutex_unlock(&s->mutex);
    return true;
}

static void *player_run(void *context)
{
    struct live_sound *s = context;
    struct waiting next;
    while (message_next(s, &next))
        message_play(s, &next);
    return NULL;
}

/* ---- the stage's thread ---- */

static void waiting_put(struct live_sound *s, const struct midi_message *m, bool song)
{
    int at = s->waiting_count;
    while (at > 0 && s->waiting[at - 1].message.time_ns > m->time_ns)
        at--;
    memmove(s->waiting + at + 1, s->waiting + at,
            (size_t)(s->waiting_count - at) * sizeof *s->waiting);
    s->waiting[at] = (struct waiting){*m, song};
    s->waiting_count++;
}

static void event_play(struct live_sound *s, const struct sound_event *e)
{
    struct midi_message messages[3];
    live_recording_add(&s->recording, e, now_ns());
    sound_event_messages(e, now_ns(), messages);
    pthread_mutex_lock(&s->mutex);
    const bool room = s->waiting_count + 3 <= WAITING_MAX; /* a note has its end, too */
    for (int i = 0; i < 3 && room; i++)
        waiting_put(s, &messages[i], false);
    pthread_cond_signal(&s->wake);
    pthread_mutex_unlock(&s->mutex);
    s->played += room;
    s->dropped += !room;
}

/* A player that hangs is behind: what has no room is dropped, and all its notes end once there
 * is room again. */
void live_sound_song(struct live_sound *s, const struct midi_message *m, double late_s)
{
    if (!s || !s->song)
        return;
    struct midi_message at = *m;
    at.time_ns = now_ns() + LIVE_SONG_LATE_MS * 1000000u;
    at.time_ns -= (uint64_t)(1e9 * fmin(LIVE_SONG_LATE_MS / 1e3, fmax(0, late_s)));
    pthread_mutex_lock(&s->mutex);
    const bool room = s->waiting_count + CHANNELS + 1 <= WAITING_MAX;
    for (int i = 0; i < CHANNELS && room && s->song_lost; i++) {
        const struct midi_message end =
            midi_message_make(at.time_ns, (uint8_t)(MIDI_CONTROL | i), ALL_NOTES_OFF, 0);
        waiting_put(s, &end, true);
    }
    if (room)
        waiting_put(s, &at, true);
    s->song_lost = !room;
    s->dropped += !room;
    pthread_cond_signal(&s->wake);
    pthread_mutex_unlock(&s->mutex);
}

void live_sound_take(struct live_sound *s, struct stage *stage)
{
    if (!s)
        return;
    const struct stage_actor actor = stage_actor(stage);
    if (!actor.kind->heard || !actor.kind->extent)
        return;
    const struct font_box extent = actor.kind->extent(actor.self);
    struct stage_sound heard[AT_ONCE];
    struct sound_event e;
    for (int count; (count = actor.kind->heard(actor.self, heard, AT_ONCE)) > 0;)
        for (int i = 0; i < count; i++) {
            if (s->heard)
                s->heard(s->heard_context, &heard[i]);
            if (live_sound_event(&heard[i], &extent, &e))
                event_play(s, &e);
        }
}

const char *live_sound_said(struct live_sound *s)
{
    return s ? sound_keeper_said(s->synth_keeper) : NULL;
}

const char *live_sound_silent(const struct live_sound *s)
{
    return s->silent[0] ? s->silent : NULL;
}

long live_sound_played(const struct live_sound *s)
{
    return s->played;
}

long live_sound_dropped(const struct live_sound *s)
{
    return s->dropped;
}

void live_sound_record(struct live_sound *s)
{
    live_recording_begin(&s->recording, now_ns());
}

enum midi_status live_sound_recorded(struct live_sound *s, struct midi_song *song,
                                     double song_s, int *file)
{
    return live_recording_end(&s->recording, now_ns(), song, song_s, file);
}

/* ---- life ---- */

static enum midi_status synth_open(struct live_sound *s, const char *driver, bool waits,
                                   struct sound **out, struct sound_keeper **keeper)
{
    struct sound_def def = sound_def_default();
    def.room = true;
    enum midi_status status = sound_create(&def, out);
    if (status == MIDI_OK)
        status = driver ? sound_listen(*out, driver) : sound_listen_any(*out);
    else
        waits = false; /* what is missing here does not come */
    if (status == MIDI_NO_DEVICE && waits) {
        snprintf(s->silent, sizeof s->silent, "%.250s; it is looked for", midi_error());
        return sound_keeper_wait(*out, keeper);
    }
    return status == MIDI_OK ? sound_keeper_begin(*out, keeper) : status;
}

static enum midi_status device_open(struct live_sound *s, const struct live_sound_def *def)
{
    struct midi_client_def client = midi_client_def_default("springs");
    client.address = def->server;
    if (strlen(def->device) >= sizeof s->device)
        return midi_fail(MIDI_BAD_ARGUMENT, "a device has no name so long: '%.40s...'",
                         def->device);
    strcpy(s->device, def->device);
    enum midi_status status = midi_client_open(&client, &s->client);
    if (status == MIDI_OK && midi_client_device(s->client, s->device) < 0)
        status = midi_fail(
            MIDI_NO_DEVICE,
            "the MIDI server has no device '%.40s'; `lutetia midi devices` lists them",
            s->device);
    return status;
}

/* The sounds of the kinds' channels are set first. */
static enum midi_status player_begin(struct live_sound *s)
{
    pthread_condattr_t monotonic;
    for (int i = 0; i < SOUND_KINDS; i++)
        s->waiting[s->waiting_count++].message = sound_kind_program((enum sound_kind)i);
    s->mutex_made = pthread_mutex_init(&s->mutex, NULL) == 0;
    if (pthread_condattr_init(&monotonic) == 0) {
        pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
        s->wake_made = pthread_cond_init(&s->wake, &monotonic) == 0;
        pthread_condattr_destroy(&monotonic);
    }
    s->playing =
        s->mutex_made && s->wake_made && pthread_create(&s->player, NULL, player_run, s) == 0;
    return s->playing ? MIDI_OK : midi_fail(MIDI_NO_MEMORY, "no thread for sounds");
}

enum midi_status live_sound_open(const struct live_sound_def *def, struct live_sound **out)
{
    struct live_sound *s = calloc(1, sizeof *s);
    *out = NULL;
    if (!s)
        return midi_fail(MIDI_NO_MEMORY, "no memory for sounds");
    s->heard = def->heard;
    s->heard_context = def->context;
    enum midi_status status =
        def->synth ? synth_open(s, def->driver, def->waits, &s->synth, &s->synth_keeper)
                   : MIDI_OK;
    if (status == MIDI_OK && def->synth && def->song)
        status = synth_open(s, def->song_driver ? def->song_driver : def->driver, def->waits,
                            &s->song, &s->song_keeper);
    if (status == MIDI_OK && def->device)
        status = device_open(s, def);
    if (status == MIDI_OK)
        status = player_begin(s);
    if (status != MIDI_OK) {
        live_sound_close(s);
        return status;
    }
    *out = s;
    return MIDI_OK;
}

void live_sound_close(struct live_sound *s)
{
    if (!s)
        return;
    if (s->playing) {
        pthread_mutex_lock(&s->mutex);
        s->ending = true;
        pthread_cond_signal(&s->wake);
        pthread_mutex_unlock(&s->mutex);
        pthread_join(s->player, NULL);
    }
    if (s->wake_made)
        pthread_cond_destroy(&s->wake);
    if (s->mutex_made)
        pthread_mutex_destroy(&s->mutex);
    midi_client_close(s->client);
    sound_keeper_end(s->synth_keeper);
    sound_keeper_end(s->song_keeper);
    sound_destroy(s->synth);
    sound_destroy(s->song);
    live_recording_finish(&s->recording);
    free(s);
}
