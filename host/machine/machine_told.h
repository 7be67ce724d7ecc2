/* machine_told.h - what a machine tells of its work: how long the front end did it, and
 * messages that were lost.
 *
 *     machine_work_time (m, true);
 *     ...
 *     machine_stats_get (m, &stats);           stats.busy_s counts that time, too
 *
 *     if (machine_sent_beyond (m))             true once
 *         ... say so ...
 *
 * Errors: none. Threads: as machine.h. */
#ifndef LUTETIA_MACHINE_TOLD_H
#define LUTETIA_MACHINE_TOLD_H

#include <stdbool.h>

struct machine;

/* Whether machine_stats.busy_s counts all that the front end computes in the device's place. At
 * first it counts byte code only: short work takes twice as long where it is timed. */
void machine_work_time(struct machine *m, bool timed);

/* Whether a message of some send went to no processor, and was lost; true once, then nobody
 * looks any more. Sends by kernels are looked at for the first times, and ever more rarely. */
bool machine_sent_beyond(struct machine *m);

#endif
