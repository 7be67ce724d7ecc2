/* state_walk.c - checks that an HDF5 file is one that paper_state_save() writes, before any
 * data is read from it.
 *
 *     /                    a hard link to a group for each sheet, none else
 *       sheet-N            "run" and "planes", none else
 *         run              bytes, all in one piece in this file
 *         planes           datasets of height x width words, in chunks of this file, shuffled
 *                          and deflated
 *
 * HDF5 can do much more: links by name to other places and other files, data kept in other
 * files or gathered from them, references, filters that are loaded as programs, types that
 * are computed on reading. None of that is in our states, so none is accepted.
 */
#include "states/hdf5_library.h"
#include "states/state_internal.h"

enum { NOTES_MAX = 6 + PAPER_PIGMENTS_MAX, NOTE_TEXT_MAX = 256, CHUNK_SIDE_MAX = 4096 };

/* Checks the link of that name in the group, and the type of its target. NULL: it is as we
 * write it. */
static const char *link_wrong(hid_t group, const char *name, H5O_type_t type)
{
    H5L_info_t link;
    H5O_info_t object;
    if (hdf5.Lexists(group, name, H5P_DEFAULT) <= 0 ||
        hdf5.Lget_info(group, name, &link, H5P_DEFAULT) < 0)
        return "a part is missing in it";
    if (link.type != H5L_TYPE_HARD)
        return "a link in it leads elsewhere";
    if (hdf5.Oget_info_by_name(group, name, &object, H5P_DEFAULT) < 0)
        return "a part of it is damaged";
    if (object.type != type)
        return "a part of it is of another kind";
    return object.rc == 1 ? NULL : "a part of it has several names";
}

static long long links_count(hid_t group)
{
    H5G_info_t info;
    return hdf5.Gget_info(group, &info) < 0 || info.nlinks > INT32_MAX ? -1
                                                                       : (long long)info.nlinks;
}

/* ---- notes for people: attributes ---- */

static bool note_type_ours(hid_t type)
{
    if (hdf5.Tcommitted(type) != 0)
        return false;
    if (hdf5.Tequal(type, *hdf5.T_STD_I64LE_g) > 0)
        return true;
    return hdf5.Tget_class(type) == H5T_STRING && hdf5.Tis_variable_str(type) == 0 &&
           hdf5.Tget_size(type) <= NOTE_TEXT_MAX;
}

static const char *notes_wrong(hid_t object)
{
    H5O_info_t info;
    if (hdf5.Oget_info(object, &info) < 0 || info.num_attrs > NOTES_MAX)
        return "it has notes that are not ours";
    bool good = true;
    for (hsize_t i = 0; i < info.num_attrs && good; i++) {
        hid_t note = hdf5.Aopen_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_NATIVE, i,
                                       H5P_DEFAULT, H5P_DEFAULT);
        hid_t type = note < 0 ? -1 : hdf5.Aget_type(note),
              space = note < 0 ? -1 : hdf5.Aget_space(note);
        good = type >= 0 && space >= 0 && note_type_ours(type) &&
               hdf5.Sget_simple_extent_type(space) == H5S_SCALAR;
        hdf5.Tclose(type);
        hdf5.Sclose(space);
        hdf5.Aclose(note);
    }
    return good ? NULL : "it has notes that are not ours";
}

/* ---- data ---- */

/* Checks that the type is one that we store. */
static const char *type_wrong(hid_t set, bool run)
{
    hid_t type = hdf5.Dget_type(set);
    bool good = type >= 0 && hdf5.Tcommitted(type) == 0 &&
                (run ? hdf5.Tequal(type, *hdf5.T_STD_U8LE_g) > 0
                     : hdf5.Tequal(type, *hdf5.T_STD_U32LE_g) > 0 ||
                           hdf5.Tequal(type, *hdf5.T_IEEE_F32LE_g) > 0);
    hdf5.Tclose(type);
    return good ? NULL : "numbers in it are of a type that is not ours";
}

static const char *filters_wrong(hid_t how)
{
    int count = hdf5.Pget_nfilters(how);
    bool good = count >= 0 && count <= 2;
    for (int i = 0; i < count && good; i++) {
        unsigned flags, values[8], settings;
        size_t room = sizeof values / sizeof *values;
        H5Z_filter_t filter =
            hdf5.Pget_filter2(how, (unsigned)i, &flags, &room, values, 0, NULL, &settings);
        good = filter == H5Z_FILTER_DEFLATE || filter == H5Z_FILTER_SHUFFLE;
    }
    return good ? NULL : "a filter in it is not ours";
}

/* Checks that all data is contiguous or in chunks in this file. size: along each axis. */
static const char *layout_wrong(hid_t how, bool run, const hsize_t size[2])
{
    hsize_t chunk[2] = {0, 0};
    if (hdf5.Pget_external_count(how) != 0)
        return "data of it is kept in another file";
    H5D_layout_t layout = hdf5.Pget_layout(how);
    if (layout == H5D_VIRTUAL)
        return "data of it is gathered from elsewhere";
    if (layout != (run ? H5D_CONTIGUOUS : H5D_CHUNKED))
        return "data of it is laid out in a way that is not ours";
    if (run)
        return NULL;
    bool good = hdf5.Pget_chunk(how, 2, chunk) == 2;
    for (int i = 0; i < 2; i++)
        good = good && chunk[i] >= 1 && chunk[i] <= CHUNK_SIDE_MAX && chunk[i] <= size[i];
    return good ? NULL : "data of it is laid out in a way that is not ours";
}

/* size: gets the lengths of the axes. */
static const char *set_wrong(hid_t group, const char *name, bool run, hsize_t size[2])
{
    const int rank = run ? 1 : 2;
    hsize_t most[2] = {0, 0};
    size[0] = size[1] = 1;
    const char *wrong = link_wrong(group, name, H5O_TYPE_DATASET);
    if (wrong)
        return wrong;
    hid_t set = hdf5.Dopen2(group, name, H5P_DEFAULT);
    hid_t how = set < 0 ? -1 : hdf5.Dget_create_plist(set),
          space = set < 0 ? -1 : hdf5.Dget_space(set);
    if (how < 0 || space < 0) {
        wrong = "a part of it is damaged";
    } else if (hdf5.Sget_simple_extent_type(space) != H5S_SIMPLE ||
               hdf5.Sget_simple_extent_ndims(space) != rank ||
               hdf5.Sget_simple_extent_dims(space, size, most) != rank || size[0] < 1 ||
               size[1] < 1 || most[0] != size[0] || (!run && most[1] != size[1]) ||
               size[0] > (run ? STATE_RUN_MAX : PAPER_SIDE_MAX) || size[1] > PAPER_SIDE_MAX) {
        wrong = "a part of it has a size that cannot be";
    } else {
        wrong = layout_wrong(how, run, size);
        wrong = wrong ? wrong : filters_wrong(how);
        wrong = wrong ? wrong : type_wrong(set, run);
        wrong = wrong ? wrong : notes_wrong(set);
        if (!wrong && run && hdf5.Dget_storage_size(set) != size[0])
            wrong = "its run is not in it";
    }
    hdf5.Sclose(space);
    hdf5.Pclose(how);
    hdf5.Dclose(set);
    return wrong;
}

/* ---- groups ---- */

static const char *planes_wrong(hid_t planes)
{
    hsize_t first[2] = {0, 0}, size[2];
    const char *wrong = notes_wrong(planes);
    long long count = links_count(planes);
    if (!wrong && (count < 1 || count > PAPER_PLANES_MAX))
        wrong = "it has planes that are not ours";
    for (long long i = 0; i < count && !wrong; i++) {
        char name[sizeof((struct paper_plane *)NULL)->name];
        ssize_t length = hdf5.Lget_name_by_idx(planes, ".", H5_INDEX_NAME, H5_ITER_NATIVE,
                                               (hsize_t)i, name, sizeof name, H5P_DEFAULT);
        if (length < 1 || length >= (ssize_t)sizeof name)
            return "it has planes that are not ours";
        wrong = set_wrong(planes, name, false, size);
        if (!wrong && i > 0 && (size[0] != first[0] || size[1] != first[1]))
            wrong = "its planes differ in size";
        first[0] = size[0];
        first[1] = size[1];
    }
    return wrong;
}

static const char *sheet_wrong(hid_t sheet)
{
    hsize_t size[2];
    const char *wrong = notes_wrong(sheet);
    if (!wrong && links_count(sheet) != 2)
        wrong = "a sheet of it has parts that are not ours";
    if (!wrong)
        wrong = set_wrong(sheet, "run", true, size);
    if (!wrong)
        wrong = link_wrong(sheet, "planes", H5O_TYPE_GROUP);
    if (wrong)
        return wrong;
    hid_t planes = hdf5.Gopen2(sheet, "planes", H5P_DEFAULT);
    wrong = planes < 0 ? "a part of it is damaged" : planes_wrong(planes);
    hdf5.Gclose(planes);
    return wrong;
}

const char *state_walk(int64_t file, const int *numbers, int count, int number)
{
    char name[STATE_NAME_MAX];
    hsize_t before = 0;
    hid_t how = hdf5.Fget_create_plist(file), root = hdf5.Gopen2(file, "/", H5P_DEFAULT);
    const char *wrong = NULL;
    if (how < 0 || root < 0 || hdf5.Pget_userblock(how, &before) < 0 ||
        before != STATE_HEADER_BYTES)
        wrong = "it is damaged: HDF5 cannot read it";
    else
        wrong = notes_wrong(root);
    if (!wrong && links_count(root) != count)
        wrong = "it has sheets that its header does not tell of";
    for (int i = 0; i < count && !wrong; i++) {
        state_sheet_name(name, numbers[i]);
        wrong = link_wrong(root, name, H5O_TYPE_GROUP);
    }
    hdf5.Pclose(how);
    state_sheet_name(name, number);
    hid_t sheet = wrong ? -1 : hdf5.Gopen2(root, name, H5P_DEFAULT);
    if (!wrong)
        wrong = sheet < 0 ? "a part of it is damaged" : sheet_wrong(sheet);
    hdf5.Gclose(sheet);
    hdf5.Gclose(root);
    return wrong;
}
