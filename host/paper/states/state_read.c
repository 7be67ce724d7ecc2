/* state_read.c - sheets from a file that anybody may have made.
 *
 *     this process                          the reader's, forked for each sheet
 *     header, length, checksum
 *     frames  <------------ pipe ---------- HDF5: run, then planes, or an error in words
 *     run decoded, planes checked (history/run.c, history/checkpoint.c)
 *
 * HDF5's library is large and meant for files that one trusts. Whatever it does to its own process, here the pipe ends. */
#include "states/state_internal.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <hdf5.h>

enum { READER_SECONDS = 300, RUN_MB_MAX = 2048 };
#define READER_BYTES ((rlim_t)3 << 30)

struct paper_state {
    char *path;
    int count;
    int numbers[PAPER_STATE_SHEETS_MAX];
    /* the reader while it runs */
    pid_t reader;
    int pipe;
};

/* ---- the reader's side ---- */

static bool all_write(int descriptor, const void *bytes, size_t count)
{
    const char *at = bytes;
    while (count > 0) {
        ssize_t done = write(descriptor, at, count);
        if (done <= 0)
            return false;
        at += done;
        count -= (size_t)done;
    }
    return true;
}

static void frame_write(int descriptor, char kind, const void *bytes, size_t count)
{
    uint8_t head[9] = {(uint8_t)kind};
    for (int i = 0; i < 8; i++)
        head[1 + i] = (uint8_t)((uint64_t)count >> 8 * i);
    if (!all_write(descriptor, head, sizeof head) || !all_write(descriptor, bytes, count))
        _exit(1); /* nobody listens any more */
}

_Noreturn static void reader_fail(int descriptor, const char *what)
{
    frame_write(descriptor, STATE_FRAME_ERROR, what, strlen(what));
    _exit(0);
}

static void reader_confine(void)
{
    int nowhere = open("/dev/null", O_WRONLY); /* what libraries say while they fall */
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    struct rlimit seconds = {READER_SECONDS, READER_SECONDS}, none = {0, 0};
    setrlimit(RLIMIT_CPU, &seconds);
    setrlimit(RLIMIT_CORE, &none);
#if !defined(__SANITIZE_ADDRESS__) && !defined(LUTETIA_FUZZ)
    long pages = 0;
    FILE *sizes = fopen("/proc/self/statm", "r");
    if (sizes && fscanf(sizes, "%ld", &pages) == 1) {
        rlim_t most = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + READER_BYTES;
        setrlimit(RLIMIT_AS, &(struct rlimit){most, most});
    }
    if (sizes)
        fclose(sizes);
#endif
}

/* A dataset of that many numbers along each axis; its bytes. */
static void *dataset_read(hid_t group, const char *name, hid_t type, int rank,
                          const hsize_t *most, const hsize_t *least, size_t *bytes)
{
    hsize_t size[2] = {0, 1};
    hid_t set = H5Dopen2(group, name, H5P_DEFAULT), space = H5Dget_space(set);
    void *made = NULL;
    if (set >= 0 && space >= 0 && H5Sget_simple_extent_ndims(space) == rank &&
        H5Sget_simple_extent_dims(space, size, NULL) == rank) {
        bool fits = true;
        for (int i = 0; i < rank; i++)
            fits = fits && size[i] >= least[i] && size[i] <= most[i];
        *bytes = (size_t)(size[0] * size[1]) * H5Tget_size(type);
        made = fits && *bytes ? malloc(*bytes) : NULL;
        if (made && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, made) < 0) {
            free(made);
            made = NULL;
        }
    }
    H5Sclose(space);
    H5Dclose(set);
    return made;
}

/* The planes' names follow from the description; the sheet is only asked for in the parent, so they are made from a copy. */
static bool planes_send(hid_t group, const uint8_t *run, size_t run_count, int descriptor)
{
    struct paper_sheet_config config;
    struct paper_plane planes[PAPER_PLANES_MAX];
    if (paper_history_describe(run, run_count, &config) != PAPER_OK)
        return false;
    int count = paper_config_planes(&config, planes);
    hsize_t size[2] = {(hsize_t)config.height, (hsize_t)config.width};
    hid_t inner = H5Gopen2(group, "planes", H5P_DEFAULT);
    bool done = inner >= 0;
    for (int i = 0; i < count && done; i++) {
        size_t bytes;
        void *words = dataset_read(inner, planes[i].name,
                                   planes[i].whole ? H5T_NATIVE_UINT32 : H5T_NATIVE_FLOAT, 2,
                                   size, size, &bytes);
        done = words != NULL;
        if (done)
            frame_write(descriptor, STATE_FRAME_PLANE, words, bytes);
        free(words);
    }
    return done;
}

_Noreturn void state_reader(const char *path, int number, bool planes, int descriptor)
{
    static const hsize_t least = 1, most = (hsize_t)RUN_MB_MAX << 20;
    char name[32];
    size_t count = 0;
    reader_confine();
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    snprintf(name, sizeof name, "sheet-%d", number);
    hid_t group = file < 0 ? -1 : H5Gopen2(file, name, H5P_DEFAULT);
    uint8_t *run = group < 0
                       ? NULL
                       : dataset_read(group, "run", H5T_NATIVE_UINT8, 1, &most, &least, &count);
    if (!run)
        reader_fail(descriptor, "a sheet is missing in it");
    frame_write(descriptor, STATE_FRAME_RUN, run, count);
    if (planes && !planes_send(group, run, count, descriptor))
        reader_fail(descriptor, "a plane is missing in it, or has another size");
    _exit(0); /* without closing: HDF5's own exits may stumble over what it read */
}

/* ---- this side ---- */

static enum paper_status file_bad(const struct paper_state *state, const char *what)
{
    return paper_fail(PAPER_BAD_FILE, "%s: %s", state->path, what);
}

/* Prefixes the last failure by the file's name. */
static enum paper_status file_failed(const struct paper_state *state, enum paper_status status)
{
    char what[600];
    snprintf(what, sizeof what, "%s", paper_error());
    return paper_fail(status, "%s: %s", state->path, what);
}

static enum paper_status reader_start(struct paper_state *state, int index, bool planes)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        return paper_fail(PAPER_NO_MEMORY, "%s: cannot read: %s", state->path, strerror(errno));
    fflush(NULL);
    state->reader = fork();
    if (state->reader == 0) {
        close(ends[0]);
        state_reader(state->path, state->numbers[index], planes, ends[1]);
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

/* The next frame's length if it is of the kind; else what the reader said. */
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
    if (status == PAPER_OK && length > (uint64_t)RUN_MB_MAX << 20)
        status = file_bad(state, "its run is too long");
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
    (void)number; /* they come in their order */
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
    if (version != STATE_VERSION || model != PAPER_MODEL_VERSION)
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
    enum paper_status status;
    int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* no waiting for pipes */
    ssize_t read_count = descriptor < 0 ? -1 : pread(descriptor, header, STATE_HEADER_BYTES, 0);
    if (read_count < 0)
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
    if (descriptor >= 0)
        close(descriptor);
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
    free(state->path);
    free(state);
}

int paper_state_count(const struct paper_state *state)
{
    return state->count;
}

int paper_state_number(const struct paper_state *state, int index)
{
    return state->numbers[index];
}
