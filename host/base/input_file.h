/* input_file.h - opens a file to be read; opening never blocks, whatever the name leads to.
 *
 *     const char *why;
 *     FILE *in = input_file_open("marsh.lua", &why);
 *     if (!in)
 *         return fail("%s: cannot read: %s", "marsh.lua", why);
 *
 * and reads it whole:
 *
 *     size_t bytes;
 *     char *text = input_file_read("marsh.lua", 1 << 20, &bytes, &why);
 *
 * Only regular files are opened: opening a pipe waits for a writer, and opening a device may
 * have any effect. Data from a pipe is read from the standard input instead. Links are
 * followed, so the file may lie anywhere.
 */
#ifndef LUTETIA_INPUT_FILE_H
#define LUTETIA_INPUT_FILE_H

#include <fcntl.h>
#include <stdio.h>

/* Returns NULL if the file cannot be read; errno and *why (the reason in words; may be NULL)
 * then say why. The caller closes the stream. */
FILE *input_file_open(const char *path, const char **why);

/* The same as a descriptor; negative if the file cannot be read. */
int input_file_descriptor(const char *path, const char **why);

/* The same, and the name itself may be no link (ELOOP): for files in folders of our own. */
int input_file_descriptor_no_link(const char *path, const char **why);

/* All of a file's bytes, and a 0 behind them, which is not counted. The caller frees them.
 * NULL: errno and *why (may be NULL) say why, errno is EFBIG if there are more than `most`
 * bytes, and *bytes is 0. A file that grows meanwhile is read to its new end. */
char *input_file_read(const char *path, size_t most, size_t *bytes, const char **why);

/* The same, and the name itself may be no link. */
char *input_file_read_no_link(const char *path, size_t most, size_t *bytes, const char **why);

/* The same of what is left of a stream, for pipes. The stream stays open. */
char *input_stream_read(FILE *in, size_t most, size_t *bytes, const char **why);

/* Opens a folder, within the folder `in` (AT_FDCWD: the current one), to read its names and to
 * open what is in it. No link. Negative: errno says why. */
int input_folder_descriptor(int in, const char *path);

#endif
