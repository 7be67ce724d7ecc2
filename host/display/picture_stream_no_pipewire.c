/* picture_stream_no_pipewire.c - this build has no PipeWire. */
#include "picture_stream_internal.h"

#include <stdio.h>

static bool no_open(const struct picture_stream_def *def, void **own, char *why, size_t room)
{
    (void)def;
    *own = NULL;
    snprintf(why, room,
             "this lutetia was built without PipeWire: install libpipewire-0.3-dev and build "
             "it again");
    return false;
}

static bool no_send(void *own, const struct display_image *image, char *why, size_t room)
{
    (void)own;
    (void)image;
    snprintf(why, room, "there is no PipeWire");
    return false;
}

static void no_close(void *own)
{
    (void)own;
}

const struct picture_way picture_way_pipewire = {no_open, no_send, no_close};
