/* parts.h - a machine: one part for each layer, each of which knows only those before it. */
#ifndef LUTETIA_MACHINE_PARTS_H
#define LUTETIA_MACHINE_PARTS_H

#include <pthread.h>

#include "base/settings.h"

/* One member a layer, each above those before it. */
struct machine {
    enum machine_status status;
    char error[1024];
    pthread_t owner;
    int inside; /* calls that build, launch or wait: see machine_leave() */
    struct settings settings;
    struct watch *watch; /* NULL: nobody looks */
    struct device *device;
    struct values *values;
    struct plans *plans;
    struct memory *memory;
    struct run *run;
};

#endif
