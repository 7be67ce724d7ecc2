/* program.h - programs of ours that our code runs: the compiler of kernels beside a machine,
 * the benchmarks beside the command.
 *
 *     char path[PATH_MAX];
 *     if (program_find(path, of_this_code, LUTETIA_LIBEXECDIR "/lutetia/lutetia-compiler", "host/machine/lutetia-compiler"))
 *         ...
 */
#ifndef LUTETIA_PROGRAM_H
#define LUTETIA_PROGRAM_H

#include <limits.h>
#include <stdbool.h>

/* A function of the library or program that asks. */
typedef void program_code(void);

/* Finds one of our programs. Looks from the folder of `asker`'s code upwards, three folders
 * at most: under `installed` (which may be an absolute path) and under `built` (in a build's
 * folder). Only a file that nobody else can replace counts (user_folder.h). False: there is
 * none. */
bool program_find(char path[PATH_MAX], program_code *asker, const char *installed,
                  const char *built);

#endif
