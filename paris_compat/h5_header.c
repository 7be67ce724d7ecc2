/* h5_header.c - see h5_file.h. */
#include "h5_file.h"

#include <string.h>

const char h5_damaged[] = "it is a damaged HDF5 file";

uint64_t h5_number(const uint8_t *at, int bytes)
{
    uint64_t n = 0;
    for (int i = 0; i < bytes; i++)
        n |= (uint64_t)at[i] << 8 * i;
    return n;
}

size_t h5_bytes_upto(FILE *in, uint64_t at, void *bytes, size_t count)
{
    return at < INT64_MAX / 2 && fseek(in, (long)at, SEEK_SET) == 0 ? fread(bytes, 1, count, in)
                                                                    : 0;
}

bool h5_bytes_at(FILE *in, uint64_t at, void *bytes, size_t count)
{
    return h5_bytes_upto(in, at, bytes, count) == count;
}

enum { MESSAGES_MOST = 4096, PARTS_MOST = 64 };

/* A header while it is read. A message begins with its type, its bytes and flags, of which only
 * the bytes stand at the same place in neither version. */
struct header {
    FILE *in;
    unsigned version, message_head; /* bytes before a message's data */
    unsigned messages;              /* that may still be read */
    uint64_t at, left;              /* the part that is read: messages */
    uint64_t next,
        next_bytes; /* the part that goes on, as it lies in the file; 0 bytes: none */
};

static const char *part_read(struct header *h, h5_message_take take, void *context)
{
    while (h->left >= h->message_head && h->messages > 0) {
        uint8_t head[8], data[H5_MESSAGE_BYTES];
        if (!h5_bytes_at(h->in, h->at, head, h->message_head))
            return h5_damaged;
        const unsigned type = h->version == 1 ? (unsigned)h5_number(head, 2) : head[0];
        const uint64_t bytes = h5_number(head + (h->version == 1 ? 2 : 1), 2);
        const size_t kept = bytes < sizeof data ? (size_t)bytes : sizeof data;
        if (bytes > h->left - h->message_head ||
            !h5_bytes_at(h->in, h->at + h->message_head, data, kept))
            return h5_damaged;
        if (type == H5_MESSAGE_MORE && kept >= 16) {
            h->next = h5_number(data, 8);
            h->next_bytes = h5_number(data + 8, 8);
        }
        const char *wrong = take(context, type, data, kept);
        if (wrong)
            return wrong;
        h->at += h->message_head + bytes;
        h->left -= h->message_head + bytes;
        h->messages--;
    }
    return NULL;
}

/* Version 2: times, bounds for attributes and the order of creation are there or not. */
static bool newer_begin(struct header *h, uint64_t at, const uint8_t *head)
{
    enum { ORDER_KEPT = 4, BOUNDS = 16, TIMES = 32, CHECKSUM = 4 };
    uint8_t bytes[8];
    const unsigned flags = head[5], size_bytes = 1u << (flags & 3);
    at += 6 + (flags & TIMES ? 16u : 0) + (flags & BOUNDS ? 4u : 0);
    if (head[4] != 2 || !h5_bytes_at(h->in, at, bytes, size_bytes))
        return false;
    h->version = 2;
    h->message_head = flags & ORDER_KEPT ? 6 : 4;
    h->at = at + size_bytes;
    h->left = h5_number(bytes, (int)size_bytes);
    return true;
}

/* The part that goes on; in version 2 between a signature and a checksum. */
static bool part_next(struct header *h)
{
    uint8_t sign[4];
    h->at = h->next;
    h->left = h->next_bytes;
    h->next_bytes = 0;
    if (h->version == 1)
        return true;
    if (h->left < 8 || !h5_bytes_at(h->in, h->at, sign, 4) || memcmp(sign, "OCHK", 4) != 0)
        return false;
    h->at += 4;
    h->left -= 8;
    return true;
}

const char *h5_header_read(FILE *in, uint64_t at, h5_message_take take, void *context)
{
    struct header h = {.in = in, .version = 1, .message_head = 8, .messages = MESSAGES_MOST};
    uint8_t head[16];
    if (!h5_bytes_at(in, at, head, sizeof head))
        return h5_damaged;
    if (memcmp(head, "OHDR", 4) == 0) {
        if (!newer_begin(&h, at, head))
            return h5_damaged;
    } else if (head[0] == 1) {
        const unsigned messages = (unsigned)h5_number(head + 2, 2);
        h.messages = messages < MESSAGES_MOST ? messages : MESSAGES_MOST;
        h.at = at + 16;
        h.left = h5_number(head + 8, 4);
    } else {
        return h5_damaged;
    }
    for (int parts = 0; parts < PARTS_MOST; parts++) {
        const char *wrong = part_read(&h, take, context);
        if (wrong || !h.next_bytes || !h.messages)
            return wrong;
        if (!part_next(&h))
            return h5_damaged;
    }
    return h5_damaged;
}
