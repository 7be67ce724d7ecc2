/* ranks_begin.c - processes become ranks: see machine_ranks.h. */
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "machine_ranks.h"
#include "ranks/mpi.h"
#include "ranks/ranks.h"
#include "served.h"

/* PoCL makes as many threads as a process has processors. Where ranks of this computer may all
 * use the same ones, each gets its share of them. */
static void processors_share(void)
{
    cpu_set_t all;
    char count[16];
    if (sched_getaffinity(0, sizeof all, &all) != 0 ||
        CPU_COUNT(&all) < (int)sysconf(_SC_NPROCESSORS_ONLN))
        return; /* the starter has given each its own */
    const int share = CPU_COUNT(&all) / ranks_on_node();
    snprintf(count, sizeof count, "%d", share ? share : 1);
    setenv("POCL_MAX_PTHREAD_COUNT", count, 0);
    setenv("POCL_CPU_MAX_CU_COUNT", count, 0);
}

/* The program has ended by itself, by exit() or at the end of main(). */
static void end(void)
{
    if (!ranks_are_ours())
        return;
    faults_are_over();
    ranks_command_all((struct ranks_command){RANKS_END, 0, {0}}, NULL);
    ranks_flush();
    mpi_finish();
}

/* Files that only one process should write are rank 0's. */
static void files_forget(void)
{
    static const char *const variables[] = {"LUTETIA_TRACE", "LUTETIA_DUMP", "LUTETIA_EXPLAIN",
                                            "LUTETIA_EXPLAIN_JSON"};
    for (size_t i = 0; i < sizeof variables / sizeof *variables; i++)
        unsetenv(variables[i]);
}

void machine_ranks_begin(void)
{
    struct ranks_starter starter;
    if (!ranks_wanted(&starter))
        return;
    if (!ranks_join(&starter))
        _exit(1);
    ranks_starter_forget();
    processors_share();
    if (ranks_mine() == 0) {
        atexit(end);
        return;
    }
    files_forget();
    served_perform();
    mpi_finish();
    _exit(0);
}
