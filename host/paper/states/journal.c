/* journal.c - see journal.h; the bytes are in journal_entries.h.
 *
 *     the sheet's thread    told() ---> pending ---.  (under the lock)
 *     the syncing thread                           '--> writing ---> file, fdatasync
 *
 * What could not be written stays in `writing`, and goes to the same place of the file when it
 * can: a disk that was full loses nothing. */
#include "states/journal_entries.h"

#include "brush.h"
#include "state.h"

#include <input_file.h>
#include <output_file.h>
#include <sha256.h>

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct paper_journal {
    struct paper_sheet *sheet;
    pthread_mutex_t lock;
    struct event_bytes pending; /* and what stands below, up to `file`: under the lock */
    int steps;                  /* of an entry that may still grow */
    bool steps_joined;
    uint64_t entries;
    int file;
    struct event_bytes writing; /* the syncing thread's, like the rest */
    long long end;              /* of the file */
    bool dirty;                 /* something is written and may not be on the disk */
};

static enum paper_status no_memory(void)
{
    return paper_fail(PAPER_NO_MEMORY, "no memory for a journal");
}

static enum paper_status cannot(const char *path, const char *what, int error)
{
    return paper_fail(PAPER_BAD_ARGUMENT, "%s: cannot %s: %s", path, what,
                      output_file_explain(error));
}

/* ---- what is told ---- */

static void entry_put(struct paper_journal *j, const struct event_record *op, bool joined,
                      int move, long number)
{
    journal_entry_put(&j->pending, j->entries++, op, joined, move, number);
}

static void steps_put(struct paper_journal *j)
{
    const struct event_record op = {.kind = SHEET_EVENT_STEP, .steps = j->steps};
    if (j->steps > 0)
        entry_put(j, &op, j->steps_joined, 0, 0);
    j->steps = 0;
}

static void told(void *context, const struct event_record *op, bool joined, enum note_move move,
                 long number)
{
    struct paper_journal *j = context;
    pthread_mutex_lock(&j->lock);
    const bool step = op && op->kind == SHEET_EVENT_STEP;
    if (!(step && joined && j->steps > 0 && j->steps < INT32_MAX / 4))
        steps_put(j);
    if (step) {
        j->steps_joined = j->steps > 0 ? j->steps_joined : joined;
        j->steps++;
    } else {
        entry_put(j, op, joined, (int)move, number);
    }
    pthread_mutex_unlock(&j->lock);
}

/* ---- files ---- */

/* False: errno says why. */
static bool digest_of(const char *path, uint8_t digest[JOURNAL_DIGEST])
{
    struct sha256 sum;
    uint8_t piece[1 << 14];
    FILE *in = input_file_open(path, NULL);
    if (!in)
        return false;
    sha256_begin(&sum);
    for (size_t count; (count = fread(piece, 1, sizeof piece, in)) > 0;)
        sha256_add(&sum, piece, count);
    const bool read = !ferror(in);
    sha256_end(&sum, digest);
    fclose(in);
    return read;
}

static enum paper_status begin_check(const struct paper_sheet *p, bool fresh)
{
    const struct sheet_history *h = history_of(p);
    const char *why = !h                              ? "the sheet has no history"
                      : h->tell                       ? "the sheet has a journal already"
                      : h->inserting_at >= 0          ? "something is being inserted"
                      : paper_sheet_stroke_growing(p) ? "a stroke is being painted"
                      : h->following                  ? "a saved run is being followed"
                      : fresh && h->log.count
                          ? "without a state, a journal begins with a sheet "
                            "that nothing has been done to"
                          : NULL;
    return why ? paper_fail(PAPER_BAD_ARGUMENT, "%s", why) : PAPER_OK;
}

/* A journal on an open file, which is its own from now on. */
static enum paper_status journal_make(struct paper_sheet *p, int file, long long end,
                                      uint64_t entries, struct paper_journal **out)
{
    struct paper_journal *j = calloc(1, sizeof *j);
    if (!j) {
        close(file);
        return no_memory();
    }
    j->sheet = p;
    j->file = file;
    j->end = end;
    j->entries = entries;
    pthread_mutex_init(&j->lock, NULL);
    history_of(p)->tell = told;
    history_of(p)->tell_context = j;
    *out = j;
    return PAPER_OK;
}

static int file_open(const char *path)
{
    return open(path, O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

static enum paper_status head_write(const char *path, const struct event_bytes *head)
{
    struct output_file file;
    if (!output_file_open(&file, path))
        return paper_fail(PAPER_BAD_ARGUMENT, "%s: cannot write: %s", path, file.why);
    fwrite(head->at, 1, head->count, file.stream);
    return output_file_commit(&file)
               ? PAPER_OK
               : paper_fail(PAPER_BAD_ARGUMENT, "%s: cannot write: %s", path, file.why);
}

enum paper_status paper_journal_begin(struct paper_sheet *p, const char *path,
                                      const char *state, struct paper_journal **out)
{
    struct journal_head head = {.config = *paper_sheet_get_config(p)};
    struct event_bytes bytes = {0};
    *out = NULL;
    enum paper_status status = begin_check(p, !state);
    if (status == PAPER_OK && state && !digest_of(state, head.digest))
        status = cannot(state, "read", errno);
    if (status != PAPER_OK)
        return status;
    journal_head_put(&bytes, &head);
    status = bytes.short_of_memory ? no_memory() : head_write(path, &bytes);
    const int file = status == PAPER_OK ? file_open(path) : -1;
    if (status == PAPER_OK && file < 0)
        status = cannot(path, "write", errno);
    if (status == PAPER_OK)
        status = journal_make(p, file, (long long)bytes.count, 0, out);
    free(bytes.at);
    return status;
}

/* ---- writing ---- */

/* Takes what is pending. False: something is lost. */
static bool pending_take(struct paper_journal *j)
{
    pthread_mutex_lock(&j->lock);
    steps_put(j);
    struct event_bytes taken = j->pending;
    j->pending = (struct event_bytes){.short_of_memory = taken.short_of_memory};
    pthread_mutex_unlock(&j->lock);
    if (j->writing.count == 0) {
        free(j->writing.at);
        j->writing = taken;
    } else {
        event_put_bytes(&j->writing, taken.at, taken.count);
        j->writing.short_of_memory |= taken.short_of_memory;
        free(taken.at);
    }
    return !j->writing.short_of_memory;
}

/* False: errno says why. */
static bool writing_write(struct paper_journal *j)
{
    size_t done = 0;
    bool good = true;
    while (good && done < j->writing.count) {
        const ssize_t more =
            pwrite(j->file, j->writing.at + done, j->writing.count - done, (off_t)j->end);
        if (more == 0)
            errno = EIO;
        if (more > 0) {
            done += (size_t)more;
            j->end += more;
            j->dirty = true;
        }
        good = more > 0 || (more < 0 && errno == EINTR);
    }
    j->writing.count -= done;
    if (j->writing.count > 0)
        memmove(j->writing.at, j->writing.at + done, j->writing.count);
    if (good && j->dirty && fdatasync(j->file) != 0)
        return false;
    j->dirty = j->dirty && !good;
    return good;
}

enum paper_status paper_journal_sync(struct paper_journal *j)
{
    const bool whole = pending_take(j);
    if (!writing_write(j))
        return cannot("the journal", "write", errno);
    return whole ? PAPER_OK : no_memory();
}

enum paper_status paper_journal_close(struct paper_journal *j)
{
    if (!j)
        return PAPER_OK;
    history_of(j->sheet)->tell = NULL;
    enum paper_status status = paper_journal_sync(j);
    close(j->file);
    pthread_mutex_destroy(&j->lock);
    free(j->pending.at);
    free(j->writing.at);
    free(j);
    return status;
}

/* ---- opening ---- */

/* Owns: the caller frees *bytes; NULL: there is no file. */
static enum paper_status file_read(const char *path, uint8_t **bytes, size_t *count)
{
    *bytes = (uint8_t *)input_file_read(path, SIZE_MAX / 4, count, NULL);
    if (*bytes || errno == ENOENT)
        return PAPER_OK;
    return errno == ENOMEM ? no_memory() : cannot(path, "read", errno);
}

static enum paper_status state_make(const char *path, double budget_bytes,
                                    struct paper_sheet **out)
{
    struct paper_state *state;
    enum paper_status status = paper_state_open(path, &state);
    if (status != PAPER_OK)
        return status;
    status = paper_state_count(state) > 0
                 ? paper_state_load(state, 0, false, budget_bytes, out)
                 : paper_fail(PAPER_BAD_FILE, "%s: there is no sheet in it", path);
    paper_state_close(state);
    return status;
}

static enum paper_status fresh_make(const struct journal_head *head, double budget_bytes,
                                    struct paper_sheet **out)
{
    enum paper_status status = paper_sheet_create(&head->config, out);
    if (status == PAPER_BAD_ARGUMENT)
        return paper_fail(PAPER_BAD_FILE, "the journal's description of the sheet is damaged");
    if (status == PAPER_OK)
        status = paper_history_begin(*out, budget_bytes);
    return status;
}

static void why_set(struct paper_journal_found *found, const char *why)
{
    snprintf(found->why, sizeof found->why, "%s", why);
}

/* Whether the journal continues what was made; found->why says why not. */
static bool continues(const struct journal_head *head, const struct paper_sheet *p,
                      const char *state, struct paper_journal_found *found)
{
    uint8_t digest[JOURNAL_DIGEST] = {0};
    const char *why = NULL;
    if (state && !digest_of(state, digest))
        why = "the state cannot be read again";
    else if (memcmp(digest, head->digest, sizeof digest) != 0)
        why = "the journal continues another state";
    else if (!paper_sheet_config_same(&head->config, paper_sheet_get_config(p)))
        why = "the journal is of another sheet";
    if (why)
        why_set(found, why);
    return !why;
}

static enum paper_status entries_do(struct event_reader *r, const struct journal_head *head,
                                    struct paper_sheet *p, struct paper_journal_found *found)
{
    enum paper_status status = PAPER_OK;
    while (r->at < r->end && status == PAPER_OK) {
        status = journal_entry_do(r, (uint64_t)found->entries, head, p);
        found->entries += status == PAPER_OK;
    }
    if (status == PAPER_BAD_FILE)
        why_set(found, paper_error());
    if (status != PAPER_OK && status != PAPER_BAD_FILE)
        return status;
    found->inserting = history_of(p)->inserting_at >= 0;
    return found->inserting ? paper_history_insert_end(p, true) : PAPER_OK;
}

enum paper_status paper_journal_open(const char *path, const char *state, double budget_bytes,
                                     struct paper_journal_found *found,
                                     struct paper_sheet **out)
{
    struct journal_head head;
    uint8_t *bytes;
    size_t count;
    struct paper_sheet *p = NULL;
    *found = (struct paper_journal_found){0};
    *out = NULL;
    enum paper_status status = file_read(path, &bytes, &count), head_status = PAPER_BAD_FILE;
    if (status != PAPER_OK)
        return status;
    struct event_reader r = {bytes, bytes ? bytes + count : NULL, false};
    found->bytes = (long long)count;
    if (bytes)
        head_status = journal_head_get(&r, &head);
    if (bytes && head_status != PAPER_OK)
        why_set(found, paper_error());
    if (state)
        status = state_make(state, budget_bytes, &p);
    else if (!bytes)
        status = cannot(path, "read", ENOENT);
    else
        status = head_status == PAPER_OK ? fresh_make(&head, budget_bytes, &p) : head_status;
    if (status == PAPER_OK && head_status == PAPER_OK && continues(&head, p, state, found)) {
        found->continues = true;
        status = entries_do(&r, &head, p, found);
        found->whole = r.at - bytes;
    }
    free(bytes);
    if (status != PAPER_OK)
        paper_sheet_destroy(p);
    else
        *out = p;
    return status;
}

enum paper_status paper_journal_continue(struct paper_sheet *p, const char *path,
                                         const struct paper_journal_found *found,
                                         struct paper_journal **out)
{
    *out = NULL;
    enum paper_status status = begin_check(p, false);
    if (status == PAPER_OK && !found->continues)
        status = paper_fail(PAPER_BAD_ARGUMENT, "%s: it is not this sheet's journal", path);
    if (status != PAPER_OK)
        return status;
    const int file = file_open(path);
    if (file < 0)
        return cannot(path, "write", errno);
    if (ftruncate(file, (off_t)found->whole) != 0) {
        const int error = errno;
        close(file);
        return cannot(path, "write", error);
    }
    status = journal_make(p, file, found->whole, (uint64_t)found->entries, out);
    if (status == PAPER_OK && found->inserting)
        told(*out, NULL, false, NOTE_INSERT_END, 1);
    return status;
}
