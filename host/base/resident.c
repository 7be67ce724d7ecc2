/* resident.c - see resident.h; Linux tells it in /proc/self/statm, in pages: size, resident,
 * shared, text, 0, data, 0. */
#include "resident.h"

#include "input_file.h"

#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

struct pages {
    double resident, data;
};

static bool pages_read(struct pages *pages)
{
    char text[200];
    const int file = input_file_descriptor("/proc/self/statm", NULL);
    const ssize_t count = file < 0 ? -1 : read(file, text, sizeof text - 1);
    if (file >= 0)
        close(file);
    if (count <= 0)
        return false;
    text[count] = '\0';
    return sscanf(text, "%*s %lf %*s %*s %*s %lf", &pages->resident, &pages->data) == 2;
}

double resident_bytes(void)
{
    struct pages pages;
    return pages_read(&pages) ? pages.resident * (double)sysconf(_SC_PAGESIZE) : 0;
}

void resident_limit(double more_bytes)
{
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    struct pages pages;
    struct rlimit now;
    if (!pages_read(&pages) || getrlimit(RLIMIT_DATA, &now) != 0)
        return;
    const rlim_t most = (rlim_t)(pages.data * (double)sysconf(_SC_PAGESIZE) + more_bytes);
    if (now.rlim_cur == RLIM_INFINITY || most < now.rlim_cur)
        setrlimit(RLIMIT_DATA, &(struct rlimit){most, now.rlim_max});
#else
    (void)more_bytes;
#endif
}
