/* blocks.h - byte code performed on the front end's own thread, over the arrays themselves. */
#ifndef LUTETIA_MACHINE_BLOCKS_H
#define LUTETIA_MACHINE_BLOCKS_H

#include "base/crew.h"
#include "interpret/byte_code.h"

struct machine_value;

/* Registers of each thread, from one run to the next. All zero: none yet. */
struct blocks_room {
    struct blocks_registers {
        void *memory, **at;
        size_t bytes;
        int at_count;
    } of[CREW_MOST];
};

/* buffers: of each node that is an array; all are where the front end can look
 * (device_buffer.host), and the device is not at them. nodes: those that are numbers. In so
 * many parts, shared out among the crew. False: no memory. */
bool blocks_run(struct blocks_room *room, struct crew *crew, int parts,
                const struct byte_code *p, const struct vpset *set,
                struct device_buffer *const *buffers, struct machine_value *const *nodes);
void blocks_room_free(struct blocks_room *room);

#endif
