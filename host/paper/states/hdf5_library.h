/* hdf5_library.h - HDF5, loaded when a state is saved or read for the first time: with the
 * libraries that it needs itself it would take longer to load than all others that the program
 * is linked with.
 *
 * hdf5.Fopen() is HDF5's H5Fopen(); *hdf5.T_STD_U8LE_g is what its headers call H5T_STD_U8LE. A
 * name that is not in the table yet is added there. */
#ifndef LUTETIA_PAPER_HDF5_LIBRARY_H
#define LUTETIA_PAPER_HDF5_LIBRARY_H

#include "base/base.h"

#include <hdf5.h>

/* HDF5's constants call these two: hdf5_begin() does, instead. */
#undef H5OPEN
#define H5OPEN
#undef H5CHECK
#define H5CHECK

/* clang-format off */
#define HDF5_NAMES(X)                                                                                                  \
    X(check_version) X(open) X(dont_atexit) X(Eset_auto2) X(PLset_loading_state)                                                        \
    X(Fcreate) X(Fopen) X(Fclose) X(Fget_create_plist) X(FDregister)                                                   \
    X(Gcreate2) X(Gopen2) X(Gclose) X(Gget_info) X(Lexists) X(Lget_info) X(Lget_name_by_idx)                           \
    X(Oget_info) X(Oget_info_by_name)                                                                                  \
    X(Acreate2) X(Aopen_by_idx) X(Aclose) X(Awrite) X(Aget_space) X(Aget_type)                                         \
    X(Dcreate2) X(Dopen2) X(Dclose) X(Dread) X(Dwrite)                                                                 \
    X(Dget_create_plist) X(Dget_space) X(Dget_storage_size) X(Dget_type)                                               \
    X(Screate) X(Screate_simple) X(Sclose)                                                                             \
    X(Sget_simple_extent_dims) X(Sget_simple_extent_ndims) X(Sget_simple_extent_type)                                  \
    X(Tcopy) X(Tclose) X(Tequal) X(Tcommitted) X(Tget_class) X(Tget_size) X(Tset_size) X(Tis_variable_str)             \
    X(T_C_S1_g) X(T_IEEE_F32LE_g) X(T_STD_I64LE_g) X(T_STD_U32LE_g) X(T_STD_U8LE_g)                                    \
    X(T_NATIVE_FLOAT_g) X(T_NATIVE_LLONG_g) X(T_NATIVE_UINT32_g) X(T_NATIVE_UINT8_g)                                   \
    X(Pcreate) X(Pclose) X(Pget_chunk) X(Pset_chunk) X(Pget_driver_info) X(Pset_driver) X(Pget_userblock)              \
    X(Pset_userblock) X(Pget_external_count) X(Pget_layout) X(Pget_filter2) X(Pget_nfilters) X(Pset_deflate)           \
    X(Pset_shuffle) X(Pset_libver_bounds) X(Pset_obj_track_times)                                                      \
    X(P_CLS_DATASET_CREATE_ID_g) X(P_CLS_FILE_ACCESS_ID_g) X(P_CLS_FILE_CREATE_ID_g) X(P_CLS_GROUP_CREATE_ID_g)
/* clang-format on */

#define HDF5_MEMBER(name) __typeof__(H5##name) *name;
extern struct hdf5 {
    HDF5_NAMES(HDF5_MEMBER)
} hdf5;

/* Loads it, for work on the file of that name. Errors: PAPER_BAD_ARGUMENT: there is none.
 * Before a process gives up its right to open files. */
enum paper_status hdf5_load(const char *path);
/* Before the first call in a process: HDF5 then prints nothing, and does nothing at exit, where
 * it would try again to write what failed on a full disk, or crash on what it read. */
void hdf5_begin(void);

#endif
