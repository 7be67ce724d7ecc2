/* verb_bench.c - `lutetia bench NAME`: runs the benchmarks, which are a program of their own
 * (bench/lutetia_bench.c). */
#include "help.h"
#include "lutetia.h"

#include <program.h>

#include <errno.h>
#include <string.h>
#include <unistd.h>

static void here(void)
{
}

int verb_bench(int argc, char **argv)
{
    (void)argc;
    char path[PATH_MAX];
    if (help_is_table()) /* the program itself lists its benchmarks */
        return help_print("bench", NULL, NULL);
    if (!program_find(path, here, LUTETIA_LIBEXECDIR "/lutetia/lutetia-bench",
                      "bench/lutetia-bench"))
        return fail("bench", "the program lutetia-bench is not beside lutetia; install or "
                             "build it with the rest");
    execv(path, argv);
    return fail("bench", "%s cannot be run: %s", path, strerror(errno));
}
