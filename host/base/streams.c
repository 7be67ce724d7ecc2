/* streams.c - see streams.h. */
#include "streams.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

int streams_nowhere(int mode)
{
    return open("/dev/null", mode);
}

void streams_fill(void)
{
    for (int i = STDIN_FILENO; i <= STDERR_FILENO; i++)
        if (fcntl(i, F_GETFD) < 0 && errno == EBADF && streams_nowhere(O_RDWR) != i)
            abort(); /* stderr is missing, too: no message is possible */
}

bool streams_end(void)
{
    bool failed = ferror(stdout) != 0;
    return fflush(stdout) == 0 && !failed;
}
