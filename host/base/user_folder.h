/* user_folder.h - folders that only this user can write to: for caches, and for sockets.
 *
 *     char folder[USER_FOLDER_MAX];
 *     if (user_cache_folder("lutetia", folder))
 *         ... files in it are this user's own
 *
 * What lies in a cache is run: compiled kernels are loaded as code. So a cache is used only where nobody else can put a file:
 *
 *     $XDG_CACHE_HOME/NAME, else $HOME/.cache/NAME      made with mode 0700 where it is missing
 *     the folder itself                                 a folder, not a link; its owner this user; no write by others
 *     each folder above it                              its owner this user or root; no write by others, or sticky as /tmp is
 *
 * Where there is no such folder (no HOME; it cannot be made; a check fails), a private temporary folder takes its place: made
 * by mkdtemp(), mode 0700, one for each process, removed when the process exits. A process that is killed leaves it; the next one that
 * needs a temporary folder removes those of dead processes (a lock tells). */
#ifndef LUTETIA_USER_FOLDER_H
#define LUTETIA_USER_FOLDER_H

#include <stdbool.h>

enum { USER_FOLDER_MAX = 512 };

/* The path of this user's cache of that name ("lutetia", "pocl/kcache"), made and checked. False: neither it nor a temporary
 * folder could be made; there is no cache. *why, if asked for, says in one line why the temporary folder is used (until the thread's next call), or is NULL.
 * Threads: any. The temporary folder is the same for every call of a process, with the names below it. */
bool user_cache_folder(const char *name, char out[static USER_FOLDER_MAX], const char **why);

/* Whether nobody but this user (and root) can put or change a file in the folder: the checks above. NULL: it is so; else what is
 * wrong, in a few words. */
const char *user_folder_wrong(const char *path);

/* Whether a program that we are about to run is this user's or root's, and nobody else can put another in its place. NULL: it is
 * so; else what is wrong. */
const char *user_program_wrong(const char *path);

/* Makes the folder and those above it that are missing, with mode 0700. It may be there; whether it is there now, and whose it
 * is, user_folder_wrong() says. */
void user_folder_make(const char *path);

#endif
