/* data.c - finds the files that come with the command: see lutetia.h. */
#include "lutetia.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

bool data_find(char path[PATH_MAX], const char *built, const char *installed)
{
    char home[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", home, sizeof home - 1);
    home[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(home, '/');
    if (!slash)
        return false;
    *slash = '\0';
    if (snprintf(path, PATH_MAX, "%s/%s", home, built) < PATH_MAX && access(path, R_OK) == 0)
        return true;
    return snprintf(path, PATH_MAX, "%s/../" LUTETIA_DATADIR "/lutetia/%s", home, installed) <
               PATH_MAX &&
           access(path, R_OK) == 0;
}
