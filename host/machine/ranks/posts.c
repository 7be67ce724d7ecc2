/* posts.c - see posts.h. */
#include "ranks/posts.h"

#include <stdlib.h>

#include "base/arrays.h"

enum { MESSAGE_MOST = 1 << 30 };

static struct mpi_request *post_add(struct posts *p)
{
    if (p->count == p->capacity)
        p->requests = array_grown(p->requests, &p->capacity, sizeof *p->requests);
    return &p->requests[p->count++];
}

void posts_send(struct posts *p, int to, const void *bytes, size_t count)
{
    for (size_t at = 0, some; at < count; at += some) {
        some = count - at < MESSAGE_MOST ? count - at : MESSAGE_MOST;
        mpi_send(to, MPI_TAG_PLANES, (const char *)bytes + at, some, post_add(p));
    }
}

void posts_take(struct posts *p, int from, void *bytes, size_t count)
{
    for (size_t at = 0, some; at < count; at += some) {
        some = count - at < MESSAGE_MOST ? count - at : MESSAGE_MOST;
        mpi_take(from, MPI_TAG_PLANES, (char *)bytes + at, some, post_add(p));
    }
}

void posts_end(struct posts *p)
{
    mpi_wait(p->requests, p->count);
    free(p->requests);
    *p = (struct posts){.count = 0};
}
