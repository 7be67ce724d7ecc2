/* state_driver.c - an HDF5 driver that reads from an open descriptor, or writes to one.
 *
 * HDF5's own drivers open files by name. The reader of states may not open files any more
 * when HDF5 reads the first byte, so it uses this driver, which reads by pread() and refuses
 * to write.
 *
 * The writer uses it because some builds of HDF5 end the program when they close a file that
 * could not be written. The driver notes the first error (struct state_writing), writes no
 * more, and tells HDF5 that all is well. The writer looks at the error when the file is closed.
 */
#include "states/hdf5_library.h"
#include "states/state_internal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The driver's own access property. writing: NULL where the file is read. */
struct driver_access {
    int descriptor;
    struct state_writing *writing;
};

struct driver_file {
    H5FD_t pub; /* HDF5's; first */
    struct driver_access of;
    haddr_t end, allocated;
};

static H5FD_t *driver_open(const char *name, unsigned flags, hid_t access, haddr_t most)
{
    (void)name;
    (void)most;
    struct stat status;
    const struct driver_access *of = hdf5.Pget_driver_info(access);
    struct driver_file *file =
        of && (of->writing || !(flags & H5F_ACC_RDWR)) ? calloc(1, sizeof *file) : NULL;
    if (!file || fstat(of->descriptor, &status) != 0) {
        free(file);
        return NULL;
    }
    file->of = *of;
    file->end = (haddr_t)status.st_size;
    return &file->pub;
}

static herr_t driver_close(H5FD_t *file)
{
    free(file);
    return 0;
}

/* What is written lies as HDF5's own drivers let it lie. */
static herr_t driver_query(const H5FD_t *file, unsigned long *flags)
{
    const bool writes = file && ((const struct driver_file *)file)->of.writing;
    *flags = writes ? H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA |
                          H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA
                    : 0;
    return 0;
}

static haddr_t driver_allocated(const H5FD_t *file, H5FD_mem_t type)
{
    (void)type;
    return ((const struct driver_file *)file)->allocated;
}

static herr_t driver_allocate(H5FD_t *file, H5FD_mem_t type, haddr_t end)
{
    (void)type;
    ((struct driver_file *)file)->allocated = end;
    return 0;
}

static haddr_t driver_end(const H5FD_t *file, H5FD_mem_t type)
{
    (void)type;
    return ((const struct driver_file *)file)->end;
}

/* Bytes beyond the file's end read as zeros, as HDF5 expects of its drivers. */
static herr_t driver_read(H5FD_t *file, H5FD_mem_t type, hid_t how, haddr_t at, size_t count,
                          void *bytes)
{
    (void)type;
    (void)how;
    int descriptor = ((const struct driver_file *)file)->of.descriptor;
    if (at > INT64_MAX - count)
        return -1;
    for (size_t done = 0; done < count;) {
        char *to = (char *)bytes + done;
        ssize_t more = pread(descriptor, to, count - done, (off_t)(at + done));
        if (more < 0 && errno == EINTR)
            continue;
        if (more < 0)
            return -1;
        if (more == 0) {
            memset(to, 0, count - done);
            break;
        }
        done += (size_t)more;
    }
    return 0;
}

static herr_t driver_write(H5FD_t *file, H5FD_mem_t type, hid_t how, haddr_t at, size_t count,
                           const void *bytes)
{
    (void)type;
    (void)how;
    struct driver_file *f = (struct driver_file *)file;
    struct state_writing *writing = f->of.writing;
    if (!writing || at > INT64_MAX - count)
        return -1;
    for (size_t done = 0; done < count && writing->error == 0;) {
        errno = 0;
        ssize_t more = pwrite(f->of.descriptor, (const char *)bytes + done, count - done,
                              (off_t)(at + done));
        if (more > 0)
            done += (size_t)more;
        else if (errno != EINTR)
            writing->error = errno ? errno : EIO;
    }
    f->end = at + count > f->end ? at + count : f->end;
    return 0;
}

/* HDF5 calls it before it closes: the file ends where what it has given out ends. */
static herr_t driver_truncate(H5FD_t *file, hid_t how, hbool_t closing)
{
    (void)how;
    (void)closing;
    struct driver_file *f = (struct driver_file *)file;
    struct state_writing *writing = f->of.writing;
    if (!writing || f->end == f->allocated)
        return 0;
    if (writing->error == 0 && ftruncate(f->of.descriptor, (off_t)f->allocated) != 0)
        writing->error = errno;
    f->end = f->allocated;
    return 0;
}

/* Access properties for the driver on that descriptor; negative if there is none. */
static hid_t access_make(const struct driver_access *of)
{
    static const H5FD_class_t driver = {
#ifdef H5FD_CLASS_VERSION /* since 1.14 */
        .version = H5FD_CLASS_VERSION,
        .value = H5_VFD_RESERVED, /* the first that is not the library's own */
#endif
        .name = "descriptor",
        .maxaddr = INT64_MAX,
        .fc_degree = H5F_CLOSE_WEAK,
        .fapl_size = sizeof(struct driver_access),
        .open = driver_open,
        .close = driver_close,
        .query = driver_query,
        .get_eoa = driver_allocated,
        .set_eoa = driver_allocate,
        .get_eof = driver_end,
        .read = driver_read,
        .write = driver_write,
        .truncate = driver_truncate,
        .fl_map = H5FD_FLMAP_SINGLE,
    };
    hid_t number = hdf5.FDregister(&driver),
          access = hdf5.Pcreate(*hdf5.P_CLS_FILE_ACCESS_ID_g);
    return number < 0 || access < 0 || hdf5.Pset_driver(access, number, of) < 0 ? -1 : access;
}

/* The driver does not look at the name. It is absolute because HDF5 2 asks for the current
 * folder otherwise, and readers may not ask. */
static const char NAME[] = "/state";

int64_t state_file_open(int descriptor)
{
    hid_t access = access_make(&(struct driver_access){.descriptor = descriptor});
    return access < 0 ? -1 : hdf5.Fopen(NAME, H5F_ACC_RDONLY, access);
}

int64_t state_file_create(int descriptor, struct state_writing *writing, int64_t how)
{
    hid_t access =
        access_make(&(struct driver_access){.descriptor = descriptor, .writing = writing});
    if (access < 0)
        return -1;
    hdf5.Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
    hid_t file = hdf5.Fcreate(NAME, H5F_ACC_TRUNC, how, access);
    hdf5.Pclose(access);
    return file;
}
