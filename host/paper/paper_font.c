/* paper_font.c - finds a font's file by its name.
 *
 * A name with a slash is a file.  Any other is looked for in the folders where the system keeps fonts, and
 * matches a file called so, with or without its ending, in any case.  Of several the first in the order of
 * their paths is taken, so that a machine always finds the same one. */
#include "paper_internal.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { DEPTH_MAX = 8 };

static const char *const endings[] = {".otf", ".ttf", ".ttc", ".pfb", ".t1"};

static bool name_matches(const char *file, const char *name)
{
    size_t length = strlen(name);
    if (strncasecmp(file, name, length) != 0)
        return false;
    if (file[length] == '\0')
        return true;
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (strcasecmp(file + length, endings[i]) == 0)
            return true;
    return false;
}

/* Keeps in *found the lesser of it and every match below the folder. */
static void folder_search(const char *folder, const char *name, int depth, char **found)
{
    DIR *dir = depth < DEPTH_MAX ? opendir(folder) : NULL;
    if (!dir)
        return;
    for (struct dirent *entry; (entry = readdir(dir));) {
        if (entry->d_name[0] == '.')
            continue;
        char *path;
        if (asprintf(&path, "%s/%s", folder, entry->d_name) < 0)
            break;
        struct stat status;
        if (stat(path, &status) == 0 && S_ISDIR(status.st_mode)) {
            folder_search(path, name, depth + 1, found);
        } else if (name_matches(entry->d_name, name) && (!*found || strcmp(path, *found) < 0)) {
            free(*found);
            *found = path;
            continue;
        }
        free(path);
    }
    closedir(dir);
}

char *paper_font_find(const char *name)
{
    struct stat status;
    if (!name || !*name)
        return NULL;
    if (strchr(name, '/') || (stat(name, &status) == 0 && S_ISREG(status.st_mode)))
        return strdup(name);

    char *found = NULL, *folder = NULL;
    const char *data = getenv("XDG_DATA_HOME"), *home = getenv("HOME");
    if (data && *data ? asprintf(&folder, "%s/fonts", data) > 0
                      : home && asprintf(&folder, "%s/.local/share/fonts", home) > 0) {
        folder_search(folder, name, 0, &found);
        free(folder);
    }
    if (!found)
        folder_search("/usr/local/share/fonts", name, 0, &found);
    if (!found)
        folder_search("/usr/share/fonts", name, 0, &found);
    return found;
}
