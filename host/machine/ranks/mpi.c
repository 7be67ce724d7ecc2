/* mpi.c - see mpi.h. */
#include "ranks/mpi.h"

#include <dlfcn.h>
#include <library.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* The same in both interfaces. */
enum { SUCCESS = 0, THREADS_IN_TURN = 2 };

/* MPICH's. */
#define MPICH_WORLD ((uintptr_t)0x44000000)
#define MPICH_BYTE ((uintptr_t)0x4c00010d)
#define MPICH_NO_STATUS ((void *)1)

#define NAMES(_)                                                                               \
    _(Init_thread) _(Comm_rank) _(Comm_size) _(Isend) _(Irecv) _(Test) _(Abort) _(Finalize)

static struct {
    int (*MPI_Init_thread)(int *, char ***, int, int *);
    int (*MPI_Comm_rank)(uintptr_t, int *);
    int (*MPI_Comm_size)(uintptr_t, int *);
    int (*MPI_Isend)(const void *, int, uintptr_t, int, int, uintptr_t, uintptr_t *);
    int (*MPI_Irecv)(void *, int, uintptr_t, int, int, uintptr_t, uintptr_t *);
    int (*MPI_Test)(uintptr_t *, int *, void *);
    int (*MPI_Abort)(uintptr_t, int);
    int (*MPI_Finalize)(void);
    char *ompi_mpi_comm_world, *ompi_mpi_byte; /* their addresses; NULL: MPICH's interface */
} mpi;

static const struct library_function functions[] = {
#define ROW(name) LIBRARY_FUNCTION(mpi, MPI_##name),
    NAMES(ROW)
#undef ROW
        LIBRARY_FUNCTION(mpi, ompi_mpi_comm_world),
    LIBRARY_FUNCTION(mpi, ompi_mpi_byte)};
enum { ALL = sizeof functions / sizeof *functions, OF_BOTH = ALL - 2 };

static int rank, size = 1;
static bool is_crowded;
static uintptr_t world, byte;
static void *no_status;

/* Open MPI's own parts look for its functions among those that all see. */
static void show(const char *library)
{
    (void)dlopen(library, RTLD_NOW | RTLD_GLOBAL);
}

/* The interface that the starter is likely to have is tried first. */
static bool load(char *why, size_t room)
{
    static const char *const open[] = {"libmpi.so.40"}, *const mpich[] = {"libmpi.so.12",
                                                                          "libmpich.so.12"};
    const bool open_first = getenv("OMPI_COMM_WORLD_SIZE") || !getenv("PMI_SIZE");
    const char *missing = NULL;
    for (int turn = 0; turn < 2; turn++) {
        if ((turn == 0) == open_first) {
            show(open[0]);
            if (library_load(open[0], functions, ALL, &mpi, &missing))
                return true;
            continue;
        }
        for (size_t i = 0; i < sizeof mpich / sizeof *mpich; i++)
            if (library_load_exactly(mpich[i], functions, OF_BOTH, &mpi, &missing))
                return true;
    }
    snprintf(why, room,
             "there is no MPI library here (libmpi.so.40 of Open MPI, libmpi.so.12 "
             "of MPICH)");
    return false;
}

bool mpi_begin(char *why, size_t room)
{
    int threads = 0;
    if (!load(why, room))
        return false;
    const bool open = mpi.ompi_mpi_comm_world != NULL;
    world = open ? (uintptr_t)mpi.ompi_mpi_comm_world : MPICH_WORLD;
    byte = open ? (uintptr_t)mpi.ompi_mpi_byte : MPICH_BYTE;
    no_status = open ? NULL : MPICH_NO_STATUS;
    if (mpi.MPI_Init_thread(NULL, NULL, THREADS_IN_TURN, &threads) != SUCCESS ||
        mpi.MPI_Comm_rank(world, &rank) != SUCCESS ||
        mpi.MPI_Comm_size(world, &size) != SUCCESS) {
        snprintf(why, room, "the MPI library does not start");
        return false;
    }
    return true;
}

int mpi_rank(void)
{
    return rank;
}

int mpi_size(void)
{
    return size;
}

void mpi_finish(void)
{
    mpi.MPI_Finalize();
}

void mpi_abort(void)
{
    mpi.MPI_Abort(world, 1);
}

void mpi_send(int to, enum mpi_tag tag, const void *bytes, size_t count,
              struct mpi_request *sent)
{
    sent->handle = 0;
    mpi.MPI_Isend(bytes, (int)count, byte, to, (int)tag, world, &sent->handle);
}

void mpi_take(int from, enum mpi_tag tag, void *bytes, size_t count, struct mpi_request *taken)
{
    taken->handle = 0;
    mpi.MPI_Irecv(bytes, (int)count, byte, from, (int)tag, world, &taken->handle);
}

void mpi_is_crowded(void)
{
    is_crowded = true;
}

/* Ever longer: first a look at once, then after a nap. Not by sched_yield(): where other
 * programs are busy, they would have the processor for their whole share of time, and who wakes
 * up comes first. The naps of who waits for long are short beside what it waited for. */
static void pause_after(int looks)
{
    enum { AT_ONCE = 2000, NAP_NS = 10000, NAP_MOST_NS = 500000 };
    const int at_once = is_crowded ? 0 : AT_ONCE;
    if (looks < at_once)
        return;
    const long ns = NAP_NS + NAP_NS * ((looks - at_once) / 16);
    nanosleep(&(struct timespec){0, ns < NAP_MOST_NS ? ns : NAP_MOST_NS}, NULL);
}

void mpi_wait(struct mpi_request *requests, int count)
{
    for (int i = 0, looks = 0, done; i < count; i++)
        while (mpi.MPI_Test(&requests[i].handle, &done, no_status) == SUCCESS && !done)
            pause_after(looks < 1 << 20 ? looks++ : looks);
}
