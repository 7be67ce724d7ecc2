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

#endif
