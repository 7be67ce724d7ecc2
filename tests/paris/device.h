/* device.h - what the tests of C/Paris share: a VP set of an odd size, numbers in it, and
 * masks. */
#ifndef PARIS_TESTS_DEVICE_H
#define PARIS_TESTS_DEVICE_H

#include <stdint.h>

#include "oracle.h"
#include "paris_internal.h"
#include <cm/paris.h>

enum { ROWS = 5, COLUMNS = 13, COUNT = ROWS * COLUMNS };

/* A machine of 16 processors with a VP set of ROWS x COLUMNS current: VP ratio 5, the last ones
 * missing. eager as in struct machine_config. Exits with 77 (skipped) where there is no device.
 * */
void device_start(int eager);

/* COUNT numbers of width bits to and from a field, whatever the context. */
void device_put(CM_field_id_t field, int width, const number *numbers);
void device_get(CM_field_id_t field, int width, number *numbers);

/* Reproducible: xorshift. */
uint64_t device_random(void);
void device_seed(uint64_t seed);
/* COUNT numbers of width bits, half of them special: 0, 1, -1, the ends, single bits. */
void device_integers(number *numbers, int width);
/* COUNT floats (width 32 or 64): zeros of both signs, denormals, infinities, NaNs, the ends,
 * whole numbers and halves, others. */
void device_floats(number *numbers, int width);

/* which % 3: none, all, random */
void device_mask(number *bits, int which);

/* What error handler messages said last; handler is device_error_catch. */
extern char device_message[512];
void device_error_catch(const char *message);
/* It was about that call and mentions what, in one line; it is forgotten then. */
void device_said(const char *call, const char *what);

/* device_start(-1), for cmocka. */
int device_setup(void **unused);

#endif
