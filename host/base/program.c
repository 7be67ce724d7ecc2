/* program.c - see program.h */
#include "program.h"

#include "user_folder.h"

#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool program_find(char path[PATH_MAX], program_code *asker, const char *installed,
                  const char *built)
{
    const char *const places[] = {installed, built};
    char here[PATH_MAX];
    Dl_info info;
    bool known = dladdr((void *)(uintptr_t)asker, &info) && *info.dli_fname == '/' &&
                 realpath(info.dli_fname, here);
    if (!known && !realpath("/proc/self/exe", here)) /* fall back to the program itself,
                                                      * under the name by which it was called */
        return false;
    for (int up = 0; up < 4; up++) {
        char *end = strrchr(here, '/');
        if (!end)
            return false;
        *end = '\0';
        for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
            int n = *places[i] == '/' ? snprintf(path, PATH_MAX, "%s", places[i])
                                      : snprintf(path, PATH_MAX, "%s/%s", here, places[i]);
            if (n < PATH_MAX && !user_program_wrong(path))
                return true;
        }
    }
    return false;
}
