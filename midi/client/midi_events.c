/* midi_events.c - see midi_events.h. */
#include "midi_events.h"

#include <stdlib.h>

enum { ROOM_USUAL = 64, ROOM_MAX = 1 << 16 };

struct midi_client_event *midi_events_add(struct midi_events *q)
{
    if (q->count == q->room) {
        const size_t room = q->room ? 2 * q->room : ROOM_USUAL;
        struct midi_client_event *grown =
            q->room < ROOM_MAX ? malloc(room * sizeof *grown) : NULL;
        if (!grown) {
            q->lost++;
            return NULL;
        }
        for (size_t i = 0; i < q->count; i++)
            grown[i] = q->ring[(q->first + i) % q->room];
        free(q->ring);
        q->ring = grown;
        q->room = room;
        q->first = 0;
    }
    struct midi_client_event *e = &q->ring[(q->first + q->count++) % q->room];
    e->kind = MIDI_CLIENT_NOTHING;
    e->device = -1;
    e->lost = 0;
    e->text[0] = '\0';
    e->message.count = 0;
    return e;
}

void midi_events_drop(struct midi_events *q)
{
    q->count--;
}

bool midi_events_take(struct midi_events *q, struct midi_client_event *out)
{
    if (!q->count) {
        *out = (struct midi_client_event){.device = -1, .lost = q->lost};
        out->kind = q->lost ? MIDI_CLIENT_LOST : MIDI_CLIENT_NOTHING;
        q->lost = 0;
        return out->lost > 0;
    }
    *out = q->ring[q->first];
    q->first = (q->first + 1) % q->room;
    if (!--q->count && q->room > ROOM_USUAL)
        midi_events_finish(q);
    return true;
}

void midi_events_finish(struct midi_events *q)
{
    free(q->ring);
    q->ring = NULL;
    q->first = q->count = q->room = 0;
}
