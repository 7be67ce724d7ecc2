/* device_loop.c - a virtual device: programs that listen to it receive what programs send to
 * it. */
#include "device_kinds.h"

#include <midi_time.h>

static enum midi_status loop_open(struct server_device *d)
{
    (void)d;
    return MIDI_OK;
}

static void loop_close(struct server_device *d)
{
    (void)d;
}

static size_t loop_write(struct server_device *d, const uint8_t *bytes, size_t count)
{
    device_input(d, midi_now_ns(), bytes, count);
    device_read_end(d);
    return count;
}

const struct device_kind device_kind_loop = {
    .name = "loop",
    .help = "no device: what programs send there, those that listen hear",
    .plays = true,
    .hears = true,
    .stays = true,
    .open = loop_open,
    .close = loop_close,
    .write = loop_write,
};
