/* marked_words.c - a library that is loaded before a window's program: all that is looked up
 * for translation comes back in brackets. Words on the screen without them are words that no
 * translation reaches. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KEPT = 4096 };

/* The same text for the same words, as gettext() gives: callers keep it. */
static char *marked(const char *words)
{
    static struct {
        const char *words;
        char *marked;
    } kept[KEPT];
    static int count;
    for (int i = 0; i < count; i++)
        if (strcmp(kept[i].words, words) == 0)
            return kept[i].marked;
    const size_t length = strlen(words);
    char *text = malloc(length + 3);
    if (!text || count == KEPT)
        return NULL;
    snprintf(text, length + 3, "[%s]", words);
    kept[count].words = strdup(words);
    kept[count].marked = text;
    return kept[count++].marked;
}

#define SEEN __attribute__((visibility("default")))
SEEN char *dcgettext(const char *domain, const char *words, int category);
SEEN char *dcngettext(const char *domain, const char *one, const char *many, unsigned long n,
                      int category);

/* The desk's words are those of the program's own domain; toolkits name theirs. */
char *dcgettext(const char *domain, const char *words, int category)
{
    (void)category;
    char *text = !domain && words[0] ? marked(words) : NULL;
    return text ? text : (char *)(size_t)words;
}

char *dcngettext(const char *domain, const char *one, const char *many, unsigned long n,
                 int category)
{
    return dcgettext(domain, n == 1 ? one : many, category);
}
