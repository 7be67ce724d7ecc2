/* live_sound_event.c - sounds of a stage as events: see live_sound.h. */
#include "live_sound.h"

#include <math.h>

enum { LOUDEST = 127, CLANK_PER_SPEED = 20 };

/* A clank's strength is a speed; the usual strength of other sounds is 1. */
static int velocity_of(enum sound_kind kind, double strength)
{
    if (kind == SOUND_CLANK)
        return (int)fmin(LOUDEST, CLANK_PER_SPEED * strength);
    return (int)(LOUDEST * (1 - exp(-1.5 * fmax(strength, 0))));
}

bool live_sound_event(const struct stage_sound *heard, const struct font_box *extent,
                      struct sound_event *out)
{
    const int kind = sound_kind_read(heard->name);
    if (kind < 0)
        return false;
    const double width = fmax(extent->x1 - extent->x0, 1e-9),
                 across = fmin(fmax((heard->x - extent->x0) / width, 0), 1);
    *out = (struct sound_event){.kind = (enum sound_kind)kind,
                                .time_s = fmax(heard->time_s, 0),
                                .velocity = velocity_of((enum sound_kind)kind, heard->strength),
                                .height = 0.25 + 0.5 * across,
                                .side = 1.4 * (across - 0.5)};
    return true;
}
