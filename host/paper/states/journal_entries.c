/* journal_entries.c - see journal_entries.h. */
#include "states/journal_entries.h"

#include <stdlib.h>
#include <string.h>

static const char magic[4] = {'L', 'J', 'R', 'N'};

enum { OPERATION = 0, JOINED = 1 };

void journal_head_put(struct event_bytes *b, const struct journal_head *head)
{
    struct event_bytes config = {0};
    sheet_config_encode(&config, &head->config);
    event_put_bytes(b, magic, sizeof magic);
    event_put_number(b, JOURNAL_VERSION, 4);
    event_put_bytes(b, head->digest, sizeof head->digest);
    event_put_number(b, config.count, 8);
    event_put_bytes(b, config.at, config.count);
    history_names_put(b);
    b->short_of_memory |= config.short_of_memory;
    free(config.at);
    if (!b->short_of_memory)
        event_put_number(b, event_digest(b->at, b->count), 8);
}

static enum paper_status damaged(void)
{
    return paper_fail(PAPER_BAD_FILE, "the journal's beginning is damaged");
}

enum paper_status journal_head_get(struct event_reader *r, struct journal_head *head)
{
    const uint8_t *first = r->at, *word = event_get_bytes(r, sizeof magic);
    const uint64_t version = event_get_number(r, 4);
    const uint8_t *digest = event_get_bytes(r, JOURNAL_DIGEST);
    const uint64_t length = event_get_number(r, 8);
    const uint8_t *config = length <= SIZE_MAX ? event_get_bytes(r, (size_t)length) : NULL;
    if (r->bad || !config || memcmp(word, magic, sizeof magic) != 0)
        return word && memcmp(word, magic, sizeof magic) == 0
                   ? damaged()
                   : paper_fail(PAPER_BAD_FILE, "it is no journal of a sheet");
    if (version != JOURNAL_VERSION)
        return paper_fail(PAPER_BAD_FILE,
                          "the journal is of version %llu, and this program knows version %d",
                          (unsigned long long)version, JOURNAL_VERSION);
    struct event_reader inner = {config, config + length, false};
    enum paper_status status = history_names_get(r, head->kinds);
    if (status != PAPER_OK)
        return status;
    const uint64_t sum = event_digest(first, (size_t)(r->at - first));
    if (event_get_number(r, 8) != sum || r->bad)
        return damaged();
    memcpy(head->digest, digest, JOURNAL_DIGEST);
    status = sheet_config_decode(&inner, &head->config);
    return status == PAPER_OK && inner.at != inner.end ? damaged() : status;
}

void journal_entry_put(struct event_bytes *b, uint64_t number, const struct event_record *op,
                       bool joined, int move, long move_number)
{
    struct event_bytes content = {0};
    event_put_number(&content, number, 8);
    event_put_number(&content, (uint64_t)(op ? joined ? JOINED : OPERATION : move), 1);
    if (op)
        history_operation_put(&content, op);
    else
        event_put_number(&content, (uint64_t)move_number, 8);
    b->short_of_memory |= content.short_of_memory || content.count > UINT32_MAX;
    if (!b->short_of_memory) {
        event_put_number(b, content.count, 4);
        event_put_number(b, event_digest(content.at, content.count), 8);
        event_put_bytes(b, content.at, content.count);
    }
    free(content.at);
}

static enum paper_status content_do(struct event_reader *r, const struct journal_head *head,
                                    struct paper_sheet *p)
{
    const int what = (int)event_get_number(r, 1);
    if (what != OPERATION && what != JOINED) {
        const int64_t number = (int64_t)event_get_number(r, 8);
        if (r->bad || r->at != r->end || number < 0 || number > INT32_MAX)
            return paper_fail(PAPER_BAD_FILE, "an entry is damaged");
        return history_remake(p, what, (long)number);
    }
    struct event_record op = {0};
    enum paper_status status = history_operation_get(r, p, head->kinds, &op);
    if (status == PAPER_OK && r->at == r->end)
        return history_retell(p, op, what == JOINED);
    event_record_free(&op);
    return status == PAPER_OK ? paper_fail(PAPER_BAD_FILE, "an entry is damaged") : status;
}

enum paper_status journal_entry_do(struct event_reader *r, uint64_t number,
                                   const struct journal_head *head, struct paper_sheet *p)
{
    const struct event_reader before = *r;
    const uint64_t length = event_get_number(r, 4), sum = event_get_number(r, 8);
    const uint8_t *content = event_get_bytes(r, (size_t)length);
    struct event_reader inner = {content, content ? content + length : NULL, false};
    enum paper_status status = PAPER_OK;
    if (!content)
        status = paper_fail(PAPER_BAD_FILE, "its last entry is cut off");
    else if (event_digest(content, (size_t)length) != sum ||
             event_get_number(&inner, 8) != number || inner.bad)
        status = paper_fail(PAPER_BAD_FILE, "an entry is damaged");
    if (status == PAPER_OK)
        status = content_do(&inner, head, p);
    if (status != PAPER_OK)
        *r = before;
    return status;
}
