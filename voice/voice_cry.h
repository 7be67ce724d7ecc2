/* voice_cry.h - a voice of our own making: pulses of a throat through two resonances. For tests, and for who has no recording. */
#ifndef LUTETIA_VOICE_CRY_H
#define LUTETIA_VOICE_CRY_H

#include <stddef.h>

struct voice_cry {
    double seconds;
    int rate_hz;
    double (*loud)(double time_s); /* 0..1 */
    double (*high)(double time_s); /* Hz */
    void (*vowel)(double time_s, double formant_hz[2]);
};

/* A small child's, of three breaths. */
struct voice_cry voice_cry_default(void);
/* Shape: *count numbers, -1..1, as loud as loud() says wherever the vowel stays the same. NULL: no memory. Owns: the caller frees it. */
float *voice_cry_make(const struct voice_cry *cry, size_t *count);

#endif
