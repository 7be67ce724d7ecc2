/* state_driver.c - an HDF5 driver that reads from an open descriptor.
 *
 * HDF5's own drivers open files by name. The reader of states may not open files any more
 * when HDF5 reads the first byte, so it uses this driver, which reads by pread(). All other
 * operations fail.
 */
#include "states/hdf5_library.h"
#include "states/state_internal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct driver_file {
    H5FD_t pub; /* HDF5's; first */
    int descriptor;
    haddr_t end, allocated;
};

static H5FD_t *driver_open(const char *name, unsigned flags, hid_t access, haddr_t most)
{
    (void)name;
    (void)most;
    struct stat status;
    const int *descriptor = hdf5.Pget_driver_info(access);
    struct driver_file *file =
        descriptor && !(flags & H5F_ACC_RDWR) ? calloc(1, sizeof *file) : NULL;
    if (!file || fstat(*descriptor, &status) != 0) {
        free(file);
        return NULL;
    }
    file->descriptor = *descriptor;
    file->end = (haddr_t)status.st_size;
    return &file->pub;
}

static herr_t driver_close(H5FD_t *file)
{
    free(file);
    return 0;
}

static herr_t driver_query(const H5FD_t *file, unsigned long *flags)
{
    (void)file;
    *flags = 0;
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
    int descriptor = ((const struct driver_file *)file)->descriptor;
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
    (void)file;
    (void)type;
    (void)how;
    (void)at;
    (void)count;
    (void)bytes;
    return -1;
}

int64_t state_file_open(int descriptor)
{
    static const H5FD_class_t driver = {
#ifdef H5FD_CLASS_VERSION /* since 1.14 */
        .version = H5FD_CLASS_VERSION,
        .value = H5_VFD_RESERVED, /* the first that is not the library's own */
#endif
        .name = "descriptor",
        .maxaddr = INT64_MAX,
        .fc_degree = H5F_CLOSE_WEAK,
        .fapl_size = sizeof(int),
        .open = driver_open,
        .close = driver_close,
        .query = driver_query,
        .get_eoa = driver_allocated,
        .set_eoa = driver_allocate,
        .get_eof = driver_end,
        .read = driver_read,
        .write = driver_write,
        .fl_map = H5FD_FLMAP_SINGLE,
    };
    hid_t number = hdf5.FDregister(&driver),
          access = hdf5.Pcreate(*hdf5.P_CLS_FILE_ACCESS_ID_g);
    if (number < 0 || access < 0 || hdf5.Pset_driver(access, number, &descriptor) < 0)
        return -1;
    return hdf5.Fopen("state", H5F_ACC_RDONLY, access);
}
