/* served.h - ranks above 0. */
#ifndef LUTETIA_MACHINE_SERVED_H
#define LUTETIA_MACHINE_SERVED_H

#include <stdint.h>

/* What a rank says of the machine that it made. */
struct served_made {
    uint32_t status; /* enum machine_status */
    char device[256], error[512];
    uint64_t memory_bytes;
    uint32_t near; /* the rank sees its arrays, and computes with them itself */
};

/* Performs rank 0's commands until the last one. What cannot be performed ends the process,
 * with a line. */
void served_perform(void);

#endif
