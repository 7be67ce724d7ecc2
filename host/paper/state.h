/* state.h - saves sheets with their histories in files.
 *
 *     paper_state_save("marsh.h5", &(struct paper_state_sheet){1, sheet}, 1);
 *
 *     struct paper_state *state;
 *     if (paper_state_open("marsh.h5", &state) != PAPER_OK ||
 *         paper_state_load(state, 0, false, 256e6, &sheet) != PAPER_OK)
 *         die(paper_error());
 *     paper_state_close(state);
 *
 * A state is an HDF5 file: for each sheet a group with its planes (history.h) as arrays of
 * height x width, and its run as bytes. Other programs can read the planes. In the 512 bytes
 * before HDF5's own stand the versions, the file's length and a checksum of the rest.
 *
 * A file is written whole or not at all. Files are not trusted when they are read. Damage is
 * found by length and checksum. HDF5's library runs in a process of its own, which can open no
 * file, has limits on memory and time, and ends with this one. Only what paper_state_save()
 * writes is accepted: no links to other places, no data kept elsewhere, no other filters and
 * types. The process's output is checked like all untrusted data before it is used.
 *
 * Errors, ownership and threads: as paper.h says.
 */
#ifndef LUTETIA_PAPER_STATE_H
#define LUTETIA_PAPER_STATE_H

#include "history.h"

enum { PAPER_STATE_SHEETS_MAX = 64 };

struct paper_state_sheet {
    int number; /* the sheet's number in its program, 1 or more */
    struct paper_sheet *sheet;
};

/* Saves sheets, in ascending order of their numbers. Errors: BAD_ARGUMENT (a sheet without
 * history; the file cannot be written: the system's reason), NO_MEMORY, MACHINE_FAILED; a
 * file that had the name is unchanged. */
enum paper_status paper_state_save(const char *path, const struct paper_state_sheet *sheets,
                                   int count);

struct paper_state;

/* Errors: BAD_FILE (not a state, damaged, of another version), BAD_ARGUMENT (cannot be read:
 * the system's reason, or it is no regular file), NO_MEMORY; *out is then NULL. Owns: the
 * caller closes *out. */
enum paper_status paper_state_open(const char *path, struct paper_state **out);
void paper_state_close(struct paper_state *state); /* NULL is fine */

/* Limits the memory for reading a sheet, both of the process that reads and of its run here
 * (default: 3 GB); beyond it, NO_MEMORY. The sheet that is made is not counted. */
void paper_state_limit(struct paper_state *state, double bytes);

/* How many sheets there are; the number, in its program, of the sheet at that index from 0. */
int paper_state_count(const struct paper_state *state);
int paper_state_number(const struct paper_state *state, int index);

/* Gets the sheet's description, before memory is allocated for the sheet. Errors: as
 * paper_state_load(). */
enum paper_status paper_state_describe(struct paper_state *state, int index,
                                       struct paper_sheet_config *config);
/* Makes the sheet; `follow` and budget_bytes: see paper_history_decode(). Errors: BAD_FILE,
 * NO_MEMORY, MACHINE_FAILED; *out is then NULL. Owns: the caller destroys *out. */
enum paper_status paper_state_load(struct paper_state *state, int index, bool follow,
                                   double budget_bytes, struct paper_sheet **out);

#endif
