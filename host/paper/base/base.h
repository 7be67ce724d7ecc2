/* base.h - what the files of this folder share. */
#ifndef LUTETIA_PAPER_INTERNAL_H
#define LUTETIA_PAPER_INTERNAL_H

#include "paper.h"

/* Records the detail of a failure and returns its status. */
enum paper_status paper_fail(enum paper_status status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static inline bool paper_within(double x, double low, double high)
{
    return x >= low && x <= high; /* false for NaN */
}

#endif
