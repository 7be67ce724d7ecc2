/* library.c - see library.h. */
#include "library.h"

#include <dirent.h>
#include <dlfcn.h>
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool library_load_exactly(const char *file, const struct library_function *functions,
                          size_t count, void *table, const char **missing)
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

/* The version in a file's name that is the stem and a number; -1: it is not. */
static int version_in(const char *name, const char *stem, size_t length)
{
    char *end = NULL;
    if (strncmp(name, stem, length) != 0 || name[length] < '0' || name[length] > '9')
        return -1;
    long version = strtol(name + length, &end, 10);
    return *end || version > LIBRARY_VERSION_MAX ? -1 : (int)version;
}

/* Inserts it, newest first, if it is new and there is room. */
static size_t version_add(int version, int *versions, size_t count, size_t most)
{
    size_t at = 0;
    while (at < count && versions[at] > version)
        at++;
    if (at == most || (at < count && versions[at] == version))
        return count;
    count = count < most ? count + 1 : most;
    memmove(versions + at + 1, versions + at, (count - at - 1) * sizeof *versions);
    versions[at] = version;
    return count;
}

size_t library_versions(const char *stem, int *versions, size_t most)
{
    Dl_serinfo size, *path = NULL;
    void *self = dlopen(NULL, RTLD_NOW);
    size_t count = 0;
    if (self && dlinfo(self, RTLD_DI_SERINFOSIZE, &size) == 0)
        path = malloc(size.dls_size);
    if (path && dlinfo(self, RTLD_DI_SERINFOSIZE, path) == 0 &&
        dlinfo(self, RTLD_DI_SERINFO, path) == 0) {
        for (unsigned i = 0; i < path->dls_cnt; i++) {
            DIR *folder = opendir(path->dls_serpath[i].dls_name);
            for (struct dirent *file; folder && (file = readdir(folder));) {
                int version = version_in(file->d_name, stem, strlen(stem));
                if (version >= 0)
                    count = version_add(version, versions, count, most);
            }
            if (folder)
                closedir(folder);
        }
    }
    free(path);
    if (self)
        dlclose(self);
    return count;
}

bool library_load(const char *file, const struct library_function *functions, size_t count,
                  void *table, const char **missing)
{
    enum { VERSIONS_MAX = 8 };
    int versions[VERSIONS_MAX];
    char stem[64], other[sizeof stem + 16];
    const char *end = strrchr(file, '.'), *lacking;
    if (library_load_exactly(file, functions, count, table, missing))
        return true;
    if (!end || (size_t)(end - file) + 2 > sizeof stem)
        return false;
    snprintf(stem, sizeof stem, "%.*s", (int)(end - file) + 1, file);
    size_t found = library_versions(stem, versions, VERSIONS_MAX);
    for (size_t i = 0; i < found; i++) {
        snprintf(other, sizeof other, "%s%d", stem, versions[i]);
        if (strcmp(other, file) != 0 &&
            library_load_exactly(other, functions, count, table, &lacking)) {
            *missing = NULL;
            return true;
        }
    }
    if (!*missing)
        (void)dlopen(file, RTLD_NOW | RTLD_LOCAL); /* so that dlerror() tells of this one */
    return false;
}
