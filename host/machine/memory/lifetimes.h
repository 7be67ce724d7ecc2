/* lifetimes.h - how long what fields hold is wanted, by calls: run/history.c looks for where in a loop least is. */
#ifndef LUTETIA_MACHINE_LIFETIMES_H
#define LUTETIA_MACHINE_LIFETIMES_H

#include <stdbool.h>
#include <stdint.h>

struct machine;
struct slot;

enum { LIFETIMES = 4096 }; /* calls that are remembered */

struct lifetimes {
    bool noted;     /* somebody wants to know */
    uint32_t calls; /* performed so far */
    /* Bytes of slots that are overwritten before they are read again, after so many calls: how many more than one
     * call before. */
    int32_t dead[LIFETIMES];
};

/* Another call begins. */
void lifetimes_call(struct machine *m);
/* In the call that is being performed. */
void lifetimes_accessed(struct machine *m, struct slot *slot, bool overwrites);

#endif
