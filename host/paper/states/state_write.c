/* state_write.c - writes sheets to an HDF5 file, which output_file.h renames. */
#include "states/hdf5_library.h"
#include "states/state_internal.h"

#include <output_file.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <zlib.h>

enum { CHUNK_SIDE = 256, DEFLATE_LEVEL = 1 };

/* The checksum of the header, with 0 for the checksum's digits. */
static uLong header_checksum(uLong sum, const char *header)
{
    char copy[STATE_HEADER_BYTES];
    static const char label[] = "\nchecksum ";
    memcpy(copy, header, sizeof copy);
    char *digits = memmem(copy, sizeof copy - 8, label, sizeof label - 1);
    if (digits)
        memset(digits + sizeof label - 1, '0', 8);
    return crc32(sum, (const Bytef *)copy, sizeof copy);
}

bool state_checksum(int descriptor, const char *header, uint32_t *checksum, long long *bytes)
{
    enum { PIECE = 1 << 18 };
    static uint8_t piece[PIECE];
    uLong sum = crc32(0, NULL, 0);
    off_t at = STATE_HEADER_BYTES;
    for (;;) {
        ssize_t count = pread(descriptor, piece, PIECE, at);
        if (count < 0)
            return false;
        if (count == 0)
            break;
        sum = crc32(sum, piece, (uInt)count);
        at += count;
    }
    *checksum = (uint32_t)header_checksum(sum, header);
    *bytes = (long long)at;
    return true;
}

static bool number_note(hid_t at, const char *name, long long number)
{
    hid_t space = hdf5.Screate(H5S_SCALAR);
    hid_t note = hdf5.Acreate2(at, name, *hdf5.T_STD_I64LE_g, space, H5P_DEFAULT, H5P_DEFAULT);
    bool done = note >= 0 && hdf5.Awrite(note, *hdf5.T_NATIVE_LLONG_g, &number) >= 0;
    hdf5.Aclose(note);
    hdf5.Sclose(space);
    return done;
}

static bool text_note(hid_t at, const char *name, const char *text)
{
    hid_t type = hdf5.Tcopy(*hdf5.T_C_S1_g), space = hdf5.Screate(H5S_SCALAR);
    hdf5.Tset_size(type, strlen(text) + 1);
    hid_t note = hdf5.Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    bool done = note >= 0 && hdf5.Awrite(note, type, text) >= 0;
    hdf5.Aclose(note);
    hdf5.Sclose(space);
    hdf5.Tclose(type);
    return done;
}

/* Creation properties of a file, group or dataset: without times, so that the same papers
 * make the same file. */
static hid_t how_made(hid_t kind)
{
    hid_t how = hdf5.Pcreate(kind);
    hdf5.Pset_obj_track_times(how, false);
    return how;
}

static hid_t group_make(hid_t at, const char *name)
{
    hid_t how = how_made(*hdf5.P_CLS_GROUP_CREATE_ID_g);
    hid_t group = hdf5.Gcreate2(at, name, H5P_DEFAULT, how, H5P_DEFAULT);
    hdf5.Pclose(how);
    return group;
}

static bool bytes_write(hid_t group, const uint8_t *bytes, size_t count)
{
    hsize_t size = count;
    hid_t space = hdf5.Screate_simple(1, &size, NULL),
          how = how_made(*hdf5.P_CLS_DATASET_CREATE_ID_g);
    hid_t set =
        hdf5.Dcreate2(group, "run", *hdf5.T_STD_U8LE_g, space, H5P_DEFAULT, how, H5P_DEFAULT);
    bool done = set >= 0 && hdf5.Dwrite(set, *hdf5.T_NATIVE_UINT8_g, H5S_ALL, H5S_ALL,
                                        H5P_DEFAULT, bytes) >= 0;
    hdf5.Dclose(set);
    hdf5.Pclose(how);
    hdf5.Sclose(space);
    return done;
}

static bool plane_write(hid_t group, const struct paper_plane *plane, const hsize_t size[2],
                        const void *words)
{
    hsize_t chunk[2];
    for (int i = 0; i < 2; i++)
        chunk[i] = size[i] < CHUNK_SIDE ? size[i] : CHUNK_SIDE;
    hid_t space = hdf5.Screate_simple(2, size, NULL),
          how = how_made(*hdf5.P_CLS_DATASET_CREATE_ID_g);
    hdf5.Pset_chunk(how, 2, chunk);
    hdf5.Pset_shuffle(how);
    hdf5.Pset_deflate(how, DEFLATE_LEVEL);
    hid_t set = hdf5.Dcreate2(group, plane->name,
                              plane->whole ? *hdf5.T_STD_U32LE_g : *hdf5.T_IEEE_F32LE_g, space,
                              H5P_DEFAULT, how, H5P_DEFAULT);
    bool done =
        set >= 0 &&
        hdf5.Dwrite(set, plane->whole ? *hdf5.T_NATIVE_UINT32_g : *hdf5.T_NATIVE_FLOAT_g,
                    H5S_ALL, H5S_ALL, H5P_DEFAULT, words) >= 0;
    hdf5.Dclose(set);
    hdf5.Pclose(how);
    hdf5.Sclose(space);
    return done;
}

/* *written false: HDF5 failed. */
static enum paper_status sheet_write(hid_t file, const struct paper_state_sheet *s,
                                     bool *written)
{
    struct paper_plane planes[PAPER_PLANES_MAX];
    const struct paper_sheet_config *config = paper_sheet_get_config(s->sheet);
    hsize_t size[2] = {(hsize_t)config->height, (hsize_t)config->width};
    char name[STATE_NAME_MAX];
    uint8_t *run = NULL;
    size_t run_count = 0;
    void *words = malloc(4 * (size_t)(size[0] * size[1]));
    if (!words)
        return paper_fail(PAPER_NO_MEMORY, "no memory to save a sheet of %dx%d", config->width,
                          config->height);
    state_sheet_name(name, s->number);
    hid_t group = group_make(file, name), inner = group_make(group, "planes");
    int count = paper_sheet_planes(s->sheet, planes);
    enum paper_status status = PAPER_OK;
    *written = group >= 0 && inner >= 0;
    for (int i = 0; i < count && status == PAPER_OK && *written; i++) {
        status = paper_sheet_plane_read(s->sheet, i, words);
        if (status == PAPER_OK)
            *written = plane_write(inner, &planes[i], size, words);
    }
    if (status == PAPER_OK)
        status = paper_history_encode(s->sheet, &run, &run_count);
    if (status == PAPER_OK)
        *written = *written && bytes_write(group, run, run_count) &&
                   number_note(group, "width", config->width) &&
                   number_note(group, "height", config->height) &&
                   number_note(group, "seed", (long long)config->seed) &&
                   number_note(group, "steps", paper_sheet_steps(s->sheet)) &&
                   number_note(group, "operations", paper_history_done(s->sheet)) &&
                   number_note(group, "grains_per_unit", config->parts ? PAPER_GRAINS : 1);
    for (int i = 0; i < config->pigments_count && *written && status == PAPER_OK; i++) {
        snprintf(name, sizeof name, "pigment_%d", i + 1);
        *written = text_note(group, name, config->pigments[i].name);
    }
    hdf5.Gclose(inner);
    hdf5.Gclose(group);
    free(run);
    free(words);
    return status;
}

/* *written false: HDF5 failed, or the file could not be written: errno tells why. */
static enum paper_status content_write(int descriptor, const struct paper_state_sheet *sheets,
                                       int count, bool *written)
{
    hdf5_begin();
    struct state_writing writing = {0};
    hid_t how = how_made(*hdf5.P_CLS_FILE_CREATE_ID_g);
    enum paper_status status = PAPER_OK;
    hdf5.Pset_userblock(how, STATE_HEADER_BYTES);
    hid_t file = state_file_create(descriptor, &writing, how);
    *written = file >= 0 && number_note(file, "format", STATE_VERSION) &&
               number_note(file, "model", PAPER_MODEL_VERSION) &&
               text_note(file, "program", "lutetia " LUTETIA_VERSION);
    for (int i = 0; i < count && status == PAPER_OK && *written && writing.error == 0; i++)
        status = sheet_write(file, &sheets[i], written);
    if ((file >= 0 && hdf5.Fclose(file) < 0) || writing.error != 0)
        *written = false;
    hdf5.Pclose(how);
    errno = writing.error;
    return status;
}

static void header_fill(char header[STATE_HEADER_BYTES], const struct paper_state_sheet *sheets,
                        int count, long long bytes, uint32_t checksum)
{
    memset(header, 0, STATE_HEADER_BYTES);
    int length = snprintf(header, STATE_HEADER_BYTES,
                          "LUTETIA STATE %d\nmodel %d\nprogram %s\nbytes %lld\nchecksum "
                          "%08x\nsheets",
                          STATE_VERSION, PAPER_MODEL_VERSION, LUTETIA_VERSION, bytes, checksum);
    for (int i = 0; i < count; i++)
        length += snprintf(header + length, STATE_HEADER_BYTES - (size_t)length, " %d",
                           sheets[i].number);
    snprintf(header + length, STATE_HEADER_BYTES - (size_t)length, "\n");
}

/* Writes the header last: a file without it is no state. */
static bool header_write(int descriptor, const struct paper_state_sheet *sheets, int count)
{
    char header[STATE_HEADER_BYTES];
    uint32_t checksum = 0;
    struct stat status;
    long long bytes;
    bool done = fstat(descriptor, &status) == 0;
    header_fill(header, sheets, count, (long long)status.st_size, 0);
    done = done && state_checksum(descriptor, header, &checksum, &bytes) &&
           bytes == (long long)status.st_size;
    header_fill(header, sheets, count, (long long)status.st_size, checksum);
    return done && pwrite(descriptor, header, sizeof header, 0) == sizeof header;
}

enum paper_status paper_state_save(const char *path, const struct paper_state_sheet *sheets,
                                   int count)
{
    struct output_file out;
    bool written = false;
    if (count < 0 || count > PAPER_STATE_SHEETS_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "a state holds up to %d sheets (got %d)",
                          PAPER_STATE_SHEETS_MAX, count);
    enum paper_status status = hdf5_load(path);
    if (status != PAPER_OK)
        return status;
    if (!output_file_open(&out, path))
        return paper_fail(PAPER_BAD_ARGUMENT, "%s: cannot write: %s", path, out.why);
    status = content_write(fileno(out.stream), sheets, count, &written);
    int error = errno;
    if (status == PAPER_OK && written) {
        errno = 0;
        written = header_write(fileno(out.stream), sheets, count);
        error = errno;
    }
    if (status == PAPER_OK && written)
        return output_file_commit(&out)
                   ? PAPER_OK
                   : paper_fail(PAPER_BAD_ARGUMENT, "%s: cannot write: %s", path, out.why);
    output_file_abandon(&out);
    return status != PAPER_OK ? status
                              : paper_fail(PAPER_BAD_ARGUMENT, "%s: cannot write: %s", path,
                                           error ? output_file_explain(error) : "HDF5 failed");
}
