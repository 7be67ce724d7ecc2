/* network_file.h - networks as text: written and read to the same bits. The format: docs/springs.md.
 *
 *     if (dyn_network_write(network, "word.springs") != DYN_OK)
 *         die(dyn_error());
 *     struct dyn_network *again;
 *     if (dyn_network_read("word.springs", &again) != DYN_OK)
 *         die(dyn_error());                      // word.springs:12: a spring cannot go from mass 3 to itself
 *
 * All that a network is goes with it, but for events that wait. */
#ifndef LUTETIA_DYN_NETWORK_FILE_H
#define LUTETIA_DYN_NETWORK_FILE_H

#include "network.h"

#include <stdio.h>

/* Errors: BAD_FILE: the file cannot be read, or a line of it says what cannot be (with the file's name and the line's number);
 * TOO_LARGE, NO_MEMORY. *out is then NULL. */
enum dyn_status dyn_network_read(const char *path, struct dyn_network **out);

/* The same of a text in memory; name: what errors call it. */
enum dyn_status dyn_network_parse(const char *text, size_t bytes, const char *name,
                                  struct dyn_network **out);

/* Errors: BAD_FILE: the file cannot be written; BAD_ARGUMENT: a mass is where no file can have it (the thesis's step
 * explodes). What had the name stays. */
enum dyn_status dyn_network_write(const struct dyn_network *n, const char *path);

/* The same text to a stream, whose errors are the caller's to look for. Errors: BAD_ARGUMENT as above, before anything is written. */
enum dyn_status dyn_network_print(const struct dyn_network *n, FILE *to);

#endif
