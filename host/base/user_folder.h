/* user_folder.h - folders that only this user can write to: for caches, and for sockets.
 *
 *     char folder[USER_FOLDER_MAX];
 *     if (user_cache_folder("lutetia", folder))
 *         ... files in it are this user's own
 *
 * Files in a cache are executed: compiled kernels are loaded as code. So a cache is used only
 * where nobody else can put a file:
 *
 *     $XDG_CACHE_HOME/NAME, else $HOME/.cache/NAME      made with mode 0700 where it is missing
 *     the folder itself                                 a folder, not a link; its owner this
 *                                                       user; no write by others
 *     each folder above it                              its owner this user or root; no write
 *                                                       by others, or sticky as /tmp is
 *
 * Where there is no such folder (no HOME; it cannot be made; a check fails), a private
 * temporary folder takes its place: made by mkdtemp(), mode 0700, one for each process,
 * removed when the process exits. A process that is killed leaves it; the next one that
 * needs a temporary folder removes those of dead processes (a lock tells).
 */
#ifndef LUTETIA_USER_FOLDER_H
#define LUTETIA_USER_FOLDER_H

#include <stdbool.h>
#include <stddef.h>

enum { USER_FOLDER_MAX = 512 };

/* Makes and checks this user's cache of that name ("lutetia", "pocl/kcache"), and returns
 * its path. False if neither this folder nor a temporary one could be made; there is no
 * cache. *why (may be NULL) gets one line that says why the temporary folder is used, valid
 * until the thread's next call, or NULL. Threads: any. The temporary folder is the same for
 * every call of a process, with the names below it. */
bool user_cache_folder(const char *name, char out[static USER_FOLDER_MAX], const char **why);

/* Makes a private folder in the temporary folder: /tmp/lutetia-KIND-XXXXXX, in TMPDIR if that
 * is set. The caller removes it. Those of this user's dead processes are removed, a lock tells
 * which. False: errno says why, and the path what was tried. */
bool user_folder_temporary(const char *kind, char *path, size_t room);

/* Checks that nobody but this user (and root) can put or change a file in the folder.
 * Returns NULL if so, else the reason in a few words. */
const char *user_folder_wrong(const char *path);

/* Checks that a program which we are about to run belongs to this user or root, and that
 * nobody else can replace it. Returns NULL if so, else the reason. */
const char *user_program_wrong(const char *path);

/* Makes the folder and its missing parents, with mode 0700. The folder may exist already.
 * The caller checks the result by user_folder_wrong(). */
void user_folder_make(const char *path);

#endif
