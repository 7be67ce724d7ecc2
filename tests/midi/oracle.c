/* oracle.c - see oracle.h. */
#include "oracle.h"

#include "../sample.h"

#include <string.h>

struct placed {
    size_t place;
    struct midi_message message;
};

struct list {
    struct placed *items;
    size_t count;
};

static void list_add(struct list *l, size_t place, const uint8_t *bytes, size_t count)
{
    struct placed *p = &l->items[l->count++];
    p->place = place;
    p->message.time_ns = 0;
    p->message.count = (uint16_t)count;
    memcpy(p->message.bytes, bytes, count);
}

/* The number of a status's data bytes, by the specification's table; -1: no such message. */
static int data_of(uint8_t status)
{
    if (status < 0xf0)
        return status >= 0xc0 && status < 0xe0 ? 1 : 2;
    return status == 0xf1 || status == 0xf3 ? 1 : status == 0xf2 ? 2 : status == 0xf6 ? 0 : -1;
}

/* Adds the pieces of a system exclusive, from its f0 to the byte before the next status, which
 * is at end_place. */
static void sysex_cut(struct list *l, const uint8_t *all, const size_t *places, size_t length,
                      size_t end_place)
{
    uint8_t *whole = malloc(length + 1);
    if (!whole)
        abort();
    memcpy(whole, all, length);
    whole[length] = 0xf7;
    for (size_t at = 0; at < length + 1; at += MIDI_BYTES_MAX) {
        size_t piece = length + 1 - at < MIDI_BYTES_MAX ? length + 1 - at : MIDI_BYTES_MAX;
        bool last = at + piece == length + 1;
        list_add(l, last ? end_place : places[at + piece - 1], whole + at, piece);
    }
    free(whole);
}

static void others_parse(struct list *l, const uint8_t *bytes, const size_t *places,
                         size_t count, size_t end, struct midi_parser_counts *counts)
{
    size_t at = 0;
    while (at < count && bytes[at] < 0x80)
        at++, counts->stray++;
    while (at < count) {
        size_t next = at + 1;
        while (next < count && bytes[next] < 0x80)
            next++;
        const uint8_t status = bytes[at];
        const int data = data_of(status);
        const size_t given = next - at - 1;
        if (status == 0xf0) {
            bool ended = next < count && bytes[next] == 0xf7;
            sysex_cut(l, bytes + at, places + at, next - at, next < count ? places[next] : end);
            counts->broken += !ended;
            next += ended;
            for (; ended && next < count && bytes[next] < 0x80; next++)
                counts->stray++;
        } else if (data < 0) {
            if (status == 0xf7)
                counts->stray++;
            else
                counts->undefined++;
            counts->stray += given;
        } else if (status >= 0xf0) {
            const size_t wanted = (size_t)data;
            if (given >= wanted)
                list_add(l, places[at + wanted], bytes + at, 1 + wanted);
            counts->stray += given > wanted ? given - wanted : 0;
            counts->broken += given < wanted;
        } else {
            const size_t wanted = (size_t)data;
            uint8_t message[3] = {status};
            for (size_t k = 0; k + wanted <= given; k += wanted) {
                memcpy(message + 1, bytes + at + 1 + k, wanted);
                list_add(l, places[at + k + wanted], message, 1 + wanted);
            }
            counts->broken += given == 0 || given % wanted != 0;
        }
        at = next;
    }
}

void oracle_parse(const uint8_t *bytes, size_t count, struct taken *out,
                  struct midi_parser_counts *counts)
{
    struct list real_time = {calloc(count + 1, sizeof(struct placed)), 0};
    struct list others = {calloc(count + 1, sizeof(struct placed)), 0};
    uint8_t *rest = malloc(count + 1);
    size_t *places = calloc(count + 1, sizeof *places), rest_count = 0;
    if (!real_time.items || !others.items || !rest || !places)
        abort();
    *counts = (struct midi_parser_counts){0};
    for (size_t i = 0; i < count; i++) {
        if (bytes[i] == 0xf9 || bytes[i] == 0xfd) {
            counts->undefined++;
        } else if (bytes[i] >= 0xf8) {
            list_add(&real_time, i, bytes + i, 1);
        } else {
            places[rest_count] = i;
            rest[rest_count++] = bytes[i];
        }
    }
    others_parse(&others, rest, places, rest_count, count, counts);
    for (size_t r = 0, o = 0; r < real_time.count || o < others.count;) {
        bool first = o == others.count ||
                     (r < real_time.count && real_time.items[r].place < others.items[o].place);
        taken_add(out, first ? &real_time.items[r++].message : &others.items[o++].message);
    }
    counts->messages = out->count;
    free(real_time.items);
    free(others.items);
    free(rest);
    free(places);
}

void oracle_bytes(uint64_t *seed, uint8_t *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const uint64_t any = sample_word(seed);
        const uint32_t kind = any & 31, low = (uint32_t)(any >> 8) & 0xff;
        if (kind < 18)
            bytes[i] = low & 0x7f;
        else if (kind < 26)
            bytes[i] = (uint8_t)(0x80 | low % 0x70);
        else if (kind < 28)
            bytes[i] = (uint8_t)(0xf8 | low % 8);
        else if (kind < 30)
            bytes[i] = (uint8_t)(0xf0 | low % 8);
        else if (kind == 30) { /* a long system exclusive, whose end may be missing */
            bytes[i] = 0xf0;
            for (size_t length = low * 4; length && i + 1 < count; length--)
                bytes[++i] = sample_word(seed) % 40 ? (uint8_t)(length & 0x7f) : 0xfe;
        } else {
            bytes[i] = 0xf7;
        }
    }
}
