/* output_file.h - a file that we write: whole under its name, or not there at all.
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
 *     .page.png.0123456789abcdef.part     while it is written: 64 random bits, made anew (O_EXCL), never a link
 *
 * A commit flushes the part file, brings it to the disk, gives it its name in one step (rename), and brings the folder to the disk.
 * So whoever opens the name sees the old file or the new one, after a crash and on a full disk, too.
 *
 * What has the name already must be a regular file, or nothing. Links, devices, pipes, sockets and folders are refused: a rename
 * would replace them by a file.
 *
 * The writer holds a lock (flock) on its part file. A part file that nobody holds is a dead process's: the first file that a
 * process opens in a folder sweeps the folder's part files of that kind, its own user's only.
 *
 * Threads: functions for different files may run at the same time. */
#ifndef LUTETIA_OUTPUT_FILE_H
#define LUTETIA_OUTPUT_FILE_H

#include <stdbool.h>
#include <stdio.h>

struct output_file {
    FILE *
        stream; /* open for reading and writing, at its beginning; its buffer is the stream's */
    char *part; /* the part file's path, for libraries that open a path themselves */
    const char
        *why;  /* after a failure: what was wrong, and what to do where there is something */
    int error; /* after a failure: errno */
    /* private */
    char *name, *part_name; /* both within the folder */
    int folder;
};

/* Begins a file. False: it cannot be written there; nothing is left to release. A path that ends with a slash, is empty or
 * names a folder is refused. The mode is 0666 less the process's umask. */
bool output_file_open(struct output_file *out, const char *path);

/* Ends the file: it now has its name. False: a write failed before or now; the file that had the name is untouched, and the
 * part file is gone. Releases everything either way. */
bool output_file_commit(struct output_file *out);

/* Gives up: the part file is gone, the file that had the name is untouched. Does nothing to a file that was committed,
 * abandoned, or not opened (all zero). */
void output_file_abandon(struct output_file *out);

/* Looks, before long work, whether a file can be written there: NULL where nothing is against it, else why not. */
const char *output_file_wrong(const char *path);

/* In plain words what an errno of a write means, with what to do about it. */
const char *output_file_explain(int error);

/* Removes the part files that dead processes of this user have left in the folder. Called by output_file_open(). */
void output_file_sweep(int folder_descriptor);

#endif
