/* latency.c - see latency.h. */
#include "latency.h"

#include <fcntl.h>
#include <stdint.h>
#include <unistd.h>

int latency_open(const char *path)
{
    return open(path, O_WRONLY | O_CLOEXEC);
}

bool latency_ask(int file, bool awake)
{
    static const int32_t at_once_us = 0, any_us = 2000000000;
    return write(file, awake ? &at_once_us : &any_us, sizeof at_once_us) ==
           (ssize_t)sizeof at_once_us;
}
