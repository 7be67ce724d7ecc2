/* near.h - what the front end does by itself where the device's memory is its own: one
 * processor's number, a reduction.
 *
 * A launch and a wait cost 10 to 40 us whatever the work. Large sets are shared out among the
 * device's crew. */
#ifndef LUTETIA_MACHINE_NEAR_H
#define LUTETIA_MACHINE_NEAR_H

#include "device/device.h"
#include "interpret/lanes.h"
#include "values/values.h"

/* Whether the front end does it by itself: it can look at arrays such as this one, and the
 * device has done all that is in its queue. near_end() tells those who watch what it was. */
bool near_begin(struct machine *m, const struct device_buffer *b, double *start);
void near_end(struct machine *m, const char *what, double start);

/* The value of one processor, if it is in memory, or was only moved since (parts, selections,
 * coordinates); nothing is evaluated. False: it is not so, and nothing has been done. */
bool near_read(struct machine *m, int set, const struct machine_value *v, uint64_t index,
               struct machine_scalar *out);

/* What is reduced, of numbers that are in memory. */
struct near_sum {
    enum reduction_op op;
    bool is_float;
    int width;    /* of integers: what is read of an element */
    bool plain;   /* ... they are as long as the result, or added without a sign */
    bool extends; /* ... it has a sign */
    struct machine_scalar flip; /* ... exclusive or, after that */
    struct machine_scalar identity;
    const struct device_buffer *numbers;
    size_t element;                      /* bytes */
    const struct device_buffer *context; /* bytes; NULL: all are active */
};
/* One number for each run of so many columns of each row, rows one after the other, in the
 * order of kernels/reduce.cl. False: the memory is the device's, and nothing has been done. */
bool near_sums(struct machine *m, const struct vpset *s, const struct near_sum *what,
               size_t run, struct machine_scalar *sums);

#endif
