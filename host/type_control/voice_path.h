/* voice_path.h - the cheapest way to cut frames into segments, one for each unit, with pauses
 * between some. */
#ifndef LUTETIA_VOICE_PATH_H
#define LUTETIA_VOICE_PATH_H

#include <stdbool.h>

struct voice_path_unit {
    int what;                     /* whose costs its frames have */
    double expected;              /* frames */
    double spread;                /* of the logarithm of its length */
    bool pause_after;             /* there may be one */
    double pause_cost, join_cost; /* of a pause after it, and of none */
};

struct voice_path_def {
    const struct voice_path_unit *units;
    int units_count;
    const double *const
        *costs; /* of what `what` says: of the frames before frame t, t in 0..frames_count */
    const double *pause; /* the same, of a pause */
    int frames_count;
    const int *begins,
        *ends; /* frames about which each unit begins and ends: units_count each */
    int reach; /* frames on each side of these that are looked at */
};

enum voice_path_status {
    VOICE_PATH_OK,
    VOICE_PATH_NONE /* too few frames */,
    VOICE_PATH_NO_MEMORY
};

/* Shape: begin and end: units_count each; end[i] <= begin[i + 1]. */
enum voice_path_status voice_path_find(const struct voice_path_def *def, int *begin, int *end);

#endif
