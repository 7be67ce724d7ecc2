/* memory.h - fields and flags: which values they hold. */
#ifndef LUTETIA_MACHINE_MEMORY_H
#define LUTETIA_MACHINE_MEMORY_H

#include "base/parts.h"
#include "memory/known_addresses.h"
#include "memory/lifetimes.h"
#include "values/graph.h"

/* A part of a field, or a flag, with its value. */
struct slot {
    struct machine_value *value;
    uint32_t offset, bits;   /* within the field; for a flag 0, 1 */
    uint32_t epoch_created;  /* number of evaluations when it was first stored */
    uint32_t epoch_accessed; /* ... at its first access since an evaluation */
    bool overwritten_first;  /* that access overwrote it: it is a temporary */
    uint32_t call_accessed;  /* number of calls at its last access: see lifetimes.c */
};

/* Where an alias has its bits. The first bit of VP r is start + r div parts * outer + r mod
 * parts * inner in the memory of the root. */
struct view {
    uint32_t start, parts, outer, inner;
};

struct field {
    uint32_t base; /* its id */
    uint32_t bits;
    uint32_t room; /* ids from base on that are no other field's */
    int vpset;
    enum machine_region region;
    uint64_t serial;    /* order of allocation */
    struct slot *slots; /* ascending offsets, no overlap; bits in no slot are 0 */
    int slots_count, slots_capacity;
    struct field *root; /* an alias: the field that owns the memory, which is itself no alias */
    struct view view;   /* an alias: where its bits are */
    bool current;       /* an alias: its slots are the valid content */
    struct field *aliases, *next_alias; /* a root: all its aliases */
    struct field *newest; /* a root: the alias that was stored into last, or NULL */
};

struct lazy_overflow {
    uint8_t op; /* a NODE_OVERFLOW_*; NODE_SELECT: a is the bit itself; 0: none */
    struct machine_value *a, *b, *context;
};

/* The flags of a VP set, by the set's id. */
struct flags {
    struct slot of[3]; /* by enum machine_flag */
    struct lazy_overflow overflow;
    /* Since the last evaluation: the first overflow was recorded, it was everybody's, and one
     * had to become a value, because the context had changed. */
    bool overflow_begun, overflow_whole, overflow_needed;
};

/* Fields that were found lately: an id's line is where it is looked for first. Bases are
 * multiples of 64. */
enum { FIELDS_FOUND = 64 };
static inline uint32_t field_line(uint32_t id)
{
    return id / 64 % FIELDS_FOUND;
}

/* Fields and flags. */
struct memory {
    struct flags *flags;   /* by VP set, as many as values->sets */
    struct field **fields; /* ascending base */
    int fields_count, fields_capacity;
    struct field
        *found[FIELDS_FOUND]; /* by field_line(): the one last found there; NULL: none */
    uint32_t next_base;
    uint64_t serial;
    struct lifetimes lifetimes;
    struct known_addresses known;
    struct known_places places;
    struct known_ranks ranks;
};

/* The flags of a VP set that exists. */
static inline struct flags *flags_of(const struct machine *m, const struct vpset *s)
{
    return &m->memory->flags[s - m->values->sets];
}

/* A flag's value, held until the next instruction: evaluations may put another in its place.
 * Overflow: what is recorded is not part of it. */
static inline struct machine_value *flag_held(struct machine *m, int set,
                                              enum machine_flag flag)
{
    return graph_borrow(m, m->memory->flags[set].of[flag].value);
}

/* ---- lifetimes.c ---- */

/* Called when a slot is accessed by the current call. */
static inline void lifetimes_accessed(struct machine *m, struct slot *slot, bool overwrites)
{
    struct lifetimes *l = &m->memory->lifetimes;
    if (!l->noted)
        return;
    if (overwrites && slot->call_accessed && l->calls - slot->call_accessed < LIFETIMES) {
        int32_t bytes = (int32_t)(slot->bits + 7) / 8;
        l->dead[slot->call_accessed % LIFETIMES] += bytes;
        l->dead[l->calls % LIFETIMES] -= bytes;
    }
    slot->call_accessed = l->calls;
}

/* ---- fields.c ---- */

void fields_finish(struct machine *m);
struct field *field_search(struct machine *m, uint32_t id, uint32_t *offset);
/* The field that the id is in; NULL and an error if there is none. */
static inline struct field *field_find(struct machine *m, uint32_t id, uint32_t *offset)
{
    struct field *f = m->memory->found[field_line(id)];
    if (!f || id - f->base >= f->bits)
        return field_search(m, id, offset);
    *offset = id - f->base;
    return f;
}
/* The field that the id is in, or past the end of but not yet in the next; NULL if there is
 * none. */
struct field *field_near(const struct machine *m, uint32_t id, uint32_t *offset);
/* The field that begins at the id; NULL if none does. */
struct field *field_exact(struct machine *m, uint32_t id);
/* Whether the field may have that many bits without overlapping the next field's ids. */
bool field_room(const struct machine *m, const struct field *f, uint32_t bits);
void field_unlink_alias(struct field *alias);
void field_destroy(struct machine *m, struct field *f);
/* Releases the field, and with a root its aliases. An alias's content is lost; to keep it,
 * call alias_settle() before. */
void field_release(struct machine *m, int index);
int field_exact_index(struct machine *m, uint32_t id, enum machine_region region);

/* ---- slots.c ---- */

void slot_set(struct machine *m, struct slot *slot, struct machine_value *v);
/* Whether that very value is the content from the offset on. */
bool field_holds(const struct field *f, uint32_t offset, const struct machine_value *v);
/* The content of [offset, offset + type.width) of a field in all processors. */
struct machine_value *field_content(struct machine *m, struct field *f, uint32_t offset,
                                    uint32_t bits);
enum machine_status field_replace(struct machine *m, struct field *f, uint32_t offset,
                                  struct machine_value *v);
/* Replaces the slots between two bit offsets by these. The field takes over the references
 * to their values. */
void field_slots_put(struct machine *m, struct field *f, uint32_t from, uint32_t to,
                     const struct slot *slots, int count);
struct machine_value *slot_zero(struct machine *m, int width);
/* The first slot that ends beyond offset. Most fields have a single one. */
int slot_search(const struct field *f, uint32_t offset);
static inline int slot_at(const struct field *f, uint32_t offset)
{
    return f->slots_count && offset < f->slots[0].offset + f->slots[0].bits
               ? 0
               : slot_search(f, offset);
}
static inline void slot_accessed(struct machine *m, struct slot *slot, bool overwrites)
{
    lifetimes_accessed(m, slot, overwrites);
    if (slot->epoch_accessed == m->values->epoch)
        return;
    slot->epoch_accessed = m->values->epoch;
    slot->overwritten_first = overwrites && slot->epoch_created != m->values->epoch;
}
/* Writes to `out` which field or flag holds the value; "" if none does. */
void memory_where(const struct machine *m, const struct machine_value *v, char *out,
                  size_t size);
static inline struct slot *slot_exact(const struct field *f, uint32_t offset, uint32_t bits)
{
    int i = slot_at(f, offset);
    return i < f->slots_count && f->slots[i].offset == offset && f->slots[i].bits == bits
               ? &f->slots[i]
               : NULL;
}

/* ---- flags.c ---- */

/* Forgets the recorded overflow. */
void flag_overflow_clear(struct machine *m, struct lazy_overflow *o);
struct machine_value *flag_resolved(struct machine *m, struct vpset *s, enum machine_flag flag);
/* Forgets the recorded overflow, which was never observed. */
void flag_overflow_forget(struct machine *m, struct vpset *s);

/* ---- vpsets.c ---- */

void vpsets_finish(struct machine *m);
/* Makes room for that many sets; id 0 is no set. False: no memory. */
bool vpsets_grow(struct machine *m, int count);
void vpset_release(struct machine *m, struct vpset *s);

#endif
