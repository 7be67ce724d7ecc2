/* live_source.c - see live_source.h. */
#include "live_source.h"

#include "computer_keys.h"

#include <midi_client.h>

#include <midi_internal.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WAITING_MAX = 64 };

struct live_source {
    struct midi_song *song;
    size_t song_at;
    struct midi_client *client;
    bool computer;
    struct computer_keys keys;
    struct midi_message waiting[WAITING_MAX]; /* of the computer's keyboard */
    int waiting_first, waiting_count;
    char text[200];
    bool said;
};

static enum midi_status client_begin(struct live_source *s, const struct live_source_def *def)
{
    struct midi_client_def client = midi_client_def_default("lutetia live");
    client.address = def->server;
    enum midi_status status = midi_client_open(&client, &s->client);
    if (status == MIDI_NO_SERVER && !def->server) {
        s->computer = !def->no_computer;
        return MIDI_OK;
    }
    if (status != MIDI_OK)
        return status;
    return midi_client_listen(s->client, def->device ? def->device : "*",
                              def->filters ? def->filters : "");
}

enum midi_status live_source_open(const struct live_source_def *def, struct live_source **out)
{
    struct live_source *s = calloc(1, sizeof *s);
    *out = NULL;
    if (!s)
        return midi_fail(MIDI_NO_MEMORY, "no memory for what is played");
    s->song = def->song;
    s->keys.lowest = def->lowest;
    enum midi_status status = s->song ? MIDI_OK : client_begin(s, def);
    if (status != MIDI_OK) {
        live_source_close(s);
        return status;
    }
    *out = s;
    return MIDI_OK;
}

void live_source_close(struct live_source *s)
{
    if (!s)
        return;
    midi_client_close(s->client);
    free(s);
}

bool live_source_by_computer(const struct live_source *s)
{
    return s->computer;
}

void live_source_no_computer(struct live_source *s)
{
    s->computer = false;
}

static bool wait_put(struct live_source *s, const struct midi_message *m)
{
    if (s->waiting_count == WAITING_MAX)
        return false;
    s->waiting[(s->waiting_first + s->waiting_count++) % WAITING_MAX] = *m;
    return true;
}

bool live_source_key(struct live_source *s, const struct input_event *event)
{
    struct midi_message m;
    if (!s->computer)
        return false;
    if (event->kind == INPUT_FOCUS_LOST) {
        while (computer_keys_release(&s->keys, &m) && wait_put(s, &m))
            ;
        return false; /* others lose it, too */
    }
    return computer_keys_take(&s->keys, event, &m) && wait_put(s, &m);
}

/* Of the song: channel messages alone. */
static bool song_next(struct live_source *s, double now_s, struct midi_message *m)
{
    const struct midi_song_info info = midi_song_info(s->song);
    while (s->song_at < info.events_count) {
        const struct midi_song_event e = midi_song_event(s->song, s->song_at);
        if ((double)e.time_ns / 1e9 > now_s)
            return false;
        s->song_at++;
        if (e.kind != MIDI_SONG_MESSAGE)
            continue;
        const struct midi_row *row = midi_row_of(e.bytes[0]);
        *m = midi_message_make(e.time_ns, e.bytes[0], e.bytes[1],
                               row->data_count > 1 ? e.bytes[2] : 0);
        return true;
    }
    return false;
}

double live_source_due_s(const struct live_source *s)
{
    const size_t count = s->song ? midi_song_info(s->song).events_count : 0;
    for (size_t at = s->song_at; at < count; at++) {
        const struct midi_song_event e = midi_song_event(s->song, at);
        if (e.kind == MIDI_SONG_MESSAGE)
            return (double)e.time_ns / 1e9;
    }
    return INFINITY;
}

static bool client_next(struct live_source *s, struct midi_message *m)
{
    struct midi_client_event e;
    while (midi_client_next(s->client, 0, &e) == MIDI_OK && e.kind != MIDI_CLIENT_NOTHING) {
        if (e.kind == MIDI_CLIENT_MESSAGE) {
            *m = e.message;
            return true;
        }
        s->said = true;
        if (e.kind == MIDI_CLIENT_GONE)
            snprintf(s->text, sizeof s->text, "the MIDI server is gone: %.150s", e.text);
        else if (e.kind == MIDI_CLIENT_BACK)
            snprintf(s->text, sizeof s->text, "the MIDI server is back");
        else if (e.kind == MIDI_CLIENT_DEVICE)
            snprintf(s->text, sizeof s->text, "%.150s", e.text);
        else
            s->said = false;
    }
    return false;
}

bool live_source_next(struct live_source *s, double now_s, struct midi_message *m)
{
    if (s->song)
        return song_next(s, now_s, m);
    if (s->waiting_count) {
        *m = s->waiting[s->waiting_first];
        s->waiting_first = (s->waiting_first + 1) % WAITING_MAX;
        s->waiting_count--;
        return true;
    }
    return s->client && client_next(s, m);
}

int live_source_descriptor(const struct live_source *s)
{
    return s->client ? midi_client_descriptor(s->client) : -1;
}

const char *live_source_said(struct live_source *s)
{
    const bool said = s->said;
    s->said = false;
    return said ? s->text : NULL;
}
