/* path_internal.h - shared by the readers of paths. */
#ifndef LUTETIA_PAPER_PATH_INTERNAL_H
#define LUTETIA_PAPER_PATH_INTERNAL_H

#include "base/base.h"
#include "path.h"

enum { PAPER_FILE_MAX = 16 << 20 };

/* Reads a whole file of up to PAPER_FILE_MAX bytes, and appends a 0. Owns: the caller frees
 * *bytes. */
enum paper_status paper_file_read(const char *file, char **bytes, size_t *count);

#endif
