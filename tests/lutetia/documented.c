/* documented.c - finds commands in documents. */
#include "documented.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>

static char *text_read(const char *folder, const char *name)
{
    char path[4096];
    static char text[1 << 17];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    if (!file)
        fail_msg("%s", path);
    size_t count = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[count] = '\0';
    return text;
}

char *documented_command(const char *folder, const char *document, const char *begins,
                         const char *wanted)
{
    char *text = text_read(folder, document), *begin = NULL;
    char *at = strstr(text, wanted);
    if (!at)
        fail_msg("%s has no %s", document, wanted);
    for (char *next = text; (next = strstr(next, begins)) && next < at; next++)
        begin = next;
    assert_non_null(begin);
    char *end = begin;
    while (*end && (*end != '\n' || end[-1] == '\\'))
        end++;
    *end = '\0';
    for (char *c = begin; *c; c++)
        if (*c == '\n' || *c == '\\')
            *c = ' ';
    return begin;
}

int documented_words(char *text, const char **words, int most)
{
    int count = 0;
    for (char *c = text; *c;) {
        while (*c == ' ')
            *c++ = '\0';
        char stop = *c == '"' ? '"' : ' ';
        c += stop == '"';
        if (!*c)
            break;
        assert_true(count < most);
        words[count++] = c;
        while (*c && *c != stop)
            c++;
        if (*c)
            *c++ = '\0';
    }
    return count;
}
