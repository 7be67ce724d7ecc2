/* midi_real_time.c - see midi_real_time.h. */
#include "midi_real_time.h"

#include <errno.h>
#include <sched.h>
#include <stdio.h>
#include <string.h>

bool midi_real_time_begin(char said[MIDI_REAL_TIME_TEXT])
{
    const struct sched_param priority = {.sched_priority = MIDI_REAL_TIME_PRIORITY};
    const bool begun = sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &priority) == 0;
    if (begun)
        snprintf(said, MIDI_REAL_TIME_TEXT, "real-time priority %d", MIDI_REAL_TIME_PRIORITY);
    else
        snprintf(said, MIDI_REAL_TIME_TEXT,
                 "usual priority: real time is not allowed (%s; `ulimit -r`)", strerror(errno));
    return begun;
}
