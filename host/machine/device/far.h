/* far.h - arrays in the memory of other ranks, and what goes from rank to rank.
 *
 *     rank 0      b->rank 2, b->far 17        the array is number 17 of rank 2
 *
 * The functions of device.h that take an array take such a one, too, but for those that give
 * commands to a device: they send a command, or ask. Here are those that only ranks need. */
#ifndef LUTETIA_MACHINE_DEVICE_FAR_H
#define LUTETIA_MACHINE_DEVICE_FAR_H

#include "device/device.h"

/* An array of that rank, which it gets now, or (_new) when it performs the next command that
 * names it. refs 1; NULL: error set. */
struct device_buffer *device_far_get(struct machine *m, int rank, struct rows rows);
struct device_buffer *device_far_new(struct machine *m, int rank, size_t bytes);

/* Rows of bytes in an array: the first is at `at`. */
struct far_rows {
    size_t at, bytes, pitch;
    uint64_t rows;
};
/* As device_read() and device_write(), of arrays here and elsewhere. */
enum machine_status device_rows_read(struct machine *m, const struct device_buffer *b,
                                     struct far_rows rows, void *out, size_t out_pitch,
                                     const char *what);
enum machine_status device_rows_write(struct machine *m, const struct device_buffer *b,
                                      struct far_rows rows, const void *in, size_t in_pitch,
                                      const char *what);

/* Rank 0: bytes of an array to another one, of which one at least is another rank's. They are
 * on their way until device_moves_end(). */
enum machine_status device_move_far(struct machine *m, const struct device_buffer *from,
                                    size_t from_at, const struct device_buffer *to,
                                    size_t to_at, size_t bytes);
/* Bytes of an array here to another rank, and from it. */
enum machine_status device_move_out(struct machine *m, const struct device_buffer *b, size_t at,
                                    size_t bytes, int rank);
enum machine_status device_move_in(struct machine *m, const struct device_buffer *b, size_t at,
                                   size_t bytes, int rank);
/* All that this rank sends and takes has gone and come. */
enum machine_status device_moves_end(struct machine *m);

/* Arrays of a rank above 0, by the numbers that rank 0 gave them. far_table_of(): NULL: there
 * is none. */
struct far_table {
    struct device_buffer **arrays;
    uint64_t count;
};
struct device_buffer *far_table_of(const struct far_table *t, uint64_t number);
void far_table_put(struct far_table *t, uint64_t number, struct device_buffer *b);
void far_table_drop(struct machine *m, struct far_table *t, uint64_t number);
void far_table_empty(struct machine *m, struct far_table *t);

/* What device_fill() and its like do with such an array. */
enum machine_status device_far_fill(struct machine *m, const struct device_buffer *b,
                                    const void *pattern, size_t pattern_bytes);
enum machine_status device_far_copy(struct machine *m, const struct device_buffer *from,
                                    const struct device_buffer *to, size_t bytes);
enum machine_status device_far_read(struct machine *m, const struct device_buffer *b,
                                    struct far_rows rows, void *out, size_t out_pitch);
enum machine_status device_far_write(struct machine *m, const struct device_buffer *b,
                                     struct far_rows rows, const void *in, size_t in_pitch);
void device_far_end(struct device_buffer *b);
/* The error of a child after fork(), which is no rank; else nothing. */
enum machine_status device_far_begin(struct machine *m);

#endif
