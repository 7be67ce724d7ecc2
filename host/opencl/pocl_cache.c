/* pocl_cache.c - see pocl_cache.h.
 *
 *     POCL_CACHE_DIR/AB/CDEFGH.../last_accessed       a program: PoCL touches this file when it
 *                                                     builds or loads it
 *                                /program.bc, k/...
 *
 * Only folders of such names with such a file are programs. */
#include "pocl_cache.h"

#include <dirent.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "input_file.h"
#include "oldest.h"

enum { FIRST_LETTERS = 2, LETTERS_LEAST = 30 };
static const char STAMP[] = "last_accessed";

static bool is_name(const char *name, size_t least, size_t most)
{
    const size_t length = strspn(name, "ABCDEFGHIJKLMNOP");
    return name[length] == '\0' && length >= least && length <= most;
}

static DIR *folder_open(int in, const char *name)
{
    int folder = input_folder_descriptor(in, name);
    DIR *list = folder >= 0 ? fdopendir(folder) : NULL;
    if (folder >= 0 && !list)
        close(folder);
    return list;
}

/* Counts the files of one of the folders of two letters, or adds them to the list. */
static int programs_of(int cache, const char *letters, struct oldest *o)
{
    char path[64];
    int count = 0;
    DIR *list = folder_open(cache, letters);
    for (const struct dirent *e; list && (e = readdir(list));) {
        if (!is_name(e->d_name, LETTERS_LEAST, sizeof path - FIRST_LETTERS - 2))
            continue;
        count++;
        snprintf(path, sizeof path, "%.2s/%.60s", letters, e->d_name);
        if (o)
            oldest_add(o, path, STAMP);
    }
    if (list)
        closedir(list);
    return count;
}

static int programs_all(DIR *cache, struct oldest *o)
{
    int count = 0;
    rewinddir(cache);
    for (const struct dirent *e; (e = readdir(cache));)
        if (is_name(e->d_name, FIRST_LETTERS, FIRST_LETTERS))
            count += programs_of(dirfd(cache), e->d_name, o);
    return count;
}

int pocl_cache_trim(const char *folder, int most, double unused_s)
{
    DIR *cache = folder_open(AT_FDCWD, folder);
    int removed = 0;
    if (cache && programs_all(cache, NULL) > most) {
        struct oldest o = {.folder = dirfd(cache)};
        programs_all(cache, &o);
        removed = oldest_remove(&o, most, unused_s);
    }
    if (cache)
        closedir(cache);
    return removed;
}
