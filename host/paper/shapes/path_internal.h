/* path_internal.h - what the readers of paths share. */
#ifndef LUTETIA_PAPER_PATH_INTERNAL_H
#define LUTETIA_PAPER_PATH_INTERNAL_H

#include "base/base.h"
#include "path.h"

enum { PAPER_FILE_MAX = 16 << 20 };

/* A whole file of up to PAPER_FILE_MAX bytes, ended by a 0. Owns: the caller frees *bytes. */
enum paper_status paper_file_read(const char *file, char **bytes, size_t *count);

#endif
