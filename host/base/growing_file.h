/* growing_file.h - opens a file that is written piece by piece while the program runs, and read meanwhile: traces, recordings.
 *
 *     int file = growing_file_open(getenv("LUTETIA_TRACE"));
 *
 * What is to appear whole is written by output_file.h. Here what was there is gone at once, so a link, which somebody else may have
 * put there, is not followed. Pipes and devices are as good as files; links of the system's, in /dev and /proc, lead to them. */
#ifndef LUTETIA_GROWING_FILE_H
#define LUTETIA_GROWING_FILE_H

/* A descriptor for writing; negative if it cannot be opened, and errno says why (ELOOP: it is a link). A regular file is empty then. */
int growing_file_open(const char *path);

#endif
