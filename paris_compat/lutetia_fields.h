/* <lutetia/fields.h> - fields to and from files of today.
 *
 *     lutetia_field_write("heat.npy", heat, "f4", 0);         // numpy.load("heat.npy")
 *     lutetia_field_read("mask.npy", mask, "b1", 0);
 *
 * The name's ending says which format: .npy is NumPy's, .h5 is HDF5's, .raw and .bin are the
 * values alone. The array in a .h5 file is called `field`, or as "heat.h5:temperature" says;
 * arrays that are read lie in one piece in the root group. A file holds a value for each
 * processor of the current VP set, in row-major order of its coordinates, whatever the context;
 * an array has the shape of the set. A file is written in bands, so that a large set needs
 * little memory on the front end, and appears under its name when it is whole.
 *
 * Types are NumPy's: "u1" "u2" "u4" "u8", "i1" "i2" "i4" "i8", "f4" "f8", "c8" "c16", and "b1",
 * a bit. `len` is the field's length where an integer of the file is longer than it: "i2" and
 * 12 for fields of 12 bits. 0: as long as the type, and 1 bit for "b1".
 *
 * Errors: 0 is returned, and a line explains to the error handler what was wrong, as in
 * <cm/paris.h>; file and field are as they were. Ownership: names stay the caller's. Threads:
 * all calls belong to the thread that makes the calls of <cm/paris.h>. */
#ifndef LUTETIA_FIELDS_H
#define LUTETIA_FIELDS_H

#include <cm/paris.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Writes a field of the current VP set. Returns 1. Errors: 0 (a name without a format, a field
 * that is too short, a full disk). */
extern int lutetia_field_write(const char *file, CM_field_id_t field, const char *type,
                               unsigned int len);
/* Reads one. Returns 1. Errors: 0 where the file has another shape or type, or another length,
 * or a value that the field has no room for. Big-endian files are read, too. */
extern int lutetia_field_read(const char *file, CM_field_id_t field, const char *type,
                              unsigned int len);
/* The lengths of the axes of a .npy or .h5 file's array, as many as there is room for. Returns
 * how many axes it has. Errors: -1. */
extern int lutetia_file_shape(const char *file, unsigned int *lengths, int most);

#ifdef __cplusplus
}
#endif

#endif
