/* loading.h - a large kernel that is in the driver's cache is brought from there by a thread,
 * while the program goes on: it takes 10 to 40 milliseconds. A small one takes the caller 6 to
 * 10; by a thread, beside the driver's own, it would come 20 later. */
#ifndef LUTETIA_MACHINE_LOADING_H
#define LUTETIA_MACHINE_LOADING_H

#include "base/aside.h"
#include "device/device.h"

/* One at a time. All zero: none. */
struct loading {
    struct aside aside;
    const struct device *device;
    const char *parts[DEVICE_PARTS]; /* the last is text; the others stay as they are */
    char *text, *options;
    cl_program program; /* NULL: it cannot be built */
};

/* False: there is no thread, or no memory. */
bool loading_begin(struct loading *l, const struct device *d,
                   const char *const parts[DEVICE_PARTS], const char *options);
bool loading_is_on(const struct loading *l);
/* Whether what is under way has ended, or never will: loading_take() does not wait. */
bool loading_is_done(const struct loading *l);
/* Whether it is of such a program. */
bool loading_is_of(const struct loading *l, const char *text, const char *options);
/* Waits until it has ended, if there is any. */
void loading_wait(struct loading *l);
/* Ends it, waiting where it must. The program is the caller's; NULL: there is none. */
cl_program loading_take(struct loading *l);
/* Ends it; nobody wants the program. */
void loading_drop(struct loading *l);

#endif
