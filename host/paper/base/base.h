/* base.h - shared by the files of this folder. */
#ifndef LUTETIA_PAPER_INTERNAL_H
#define LUTETIA_PAPER_INTERNAL_H

#include "paper.h"

#include <error_text.h>

/* Records the detail of a failure and returns its status. */
extern _Thread_local struct error_text paper_last_error;
#define paper_fail(status, ...)                                                                \
    ((enum paper_status)error_text_fail(&paper_last_error, (int)(status), __VA_ARGS__))

static inline bool paper_within(double x, double low, double high)
{
    return x >= low && x <= high; /* false for NaN */
}

/* K and S of a layer that looks so over white and over black, 0 < black < white < 1. Source:
 * Curtis et al. 1997, 5.1. */
void paper_layer_of(double white, double black, double *k, double *s);

#endif
