/* session_file.c - see session_file.h. */
#include "session_file.h"

#include <growing_file.h>

#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { SYNC_S = 1 };

struct stage_session_file {
    char *path;
    struct growing_file file;
    int written;      /* of the session's actions: they do not change any more */
    int seen;         /* actions that are in the file's last state */
    double last;      /* the value of the last of them, which may still change */
    int64_t end_step; /* in the file's last line */
    bool begun, has_failed, has_said;
    char said[320];
    /* Who brings it to the disk. */
    pthread_t syncer;
    pthread_mutex_t mutex;
    pthread_cond_t wake;
    bool syncs, grown, ending; /* grown, ending: under the mutex */
    int descriptor;            /* the syncer's own */
};

static enum stage_status file_fail(const struct stage_session_file *f, const char *why)
{
    return stage_fail(STAGE_BAD_FILE, "%s: cannot be written: %s", f->path, why);
}

/* ---- to the disk ---- */

static void *sync_run(void *context)
{
    struct stage_session_file *f = context;
    struct timespec until;
    pthread_mutex_lock(&f->mutex);
    while (!f->ending) {
        clock_gettime(CLOCK_REALTIME, &until);
        until.tv_sec += SYNC_S;
        pthread_cond_timedwait(&f->wake, &f->mutex, &until);
        const bool grown = f->grown && !f->ending;
        f->grown = false;
        if (!grown)
            continue;
        pthread_mutex_unlock(&f->mutex);
        (void)fdatasync(f->descriptor); /* closing says what is wrong with the disk */
        pthread_mutex_lock(&f->mutex);
    }
    pthread_mutex_unlock(&f->mutex);
    return NULL;
}

/* Without a thread, the system brings the file to the disk when it likes. */
static void sync_begin(struct stage_session_file *f)
{
    f->descriptor = fcntl(fileno(f->file.out.stream), F_DUPFD_CLOEXEC, 3);
    f->syncs = f->descriptor >= 0 && pthread_create(&f->syncer, NULL, sync_run, f) == 0;
}

static void sync_end(struct stage_session_file *f)
{
    if (f->syncs) {
        pthread_mutex_lock(&f->mutex);
        f->ending = true;
        pthread_cond_signal(&f->wake);
        pthread_mutex_unlock(&f->mutex);
        pthread_join(f->syncer, NULL);
    }
    if (f->descriptor >= 0)
        close(f->descriptor);
    f->syncs = false;
    f->descriptor = -1;
}

/* ---- what grows ---- */

enum stage_status stage_session_file_open(const char *path, struct stage_session_file **out)
{
    *out = NULL;
    struct stage_session_file *f = calloc(1, sizeof *f);
    if (f)
        f->path = strdup(path);
    if (!f || !f->path) {
        free(f);
        return stage_fail(STAGE_NO_MEMORY, "no memory for a session");
    }
    f->descriptor = -1;
    pthread_mutex_init(&f->mutex, NULL);
    pthread_cond_init(&f->wake, NULL);
    const char *why = output_file_wrong(path); /* pipes, too: they have no end that moves */
    if (!why && !growing_file_open(&f->file, path))
        why = f->file.why;
    if (why) {
        const enum stage_status status = file_fail(f, why);
        stage_session_file_close(f, NULL, NULL);
        return status;
    }
    *out = f;
    return STAGE_OK;
}

/* The actions from the first to before the last as text, and from there to the end as what may
 * still change. */
static bool texts_make(const struct stage_session_file *f, const struct stage_session *s,
                       const struct control *rows, int last, int64_t step, char *texts[2],
                       size_t bytes[2])
{
    const int from[2] = {f->written, last}, to[2] = {last, s->count};
    for (int i = 0; i < 2; i++) {
        FILE *text = open_memstream(&texts[i], &bytes[i]);
        if (!text)
            return false;
        if (i == 0 && !f->begun)
            fprintf(text, "session 1\nbegin %016llx\n", (unsigned long long)s->begin);
        for (int d = from[i]; d < to[i]; d++)
            stage_session_deed_print(s, &s->deeds[d], rows, text);
        if (i == 1)
            fprintf(text, "end %lld\n", (long long)step);
        const bool failed = ferror(text) != 0;
        if (fclose(text) != 0 || failed)
            return false;
    }
    return true;
}

/* step: of the end. whole: nothing changes any more. */
static void grow(struct stage_session_file *f, const struct stage_session *s,
                 const struct control *rows, int64_t step, bool whole)
{
    char *texts[2] = {NULL, NULL};
    size_t bytes[2];
    const int last = whole || !s->count ? s->count : s->count - 1;
    const bool made = texts_make(f, s, rows, last, step, texts, bytes);
    if (made && growing_file_append(&f->file, texts[0], bytes[0], texts[1], bytes[1])) {
        f->begun = true;
        f->written = last;
        f->seen = s->count;
        f->last = s->count ? s->deeds[s->count - 1].value : 0;
        f->end_step = step;
    } else {
        snprintf(f->said, sizeof f->said, "%.200s is not being written: %.80s", f->path,
                 made ? f->file.why : "no memory");
        f->has_failed = f->has_said = true;
        sync_end(f);
        growing_file_close(&f->file);
        f->file = (struct growing_file){.descriptor = -1};
    }
    free(texts[0]);
    free(texts[1]);
}

void stage_session_file_add(struct stage_session_file *f, const struct stage_session *s,
                            const struct control *rows, int64_t step)
{
    const int64_t steps_of_end = 240; /* about a second */
    const bool changed =
        s->count != f->seen || (s->count && s->deeds[s->count - 1].value != f->last);
    if (!f->file.is_open || s->broken ||
        (f->begun && !changed && step < f->end_step + steps_of_end))
        return;
    grow(f, s, rows, step, false);
    if (!f->file.is_open)
        return;
    if (!f->syncs && f->descriptor < 0)
        sync_begin(f);
    pthread_mutex_lock(&f->mutex);
    f->grown = true;
    pthread_mutex_unlock(&f->mutex);
}

const char *stage_session_file_said(struct stage_session_file *f)
{
    const bool has = f->has_said;
    f->has_said = false;
    return has ? f->said : NULL;
}

enum stage_status stage_session_file_close(struct stage_session_file *f,
                                           const struct stage_session *s,
                                           const struct control *rows)
{
    enum stage_status status = STAGE_OK;
    sync_end(f);
    if (s && !s->broken && f->begun && f->file.is_open)
        grow(f, s, rows, s->end, true);
    if (s && s->broken)
        status = stage_fail(STAGE_BAD_ARGUMENT, "%s: the session ends early: %s", f->path,
                            s->broken);
    if (f->file.is_open) {
        if (!growing_file_close(&f->file))
            status = file_fail(f, f->file.why);
    } else if (s && !s->broken && f->has_failed) {
        status = stage_session_write(s, rows, f->path);
    }
    pthread_cond_destroy(&f->wake);
    pthread_mutex_destroy(&f->mutex);
    free(f->path);
    free(f);
    return status;
}
