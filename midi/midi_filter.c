/* midi_filter.c - see midi_filter.h. midi_filter_read.c parses the text of the links. */
#include "midi_filter_internal.h"

#include <stdlib.h>
#include <string.h>

void midi_chain_destroy(struct midi_chain *chain)
{
    if (!chain)
        return;
    for (int i = 0; i < chain->links_count; i++)
        free(chain->links[i].held);
    free(chain);
}

struct sink {
    midi_take *take;
    void *context;
};

static void pass(struct midi_chain *chain, int from, const struct midi_message *m,
                 const struct sink *sink);

static bool is_note(const struct midi_message *m)
{
    return m->bytes[0] >= MIDI_NOTE_OFF && m->bytes[0] < MIDI_CONTROL;
}

/* ---- thinning ---- */

/* A key that identifies the controller or value, if it may be thinned; -1: it may not. */
static int thin_key(const struct midi_message *m)
{
    const int channel = m->bytes[0] & 15, data = m->bytes[1];
    switch (m->bytes[0] & 0xf0) {
    case MIDI_POLY_PRESSURE:
        return channel << 8 | 0x80 | data;
    case MIDI_CONTROL: /* except banks (0, 32), data entry (6, 38), switches and parameter
                        * numbers */
        if ((data >= 1 && data <= 31 && data != 6) || (data >= 70 && data <= 95))
            return channel << 8 | data;
        return -1;
    case MIDI_PRESSURE: /* a mode or reset, which is not thinned */
        return channel << 8 | 120;
    case MIDI_BEND:
        return channel << 8 | 121;
    default:
        return -1;
    }
}

static void thin_release(struct midi_chain *chain, int index, struct midi_held *held,
                         uint64_t now_ns, const struct sink *sink)
{
    const struct midi_message m = held->message;
    held->waits = false;
    held->sent_ns = now_ns;
    pass(chain, index + 1, &m, sink);
}

/* The value of that link that has waited longest, among those selected; NULL: none. channel
 * -1: any. */
static struct midi_held *thin_oldest(struct midi_link *link, int channel, uint64_t due_by_ns)
{
    struct midi_held *oldest = NULL;
    for (int i = 0; i < link->held_count; i++) {
        struct midi_held *h = &link->held[i];
        if (h->waits && (channel < 0 || midi_message_channel(&h->message) == channel) &&
            (due_by_ns == UINT64_MAX || h->sent_ns + link->interval_ns <= due_by_ns) &&
            (!oldest || h->order < oldest->order))
            oldest = h;
    }
    return oldest;
}

/* The value's place, or the place of one that may be sent again; NULL: all are in use. */
static struct midi_held *thin_place(struct midi_link *link, int key, uint64_t now_ns,
                                    bool *known)
{
    struct midi_held *free_one = NULL;
    *known = true;
    for (int i = 0; i < link->held_count; i++) {
        struct midi_held *h = &link->held[i];
        if (h->key == key)
            return h;
        if (!h->waits && h->sent_ns + link->interval_ns <= now_ns)
            free_one = h;
    }
    *known = false;
    if (link->held_count < MIDI_HELD_MAX)
        free_one = &link->held[link->held_count++];
    if (free_one)
        *free_one = (struct midi_held){.key = key};
    return free_one;
}

static void thin_take(struct midi_chain *chain, int index, const struct midi_message *m,
                      const struct sink *sink)
{
    struct midi_link *link = &chain->links[index];
    const int key = thin_key(m), channel = midi_message_channel(m);
    struct midi_held *held;
    bool known;
    if (key < 0) {
        if (channel >= 0)
            while ((held = thin_oldest(link, channel, UINT64_MAX)))
                thin_release(chain, index, held, m->time_ns, sink);
        pass(chain, index + 1, m, sink);
        return;
    }
    held = thin_place(link, key, m->time_ns, &known);
    if (!held || !known || m->time_ns >= held->sent_ns + link->interval_ns) {
        if (held) {
            held->waits = false;
            held->sent_ns = m->time_ns;
        }
        pass(chain, index + 1, m, sink);
        return;
    }
    if (!held->waits)
        held->order = ++chain->order;
    held->waits = true;
    held->message = *m;
}

uint64_t midi_chain_due_ns(const struct midi_chain *chain)
{
    uint64_t due_ns = UINT64_MAX;
    for (int i = 0; i < chain->links_count; i++) {
        const struct midi_link *link = &chain->links[i];
        for (int k = 0; k < link->held_count; k++) {
            const struct midi_held *h = &link->held[k];
            if (h->waits && h->sent_ns + link->interval_ns < due_ns)
                due_ns = h->sent_ns + link->interval_ns;
        }
    }
    return due_ns;
}

void midi_chain_flush(struct midi_chain *chain, uint64_t now_ns, midi_take *take, void *context)
{
    const struct sink sink = {take, context};
    for (int i = 0; i < chain->links_count; i++) {
        struct midi_held *held;
        while ((held = thin_oldest(&chain->links[i], -1, now_ns)))
            thin_release(chain, i, held, now_ns == UINT64_MAX ? held->message.time_ns : now_ns,
                         &sink);
    }
}

/* ---- the others: what passes, and as what ---- */

static void channel_set(struct midi_message *m, int channel)
{
    m->bytes[0] = (uint8_t)((m->bytes[0] & 0xf0) | channel);
}

static bool link_passes(const struct midi_link *link, struct midi_message *m)
{
    const int channel = midi_message_channel(m);
    switch (link->kind) {
    case MIDI_LINK_DROP: /* all pieces of a system exclusive are treated alike */
        return !(link->rows >> (m->bytes[0] < 0x80 || m->bytes[0] == MIDI_SYSEX_END
                                    ? midi_row_of(MIDI_SYSEX) - midi_row_of(0x80)
                                    : midi_row_of(m->bytes[0]) - midi_row_of(0x80)) &
                 1);
    case MIDI_LINK_CHANNELS:
        return channel < 0 || (link->channels >> channel & 1);
    case MIDI_LINK_NOTES:
        return !is_note(m) || (m->bytes[1] >= link->least && m->bytes[1] <= link->most);
    case MIDI_LINK_TRANSPOSE:
        if (is_note(m)) {
            const int note = m->bytes[1] + link->steps;
            if (note < 0 || note >= MIDI_NOTES)
                return false;
            m->bytes[1] = (uint8_t)note;
        }
        return true;
    case MIDI_LINK_VELOCITY:
        if (midi_message_strikes(m))
            m->bytes[2] = link->curve[m->bytes[2]];
        return true;
    case MIDI_LINK_CHANNEL:
        if (channel >= 0)
            channel_set(m, link->channel);
        return true;
    case MIDI_LINK_SPLIT:
        if (is_note(m) && m->bytes[1] < link->least)
            channel_set(m, link->channel);
        return true;
    case MIDI_LINK_THIN:
        break;
    }
    return true;
}

static void pass(struct midi_chain *chain, int from, const struct midi_message *m,
                 const struct sink *sink)
{
    if (from == chain->links_count) {
        sink->take(sink->context, m);
    } else if (chain->links[from].kind == MIDI_LINK_THIN) {
        thin_take(chain, from, m, sink);
    } else {
        struct midi_message changed = *m;
        if (link_passes(&chain->links[from], &changed))
            pass(chain, from + 1, &changed, sink);
    }
}

void midi_chain_take(struct midi_chain *chain, const struct midi_message *m, midi_take *take,
                     void *context)
{
    const struct sink sink = {take, context};
    pass(chain, 0, m, &sink);
}
