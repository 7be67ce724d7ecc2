/* sha256.h - SHA-256 (FIPS 180-4), and HMAC with it (RFC 2104).
 *
 *     struct sha256 sum;
 *     uint8_t digest[SHA256_BYTES];
 *     sha256_begin(&sum);
 *     sha256_add(&sum, bytes, count);
 *     sha256_end(&sum, digest);
 *
 * It is ours because liblutetia-midi.a, which other programs are linked with, needs it: each of
 * them would need a library of sums, too. Published values and Python's hmac are its oracles.
 *
 * Threads: one at a time for each sum.
 */
#ifndef LUTETIA_SHA256_H
#define LUTETIA_SHA256_H

#include <stddef.h>
#include <stdint.h>

enum { SHA256_BYTES = 32, SHA256_BLOCK = 64 };

struct sha256 {
    uint32_t state[8];
    uint64_t count; /* bytes added */
    uint8_t block[SHA256_BLOCK];
};

void sha256_begin(struct sha256 *sum);
void sha256_add(struct sha256 *sum, const void *bytes, size_t count);
/* The sum is used up. */
void sha256_end(struct sha256 *sum, uint8_t digest[static SHA256_BYTES]);

/* The code that only who knows the key can compute from the bytes. */
void sha256_hmac(const void *key, size_t key_count, const void *bytes, size_t count,
                 uint8_t code[static SHA256_BYTES]);

#endif
