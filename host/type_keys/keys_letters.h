/* keys_letters.h - the letters of keys: names of notes, letters of a text, or letters from a
 * file.
 *
 *     c4 A          a key, as a note or a number, and what it plays; # begins a comment
 *     d4 at
 */
#ifndef LUTETIA_KEYS_LETTERS_H
#define LUTETIA_KEYS_LETTERS_H

#include "keys_score.h"

enum { KEYS_LETTER_BYTES = 64 };

struct keys_letters {
    char of[MIDI_NOTES][KEYS_LETTER_BYTES]; /* UTF-8; "" where a key has none */
};

/* C, C-sharp, D, ... of all keys. */
void keys_letters_names(struct keys_letters *out);
/* Assigns the letters of the text to the keys that are played, from the lowest, repeating the
 * text if there are more keys. Marks stay with their letters, and a consonant with those that
 * join it (Devanagari); Arabic letters have the form that they have in their word; a text that
 * runs to the left begins at the highest key. White space is skipped. False: the text has no
 * letter. */
bool keys_letters_text(const struct keys_score *score, const char *text,
                       struct keys_letters *out);
/* False: `why` gets one line. Keys that are not in the file keep their letters. */
bool keys_letters_file(const char *path, struct keys_letters *out, char *why, size_t room);

#endif
