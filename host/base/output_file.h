/* output_file.h - writes a file that appears under its name whole, or not at all.
 *
 *     struct output_file out;
 *     if (!output_file_open(&out, "page.png"))
 *         return fail("%s: cannot write: %s", "page.png", out.why);
 *     fwrite(bytes, 1, count, out.stream);
 *     if (!output_file_commit(&out))
 *         return fail("%s: cannot write: %s", "page.png", out.why);
 *
 * The bytes go to a part file in the same folder:
 *
 *     page.png                            the name in the end
 *     .page.png.0123456789abcdef.part     while it is written: 64 random bits, made anew
 *                                         (O_EXCL), never a link
 *
 * A commit flushes the part file, brings it to the disk, gives it its name in one step
 * (rename), and brings the folder to the disk. So a reader of the name sees the old file or the
 * new one, even after a crash or on a full disk.
 *
 * If the name exists, it must be a regular file. Links, devices, pipes, sockets and folders are
 * refused, because a rename would replace them by a file.
 *
 * The writer holds a lock (flock) on its part file. A part file without a lock belongs to a
 * dead process. When a process opens its first file in a folder, it removes this user's
 * unlocked part files there. A signal that ends the process removes its part files
 * (part_files.h).
 *
 * Threads: functions for different files may run at the same time.
 */
#ifndef LUTETIA_OUTPUT_FILE_H
#define LUTETIA_OUTPUT_FILE_H

#include <stdbool.h>
#include <stdio.h>

struct output_file {
    FILE *stream; /* open for reading and writing, at its beginning; the struct owns the
                 * stream's buffer */
    char *part;   /* the part file's path, for libraries that open a path themselves */
    const char
        *why;  /* after a failure: what was wrong, and what to do where there is something */
    int error; /* after a failure: errno */
    /* private */
    char *name, *part_name;  /* both within the folder */
    char *former_name;       /* after output_file_appear(): what had the name before */
    int folder, former;      /* former: what had the name, locked; -1 */
    int noted, former_noted; /* part_file_note() */
};

/* Begins a file. False if it cannot be written there; nothing is left to release. A path
 * that ends with a slash, is empty or names a folder is refused. The mode is 0666 less the
 * process's umask. */
bool output_file_open(struct output_file *out, const char *path);

/* Ends the file and renames it. False if a write failed, before or now: the old file of that
 * name is untouched, and the part file is removed. Releases everything either way. */
bool output_file_commit(struct output_file *out);

/* Gives the file its name while it goes on being written. What had the name is kept under a
 * part file's name until the end: a commit removes it, and if that fails, or the file is
 * abandoned, it has its name again. False as for output_file_commit(). */
bool output_file_appear(struct output_file *out);

/* In a forked child: closes its parent's file, and leaves all names as they are. */
void output_file_let_go(struct output_file *out);

/* Gives up: removes the part file and leaves the old file of that name untouched. Does
 * nothing to a file that was committed, abandoned, or not opened (all zero). */
void output_file_abandon(struct output_file *out);

/* Checks, before long work, whether a file can be written there. Returns NULL if so, else
 * the reason. */
const char *output_file_wrong(const char *path);

/* Says in plain words what the errno of a failed write means, and what to do about it. */
const char *output_file_explain(int error);

/* Removes the part files that dead processes of this user have left in the folder. Called by
 * output_file_open(). */
void output_file_sweep(int folder_descriptor);

#endif
