/* operations.c - single operations of a history, for others: their arguments, and as bytes that
 * can be done again.
 *
 *     name: length, bytes                1; of the kind
 *     operation                          history_operation_put()
 */
#include "history/history_internal.h"
#include "model/model.h"

#include <stdlib.h>
#include <string.h>

static enum paper_status record_find(const struct paper_sheet *p, int number,
                                     const struct event_record **op)
{
    const struct sheet_history *h = p->history;
    if (!h || number < 0 || number >= h->log.count)
        return paper_fail(PAPER_BAD_ARGUMENT, "there is no operation %d in the history",
                          number);
    *op = &h->log.records[number];
    return PAPER_OK;
}

enum paper_status paper_history_arguments(const struct paper_sheet *p, int number,
                                          void **arguments)
{
    const struct event_record *op = NULL;
    *arguments = NULL;
    const enum paper_status status = record_find(p, number, &op);
    return status == PAPER_OK ? operation_arguments(&p->config, op, arguments) : status;
}

void paper_history_arguments_free(const char *what, void *arguments)
{
    const int kind = sheet_event_find(what, strlen(what));
    if (kind >= 0)
        event_free(sheet_event_kind((enum sheet_event_kind)kind), arguments);
}

enum paper_status paper_history_operation(const struct paper_sheet *p, int number,
                                          uint8_t **bytes, size_t *count)
{
    const struct event_record *op = NULL;
    struct event_bytes b = {0};
    *bytes = NULL;
    *count = 0;
    const enum paper_status status = record_find(p, number, &op);
    if (status != PAPER_OK)
        return status;
    const char *name = sheet_event_name(operation_kind(op));
    event_put_number(&b, strlen(name), 1);
    event_put_bytes(&b, name, strlen(name));
    history_operation_put(&b, op);
    if (b.short_of_memory) {
        free(b.at);
        return paper_fail(PAPER_NO_MEMORY, "no memory for an operation (%s)", name);
    }
    *bytes = b.at;
    *count = b.count;
    return PAPER_OK;
}

enum paper_status paper_sheet_again(struct paper_sheet *p, const uint8_t *bytes, size_t count)
{
    struct event_reader r = {bytes, bytes + count, false};
    const size_t length = (size_t)event_get_number(&r, 1);
    const char *name = (const char *)event_get_bytes(&r, length);
    const int kind = name ? sheet_event_find(name, length) : -1;
    struct event_record op = {0};
    int kinds[256];
    for (int i = 0; i < 256; i++)
        kinds[i] = kind;
    if (kind < 0)
        return paper_fail(PAPER_BAD_FILE, "these are no bytes of an operation");
    enum paper_status status = history_operation_get(&r, p, kinds, &op);
    void *arguments = NULL;
    if (status == PAPER_OK && r.at != r.end)
        status = paper_fail(PAPER_BAD_FILE, "an operation's bytes are damaged");
    if (status == PAPER_OK)
        status = operation_arguments(&p->config, &op, &arguments);
    if (status == PAPER_OK)
        status = sheet_event(p, (enum sheet_event_kind)kind, arguments);
    event_free(sheet_event_kind((enum sheet_event_kind)kind), arguments);
    event_record_free(&op);
    return status;
}
