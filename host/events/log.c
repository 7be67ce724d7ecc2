/* log.c - see log.h. */
#include "log.h"

#include <array.h>

#include <stdlib.h>
#include <string.h>

#include <zlib.h>

enum { DEFLATE_FROM = 256, DEFLATE_RATIO_MAX = 1032 /* zlib's */ };

static double record_bytes(const struct event_record *record)
{
    return (double)(record->stored + sizeof *record);
}

/* ---- records ---- */

static void record_deflate(struct event_record *record)
{
    uLongf room = compressBound((uLong)record->raw);
    uint8_t *packed = malloc(room);
    if (packed && compress2(packed, &room, record->bytes, (uLong)record->raw, 1) == Z_OK &&
        room < record->raw - record->raw / 8) {
        uint8_t *fitted = realloc(packed, room);
        free(record->bytes);
        record->bytes = fitted ? fitted : packed;
        record->stored = room;
        packed = NULL;
    }
    free(packed);
}

bool event_record_make(struct event_record *record, int number, const struct event_kind *kind,
                       const void *arguments, const void *context)
{
    struct event_bytes b = {0};
    *record = (struct event_record){.kind = number};
    event_encode(&b, kind, arguments, context);
    if (b.short_of_memory) {
        free(b.at);
        return false;
    }
    uint8_t *fitted = b.count ? realloc(b.at, b.count) : b.at;
    record->bytes = fitted ? fitted : b.at;
    record->raw = record->stored = b.count;
    record->digest = event_digest(record->bytes, record->raw);
    if (record->raw >= DEFLATE_FROM)
        record_deflate(record);
    return true;
}

void event_record_free(struct event_record *record)
{
    free(record->bytes);
    record->bytes = NULL;
}

/* Returns the arguments' bytes: the record's own, or, inflated, *made, which the caller
 * frees. NULL: damaged, or no memory. */
static const uint8_t *raw_bytes(const struct event_record *record, uint8_t **made)
{
    *made = NULL;
    if (record->stored == record->raw)
        return record->bytes;
    uLongf count = (uLongf)record->raw;
    *made = malloc(record->raw);
    if (*made && uncompress(*made, &count, record->bytes, (uLong)record->stored) == Z_OK &&
        count == record->raw)
        return *made;
    free(*made);
    *made = NULL;
    return NULL;
}

uint64_t event_record_digest(const struct event_record *record)
{
    uint8_t *made = NULL;
    const uint8_t *bytes = record->raw ? raw_bytes(record, &made) : NULL;
    uint64_t digest = event_digest(bytes, bytes ? record->raw : 0);
    free(made);
    return digest;
}

enum event_decoded event_record_arguments(const struct event_record *record,
                                          const struct event_kind *kind, const void *context,
                                          void **arguments)
{
    uint8_t *made = NULL;
    *arguments = NULL;
    const uint8_t *bytes = record->raw ? raw_bytes(record, &made) : NULL;
    if (record->raw && !bytes)
        return EVENT_DAMAGED;
    enum event_decoded decoded = event_decode(bytes, record->raw, kind, context, arguments);
    free(made);
    return decoded;
}

bool event_record_plausible(uint64_t raw, uint64_t stored, uint64_t most)
{
    return stored <= raw && raw <= most && raw <= stored * DEFLATE_RATIO_MAX + 64;
}

/* ---- the list ---- */

static bool room_make(struct event_log *log)
{
    return array_reserve(&log->records, &log->room, log->count + 1, sizeof *log->records);
}

bool event_log_append(struct event_log *log, struct event_record record)
{
    if (!room_make(log)) {
        event_record_free(&record);
        return false;
    }
    log->records[log->count++] = record;
    log->bytes += record_bytes(&record);
    return true;
}

bool event_log_split(struct event_log *log, int at, int steps)
{
    if (!room_make(log))
        return false;
    struct event_record *record = &log->records[at];
    memmove(record + 1, record, (size_t)(log->count - at) * sizeof *record);
    log->count++;
    record[0].steps = steps;
    record[1].steps -= steps;
    record[1].bytes = NULL;
    record[1].raw = record[1].stored = 0;
    log->bytes += record_bytes(&record[1]);
    return true;
}

void event_log_remove(struct event_log *log, int at, int count)
{
    for (int i = at; i < at + count; i++) {
        log->bytes -= record_bytes(&log->records[i]);
        event_record_free(&log->records[i]);
    }
    log->count -= count;
    memmove(log->records + at, log->records + at + count,
            (size_t)(log->count - at) * sizeof *log->records);
}

void event_log_cut(struct event_log *log, int count)
{
    if (log->count > count)
        event_log_remove(log, count, log->count - count);
}

void event_log_join(struct event_log *log, int at)
{
    log->records[at - 1].steps += log->records[at].steps;
    event_log_remove(log, at, 1);
}

bool event_log_take_away(struct event_log *log, int count, struct event_record **out,
                         int *out_count)
{
    *out_count = log->count - count;
    *out = malloc((size_t)(*out_count ? *out_count : 1) * sizeof **out);
    if (!*out)
        return false;
    for (int i = 0; i < *out_count; i++)
        (*out)[i] = log->records[count + i];
    log->count = count;
    return true;
}

bool event_log_put_back(struct event_log *log, struct event_record *records, int count)
{
    bool memory = true;
    for (int i = 0; i < count; i++) {
        log->bytes -= record_bytes(&records[i]);
        if (memory)
            memory = event_log_append(log, records[i]);
        else
            event_record_free(&records[i]);
    }
    free(records);
    return memory;
}

void event_log_free(struct event_log *log)
{
    event_log_cut(log, 0);
    free(log->records);
    *log = (struct event_log){0};
}
