/* lines.c - what a program prints, the last of it: see keeper.h. */
#include "keeper.h"

#include <string.h>

void lines_end(struct lines *l)
{
    if (!l->now_bytes)
        return;
    char *line = l->kept[l->count++ % LINES_KEPT];
    memcpy(line, l->now, (size_t)l->now_bytes);
    line[l->now_bytes] = '\0';
    l->now_bytes = 0;
}

void lines_add(struct lines *l, const char *bytes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (bytes[i] == '\n' && !l->now_bytes)
            l->now[l->now_bytes++] = ' '; /* an empty line is one */
        if (bytes[i] == '\n')
            lines_end(l);
        else if (l->now_bytes < LINE_BYTES)
            l->now[l->now_bytes++] = bytes[i] ? bytes[i] : ' ';
    }
}
