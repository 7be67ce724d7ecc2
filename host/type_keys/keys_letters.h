/* keys_letters.h - which letter a key has: its note's name, a text's letters one after the other, or a file's.
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
/* The letters of the text go to the keys that are played, from the lowest, and begin again where there are more keys. Marks stay with
 * their letters; white space is passed over. False: there is no letter in it. */
bool keys_letters_text(const struct keys_score *score, const char *text,
                       struct keys_letters *out);
/* False: `why` has one line. Keys that the file does not have keep what they had. */
bool keys_letters_file(const char *path, struct keys_letters *out, char *why, size_t room);

#endif
