/* state_reader.c - the process that reads a saved state: forked for one sheet, and confined
 * before HDF5 sees the file.
 *
 *     confine      no new descriptors, limits on memory and time, ends with its parent
 *     open         HDF5, on the descriptor that the parent has checked (states/state_driver.c)
 *     walk         only what we write is there (states/state_walk.c)
 *     read         the run, then the planes; or an error in words
 */
#include "states/hdf5_library.h"
#include "states/state_internal.h"

#include <confine.h>
#include <streams.h>

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { READER_SECONDS = 300 };
/* Memory that HDF5 needs for itself, whatever is read. */
#define READER_OWN_BYTES (64ull << 20)

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

_Noreturn static void reader_fail(int descriptor, char kind, const char *what)
{
    frame_write(descriptor, kind, what, strlen(what));
    _exit(0);
}

/* Messages that libraries print when they crash are discarded. */
static void reader_confine(const struct state_reading *reading)
{
    confine_descriptors((int[]){reading->descriptor, reading->pipe}, 2);
    int nowhere = streams_nowhere(O_RDWR);
    if (nowhere >= 0) {
        dup2(nowhere, STDIN_FILENO);
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
        if (nowhere > STDERR_FILENO)
            close(nowhere);
    }
    unsigned long long bytes = reading->memory_bytes;
    confine_resources(reading->parent, READER_SECONDS,
                      bytes < UINT64_MAX - READER_OWN_BYTES ? bytes + READER_OWN_BYTES : bytes);
    confine_calls();
}

/* Reads a dataset that state_walk() has checked, of at most that many bytes; returns its
 * bytes. */
static void *dataset_read(const struct state_reading *reading, hid_t group, const char *name,
                          hid_t type, hsize_t size[2], size_t *bytes)
{
    hid_t set = hdf5.Dopen2(group, name, H5P_DEFAULT), space = hdf5.Dget_space(set);
    size[0] = size[1] = 1;
    int rank = hdf5.Sget_simple_extent_dims(space, size, NULL);
    *bytes = (size_t)(size[0] * size[1]) * hdf5.Tget_size(type);
    void *made = rank > 0 ? malloc(*bytes) : NULL;
    if (rank > 0 && (!made || *bytes > reading->memory_bytes))
        reader_fail(reading->pipe, STATE_FRAME_NO_MEMORY, "");
    if (made && hdf5.Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, made) < 0) {
        free(made);
        made = NULL;
    }
    hdf5.Sclose(space);
    hdf5.Dclose(set);
    return made;
}

/* A plane that the file's version of the model does not have: zeros. */
static bool zeros_send(const struct state_reading *reading,
                       const struct paper_sheet_config *config)
{
    const size_t bytes = sizeof(float) * (size_t)config->width * (size_t)config->height;
    void *words = calloc(bytes, 1);
    if (!words)
        reader_fail(reading->pipe, STATE_FRAME_NO_MEMORY, "");
    frame_write(reading->pipe, STATE_FRAME_PLANE, words, bytes);
    free(words);
    return true;
}

/* The planes that a file of that version of the model has. */
static int planes_of(const struct paper_plane *planes, int count, int model)
{
    int had = 0;
    for (int i = 0; i < count; i++)
        had += planes[i].since <= model;
    return had;
}

/* The planes' names follow from the description. Only the parent makes the sheet, so they
 * are derived from a copy of the description. */
static bool planes_send(const struct state_reading *reading, hid_t group, const uint8_t *run,
                        size_t run_count)
{
    struct paper_sheet_config config;
    struct paper_plane planes[PAPER_PLANES_MAX];
    H5G_info_t info;
    if (paper_history_describe(run, run_count, &config) != PAPER_OK)
        return false;
    int count = paper_config_planes(&config, planes);
    hid_t inner = hdf5.Gopen2(group, "planes", H5P_DEFAULT);
    bool done = inner >= 0 && hdf5.Gget_info(inner, &info) >= 0 &&
                info.nlinks == (hsize_t)planes_of(planes, count, reading->model);
    for (int i = 0; i < count && done; i++) {
        if (planes[i].since > reading->model) {
            done = zeros_send(reading, &config);
            continue;
        }
        size_t bytes;
        hsize_t size[2];
        bool whole = planes[i].whole;
        hid_t stored = hdf5.Dopen2(inner, planes[i].name, H5P_DEFAULT),
              type = hdf5.Dget_type(stored);
        done = hdf5.Tequal(type, whole ? *hdf5.T_STD_U32LE_g : *hdf5.T_IEEE_F32LE_g) > 0;
        hdf5.Tclose(type);
        hdf5.Dclose(stored);
        void *words =
            !done ? NULL
                  : dataset_read(reading, inner, planes[i].name,
                                 whole ? *hdf5.T_NATIVE_UINT32_g : *hdf5.T_NATIVE_FLOAT_g, size,
                                 &bytes);
        done = words && size[0] == (hsize_t)config.height && size[1] == (hsize_t)config.width;
        if (done)
            frame_write(reading->pipe, STATE_FRAME_PLANE, words, bytes);
        free(words);
    }
    return done;
}

_Noreturn void state_reader(const struct state_reading *reading)
{
    char name[STATE_NAME_MAX];
    size_t count = 0;
    hsize_t size[2];
    reader_confine(reading);
    hdf5_begin();
    hdf5.PLset_loading_state(0);
    hid_t file = state_file_open(reading->descriptor);
    if (file < 0)
        reader_fail(reading->pipe, STATE_FRAME_ERROR, "it is damaged: HDF5 cannot read it");
    const char *wrong = state_walk(file, reading->numbers, reading->count, reading->number);
    if (wrong)
        reader_fail(reading->pipe, STATE_FRAME_ERROR, wrong);
    state_sheet_name(name, reading->number);
    hid_t group = hdf5.Gopen2(file, name, H5P_DEFAULT);
    uint8_t *run = dataset_read(reading, group, "run", *hdf5.T_NATIVE_UINT8_g, size, &count);
    if (!run)
        reader_fail(reading->pipe, STATE_FRAME_ERROR, "it is damaged: its run cannot be read");
    frame_write(reading->pipe, STATE_FRAME_RUN, run, count);
    if (reading->planes && !planes_send(reading, group, run, count))
        reader_fail(reading->pipe, STATE_FRAME_ERROR,
                    "a plane is missing in it, or has another size or type");
    _exit(0); /* exits without closing, because HDF5's exit handlers may crash on what it
               * read */
}
