/* geometry.h - VP sets: their geometries, where their processors are in memory, their
 * addresses. */
#ifndef LUTETIA_MACHINE_GEOMETRY_H
#define LUTETIA_MACHINE_GEOMETRY_H

#include "device/device.h"

struct vpset {
    bool used;
    uint16_t generation; /* counts the sets that have had this id */
    int rank;
    int dimensions[MACHINE_AXES_MAX];
    uint64_t count, rows; /* rows: product of all axes but the last */
    int width;            /* the last axis: what vectors run along */
    int halo;             /* columns repeated on both sides of a row */
    size_t pitch;         /* elements from row to row */
    uint64_t ratio;
    int address_bits; /* of a send address */
    struct machine_layout layout;
};

void geometry_make(const struct machine *m, struct vpset *s, const int *dimensions, int rank,
                   const struct machine_layout *layout);
/* Of a set with weights of 1. */
void geometry_layout(const struct machine *m, struct machine_layout *l, const int *dimensions,
                     int rank, enum machine_order order);
/* The position of a processor in a buffer, in elements. */
size_t geometry_place(const struct vpset *s, uint64_t index);
/* The same, and where the row's halo repeats it; returns how many places. */
int geometry_places(const struct vpset *s, uint64_t index, size_t places[3]);
uint64_t geometry_coordinate(const struct vpset *s, int axis, uint64_t index);
/* Of a buffer for one value of that type: its rows, and 16 elements more where they have a
 * halo. */
size_t geometry_bytes(const struct vpset *s, struct machine_type type);
struct rows geometry_rows(const struct vpset *s, struct machine_type type);

#endif
