/* h5.h - HDF5 files with one plain array, made and read without HDF5's library: it may not be
 * let loose on files that anybody may have made (docs/security.md), and it takes longer to load
 * than a small program runs.
 *
 * What is made is the format of HDF5 1.0 to 1.8: a superblock of version 0, an old group, an
 * object header of version 1. What is read is that and the newer ones (superblocks of version 2
 * and 3, groups of links, object headers of version 2), which HDF5 2 writes if it is not asked
 * for another. Arrays must lie in one piece; for others there is h5repack. Checksums are not
 * looked at.
 *
 *     0     superblock: where the root group is        680   its local heap: names
 *     96    the root group's header                    784   its node of symbols: name, header
 *     136   its B-tree: where the node of symbols is   1112  the array's header: shape, type, place
 *                                                      2048  the values */
#ifndef PARIS_H5_H
#define PARIS_H5_H

#include "npy.h"

#include <stdio.h>

enum { H5_HEAD = 2048, H5_NAME_MAX = 63 };

/* Writes the head of a file with such an array; swapped and fortran are ignored. kind: u, i or
 * f. */
void h5_make(const struct npy *array, const char *name, uint8_t out[H5_HEAD]);
/* Finds an array in the root group; name "": the only one. `head` of it is where the values
 * begin. NULL: well done; else what is wrong, which is valid until the next call. */
const char *h5_read(FILE *in, const char *name, struct npy *array);

#endif
