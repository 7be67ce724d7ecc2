/* voice_letters.h - which letters of a text a moment of a voice shows.
 *
 * A text of one word is shown as a whole, as long as the voice sounds. Several words are
 * distributed over the sounds: with more words than sounds, each sound shows several; with
 * fewer, each word lasts for several sounds. Along a line words are prolonged: their letters
 * share their sounds' time, and a letter is repeated as long as its share lasts
 * ("Aaaaagggh"). Punctuation is set once, with the letter beside it.
 */
#ifndef LUTETIA_VOICE_LETTERS_H
#define LUTETIA_VOICE_LETTERS_H

#include "voice_score.h"

/* Bytes of the text: what goes before a letter, the letter with the marks on it, and what comes after it. */
struct voice_letter {
    int before, begin, end, after; /* [before, begin), [begin, end), [end, after) */
    int word;
};

struct voice_words {
    const char *text; /* UTF-8, borrowed */
    int count;        /* of its words */
    int letters_count;
    int *first; /* index of each word's first letter; the last entry is letters_count */
    struct voice_letter *letters;
};

/* Splits the text at white space. False: no memory, or there is no word (*empty true). Owns:
 * the caller finishes *out. */
bool voice_words_make(const char *text, struct voice_words *out, bool *empty);
void voice_words_finish(struct voice_words *words);

/* The bytes of the text that are shown at that time. */
void voice_words_at(const struct voice_words *words, const struct voice_score *score,
                    double time_s, int *begin, int *end);
/* The letter for a time on the line, and the end of its share of the time. */
int voice_letter_at(const struct voice_words *words, const struct voice_score *score,
                    double time_s, double *until_s);

#endif
