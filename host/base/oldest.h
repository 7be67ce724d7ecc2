/* oldest.h - of many entries of a cache, those that were used last longest ago are removed.
 *
 *     struct oldest o = {.folder = descriptor};
 *     oldest_add (&o, "ab12.bin", NULL);                  for each entry
 *     removed = oldest_remove (&o, 4096, 3600);           until 4,096 are left; none that was
 *                                                         used in the last hour
 *
 * Links are removed, never followed. What cannot be removed stays. */
#ifndef LUTETIA_BASE_OLDEST_H
#define LUTETIA_BASE_OLDEST_H

#include <stdbool.h>
#include <time.h>

struct oldest_entry {
    char *name;
    struct timespec used;
};

struct oldest {
    int folder; /* its descriptor, which stays the caller's */
    struct oldest_entry *entries;
    int count, capacity;
    bool failed; /* no memory: nothing is removed */
};

/* A file, or a folder with all that is in it, by its path within the folder. stamp: the file in
 * it whose time of writing counts; NULL: the entry's own. An entry without such a file is
 * none. */
void oldest_add(struct oldest *o, const char *name, const char *stamp);
/* Returns how many were removed. Afterwards there is no entry to be removed. */
int oldest_remove(struct oldest *o, int most, double unused_s);

#endif
