/* positions.c - converts between positions and times. */
#include "history/history_internal.h"

long history_time(const struct sheet_history *h, struct position position)
{
    long time = position.step;
    for (int i = 0; i < position.op; i++)
        time += h->log.records[i].steps;
    return time;
}

struct position history_position(const struct sheet_history *h, long time, struct position end)
{
    struct position position = {0, 0};
    long passed = 0;
    if (time < 0 || time > history_time(h, end))
        return (struct position){-1, 0};
    while (position_compare(position, end) < 0) {
        int steps = h->log.records[position.op].steps;
        if (steps > 0 && passed + steps > time) { /* a stroke cannot be split */
            if (h->log.records[position.op].kind == SHEET_EVENT_STEP)
                position.step = (int)(time - passed);
            break;
        }
        passed += steps;
        position.op++;
    }
    return position_compare(position, end) < 0 ? position : end;
}

long history_work(const struct sheet_history *h, struct position position)
{
    long work = position.step;
    for (int i = 0; i < position.op; i++)
        work += h->log.records[i].kind == SHEET_EVENT_STEP ? h->log.records[i].steps
                                                           : 1 + h->log.records[i].steps;
    return work;
}
