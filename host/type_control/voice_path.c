/* voice_path.c - see voice_path.h.
 *
 * For the beginning of each unit, and for its end, a window of frames is looked at:
 *
 *     frames           0 1 2 3 4 5 6 7 8 9
 *     unit 0 begins    [     ]                 cost of all before, where unit 0 begins at this frame
 *     unit 0 ends        [     ]               ... = the least over the lengths of unit 0
 *     unit 1 begins              [     ]       ... = the least over the lengths of the pause between, or of none
 *
 * Where there can be no pause a unit begins in the window in which the one before ends. */
#include "voice_path.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { LENGTH_MOST = 4000 };
#define LONGEST 4.0 /* of what is expected */

struct search {
    const struct voice_path_def *def;
    int window;
    int *begins, *ends; /* first frames of the windows */
    double *now, *next; /* costs of a window */
    uint16_t *length;   /* of the unit that ends at a frame of its window */
    int *pause_row;     /* of the pause before a unit: its row, or -1 */
    int32_t *pause;     /* its length, for each frame of the window in which the unit begins */
    double length_cost[LENGTH_MOST + 1];
};

static int window_low(const struct search *s, int about, int least)
{
    const int low = about - s->window / 2, most = s->def->frames_count + 1 - s->window;
    const int within = low < 0 ? 0 : low > most ? most : low;
    return within < least ? least : within;
}

static bool windows_make(struct search *s)
{
    const struct voice_path_def *d = s->def;
    const int whole = d->frames_count + 1, wide = 2 * d->reach + 1;
    const size_t units = (size_t)d->units_count;
    int pauses = 0, least = 0;
    s->window = wide < whole ? wide : whole;
    s->begins = malloc(sizeof *s->begins * units);
    s->ends = malloc(sizeof *s->ends * units);
    s->pause_row = malloc(sizeof *s->pause_row * units);
    s->now = malloc(sizeof *s->now * (size_t)s->window);
    s->next = malloc(sizeof *s->next * (size_t)s->window);
    s->length = calloc(units * (size_t)s->window, sizeof *s->length);
    if (!s->begins || !s->ends || !s->pause_row || !s->now || !s->next || !s->length)
        return false;
    for (int k = 0; k < d->units_count; k++) {
        const bool pause = k > 0 && d->units[k - 1].pause_after;
        s->pause_row[k] = pause ? pauses++ : -1;
        s->begins[k] = k > 0 && !pause ? least : window_low(s, d->begins[k], least);
        s->ends[k] = least = window_low(s, d->ends[k], s->begins[k]);
    }
    s->pause = calloc((size_t)pauses * (size_t)s->window + 1, sizeof *s->pause);
    return s->pause != NULL;
}

static void search_finish(struct search *s)
{
    free(s->begins);
    free(s->ends);
    free(s->pause_row);
    free(s->now);
    free(s->next);
    free(s->length);
    free(s->pause);
}

/* The cost of each length of a unit. Returns the longest. */
static int lengths_cost(struct search *s, const struct voice_path_unit *u)
{
    const int longest = (int)fmin(LENGTH_MOST, ceil(LONGEST * u->expected) + 2);
    for (int n = 1; n <= longest; n++) {
        const double far = log(n / u->expected) / u->spread;
        s->length_cost[n] = 0.5 * far * far;
    }
    return longest;
}

/* From the costs of unit k's beginnings to those of its ends. */
static void unit_go(struct search *s, int k)
{
    const struct voice_path_unit *u = &s->def->units[k];
    const double *cost = s->def->costs[u->what];
    const int longest = lengths_cost(s, u), from = s->begins[k], to = s->ends[k];
    uint16_t *length = s->length + (size_t)k * (size_t)s->window;
    for (int i = 0; i < s->window; i++) {
        const int t = to + i;
        double best = INFINITY;
        int best_n = 0;
        int n = t - (from + s->window - 1); /* the shortest from a frame in the window */
        const int last = t - from < longest ? t - from : longest;
        for (n = n < 1 ? 1 : n; n <= last; n++) {
            const double all = s->now[t - n - from] - cost[t - n] + s->length_cost[n];
            if (all < best) {
                best = all;
                best_n = n;
            }
        }
        s->next[i] = best + cost[t];
        length[i] = (uint16_t)best_n;
    }
}

/* From the costs of unit k - 1's ends to those of unit k's beginnings. */
static void pause_go(struct search *s, int k)
{
    const struct voice_path_unit *before = &s->def->units[k - 1];
    const double *quiet = s->def->pause;
    int32_t *pause = s->pause + (size_t)s->pause_row[k] * (size_t)s->window;
    const int from = s->ends[k - 1], to = s->begins[k], end = from + s->window;
    double best = INFINITY; /* of a pause that has begun */
    int best_t = 0, t = from;
    for (int i = 0; i < s->window; i++) {
        for (; t < to + i && t < end; t++) {
            const double begins = s->now[t - from] + before->pause_cost - quiet[t];
            if (begins < best) {
                best = begins;
                best_t = t;
            }
        }
        const double open = best + quiet[to + i],
                     joined =
                         to + i < end ? s->now[to + i - from] + before->join_cost : INFINITY;
        pause[i] = open < joined ? to + i - best_t : 0;
        s->next[i] = open < joined ? open : joined;
    }
}

static void swap(struct search *s)
{
    double *now = s->now;
    s->now = s->next;
    s->next = now;
}

static enum voice_path_status back(const struct search *s, int *begin, int *end)
{
    const struct voice_path_def *d = s->def;
    const int last = d->units_count - 1;
    double best = INFINITY;
    int t = -1;
    for (int i = 0; i < s->window; i++) { /* a pause after the last unit is free */
        const double all = s->now[i] + d->pause[d->frames_count] - d->pause[s->ends[last] + i];
        if (all < best) {
            best = all;
            t = s->ends[last] + i;
        }
    }
    if (t < 0)
        return VOICE_PATH_NONE;
    for (int k = last; k >= 0; k--) {
        end[k] = t;
        t -= s->length[(size_t)k * (size_t)s->window + (size_t)(t - s->ends[k])];
        begin[k] = t;
        if (s->pause_row[k] >= 0)
            t -= s->pause[(size_t)s->pause_row[k] * (size_t)s->window +
                          (size_t)(t - s->begins[k])];
    }
    return VOICE_PATH_OK;
}

enum voice_path_status voice_path_find(const struct voice_path_def *def, int *begin, int *end)
{
    struct search *s = calloc(1, sizeof *s);
    enum voice_path_status status = VOICE_PATH_NO_MEMORY;
    if (s)
        s->def = def;
    if (s && windows_make(s)) {
        for (int i = 0; i < s->window; i++) /* nor does one before the first cost anything */
            s->now[i] = def->pause[s->begins[0] + i];
        for (int k = 0; k < def->units_count; k++) {
            if (s->pause_row[k] >= 0) {
                pause_go(s, k);
                swap(s);
            }
            unit_go(s, k);
            swap(s);
        }
        status = back(s, begin, end);
    }
    if (s)
        search_finish(s);
    free(s);
    return status;
}
