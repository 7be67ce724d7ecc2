/* voice_cry.h - a synthetic voice: glottal pulses through two resonances. For tests, and in
 * place of a recording. */
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

/* The cry of a small child, of three breaths. */
struct voice_cry voice_cry_default(void);
/* Shape: *count numbers, -1..1; as long as the vowel stays the same, the loudness is loud().
 * NULL: no memory. Owns: the caller frees it. */
float *voice_cry_make(const struct voice_cry *cry, size_t *count);

#endif
