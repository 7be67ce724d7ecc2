/* commands.c - commands on their way: see ranks.h.
 *
 *     a batch     bytes in all | command, payload | command, payload ...
 *
 * Batches of all ranks are sent together, and waited for together. Else a long batch for one
 * rank, which waits for planes of another one, would hold up the command that this one sends
 * them by. */
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "ranks/mpi.h"
#include "ranks/ranks.h"

enum { BATCH_BYTES = 65536, MESSAGE_MOST = 1 << 30, AS_DATA = 1 << 16 };

struct batch {
    uint64_t bytes; /* that are in use, these among them */
    unsigned char rest[BATCH_BYTES - sizeof(uint64_t)];
};

static struct batch *batches; /* of rank 0: by rank */
static struct batch taken;    /* of others: the one at hand */
static uint64_t taken_at;
static unsigned char *taken_data;

/* In pieces that the library can count. */
static void send_all(int to, enum mpi_tag tag, const void *bytes, size_t count)
{
    for (size_t at = 0, piece; at < count; at += piece) {
        struct mpi_request sent;
        piece = count - at < MESSAGE_MOST ? count - at : MESSAGE_MOST;
        mpi_send(to, tag, (const char *)bytes + at, piece, &sent);
        mpi_wait(&sent, 1);
    }
}

static void take_all(int from, enum mpi_tag tag, void *bytes, size_t count)
{
    for (size_t at = 0, piece; at < count; at += piece) {
        struct mpi_request got;
        piece = count - at < MESSAGE_MOST ? count - at : MESSAGE_MOST;
        mpi_take(from, tag, (char *)bytes + at, piece, &got);
        mpi_wait(&got, 1);
    }
}

/* ---- rank 0 ---- */

static struct batch *batch_of(int rank)
{
    if (!batches) {
        batches = calloc((size_t)ranks_count(), sizeof *batches);
        NEEDS_MEMORY(batches);
        for (int i = 0; i < ranks_count(); i++)
            batches[i].bytes = sizeof batches[i].bytes;
    }
    return &batches[rank];
}

void ranks_flush(void)
{
    struct mpi_request sent[RANKS_MOST];
    int count = 0;
    for (int i = 1; batches && i < ranks_count(); i++)
        if (batches[i].bytes > sizeof batches[i].bytes)
            mpi_send(i, MPI_TAG_COMMANDS, &batches[i], batches[i].bytes, &sent[count++]);
    mpi_wait(sent, count);
    for (int i = 1; batches && i < ranks_count(); i++)
        batches[i].bytes = sizeof batches[i].bytes;
}

void ranks_command(int rank, struct ranks_command command, const void *payload)
{
    const bool as_data = command.payload > RANKS_PAYLOAD_MOST;
    const uint64_t inside = as_data ? 0 : ((uint64_t)command.payload + 7) / 8 * 8;
    if (!ranks_are_ours())
        return;
    if (batch_of(rank)->bytes + sizeof command + inside > BATCH_BYTES)
        ranks_flush();
    struct batch *b = batch_of(rank);
    unsigned char *to = (unsigned char *)b + b->bytes;
    const uint32_t bytes = command.payload;
    command.what |= as_data ? AS_DATA : 0;
    memcpy(to, &command, sizeof command);
    if (inside)
        memcpy(to + sizeof command, payload, bytes);
    b->bytes += sizeof command + inside;
    if (as_data)
        ranks_data(rank, payload, bytes);
}

void ranks_command_all(struct ranks_command command, const void *payload)
{
    for (int i = 1; i < ranks_count(); i++)
        ranks_command(i, command, payload);
}

void ranks_data(int rank, const void *data, size_t bytes)
{
    if (!ranks_are_ours())
        return;
    ranks_flush();
    send_all(rank, MPI_TAG_DATA, data, bytes);
}

void ranks_reply_take(int rank, void *out, size_t bytes)
{
    take_all(rank, MPI_TAG_REPLY, out, bytes);
}

/* ---- other ranks ---- */

const struct ranks_command *ranks_next(const void **payload)
{
    static struct ranks_command c;
    if (taken_at == taken.bytes) {
        struct mpi_request got;
        mpi_take(0, MPI_TAG_COMMANDS, &taken, sizeof taken, &got);
        mpi_wait(&got, 1);
        taken_at = sizeof taken.bytes;
    }
    memcpy(&c, (unsigned char *)&taken + taken_at, sizeof c);
    taken_at += sizeof c;
    free(taken_data);
    taken_data = NULL;
    if (c.what & AS_DATA) {
        c.what &= ~(uint32_t)AS_DATA;
        taken_data = malloc(c.payload);
        NEEDS_MEMORY(taken_data);
        ranks_data_take(taken_data, c.payload);
        *payload = taken_data;
    } else {
        *payload = (unsigned char *)&taken + taken_at;
        taken_at += ((uint64_t)c.payload + 7) / 8 * 8;
    }
    return &c;
}

void ranks_data_take(void *out, size_t bytes)
{
    take_all(0, MPI_TAG_DATA, out, bytes);
}

void ranks_reply(const void *bytes, size_t count)
{
    send_all(0, MPI_TAG_REPLY, bytes, count);
}
