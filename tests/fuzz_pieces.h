/* fuzz_pieces.h - without libFuzzer: the same inputs in every run, each a row of pieces of the
 * language. For targets of texts. */
#ifndef FUZZ_PIECES_H
#define FUZZ_PIECES_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* `count` inputs of up to `most` pieces behind one byte, which counts. Each seventh has one
 * byte damaged. */
static inline void fuzz_pieces(const char *const *pieces, size_t pieces_count, long count,
                               long most)
{
    uint32_t state = 2463534242u;
    for (long i = 0; i < count; i++) {
        uint8_t bytes[1024];
        size_t length = 1;
        bytes[0] = (uint8_t)i;
        for (long k = i % most; k >= 0; k--) {
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
            const char *piece = pieces[(state >> 8) % pieces_count];
            size_t n = strlen(piece);
            if (length + n > sizeof bytes)
                break;
            memcpy(bytes + length, piece, n);
            length += n;
        }
        if (i % 7 == 0 && length > 1)
            bytes[1 + state % (length - 1)] = (uint8_t)(state >> 24);
        uint8_t *exact = malloc(length); /* so that reading beyond the end is seen */
        if (!exact)
            abort();
        memcpy(exact, bytes, length);
        LLVMFuzzerTestOneInput(exact, length);
        free(exact);
    }
}

#endif
