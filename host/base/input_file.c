/* input_file.c - see input_file.h. */
#include "input_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
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
    case EFBIG:
        return "Is too large";
    case ENOMEM:
        return "There is no memory for it";
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

static FILE *stream_open(int file, const char **why)
{
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

FILE *input_file_open(const char *path, const char **why)
{
    return stream_open(input_file_descriptor(path, why), why);
}

/* ---- whole ---- */

/* How many bytes are likely to come: of a file those that are left, else some. */
static size_t expected(FILE *in)
{
    enum { SOME = 1 << 14 };
    struct stat status;
    const off_t at = ftello(in);
    const bool known = at >= 0 && fstat(fileno(in), &status) == 0 && S_ISREG(status.st_mode) &&
                       status.st_size > at;
    return known ? (size_t)(status.st_size - at) : SOME;
}

/* Returns the errno. *text is the caller's, whatever is returned. */
static int all_read(FILE *in, size_t most, char **text, size_t *bytes)
{
    size_t room = expected(in);
    errno = 0;
    for (;;) {
        room = room < most ? room : most;
        char *more = realloc(*text, room + 2); /* one to see that there is more, and the 0 */
        if (!more)
            return ENOMEM;
        *text = more;
        *bytes += fread(*text + *bytes, 1, room + 1 - *bytes, in);
        if (ferror(in))
            return errno ? errno : EIO;
        if (*bytes > most)
            return EFBIG;
        if (*bytes <= room)
            break;
        room *= 2;
    }
    (*text)[*bytes] = '\0';
    return 0;
}

char *input_stream_read(FILE *in, size_t most, size_t *bytes, const char **why)
{
    char *text = NULL;
    *bytes = 0;
    const int error = all_read(in, most, &text, bytes);
    if (!error)
        return text;
    free(text);
    *bytes = 0;
    errno = error;
    if (why)
        *why = explain(error);
    return NULL;
}

static char *descriptor_read(int file, size_t most, size_t *bytes, const char **why)
{
    FILE *in = stream_open(file, why);
    *bytes = 0;
    if (!in)
        return NULL;
    char *text = input_stream_read(in, most, bytes, why);
    const int error = errno;
    fclose(in);
    errno = error;
    return text;
}

char *input_file_read(const char *path, size_t most, size_t *bytes, const char **why)
{
    return descriptor_read(input_file_descriptor(path, why), most, bytes, why);
}

char *input_file_read_no_link(const char *path, size_t most, size_t *bytes, const char **why)
{
    return descriptor_read(input_file_descriptor_no_link(path, why), most, bytes, why);
}
