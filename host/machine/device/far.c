/* far.c - arrays of other ranks, from rank 0: see far.h. */
#include "device/far.h"

#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "base/parts.h"
#include "ranks/numbers.h"
#include "ranks/ranks.h"

static struct numbers numbers;

enum machine_status device_far_begin(struct machine *m)
{
    return ranks_are_ours()
               ? MACHINE_OK
               : machine_fail(
                     m, MACHINE_DEVICE_FAILED,
                     "this is a child of fork(), which has no ranks, and what is wanted "
                     "is in another rank's memory: fork before the first instruction, "
                     "or exec another program");
}

struct device_buffer *device_far_new(struct machine *m, int rank, size_t bytes)
{
    struct device_buffer *b = device_far_begin(m) ? NULL : calloc(1, sizeof *b);
    if (!b) {
        if (!m->status)
            machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for an array of a rank");
        return NULL;
    }
    b->bytes = bytes;
    b->refs = 1;
    b->rank = rank;
    b->far = numbers_get(&numbers);
    return b;
}

struct device_buffer *device_far_get(struct machine *m, int rank, struct rows rows)
{
    struct device_buffer *b = device_far_new(m, rank, rows.bytes);
    if (b)
        ranks_command(
            rank, (struct ranks_command){RANKS_GET, 0, {b->far, rows.bytes, rows.first}}, NULL);
    return b;
}

void device_far_end(struct device_buffer *b)
{
    ranks_command(b->rank, (struct ranks_command){RANKS_DROP, 0, {b->far}}, NULL);
    numbers_leave(&numbers, b->far);
    free(b);
}

enum machine_status device_far_fill(struct machine *m, const struct device_buffer *b,
                                    const void *pattern, size_t pattern_bytes)
{
    const struct ranks_command c = {
        RANKS_FILL, (uint32_t)pattern_bytes, {b->far, pattern_bytes}};
    if (device_far_begin(m))
        return m->status;
    ranks_command(b->rank, c, pattern);
    return MACHINE_OK;
}

enum machine_status device_far_copy(struct machine *m, const struct device_buffer *from,
                                    const struct device_buffer *to, size_t bytes)
{
    INVARIANT(from->rank == to->rank);
    if (device_far_begin(m))
        return m->status;
    ranks_command(from->rank,
                  (struct ranks_command){RANKS_COPY, 0, {from->far, to->far, bytes}}, NULL);
    return MACHINE_OK;
}

/* ---- rows ---- */

static struct ranks_command rows_command(enum ranks_command_of what,
                                         const struct device_buffer *b, struct far_rows rows)
{
    return (struct ranks_command){
        what, 0, {b->far, rows.at, rows.bytes, rows.pitch, rows.rows}};
}

/* Rows between two arrays that have them at other distances. */
static void rows_copy(char *to, size_t to_pitch, const char *from, size_t from_pitch,
                      struct far_rows rows)
{
    for (uint64_t i = 0; i < rows.rows; i++)
        memcpy(to + i * to_pitch, from + i * from_pitch, rows.bytes);
}

enum machine_status device_far_read(struct machine *m, const struct device_buffer *b,
                                    struct far_rows rows, void *out, size_t out_pitch)
{
    const size_t all = rows.bytes * rows.rows;
    const bool dense = out_pitch == rows.bytes || rows.rows == 1;
    if (device_far_begin(m) || !all)
        return m->status;
    void *to = dense ? out : malloc(all);
    if (!to)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to read a block");
    ranks_command(b->rank, rows_command(RANKS_READ, b, rows), NULL);
    ranks_flush();
    ranks_reply_take(b->rank, to, all);
    if (!dense) {
        rows_copy(out, out_pitch, to, rows.bytes, rows);
        free(to);
    }
    return MACHINE_OK;
}

enum machine_status device_far_write(struct machine *m, const struct device_buffer *b,
                                     struct far_rows rows, const void *in, size_t in_pitch)
{
    const size_t all = rows.bytes * rows.rows;
    const bool dense = in_pitch == rows.bytes || rows.rows == 1;
    if (device_far_begin(m) || !all)
        return m->status;
    void *from = dense ? NULL : malloc(all);
    if (!dense && !from)
        return machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to write a block");
    if (!dense)
        rows_copy(from, rows.bytes, in, in_pitch, rows);
    ranks_command(b->rank, rows_command(RANKS_WRITE, b, rows), NULL);
    ranks_data(b->rank, dense ? in : from, all);
    free(from);
    return MACHINE_OK;
}
