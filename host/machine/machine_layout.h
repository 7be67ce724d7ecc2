/* machine_layout.h - where virtual processors live: which of them a physical processor has, and
 * what their send addresses are.
 *
 * With P physical processors and R = ceil(count / P) virtual ones to each, a send address is
 * processor * R + VP, and a processor's virtual ones follow each other in its memory. There are
 * three layouts:
 *
 *     send order   the address is the row-major index
 *     subgrids     NEWS order where all lengths are powers of two, as the CM-2 demanded: each
 *                  physical processor has a block, which is 2^subgrid[a] long on axis a. The
 *                  blocks along axis a are numbered in Gray code (an axis in send order: in
 *                  binary) in node[a] bits of the processor's number. In the processor's
 *                  number, and in the VP's, the last axis has the lowest bits.
 *     dealt        NEWS order with any other length: the processor of row-major index n is VP
 *                  n div P of processor n mod P
 *
 * Geometries of as many processors have the same addresses, if P divides their number or none
 * is dealt.
 */
#ifndef LUTETIA_MACHINE_LAYOUT_H
#define LUTETIA_MACHINE_LAYOUT_H

#include <stdbool.h>
#include <stdint.h>

struct machine;
struct machine_value;

#define MACHINE_AXES_MAX 31

enum machine_order { MACHINE_NEWS_ORDER, MACHINE_SEND_ORDER };

/* Bits of an index that follow each other in the address, too. */
struct machine_layout_bits {
    uint8_t in_index, in_address, bits, gray;
};

struct machine_layout {
    enum machine_order order;
    bool powers; /* all lengths are powers of two */
    bool blocks; /* subgrids */
    uint64_t count, ratio, processors;
    /* With powers: bits of each axis. In send order the last axis is filled first. */
    uint8_t subgrid[MACHINE_AXES_MAX], node[MACHINE_AXES_MAX];
    int parts_count;
    struct machine_layout_bits parts[2 * MACHINE_AXES_MAX + 1];
};

/* lengths: 1 or more each, a product below 2^31. weights NULL: all 1; orders NULL: all in NEWS
 * order. Block sides double where that saves most: on the axis of the greatest weight / side;
 * among equals the one of most blocks, then the first. */
void machine_layout_make(struct machine_layout *l, const int *lengths, const int *weights,
                         const uint8_t *orders, int rank, uint64_t processors);
/* Whether each index has the same address by both. */
bool machine_layouts_equal(const struct machine_layout *a, const struct machine_layout *b);
uint64_t machine_layout_address(const struct machine_layout *l, uint64_t index);
/* UINT64_MAX: nobody lives at the address. */
uint64_t machine_layout_index(const struct machine_layout *l, uint64_t address);
/* The same of values of 32 bits, for subgrids. What is no index or address gives none. */
struct machine_value *machine_layout_address_value(struct machine *m,
                                                   const struct machine_layout *l,
                                                   struct machine_value *index);
struct machine_value *machine_layout_index_value(struct machine *m,
                                                 const struct machine_layout *l,
                                                 struct machine_value *address);
/* The addresses of the current set with that coordinate along the axis, where they are each
 * processor's own but for some bits, and so is the coordinate. Gets by them are recognised.
 * NULL, without an error: it is not known that they are. */
struct machine_value *machine_address_turned(struct machine *m,
                                             const struct machine_layout *layout,
                                             struct machine_value *address, int axis,
                                             struct machine_value *coordinate);
/* These addresses are those of these indices, by this layout. A send by them may then be
 * recognised. */
void machine_layout_note(struct machine *m, const struct machine_layout *layout,
                         struct machine_value *index, struct machine_value *address);

#endif
