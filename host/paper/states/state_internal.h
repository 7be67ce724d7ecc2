/* state_internal.h - what writing and reading states share.
 *
 * The first 512 bytes, text, the rest of them 0:
 *
 *     LUTETIA STATE 1                    the version of this format
 *     model 1                            PAPER_MODEL_VERSION
 *     program 0.1.0
 *     bytes 123456                       of the whole file
 *     checksum 1a2b3c4d                  CRC-32 of all from byte 512 on, then of this, with these digits 0
 *     sheets 1 2 5                       their numbers
 *
 * Then HDF5: a group sheet-N for each, with attributes for people and programs that look at it, "run" (bytes), and in "planes" a
 * dataset for each plane, chunked, shuffled, deflated. */
#ifndef LUTETIA_PAPER_STATE_INTERNAL_H
#define LUTETIA_PAPER_STATE_INTERNAL_H

#include "base/base.h"
#include "state.h"

#include <stdio.h>

enum { STATE_VERSION = 1, STATE_HEADER_BYTES = 512 };

/* The checksum of a file with that header (STATE_HEADER_BYTES), and the file's length. False: errno says why. */
bool state_checksum(int descriptor, const char *header, uint32_t *checksum, long long *bytes);

/* Reads a sheet of a file by HDF5 and writes it to a descriptor (states/state_read.c); in a process of its own. */
_Noreturn void state_reader(const char *path, int number, bool planes, int descriptor);

/* What it writes: frames of a kind, a length (8 bytes, low first), and as many bytes. */
enum { STATE_FRAME_RUN = 'R', STATE_FRAME_PLANE = 'P', STATE_FRAME_ERROR = 'E' };

#endif
