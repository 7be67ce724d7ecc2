/* midi_scene.h - a MIDI server as a process of its own, an instrument on a pseudo-terminal, and
 * programs that listen.
 *
 *     struct midi_scene scene;
 *     if (midi_scene_begin(&scene, &(struct midi_scene_def){.real_time = true}) && midi_scene_listeners(&scene, 16, 0)) {
 *         for (uint32_t i = 0; i < 5000; i++)
 *             midi_scene_play(&scene, i);
 *         ok = midi_scene_wait(&scene, 5000);
 *     }
 *     midi_scene_end(&scene);
 *
 * Message i is a function of i, so each listener knows what must come next, and nothing may be
 * lost, altered or in another order. */
#ifndef LUTETIA_BENCH_MIDI_SCENE_H
#define LUTETIA_BENCH_MIDI_SCENE_H

#include <midi_encoder.h>
#include <midi_time.h>

#include <stdatomic.h>
#include <sys/types.h>

enum { MIDI_LISTENERS_MAX = 16, MIDI_TIMES = 1 << 16 };

/* In memory that all processes share. */
struct midi_listener {
    _Atomic uint32_t heard; /* messages, all as they must be */
    _Atomic uint32_t wrong; /* 1 + the number of the first that was not; 0: none */
    _Atomic uint32_t lost;  /* told by the server */
    _Atomic uint32_t away;  /* how often it was told that the instrument had gone */
    _Atomic uint32_t back;  /* how often that it was there, which is once more */
    _Atomic bool ready;
    struct midi_histogram took; /* from the write at the instrument's end to here */
    struct midi_histogram read; /* from there to the server's read: through the terminal */
};

struct midi_shared {
    _Atomic uint64_t sent_ns[MIDI_TIMES]; /* of message i at i % MIDI_TIMES */
    /* Before message so many the instrument is unplugged, so that ends of notes come; 0: it is
     * not. */
    _Atomic uint32_t unplugged;
    struct midi_listener listeners[MIDI_LISTENERS_MAX];
};

/* Who plays: the other end of a pseudo-terminal, or a program, through the server's loop. */
enum midi_player { MIDI_FROM_INSTRUMENT, MIDI_FROM_PROGRAM };

struct midi_scene_def {
    enum midi_player player;
    /* SCHED_FIFO for the server, the listeners and whoever calls, where that is allowed */
    bool real_time;
    bool may_sleep; /* the server does not keep the processors awake */
    bool terminals_first;
};

struct midi_client;

struct midi_scene {
    struct midi_scene_def def;
    struct midi_client *client; /* the program that plays */
    char folder[64], link[96], path[96];
    pid_t server, listeners[MIDI_LISTENERS_MAX];
    int listeners_count, port; /* port: the instrument's end */
    struct midi_encoder encoder;
    struct midi_shared *shared;
};

/* Starts the server. Errors: false. */
bool midi_scene_begin(struct midi_scene *s, const struct midi_scene_def *def);
/* That many processes that listen, from message `from` on. Errors: false. */
bool midi_scene_listeners(struct midi_scene *s, int count, uint32_t from);
/* Writes message i; returns how many bytes that took, 0: it cannot be written. */
size_t midi_scene_play(struct midi_scene *s, uint32_t i);
struct midi_message midi_scene_message(uint32_t i);
/* Until all listeners have so many, five seconds at most after the last one got something.
 * Errors: false, and what is missing. */
bool midi_scene_wait(struct midi_scene *s, uint32_t count);
/* After message i - 1: once all listeners have it, the instrument is unplugged, and plugged in
 * again when all have been told so. All notes must have been ended then. Errors: false, and
 * what did not happen in five seconds. */
bool midi_scene_replug(struct midi_scene *s, uint32_t i);
void midi_scene_end(struct midi_scene *s);

/* Whether this user may have real-time priority, and keep processors awake. */
bool midi_real_time_allowed(void);
bool midi_awake_allowed(void);
bool midi_terminals_first_allowed(void);

#endif
