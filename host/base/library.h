/* library.h - shared libraries that are loaded when they are first needed: most programs need none of them, and each takes time to load.
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

/* Fills the table's pointers; the library stays loaded. False: it is not installed (*missing is NULL, dlerror() says more), or has no
 * function *missing; the table is as it was then. Threads: the caller's to order. */
bool library_load(const char *file, const struct library_function *functions, size_t count,
                  void *table, const char **missing);

#endif
