/* processes.c - who this process is among the ranks: see ranks.h. */
#include "ranks/processes.h"

#include <unistd.h>

#include "base/process.h"

static struct {
    int count, mine, on_node;
    pid_t process;
} the = {1, 0, 1, 0};

void processes_are(int count, int mine, int on_node)
{
    the.count = count;
    the.mine = mine;
    the.on_node = on_node;
    the.process = process_now();
}

int ranks_count(void)
{
    return the.count;
}

int ranks_mine(void)
{
    return the.mine;
}

int ranks_on_node(void)
{
    return the.on_node;
}

bool ranks_are_ours(void)
{
    return the.count > 1 && the.process == process_now();
}
