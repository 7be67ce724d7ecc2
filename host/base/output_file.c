/* output_file.c - see output_file.h. */
#include "output_file.h"

#include "input_file.h"
#include "part_files.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

enum { RANDOM_DIGITS = 16, TRIES = 16, FOLDERS_REMEMBERED = 16 };

static const char part_end[] = ".part";

const char *output_file_explain(int error)
{
    switch (error) {
    case ENOSPC:
        return "No space left on device; free some space or write elsewhere";
    case EDQUOT:
        return "Disk quota exceeded; free some space or write elsewhere";
    case EFBIG:
        return "File too large; write elsewhere";
    case ENOENT:
        return "No such file or directory; the folder must exist";
    case EACCES:
        return "Permission denied; choose a folder that you may write to";
    case EPERM:
        return "Operation not permitted; choose a folder that you may write to";
    case EROFS:
        return "Read-only file system; choose a folder that you may write to";
    case EISDIR:
        return "Is a directory; name a file in it";
    case ELOOP:
        return "Is a symbolic link, and links are not followed; name the file itself";
    case ENOTSUP:
        return "Is not a regular file; name a file";
    default:
        return strerror(error);
    }
}

static bool output_fail(struct output_file *out, int error)
{
    output_file_abandon(out);
    out->error = error ? error : EIO;
    out->why = output_file_explain(out->error);
    return false;
}

/* ---- part files of dead processes ---- */

/* .NAME.0123456789abcdef.part */
static bool is_part_name(const char *name)
{
    size_t length = strlen(name), end = sizeof part_end - 1;
    if (name[0] != '.' || length < RANDOM_DIGITS + end + 4 ||
        strcmp(name + length - end, part_end) != 0)
        return false;
    const char *digits = name + length - end - RANDOM_DIGITS;
    return digits[-1] == '.' && strspn(digits, "0123456789abcdef") == RANDOM_DIGITS;
}

static void part_sweep(int folder, const char *name)
{
    int file = openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    struct stat status;
    if (file < 0)
        return;
    if (fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_uid == geteuid() &&
        flock(file, LOCK_EX | LOCK_NB) == 0)
        unlinkat(folder, name, 0);
    close(file);
}

void output_file_sweep(int folder_descriptor)
{
    int again =
        input_folder_descriptor(folder_descriptor, "."); /* a description of its own, with
                                                                  * its own position */
    DIR *names = again < 0 ? NULL : fdopendir(again);
    if (!names) {
        if (again >= 0)
            close(again);
        return;
    }
    for (struct dirent *e; (e = readdir(names));)
        if (is_part_name(e->d_name))
            part_sweep(folder_descriptor, e->d_name);
    closedir(names);
}

/* A film writes thousands of pictures into one folder: a process sweeps it once. The folders
 * last swept are remembered. */
static void sweep_once(int folder)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static struct {
        dev_t device;
        ino_t inode;
    } swept[FOLDERS_REMEMBERED];
    static unsigned count;
    static pid_t process;
    struct stat status;
    bool known = fstat(folder, &status) != 0;
    pthread_mutex_lock(&lock);
    if (process != getpid()) { /* a forked child has swept nothing yet */
        process = getpid();
        count = 0;
    }
    for (unsigned i = 0; i < count && i < FOLDERS_REMEMBERED && !known; i++)
        known = swept[i].device == status.st_dev && swept[i].inode == status.st_ino;
    if (!known) {
        swept[count % FOLDERS_REMEMBERED].device = status.st_dev;
        swept[count++ % FOLDERS_REMEMBERED].inode = status.st_ino;
    }
    pthread_mutex_unlock(&lock);
    if (!known)
        output_file_sweep(folder);
}

/* ---- a file's life ---- */

/* Splits the path "a/b.png": opens the folder "a", and keeps the name "b.png". */
static int path_split(struct output_file *out, const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    if (!*name || strcmp(name, ".") == 0 || strcmp(name, "..") == 0)
        return *path ? EISDIR : ENOENT;
    if (strlen(name) + RANDOM_DIGITS + sizeof part_end + 2 > 255)
        return ENAMETOOLONG;
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
    out->name = strdup(name);
    if (!folder || !out->name) {
        free(folder);
        return ENOMEM;
    }
    out->folder = open(folder, O_PATH | O_DIRECTORY | O_CLOEXEC); /* O_PATH: the folder need
                                                                   * not be readable */
    int error = out->folder < 0 ? errno : 0;
    out->part = folder; /* part_make() adds the part file's name */
    if (!slash)
        *folder = '\0';
    return error;
}

/* The name may be replaced if it is a regular file, or free. */
static int target_check(const struct output_file *out)
{
    struct stat status;
    if (fstatat(out->folder, out->name, &status, AT_SYMLINK_NOFOLLOW) != 0)
        return errno == ENOENT ? 0 : errno;
    if (S_ISREG(status.st_mode))
        return 0;
    return S_ISDIR(status.st_mode) ? EISDIR : S_ISLNK(status.st_mode) ? ELOOP : ENOTSUP;
}

/* Finds another name for a part file, and notes it. */
static char *part_name_make(const struct output_file *out, int *noted)
{
    unsigned long long number;
    char *name = NULL;
    if (getrandom(&number, sizeof number, 0) != sizeof number)
        return NULL;
    if (asprintf(&name, ".%s.%016llx%s", out->name, number, part_end) < 0) {
        errno = ENOMEM;
        return NULL;
    }
    *noted = part_file_note(out->folder, name);
    return name;
}

/* Forgets and frees the name of a part file. */
static void part_name_drop(struct output_file *out)
{
    part_file_forget(out->noted);
    free(out->part_name);
    out->part_name = NULL;
    out->noted = 0;
}

/* Makes the part file and locks it. Returns its descriptor, or -1 with errno. Between making
 * and locking, another process that sweeps may take the file for a dead process's and remove
 * its name; then another part file is made. */
static int part_make(struct output_file *out)
{
    for (int i = 0; i < TRIES; i++) {
        struct stat status;
        part_name_drop(out);
        out->part_name = part_name_make(out, &out->noted);
        if (!out->part_name)
            return -1;
        int file = openat(out->folder, out->part_name,
                          O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file < 0 && errno == EEXIST)
            continue;
        if (file < 0)
            return -1;
        flock(file, LOCK_EX); /* a file system without locks is never swept */
        if (fstat(file, &status) == 0 && status.st_nlink > 0)
            return file;
        close(file);
    }
    errno = EEXIST;
    return -1;
}

bool output_file_open(struct output_file *out, const char *path)
{
    *out = (struct output_file){.folder = -1, .former = -1};
    int error = path_split(out, path);
    if (!error)
        error = target_check(out);
    if (error)
        return output_fail(out, error);
    sweep_once(out->folder);
    int file = part_make(out);
    char *whole = NULL;
    if (file < 0 || asprintf(&whole, "%s%s", out->part, out->part_name) < 0) {
        error = file < 0 ? errno : ENOMEM;
        if (file >= 0) {
            unlinkat(out->folder, out->part_name, 0);
            close(file);
        }
        part_name_drop(out);
        return output_fail(out, error);
    }
    free(out->part);
    out->part = whole;
    out->stream = fdopen(file, "w+b");
    if (out->stream)
        return true;
    error = errno;
    close(file);
    return output_fail(out, error);
}

const char *output_file_wrong(const char *path)
{
    struct output_file out = {.folder = -1, .former = -1};
    int error = path_split(&out, path);
    if (!error)
        error = target_check(&out);
    if (!error && faccessat(out.folder, ".", W_OK | X_OK, 0) != 0)
        error = errno;
    output_file_abandon(&out);
    return error ? output_file_explain(error) : NULL;
}

/* Frees the memory, and removes the part file if it has not been renamed, or what had the name
 * if it is kept. */
static void output_release(struct output_file *out)
{
    if (out->part_name)
        unlinkat(out->folder, out->part_name, 0);
    if (out->former_name)
        unlinkat(out->folder, out->former_name, 0);
    part_file_forget(out->noted);
    part_file_forget(out->former_noted);
    if (out->stream)
        fclose(out->stream);
    if (out->former >= 0)
        close(out->former);
    if (out->folder >= 0)
        close(out->folder);
    free(out->part);
    free(out->part_name);
    free(out->former_name);
    free(out->name);
    *out = (struct output_file){.folder = -1, .former = -1};
}

/* Whether that name is this open file's. */
static bool is_name_of(int folder, const char *name, int file)
{
    struct stat named, opened;
    return fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
           fstat(file, &opened) == 0 && named.st_dev == opened.st_dev &&
           named.st_ino == opened.st_ino;
}

/* The file has appeared, and is given up: what had the name has it again, unless another
 * process has put a file there since. */
static void former_return(struct output_file *out)
{
    if (out->part_name || !out->stream ||
        !is_name_of(out->folder, out->name, fileno(out->stream)))
        return;
    if (!out->former_name)
        unlinkat(out->folder, out->name, 0);
    else if (renameat(out->folder, out->former_name, out->folder, out->name) == 0) {
        free(out->former_name);
        out->former_name = NULL;
    }
}

/* Keeps what has the name, under a part file's name and with a lock, so that nobody sweeps it.
 * Where that cannot be (it is not ours to read or to link; another process is writing it), it
 * is not kept. */
static void former_keep(struct output_file *out)
{
    out->former = openat(out->folder, out->name,
                         O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (out->former < 0 || flock(out->former, LOCK_SH | LOCK_NB) != 0)
        return;
    out->former_name = part_name_make(out, &out->former_noted);
    if (!out->former_name ||
        (linkat(out->folder, out->name, out->folder, out->former_name, 0) == 0 &&
         is_name_of(out->folder, out->former_name, out->former)))
        return;
    unlinkat(out->folder, out->former_name, 0);
    part_file_forget(out->former_noted);
    free(out->former_name);
    out->former_name = NULL;
    out->former_noted = 0;
}

void output_file_abandon(struct output_file *out)
{
    if (!out->name && !out->stream)
        return;
    former_return(out);
    output_release(out);
}

void output_file_let_go(struct output_file *out)
{
    free(out->part_name);
    free(out->former_name);
    out->part_name = out->former_name = NULL;
    output_release(out);
}

/* A stream remembers that a write failed, but not the errno. Writing another byte fails for
 * the same reason and sets errno. */
static int write_error(FILE *stream)
{
    struct stat status;
    int file = fileno(stream);
    errno = EIO;
    return fstat(file, &status) == 0 && pwrite(file, "", 1, status.st_size) == 1 ? EIO : errno;
}

/* Syncs the folder, so that the new name is on the disk. A folder that cannot be synced is
 * left to the system. */
static void folder_sync(int folder)
{
    int again = input_folder_descriptor(folder, ".");
    if (again >= 0) {
        fsync(again);
        close(again);
    }
}

/* Brings the bytes to the disk; returns errno. */
static int bytes_sync(struct output_file *out)
{
    int error = ferror(out->stream) ? write_error(out->stream) : 0;
    errno = 0;
    if (!error && fflush(out->stream) != 0)
        error = errno ? errno : EIO;
    if (!error && fsync(fileno(out->stream)) != 0 && errno != EINVAL)
        error = errno; /* EINVAL: the file system has no fsync() */
    return error;
}

/* Gives the part file its name; returns errno. */
static int part_rename(struct output_file *out)
{
    int error = target_check(out);
    if (!error && renameat(out->folder, out->part_name, out->folder, out->name) != 0)
        error = errno;
    if (error)
        return error;
    part_name_drop(out);
    folder_sync(out->folder);
    return 0;
}

bool output_file_appear(struct output_file *out)
{
    int error = bytes_sync(out);
    if (!error)
        error = target_check(out);
    if (error)
        return output_fail(out, error);
    former_keep(out);
    error = part_rename(out);
    return !error || output_fail(out, error);
}

bool output_file_commit(struct output_file *out)
{
    int error = bytes_sync(out);
    if (!error && out->part_name)
        error = part_rename(out);
    if (error)
        return output_fail(out, error);
    output_release(out);
    return true;
}
