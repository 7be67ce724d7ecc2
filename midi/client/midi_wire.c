/* midi_wire.c - see midi_wire.h. */
#include "midi_wire.h"

#include <user_folder.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void number_put(uint8_t *bytes, uint64_t value, int count)
{
    for (int i = 0; i < count; i++)
        bytes[i] = (uint8_t)(value >> 8 * i);
}

static uint64_t number_get(const uint8_t *bytes, int count)
{
    uint64_t value = 0;
    for (int i = count - 1; i >= 0; i--)
        value = value << 8 | bytes[i];
    return value;
}

void midi_wire_head(const struct midi_wire_frame *f, uint8_t bytes[static MIDI_WIRE_HEAD])
{
    number_put(bytes, f->count, 2);
    bytes[2] = f->kind;
    bytes[3] = f->device;
    number_put(bytes + 4, f->number, 4);
    number_put(bytes + 8, f->time_ns, 8);
}

size_t midi_wire_read(const uint8_t *bytes, size_t count, struct midi_wire_frame *f)
{
    if (count < MIDI_WIRE_HEAD)
        return 0;
    f->count = (uint16_t)number_get(bytes, 2);
    f->kind = bytes[2];
    f->device = bytes[3];
    f->number = (uint32_t)number_get(bytes + 4, 4);
    f->time_ns = number_get(bytes + 8, 8);
    f->payload = bytes + MIDI_WIRE_HEAD;
    return count >= MIDI_WIRE_HEAD + (size_t)f->count ? MIDI_WIRE_HEAD + (size_t)f->count : 0;
}

bool midi_wire_message(const struct midi_wire_frame *f, struct midi_message *m)
{
    if (f->count < 1 || f->count > MIDI_BYTES_MAX)
        return false;
    m->time_ns = f->time_ns;
    m->count = f->count;
    memcpy(m->bytes, f->payload, f->count);
    return midi_message_good(m);
}

bool midi_wire_usual_path(char path[static 108], const char **why)
{
    char folder[80];
    const char *run = getenv("XDG_RUNTIME_DIR");
    if (run && run[0] == '/' && strlen(run) < sizeof folder)
        snprintf(folder, sizeof folder, "%s", run);
    else
        snprintf(folder, sizeof folder, "/tmp/lutetia-%lu", (unsigned long)getuid());
    user_folder_make(folder);
    *why = user_folder_wrong(folder);
    snprintf(path, 108, "%s/lutetia-midi", folder);
    return !*why;
}
