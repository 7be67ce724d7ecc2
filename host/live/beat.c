/* beat.c - see beat.h. */
#include "beat.h"

#include <math.h>

enum { START = 0xfa, CONTINUE = 0xfb, STOP = 0xfc };
static const double silent_s = 1;

void beat_take(struct beat *b, const struct midi_message *m)
{
    switch (m->bytes[0]) {
    case START:
        *b = (struct beat){.clocks = -1}; /* the next clock is the beat */
        break;
    case CONTINUE:
        b->stopped = false;
        b->count = 0;
        break;
    case STOP:
        b->stopped = true;
        break;
    case MIDI_CLOCK:
        b->last = (b->last + 1) % BEAT_CLOCKS;
        b->times_ns[b->last] = m->time_ns;
        b->count += b->count < BEAT_CLOCKS;
        b->clocks = (b->clocks + 1) % BEAT_CLOCKS;
        break;
    default:
        break;
    }
}

bool beat_now(const struct beat *b, uint64_t now_ns, double *phase, double *per_minute)
{
    if (b->stopped || b->count < 2)
        return false;
    const uint64_t newest = b->times_ns[b->last],
                   oldest = b->times_ns[(b->last - b->count + 1 + BEAT_CLOCKS) % BEAT_CLOCKS];
    const double since_s = now_ns > newest ? (double)(now_ns - newest) / 1e9 : 0;
    const double spacing_s =
        newest > oldest ? (double)(newest - oldest) / 1e9 / (b->count - 1) : 0;
    if (since_s > silent_s || !(spacing_s > 0))
        return false;
    *phase = fmin((b->clocks + fmin(1, since_s / spacing_s)) / BEAT_CLOCKS, 1);
    *per_minute = 60 / (spacing_s * BEAT_CLOCKS);
    return true;
}
