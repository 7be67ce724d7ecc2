/* midi_song.c - see midi_song.h: events, their order, the tempo map. Files are in
 * midi_song_read.c and midi_song_write.c. */
#include "midi_song_internal.h"

#include <stdlib.h>
#include <string.h>

enum midi_status song_room(void **items, size_t *room, size_t count, size_t item_bytes)
{
    if (count <= *room)
        return MIDI_OK;
    size_t wanted = *room ? 2 * *room : 64;
    wanted = wanted < count ? count : wanted;
    void *grown = realloc(*items, wanted * item_bytes);
    if (!grown)
        return midi_fail(MIDI_NO_MEMORY, "no memory for %zu events", count);
    *items = grown;
    *room = wanted;
    return MIDI_OK;
}

struct midi_song_def midi_song_def_default(void)
{
    return (struct midi_song_def){.format = 1, .division = MIDI_DIVISION_USUAL};
}

static bool division_good(int division)
{
    if (division > 0)
        return division <= 32767;
    const int frames = -division >> 8, ticks = -division & 255;
    return ticks > 0 && (frames == 24 || frames == 25 || frames == 29 || frames == 30);
}

enum midi_status midi_song_create(const struct midi_song_def *def, struct midi_song **out)
{
    *out = NULL;
    if ((def->format != 0 && def->format != 1) || !division_good(def->division))
        return midi_fail(
            MIDI_BAD_ARGUMENT,
            "a song has format 0 or 1 and a division of 1..32767 ticks or of SMPTE "
            "frames (got format %d, division %d)",
            def->format, def->division);
    struct midi_song *song = calloc(1, sizeof *song);
    if (!song)
        return midi_fail(MIDI_NO_MEMORY, "no memory for a song");
    song->format = def->format;
    song->division = def->division;
    song->open_track = -1;
    *out = song;
    return MIDI_OK;
}

void midi_song_destroy(struct midi_song *song)
{
    if (!song)
        return;
    free(song->events);
    free(song->bytes);
    free(song->end_ticks);
    free(song->tempos);
    free(song);
}

/* ---- time ---- */

static const uint64_t TIME_MAX_NS = UINT64_MAX / 4;

/* Converts ticks of factor_us / parts microseconds each to nanoseconds. */
static uint64_t ticks_ns(uint64_t ticks, uint64_t factor_us, uint64_t parts)
{
    const uint64_t product = ticks * factor_us; /* below 2^32 and 2^24 */
    if (product / parts > TIME_MAX_NS / 2000)
        return TIME_MAX_NS;
    return product / parts * 1000 + product % parts * 1000 / parts;
}

/* A tick's length as a fraction, of quarter notes or of frames; 29 frames a second are
 * 30/1.001. */
static void tick_length(const struct midi_song *song, uint32_t tempo_us, uint64_t *factor_us,
                        uint64_t *parts)
{
    if (song->division > 0) {
        *factor_us = tempo_us;
        *parts = (uint64_t)song->division;
        return;
    }
    const uint64_t frames = (uint64_t)(-song->division >> 8),
                   ticks = (uint64_t)(-song->division & 255);
    *factor_us = frames == 29 ? 1001000 : 1000000;
    *parts = (frames == 29 ? 30 : frames) * ticks;
}

static uint64_t time_after(const struct midi_song *song, const struct song_tempo *t,
                           uint32_t tick)
{
    uint64_t factor_us, parts;
    tick_length(song, t->tempo_us, &factor_us, &parts);
    const uint64_t ns = t->time_ns + ticks_ns(tick - t->tick, factor_us, parts);
    return ns < TIME_MAX_NS ? ns : TIME_MAX_NS;
}

static int event_order(const void *a, const void *b)
{
    const struct song_event *x = a, *y = b;
    if (x->tick != y->tick)
        return x->tick < y->tick ? -1 : 1;
    if (x->track != y->track)
        return x->track < y->track ? -1 : 1;
    return x->order < y->order ? -1 : x->order > y->order;
}

static enum midi_status tempo_add(struct midi_song *song, uint32_t tick, uint32_t tempo_us)
{
    void *tempos = song->tempos;
    enum midi_status status =
        song_room(&tempos, &song->tempos_room, song->tempos_count + 1, sizeof *song->tempos);
    song->tempos = tempos;
    if (status != MIDI_OK)
        return status;
    struct song_tempo t = {tick, tempo_us, 0};
    if (song->tempos_count)
        t.time_ns = time_after(song, &song->tempos[song->tempos_count - 1], tick);
    song->tempos[song->tempos_count++] = t;
    return MIDI_OK;
}

enum midi_status song_sort(struct midi_song *song)
{
    if (song->sorted)
        return MIDI_OK;
    song->open_track =
        -1; /* the event of the recorded system exclusive may no longer be the last */
    if (song->events_count)
        qsort(song->events, song->events_count, sizeof *song->events, event_order);
    song->tempos_count = 0;
    enum midi_status status = tempo_add(song, 0, MIDI_TEMPO_USUAL_US);
    for (size_t i = 0; status == MIDI_OK && i < song->events_count; i++) {
        struct song_event *e = &song->events[i];
        const uint8_t *b = e->count ? song->bytes + e->offset : NULL;
        if (e->kind == MIDI_SONG_META && e->meta == MIDI_META_TEMPO && e->count == 3 &&
            song->division > 0)
            status = tempo_add(song, e->tick, (uint32_t)(b[0] << 16 | b[1] << 8 | b[2]));
        e->time_ns = time_after(song, &song->tempos[song->tempos_count - 1], e->tick);
    }
    song->sorted = status == MIDI_OK;
    return status;
}

/* The last tempo that begins at or before the tick, or the time. */
static const struct song_tempo *tempo_at(struct midi_song *song, uint32_t tick, uint64_t ns)
{
    size_t low = 0, high;
    if (song_sort(song) != MIDI_OK)
        return NULL;
    for (high = song->tempos_count; high - low > 1;) {
        const size_t middle = (low + high) / 2;
        const struct song_tempo *t = &song->tempos[middle];
        *(t->tick <= tick && t->time_ns <= ns ? &low : &high) = middle;
    }
    return &song->tempos[low];
}

uint64_t midi_song_time_ns(struct midi_song *song, uint32_t tick)
{
    const struct song_tempo *t = tempo_at(song, tick, UINT64_MAX);
    return t ? time_after(song, t, tick) : 0;
}

static uint32_t tick_near(const struct midi_song *song, const struct song_tempo *t,
                          uint64_t time_ns)
{
    uint64_t factor_us, parts;
    tick_length(song, t->tempo_us, &factor_us, &parts);
    if (!factor_us)
        return t->tick;
    const double ticks =
        (double)(time_ns - t->time_ns) * (double)parts / (1000.0 * (double)factor_us);
    const double tick = t->tick + ticks + 0.5;
    return tick >= UINT32_MAX ? UINT32_MAX : (uint32_t)tick;
}

uint32_t midi_song_tick(struct midi_song *song, uint64_t time_ns)
{
    const struct song_tempo *t = tempo_at(song, UINT32_MAX, time_ns);
    return t ? tick_near(song, t, time_ns) : 0;
}

/* ---- events ---- */

struct midi_song_info midi_song_info(struct midi_song *song)
{
    struct midi_song_info info = {.format = song->format,
                                  .division = song->division,
                                  .tracks_count = song->tracks_count,
                                  .events_count = song->events_count};
    for (int i = 0; i < song->tracks_count; i++)
        if (song->end_ticks[i] > info.end_tick)
            info.end_tick = song->end_ticks[i];
    info.end_ns = midi_song_time_ns(song, info.end_tick);
    return info;
}

struct midi_song_event midi_song_event(struct midi_song *song, size_t index)
{
    (void)song_sort(song);
    const struct song_event *e = &song->events[index];
    return (struct midi_song_event){e->time_ns,
                                    e->tick,
                                    e->track,
                                    (enum midi_song_kind)e->kind,
                                    e->meta,
                                    e->count,
                                    e->count ? song->bytes + e->offset : NULL};
}

void midi_song_play(const struct midi_song_event *e, struct midi_parser *parser,
                    midi_take *take, void *context)
{
    if (e->kind != MIDI_SONG_META)
        midi_parser_take(parser, e->time_ns, e->bytes, e->count, take, context);
}

static bool event_good(const struct midi_song_event *e)
{
    switch (e->kind) {
    case MIDI_SONG_MESSAGE: {
        struct midi_message m = {.count = (uint16_t)e->count};
        if (!e->count || e->count > 3)
            return false;
        memcpy(m.bytes, e->bytes, e->count);
        return midi_message_channel(&m) >= 0 && midi_message_good(&m);
    }
    case MIDI_SONG_SYSEX:
        return e->count && e->bytes[0] == MIDI_SYSEX;
    case MIDI_SONG_META:
        return e->meta < 0x80 && e->meta != MIDI_META_END;
    case MIDI_SONG_ESCAPE:
        break;
    }
    return true;
}

static enum midi_status track_make(struct midi_song *song, int track)
{
    if (track < song->tracks_count)
        return MIDI_OK;
    uint32_t *ends = realloc(song->end_ticks, ((size_t)track + 1) * sizeof *ends);
    if (!ends)
        return midi_fail(MIDI_NO_MEMORY, "no memory for %d tracks", track + 1);
    memset(ends + song->tracks_count, 0,
           (size_t)(track + 1 - song->tracks_count) * sizeof *ends);
    song->end_ticks = ends;
    song->tracks_count = track + 1;
    return MIDI_OK;
}

enum midi_status midi_song_end(struct midi_song *song, int track, uint32_t tick)
{
    if (track < 0 || track >= (song->format ? SONG_TRACKS_MAX : 1))
        return midi_fail(MIDI_BAD_ARGUMENT, "a song of format %d has no track %d", song->format,
                         track + 1);
    enum midi_status status = track_make(song, track);
    if (status == MIDI_OK && tick > song->end_ticks[track])
        song->end_ticks[track] = tick;
    return status;
}

static enum midi_status bytes_add(struct midi_song *song, const uint8_t *bytes, size_t count)
{
    if (song->bytes_count + count > 4u * SONG_BYTES_MAX)
        return midi_fail(MIDI_NO_MEMORY, "a song has at most %d MiB", 4 * SONG_BYTES_MAX >> 20);
    void *all = song->bytes;
    enum midi_status status = song_room(&all, &song->bytes_room, song->bytes_count + count, 1);
    song->bytes = all;
    if (status == MIDI_OK && count) {
        memcpy(song->bytes + song->bytes_count, bytes, count);
        song->bytes_count += count;
    }
    return status;
}

enum midi_status midi_song_add(struct midi_song *song, const struct midi_song_event *e)
{
    if (!event_good(e))
        return midi_fail(MIDI_BAD_ARGUMENT,
                         "an event's bytes are no message, system exclusive or meta event");
    enum midi_status status = midi_song_end(song, e->track, e->tick);
    void *events = song->events;
    if (status == MIDI_OK)
        status = song_room(&events, &song->events_room, song->events_count + 1,
                           sizeof *song->events);
    song->events = events;
    const size_t offset = song->bytes_count;
    if (status == MIDI_OK)
        status = bytes_add(song, e->bytes, e->count);
    if (status != MIDI_OK)
        return status;
    song->events[song->events_count] = (struct song_event){0,
                                                           e->tick,
                                                           (uint32_t)song->events_count,
                                                           (uint32_t)offset,
                                                           e->count,
                                                           (uint16_t)e->track,
                                                           (uint8_t)e->kind,
                                                           e->meta};
    song->events_count++;
    song->sorted = false;
    song->open_track = -1;
    return MIDI_OK;
}

enum midi_status midi_song_record(struct midi_song *song, int track,
                                  const struct midi_message *m, uint64_t begin_ns)
{
    const enum midi_kind kind = midi_message_kind(m);
    if (kind != MIDI_KIND_CHANNEL && kind != MIDI_KIND_SYSEX)
        return MIDI_OK;
    if (kind == MIDI_KIND_SYSEX && m->bytes[0] != MIDI_SYSEX) {
        /* A continued piece is appended to the bytes of the last event, which are last in
         * memory. */
        if (song->open_track != track)
            return MIDI_OK;
        enum midi_status status = bytes_add(song, m->bytes, m->count);
        if (status == MIDI_OK)
            song->events[song->events_count - 1].count += m->count;
        if (!midi_message_open(m))
            song->open_track = -1;
        return status;
    }
    /* By the default tempo: sorting the events so far to apply tempo events would take ever
     * longer. */
    const struct song_tempo usual = {.tempo_us = MIDI_TEMPO_USUAL_US};
    const uint64_t ns = m->time_ns > begin_ns ? m->time_ns - begin_ns : 0;
    const struct midi_song_event e = {.tick = tick_near(song, &usual, ns),
                                      .track = (uint16_t)track,
                                      .kind = kind == MIDI_KIND_SYSEX ? MIDI_SONG_SYSEX
                                                                      : MIDI_SONG_MESSAGE,
                                      .count = m->count,
                                      .bytes = m->bytes};
    enum midi_status status = midi_song_add(song, &e);
    if (status == MIDI_OK && midi_message_open(m))
        song->open_track = track;
    return status;
}
