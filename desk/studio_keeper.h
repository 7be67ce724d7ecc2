/* studio_keeper.h - the keeper's thread: once a second it brings to the disk what was done with
 * the sheet since it was saved (journal.h).
 *
 *     studio_keeper_begin(&keeper);
 *     studio_keeper_watch(&keeper, sheet, "marsh.h5.journal", "marsh.h5");
 *     ...
 *     // before the sheet goes: the journal is not needed any more, and removed
 *     studio_keeper_leave(&keeper);
 *     studio_keeper_end(&keeper);
 *
 * Threads: all functions belong to the paper's thread. */
#ifndef LUTETIA_STUDIO_KEEPER_H
#define LUTETIA_STUDIO_KEEPER_H

#include <journal.h>
#include <pthread.h>

enum { STUDIO_KEEPER_TEXT = 1100 };

struct studio_keeper {
    /* private */
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t wake;
    bool started, end;
    int held; /* on the journal's file, while it is this studio's; -1: none */
    struct paper_journal *journal; /* NULL: none */
    char path[STUDIO_KEEPER_TEXT];
    char error[STUDIO_KEEPER_TEXT]; /* of the last sync; "": it went well */
    bool told;
};

/* False: there is no thread; sheets are not kept then. */
bool studio_keeper_begin(struct studio_keeper *k);
void studio_keeper_end(struct studio_keeper *k);

/* Begins a journal of a sheet that was just saved in, or loaded from, `state` (NULL: as it was
 * made), or goes on in the one that it was opened with. A journal before that is closed; it is
 * removed if it has another name. Errors: as paper_journal_begin(); then the sheet is not
 * kept. */
enum paper_status studio_keeper_watch(struct studio_keeper *k, struct paper_sheet *sheet,
                                      const char *path, const char *state);
enum paper_status studio_keeper_continue(struct studio_keeper *k, struct paper_sheet *sheet,
                                         const char *path,
                                         const struct paper_journal_found *found);
/* Whether another studio writes this journal now: it holds a lock on its file. */
bool studio_keeper_held(const struct studio_keeper *k, const char *path);
/* Closes the journal and removes its file. */
void studio_keeper_leave(struct studio_keeper *k);
/* A journal that cannot be gone on with gets another name, PATH.kept or PATH.kept-2 and so on,
 * so that no other journal takes its place. False: it cannot be renamed; errno says why. */
bool studio_keeper_set_aside(const char *path, char *kept, size_t room);
/* True, once for each failure: the last sync failed, and `text` says why. */
bool studio_keeper_failed(struct studio_keeper *k, char *text, size_t room);

#endif
