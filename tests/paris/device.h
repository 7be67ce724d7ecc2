/* device.h - shared by the tests of C/Paris: a VP set of an odd size, sample numbers and
 * masks. */
#ifndef PARIS_TESTS_DEVICE_H
#define PARIS_TESTS_DEVICE_H

#include <stdint.h>

#include "oracle.h"
#include "paris_internal.h"
#include <cm/paris.h>

enum { ROWS = 5, COLUMNS = 13, COUNT = ROWS * COLUMNS };

/* Starts a machine of 16 processors and selects a VP set of ROWS x COLUMNS: the VP ratio is 5,
 * and the last VPs are missing. eager: as in struct machine_config. Exits with 77 (skipped)
 * where there is no device. */
void device_start(int eager);

/* Write and read COUNT numbers of width bits in a field, whatever the context. */
void device_put(CM_field_id_t field, int width, const number *numbers);
void device_get(CM_field_id_t field, int width, number *numbers);

/* The next random number, by xorshift. */
uint64_t device_random(void);
void device_seed(uint64_t seed);
/* Draws COUNT numbers of width bits. Half of them are special: 0, 1, -1, the range's ends,
 * single bits. */
void device_integers(number *numbers, int width);
/* Draws COUNT floats (width 32 or 64): zeros of both signs, subnormals, infinities, NaNs, the
 * range's ends, whole numbers and halves, others. */
void device_floats(number *numbers, int width);

/* Draws a mask; which % 3: none, all, random. */
void device_mask(number *bits, int which);

/* The last message of the error handler device_error_catch(). */
extern char device_message[512];
void device_error_catch(const char *message);
/* Checks that the message is one line, begins with this call and contains `what`. Then clears
 * it. */
void device_said(const char *call, const char *what);

/* device_start(-1), for cmocka. */
int device_setup(void **unused);

#endif
