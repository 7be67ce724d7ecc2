/* faults.h - a process that ends ends all.
 *
 *     rank 0      a thread looks at a connection to each other rank
 *     others      a thread looks at the one to rank 0
 *
 * The connections are of TCP, and carry nothing. The system closes them when a process ends,
 * however that was. mpirun sees that, too, but other starters leave the rest waiting for ever.
 *
 *     struct faults_door door;
 *     rank 0      faults_open(&door)     ... door is sent to the others ...     faults_meet(names)
 *     others                             faults_join(&door, name of rank 0's computer)
 */
#ifndef LUTETIA_MACHINE_RANKS_FAULTS_H
#define LUTETIA_MACHINE_RANKS_FAULTS_H

#include "ranks/ranks.h"

/* Where rank 0 waits (port 0: nowhere), and what who comes there must know. */
struct faults_door {
    uint8_t secret[16];
    uint32_t port;
};

void faults_open(struct faults_door *door);
/* Waits for all others; then looks on. False: some did not come. */
bool faults_meet(const struct faults_door *door, const char (*names)[RANKS_NAME_BYTES]);
/* Nothing happens where it cannot be reached: rank 0 says so. */
void faults_join(const struct faults_door *door, const char *name, bool same_computer);

#endif
