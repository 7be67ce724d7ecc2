/* machine_saved.h - what a machine consists of, to be saved and made again: numbers, VP sets'
 * flags, fields with their ids, their parts and aliases.
 *
 *     struct machine_saved_field f;
 *     for (int i = 0; machine_field_saved (m, i, &f); i++)
 *         for (int k = 0; k < f.parts_count; k++)
 *             ... machine_part_saved (m, f.base, k, &part); machine_field_download (m, f.base + part.offset, part.type, ...)
 *
 * Into a machine that machine_empty() has emptied, with VP sets of the same ids, the same is
 * put back by machine_field_restore() in the order of bases, and uploads.
 *
 * Errors: as machine.h. What is put back is looked at: MACHINE_BAD_ARGUMENT where it is no
 * machine's. Threads: as machine.h. */
#ifndef LUTETIA_MACHINE_SAVED_H
#define LUTETIA_MACHINE_SAVED_H

#include "machine.h"

/* What later calls depend on beside fields and sets. */
struct machine_saved_numbers {
    uint64_t random_seed, random_draws;
    uint64_t next_field; /* the id that the next field may get */
    uint64_t next_order; /* of allocation */
};
void machine_numbers_saved(const struct machine *m, struct machine_saved_numbers *out);
enum machine_status machine_numbers_restore(struct machine *m,
                                            const struct machine_saved_numbers *n);

struct machine_saved_field {
    uint32_t base, bits, room;
    int vpset;
    enum machine_region region;
    uint64_t order;   /* of allocation */
    uint32_t root;    /* an alias: the field whose memory it is; else 0 */
    uint32_t view[4]; /* an alias: where its bits are (struct view) */
    int parts_count;  /* 0 of aliases */
};
/* The i-th field by base. What was stored through its aliases is in it, and in none of them.
 * False: there are not so many, or an error that machine_status_last() tells. */
bool machine_field_saved(struct machine *m, int i, struct machine_saved_field *out);
/* Bits outside of all parts are 0. A value that is the same in all processors is `constant`,
 * and `number`. */
struct machine_saved_part {
    uint32_t offset;
    struct machine_type type;
    bool constant;
    struct machine_scalar number;
};
/* False: there is no such part. */
bool machine_part_saved(struct machine *m, uint32_t field, int k,
                        struct machine_saved_part *out);

/* Whether the field can be put back behind those that are there: its set and root exist, its
 * ids and bits are nobody else's. */
enum machine_status machine_field_restore(struct machine *m,
                                          const struct machine_saved_field *f);
enum machine_status machine_part_restore(struct machine *m, uint32_t field,
                                         const struct machine_saved_part *part,
                                         const void *array);
enum machine_status machine_flag_upload(struct machine *m, int vpset, enum machine_flag flag,
                                        const uint8_t *in);

#endif
