/* display_internal.h - what the files of this folder share. */
#ifndef LUTETIA_DISPLAY_INTERNAL_H
#define LUTETIA_DISPLAY_INTERNAL_H

#include "display.h"

/* Records the detail of a failure and returns its status. */
enum display_status display_fail(enum display_status status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
