/* word_list.h - lists of words with blanks between them, as the choices of a control are. */
#ifndef LUTETIA_WORD_LIST_H
#define LUTETIA_WORD_LIST_H

#include <stddef.h>

/* How many words there are. Any thread. */
int word_list_count(const char *list);

/* Word number `index` from 0, which is not ended, and its length; where there are fewer, the
 * list's end and 0. Owns: the list. Any thread. */
const char *word_list_at(const char *list, int index, size_t *length);

/* The number of the word, from 0; -1: the list does not have it. Any thread. */
int word_list_find(const char *list, const char *word);

#endif
