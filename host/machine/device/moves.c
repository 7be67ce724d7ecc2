/* moves.c - bytes of arrays between ranks, and rows of arrays: see far.h.
 *
 * The library reads and writes memory that the front end sees where it is. Other devices' goes
 * by a copy. */
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/errors.h"
#include "base/parts.h"
#include "device/far.h"
#include "ranks/mpi.h"
#include "ranks/ranks.h"

enum { MESSAGE_MOST = 1 << 30 };

/* On its way. */
struct move {
    struct mpi_request request;
    const struct device_buffer *to; /* what comes is written there at the end; NULL: it is */
    size_t at, bytes;
    void *copy; /* NULL: none */
};

static struct {
    struct move *all;
    int count, capacity;
} moves;

static struct move *move_add(void)
{
    if (moves.count == moves.capacity)
        moves.all = array_grown(moves.all, &moves.capacity, sizeof *moves.all);
    moves.all[moves.count] = (struct move){.to = NULL};
    return &moves.all[moves.count++];
}

static bool in_place(const struct machine *m, const struct device_buffer *b)
{
    return b->host && m->settings.near;
}

/* One message's. */
static enum machine_status part_out(struct machine *m, const struct device_buffer *b, size_t at,
                                    size_t bytes, int rank)
{
    const void *from = in_place(m, b) ? (const char *)b->host + at : NULL;
    struct move *it = move_add();
    enum machine_status status = MACHINE_OK;
    if (!from) {
        it->copy = malloc(bytes);
        NEEDS_MEMORY(it->copy);
        status = device_read(m, b, at, it->copy, bytes, "reading a block");
        if (status)
            memset(it->copy, 0, bytes); /* the other rank waits for something */
        from = it->copy;
    }
    mpi_send(rank, MPI_TAG_PLANES, from, bytes, &it->request);
    return status;
}

static enum machine_status part_in(struct machine *m, const struct device_buffer *b, size_t at,
                                   size_t bytes, int rank)
{
    void *to = in_place(m, b) ? (char *)b->host + at : NULL;
    struct move *it = move_add();
    if (!to) {
        *it = (struct move){.to = b, .at = at, .bytes = bytes, .copy = malloc(bytes)};
        NEEDS_MEMORY(it->copy);
        to = it->copy;
    }
    mpi_take(rank, MPI_TAG_PLANES, to, bytes, &it->request);
    return MACHINE_OK;
}

typedef enum machine_status part_move(struct machine *m, const struct device_buffer *b,
                                      size_t at, size_t bytes, int rank);

static enum machine_status parts_move(struct machine *m, const struct device_buffer *b,
                                      size_t at, size_t bytes, int rank, part_move *part)
{
    enum machine_status status = device_settle(m);
    for (size_t done = 0, some; done < bytes; done += some) {
        some = bytes - done < MESSAGE_MOST ? bytes - done : MESSAGE_MOST;
        const enum machine_status of_part = part(m, b, at + done, some, rank);
        status = status ? status : of_part;
    }
    return status;
}

enum machine_status device_move_out(struct machine *m, const struct device_buffer *b, size_t at,
                                    size_t bytes, int rank)
{
    return parts_move(m, b, at, bytes, rank, part_out);
}

enum machine_status device_move_in(struct machine *m, const struct device_buffer *b, size_t at,
                                   size_t bytes, int rank)
{
    return parts_move(m, b, at, bytes, rank, part_in);
}

enum machine_status device_move_far(struct machine *m, const struct device_buffer *from,
                                    size_t from_at, const struct device_buffer *to,
                                    size_t to_at, size_t bytes)
{
    if (device_far_begin(m))
        return m->status;
    if (from->rank)
        ranks_command(from->rank,
                      (struct ranks_command){
                          RANKS_OUT, 0, {from->far, from_at, bytes, (uint64_t)to->rank}},
                      NULL);
    if (to->rank)
        ranks_command(
            to->rank,
            (struct ranks_command){RANKS_IN, 0, {to->far, to_at, bytes, (uint64_t)from->rank}},
            NULL);
    return !from->rank ? device_move_out(m, from, from_at, bytes, to->rank)
           : !to->rank ? device_move_in(m, to, to_at, bytes, from->rank)
                       : MACHINE_OK;
}

enum machine_status device_moves_end(struct machine *m)
{
    enum machine_status status = MACHINE_OK;
    if (ranks_mine() == 0 && ranks_are_ours())
        ranks_flush();
    for (int i = 0; i < moves.count; i++) {
        struct move *it = &moves.all[i];
        mpi_wait(&it->request, 1);
        if (it->to && !status)
            status = device_write(m, it->to, it->at, it->copy, it->bytes, "writing a block");
        free(it->copy);
    }
    moves.count = 0;
    return status;
}

/* ---- rows ---- */

enum machine_status device_rows_read(struct machine *m, const struct device_buffer *b,
                                     struct far_rows rows, void *out, size_t out_pitch,
                                     const char *what)
{
    enum machine_status status = MACHINE_OK;
    if (b->rank)
        return device_far_read(m, b, rows, out, out_pitch);
    for (uint64_t i = 0; i < rows.rows && !status; i++)
        status = device_read(m, b, rows.at + i * rows.pitch, (char *)out + i * out_pitch,
                             rows.bytes, what);
    return status;
}

enum machine_status device_rows_write(struct machine *m, const struct device_buffer *b,
                                      struct far_rows rows, const void *in, size_t in_pitch,
                                      const char *what)
{
    enum machine_status status = MACHINE_OK;
    if (b->rank)
        return device_far_write(m, b, rows, in, in_pitch);
    for (uint64_t i = 0; i < rows.rows && !status; i++)
        status = device_write(m, b, rows.at + i * rows.pitch, (const char *)in + i * in_pitch,
                              rows.bytes, what);
    return status;
}
