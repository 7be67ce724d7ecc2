/* osc.h - packets of Open Sound Control 1.0: read, written, and addresses matched.
 *
 *     static void take(void *context, const struct osc_message *m) { ... }
 *     // NULL: all of it was taken
 *     const char *why = osc_packet_read(bytes, count, take, context);
 *
 *     uint8_t out[OSC_PACKET_MAX];
 *     size_t length = osc_message_write(out, sizeof out, "/control/gravity", "f", 3.7);
 *
 *     /control/gravity\0\0\0\0 ,f\0\0 406ccccd      address and types are strings, padded to 4
 *                                                   bytes; numbers have their high byte first
 *     #bundle\0 TTTTTTTT LLLL message LLLL ...       messages and bundles, each after its
 *                                                    length, with a time
 *
 * Nothing of a damaged packet is taken. Bundles are taken at once, whatever time they name.
 *
 * Source: The Open Sound Control 1.0 Specification. Threads: any.
 */
#ifndef LUTETIA_LIVE_OSC_H
#define LUTETIA_LIVE_OSC_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { OSC_PACKET_MAX = 8192, OSC_ARGUMENTS_MAX = 32, OSC_BUNDLES_MAX = 8 };

/* type: i, h (64 bits), f, d, s, S; T and F (true, false); N (nothing), I (a bang); c, r, m, t
 * and b are there without a value. */
struct osc_argument {
    char type;
    double number;    /* of i, h, f, d; 1 for T, 0 for F */
    const char *text; /* of s and S; within the packet */
};

struct osc_message {
    const char *address; /* within the packet; begins with / */
    int count;
    struct osc_argument arguments[OSC_ARGUMENTS_MAX];
};

/* Hands over the packet's messages, in their order. Returns NULL, or what is wrong with the
 * packet: then none was handed over. */
const char *osc_packet_read(const uint8_t *bytes, size_t count,
                            void (*take)(void *context, const struct osc_message *m),
                            void *context);

/* types: of f (double), i (int) and s (const char *), one for each argument that follows.
 * Returns the bytes; 0: there is no room. */
size_t osc_message_write(uint8_t *out, size_t room, const char *address, const char *types,
                         ...);

/* Adds a message to the bundle whose `used` bytes stand in out; 0 begins a bundle, whose time
 * is "at once". Returns the bundle's bytes; 0: there is no room. */
size_t osc_bundle_add(uint8_t *out, size_t room, size_t used, const char *address,
                      const char *types, ...);

/* A message of arguments as they are read: texts, and numbers as f. */
size_t osc_arguments_write(uint8_t *out, size_t room, const char *address,
                           const struct osc_argument *arguments, int count);

/* Whether a pattern names an address: ? is one character, * any number of them, [a-c] and
 * [!a-c] one of or none of these, {one,two} one of these words; none of them is /. The address
 * has at most 63 characters. Takes time in proportion to both lengths. */
bool osc_address_matches(const char *pattern, const char *address);

#endif
