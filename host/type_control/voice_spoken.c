/* voice_spoken.c - which frames are a voice: see voice_align.h.
 *
 *     level     ___.-'''-.__.-''-.______#######____        # noise
 *     periodic      ||||||   ||||                 
 *     spoken      |||||||||||||||||                        loud, and near what is periodic
 */
#include "voice_align.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK_S 0.25       /* of which the quietest frames are the noise */
#define AROUND_BLOCKS 16   /* on each side, for the noise at a block */
#define ABOVE_NOISE 2.0    /* a voice's level, of the noise's */
#define OF_LOUD 0.02       /* and of the loudest but for rare ones */
#define NEAR_S 0.22        /* of a periodic frame */
#define PERIODIC_LEAST 0.1 /* the part of the loud frames, else all of them are a voice */
#define CLOSURE_S 0.13     /* the silence within a stop */
#define PERIODIC_RUN_S 0.03

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double level_percentile(const struct voice_frame *frames, int count, double part,
                               double *room)
{
    for (int i = 0; i < count; i++)
        room[i] = frames[i].level;
    qsort(room, (size_t)count, sizeof *room, ascending);
    return room[(int)(part * (count - 1))];
}

static int frames_in(const struct voice_frame *frames, int count, double seconds)
{
    const double frame_s =
        count > 1 ? (frames[count - 1].time_s - frames[0].time_s) / (count - 1) : 0.01;
    return (int)fmax(1, round(seconds / fmax(frame_s, 1e-4)));
}

/* The level of noise for each block: the least of the blocks around it. */
static void noise_find(const struct voice_frame *frames, int count, int block, double *quiet,
                       double *noise, double *room)
{
    const int blocks = (count + block - 1) / block;
    for (int b = 0; b < blocks; b++) {
        const int from = b * block, n = from + block < count ? block : count - from;
        quiet[b] = level_percentile(frames + from, n, 0.2, room);
    }
    for (int b = 0; b < blocks; b++) {
        noise[b] = quiet[b];
        for (int k = b - AROUND_BLOCKS; k <= b + AROUND_BLOCKS; k++)
            if (k >= 0 && k < blocks)
                noise[b] = fmin(noise[b], quiet[k]);
    }
}

/* Short silences between what is spoken are spoken, too. */
static void closures_fill(bool *spoken, int count, int most)
{
    int last = -1;
    for (int i = 0; i < count; i++) {
        if (!spoken[i])
            continue;
        if (last >= 0 && i - last <= most)
            for (int k = last + 1; k < i; k++)
                spoken[k] = true;
        last = i;
    }
}

/* Marks loud frames that are within `near` frames of a periodic one, and connected to it by
 * loud ones. */
static void periodic_spread(const bool *loud, const bool *periodic, int count, int near,
                            bool *spoken)
{
    for (int way = 1; way >= -1; way -= 2) {
        int since = near + 1;
        for (int k = 0; k < count; k++) {
            const int i = way > 0 ? k : count - 1 - k;
            since = periodic[i] ? 0 : loud[i] ? since + 1 : near + 1;
            spoken[i] = spoken[i] || (loud[i] && since <= near);
        }
    }
}

/* Frames that are periodic by chance stand alone. */
static void periodic_runs_keep(bool *periodic, int count, int least)
{
    for (int i = 0; i < count;) {
        int end = i;
        while (end < count && periodic[end] == periodic[i])
            end++;
        if (periodic[i] && end - i < least)
            memset(periodic + i, 0, (size_t)(end - i) * sizeof *periodic);
        i = end;
    }
}

bool voice_frames_spoken(const struct voice_frame *frames, int count, double silence,
                         bool *spoken)
{
    const int block = frames_in(frames, count, BLOCK_S), blocks = count / block + 1;
    double *room = malloc(sizeof *room * (size_t)(count + 2 * blocks + 1));
    bool *loud = calloc((size_t)count + 1, sizeof *loud),
         *periodic = calloc((size_t)count + 1, sizeof *periodic);
    const bool memory = room && loud && periodic;
    long louds = 0, periodics = 0;
    if (memory && count > 0) {
        double *quiet = room + count, *noise = quiet + blocks;
        const double least =
            fmax(silence, OF_LOUD * level_percentile(frames, count, 0.97, room));
        noise_find(frames, count, block, quiet, noise, room);
        for (int i = 0; i < count; i++) {
            /* a sound that never pauses has no noise: it is quieter than most of the sound */
            const double floor_level = fmin(ABOVE_NOISE * noise[i / block], 6 * least);
            loud[i] = frames[i].level > fmax(least, floor_level);
            periodic[i] = loud[i] && frames[i].pitch_hz > 0;
        }
        periodic_runs_keep(periodic, count, frames_in(frames, count, PERIODIC_RUN_S));
        for (int i = 0; i < count; i++) {
            louds += loud[i];
            periodics += periodic[i];
            spoken[i] = false;
        }
        if ((double)periodics < PERIODIC_LEAST * (double)louds)
            memcpy(spoken, loud, (size_t)count * sizeof *spoken);
        else
            periodic_spread(loud, periodic, count, frames_in(frames, count, NEAR_S), spoken);
        closures_fill(spoken, count, frames_in(frames, count, CLOSURE_S));
    }
    free(room);
    free(loud);
    free(periodic);
    return memory;
}
