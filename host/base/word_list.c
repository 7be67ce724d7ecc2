/* word_list.c - see word_list.h. */
#include "word_list.h"

#include <string.h>

const char *word_list_at(const char *list, int index, size_t *length)
{
    list += strspn(list, " ");
    for (; index > 0; index--) {
        list += strcspn(list, " ");
        list += strspn(list, " ");
    }
    *length = strcspn(list, " ");
    return list;
}

int word_list_find(const char *list, const char *word)
{
    size_t length = 0;
    int index = 0;
    list = word_list_at(list, 0, &length);
    for (; length > 0; list = word_list_at(list + length, 0, &length), index++)
        if (strlen(word) == length && memcmp(list, word, length) == 0)
            return index;
    return -1;
}

int word_list_count(const char *list)
{
    size_t length;
    int count = 0;
    for (list = word_list_at(list, 0, &length); length > 0;
         list = word_list_at(list + length, 0, &length))
        count++;
    return count;
}
