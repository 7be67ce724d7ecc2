/* midi_live.c - see midi_live.h.
 *
 * Bounces: masses bounce on a stage that makes 60 pictures a second, as a window does, and each
 * bounce is sent as a note through a server to a program. The time of a bounce is the
 * simulation's, so the wait for the picture in which it happens is part of it.
 *
 * Keys: a program sends notes at moments that do not depend on pictures, through a server to a
 * window of letters; the picture after which there is ink ends the time. */
#include "midi_live.h"
#include "bench.h"
#include "midi_scene.h"

#include <keys_actor.h>
#include <live_player.h>
#include <live_sound.h>
#include <midi_client.h>
#include <springs.h>
#include <stage_window.h>
#include <visible_text.h>

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FPS = 60, MASSES = 8, TIMES_MAX = 400, WAIT_S = 20 };

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Of all rounds, each of `count` times in us, the 50th and the 99th percentile. */
static void times_add(struct bench_report *r, const char *what, double *us, int count,
                      int rounds)
{
    static const char *const names[] = {"p50", "p99"};
    static const double parts[] = {0.5, 0.99};
    double of_round[2][100];
    for (int i = 0; i < rounds; i++) {
        qsort(us + (size_t)i * (size_t)count, (size_t)count, sizeof *us, by_size);
        for (int k = 0; k < 2; k++)
            of_round[k][i] = us[i * count + (int)(parts[k] * count)];
    }
    for (int k = 0; k < 2; k++)
        bench_report_add(r, what, names[k], bench_sample_of(of_round[k], rounds), 1, "us");
}

/* ---- bounces ---- */

struct bounces {
    struct midi_client *client;
    _Atomic int heard, sent;
    uint64_t heard_ns[TIMES_MAX];
    double bounced_s[TIMES_MAX]; /* of the simulation */
    int most;
};

static void *notes_hear(void *context)
{
    struct bounces *b = context;
    struct midi_client_event e;
    while (b->heard < b->most && midi_client_next(b->client, WAIT_S * 1000, &e) == MIDI_OK &&
           e.kind != MIDI_CLIENT_NOTHING)
        if (e.kind == MIDI_CLIENT_MESSAGE && (e.message.bytes[0] & 0xf0) == MIDI_NOTE_ON &&
            e.message.bytes[2] > 0)
            b->heard_ns[b->heard++] = midi_now_ns();
    return NULL;
}

static void bounce_note(void *context, const struct stage_sound *sound)
{
    struct bounces *b = context;
    if (b->sent < b->most)
        b->bounced_s[b->sent++] = sound->time_s;
}

bool midi_live_masses(struct stage **out)
{
    struct stage_springs_def springs = stage_springs_def_default();
    struct stage_def def = stage_def_default();
    if (dyn_network_create(&springs.network) != DYN_OK)
        return false;
    struct dyn_world world = *dyn_network_world(springs.network);
    world.restitution = 1;
    bool ok = dyn_network_world_set(springs.network, &world) == DYN_OK;
    for (int i = 0; i < MASSES; i++) {
        struct dyn_mass mass = dyn_mass_usual();
        mass.x = i;
        mass.y = 0.5 + 0.173 * i;
        ok = ok && dyn_mass_add(springs.network, &mass, NULL) == DYN_OK;
    }
    def.forgets = true;
    if (!ok) {
        dyn_network_destroy(springs.network);
        return false;
    }
    return stage_springs_create(&springs, &def.actor) == STAGE_OK &&
           stage_create(&def, out) == STAGE_OK;
}

/* Plays until so many bounces have been heard. */
static bool bounces_play(struct bounces *b, struct stage *stage, const char *server, double *us)
{
    const struct live_sound_def def = {
        .server = server, .device = "keys", .heard = bounce_note, .context = b};
    struct live_sound *sound;
    if (live_sound_open(&def, &sound) != MIDI_OK)
        return bench_fail("%s", midi_error());
    const uint64_t began_ns = midi_now_ns();
    bool ok = true;
    for (uint64_t picture = 0; ok && b->heard < b->most; picture++) {
        const double now_s = (double)(midi_now_ns() - began_ns) / 1e9,
                     next_s = (double)(picture + 1) / FPS;
        ok = stage_frame(stage, now_s, NULL) == STAGE_OK && now_s < 2 * WAIT_S;
        live_sound_take(sound, stage);
        const double left_s = next_s - (double)(midi_now_ns() - began_ns) / 1e9;
        if (left_s > 0)
            usleep((useconds_t)(1e6 * left_s));
    }
    live_sound_close(sound);
    for (int i = 0; ok && i < b->most; i++)
        us[i] = (double)(b->heard_ns[i] - began_ns) / 1e3 - 1e6 * b->bounced_s[i];
    return ok || bench_fail("bounces are not heard");
}

static bool bounces_round(const char *server, int count, double *us)
{
    const struct midi_client_def def = {.name = "listener", .address = server};
    static struct bounces b;
    struct stage *stage = NULL;
    pthread_t listener;
    b = (struct bounces){.most = count};
    bool ok = midi_client_open(&def, &b.client) == MIDI_OK &&
              midi_client_listen(b.client, "keys", "") == MIDI_OK;
    if (!ok)
        return bench_fail("%s", midi_error());
    ok = midi_live_masses(&stage) || bench_fail("no memory for masses");
    if (ok && pthread_create(&listener, NULL, notes_hear, &b) == 0) {
        ok = bounces_play(&b, stage, server, us);
        b.most = ok ? b.most : 0;
        pthread_join(listener, NULL);
    }
    stage_destroy(stage);
    midi_client_close(b.client);
    return ok;
}

/* ---- keys ---- */

struct shared {
    _Atomic uint64_t sent_ns; /* when the unseen note was sent; 0: none */
    _Atomic bool clear, over; /* clear: the picture has no ink any more */
};

static void notes_send(const char *server, struct shared *shared)
{
    const struct midi_client_def def = {.name = "player", .address = server};
    struct midi_client *client;
    struct midi_client_event e;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (midi_client_open(&def, &client) != MIDI_OK)
        _exit(1);
    for (int i = 0; !shared->over; i++) {
        while (!shared->clear && !shared->over)
            poll(NULL, 0, 1);
        usleep((useconds_t)(3000 + i * 7919 % 17 * 1000 + i * 104729 % 1000));
        const struct midi_message on = midi_message_make(0, MIDI_NOTE_ON,
                                                         (uint8_t)(48 + i * 5 % 25), 127),
                                  off = midi_message_make(0, MIDI_NOTE_OFF, on.bytes[1], 127);
        while (midi_client_next(client, 0, &e) == MIDI_OK && e.kind != MIDI_CLIENT_NOTHING)
            ;
        shared->clear = false;
        shared->sent_ns = midi_now_ns();
        (void)midi_client_send(client, 0, &on);
        while (shared->sent_ns && !shared->over)
            poll(NULL, 0, 1);
        (void)midi_client_send(client, 0, &off);
    }
    _exit(0);
}

static bool has_ink(const struct display_image *image, const struct display_image *empty)
{
    return image->width_px == empty->width_px && image->height_px == empty->height_px &&
           memcmp(image->pixels, empty->pixels,
                  3 * (size_t)image->width_px * (size_t)image->height_px) != 0;
}

/* count times, in us. */
static bool keys_see(struct stage_window *window, struct shared *shared, int count, double *us)
{
    struct display_image image = {0}, empty = {0};
    bool ok = stage_window_turn(window) == STAGE_OK &&
              stage_window_picture(window, &empty) == STAGE_OK;
    const uint64_t until_ns = midi_now_ns() + UINT64_C(1000000000) * 6 * WAIT_S;
    for (int seen = 0; ok && seen < count;) {
        ok = stage_window_turn(window) == STAGE_OK && midi_now_ns() < until_ns;
        const uint64_t drawn_ns = midi_now_ns();
        ok = ok && stage_window_picture(window, &image) == STAGE_OK;
        const bool ink = ok && has_ink(&image, &empty);
        if (ink && shared->sent_ns) {
            us[seen++] = (double)(drawn_ns - shared->sent_ns) / 1e3;
            shared->sent_ns = 0;
        }
        if (!ink && !shared->sent_ns)
            shared->clear = true;
    }
    display_image_destroy(&image);
    display_image_destroy(&empty);
    return ok || bench_fail("keys are not seen in the window");
}

/* The window's stage, made and ended. *shown false: there is no display. */
static bool keys_window(const char *server, struct shared *shared, int count, double *us,
                        bool *shown)
{
    const struct live_source_def source_def = {.server = server, .lowest = 48};
    struct keys_actor_def keys = keys_actor_def_default();
    struct stage_def stage_def = stage_def_default();
    struct stage_window_def window_def = stage_window_def_default();
    struct live_source *source = NULL;
    struct live_player *player = NULL;
    struct stage *stage = NULL;
    struct stage_window *window = NULL;
    bool ok = live_source_open(&source_def, &source) == MIDI_OK &&
              font_face_open("DejaVuSans", 0, &keys.face) == FONT_OK;
    keys.keys.release_s = 0.01;
    ok = ok && keys_actor_create(&keys, &stage_def.actor) == STAGE_OK &&
         stage_create(&stage_def, &stage) == STAGE_OK;
    const struct live_player_def player_def = {.source = source};
    ok = ok && live_player_create(&player_def, stage, &player) == STAGE_OK;
    if (!ok)
        bench_fail("no stage for letters: %s", stage_error());
    window_def.title = "bench midi";
    window_def.width_px = 960;
    window_def.height_px = 360;
    window_def.fps = FPS;
    window_def.before = live_player_before;
    window_def.readable = live_player_readable;
    window_def.context = player;
    *shown = ok && stage_window_create(stage, &window_def, &window) == STAGE_OK;
    if (*shown)
        ok = keys_see(window, shared, count, us);
    stage_window_destroy(window);
    live_player_destroy(player);
    stage_destroy(stage);
    font_face_close(keys.face);
    live_source_close(source);
    return ok;
}

static bool keys_measure(const char *server, int count, double *us, bool *shown)
{
    struct shared *shared =
        mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED)
        return bench_fail("no memory for keys");
    const pid_t child = fork();
    if (child == 0)
        notes_send(server, shared);
    const bool ok = child > 0 && keys_window(server, shared, count, us, shown);
    shared->over = true;
    if (child > 0)
        waitpid(child, NULL, 0);
    munmap(shared, sizeof *shared);
    return ok;
}

bool midi_live_measure(struct bench_report *r, int rounds)
{
    const struct midi_scene_def def = {.player = MIDI_FROM_PROGRAM};
    const int count = (int)bench_many(100, 10), all = rounds < 100 ? rounds : 100;
    double *us = calloc((size_t)all * (size_t)count, sizeof *us);
    struct midi_scene scene;
    bool shown = false;
    if (!us)
        return bench_fail("no memory for %d rounds", all);
    bool ok = midi_scene_begin(&scene, &def);
    for (int i = 0; ok && i < all; i++)
        ok = bounces_round(scene.path, count, us + (size_t)i * (size_t)count);
    if (ok)
        times_add(r, "from a bounce to its note", us, count, all);
    ok = ok && keys_measure(scene.path, all * count, us, &shown);
    if (ok && shown)
        times_add(r, "from a key to its picture", us, count, all);
    else if (ok)
        visible_say("lutetia bench midi: there is no display; rows of pictures are missing");
    midi_scene_end(&scene);
    free(us);
    return ok;
}
