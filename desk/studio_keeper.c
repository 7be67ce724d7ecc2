/* studio_keeper.c - see studio_keeper.h. */
#include "studio_keeper.h"

#include <input_file.h>

#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* ---- which studio's it is ---- */

static void lock_leave(struct studio_keeper *k)
{
    if (k->held >= 0)
        close(k->held);
    k->held = -1;
}

/* A journal that nobody could lock is kept all the same. */
static void lock_take(struct studio_keeper *k)
{
    k->held = input_file_descriptor(k->path, NULL);
    if (k->held >= 0 && flock(k->held, LOCK_EX | LOCK_NB) != 0)
        lock_leave(k);
}

bool studio_keeper_held(const struct studio_keeper *k, const char *path)
{
    struct stat own, named;
    const int file = input_file_descriptor(path, NULL);
    if (file < 0)
        return false;
    const bool ours = k->held >= 0 && fstat(k->held, &own) == 0 && fstat(file, &named) == 0 &&
                      own.st_dev == named.st_dev && own.st_ino == named.st_ino;
    const bool held = !ours && flock(file, LOCK_EX | LOCK_NB) != 0;
    close(file);
    return held;
}

/* ---- once a second ---- */

static void sync_now(struct studio_keeper *k)
{
    if (!k->journal)
        return;
    const bool good = paper_journal_sync(k->journal) == PAPER_OK;
    if (!good && !k->error[0])
        k->told = false;
    snprintf(k->error, sizeof k->error, "%s", good ? "" : paper_error());
}

static void *keeper_run(void *context)
{
    struct studio_keeper *k = context;
    pthread_mutex_lock(&k->lock);
    while (!k->end) {
        struct timespec until;
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_sec++;
        pthread_cond_timedwait(&k->wake, &k->lock, &until);
        sync_now(k);
    }
    pthread_mutex_unlock(&k->lock);
    return NULL;
}

bool studio_keeper_begin(struct studio_keeper *k)
{
    *k = (struct studio_keeper){.held = -1};
    pthread_mutex_init(&k->lock, NULL);
    pthread_cond_init(&k->wake, NULL);
    k->started = pthread_create(&k->thread, NULL, keeper_run, k) == 0;
    return k->started;
}

void studio_keeper_end(struct studio_keeper *k)
{
    pthread_mutex_lock(&k->lock);
    k->end = true;
    pthread_cond_signal(&k->wake);
    pthread_mutex_unlock(&k->lock);
    if (k->started)
        pthread_join(k->thread, NULL);
    paper_journal_close(k->journal);
    lock_leave(k);
    pthread_cond_destroy(&k->wake);
    pthread_mutex_destroy(&k->lock);
    *k = (struct studio_keeper){.held = -1};
}

/* ---- journals ---- */

/* The journal that there is goes: its file too, unless `path` is its name, whose file the next
 * journal replaces. */
static void journal_leave(struct studio_keeper *k, const char *path)
{
    paper_journal_close(k->journal);
    lock_leave(k);
    if (k->journal && (!path || strcmp(path, k->path) != 0))
        unlink(k->path);
    k->journal = NULL;
    k->error[0] = '\0';
}

static enum paper_status journal_take(struct studio_keeper *k, enum paper_status status,
                                      const char *path)
{
    if (status == PAPER_OK) {
        snprintf(k->path, sizeof k->path, "%s", path);
        lock_take(k);
    }
    pthread_mutex_unlock(&k->lock);
    return status;
}

enum paper_status studio_keeper_watch(struct studio_keeper *k, struct paper_sheet *sheet,
                                      const char *path, const char *state)
{
    pthread_mutex_lock(&k->lock);
    journal_leave(k, path);
    return journal_take(k, paper_journal_begin(sheet, path, state, &k->journal), path);
}

enum paper_status studio_keeper_continue(struct studio_keeper *k, struct paper_sheet *sheet,
                                         const char *path,
                                         const struct paper_journal_found *found)
{
    pthread_mutex_lock(&k->lock);
    journal_leave(k, path);
    return journal_take(k, paper_journal_continue(sheet, path, found, &k->journal), path);
}

void studio_keeper_leave(struct studio_keeper *k)
{
    pthread_mutex_lock(&k->lock);
    journal_leave(k, NULL);
    pthread_mutex_unlock(&k->lock);
}

bool studio_keeper_set_aside(const char *path, char *kept, size_t room)
{
    snprintf(kept, room, "%s.kept", path);
    for (int i = 2; access(kept, F_OK) == 0; i++)
        snprintf(kept, room, "%s.kept-%d", path, i);
    return rename(path, kept) == 0;
}

bool studio_keeper_failed(struct studio_keeper *k, char *text, size_t room)
{
    if (pthread_mutex_trylock(&k->lock) != 0) /* a disk that takes its time: told later */
        return false;
    const bool failed = k->error[0] && !k->told;
    if (failed)
        snprintf(text, room, "%s", k->error);
    k->told = k->told || failed;
    pthread_mutex_unlock(&k->lock);
    return failed;
}
