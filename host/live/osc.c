/* osc.c - see osc.h. */
#include "osc.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

/* ---- reading ---- */

struct reader {
    const uint8_t *at, *end;
};

static uint32_t word_at(const uint8_t *b)
{
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static size_t left(const struct reader *r)
{
    return (size_t)(r->end - r->at);
}

/* NULL: it does not end in the packet. */
static const char *string_take(struct reader *r)
{
    const char *text = (const char *)r->at;
    const uint8_t *zero = left(r) ? memchr(r->at, 0, left(r)) : NULL;
    if (!zero)
        return NULL;
    const size_t padded = ((size_t)(zero - r->at) + 4) & ~(size_t)3;
    if (padded > left(r))
        return NULL;
    r->at += padded;
    return text;
}

static bool number_take(struct reader *r, size_t bytes, uint64_t *bits)
{
    if (left(r) < bytes)
        return false;
    *bits = word_at(r->at);
    if (bytes == 8)
        *bits = *bits << 32 | word_at(r->at + 4);
    r->at += bytes;
    return true;
}

static double float_of(uint64_t bits)
{
    const uint32_t word = (uint32_t)bits;
    float value;
    memcpy(&value, &word, sizeof value);
    return (double)value;
}

static double double_of(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static bool blob_skip(struct reader *r)
{
    uint64_t length;
    if (!number_take(r, 4, &length) || length > left(r))
        return false;
    const size_t padded = ((size_t)length + 3) & ~(size_t)3;
    if (padded > left(r))
        return false;
    r->at += padded;
    return true;
}

static bool argument_take(struct reader *r, struct osc_argument *a)
{
    uint64_t bits = 0;
    switch (a->type) {
    case 'i':
    case 'f':
    case 'c':
    case 'r':
    case 'm':
        if (!number_take(r, 4, &bits))
            return false;
        a->number = a->type == 'i'   ? (double)(int32_t)(uint32_t)bits
                    : a->type == 'f' ? float_of(bits)
                                     : 0;
        return true;
    case 'h':
    case 'd':
    case 't':
        if (!number_take(r, 8, &bits))
            return false;
        a->number = a->type == 'h'   ? (double)(int64_t)bits
                    : a->type == 'd' ? double_of(bits)
                                     : 0;
        return true;
    case 's':
    case 'S':
        a->text = string_take(r);
        return a->text != NULL;
    case 'b':
        return blob_skip(r);
    case 'T':
        a->number = 1;
        return true;
    case 'F':
    case 'N':
    case 'I':
        return true;
    default:
        return false;
    }
}

static const char *message_read(struct reader r, struct osc_message *m)
{
    m->count = 0;
    m->address = string_take(&r);
    if (!m->address || m->address[0] != '/')
        return "a message begins with its address, /name";
    const char *types = left(&r) ? string_take(&r) : ",";
    if (!types || types[0] != ',')
        return "the types of a message begin with a comma";
    for (types++; *types; types++) {
        if (*types == '[' || *types == ']')
            continue; /* an array's elements are taken one by one */
        if (m->count == OSC_ARGUMENTS_MAX)
            return "a message has at most 32 arguments";
        struct osc_argument *a = &m->arguments[m->count++];
        *a = (struct osc_argument){.type = *types};
        if (!argument_take(&r, a))
            return "an argument is of no known type, or cut short";
    }
    return left(&r) ? "there are bytes behind a message's arguments" : NULL;
}

struct taker {
    void (*take)(void *context, const struct osc_message *m); /* NULL: it is only checked */
    void *context;
};

static const char *element_read(struct reader r, int depth, const struct taker *taker);

static const char *bundle_read(struct reader r, int depth, const struct taker *taker)
{
    enum { HEAD = 16 };
    if (left(&r) < HEAD || depth == OSC_BUNDLES_MAX)
        return "a bundle is cut short, or in too many others";
    r.at += HEAD;
    while (left(&r)) {
        uint64_t length;
        if (!number_take(&r, 4, &length) || length > left(&r) || length % 4 || !length)
            return "a bundle's message has a wrong length";
        const char *why = element_read((struct reader){r.at, r.at + length}, depth + 1, taker);
        if (why)
            return why;
        r.at += length;
    }
    return NULL;
}

static const char *element_read(struct reader r, int depth, const struct taker *taker)
{
    struct osc_message m;
    if (left(&r) >= 8 && memcmp(r.at, "#bundle", 8) == 0)
        return bundle_read(r, depth, taker);
    const char *why = message_read(r, &m);
    if (!why && taker->take)
        taker->take(taker->context, &m);
    return why;
}

const char *osc_packet_read(const uint8_t *bytes, size_t count,
                            void (*take)(void *context, const struct osc_message *m),
                            void *context)
{
    const struct reader whole = {bytes, bytes + count};
    if (!count || count % 4)
        return "a packet has 4 bytes, or 8, or 12, ...";
    const char *why = element_read(whole, 0, &(struct taker){0});
    return why ? why : element_read(whole, 0, &(struct taker){take, context});
}

/* ---- writing ---- */

struct writer {
    uint8_t *out;
    size_t room, used;
    bool full;
};

static void bytes_put(struct writer *w, const void *bytes, size_t count, size_t padded)
{
    w->full = w->full || padded > w->room - w->used;
    if (w->full)
        return;
    memset(w->out + w->used, 0, padded);
    memcpy(w->out + w->used, bytes, count);
    w->used += padded;
}

static void string_put(struct writer *w, const char *text)
{
    const size_t length = strlen(text);
    bytes_put(w, text, length, (length + 4) & ~(size_t)3);
}

static void word_put(struct writer *w, uint32_t word)
{
    const uint8_t bytes[4] = {(uint8_t)(word >> 24), (uint8_t)(word >> 16),
                              (uint8_t)(word >> 8), (uint8_t)word};
    bytes_put(w, bytes, 4, 4);
}

static void float_put(struct writer *w, double number)
{
    const float value = (float)number;
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    word_put(w, word);
}

size_t osc_arguments_write(uint8_t *out, size_t room, const char *address,
                           const struct osc_argument *arguments, int count)
{
    struct writer w = {.out = out, .room = room};
    char types[OSC_ARGUMENTS_MAX + 2] = ",";
    if (count < 0 || count > OSC_ARGUMENTS_MAX)
        return 0;
    for (int i = 0; i < count; i++)
        types[i + 1] = arguments[i].text ? 's' : 'f';
    types[count + 1] = '\0';
    string_put(&w, address);
    string_put(&w, types);
    for (int i = 0; i < count; i++)
        if (arguments[i].text)
            string_put(&w, arguments[i].text);
        else
            float_put(&w, arguments[i].number);
    return w.full ? 0 : w.used;
}

/* Puts the message of a call's further arguments. */
static void message_put(struct writer *w, const char *address, const char *types,
                        va_list arguments)
{
    char all[OSC_ARGUMENTS_MAX + 2] = ",";
    w->full = w->full || strlen(types) > OSC_ARGUMENTS_MAX;
    if (w->full)
        return;
    memcpy(all + 1, types, strlen(types) + 1);
    string_put(w, address);
    string_put(w, all);
    for (; *types; types++) {
        if (*types == 's') {
            string_put(w, va_arg(arguments, const char *));
        } else if (*types == 'i') {
            word_put(w, (uint32_t)va_arg(arguments, int));
        } else {
            float_put(w, va_arg(arguments, double));
        }
    }
}

size_t osc_message_write(uint8_t *out, size_t room, const char *address, const char *types, ...)
{
    struct writer w = {.out = out, .room = room};
    va_list arguments;
    va_start(arguments, types);
    message_put(&w, address, types, arguments);
    va_end(arguments);
    return w.full ? 0 : w.used;
}

size_t osc_bundle_add(uint8_t *out, size_t room, size_t used, const char *address,
                      const char *types, ...)
{
    enum { HEAD = 16 }; /* its name, and the time "at once" */
    struct writer w = {.out = out, .room = room, .used = used};
    va_list arguments;
    if (used == 0)
        bytes_put(&w, "#bundle\0\0\0\0\0\0\0\0\1", HEAD, HEAD);
    struct writer length = w;
    word_put(&w, 0);
    const size_t from = w.used;
    va_start(arguments, types);
    message_put(&w, address, types, arguments);
    va_end(arguments);
    if (w.full)
        return 0;
    word_put(&length, (uint32_t)(w.used - from));
    return w.used;
}

/* ---- addresses ----
 *
 * The places that a pattern's beginning can have reached are bits: bit i says that it names the
 * address's first i characters. Each piece of the pattern moves all of them at once. */

enum { ADDRESS_MAX = 63 };

/* After one character that `fits` says. */
static uint64_t one_after(uint64_t places, const char *address, const bool fits[256])
{
    uint64_t next = 0;
    for (size_t i = 0; address[i]; i++)
        if ((places >> i & 1) && fits[(unsigned char)address[i]])
            next |= UINT64_C(1) << (i + 1);
    return next;
}

static uint64_t any_after(uint64_t places, const char *address)
{
    for (size_t i = 0; address[i]; i++)
        if ((places >> i & 1) && address[i] != '/')
            places |= UINT64_C(1) << (i + 1);
    return places;
}

/* "[!a-c]": what is behind the bracket. NULL: it is not closed. */
static const char *class_read(const char *p, bool fits[256])
{
    const bool not = *p == '!';
    memset(fits, not, 256 * sizeof *fits);
    for (p += not ; *p && *p != ']'; p++) {
        unsigned char from = (unsigned char)*p, to = from;
        if (p[1] == '-' && p[2] && p[2] != ']') {
            to = (unsigned char)p[2];
            p += 2;
        }
        for (int c = from; c <= to; c++)
            fits[c] = !not ;
    }
    fits['/'] = false;
    return *p ? p + 1 : NULL;
}

/* "{one,two}": moves places over one of the words. NULL: it is not closed. */
static const char *words_read(const char *p, const char *address, uint64_t *places)
{
    uint64_t all = 0;
    for (;;) {
        const size_t length = strcspn(p, ",}");
        if (!p[length])
            return NULL;
        for (size_t i = 0; i <= strlen(address); i++)
            if ((*places >> i & 1) && strncmp(address + i, p, length) == 0)
                all |= UINT64_C(1) << (i + length);
        p += length + 1;
        if (p[-1] == '}')
            break;
    }
    *places = all;
    return p;
}

bool osc_address_matches(const char *pattern, const char *address)
{
    uint64_t places = 1;
    const size_t length = strlen(address);
    if (length > ADDRESS_MAX)
        return false;
    for (const char *p = pattern; p && *p && places;) {
        bool fits[256] = {false};
        const char c = *p++;
        if (c == '*') {
            places = any_after(places, address);
        } else if (c == '{') {
            p = words_read(p, address, &places);
        } else {
            if (c == '[') {
                p = class_read(p, fits);
            } else if (c == '?') {
                memset(fits, true, sizeof fits);
                fits['/'] = false;
            } else {
                fits[(unsigned char)c] = true;
            }
            places = one_after(places, address, fits);
        }
        if (!p)
            return false;
    }
    return places >> length & 1;
}
