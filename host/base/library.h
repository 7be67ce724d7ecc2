/* library.h - shared libraries that are loaded when they are first needed: most programs need
 * none of them, and each takes time to load.
 *
 *     static struct { int (*jack_activate)(void *client); } jack;
 *     static const struct library_function functions[] = {LIBRARY_FUNCTION(jack, jack_activate)};
 *     if (!library_load("libjack.so.0", functions, 1, &jack, &missing))
 *         say(missing ? missing : dlerror()); */
#ifndef LUTETIA_LIBRARY_H
#define LUTETIA_LIBRARY_H

#include <stdbool.h>
#include <stddef.h>

/* A function's name, and the place of its pointer in a table. */
struct library_function {
    const char *name;
    size_t at;
};
#define LIBRARY_FUNCTION(table, function)                                                      \
    {                                                                                          \
#function, offsetof(__typeof__(table), function)                                       \
    }

enum { LIBRARY_VERSION_MAX = 99999 };

/* Fills the table's pointers; the library stays loaded. "libjack.so.0" is the version that is
 * tried first: where it is not installed, or lacks a function, any other version that has them
 * all will do, the newest first. False: there is none (*missing is NULL, dlerror() says more),
 * or that version has no function *missing; the table is as it was then. Threads: the caller's
 * to order. */
bool library_load(const char *file, const struct library_function *functions, size_t count,
                  void *table, const char **missing);

/* The same with no other version than that: for libraries whose functions take structures that
 * differ. */
bool library_load_exactly(const char *file, const struct library_function *functions,
                          size_t count, void *table, const char **missing);

/* The versions of a library that lie where the loader looks, newest first: 8 for "libthing.so."
 * where there is libthing.so.8. Of more than `most` the newest. Returns how many there are. Any
 * thread. */
size_t library_versions(const char *stem, int *versions, size_t most);

#endif
