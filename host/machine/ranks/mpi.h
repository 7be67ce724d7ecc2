/* mpi.h - the few functions of MPI that ranks need, of a library that is loaded where a starter
 * has made several processes, and nowhere else.
 *
 *     char why[200];
 *     if (!mpi_begin(why, sizeof why))
 *         say(why);
 *     struct mpi_request sent;
 *     mpi_send(1, MPI_TAG_DATA, bytes, count, &sent);
 *     mpi_wait(&sent, 1);
 *
 * Nothing is compiled against a library's header. There are two binary interfaces: Open MPI's,
 * whose handles are addresses, and MPICH's, whose handles are numbers, which Intel's and other
 * libraries share. A handle here is a word that has room for both.
 *
 * Errors: a library ends all ranks where a message cannot be sent. Threads: one at a time. */
#ifndef LUTETIA_MACHINE_RANKS_MPI_H
#define LUTETIA_MACHINE_RANKS_MPI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Of one sender and one tag messages arrive in the order in which they were sent. */
enum mpi_tag { MPI_TAG_COMMANDS = 1, MPI_TAG_DATA, MPI_TAG_PLANES, MPI_TAG_REPLY };

struct mpi_request {
    uintptr_t handle;
};

/* Loads the library and starts it. False: why not. */
bool mpi_begin(char *why, size_t size);
int mpi_rank(void);
int mpi_size(void);
/* Waits for all other ranks. */
void mpi_finish(void);
/* Ends all ranks, as well as the starter can. */
void mpi_abort(void);

/* A message has fewer bytes than 2^31. */
void mpi_send(int to, enum mpi_tag tag, const void *bytes, size_t count,
              struct mpi_request *sent);
void mpi_take(int from, enum mpi_tag tag, void *bytes, size_t count, struct mpi_request *taken);
/* Processors are left to others while nothing comes. */
void mpi_wait(struct mpi_request *requests, int count);
/* More ranks are on this computer than there are processors: a rank that waits leaves its
 * processor at once. */
void mpi_is_crowded(void);

#endif
