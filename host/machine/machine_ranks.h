/* machine_ranks.h - one program on several processes, which a starter of MPI has made.
 *
 *     mpirun -n 3 ./diffusion
 *
 *     int main (int argc, char **argv)
 *     {
 *         machine_ranks_begin ();         ranks 1 and 2 never return from here
 *         machine_create (...);           its large VP sets are in the memory of three processes
 *
 * libparis does this before main(). Threads: only one may be there yet. */
#ifndef LUTETIA_MACHINE_RANKS_BEGIN_H
#define LUTETIA_MACHINE_RANKS_BEGIN_H

/* Where a starter has made several processes: they become ranks. The first one goes on; the
 * others perform its commands until it ends, and end. Processes that cannot be ranks of one
 * program say why in one line, and end with status 1. Elsewhere, and with LUTETIA_RANKS=0,
 * nothing happens. */
void machine_ranks_begin(void);

#endif
