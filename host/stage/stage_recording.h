/* stage_recording.h - films of what a stage's window shows.
 *
 *     stage_recording_toggle(&recording, &def, renderer);      // V
 *     while (...)
 *         stage_recording_add(&recording, renderer, input_now_s());   // after each picture
 *     stage_recording_finish(&recording);                      // the film is whole
 *
 * An encoder takes a second to end a film. A thread waits for it, and the stage goes on.
 *
 * Threads: all functions belong to the window's. */
#ifndef LUTETIA_STAGE_RECORDING_H
#define LUTETIA_STAGE_RECORDING_H

#include "renderer.h"
#include "stage_window.h"

#include <video.h>

#include <pthread.h>
#include <stdatomic.h>

/* A film that is being ended. */
struct stage_ending {
    bool runs; /* there is one, and its thread */
    pthread_t thread;
    struct video *video;
    int sound; /* a descriptor; -1: none */
    long pictures;
    char silent[160]; /* why it has no sound; empty: it has, or none was wanted */
    _Atomic bool ended;
    bool whole;    /* once it has ended */
    char why[240]; /* why not */
    char path[512];
};

/* All zero: no film has been recorded. */
struct stage_recording {
    const struct stage_window_def *def; /* the window's */
    struct video *video;                /* NULL: nothing is recorded */
    struct display_image image;
    double next_s, began_s; /* pictures are at times that are a thirtieth apart */
    struct stage_ending ending;
    char recorded[512], said[240];
};

/* Begins a film, or ends the one that runs. */
void stage_recording_toggle(struct stage_recording *r, const struct stage_window_def *def,
                            struct stage_renderer *renderer);
/* Adds the picture that the renderer has drawn, for all frames due until now. */
void stage_recording_add(struct stage_recording *r, struct stage_renderer *renderer,
                         double now_s);
/* What is to be told since it was asked last; NULL: nothing. Valid until the next call. */
const char *stage_recording_told(struct stage_recording *r);
/* Ends the film that runs, and waits until it is whole. */
void stage_recording_end(struct stage_recording *r);
/* The same, and frees what it keeps. */
void stage_recording_finish(struct stage_recording *r);

#endif
