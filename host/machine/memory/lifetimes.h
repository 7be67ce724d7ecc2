/* lifetimes.h - how long the contents of fields are needed, counted in calls. run/history.c
 * uses it to find where in a loop the least memory is live. */
#ifndef LUTETIA_MACHINE_LIFETIMES_H
#define LUTETIA_MACHINE_LIFETIMES_H

#include <stdbool.h>
#include <stdint.h>

struct machine;
struct slot;

enum { LIFETIMES = 4096 }; /* calls that are remembered */

struct lifetimes {
    bool noted;     /* lifetimes are recorded */
    uint32_t calls; /* number of calls performed */
    /* Dead bytes are bytes of slots that will be overwritten before they are read again. For
     * each call: how many more are dead after it than after the call before. */
    int32_t dead[LIFETIMES];
};

/* Called at the beginning of each call. */
void lifetimes_call(struct machine *m);

#endif
