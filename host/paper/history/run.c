/* run.c - encodes a whole run as bytes, decodes it, and scales it to another resolution.
 *
 *     "LRUN", version                    4 bytes each; all numbers with their low byte first
 *     description                        sheet_config_encode()
 *     air                                as it is now
 *     now: operation, step               4, 4
 *     names: count, {length, name}       1, {1, length}: of the kinds below
 *     extras: length                     8: brushes and what they hold
 *       sheet_extras_encode()
 *     operations: count                  4
 *       kind, steps, raw, stored         1, 4, 8, 8: lengths of the arguments, before and after
 *                                        deflating
 *       arguments                        stored bytes, event_encode()
 *     notes: count                       4; if something was undone or inserted
 *                                        (history/notes.c)
 *       what, number, digest             1, 8, 8
 */
#include "arguments/forms.h"
#include "drawing.h"
#include "history/history_internal.h"
#include "model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RUN_VERSION = 1, OPERATIONS_MAX = 1 << 24 };
/* The largest arguments are a plane; this is for everything else. */
#define ARGUMENTS_BESIDES (64u << 20)

static const char magic[4] = {'L', 'R', 'U', 'N'};

void history_names_put(struct event_bytes *b)
{
    event_put_number(b, SHEET_EVENT_KINDS, 1);
    for (int i = 0; i < SHEET_EVENT_KINDS; i++) {
        const char *name = sheet_event_name((enum sheet_event_kind)i);
        event_put_number(b, strlen(name), 1);
        event_put_bytes(b, name, strlen(name));
    }
}

void history_operation_put(struct event_bytes *b, const struct event_record *op)
{
    event_put_number(b, (uint64_t)op->kind, 1);
    event_put_number(b, (uint64_t)op->steps, 4);
    event_put_number(b, op->raw, 8);
    event_put_number(b, op->stored, 8);
    event_put_bytes(b, op->bytes, op->stored);
}

enum paper_status paper_history_encode(struct paper_sheet *p, uint8_t **bytes, size_t *count)
{
    const struct sheet_history *h = p->history;
    struct event_bytes b = {0};
    *bytes = NULL;
    *count = 0;
    if (!h || h->inserting_at >= 0)
        return paper_fail(PAPER_BAD_ARGUMENT, h ? "something is being inserted; save later"
                                                : "the sheet has no history to save");
    struct event_bytes extras = {0};
    enum paper_status status = history_no_stroke(p);
    if (status == PAPER_OK)
        status = sheet_ready(p);
    if (status == PAPER_OK)
        status = sheet_extras_encode(p, &extras);
    if (status != PAPER_OK) {
        free(extras.at);
        return status;
    }
    int ops_count = h->log.count;
    event_put_bytes(&b, magic, sizeof magic);
    event_put_number(&b, RUN_VERSION, 4);
    sheet_config_encode(&b, &p->config);
    sheet_air_encode(&b, &p->air);
    event_put_number(&b, (uint64_t)h->now.op, 4);
    event_put_number(&b, (uint64_t)h->now.step, 4);
    history_names_put(&b);
    event_put_number(&b, extras.count, 8);
    event_put_bytes(&b, extras.at, extras.count);
    b.short_of_memory |= extras.short_of_memory;
    free(extras.at);
    event_put_number(&b, (uint64_t)ops_count, 4);
    for (int i = 0; i < ops_count; i++)
        history_operation_put(&b, &h->log.records[i]);
    notes_encode(&b, h);
    if (b.short_of_memory) {
        free(b.at);
        return paper_fail(PAPER_NO_MEMORY, "no memory for a run of %d operations", ops_count);
    }
    *bytes = b.at;
    *count = b.count;
    return PAPER_OK;
}

static enum paper_status run_begin(struct event_reader *r, struct paper_sheet_config *config,
                                   struct paper_air *air)
{
    const uint8_t *word = event_get_bytes(r, sizeof magic);
    uint64_t version = event_get_number(r, 4);
    if (r->bad || memcmp(word, magic, sizeof magic) != 0)
        return paper_fail(PAPER_BAD_FILE, "it holds no run of a sheet");
    if (version != RUN_VERSION)
        return paper_fail(PAPER_BAD_FILE,
                          "its run is of version %llu, and this program knows version %d",
                          (unsigned long long)version, RUN_VERSION);
    enum paper_status status = sheet_config_decode(r, config);
    if (status == PAPER_OK)
        sheet_air_decode(r, air);
    return status;
}

enum paper_status paper_history_describe(const uint8_t *bytes, size_t count,
                                         struct paper_sheet_config *config)
{
    struct event_reader r = {bytes, bytes + count, false};
    struct paper_air air;
    return run_begin(&r, config, &air);
}

bool paper_sheet_config_same(const struct paper_sheet_config *a,
                             const struct paper_sheet_config *b)
{
    struct event_bytes bytes[2] = {{0}, {0}};
    const struct paper_sheet_config *const both[2] = {a, b};
    for (int i = 0; i < 2; i++) { /* parts that imply others always come with these */
        struct paper_sheet_config config = *both[i];
        config.parts = sheet_parts_whole(config.parts);
        sheet_config_encode(&bytes[i], &config);
    }
    bool same = !bytes[0].short_of_memory && bytes[0].count == bytes[1].count &&
                memcmp(bytes[0].at, bytes[1].at, bytes[0].count) == 0;
    free(bytes[0].at);
    free(bytes[1].at);
    return same;
}

static enum paper_status damaged(const char *what)
{
    return paper_fail(PAPER_BAD_FILE, "%s of the run is damaged", what);
}

enum paper_status history_names_get(struct event_reader *r, int kinds[256])
{
    int count = (int)event_get_number(r, 1);
    for (int i = 0; i < 256; i++)
        kinds[i] = -1;
    for (int i = 0; i < count && !r->bad; i++) {
        size_t length = (size_t)event_get_number(r, 1);
        const uint8_t *name = event_get_bytes(r, length);
        if (name)
            kinds[i] = sheet_event_find((const char *)name, length);
    }
    return r->bad ? damaged("the list of names") : PAPER_OK;
}

enum paper_status history_operation_get(struct event_reader *r, const struct paper_sheet *p,
                                        const int kinds[256], struct event_record *op)
{
    uint64_t kind = event_get_number(r, 1), steps = event_get_number(r, 4),
             raw = event_get_number(r, 8), stored = event_get_number(r, 8);
    uint64_t most =
        4 * (uint64_t)p->page.grid.width * (uint64_t)p->page.grid.height + ARGUMENTS_BESIDES;
    if (r->bad)
        return damaged("an operation");
    if (kinds[kind] < 0)
        return paper_fail(PAPER_BAD_FILE,
                          "the run has an operation that this program does not know");
    bool step = kinds[kind] == SHEET_EVENT_STEP;
    if (!event_record_plausible(raw, stored, most) || steps > INT32_MAX / 2 ||
        (step && steps < 1))
        return damaged("an operation");
    const uint8_t *bytes = event_get_bytes(r, (size_t)stored);
    if (!bytes)
        return damaged("an operation");
    *op = (struct event_record){
        .kind = kinds[kind], .steps = (int)steps, .raw = (size_t)raw, .stored = (size_t)stored};
    if (stored == 0)
        return PAPER_OK;
    op->bytes = malloc((size_t)stored);
    if (!op->bytes)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a run's operations");
    memcpy(op->bytes, bytes, (size_t)stored);
    return PAPER_OK;
}

enum paper_status history_operation_check(const struct paper_sheet *p,
                                          const struct event_record *op, unsigned *brushes)
{
    void *arguments;
    enum paper_status status = operation_arguments(&p->config, op, &arguments);
    if (status == PAPER_OK)
        status = sheet_event_check(p, operation_kind(op), arguments);
    int brush = status == PAPER_OK ? history_brush_of(operation_kind(op), arguments) : -1;
    if (op->kind == SHEET_EVENT_BRUSH && brush >= 0)
        *brushes |= 1u << brush;
    if (brush >= 0 && !(*brushes & 1u << brush))
        status = PAPER_BAD_ARGUMENT;
    event_free(sheet_event_kind(operation_kind(op)), arguments);
    return status == PAPER_BAD_ARGUMENT ? damaged("an operation") : status;
}

static enum paper_status operations_read(struct event_reader *r, struct paper_sheet *p,
                                         struct event_reader *extras)
{
    struct sheet_history *h = p->history;
    int kinds[256];
    uint64_t now_op = event_get_number(r, 4), now_step = event_get_number(r, 4);
    enum paper_status status = history_names_get(r, kinds);
    uint64_t extras_count = event_get_number(r, 8);
    extras->at = event_get_bytes(r, (size_t)extras_count);
    extras->end = extras->at ? extras->at + extras_count : NULL;
    uint64_t count = event_get_number(r, 4);
    unsigned brushes = 0;
    if (status == PAPER_OK && (r->bad || count > OPERATIONS_MAX))
        status = damaged("the list of operations");
    for (uint64_t i = 0; i < count && status == PAPER_OK; i++) {
        struct event_record op = {0};
        status = history_operation_get(r, p, kinds, &op);
        if (status == PAPER_OK)
            status = history_append(h, op);
        if (status == PAPER_OK)
            status = history_operation_check(p, &h->log.records[h->log.count - 1], &brushes);
    }
    bool noted = status == PAPER_OK && r->at != r->end;
    if (noted && !notes_decode(r, kinds, &h->notes))
        status = paper_fail(PAPER_NO_MEMORY, "no memory for a run's notes");
    if (status != PAPER_OK)
        return status;
    if (r->bad || r->at != r->end || now_op > count ||
        (now_step > 0 &&
         (now_op == count || now_step >= (uint64_t)h->log.records[now_op].steps)))
        return damaged("the list of operations");
    h->now = (struct position){(int)now_op, (int)now_step};
    if (!noted && !notes_derive(h))
        return paper_fail(PAPER_NO_MEMORY, "no memory for a run's notes");
    return PAPER_OK;
}

enum paper_status paper_history_decode(const uint8_t *bytes, size_t count, bool follow,
                                       double budget_bytes, paper_plane_source source,
                                       void *context, struct paper_sheet **out)
{
    struct event_reader r = {bytes, bytes + count, false};
    struct paper_sheet_config config;
    struct paper_air air;
    struct paper_sheet *p = NULL;
    struct paper_plane planes[PAPER_PLANES_MAX];
    struct event_reader extras = {NULL, NULL, false};
    *out = NULL;
    enum paper_status status = run_begin(&r, &config, &air);
    if (status == PAPER_OK && r.bad)
        status = damaged("the air");
    if (status == PAPER_OK)
        status = sheet_create(&config, &p);
    if (status == PAPER_BAD_ARGUMENT)
        status = damaged("the description of the sheet");
    if (status == PAPER_OK && sheet_event_check(p, SHEET_EVENT_AIR, &air) != PAPER_OK)
        status = damaged("the air");
    if (status == PAPER_OK)
        status = paper_history_begin(p, budget_bytes);
    if (status == PAPER_OK)
        status = operations_read(&r, p, &extras);
    if (status == PAPER_OK)
        status = sheet_extras_check(p, &extras);
    if (status != PAPER_OK)
        goto cleanup;

    struct sheet_history *h = p->history;
    if (follow) { /* the program will repeat everything */
        h->now = (struct position){0, 0};
        status = history_cut(h);
    }
    double state_bytes = 4.0 * config.width * config.height * paper_sheet_planes(p, planes);
    if (status == PAPER_OK && follow && state_bytes <= budget_bytes) {
        status = checkpoint_pin(p, source, context, &air, &extras);
    } else if (status == PAPER_OK) {
        status = planes_load(p, source, context);
        if (status == PAPER_OK)
            status = sheet_extras_decode(p, &extras);
        p->air = air;
        h->at = follow ? (struct position){-1, 0} : h->now;
        h->work = follow ? 0 : history_work(h, h->now);
        h->loaded = follow;
    }
    if (status == PAPER_OK && follow) {
        h->following = true;
        history_followed(h); /* for a run without operations */
    }
cleanup:
    if (status != PAPER_OK)
        history_sheet_destroy(p);
    else
        *out = p;
    return status;
}

/* ---- at another resolution ---- */

static enum paper_status render_operation(struct paper_sheet *to, const struct event_record *op,
                                          const struct paper_sheet_config *from,
                                          const struct event_scaling *scaling)
{
    void *arguments;
    enum paper_status status = operation_arguments(from, op, &arguments);
    if (status == PAPER_OK)
        status = sheet_event_scale(operation_kind(op), arguments, scaling);
    if (status == PAPER_OK)
        status = sheet_event(to, operation_kind(op), arguments);
    event_free(sheet_event_kind(operation_kind(op)), arguments);
    return status;
}

enum paper_status paper_history_render(struct paper_sheet *p, double scale, double pace,
                                       double budget_bytes, struct paper_sheet **out)
{
    struct sheet_history *h = p->history;
    *out = NULL;
    if (!h)
        return paper_fail(PAPER_BAD_ARGUMENT, "the sheet has no history");
    if (!(scale >= 1.0 / 64 && scale <= 64))
        return paper_fail(PAPER_BAD_ARGUMENT, "a scale must be 1/64..64 (got %g)", scale);
    if (!(pace >= 1.0 / 4096 && pace <= 4096))
        return paper_fail(PAPER_BAD_ARGUMENT, "a pace must be 1/4096..4096 (got %g)", pace);
    struct paper_sizes sizes = {p->config.width, p->config.height,
                                (int)lround(p->config.width * scale),
                                (int)lround(p->config.height * scale), paper_drawing_screen};
    struct event_scaling scaling = {scale, pace, &sizes};
    struct paper_sheet_config config = p->config;
    struct paper_sheet *to;
    sheet_config_scale(&config, &scaling);
    enum paper_status status = sheet_create(&config, &to);
    if (status != PAPER_OK)
        return status;
    if (budget_bytes >= 0)
        status = paper_history_begin(to, budget_bytes);
    struct paper_air air = paper_air_default(); /* described for a scale of 1 */
    if (status == PAPER_OK)
        status = sheet_event_scale(SHEET_EVENT_AIR, &air, &scaling);
    if (status == PAPER_OK)
        status = sheet_event(to, SHEET_EVENT_AIR, &air);
    long passed = 0, total = paper_sheet_steps(p);
    for (int i = 0; i < h->log.count && status == PAPER_OK; i++) {
        struct position start = {i, 0};
        if (position_compare(start, h->now) >= 0)
            break;
        if (h->log.records[i].kind != SHEET_EVENT_STEP) {
            status = render_operation(to, &h->log.records[i], &p->config, &scaling);
            passed += h->log.records[i].steps;
            continue;
        }
        passed += i == h->now.op ? h->now.step : h->log.records[i].steps;
        paper_history_mark(to);
        while (status == PAPER_OK && paper_sheet_steps(to) < lround(pace * (double)passed)) {
            status = sheet_event(to, SHEET_EVENT_STEP, NULL);
            if (status == PAPER_OK)
                status = sheet_finish(to);
            if (status == PAPER_OK && h->watch &&
                !h->watch(h->watch_context, paper_sheet_steps(to),
                          lround(pace * (double)total)))
                status = paper_fail(PAPER_MACHINE_FAILED, "stopped");
        }
    }
    if (status != PAPER_OK) {
        history_sheet_destroy(to);
        return status;
    }
    *out = to;
    return PAPER_OK;
}
