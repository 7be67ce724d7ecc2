/* input_file.c - see input_file.h. */
#include "input_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *explain(int error)
{
    switch (error) {
    case EISDIR:
        return "Is a directory; name a file in it";
    case ENOTSUP:
        return "Is not a regular file; name a file";
    case ELOOP:
        return "Is a symbolic link, or too many follow each other; name the file itself";
    default:
        return strerror(error);
    }
}

static int regular_open(const char *path, int flags, const char **why)
{
    struct stat status;
    int error = 0;
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | flags);
    if (file < 0 || fstat(file, &status) != 0)
        error = errno == ENXIO ? ENOTSUP : errno; /* ENXIO: the file is a socket */
    else if (!S_ISREG(status.st_mode))
        error = S_ISDIR(status.st_mode) ? EISDIR : ENOTSUP;
    else if (fcntl(file, F_SETFL, 0) != 0) /* O_NONBLOCK was for opening only */
        error = errno;
    if (!error)
        return file;
    if (file >= 0)
        close(file);
    errno = error;
    if (why)
        *why = explain(error);
    return -1;
}

int input_file_descriptor(const char *path, const char **why)
{
    return regular_open(path, 0, why);
}

int input_file_descriptor_no_link(const char *path, const char **why)
{
    return regular_open(path, O_NOFOLLOW, why);
}

int input_folder_descriptor(int in, const char *path)
{
    return openat(in, path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

FILE *input_file_open(const char *path, const char **why)
{
    int file = input_file_descriptor(path, why);
    FILE *stream = file < 0 ? NULL : fdopen(file, "rb");
    if (file >= 0 && !stream) {
        int error = errno;
        close(file);
        errno = error;
        if (why)
            *why = explain(error);
    }
    return stream;
}
