/* ranks_start.c - a program that is linked with libparis may be one of several processes,
 * which a starter of MPI has made: they become ranks before main(), so that only the first one
 * prints, reads and writes files.
 *
 * It is in the shared library, and in tests. Where that is loaded later (dlopen), the loader's
 * lock is held: a rank that stayed here could load nothing more, as drivers do in threads of
 * their own. Then nothing happens here, and no machine can be made: machine_create() says
 * why. */
#include <dlfcn.h>
#include <link.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "machine_ranks.h"

enum { LIBRARIES_MOST = 512 };

static const char *base_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* The loader has added where the library is, but not to what it may not write to: the system's
 * own. */
static const char *strings_of(const struct link_map *library)
{
    const ElfW(Dyn) *d = library->l_ld;
    while (d->d_tag != DT_NULL && d->d_tag != DT_STRTAB)
        d++;
    if (d->d_tag != DT_STRTAB)
        return NULL;
    const ElfW(Addr) at = d->d_un.d_ptr;
    return (const char *)(at < library->l_addr ? at + library->l_addr : at);
}

/* Whether that is a library's name: its file's, or the one that it gives itself. */
static bool is_called(const struct link_map *library, const char *name)
{
    const char *strings = strings_of(library);
    if (strcmp(base_of(library->l_name), base_of(name)) == 0)
        return true;
    for (const ElfW(Dyn) *d = library->l_ld; strings && d->d_tag != DT_NULL; d++)
        if (d->d_tag == DT_SONAME && strcmp(strings + d->d_un.d_val, name) == 0)
            return true;
    return false;
}

/* Adds what the library needs to those that are found. */
static int needs_add(const struct link_map *library, struct link_map *all,
                     const struct link_map **found, int count)
{
    const char *strings = strings_of(library);
    for (const ElfW(Dyn) *d = library->l_ld; strings && d->d_tag != DT_NULL; d++) {
        if (d->d_tag != DT_NEEDED)
            continue;
        const struct link_map *it = all;
        while (it && !is_called(it, strings + d->d_un.d_val))
            it = it->l_next;
        int known = 0;
        while (it && known < count && found[known] != it)
            known++;
        if (it && known == count && count < LIBRARIES_MOST)
            found[count++] = it;
    }
    return count;
}

/* Whether the program needs this library, itself or through others: then it was loaded with the
 * program, which has not begun. */
static bool is_linked(const struct link_map *mine)
{
    const struct link_map *found[LIBRARIES_MOST];
    int count = 0;
    if (!_r_debug.r_map)
        return false;
    found[count++] = _r_debug.r_map;
    for (int i = 0; i < count; i++) {
        if (found[i] == mine)
            return true;
        count = needs_add(found[i], _r_debug.r_map, found, count);
    }
    return false;
}

__attribute__((constructor)) static void begin(void)
{
    Dl_info info;
    void *mine = NULL;
    if (dladdr1(&base_of, &info, &mine, RTLD_DL_LINKMAP) && is_linked(mine))
        machine_ranks_begin();
}
