/* <cm/cmfs.h> - files of the machine: fields to and from files in parallel.
 *
 *     int file = CMFS_open("heat.cm", CMFS_O_RDWR | CMFS_O_CREAT | CMFS_O_TRUNC, 0644);
 *     if (file < 0 || CMFS_write_file_always(file, heat, 32) != 32)
 *         CMFS_perror("heat.cm");
 *     CMFS_close(file);
 *
 * A write appends, where the file stands, a value of each processor of the current VP set, in
 * row-major order of its coordinates: `len` bits as (len + 7) / 8 bytes, the lowest first, with
 * zeros in the bits that are left. A read is the same way back. Files are files of this
 * computer: other programs read them, and `lutetia/fields.h` has formats that tell their shape.
 *
 * Which of these names are those of 1990 and which are our own: docs/files.md.
 *
 * Errors: a call that fails returns -1, and CMFS_errno says why, as errno does; CMFS_perror()
 * prints it. A wrong call (a field that is none) is also explained to the error handler, as in
 * <cm/paris.h>, with CMFS_errno EINVAL. Ownership: files belong to the library; descriptors
 * name them until they are closed. Threads: all calls belong to the thread that makes the calls
 * of <cm/paris.h>. */
#ifndef CM_CMFS_H
#define CM_CMFS_H

#include <cm/paris.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CMFS_O_RDONLY 0
#define CMFS_O_WRONLY 1
#define CMFS_O_RDWR 2
#define CMFS_O_APPEND 8
#define CMFS_O_CREAT 512
#define CMFS_O_TRUNC 1024
#define CMFS_O_EXCL 2048

#define CMFS_L_SET 0  /* from the beginning */
#define CMFS_L_INCR 1 /* from where the file stands */
#define CMFS_L_XTND 2 /* from the end */

/* Why the last call failed. */
extern int CMFS_errno;

/* Opens a file; with CMFS_O_CREAT a third argument, the mode of a new one, is expected. Returns
 * a descriptor, 0 or more. Errors: -1 (a name that leads to a device, a pipe or a folder is
 * EINVAL). */
extern int CMFS_open(const char *path, int flags, ...);
/* Errors: -1 where what was written is not on the disk; the descriptor is free all the same. */
extern int CMFS_close(int file);
/* Prints "what: why the last call failed". Never fails. */
extern void CMFS_perror(const char *what);

/* Writes `len` bits of a field of all processors. Returns len. Errors: -1; the file then stands
 * where it stood. */
extern int CMFS_write_file_always(int file, CM_field_id_t source, unsigned int len);
/* Reads `len` bits into a field of all processors. Returns len; 0 at the end of the file.
 * Errors: -1; the field is as it was. */
extern int CMFS_read_file_always(int file, CM_field_id_t dest, unsigned int len);
/* The same, but inactive processors keep what they have; the file has values for them, too. */
extern int CMFS_read_file(int file, CM_field_id_t dest, unsigned int len);
/* Moves by values of `len` bits of all processors of the current VP set. Returns the place in
 * bytes. */
extern long CMFS_lseek(int file, long values, unsigned int len, int whence);

/* ---- bytes, from and to the front end ---- */

/* Return the bytes written and read. */
extern long CMFS_serial_write_file(int file, const void *bytes, unsigned long count);
extern long CMFS_serial_read_file(int file, void *bytes, unsigned long count);
/* Moves by bytes. Returns the place in bytes. */
extern long CMFS_serial_lseek(int file, long bytes, int whence);
/* Removes a file's name. */
extern int CMFS_unlink(const char *path);

#ifdef __cplusplus
}
#endif

#endif
