/* growing_file.c - see growing_file.h. */
#include "growing_file.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool growing_fail(struct growing_file *f, int error)
{
    if (f->owner == getpid())
        output_file_abandon(&f->out);
    else if (f->out.stream)
        output_file_let_go(&f->out);
    if (f->descriptor >= 0)
        close(f->descriptor);
    *f = (struct growing_file){
        .error = error, .why = output_file_explain(error), .descriptor = -1};
    return false;
}

static const char *digits_skip(const char *text)
{
    while (isdigit((unsigned char)*text))
        text++;
    return text;
}

/* The names under which the system shows this or another process's open files. Others in /dev
 * may be anybody's: /dev/shm is open to all. */
static bool is_open_file(const char *path)
{
    const char *at = NULL;
    if (strcmp(path, "/dev/stdout") == 0 || strcmp(path, "/dev/stderr") == 0)
        return true;
    if (strncmp(path, "/dev/fd/", 8) == 0)
        at = path + 8;
    else if (strncmp(path, "/proc/self/fd/", 14) == 0)
        at = path + 14;
    else if (strncmp(path, "/proc/", 6) == 0 && digits_skip(path + 6) > path + 6 &&
             strncmp(digits_skip(path + 6), "/fd/", 4) == 0)
        at = digits_skip(path + 6) + 4;
    return at && isdigit((unsigned char)*at) && *digits_skip(at) == '\0';
}

/* Neither follows a link nor makes or empties a file. */
static int stream_open(const char *path, bool follow)
{
    struct stat status;
    const int file =
        open(path, O_WRONLY | O_APPEND | O_NOCTTY | O_CLOEXEC | (follow ? 0 : O_NOFOLLOW));
    if (file < 0)
        return -1;
    int error = fstat(file, &status) != 0 ? errno : 0;
    if (!error && S_ISREG(status.st_mode) && !follow)
        error = ENOTSUP; /* a file has come in a pipe's place */
    if (!error && S_ISFIFO(status.st_mode) && !follow && status.st_uid != geteuid() &&
        status.st_uid != 0)
        error = EACCES;
    if (!error)
        return file;
    close(file);
    errno = error;
    return -1;
}

bool growing_file_open(struct growing_file *f, const char *path)
{
    struct stat status;
    const bool follow = is_open_file(path);
    *f = (struct growing_file){.descriptor = -1, .owner = getpid()};
    const bool there = (follow ? stat(path, &status) : lstat(path, &status)) == 0;
    if (there && S_ISFIFO(status.st_mode) && !follow && status.st_uid != geteuid() &&
        status.st_uid != 0)
        return growing_fail(f, EACCES); /* before it waits for a reader */
    if (follow || (there && (S_ISFIFO(status.st_mode) || S_ISCHR(status.st_mode)))) {
        f->descriptor = stream_open(path, follow);
        if (f->descriptor < 0)
            return growing_fail(f, errno);
    } else if (!output_file_open(&f->out, path)) {
        return growing_fail(f, f->out.error);
    }
    f->is_open = true;
    return true;
}

void growing_file_of_pipe(struct growing_file *f, int descriptor)
{
    *f = (struct growing_file){.descriptor = descriptor, .is_open = true, .owner = getpid()};
}

/* at < 0: to a stream. */
static bool bytes_write(int file, const char *bytes, size_t count, off_t at)
{
    while (count > 0) {
        const ssize_t done =
            at < 0 ? write(file, bytes, count) : pwrite(file, bytes, count, at);
        if (done < 0 && errno == EINTR)
            continue;
        if (done == 0)
            errno = EIO;
        if (done <= 0)
            return false;
        bytes += done;
        count -= (size_t)done;
        at += at < 0 ? 0 : (off_t)done;
    }
    return true;
}

bool growing_file_append(struct growing_file *f, const void *bytes, size_t count,
                         const char *tail, size_t tail_count)
{
    if (!f->is_open)
        return false;
    if (f->descriptor >= 0)
        return bytes_write(f->descriptor, bytes, count, -1) || growing_fail(f, errno);
    const int file = fileno(f->out.stream);
    if (tail_count == 0) { /* at the place that forked children share */
        if (!bytes_write(file, bytes, count, -1))
            return growing_fail(f, errno);
    } else if (!bytes_write(file, bytes, count, f->end) ||
               !bytes_write(file, tail, tail_count, f->end + (off_t)count)) {
        return growing_fail(f, errno);
    }
    f->end += (off_t)count;
    if (!f->named && !output_file_appear(&f->out))
        return growing_fail(f, f->out.error);
    f->named = true;
    return true;
}

bool growing_file_close(struct growing_file *f)
{
    if (!f->is_open)
        return true;
    f->is_open = false;
    if (f->descriptor >= 0) {
        const int file = f->descriptor;
        f->descriptor = -1;
        return close(file) == 0 || growing_fail(f, errno);
    }
    if (f->owner != getpid() || !f->named) {
        if (f->owner != getpid())
            output_file_let_go(&f->out);
        else
            output_file_abandon(&f->out);
        return true;
    }
    return output_file_commit(&f->out) || growing_fail(f, f->out.error);
}
