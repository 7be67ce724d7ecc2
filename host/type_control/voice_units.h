/* voice_units.h - what a text sounds like, as far as its letters tell in any language: a row of
 * short sounds, each of a class and of an expected length.
 *
 *     "Why not?"   W voiced  hy vowel | n voiced  o vowel  t stop |  a pause is expected
 *
 * Nothing is known of the language. So letters have the class that they have most often in the
 * languages of their script, neighbours that make one sound in most of them (vowels, doubled
 * consonants, sh, ch, th) are one unit, and lengths are rough.
 */
#ifndef LUTETIA_VOICE_UNITS_H
#define LUTETIA_VOICE_UNITS_H

#include "voice_letters.h"

enum voice_class {
    VOICE_CLASS_VOWEL,  /* periodic, loud */
    VOICE_CLASS_VOICED, /* periodic: l, m, d, ... */
    VOICE_CLASS_HISS,   /* noise of high frequencies: s, sh, z */
    VOICE_CLASS_BREATH, /* weak noise: f, h, th */
    VOICE_CLASS_STOP,   /* silence and a burst: p, t, k */
    VOICE_CLASS_ANY,    /* of several sounds: digits, signs */
    VOICE_CLASSES
};

struct voice_unit {
    enum voice_class what;
    double seconds;                 /* expected, as read aloud without haste */
    int letters_begin, letters_end; /* of the text's */
    int word;
};

/* What is expected after a word. */
enum voice_break { VOICE_BREAK_NONE, VOICE_BREAK_SHORT /* comma */, VOICE_BREAK_LONG };

/* Units of all words, in their order; each word has at least one, each letter is in at least
 * one. False: no memory. Owns: the caller frees *out. */
bool voice_units_make(const struct voice_words *words, struct voice_unit **out, int *count);
/* What follows a word in the text: the sign at its end says. */
enum voice_break voice_break_after(const struct voice_words *words, int word);

#endif
