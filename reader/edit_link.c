/* edit_link.c - links that are called by their words: see edit_internal.h. */
#include "edit_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_escaped(const char *text, int first, int at)
{
    int signs = 0;
    while (at > first && text[--at] == '\\')
        signs++;
    return signs % 2;
}

/* The bracket before a place; -1: there is none in its line, or it closes. */
static int opening(const char *text, int first, int at)
{
    while (at-- > first && text[at] != '\n')
        if ((text[at] == '[' || text[at] == ']') && !is_escaped(text, first, at))
            return text[at] == '[' ? at : -1;
    return -1;
}

/* The bracket behind it; -1: there is none in its line, or it opens. */
static int closing(const char *text, int first, int last, int at)
{
    for (; at < last && text[at] != '\n'; at++)
        if ((text[at] == '[' || text[at] == ']') && !is_escaped(text, first, at))
            return text[at] == ']' ? at : -1;
    return -1;
}

char *edit_link_name(const char *text, int first, int last, int begin, int end, int *behind)
{
    char *out = NULL;
    if (begin < first || end < begin || end > last)
        return NULL;
    const int open = opening(text, first, begin), close = closing(text, first, last, end);
    if (open < 0 || close < 0 || closing(text, first, last, begin) != close ||
        text[open + 1] == '^')
        return NULL;
    const bool empty = close + 2 < last && text[close + 1] == '[' && text[close + 2] == ']';
    if (!empty && close + 1 < last && strchr("[(:", text[close + 1]))
        return NULL;
    *behind = close + (empty ? 3 : 1);
    return asprintf(&out, "%.*s][%.*s]", close - end, text + end, close - open - 1,
                    text + open + 1) < 0
               ? NULL
               : out;
}
