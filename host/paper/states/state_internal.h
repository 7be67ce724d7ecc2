/* state_internal.h - shared by writing and reading of states.
 *
 * The first 512 bytes, text, the rest of them 0:
 *
 *     LUTETIA STATE 2                    the version of this format
 *     model 4                            the version of the paper's model; 1 to 3 are read, too
 *                                        (sheet.h)
 *     program X.Y.Z                      that wrote it
 *     bytes 123456                       of the whole file
 *     checksum 1a2b3c4d                  CRC-32 of all from byte 512 on, then of this, with
 *                                        these digits 0
 *     sheets 1 2 5                       their numbers
 *
 * Then HDF5: a group sheet-N for each, with attributes for people and programs that look at
 * it, "run" (bytes), and in "planes" a dataset for each plane, chunked, shuffled, deflated.
 * Nothing else is accepted when it is read.
 */
#ifndef LUTETIA_PAPER_STATE_INTERNAL_H
#define LUTETIA_PAPER_STATE_INTERNAL_H

#include "base/base.h"
#include "state.h"

#include <stdio.h>
#include <sys/types.h>

enum { STATE_VERSION = 2, STATE_HEADER_BYTES = 512 };

/* Computes the checksum of a file with that header (STATE_HEADER_BYTES), and the file's
 * length. False: errno is set. */
bool state_checksum(int descriptor, const char *header, uint32_t *checksum, long long *bytes);

/* ---- the reader: a process of its own ---- */

/* The longest run of a sheet, and the default limit of a reader's memory, in bytes. */
#define STATE_RUN_MAX (2ull << 30)
#define STATE_MEMORY_BYTES (3ull << 30)

struct state_reading {
    pid_t parent;
    int descriptor; /* of a regular file, open for reading; its header has been checked */
    int pipe;       /* where frames go */
    const int *numbers;
    int count;   /* number of sheets in the header */
    int number;  /* the one that is read */
    bool planes; /* its planes, too */
    int model;   /* the version of the paper's model that the header names */
    unsigned long long memory_bytes;
};

/* Confines the process, reads a sheet by HDF5 and writes it to the pipe; does not return
 * (states/state_reader.c). */
_Noreturn void state_reader(const struct state_reading *reading);

/* The format of its output: frames of a kind, a length (8 bytes, low first), and that many
 * bytes. */
enum {
    STATE_FRAME_RUN = 'R',
    STATE_FRAME_PLANE = 'P',
    STATE_FRAME_ERROR = 'E',
    STATE_FRAME_NO_MEMORY = 'M'
};

/* Opens an HDF5 file (hid_t) on a descriptor, for reading only; negative: failed
 * (states/state_driver.c). */
int64_t state_file_open(int descriptor);
/* What became of a file that is written: the first error, as errno has it; 0: none. It lasts as
 * long as the file is open. */
struct state_writing {
    int error;
};
/* Makes an HDF5 file (hid_t) on a descriptor of an empty file, with creation properties
 * (hid_t); negative: failed. What cannot be written is noted in *writing, and HDF5 does not
 * hear of it (states/state_driver.c). */
int64_t state_file_create(int descriptor, struct state_writing *writing, int64_t how);
/* Checks that the HDF5 file (hid_t) has the sheets of its header, and that the sheet
 * `number` has exactly what we write. Returns NULL if so, else the error in words. Reads no
 * data (states/state_walk.c). */
const char *state_walk(int64_t file, const int *numbers, int count, int number);

enum { STATE_NAME_MAX = 32 };
static inline void state_sheet_name(char name[static STATE_NAME_MAX], int number)
{
    snprintf(name, STATE_NAME_MAX, "sheet-%d", number);
}

#endif
