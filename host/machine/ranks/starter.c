/* starter.c - what starters say in the environment: see ranks.h. */
#include <stdlib.h>
#include <string.h>

#include "ranks/ranks.h"

/* Slurm's are those of a step: a batch script is none, though it has other variables of these
 * names. */
static const struct {
    const char *count, *mine;
} starters[] = {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                {"PMI_SIZE", "PMI_RANK"},
                {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}};
enum { STARTERS = sizeof starters / sizeof *starters };

static int number_of(const char *variable)
{
    const char *text = getenv(variable);
    return text && *text ? atoi(text) : 0;
}

bool ranks_starter(struct ranks_starter *out)
{
    for (int i = 0; i < STARTERS; i++)
        if (number_of(starters[i].count) > 1) {
            *out = (struct ranks_starter){number_of(starters[i].count),
                                          number_of(starters[i].mine), starters[i].count};
            return true;
        }
    return false;
}

bool ranks_wanted(struct ranks_starter *out)
{
    const char *said = getenv("LUTETIA_RANKS");
    return ranks_starter(out) && !(said && strcmp(said, "0") == 0);
}

void ranks_starter_forget(void)
{
    for (int i = 0; i < STARTERS; i++)
        unsetenv(starters[i].count);
}
