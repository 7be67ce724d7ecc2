/* journal.h - what is done with a sheet, appended to a file as it is done: after a crash the
 * sheet is there again.
 *
 *     paper_state_save("marsh.h5", &(struct paper_state_sheet){1, sheet}, 1);
 *     struct paper_journal *journal;
 *     if (paper_journal_begin(sheet, "marsh.journal", "marsh.h5", &journal) != PAPER_OK)
 *         die(paper_error());
 *     ... the sheet is painted; once a second, in a thread of its own:
 *         paper_journal_sync(journal);
 *     paper_journal_close(journal);
 *
 *     struct paper_journal_found found;                                      // later
 *     if (paper_journal_open("marsh.journal", "marsh.h5", 256e6, &found, &sheet) != PAPER_OK)
 *         die(paper_error());
 *     paper_journal_continue(sheet, "marsh.journal", &found, &journal);
 *
 * A journal continues a saved state, whose digest it names, or, without one, the sheet as it
 * was made. It has an entry for each operation and each move in the history (undo, redo, seek,
 * insertion), with its length and a checksum. Whatever is lost of its end, the entries before
 * it are good. A stroke that grows is an entry when it has ended. Who saves a state again
 * begins another journal after it: as long as that is not there, the old one does not continue
 * the new state, which has all that it tells.
 *
 * Files are not trusted: an entry that is damaged, or that this sheet cannot do, ends the
 * journal there.
 *
 * Errors and ownership: as paper.h says. Threads: one thread calls paper_journal_sync() of a
 * journal, at any time until it is closed; all else belongs to the sheet's thread. */
#ifndef LUTETIA_PAPER_JOURNAL_H
#define LUTETIA_PAPER_JOURNAL_H

#include "history.h"

enum { PAPER_JOURNAL_WHY = 256 };

struct paper_journal;

/* Begins a journal of a sheet with a history, which is as in the state that was just saved or
 * loaded (NULL: as it was made, with nothing done), and keeps in memory what is done from now
 * on. The file replaces what had its name. Errors: BAD_ARGUMENT (no history, something is being
 * inserted or painted, followed, or told to another journal; the file cannot be written: the
 * system's reason), NO_MEMORY; *out is then NULL. Owns: the caller closes *out before the sheet
 * is destroyed. */
enum paper_status paper_journal_begin(struct paper_sheet *sheet, const char *path,
                                      const char *state, struct paper_journal **out);

/* Writes what is new, and brings it to the disk. Errors: BAD_ARGUMENT (the system's reason:
 * what was not written is kept, and written by the next call that can), NO_MEMORY (something
 * could not be kept: save a state and begin another journal). Threads: any one. */
enum paper_status paper_journal_sync(struct paper_journal *journal);

/* Syncs and ends it; nobody syncs it any more. NULL is fine. Errors: as paper_journal_sync();
 * it is closed either way. */
enum paper_status paper_journal_close(struct paper_journal *journal);

/* What was found when a journal was opened. */
struct paper_journal_found {
    bool continues;  /* the journal is there, and it continues the state */
    bool inserting;  /* it ended in an insertion, which was kept as far as it went */
    long entries;    /* that are good */
    long long whole; /* bytes of the file up to the end of the last of them, */
    long long bytes; /* and of all of it; 0: there is no file */
    char why[PAPER_JOURNAL_WHY]; /* what is wrong with the rest; "": nothing */
};

/* Makes the sheet again: the state (its first sheet; NULL: a fresh one of the journal's
 * description), then what the journal tells. A journal that is missing, damaged at its
 * beginning or of another state tells nothing, which is an error only without a state. The
 * operations are listed, and are computed when somebody looks; paper_history_set_watch() tells
 * of that. Errors: BAD_FILE, BAD_ARGUMENT (a file cannot be read: the system's reason),
 * NO_MEMORY, MACHINE_FAILED; *out is then NULL. Owns: the caller destroys *out. */
enum paper_status paper_journal_open(const char *path, const char *state, double budget_bytes,
                                     struct paper_journal_found *found,
                                     struct paper_sheet **out);

/* Goes on in the journal that the sheet was just opened with; what was not good of it is cut
 * off. Errors: BAD_ARGUMENT (also unless found->continues: begin another one), NO_MEMORY; *out
 * is then NULL. Owns: as paper_journal_begin(). */
enum paper_status paper_journal_continue(struct paper_sheet *sheet, const char *path,
                                         const struct paper_journal_found *found,
                                         struct paper_journal **out);

#endif
