/* state.h - sheets with all that was done to them, in files.
 *
 *     paper_state_save("marsh.h5", &(struct paper_state_sheet){1, sheet}, 1);
 *
 *     struct paper_state *state;
 *     if (paper_state_open("marsh.h5", &state) != PAPER_OK ||
 *         paper_state_load(state, 0, false, 256e6, &sheet) != PAPER_OK)
 *         die(paper_error());
 *     paper_state_close(state);
 *
 * A state is an HDF5 file: for each sheet a group with its planes (history.h) as arrays of height x width, and its run as
 * bytes. Other programs can read the planes. In the 512 bytes before HDF5's own stand the versions, the file's length and a checksum
 * of the rest.
 *
 * A file is written whole or not at all. It is read with suspicion: what is damaged is found by length and checksum; what
 * was made to do harm meets HDF5's library in a process of its own, which can open no file, has no more memory and time than reading
 * takes, and ends with this one. It accepts only what paper_state_save() writes: no links to other places, no data kept elsewhere, no
 * filters and types but ours. What it says is checked as all that comes from outside, before it is used.
 *
 * Errors and threads: as paper.h says. */
#ifndef LUTETIA_PAPER_STATE_H
#define LUTETIA_PAPER_STATE_H

#include "history.h"

enum { PAPER_STATE_SHEETS_MAX = 64 };

struct paper_state_sheet {
    int number; /* 1 or more: which of a program's sheets it is, as the program counts */
    struct paper_sheet *sheet;
};

/* By number, rising. Errors: BAD_ARGUMENT (a sheet without history; the file cannot be written: the system's reason),
 * NO_MEMORY, MACHINE_FAILED; what stood under that name stands as it was. */
enum paper_status paper_state_save(const char *path, const struct paper_state_sheet *sheets,
                                   int count);

struct paper_state;

/* Errors: BAD_FILE (not a state, damaged, of another version), BAD_ARGUMENT (cannot be read: the system's reason, or it is no regular
 * file), NO_MEMORY;
 * *out is then NULL. Owns: the caller closes *out. */
enum paper_status paper_state_open(const char *path, struct paper_state **out);
void paper_state_close(struct paper_state *state); /* NULL is fine */

/* What reading a sheet may take at most, in the process that reads and for its run here (3 GB where nobody says); more is NO_MEMORY.
 * The sheet that is made is not counted. */
void paper_state_limit(struct paper_state *state, double bytes);

int paper_state_count(const struct paper_state *state);
int paper_state_number(const struct paper_state *state, int index);

/* What sheet it is, before memory is taken for it. Errors: as paper_state_load(). */
enum paper_status paper_state_describe(struct paper_state *state, int index,
                                       struct paper_sheet_config *config);
/* Makes the sheet; `follow` and budget_bytes as paper_history_decode() has them.
 * Errors: BAD_FILE, NO_MEMORY, MACHINE_FAILED; *out is then NULL. Owns: the caller destroys *out. */
enum paper_status paper_state_load(struct paper_state *state, int index, bool follow,
                                   double budget_bytes, struct paper_sheet **out);

#endif
