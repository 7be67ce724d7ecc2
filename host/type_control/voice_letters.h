/* voice_letters.h - which letters of a text a moment of a voice shows.
 *
 * A word is shown while it is said (voice_align.h finds when), and nothing in a silence. A text
 * of one word is shown as a whole, as long as the voice sounds. Along a line words are
 * prolonged: a letter is repeated as long as its time lasts ("Aaaaagggh"). Punctuation is set
 * once, with the letter beside it.
 */
#ifndef LUTETIA_VOICE_LETTERS_H
#define LUTETIA_VOICE_LETTERS_H

#include "voice_score.h"

/* Bytes of the text: what goes before a letter, the letter with the marks on it, and what comes
 * after it. */
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

/* Whether a word's letters join, or stand in another order than they are said (Arabic,
 * Devanagari): it is then set as a whole. */
bool voice_word_joins(const struct voice_words *words, int word);
/* Whether the text runs to the left: the first word with letters of a direction says. */
bool voice_words_to_left(const struct voice_words *words);

struct voice_span {
    double begin_s, end_s;
};

struct voice_timing {
    struct voice_span *words;   /* ascending; none overlaps the next */
    struct voice_span *letters; /* of a word: within it, one after the other */
    int words_count, letters_count;
    struct voice_span *sounds; /* what is heard of the voice, ascending, with silence between */
    int sounds_count;
};
void voice_timing_finish(struct voice_timing *timing); /* an empty one is fine */

/* The word that is said at that time; -1: none. */
int voice_word_at(const struct voice_timing *timing, double time_s);
/* The bytes of the text that a word is shown as. */
void voice_word_bytes(const struct voice_words *words, int word, int *begin, int *end);

#endif
