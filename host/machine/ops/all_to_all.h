/* all_to_all.h - sends and gets between VP sets that are cut into blocks (sequencers/), on the
 * front end's own threads: the same bits as of sets in one piece.
 *
 *     messages    each block that sends sorts its messages by the block that they go to
 *     exchange    all blocks with all: an index in the other block, and the element
 *     delivery    each block takes those of the first block, then those of the next one
 *
 * Blocks are ranges of row-major indices, one after the other. So a block that takes messages
 * in this order takes them in the order of the senders, as one piece does: of two that are
 * written to one processor the same one stays, and floats are added in the same order.
 *
 * Of a get the messages are indices of what is wanted; the elements come back. */
#ifndef LUTETIA_MACHINE_ALL_TO_ALL_H
#define LUTETIA_MACHINE_ALL_TO_ALL_H

#include "ops/message.h"

/* Whether the messages go from block to block: some of what they read is in blocks only, and
 * then all of it is put into blocks where its set is cut. Else it is put together. gets: of a
 * get. far_too: other ranks may have blocks. */
enum machine_status all_to_all_arrange(struct machine *m, const struct message *g, bool gets,
                                       bool far_too, bool *in_blocks);
/* Of messages that were so arranged. NULL: error set. *arrived: bits; NULL: nobody wants to
 * know. */
struct device_buffer *all_to_all_send(struct machine *m, const struct message *g,
                                      enum machine_combiner combiner,
                                      struct device_buffer **arrived);
struct device_buffer *all_to_all_get(struct machine *m, const struct message *g);
/* How many send to a processor that does not exist. */
enum machine_status all_to_all_wrong(struct machine *m, const struct message *g,
                                     uint64_t *wrong);

#endif
