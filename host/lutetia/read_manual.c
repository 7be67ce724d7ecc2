/* read_manual.c - finds the manual's files by their list, manual.txt, a path a line
 * (docs/manual/meson.build makes it): see read_manual.h. */
#include "read_manual.h"

#include "lutetia.h"
#include "type_pages.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char paths[OPTION_WORDS_MAX][PATH_MAX];

/* A line's path; one that is not absolute begins in the folder of the list. */
static bool path_make(char path[PATH_MAX], const char *list, const char *line)
{
    const char *slash = strrchr(list, '/');
    const int folder = *line == '/' || !slash ? 0 : (int)(slash + 1 - list);
    return snprintf(path, PATH_MAX, "%.*s%s", folder, list, line) < PATH_MAX;
}

static int list_read(const char *list, char *text, struct option_words *words)
{
    for (char *rest = text, *line; (line = strsep(&rest, "\n"));) {
        if (!*line)
            continue;
        if (words->count == OPTION_WORDS_MAX || !path_make(paths[words->count], list, line))
            return fail("read", "%s is damaged: install it again", list);
        words->words[words->count] = paths[words->count];
        words->count++;
    }
    return EXIT_SUCCESS;
}

int read_manual_words(struct option_words *words)
{
    char found[PATH_MAX], list[PATH_MAX], *text = NULL;
    size_t bytes;
    if (!data_find(found, "../../docs/manual/manual.txt", "manual/manual.txt") ||
        !realpath(found, list))
        return fail("read", "the manual is not installed: name a Markdown file, or several");
    int status = type_text_read("read", list, &text, &bytes);
    if (status == EXIT_SUCCESS) {
        text[bytes] = '\0'; /* there is room for it */
        status = list_read(list, text, words);
    }
    free(text);
    return status;
}
