/* parts.h - struct machine: one member for each layer; a layer uses only those before it. */
#ifndef LUTETIA_MACHINE_PARTS_H
#define LUTETIA_MACHINE_PARTS_H

#include <pthread.h>

#include "base/settings.h"

/* One member for each layer, from the lowest up. */
struct machine {
    enum machine_status status;
    char error[1024];
    pthread_t owner;
    int inside; /* nesting depth of calls that build, launch or wait: see machine_leave() */
    struct settings settings;
    struct watch *watch; /* NULL: no trace and no explanation */
    struct device *device;
    struct values *values;
    struct plans *plans;
    struct memory *memory;
    struct run *run;
    struct machine *front; /* of the sequencers' machine: the program's; else NULL */
    struct sequencers
        *sequencers; /* NULL: one block, and the front end's functions are called directly */
    struct machine *made_before; /* forks.c; NULL: none */
};

#endif
