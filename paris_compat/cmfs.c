/* cmfs.c - files of the machine: <cm/cmfs.h>. */
#include "field_bytes.h"

#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif
#include <cm/cmfs.h>
#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#include <visible_text.h>

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int CMFS_errno = 0;

static int failed(int error)
{
    CMFS_errno = error;
    return -1;
}

/* ---- open, close ---- */

static int flags_of(int flags)
{
    static const int pairs[][2] = {{CMFS_O_WRONLY, O_WRONLY}, {CMFS_O_RDWR, O_RDWR},
                                   {CMFS_O_APPEND, O_APPEND}, {CMFS_O_CREAT, O_CREAT},
                                   {CMFS_O_TRUNC, O_TRUNC},   {CMFS_O_EXCL, O_EXCL}};
    int theirs = 0, known = 0;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        theirs |= flags & pairs[i][0] ? pairs[i][1] : 0;
        known |= pairs[i][0];
    }
    return flags & ~known || (flags & 3) == 3 ? -1 : theirs;
}

int CMFS_open(const char *path, int flags, ...)
{
    int mode = 0666;
    struct stat status;
    paris_inquire("CMFS_open");
    if (flags & CMFS_O_CREAT) {
        va_list arguments;
        va_start(arguments, flags);
        mode = va_arg(arguments, int);
        va_end(arguments);
    }
    const int theirs = flags_of(flags);
    if (!path || theirs < 0) {
        paris_fail(path ? "flags: %d are no CMFS_O_ flags" : "path: is NULL", flags);
        return failed(EINVAL);
    }
    /* Not emptied before it is known to be a file; opening a pipe does not wait. */
    const int file = open(path, (theirs & ~O_TRUNC) | O_NONBLOCK | O_NOCTTY | O_CLOEXEC,
                          (mode_t)mode & 0777);
    if (file < 0)
        return failed(errno);
    int error = fstat(file, &status) != 0 ? errno : !S_ISREG(status.st_mode) ? EINVAL : 0;
    if (!error && theirs & O_TRUNC && ftruncate(file, 0) != 0)
        error = errno;
    if (!error)
        return file;
    close(file);
    return failed(error);
}

int CMFS_close(int file)
{
    paris_inquire("CMFS_close");
    return close(file) == 0 ? 0 : failed(errno);
}

void CMFS_perror(const char *what)
{
    visible_say("%s: %s", what && *what ? what : "CMFS", strerror(CMFS_errno));
}

int CMFS_unlink(const char *path)
{
    paris_inquire("CMFS_unlink");
    if (!path) {
        paris_fail("path: is NULL");
        return failed(EINVAL);
    }
    return unlink(path) == 0 ? 0 : failed(errno);
}

/* ---- bytes ---- */

static bool bytes_write(int file, const uint8_t *bytes, size_t count)
{
    while (count > 0) {
        const ssize_t done = write(file, bytes, count);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0) {
            CMFS_errno = done ? errno : EIO;
            return false;
        }
        bytes += done;
        count -= (size_t)done;
    }
    return true;
}

/* How many bytes were read: fewer than count at the file's end. Negative: CMFS_errno. */
static ssize_t bytes_read(int file, uint8_t *bytes, size_t count)
{
    size_t all = 0;
    while (all < count) {
        const ssize_t done = read(file, bytes + all, count - all);
        if (done < 0 && errno == EINTR)
            continue;
        if (done < 0)
            return failed(errno);
        if (done == 0)
            break;
        all += (size_t)done;
    }
    return (ssize_t)all;
}

long CMFS_serial_write_file(int file, const void *bytes, unsigned long count)
{
    paris_inquire("CMFS_serial_write_file");
    if (!bytes && count) {
        paris_fail("bytes: is NULL");
        return failed(EINVAL);
    }
    return bytes_write(file, bytes, count) ? (long)count : -1;
}

long CMFS_serial_read_file(int file, void *bytes, unsigned long count)
{
    paris_inquire("CMFS_serial_read_file");
    if (!bytes && count) {
        paris_fail("bytes: is NULL");
        return failed(EINVAL);
    }
    return bytes_read(file, bytes, count);
}

static long seek(int file, long bytes, int whence)
{
    static const int whences[] = {SEEK_SET, SEEK_CUR, SEEK_END};
    if (whence < 0 || whence > 2) {
        paris_fail("whence: must be CMFS_L_SET, CMFS_L_INCR or CMFS_L_XTND (got %d)", whence);
        return failed(EINVAL);
    }
    const off_t at = lseek(file, bytes, whences[whence]);
    return at < 0 ? failed(errno) : (long)at;
}

long CMFS_serial_lseek(int file, long bytes, int whence)
{
    paris_inquire("CMFS_serial_lseek");
    return seek(file, bytes, whence);
}

/* ---- fields ---- */

enum { BITS_MOST = 1 << 16 };

static bool length_good(unsigned int len)
{
    if (len >= 1 && len <= BITS_MOST)
        return true;
    paris_fail("len: must be 1..%d bits (got %u)", BITS_MOST, len);
    return false;
}

static bool fields_begin(struct field_bytes *b, const char *name, CM_field_id_t field,
                         unsigned int len, const char *role)
{
    struct machine *m = paris_begin(name);
    CMFS_errno = EINVAL;
    return length_good(len) && paris_check_field_wholly(field, len, role) &&
           field_bytes_begin(b, m, field, len, (len + 7) / 8, NULL, false);
}

long CMFS_lseek(int file, long values, unsigned int len, int whence)
{
    struct machine *m = paris_inquire("CMFS_lseek");
    if (!length_good(len))
        return failed(EINVAL);
    const uint64_t each = machine_vpset_count(m, machine_vpset_current(m)) * ((len + 7) / 8);
    long bytes;
    if (each > INT64_MAX || __builtin_mul_overflow(values, (long)each, &bytes)) {
        paris_fail("values: a file has no place so far (got %ld)", values);
        return failed(EINVAL);
    }
    return seek(file, bytes, whence);
}

int CMFS_write_file_always(int file, CM_field_id_t source, unsigned int len)
{
    struct field_bytes b;
    if (!fields_begin(&b, "CMFS_write_file_always", source, len, "source"))
        return -1;
    const off_t begins = lseek(file, 0, SEEK_CUR);
    bool good = begins >= 0;
    if (!good)
        CMFS_errno = errno;
    while (good && field_bytes_next(&b)) {
        CMFS_errno = EIO; /* of the machine */
        good = field_bytes_get(&b) && bytes_write(file, b.bytes, b.count);
    }
    field_bytes_end(&b);
    if (!good && begins >= 0) {
        const int error = CMFS_errno;
        (void)lseek(file, begins, SEEK_SET);
        return failed(error);
    }
    return good ? (int)len : -1;
}

/* Whether the file has so many bytes from where it stands: 1; 0 at its end; negative: it has
 * not. */
static int has_bytes(int file, uint64_t bytes)
{
    struct stat status;
    const off_t at = lseek(file, 0, SEEK_CUR);
    if (at < 0 || fstat(file, &status) != 0)
        return failed(errno);
    if (at >= status.st_size)
        return 0;
    return (uint64_t)(status.st_size - at) >= bytes ? 1 : failed(ENODATA);
}

static int fields_read(struct field_bytes *b, int file, unsigned int len)
{
    const int has = has_bytes(file, field_bytes_all(b));
    bool good = has > 0;
    while (good && field_bytes_next(b)) {
        CMFS_errno = EIO;
        good = bytes_read(file, b->bytes, b->count) == (ssize_t)b->count && field_bytes_put(b);
    }
    field_bytes_end(b);
    return good ? (int)len : has > 0 ? -1 : has;
}

int CMFS_read_file_always(int file, CM_field_id_t dest, unsigned int len)
{
    struct field_bytes b;
    if (!fields_begin(&b, "CMFS_read_file_always", dest, len, "dest"))
        return -1;
    return fields_read(&b, file, len);
}

/* dest = source where active, in pieces. */
static bool move_where_active(struct machine *m, CM_field_id_t dest, CM_field_id_t source,
                              unsigned int len)
{
    for (unsigned int at = 0; at < len; at += PARIS_PIECE) {
        const unsigned int bits = len - at < PARIS_PIECE ? len - at : PARIS_PIECE;
        struct machine_value *v =
            machine_field_value(m, source + at, MACHINE_UINT((int)bits), MACHINE_WHERE_ACTIVE);
        if (!v || machine_field_store(m, dest + at, v, MACHINE_WHERE_ACTIVE) != MACHINE_OK) {
            paris_fail_machine();
            return false;
        }
    }
    return true;
}

int CMFS_read_file(int file, CM_field_id_t dest, unsigned int len)
{
    struct machine *m = paris_begin("CMFS_read_file");
    struct field_bytes b;
    CMFS_errno = EINVAL;
    if (!length_good(len) || !paris_check_field_wholly(dest, len, "dest"))
        return -1;
    const uint32_t read =
        machine_field_allocate(m, machine_vpset_current(m), len, MACHINE_STACK);
    if (read == MACHINE_NO_FIELD) {
        paris_fail_machine();
        return failed(ENOMEM);
    }
    int result = -1;
    if (field_bytes_begin(&b, m, read, len, (len + 7) / 8, NULL, false))
        result = fields_read(&b, file, len);
    if (result > 0 && !move_where_active(m, dest, read, len))
        result = failed(EIO);
    machine_field_deallocate_through(m, read);
    return result;
}
