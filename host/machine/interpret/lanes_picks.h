/* lanes_picks.h - picks as loops: a part of fast_loops.h, whose macros it uses.
 *
 * A step's list names keys and values in turn, and what is left. A lane whose index is a key
 * takes its value; of equal keys the first counts. A key is the same in all lanes, but not
 * known before the program runs. Where keys are near one another there is a table of values,
 * and a lane takes what stands at its index; else one key after the other is compared. */
#include "interpret/picks.h"

static u32 key_of(const struct lanes_step *s, void *const *at, int k)
{
    const void *key = at[s->list[2 * k]];
    return s->from.width <= 8    ? *(const u8 *)key
           : s->from.width <= 16 ? *(const u16 *)key
                                 : *(const u32 *)key;
}

struct pick_table {
    u32 first, count; /* of keys; count 0: they are too far from one another */
    const void *values[PICK_MOST + 1];
};

/* Behind those of the keys stands what is left. */
static void pick_table_make(const struct lanes_step *s, void *const *at, struct pick_table *t)
{
    u32 first = UINT32_MAX, last = 0;
    for (int k = 0; k < s->detail; k++) {
        const u32 key = key_of(s, at, k);
        first = key < first ? key : first;
        last = key > last ? key : last;
    }
    t->first = first;
    t->count = last - first < PICK_MOST ? last - first + 1 : 0;
    for (u32 i = 0; i <= t->count; i++)
        t->values[i] = at[s->list[2 * s->detail]];
    for (int k = t->count ? s->detail : 0; k--;)
        t->values[key_of(s, at, k) - first] = at[s->list[2 * k + 1]];
}

#define PICK(T)                                                                                \
    LOOP(pick, T)                                                                              \
    {                                                                                          \
        TO(T);                                                                                 \
        IN(u32, 0, index);                                                                     \
        struct pick_table t;                                                                   \
        pick_table_make(s, at, &t);                                                            \
        const u32 first = t.first, count = t.count;                                            \
        if (count) {                                                                           \
            EACH                                                                               \
            {                                                                                  \
                const u32 k = index[i] - first;                                                \
                d[i] = ((const T *)t.values[k < count ? k : count])[i];                        \
            }                                                                                  \
            return;                                                                            \
        }                                                                                      \
        const T *rest = t.values[0];                                                           \
        EACH d[i] = rest[i];                                                                   \
        for (int k = s->detail; k--;) {                                                        \
            const T *value = at[s->list[2 * k + 1]];                                           \
            const u32 key = key_of(s, at, k);                                                  \
            EACH d[i] = index[i] == key ? value[i] : d[i];                                     \
        }                                                                                      \
    }
PICK(u8) PICK(u16) PICK(u32) PICK(u64) PICK(u128)
