/* device_file.c - a Standard MIDI File, played in time, once or repeatedly. */
#include "device_kinds.h"

#include <midi_internal.h>
#include <midi_song.h>
#include <midi_time.h>

#include <stdlib.h>
#include <string.h>

enum { LEAD_MS = 100, PAUSE_MS = 500 };

struct playing {
    struct midi_song *song;
    struct midi_song_info info;
    size_t next;
    uint64_t begin_ns;
    bool again;
    struct server_timer timer;
};

struct stamped {
    struct server_device *device;
    uint64_t time_ns;
};

static void stamped_take(void *context, const struct midi_message *m)
{
    const struct stamped *s = context;
    struct midi_message timed = *m;
    timed.time_ns = s->time_ns;
    device_message(s->device, &timed);
}

static void play_fire(struct server_timer *t, uint64_t now_ns)
{
    struct server_device *d = t->owner;
    struct playing *p = d->own;
    while (p->next < p->info.events_count) {
        const struct midi_song_event e = midi_song_event(p->song, p->next);
        const uint64_t due_ns = p->begin_ns + e.time_ns;
        if (due_ns > now_ns) {
            device_read_end(d);
            loop_timer(d->loop, t, due_ns);
            return;
        }
        p->next++;
        struct stamped s = {d, due_ns};
        midi_song_play(&e, &d->parser, stamped_take, &s);
    }
    device_read_end(d);
    if (p->again) {
        p->next = 0;
        p->begin_ns += p->info.end_ns + PAUSE_MS * UINT64_C(1000000);
        loop_timer(d->loop, t, p->begin_ns);
    }
}

static enum midi_status file_open(struct server_device *d)
{
    char path[DEVICE_ARGUMENT_BYTES];
    memcpy(path, d->argument, sizeof path);
    struct playing *p = calloc(1, sizeof *p);
    if (!p)
        return midi_fail(MIDI_NO_MEMORY, "no memory");
    d->own = p;
    p->timer = (struct server_timer){.due_ns = UINT64_MAX, .fire = play_fire, .owner = d};
    const size_t count = strlen(path);
    if (count > 5 && !strcmp(path + count - 5, "@loop")) {
        p->again = true;
        path[count - 5] = '\0';
    }
    enum midi_status status = midi_song_read(path, &p->song);
    if (status != MIDI_OK)
        return MIDI_BAD_FILE; /* it is a mistake, not something that will be plugged in */
    p->info = midi_song_info(p->song);
    p->begin_ns = midi_now_ns() + LEAD_MS * UINT64_C(1000000);
    loop_timer(d->loop, &p->timer, p->begin_ns);
    return MIDI_OK;
}

static void file_close(struct server_device *d)
{
    struct playing *p = d->own;
    if (!p)
        return;
    loop_timer_remove(d->loop, &p->timer);
    midi_song_destroy(p->song);
    free(p);
    d->own = NULL;
}

static size_t file_write(struct server_device *d, const uint8_t *bytes, size_t count)
{
    (void)d;
    (void)bytes;
    return count;
}

const struct device_kind device_kind_file = {
    .name = "file",
    .argument = "SONG.mid[@loop]",
    .help = "a Standard MIDI File, played in time",
    .hears = true,
    .stays = true,
    .open = file_open,
    .close = file_close,
    .write = file_write,
};
