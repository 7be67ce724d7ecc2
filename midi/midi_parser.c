/* midi_parser.c - see midi_parser.h. */
#include "midi_parser.h"

#include <string.h>

void midi_parser_init(struct midi_parser *p)
{
    *p = (struct midi_parser){0};
}

struct sink {
    uint64_t time_ns;
    midi_take *take;
    void *context;
};

static void give(struct midi_parser *p, struct midi_message *m, const struct sink *sink)
{
    m->time_ns = sink->time_ns;
    p->counts.messages++;
    sink->take(sink->context, m);
}

static void sysex_byte(struct midi_parser *p, uint8_t byte, const struct sink *sink)
{
    p->partial.bytes[p->partial.count++] = byte;
    if (p->partial.count == MIDI_BYTES_MAX || byte == MIDI_SYSEX_END) {
        give(p, &p->partial, sink);
        p->partial.count = 0;
    }
}

/* A status byte other than a real-time one ends the message being read. */
static void break_off(struct midi_parser *p, const struct sink *sink)
{
    if (p->in_sysex)
        sysex_byte(p, MIDI_SYSEX_END, sink);
    if (p->in_sysex || p->partial.count > 1)
        p->counts.broken++;
    p->in_sysex = false;
    p->partial.count = 0;
}

static void status_byte(struct midi_parser *p, uint8_t byte, const struct sink *sink)
{
    const struct midi_row *row = midi_row_of(byte);
    if (row->kind == MIDI_KIND_REAL_TIME) {
        struct midi_message m = {.count = 1, .bytes = {byte}};
        give(p, &m, sink);
        return;
    }
    if (row->kind == MIDI_KIND_UNDEFINED_REAL_TIME) {
        p->counts.undefined++;
        return;
    }
    if (byte == MIDI_SYSEX_END && p->in_sysex) {
        sysex_byte(p, byte, sink);
        p->in_sysex = false;
        return;
    }
    /* A status still waiting for its first data bytes, which is no running status, is
     * dropped. */
    if (!p->in_sysex && p->partial.count == 1)
        p->counts.broken++;
    break_off(p, sink);
    p->running = 0;
    if (byte == MIDI_SYSEX_END) {
        p->counts.stray++;
    } else if (row->kind == MIDI_KIND_UNDEFINED) {
        p->counts.undefined++;
    } else if (byte == MIDI_SYSEX) {
        p->in_sysex = true;
        sysex_byte(p, byte, sink);
    } else {
        p->partial.bytes[0] = byte;
        p->partial.count = 1;
        if (row->data_count == 0) {
            give(p, &p->partial, sink);
            p->partial.count = 0;
        } else {
            p->running = byte;
        }
    }
}

static void data_byte(struct midi_parser *p, uint8_t byte, const struct sink *sink)
{
    if (p->in_sysex) {
        sysex_byte(p, byte, sink);
        return;
    }
    if (!p->running) {
        p->counts.stray++;
        return;
    }
    if (!p->partial.count) { /* running status */
        p->partial.bytes[0] = p->running;
        p->partial.count = 1;
    }
    p->partial.bytes[p->partial.count++] = byte;
    const struct midi_row *row = midi_row_of(p->running);
    if (p->partial.count == 1 + row->data_count) {
        give(p, &p->partial, sink);
        p->partial.count = 0;
        if (row->kind != MIDI_KIND_CHANNEL)
            p->running = 0;
    }
}

void midi_parser_take(struct midi_parser *p, uint64_t time_ns, const uint8_t *bytes,
                      size_t count, midi_take *take, void *context)
{
    const struct sink sink = {time_ns, take, context};
    for (size_t i = 0; i < count; i++) {
        if (bytes[i] >= 0x80)
            status_byte(p, bytes[i], &sink);
        else
            data_byte(p, bytes[i], &sink);
    }
}

void midi_parser_end(struct midi_parser *p, uint64_t time_ns, midi_take *take, void *context)
{
    const struct sink sink = {time_ns, take, context};
    if (!p->in_sysex && p->partial.count == 1)
        p->counts.broken++;
    break_off(p, &sink);
    p->running = 0;
}
