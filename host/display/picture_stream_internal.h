/* picture_stream_internal.h - a way to hand pictures out. Its functions are called by one
 * thread at a time: the first open() by the caller of picture_stream_open(), all else by the
 * stream's. */
#ifndef LUTETIA_PICTURE_STREAM_INTERNAL_H
#define LUTETIA_PICTURE_STREAM_INTERNAL_H

#include "picture_stream.h"

#include <sys/types.h>

struct picture_way {
    /* *own: what it needs. False: `why` has one line. */
    bool (*open)(const struct picture_stream_def *def, void **own, char *why, size_t room);
    bool (*send)(void *own, const struct display_image *image, char *why, size_t room);
    void (*close)(void *own);
};

extern const struct picture_way picture_way_v4l2, picture_way_pipewire;

/* What a device is reached by; tests put a device of their own in its place. */
struct picture_system {
    int (*open)(const char *path, int flags);
    int (*ioctl)(int file, unsigned long request, void *argument);
    ssize_t (*write)(int file, const void *bytes, size_t count);
    int (*close)(int file);
};
extern struct picture_system picture_system;

#endif
