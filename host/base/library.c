/* library.c - see library.h. */
#include "library.h"

#include <dlfcn.h>
#include <string.h>

bool library_load(const char *file, const struct library_function *functions, size_t count,
                  void *table, const char **missing)
{
    void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    *missing = NULL;
    for (size_t i = 0; library && !*missing && i < count; i++)
        if (!dlsym(library, functions[i].name))
            *missing = functions[i].name;
    if (*missing) {
        dlclose(library);
        return false;
    }
    for (size_t i = 0; library && i < count; i++) {
        void *found = dlsym(library, functions[i].name);
        memcpy((char *)table + functions[i].at, &found, sizeof found); /* as POSIX has it */
    }
    return library != NULL;
}
