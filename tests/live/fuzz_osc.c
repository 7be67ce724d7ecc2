/* fuzz_osc.c - packets of OSC from damaged bytes: refused whole, or messages whose texts end
 * within the packet. */
#include <osc.h>

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

struct looked {
    const uint8_t *bytes;
    size_t count;
    int taken;
};

static void text_look(const struct looked *l, const char *text)
{
    const uint8_t *at = (const uint8_t *)text;
    if (at < l->bytes || at >= l->bytes + l->count ||
        !memchr(at, 0, (size_t)(l->bytes + l->count - at)))
        abort();
}

static void take(void *context, const struct osc_message *m)
{
    struct looked *l = context;
    l->taken++;
    text_look(l, m->address);
    if (m->address[0] != '/' || m->count < 0 || m->count > OSC_ARGUMENTS_MAX)
        abort();
    for (int i = 0; i < m->count; i++)
        if (m->arguments[i].text)
            text_look(l, m->arguments[i].text);
    (void)osc_address_matches(m->address, "control/gravity");
    if (!osc_address_matches("*", "gravity") || osc_address_matches(m->address, ""))
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t *exact = malloc(size ? size : 1); /* its end is where a sanitizer sees it */
    if (!exact)
        abort();
    memcpy(exact, data, size);
    struct looked l = {exact, size, 0};
    const char *why = osc_packet_read(exact, size, take, &l);
    if (why && (l.taken || !*why))
        abort();
    free(exact);
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
enum { MOST = 600, ROUNDS = 300000 };

static uint32_t state = 2463534242u;

static uint32_t next(void)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state >> 4;
}

/* Pieces of packets, most of them whole. */
static size_t packet_make(uint8_t out[MOST], int depth)
{
    static const char *const addresses[] = {"/control/gravity", "/a",      "/{a,b",
                                            "/[!a-c]*",         "/t?xt/*", "gravity"};
    static const char *const types[] = {"f", "i", "ff", "sss", "is", "", "fi"};
    size_t used = 0;
    if (next() % 3 == 0 && depth < 4) {
        memcpy(out, "#bundle\0\0\0\0\0\0\0\0\x01", 16);
        used = 16;
        for (uint32_t i = next() % 4; i; i--) {
            uint8_t part[MOST];
            const size_t count = packet_make(part, depth + 1);
            if (used + count + 4 > MOST / 2)
                break;
            const uint8_t length[4] = {0, 0, (uint8_t)(count >> 8), (uint8_t)count};
            memcpy(out + used, length, 4);
            memcpy(out + used + 4, part, count);
            used += count + 4;
        }
        return used;
    }
    const char *address = addresses[next() % 6], *type = types[next() % 7];
    if (!strcmp(type, "sss"))
        return osc_message_write(out, MOST, address, type, "a", "four", "");
    if (!strcmp(type, "is"))
        return osc_message_write(out, MOST, address, type, 7, "seven");
    if (!strcmp(type, "i"))
        return osc_message_write(out, MOST, address, type, -1);
    if (!strcmp(type, "fi"))
        return osc_message_write(out, MOST, address, type, 1e9, 3);
    return osc_message_write(out, MOST, address, type, 0.5, 2.0);
}

int main(void)
{
    static const char pieces[] = ",ifsbhdTF[]/#\0\xff";
    int read = 0;
    for (int i = 0; i < ROUNDS; i++) {
        uint8_t bytes[MOST];
        size_t count = packet_make(bytes, 0);
        for (int k = i % 4; k && count; k--)
            bytes[next() % count] =
                next() % 5 ? (uint8_t)pieces[next() % (sizeof pieces - 1)] : (uint8_t)next();
        if (i % 7 == 0)
            count -= count ? next() % count : 0;
        LLVMFuzzerTestOneInput(bytes, count);
        struct looked l = {bytes, count, 0};
        read += !osc_packet_read(bytes, count, take, &l);
    }
    return read > ROUNDS / 10 && read < ROUNDS ? 0 : 1; /* enough of them are read, too */
}
#endif
