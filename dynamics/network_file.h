/* network_file.h - networks as text; reading what was written gives the same bits. The format:
 * docs/springs.md.
 *
 *     if (dyn_network_write(network, "word.springs") != DYN_OK)
 *         die(dyn_error());
 *     struct dyn_network *again;
 *     if (dyn_network_read("word.springs", &again) != DYN_OK)
 *         // word.springs:12: a spring cannot go from mass 3 to itself
 *         die(dyn_error());
 *
 * Everything is written except waiting events.
 *
 * Errors, ownership and threads: as network.h says. */
#ifndef LUTETIA_DYN_NETWORK_FILE_H
#define LUTETIA_DYN_NETWORK_FILE_H

#include "network.h"

#include <stdio.h>

/* Errors: BAD_FILE: the file cannot be read, or a line is wrong (with the file's name and the
 * line's number); TOO_LARGE, NO_MEMORY. *out is then NULL. Owns: the caller destroys *out. */
enum dyn_status dyn_network_read(const char *path, struct dyn_network **out);

/* The same for a text in memory; name: used in errors. Errors: as dyn_network_read(). Owns: the
 * caller destroys *out. */
enum dyn_status dyn_network_parse(const char *text, size_t bytes, const char *name,
                                  struct dyn_network **out);

/* Errors: BAD_FILE: the file cannot be written; BAD_ARGUMENT: a mass's place is out of a
 * file's range (the thesis's step explodes). An existing file stays. */
enum dyn_status dyn_network_write(const struct dyn_network *n, const char *path);

/* Prints the same text to a stream; the caller checks the stream for errors. Errors:
 * BAD_ARGUMENT as above, before anything is written. */
enum dyn_status dyn_network_print(const struct dyn_network *n, FILE *to);

#endif
