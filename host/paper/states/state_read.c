/* state_read.c - reads sheets from an untrusted file.
 *
 *     this process                          the reader's, forked for each sheet
 *                                           (states/state_reader.c)
 *     header, length, checksum
 *     frames  <------------ pipe ---------- HDF5: run, then planes, or an error in words
 *     run decoded, planes checked (history/run.c, checkpoint.c)
 *
 * HDF5's library is large and meant for trusted files. Whatever a file makes it do affects
 * only the reader's process; here the pipe ends. The file is opened once, here, and the
 * reader inherits the descriptor, so it reads the file that was checked.
 */
#include "states/hdf5_library.h"
#include "states/state_internal.h"

#include <input_file.h>

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

struct paper_state {
    char *path;
    int descriptor;
    unsigned long long memory_bytes; /* paper_state_limit() */
    int model; /* the version of the paper's model that the header names */
    int count;
    int numbers[PAPER_STATE_SHEETS_MAX];
    /* the reader while it runs */
    pid_t reader;
    int pipe;
};

/* ---- this side ---- */

static enum paper_status file_bad(const struct paper_state *state, const char *what)
{
    return paper_fail(PAPER_BAD_FILE, "%s: %s", state->path, what);
}

/* Prefixes the last failure with the file's name. */
static enum paper_status file_failed(const struct paper_state *state, enum paper_status status)
{
    char what[600];
    snprintf(what, sizeof what, "%s", paper_error());
    return paper_fail(status, "%s: %s", state->path, what);
}

static enum paper_status reader_start(struct paper_state *state, int index, bool planes)
{
    int ends[2];
    enum paper_status status = hdf5_load(state->path);
    if (status != PAPER_OK)
        return status;
    if (pipe2(ends, O_CLOEXEC) != 0)
        return paper_fail(PAPER_NO_MEMORY, "%s: cannot read: %s", state->path, strerror(errno));
    fflush(NULL);
    pid_t parent = getpid();
    state->reader = fork();
    if (state->reader == 0) {
        close(ends[0]);
        state_reader(&(struct state_reading){.parent = parent,
                                             .descriptor = state->descriptor,
                                             .pipe = ends[1],
                                             .numbers = state->numbers,
                                             .count = state->count,
                                             .number = state->numbers[index],
                                             .planes = planes,
                                             .model = state->model,
                                             .memory_bytes = state->memory_bytes});
    }
    close(ends[1]);
    state->pipe = ends[0];
    if (state->reader > 0)
        return PAPER_OK;
    close(ends[0]);
    state->pipe = -1;
    return paper_fail(PAPER_NO_MEMORY, "%s: cannot read: %s", state->path, strerror(errno));
}

static void reader_end(struct paper_state *state)
{
    int status;
    if (state->pipe >= 0)
        close(state->pipe);
    state->pipe = -1;
    if (state->reader > 0) {
        kill(state->reader, SIGKILL);
        while (waitpid(state->reader, &status, 0) < 0 && errno == EINTR)
            ;
    }
    state->reader = 0;
}

static bool all_read(int descriptor, void *bytes, size_t count)
{
    char *at = bytes;
    while (count > 0) {
        ssize_t done = read(descriptor, at, count);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return false;
        at += done;
        count -= (size_t)done;
    }
    return true;
}

static enum paper_status memory_short(const struct paper_state *state)
{
    return paper_fail(PAPER_NO_MEMORY, "%s: not enough memory to read it (%.0f MB are allowed)",
                      state->path, (double)state->memory_bytes * 1e-6);
}

/* The next frame's length if it is of the kind; else fails with the reader's message. */
static enum paper_status frame_begin(struct paper_state *state, char kind, uint64_t *count)
{
    uint8_t head[9];
    char said[100] = "";
    if (!all_read(state->pipe, head, sizeof head))
        return file_bad(state, "it is damaged: HDF5 cannot read it");
    *count = 0;
    for (int i = 0; i < 8; i++)
        *count |= (uint64_t)head[1 + i] << 8 * i;
    if (head[0] == (uint8_t)kind)
        return PAPER_OK;
    if (head[0] == STATE_FRAME_NO_MEMORY)
        return memory_short(state);
    if (head[0] == STATE_FRAME_ERROR && *count < sizeof said)
        all_read(state->pipe, said, (size_t)*count);
    for (char *c = said; *c; c++)
        *c = *c >= ' ' && *c < 127 ? *c : '?';
    return file_bad(state, *said ? said : "it is damaged");
}

static enum paper_status run_read(struct paper_state *state, uint8_t **run, size_t *count)
{
    uint64_t length = 0;
    *run = NULL;
    enum paper_status status = frame_begin(state, STATE_FRAME_RUN, &length);
    if (status == PAPER_OK && length > STATE_RUN_MAX)
        status = file_bad(state, "its run is too long");
    else if (status == PAPER_OK && length > state->memory_bytes)
        status = memory_short(state);
    if (status != PAPER_OK)
        return status;
    *run = malloc(length ? (size_t)length : 1);
    *count = (size_t)length;
    if (!*run)
        return paper_fail(PAPER_NO_MEMORY, "%s: no memory for its run", state->path);
    if (!all_read(state->pipe, *run, (size_t)length)) {
        free(*run);
        *run = NULL;
        return file_bad(state, "it is damaged");
    }
    return PAPER_OK;
}

struct planes_from {
    struct paper_state *state;
    uint64_t bytes;
};

static enum paper_status plane_read(void *context, int number, void *words)
{
    (void)number; /* planes come in order */
    struct planes_from *from = context;
    uint64_t count;
    enum paper_status status = frame_begin(from->state, STATE_FRAME_PLANE, &count);
    if (status != PAPER_OK)
        return status;
    return count == from->bytes && all_read(from->state->pipe, words, (size_t)count)
               ? PAPER_OK
               : file_bad(from->state, "it is damaged");
}

enum paper_status paper_state_describe(struct paper_state *state, int index,
                                       struct paper_sheet_config *config)
{
    uint8_t *run = NULL;
    size_t count = 0;
    enum paper_status status = reader_start(state, index, false);
    if (status == PAPER_OK)
        status = run_read(state, &run, &count);
    if (status == PAPER_OK && paper_history_describe(run, count, config) != PAPER_OK)
        status = file_failed(state, PAPER_BAD_FILE);
    reader_end(state);
    free(run);
    return status;
}

enum paper_status paper_state_load(struct paper_state *state, int index, bool follow,
                                   double budget_bytes, struct paper_sheet **out)
{
    uint8_t *run = NULL;
    size_t count = 0;
    struct paper_sheet_config config;
    *out = NULL;
    enum paper_status status = reader_start(state, index, true);
    if (status == PAPER_OK)
        status = run_read(state, &run, &count);
    if (status == PAPER_OK && paper_history_describe(run, count, &config) != PAPER_OK)
        status = file_failed(state, PAPER_BAD_FILE);
    else if (status == PAPER_OK) {
        struct planes_from from = {state, 4 * (uint64_t)config.width * (uint64_t)config.height};
        status = paper_history_decode(run, count, follow, budget_bytes, plane_read, &from, out);
        if (status != PAPER_OK && strncmp(paper_error(), state->path, strlen(state->path)) != 0)
            status = file_failed(state, status);
    }
    reader_end(state);
    free(run);
    return status;
}

/* ---- the header ---- */

static enum paper_status header_read(struct paper_state *state, const char *header,
                                     uint32_t *checksum, long long *bytes)
{
    int version = 0, model = 0, used = 0;
    char program[33] = "";
    if (sscanf(header, "LUTETIA STATE %d\nmodel %d\nprogram %32s\n%n", &version, &model,
               program, &used) != 3 ||
        used == 0)
        return file_bad(state, "it is not a saved state");
    state->model = model;
    if (version != STATE_VERSION || model < PAPER_MODEL_READ || model > PAPER_MODEL_VERSION)
        return paper_fail(PAPER_BAD_FILE,
                          "%s: it was saved by program %s (format %d, model of paper %d); this "
                          "one reads format %d, model %d",
                          state->path, program, version, model, STATE_VERSION,
                          PAPER_MODEL_VERSION);
    int more = 0;
    if (sscanf(header + used, "bytes %18lld\nchecksum %8x\nsheets%n", bytes, checksum, &more) !=
            2 ||
        more == 0)
        return file_bad(state, "it is damaged: its header is");
    const char *at = header + used + more;
    while (*at == ' ') {
        int number = 0, digits = 0;
        if (sscanf(at, " %9d%n", &number, &digits) != 1 || number < 1 ||
            state->count == PAPER_STATE_SHEETS_MAX ||
            (state->count > 0 && number <= state->numbers[state->count - 1]))
            return file_bad(state, "it is damaged: its header is");
        state->numbers[state->count++] = number;
        at += digits;
    }
    return *at == '\n' ? PAPER_OK : file_bad(state, "it is damaged: its header is");
}

enum paper_status paper_state_open(const char *path, struct paper_state **out)
{
    struct paper_state *state = calloc(1, sizeof *state);
    char header[STATE_HEADER_BYTES + 1] = "";
    uint32_t checksum = 0, found = 0;
    long long bytes = 0, length = 0;
    *out = NULL;
    if (!state || !(state->path = strdup(path))) {
        free(state);
        return paper_fail(PAPER_NO_MEMORY, "no memory for a saved state");
    }
    state->pipe = -1;
    state->memory_bytes = STATE_MEMORY_BYTES;
    enum paper_status status;
    int descriptor = input_file_descriptor(path, NULL);
    state->descriptor = descriptor;
    ssize_t read_count =
        descriptor >= 0 ? pread(descriptor, header, STATE_HEADER_BYTES, 0) : -1;
    if (descriptor < 0 && (errno == ENOTSUP || errno == EISDIR))
        status = paper_fail(PAPER_BAD_ARGUMENT, "%s: cannot read: it is no regular file", path);
    else if (read_count < 0)
        status = paper_fail(PAPER_BAD_ARGUMENT, "%s: cannot read: %s", path, strerror(errno));
    else if (read_count < STATE_HEADER_BYTES)
        status = file_bad(state, "it is not a saved state");
    else
        status = header_read(state, header, &checksum, &bytes);
    if (status == PAPER_OK) {
        if (!state_checksum(descriptor, header, &found, &length))
            status =
                paper_fail(PAPER_BAD_ARGUMENT, "%s: cannot read: %s", path, strerror(errno));
        else if (length != bytes)
            status = paper_fail(PAPER_BAD_FILE,
                                "%s: it is damaged: it should have %lld bytes and has %lld",
                                path, bytes, length);
        else if (checksum != found)
            status = file_bad(state, "it is damaged: its checksum is wrong");
    }
    if (status != PAPER_OK) {
        paper_state_close(state);
        return status;
    }
    *out = state;
    return PAPER_OK;
}

void paper_state_close(struct paper_state *state)
{
    if (!state)
        return;
    reader_end(state);
    if (state->descriptor >= 0)
        close(state->descriptor);
    free(state->path);
    free(state);
}

void paper_state_limit(struct paper_state *state, double bytes)
{
    state->memory_bytes = bytes > 0 ? (unsigned long long)fmin(bytes, 0x1p62) : 0;
}

int paper_state_count(const struct paper_state *state)
{
    return state->count;
}

int paper_state_number(const struct paper_state *state, int index)
{
    return state->numbers[index];
}
