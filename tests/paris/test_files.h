/* test_files.h - shared by the tests of fields in files. */
#ifndef PARIS_TESTS_FILES_H
#define PARIS_TESTS_FILES_H

#include "device.h"

#include <lutetia/fields.h>
#include <stddef.h>

enum { BYTES_MOST = 1 << 16 };

size_t file_read(const char *path, uint8_t *bytes); /* at most BYTES_MOST */
void file_write(const char *path, const void *bytes, size_t count);

/* Writes `len` random bits to each processor, bit by bit; values[i] holds those of processor
 * i. */
CM_field_id_t field_make(unsigned int len, uint8_t (*values)[32]);
void field_is(CM_field_id_t field, unsigned int len, uint8_t (*values)[32]);

/* test_files_h5.c */
void fields_go_to_hdf5(void **unused);
void fields_come_from_hdf5(void **unused);
void groups_of_all_ages_have_their_names(void **unused);
void damaged_hdf5_files_are_refused_or_read(void **unused);

#endif
