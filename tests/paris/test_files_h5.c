/* Fields to and from HDF5 files, beside HDF5's own library. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <hdf5.h>

#include "../display/scratch.h"
#include "test_files.h"

static const char *const types[] = {"u1", "u2", "u4", "u8", "i1", "i2", "i4", "i8", "f4", "f8"};
enum { TYPES = 10 };

static hid_t native(int i)
{
    const hid_t all[TYPES] = {H5T_NATIVE_UINT8,  H5T_NATIVE_UINT16, H5T_NATIVE_UINT32,
                              H5T_NATIVE_UINT64, H5T_NATIVE_INT8,   H5T_NATIVE_INT16,
                              H5T_NATIVE_INT32,  H5T_NATIVE_INT64,  H5T_NATIVE_FLOAT,
                              H5T_NATIVE_DOUBLE};
    return all[i];
}

static hid_t big_endian(int i)
{
    const hid_t all[TYPES] = {H5T_STD_U8BE,   H5T_STD_U16BE, H5T_STD_U32BE, H5T_STD_U64BE,
                              H5T_STD_I8BE,   H5T_STD_I16BE, H5T_STD_I32BE, H5T_STD_I64BE,
                              H5T_IEEE_F32BE, H5T_IEEE_F64BE};
    return all[i];
}

static unsigned int bytes_of(int i)
{
    return (unsigned int)(types[i][1] - '0');
}

/* The values one behind the other. */
static void pack(uint8_t (*values)[32], unsigned int each, uint8_t *out)
{
    for (int i = 0; i < COUNT; i++)
        memcpy(out + (unsigned int)i * each, values[i], each);
}

void fields_go_to_hdf5(void **unused)
{
    (void)unused;
    static uint8_t values[COUNT][32], wanted[BYTES_MOST], found[BYTES_MOST];
    for (int i = 0; i < TYPES; i++) {
        char name[600];
        const char *path = scratch_path("made.h5");
        const unsigned int each = bytes_of(i);
        CM_field_id_t field = field_make(8 * each, values);
        snprintf(name, sizeof name, i % 2 ? "%s:the temperature" : "%s", path);
        assert_int_equal(lutetia_field_write(name, field, types[i], 0), 1);
        hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
        assert_true(file >= 0);
        hid_t set = H5Dopen2(file, i % 2 ? "the temperature" : "field", H5P_DEFAULT);
        assert_true(set >= 0);
        hid_t type = H5Dget_type(set), space = H5Dget_space(set);
        hsize_t lengths[2];
        assert_true(H5Tequal(type, native(i)) > 0);
        assert_int_equal(H5Sget_simple_extent_ndims(space), 2);
        H5Sget_simple_extent_dims(space, lengths, NULL);
        assert_int_equal(lengths[0], ROWS);
        assert_int_equal(lengths[1], COLUMNS);
        assert_true(H5Dread(set, native(i), H5S_ALL, H5S_ALL, H5P_DEFAULT, found) >= 0);
        pack(values, each, wanted);
        assert_memory_equal(found, wanted, COUNT * each);
        H5Tclose(type);
        H5Sclose(space);
        H5Dclose(set);
        assert_true(H5Fclose(file) >= 0);
        CM_field_id_t to = CM_allocate_heap_field(8 * each);
        assert_int_equal(lutetia_field_read(name, to, types[i], 0), 1);
        field_is(to, 8 * each, values);
    }
    /* Bits are bytes there. */
    CM_field_id_t bit = field_make(1, values), to = CM_allocate_heap_field(1);
    assert_int_equal(lutetia_field_write(scratch_path("bits.h5"), bit, "b1", 0), 1);
    assert_int_equal(lutetia_field_read(scratch_path("bits.h5"), to, "b1", 0), 1);
    field_is(to, 1, values);
    CM_field_id_t pair = CM_allocate_heap_field(64);
    assert_int_equal(lutetia_field_write(scratch_path("c.h5"), pair, "c8", 0), 0);
    device_said("lutetia_field_write", "complex");
}

/* Writes an array by HDF5's library; chunk: by chunks of rows. */
static void array_add(hid_t file, const char *name, hid_t type, hid_t memory, int rank,
                      const hsize_t *lengths, int chunk, const void *values)
{
    hid_t space = H5Screate_simple(rank, lengths, NULL), how = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t piece[2] = {1, lengths[rank - 1]};
    if (chunk)
        H5Pset_chunk(how, rank, piece + 2 - rank);
    hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT);
    assert_true(set >= 0);
    hid_t one = H5Screate(H5S_SCALAR);
    hid_t note = H5Acreate2(set, "unit", H5T_NATIVE_INT, one, H5P_DEFAULT, H5P_DEFAULT);
    const int kelvin = 7;
    H5Awrite(note, H5T_NATIVE_INT, &kelvin);
    if (values)
        assert_true(H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    H5Aclose(note);
    H5Sclose(one);
    H5Dclose(set);
    H5Pclose(how);
    H5Sclose(space);
}

static const hsize_t lengths_here[2] = {ROWS, COLUMNS}, lengths_other[2] = {COLUMNS, ROWS};

void fields_come_from_hdf5(void **unused)
{
    (void)unused;
    static uint8_t values[COUNT][32], packed[BYTES_MOST];
    const char *path = scratch_path("theirs.h5");
    char name[600];
    for (int i = 0; i < 2 * TYPES; i++) {
        const unsigned int each = bytes_of(i % TYPES);
        hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        field_make(8 * each, values);
        pack(values, each, packed);
        for (int k = 0; k < 40; k++) { /* so that the group has several nodes */
            snprintf(name, sizeof name, "other %d", k * 7 % 40);
            array_add(file, name, H5T_NATIVE_INT8, H5T_NATIVE_INT8, 2, lengths_other, k % 2,
                      packed);
        }
        /* turned bytes are the library's work */
        array_add(file, "heat", i < TYPES ? native(i) : big_endian(i - TYPES),
                  native(i % TYPES), 2, lengths_here, 0, packed);
        hid_t group = H5Gcreate2(file, "inner", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        H5Gclose(group);
        array_add(file, "empty", H5T_NATIVE_INT8, H5T_NATIVE_INT8, 2, lengths_here, 0, NULL);
        assert_true(H5Fclose(file) >= 0);
        CM_field_id_t to = CM_allocate_heap_field(8 * each);
        snprintf(name, sizeof name, "%s:heat", path);
        assert_int_equal(lutetia_field_read(name, to, types[i % TYPES], 0), 1);
        field_is(to, 8 * each, values);
    }
    static const struct {
        const char *array, *says;
    } wrongs[] = {{"", "several arrays"},      {":nobody", "no array of that name"},
                  {":inner", "no array"},      {":other 2", "13x5"},
                  {":empty", "never written"}, {":heat/x", "must end in"},
                  {":other 14", "13x5"}};
    CM_field_id_t to = field_make(8, values);
    for (size_t i = 0; i < sizeof wrongs / sizeof *wrongs; i++) {
        snprintf(name, sizeof name, "%s%s", path, wrongs[i].array);
        assert_int_equal(lutetia_field_read(name, to, "i1", 0), 0);
        device_said("lutetia_field_read", wrongs[i].says);
        field_is(to, 8, values);
    }
    /* What has been compressed is named, and what to do. */
    hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    array_add(file, "a", H5T_NATIVE_INT8, H5T_NATIVE_INT8, 2, lengths_here, 1, packed);
    H5Fclose(file);
    assert_int_equal(lutetia_field_read(path, to, "i1", 0), 0);
    device_said("lutetia_field_read", "h5repack -l CONTI");
    unsigned int shape[2];
    file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    array_add(file, "a", H5T_NATIVE_INT8, H5T_NATIVE_INT8, 2, lengths_other, 0, packed);
    H5Fclose(file);
    assert_int_equal(lutetia_file_shape(path, shape, 2), 2);
    assert_int_equal(shape[0], COLUMNS);
    assert_int_equal(shape[1], ROWS);
}

/* A file of the oldest format that the library has, or of the newest. Newest groups may keep
 * the order in which names came. */
static hid_t file_of(const char *path, bool newest, bool ordered)
{
    hid_t access = H5Pcreate(H5P_FILE_ACCESS), create = H5Pcreate(H5P_FILE_CREATE);
    H5Pset_libver_bounds(access, newest ? H5F_LIBVER_LATEST : H5F_LIBVER_EARLIEST,
                         H5F_LIBVER_LATEST);
    if (ordered)
        H5Pset_link_creation_order(create, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, create, access);
    H5Pclose(access);
    H5Pclose(create);
    assert_true(file >= 0);
    return file;
}

/* Few names are in the group's header, more in a heap, very many in a heap of blocks of blocks
 * and in a tree of some floors. */
void groups_of_all_ages_have_their_names(void **unused)
{
    (void)unused;
    static const int many[] = {1, 3, 8, 9, 40, 700, 6000};
    static uint8_t values[COUNT][32], packed[BYTES_MOST];
    const char *path = scratch_path("names.h5");
    char name[600], element[64];
    CM_field_id_t to = CM_allocate_heap_field(16);
    for (size_t n = 0; n < 3 * sizeof many / sizeof *many; n++) {
        const int count = many[n / 3];
        const bool newest = n % 3 > 0;
        hid_t file = file_of(path, newest, n % 3 == 2);
        hid_t one = H5Screate(H5S_SCALAR);
        const int wanted = (int)(device_random() % (uint64_t)count);
        field_make(16, values);
        pack(values, 2, packed);
        for (int i = 0; i < count; i++) {
            snprintf(element, sizeof element, "array %d of some of these", i);
            if (i == wanted)
                array_add(file, element, H5T_NATIVE_UINT16, H5T_NATIVE_UINT16, 2, lengths_here,
                          0, packed);
            else
                H5Dclose(H5Dcreate2(file, element, H5T_NATIVE_INT8, one, H5P_DEFAULT,
                                    H5P_DEFAULT, H5P_DEFAULT));
        }
        assert_true(H5Lcreate_soft("/array 0 of some of these", file, "elsewhere", H5P_DEFAULT,
                                   H5P_DEFAULT) >= 0);
        H5Sclose(one);
        assert_true(H5Fclose(file) >= 0);
        snprintf(name, sizeof name, "%s:array %d of some of these", path, wanted);
        assert_int_equal(lutetia_field_read(name, to, "u2", 0), 1);
        field_is(to, 16, values);
        if (!newest)
            continue;
        assert_int_equal(lutetia_field_read(path, to, "u2", 0), count == 1);
        snprintf(name, sizeof name, "%s:elsewhere", path);
        assert_int_equal(lutetia_field_read(name, to, "u2", 0), 0);
        device_said("lutetia_field_read", "link to somewhere else");
        snprintf(name, sizeof name, "%s:array", path);
        assert_int_equal(lutetia_field_read(name, to, "u2", 0), 0);
        device_said("lutetia_field_read", "no array of that name");
    }
}

void damaged_hdf5_files_are_refused_or_read(void **unused)
{
    (void)unused;
    static uint8_t values[COUNT][32], bytes[BYTES_MOST], damaged[BYTES_MOST];
    const char *path = scratch_path("damaged.h5");
    CM_field_id_t field = field_make(16, values), to = CM_allocate_heap_field(16);
    int read = 0;
    for (int theirs = 0; theirs < 4; theirs++) {
        if (theirs) {
            hid_t file = file_of(path, theirs > 1, false);
            pack(values, 2, bytes);
            for (int i = 0; theirs == 3 && i < 20; i++) { /* more than a header takes */
                char other[32];
                snprintf(other, sizeof other, "other %d", i);
                H5Lcreate_soft("/a", file, other, H5P_DEFAULT, H5P_DEFAULT);
            }
            array_add(file, "a", H5T_NATIVE_UINT16, H5T_NATIVE_UINT16, 2, lengths_here, 0,
                      bytes);
            H5Fclose(file);
        } else {
            assert_int_equal(lutetia_field_write(path, field, "u2", 0), 1);
        }
        const size_t all = file_read(path, bytes);
        size_t used[BYTES_MOST], count = 0; /* places that are not 0 */
        for (size_t i = 0; i < all; i++)
            if (bytes[i])
                used[count++] = i;
        for (int n = 0; n < 1000; n++) {
            size_t end = all;
            memcpy(damaged, bytes, all);
            for (uint64_t k = 1 + device_random() % 3; k > 0; k--) {
                const uint64_t die = device_random() % 10;
                size_t at = used[device_random() % count] + (die & 1);
                at = at < all ? at : 0;
                if (die == 0)
                    end = device_random() % all;
                else
                    damaged[at] = die < 6 ? (uint8_t)device_random()
                                          : (uint8_t)(damaged[at] + (int)die - 8);
            }
            file_write(path, damaged, end);
            device_message[0] = '\0';
            const int good = lutetia_field_read(path, to, "u2", 0);
            assert_int_equal(good, !device_message[0]);
            read += good;
        }
    }
    device_message[0] = '\0';
    assert_in_range(read, 200, 3800);
}
