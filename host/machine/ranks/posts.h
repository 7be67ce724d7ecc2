/* posts.h - messages of any length that are on their way together.
 *
 *     struct posts posts = {.count = 0};
 *     posts_send(&posts, 1, out, bytes);
 *     posts_take(&posts, 1, in, bytes);
 *     posts_end(&posts);
 *
 * What two ranks send to each other is taken in the order in which it was sent. */
#ifndef LUTETIA_MACHINE_RANKS_POSTS_H
#define LUTETIA_MACHINE_RANKS_POSTS_H

#include "ranks/mpi.h"

struct posts {
    struct mpi_request *requests;
    int count, capacity;
};

void posts_send(struct posts *p, int to, const void *bytes, size_t count);
void posts_take(struct posts *p, int from, void *bytes, size_t count);
/* Waits for all. Others can be posted then. */
void posts_end(struct posts *p);

#endif
