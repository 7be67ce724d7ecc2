/* input_file.h - a file that we read: whatever a name leads to, opening it holds nobody.
 *
 *     const char *why;
 *     FILE *in = input_file_open("marsh.lua", &why);
 *     if (!in)
 *         return fail("%s: cannot read: %s", "marsh.lua", why);
 *
 * A pipe without a writer waits for one, and a device may do anything when it is opened: only regular files are read. What comes
 * by a pipe comes by the standard input. Links are followed: what is read may lie anywhere. */
#ifndef LUTETIA_INPUT_FILE_H
#define LUTETIA_INPUT_FILE_H

#include <stdio.h>

/* NULL: it cannot be read, errno and *why (what is wrong, in words; may be NULL) say why not. The caller closes the stream. */
FILE *input_file_open(const char *path, const char **why);

/* The same as a descriptor; negative: it cannot be read. */
int input_file_descriptor(const char *path, const char **why);

#endif
