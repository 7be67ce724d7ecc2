/* oldest.c - see oldest.h. */
#include "oldest.h"

#include "array.h"
#include "input_file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { DEEPEST = 8, PATH_BYTES = 600 };

void oldest_add(struct oldest *o, const char *name, const char *stamp)
{
    char path[PATH_BYTES];
    struct stat status;
    int length =
        snprintf(path, sizeof path, "%s%s%s", name, stamp ? "/" : "", stamp ? stamp : "");
    if (o->failed || length < 0 || (size_t)length >= sizeof path ||
        fstatat(o->folder, path, &status, AT_SYMLINK_NOFOLLOW))
        return;
    char *kept = strdup(name);
    o->failed =
        !kept || !array_reserve(&o->entries, &o->capacity, o->count + 1, sizeof *o->entries);
    if (o->failed)
        free(kept);
    else
        o->entries[o->count++] = (struct oldest_entry){kept, status.st_mtim};
}

static bool tree_remove(int folder, const char *name, int depth)
{
    if (!unlinkat(folder, name, 0))
        return true;
    if ((errno != EISDIR && errno != EPERM) || depth == 0)
        return false;
    int inner = input_folder_descriptor(folder, name);
    DIR *list = inner >= 0 ? fdopendir(inner) : NULL;
    if (!list) {
        if (inner >= 0)
            close(inner);
        return false;
    }
    for (const struct dirent *e; (e = readdir(list));)
        if (strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0)
            tree_remove(inner, e->d_name, depth - 1);
    closedir(list);
    return unlinkat(folder, name, AT_REMOVEDIR) == 0;
}

static int by_time(const void *a, const void *b)
{
    const struct oldest_entry *x = a, *y = b;
    if (x->used.tv_sec != y->used.tv_sec)
        return x->used.tv_sec < y->used.tv_sec ? -1 : 1;
    return x->used.tv_nsec < y->used.tv_nsec ? -1 : x->used.tv_nsec > y->used.tv_nsec;
}

int oldest_remove(struct oldest *o, int most, double unused_s)
{
    struct timespec now;
    int removed = 0;
    clock_gettime(CLOCK_REALTIME, &now);
    if (o->count)
        qsort(o->entries, (size_t)o->count, sizeof *o->entries, by_time);
    for (int i = 0; i < o->count; i++) {
        const bool is_old = difftime(now.tv_sec, o->entries[i].used.tv_sec) >= unused_s;
        if (!o->failed && o->count - i > most && is_old)
            removed += tree_remove(o->folder, o->entries[i].name, DEEPEST);
        free(o->entries[i].name);
    }
    free(o->entries);
    *o = (struct oldest){.folder = o->folder};
    return removed;
}
