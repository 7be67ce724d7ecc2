/* list.c - the list of operations itself. Arguments are deflated where that saves much: masks are mostly empty. */
#include "history/history_internal.h"
#include "model/model.h"

#include <stdlib.h>
#include <string.h>

#include <zlib.h>

enum { DEFLATE_FROM = 256 };

static void operation_deflate(struct operation *op)
{
    uLongf room = compressBound((uLong)op->raw);
    uint8_t *packed = malloc(room);
    if (packed && compress2(packed, &room, op->bytes, (uLong)op->raw, 1) == Z_OK &&
        room < op->raw - op->raw / 8) {
        uint8_t *fitted = realloc(packed, room);
        free(op->bytes);
        op->bytes = fitted ? fitted : packed;
        op->stored = room;
        packed = NULL;
    }
    free(packed);
}

uint64_t operation_bytes_digest(const uint8_t *bytes, size_t count)
{
    uint64_t digest = UINT64_C(0xcbf29ce484222325) ^ count, word;
    for (size_t at = 0; at < count; at += sizeof word) {
        size_t left = count - at;
        word = 0;
        memcpy(&word, bytes + at, left < sizeof word ? left : sizeof word);
        digest = (digest ^ word) * UINT64_C(0x9e3779b97f4a7c15);
        digest ^= digest >> 29;
    }
    return digest;
}

enum paper_status operation_make(const struct paper_sheet *p, enum sheet_event_kind kind,
                                 const void *arguments, struct operation *op)
{
    struct event_bytes b = {0};
    *op = (struct operation){.kind = kind, .steps = kind == SHEET_EVENT_STEP};
    event_encode(&b, &p->config, kind, arguments);
    if (b.short_of_memory) {
        free(b.at);
        return paper_fail(PAPER_NO_MEMORY, "no memory to record an operation (%s)",
                          event_name(kind));
    }
    uint8_t *fitted = b.count ? realloc(b.at, b.count) : b.at;
    op->bytes = fitted ? fitted : b.at;
    op->raw = op->stored = b.count;
    op->digest = operation_bytes_digest(op->bytes, op->raw);
    if (op->raw >= DEFLATE_FROM)
        operation_deflate(op);
    return PAPER_OK;
}

void operation_free(struct operation *op)
{
    free(op->bytes);
    op->bytes = NULL;
}

/* The arguments as they were before deflating; the operation's own, or *made, which the caller frees. NULL: damaged, or no memory. */
static const uint8_t *operation_bytes(const struct operation *op, uint8_t **made)
{
    *made = NULL;
    if (op->stored == op->raw)
        return op->bytes;
    uLongf count = (uLongf)op->raw;
    *made = malloc(op->raw);
    if (*made && uncompress(*made, &count, op->bytes, (uLong)op->stored) == Z_OK &&
        count == op->raw)
        return *made;
    free(*made);
    *made = NULL;
    return NULL;
}

uint64_t operation_digest(const struct operation *op)
{
    uint8_t *made = NULL;
    const uint8_t *bytes = op->raw ? operation_bytes(op, &made) : NULL;
    uint64_t digest = operation_bytes_digest(bytes, bytes ? op->raw : 0);
    free(made);
    return digest;
}

enum paper_status operation_arguments(const struct paper_sheet_config *config,
                                      const struct operation *op, void **arguments)
{
    uint8_t *made;
    *arguments = NULL;
    if (op->raw == 0)
        return event_decode(NULL, 0, config, op->kind, arguments);
    const uint8_t *bytes = operation_bytes(op, &made);
    if (!bytes)
        return paper_fail(PAPER_BAD_FILE, "an event (%s) is damaged", event_name(op->kind));
    enum paper_status status = event_decode(bytes, op->raw, config, op->kind, arguments);
    free(made);
    return status;
}

static bool room_make(struct sheet_history *h)
{
    if (h->count < h->room)
        return true;
    int room = h->room ? 2 * h->room : 64;
    struct operation *grown = realloc(h->ops, (size_t)room * sizeof *grown);
    if (!grown)
        return false;
    h->ops = grown;
    h->room = room;
    return true;
}

static enum paper_status no_memory(void)
{
    return paper_fail(PAPER_NO_MEMORY, "no memory for the history of a sheet");
}

enum paper_status history_append(struct sheet_history *h, struct operation op)
{
    if (!room_make(h)) {
        operation_free(&op);
        return no_memory();
    }
    h->ops[h->count++] = op;
    h->ops_bytes += (double)(op.stored + sizeof op);
    return PAPER_OK;
}

enum paper_status history_split(struct sheet_history *h, struct position at)
{
    if (at.step == 0)
        return PAPER_OK;
    if (!room_make(h))
        return no_memory();
    memmove(&h->ops[at.op + 1], &h->ops[at.op], (size_t)(h->count - at.op) * sizeof *h->ops);
    h->count++;
    h->ops_bytes += sizeof *h->ops;
    h->ops[at.op].steps = at.step;
    h->ops[at.op + 1].steps -= at.step;
    /* places from there on have other numbers */
    struct position *places[CHECKPOINTS_MAX + 2] = {&h->now, &h->at};
    int count = 2;
    for (int i = 0; i < h->points_count; i++)
        places[count++] = &h->points[i].position;
    for (int i = 0; i < count; i++) {
        if (position_compare(*places[i], at) < 0)
            continue;
        if (places[i]->op == at.op)
            places[i]->step -= at.step;
        places[i]->op++;
    }
    return PAPER_OK;
}

enum paper_status history_cut(struct sheet_history *h)
{
    enum paper_status status = history_split(h, h->now);
    if (status != PAPER_OK)
        return status;
    if (h->count == h->now.op)
        return PAPER_OK;
    while (h->count > h->now.op) {
        h->count--;
        h->ops_bytes -= (double)(h->ops[h->count].stored + sizeof *h->ops);
        operation_free(&h->ops[h->count]);
    }
    h->open = false;
    checkpoints_drop_after(h, h->now);
    if (position_compare(h->at, h->now) > 0)
        h->at.op = -1;
    return PAPER_OK;
}
