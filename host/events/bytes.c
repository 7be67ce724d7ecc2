/* bytes.c - see bytes.h. */
#include "bytes.h"

#include <stdlib.h>
#include <string.h>

void event_put_bytes(struct event_bytes *b, const void *bytes, size_t count)
{
    if (b->short_of_memory || count == 0)
        return;
    if (count > b->room - b->count) {
        size_t room = b->room ? b->room : 256;
        while (room - b->count < count)
            room *= 2;
        uint8_t *grown = realloc(b->at, room);
        if (!grown) {
            b->short_of_memory = true;
            return;
        }
        b->at = grown;
        b->room = room;
    }
    memcpy(b->at + b->count, bytes, count);
    b->count += count;
}

void event_put_number(struct event_bytes *b, uint64_t number, int bytes)
{
    uint8_t low_first[8];
    for (int i = 0; i < bytes; i++)
        low_first[i] = (uint8_t)(number >> 8 * i);
    event_put_bytes(b, low_first, (size_t)bytes);
}

void event_put_double(struct event_bytes *b, double number)
{
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    event_put_number(b, bits, 8);
}

const uint8_t *event_get_bytes(struct event_reader *r, size_t count)
{
    if (r->bad || count > (size_t)(r->end - r->at)) {
        r->bad = true;
        return NULL;
    }
    const uint8_t *bytes = r->at;
    r->at += count;
    return bytes;
}

uint64_t event_get_number(struct event_reader *r, int bytes)
{
    const uint8_t *low_first = event_get_bytes(r, (size_t)bytes);
    uint64_t number = 0;
    for (int i = 0; low_first && i < bytes; i++)
        number |= (uint64_t)low_first[i] << 8 * i;
    return number;
}

double event_get_double(struct event_reader *r)
{
    uint64_t bits = event_get_number(r, 8);
    double number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

uint64_t event_digest(const uint8_t *bytes, size_t count)
{
    uint64_t digest = UINT64_C(0xcbf29ce484222325) ^ count, word;
    for (size_t at = 0; at < count; at += sizeof word) {
        size_t left = count - at;
        word = 0;
        memcpy(&word, bytes + at, left < sizeof word ? left : sizeof word);
        digest = (digest ^ word) * UINT64_C(0x9e3779b97f4a7c15);
        digest ^= digest >> 29;
    }
    return digest;
}
