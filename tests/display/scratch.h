/* scratch.h - a folder for one test program's files, which is removed when the program ends.
 *
 *     const char *path = scratch_path("page.png");
 */
#ifndef LUTETIA_TEST_SCRATCH_H
#define LUTETIA_TEST_SCRATCH_H

#include <assert.h>
#include <dirent.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char scratch_dir[256];

/* The number of files in the folder. */
static inline int scratch_count(void)
{
    DIR *dir = opendir(scratch_dir);
    int count = 0;
    assert(dir);
    for (struct dirent *entry; (entry = readdir(dir));)
        count += entry->d_name[0] != '.';
    closedir(dir);
    return count;
}

static inline int scratch_drop(const char *path, const struct stat *about, int type,
                               struct FTW *where)
{
    (void)about;
    (void)type;
    if (where->level > 0)
        remove(path);
    return 0;
}

/* Removes all files and folders in the folder. */
static inline void scratch_empty(void)
{
    nftw(scratch_dir, scratch_drop, 8, FTW_DEPTH | FTW_PHYS);
}

static inline void scratch_remove(void)
{
    scratch_empty();
    rmdir(scratch_dir);
}

/* The path of a file in the folder; valid until the eighth call after this. */
static inline const char *scratch_path(const char *name)
{
    static char paths[8][512];
    static int turn;
    if (!scratch_dir[0]) {
        const char *tmp = getenv("TMPDIR");
        snprintf(scratch_dir, sizeof scratch_dir, "%s/lutetia-test-XXXXXX", tmp ? tmp : "/tmp");
        char *made = mkdtemp(scratch_dir);
        assert(made);
        atexit(scratch_remove);
    }
    char *path = paths[turn++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", scratch_dir, name);
    return path;
}

#endif
