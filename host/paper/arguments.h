/* arguments.h - structs for the arguments of operations whose public functions take them one by
 * one. The other operations' arguments are structs of the public headers.
 * paper_history_arguments() gives either. */
#ifndef LUTETIA_PAPER_ARGUMENTS_H
#define LUTETIA_PAPER_ARGUMENTS_H

#include "brush.h"
#include "sheet.h"
#include "techniques.h"

struct event_put {
    struct paper_place place;
    double amount[1 + PAPER_PIGMENTS_MAX];
};

struct event_blot {
    struct paper_place place;
    double part, lift;
};

struct event_resist {
    struct paper_place place;
    bool on;
};

struct event_layer {
    int layer, pigment;
    const float *values; /* one for each fiber */
};

#endif
