/* served.c - a rank above 0 performs commands: see ranks/ranks.h.
 *
 * It has a machine without fields and graph, whose VP sets are blocks. Nothing that rank 0
 * sends can be wrong but for a mistake of ours; then the process ends with a line. */
#include "served.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <visible_text.h>

#include "base/errors.h"
#include "device/far.h"
#include "machine.h"
#include "ops/all_to_all_far.h"
#include "ops/scan.h"
#include "ops/sums_far.h"
#include "plans/far.h"
#include "ranks/ranks.h"

/* The one machine. */
static struct {
    struct machine *m;
    struct far_table arrays;
    struct far_portion **portions;
    uint64_t portions_count;
} the;

_Noreturn static void fail(const struct ranks_command *c)
{
    const char *why = the.m && the.m->status ? machine_error(the.m) : "it makes no sense";
    visible_say("rank %d of %d cannot perform command %u: %s", ranks_mine(), ranks_count(),
                c->what, why);
    _exit(1);
}

static struct device_buffer *array_of(const struct ranks_command *c, int at)
{
    struct device_buffer *b = far_table_of(&the.arrays, c->of[at]);
    if (!b)
        fail(c);
    return b;
}

/* ---- the machine ---- */

static void make(const struct ranks_command *c, const void *payload)
{
    char device[256] = "";
    struct machine_config config = machine_config_default();
    struct served_made made;
    memset(&made, 0, sizeof made);
    memcpy(device, payload, c->payload < sizeof device ? c->payload : sizeof device - 1);
    config.device = *device ? device : NULL;
    config.processors_count = (int)c->of[0];
    made.status = machine_create(&config, &the.m);
    if (made.status) {
        snprintf(made.error, sizeof made.error, "%s",
                 the.m ? machine_error(the.m) : "not enough memory");
        machine_destroy(the.m);
        the.m = NULL;
    } else {
        snprintf(made.device, sizeof made.device, "%s", the.m->device->name);
        made.memory_bytes = the.m->device->memory_bytes;
        made.near = the.m->settings.near && the.m->device->is_pocl;
    }
    ranks_reply(&made, sizeof made);
}

static void forget(uint64_t portion)
{
    if (portion >= the.portions_count)
        return;
    portion_far_free(the.portions[portion]);
    the.portions[portion] = NULL;
}

static void destroy(void)
{
    if (!the.m)
        return;
    for (uint64_t i = 0; i < the.portions_count; i++)
        forget(i);
    free(the.portions);
    the.portions = NULL;
    the.portions_count = 0;
    far_table_empty(the.m, &the.arrays);
    for (int i = 1; i < the.m->values->sets_count; i++)
        the.m->values->sets[i].used = false; /* it has no fields and flags here */
    machine_destroy(the.m);
    the.m = NULL;
}

static void set_take(const struct ranks_command *c, const void *payload)
{
    struct values *v = the.m->values;
    const uint64_t set = c->of[0];
    if (c->payload != sizeof *v->sets || set > UINT16_MAX)
        fail(c);
    if ((int)set >= v->sets_count) {
        v->sets = realloc(v->sets, (set + 1) * sizeof *v->sets);
        NEEDS_MEMORY(v->sets);
        memset(v->sets + v->sets_count, 0,
               (set + 1 - (uint64_t)v->sets_count) * sizeof *v->sets);
        v->sets_count = (int)set + 1;
    }
    memcpy(&v->sets[set], payload, sizeof *v->sets);
}

/* ---- arrays ---- */

/* From the first byte of the rows to their last. */
static size_t span_of(const struct ranks_command *c)
{
    return c->of[4] ? (c->of[4] - 1) * c->of[3] + c->of[2] : 0;
}

static void rows_check(const struct ranks_command *c, const struct device_buffer *b)
{
    if (c->of[1] > b->bytes || span_of(c) > b->bytes - c->of[1] || !c->of[4] ||
        (c->of[4] > 1 && c->of[3] < c->of[2]))
        fail(c);
}

static void rows_read(const struct ranks_command *c)
{
    const struct device_buffer *b = array_of(c, 0);
    const size_t bytes = c->of[2], pitch = c->of[3];
    rows_check(c, b);
    char *all = malloc(span_of(c));
    NEEDS_MEMORY(all);
    if (device_read(the.m, b, c->of[1], all, span_of(c), "reading a block"))
        fail(c);
    for (uint64_t i = 1; i < c->of[4]; i++)
        memmove(all + i * bytes, all + i * pitch, bytes);
    ranks_reply(all, bytes * c->of[4]);
    free(all);
}

static void rows_write(const struct ranks_command *c)
{
    const struct device_buffer *b = array_of(c, 0);
    const size_t bytes = c->of[2], pitch = c->of[3], all = bytes * c->of[4];
    rows_check(c, b);
    char *rows = malloc(all);
    NEEDS_MEMORY(rows);
    ranks_data_take(rows, all);
    for (uint64_t i = 0; i < c->of[4]; i++)
        if (device_write(the.m, b, c->of[1] + i * pitch, rows + i * bytes, bytes,
                         "writing a block"))
            fail(c);
    free(rows);
}

static void array_command(const struct ranks_command *c, const void *payload)
{
    struct machine *m = the.m;
    struct device_buffer *b;
    enum machine_status status = MACHINE_OK;
    if (c->what == RANKS_GET) {
        b = device_rows_get(m, (struct rows){c->of[1], c->of[2]});
        if (!b)
            fail(c);
        far_table_put(&the.arrays, c->of[0], b);
    } else if (c->what == RANKS_DROP) {
        far_table_drop(m, &the.arrays, c->of[0]);
    } else if (c->what == RANKS_FILL) {
        status = device_fill(m, array_of(c, 0), payload, c->of[1], "filling a field");
    } else if (c->what == RANKS_COPY) {
        status = device_copy(m, array_of(c, 0), array_of(c, 1), c->of[2], "copying a field");
    } else if (c->what == RANKS_READ) {
        rows_read(c);
    } else {
        rows_write(c);
    }
    if (status)
        fail(c);
}

/* ---- plans ---- */

static void plan_take(const struct ranks_command *c, const void *payload)
{
    const uint64_t at = c->of[0];
    struct far_portion *p = portion_far_make(the.m, payload, c->payload);
    if (!p || at > UINT32_MAX)
        fail(c);
    if (at >= the.portions_count) {
        const uint64_t count = 2 * at + 16;
        the.portions = realloc(the.portions, count * sizeof *the.portions);
        NEEDS_MEMORY(the.portions);
        memset(the.portions + the.portions_count, 0,
               (count - the.portions_count) * sizeof *the.portions);
        the.portions_count = count;
    }
    the.portions[at] = p;
}

static void plan_command(const struct ranks_command *c, const void *payload)
{
    struct far_portion *p = c->of[0] < the.portions_count ? the.portions[c->of[0]] : NULL;
    if (!p)
        fail(c);
    if (c->what == RANKS_PREPARE) {
        portion_far_prepare(p, (enum plan_use)c->of[1]);
        return;
    }
    uint64_t few[64], *words = c->payload <= sizeof few ? few : malloc(c->payload);
    NEEDS_MEMORY(words);
    memcpy(words, payload, c->payload);
    if (!portion_far_run(the.m, p, &the.arrays, words, c->payload / sizeof *words))
        fail(c);
    if (words != few)
        free(words);
    if (plans_are_many(the.m))
        plans_forget_oldest(the.m);
}

/* ---- whole instructions ---- */

/* Work of lines of this block. */
static void each(const struct ranks_command *c, const void *payload)
{
    struct each_head head;
    struct device_buffer *in[SEQUENCERS_ARRAYS];
    const struct values *v = the.m->values;
    if (c->payload < sizeof head || c->of[1] < 1 || c->of[1] >= (uint64_t)v->sets_count)
        fail(c);
    memcpy(&head, payload, sizeof head);
    for (int i = 0; i < SEQUENCERS_ARRAYS; i++) {
        in[i] = head.in[i] ? far_table_of(&the.arrays, head.in[i]) : NULL;
        if (head.in[i] && !in[i])
            fail(c);
    }
    const enum lines_kind kind = (enum lines_kind)c->of[0];
    const struct vpset *s = &v->sets[c->of[1]];
    const unsigned char *of = (const unsigned char *)payload + sizeof head;
    const size_t count = c->payload - sizeof head;
    struct device_buffer *out = kind == LINES_RANKS ? rank_told(the.m, s, in, of, count)
                                                    : scan_told(the.m, s, in, kind, of, count);
    if (!out)
        fail(c);
    device_flush(the.m);
    far_table_put(&the.arrays, c->of[2], out);
}

/* ---- all ---- */

static void perform(const struct ranks_command *c, const void *payload)
{
    const bool moves = c->what == RANKS_OUT || c->what == RANKS_IN;
    if (c->what != RANKS_CREATE && !the.m)
        fail(c);
    if (!moves && the.m && device_moves_end(the.m))
        fail(c);
    if (c->what == RANKS_CREATE)
        make(c, payload);
    else if (c->what == RANKS_DESTROY)
        destroy();
    else if (c->what == RANKS_SET)
        set_take(c, payload);
    else if (c->what >= RANKS_GET && c->what <= RANKS_WRITE)
        array_command(c, payload);
    else if (moves) {
        const struct device_buffer *b = array_of(c, 0);
        if (c->of[1] > b->bytes || c->of[2] > b->bytes - c->of[1] ||
            (c->what == RANKS_OUT ? device_move_out : device_move_in)(the.m, b, c->of[1],
                                                                      c->of[2], (int)c->of[3]))
            fail(c);
    } else if (c->what == RANKS_PLAN)
        plan_take(c, payload);
    else if (c->what == RANKS_PREPARE || c->what == RANKS_RUN)
        plan_command(c, payload);
    else if (c->what == RANKS_REDUCE) {
        if (!sums_far_answer(the.m, &the.arrays, payload, c->payload))
            fail(c);
    } else if (c->what == RANKS_ROUTE) {
        if (!all_to_all_told(the.m, &the.arrays, payload, c->payload))
            fail(c);
    } else if (c->what == RANKS_EACH)
        each(c, payload);
    else if (c->what == RANKS_FORGET)
        forget(c->of[0]);
    else
        fail(c);
}

void served_perform(void)
{
    const void *payload;
    const struct ranks_command *c;
    while ((c = ranks_next(&payload))->what != RANKS_END)
        perform(c, payload);
    faults_are_over();
    if (the.m && !device_moves_end(the.m))
        machine_leave(the.m);
}
