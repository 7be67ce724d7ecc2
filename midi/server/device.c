/* device.c - see device.h. */
#include "device.h"

#include <midi_internal.h>
#include <midi_time.h>

#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RETRY_MS = 100, LEAVE_MS = 300 };

static void retry_fire(struct server_timer *t, uint64_t now_ns)
{
    (void)now_ns;
    (void)device_start(t->owner);
}

static void retry_set(struct server_device *d)
{
    const int ms = d->kind->retry_ms ? d->kind->retry_ms : RETRY_MS;
    loop_timer(d->loop, &d->retry, midi_now_ns() + (uint64_t)ms * 1000000);
}

/* The name is letters, digits and -_. */
static bool name_good(const char *name, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!((name[i] | 0x20) >= 'a' && (name[i] | 0x20) <= 'z') &&
            !(name[i] >= '0' && name[i] <= '9') && !strchr("-_.", name[i]))
            return false;
    return count > 0 && count < DEVICE_NAME_BYTES;
}

static enum midi_status kind_unknown(const struct device_kind *const *kinds, const char *spec)
{
    char known[200] = "";
    for (int i = 0; kinds[i]; i++)
        error_text_list(known, sizeof known, ", ", kinds[i]->name);
    return midi_fail(MIDI_BAD_ARGUMENT,
                     "device '%.60s': it must be [NAME=]KIND[:ARGUMENT]; known kinds are %s",
                     spec, known);
}

enum midi_status device_create(const struct device_kind *const *kinds, const char *spec,
                               struct server_loop *loop, struct server_device **out)
{
    const char *at = spec, *equals = strchr(spec, '=');
    const size_t name_count = equals ? (size_t)(equals - spec) : 0;
    const struct device_kind *kind = NULL;
    *out = NULL;
    if (equals && name_good(spec, name_count))
        at = equals + 1;
    const size_t kind_count = strcspn(at, ":");
    for (int i = 0; kinds[i]; i++)
        if (strlen(kinds[i]->name) == kind_count && !strncmp(kinds[i]->name, at, kind_count))
            kind = kinds[i];
    const char *argument = at[kind_count] ? at + kind_count + 1 : "";
    if (!kind)
        return kind_unknown(kinds, spec);
    if (kind->argument && kind->argument[0] != '[' && !argument[0])
        return midi_fail(MIDI_BAD_ARGUMENT, "device '%.60s': %s needs its %s: %s:%s", spec,
                         kind->name, kind->argument, kind->name, kind->argument);
    if (strlen(argument) >= DEVICE_ARGUMENT_BYTES)
        return midi_fail(MIDI_BAD_ARGUMENT, "device '%.60s...': at most %d bytes", spec,
                         DEVICE_ARGUMENT_BYTES - 1);
    struct server_device *d = calloc(1, sizeof *d);
    if (!d)
        return midi_fail(MIDI_NO_MEMORY, "no memory for a device");
    d->kind = kind;
    d->loop = loop;
    d->plays = kind->plays;
    d->hears = kind->hears;
    snprintf(d->argument, sizeof d->argument, "%s", argument);
    snprintf(d->name, sizeof d->name, "%.*s", at == spec ? (int)kind_count : (int)name_count,
             at == spec ? at : spec);
    d->retry = (struct server_timer){.due_ns = UINT64_MAX, .fire = retry_fire, .owner = d};
    snprintf(d->why, sizeof d->why, "not started");
    *out = d;
    return MIDI_OK;
}

static void put_take(void *context, const struct midi_message *m)
{
    (void)device_put(context, m);
}

enum midi_status device_start(struct server_device *d)
{
    enum midi_status status = d->kind->open(d);
    if (status != MIDI_OK) {
        char why[sizeof d->why];
        snprintf(why, sizeof why, "%s", midi_error());
        d->kind->close(d);
        const bool changed = strcmp(d->why, why) != 0;
        memcpy(d->why, why, sizeof why);
        if (status == MIDI_BAD_ARGUMENT || status == MIDI_BAD_FILE)
            return midi_fail(status, "device %s: %s", d->name, why);
        retry_set(d);
        if (changed)
            d->changed(d);
        return MIDI_OK;
    }
    midi_parser_init(&d->parser);
    d->encoder = (struct midi_encoder){.running_status = true};
    d->out_count = d->out_first = 0;
    d->sounding = d->played = (struct midi_notes){0};
    d->up = true;
    d->why[0] = '\0';
    d->counts.opened++;
    d->changed(d);
    /* The device's last player may have died with keys down. */
    if (d->up && d->plays && !d->kind->stays) {
        midi_notes_silence(midi_now_ns(), put_take, d);
        device_write_out(d);
    }
    return MIDI_OK;
}

static void received_take(void *context, const struct midi_message *m)
{
    device_message(context, m);
}

void device_down(struct server_device *d, const char *why)
{
    if (!d->up)
        return;
    d->up = false;
    snprintf(d->why, sizeof d->why, "%s", why);
    midi_parser_end(&d->parser, midi_now_ns(), received_take, d);
    d->kind->close(d);
    d->out_count = 0;
    d->more_wanted = false;
    d->sounding = d->played = (struct midi_notes){0};
    retry_set(d);
    d->changed(d);
    d->drained(d); /* clients that wait for it need not wait any longer */
}

void device_destroy(struct server_device *d)
{
    if (!d)
        return;
    if (d->up && d->plays) {
        const uint64_t until_ns = midi_now_ns() + LEAVE_MS * UINT64_C(1000000);
        midi_notes_release(&d->sounding, midi_now_ns(), put_take, d);
        for (;;) {
            device_write_out(d);
            if (!d->up || midi_now_ns() > until_ns ||
                (!d->out_count && !(d->kind->busy && d->kind->busy(d))))
                break;
            poll(NULL, 0, 2);
        }
    }
    loop_timer_remove(d->loop, &d->retry);
    d->kind->close(d);
    if (d->kind->finish)
        d->kind->finish(d);
    free(d);
}

/* ---- in ---- */

void device_message(struct server_device *d, const struct midi_message *m)
{
    d->counts.in++;
    d->received(d, m);
}

void device_input(struct server_device *d, uint64_t time_ns, const uint8_t *bytes, size_t count)
{
    midi_parser_take(&d->parser, time_ns, bytes, count, received_take, d);
}

void device_read_end(struct server_device *d)
{
    d->read(d);
}

void device_lost(struct server_device *d, uint32_t in, uint32_t out)
{
    if (!in && !out)
        return;
    if (in) /* the middle of a message, perhaps */
        midi_parser_end(&d->parser, midi_now_ns(), received_take, d);
    d->counts.lost += (uint64_t)in + out;
    d->ends_again = true;
    d->lost(d, in, out);
}

void device_look(struct server_device *d)
{
    if (!d->ends_again || !d->up)
        return;
    d->ends_again = false;
    struct midi_notes ended = d->played;
    ended.pedals &= (uint16_t)~d->sounding.pedals;
    for (int i = 0; i < MIDI_CHANNELS; i++)
        for (int k = 0; k < 2; k++)
            ended.on[i][k] &= ~d->sounding.on[i][k];
    midi_notes_release(&ended, midi_now_ns(), put_take, d);
    device_write_out(d);
}

/* ---- out ---- */

bool device_has_room(const struct server_device *d)
{
    return d->out_count < DEVICE_OUT_USUAL;
}

bool device_put(struct server_device *d, const struct midi_message *m)
{
    uint8_t bytes[MIDI_ENCODED_MAX];
    if (!d->up || !d->plays)
        return false;
    if (d->out_count + MIDI_ENCODED_MAX > DEVICE_OUT_BYTES)
        return false;
    const size_t count = midi_encoder_put(&d->encoder, m, bytes);
    if (!count)
        return false;
    for (size_t i = 0; i < count; i++)
        d->out[(d->out_first + d->out_count + i) % DEVICE_OUT_BYTES] = bytes[i];
    d->out_count += count;
    d->counts.out++;
    midi_notes_take(&d->sounding, m);
    d->played.pedals |= d->sounding.pedals;
    for (int k = 0; k < 2 && midi_message_channel(m) >= 0; k++)
        d->played.on[midi_message_channel(m)][k] |= d->sounding.on[midi_message_channel(m)][k];
    return true;
}

void device_write_out(struct server_device *d)
{
    const bool waited = d->more_wanted;
    if (d->writing)
        return;
    d->writing = true;
    while (d->up && d->out_count) {
        const size_t to_end = DEVICE_OUT_BYTES - d->out_first;
        const size_t count = d->out_count < to_end ? d->out_count : to_end;
        const size_t taken = d->kind->write(d, d->out + d->out_first, count);
        if (!d->up)
            break;
        d->out_first = (d->out_first + taken) % DEVICE_OUT_BYTES;
        d->out_count -= taken;
        if (taken < count)
            break;
    }
    d->writing = false;
    if (!d->up)
        return;
    d->more_wanted = d->out_count > 0;
    if (d->more_wanted != waited && d->kind->more)
        d->kind->more(d, d->more_wanted);
    if (waited && device_has_room(d))
        d->drained(d);
}
