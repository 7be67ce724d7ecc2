/* each.c - the same work for each block, with its arrays: see sequencers.h. */
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "device/far.h"
#include "ranks/ranks.h"
#include "sequencers/sequencers.h"

bool sequencers_have_some(struct machine_value *const *values, int count)
{
    for (int i = 0; i < count; i++)
        if (values[i] && !values[i]->buffer->memory)
            return true;
    return false;
}

int sequencers_divide_all(struct machine *m, int set, struct machine_value *const *values,
                          int count)
{
    int valid = sequencers_cut(m, set)->ghosts;
    for (int i = 0; i < count; i++) {
        if (!values[i])
            continue;
        if (sequencers_divide(m, values[i]->buffer, set, values[i]->type, 0))
            return -1;
        const int of_it = values[i]->buffer->blocks->valid;
        valid = of_it < valid ? of_it : valid;
    }
    return valid;
}

/* Another rank's block: it performs the same work of its arrays. NULL: error set. */
static struct device_buffer *each_far(struct machine *m, int set, struct machine_type type,
                                      struct device_buffer *const *in, int count, int block,
                                      const struct sequencers_told *told)
{
    struct each_head head = {{0}};
    struct device_buffer *out =
        device_far_new(m, block, geometry_rows(sequencers_set(m, set), type).bytes);
    unsigned char *all = out ? malloc(sizeof head + told->bytes) : NULL;
    if (!out)
        return NULL;
    NEEDS_MEMORY(all);
    for (int i = 0; i < count; i++)
        head.in[i] = in[i] ? in[i]->far : 0;
    memcpy(all, &head, sizeof head);
    memcpy(all + sizeof head, told->of, told->bytes);
    const struct ranks_command c = {RANKS_EACH,
                                    (uint32_t)sizeof head + told->bytes,
                                    {(uint64_t)told->kind, (uint64_t)set, out->far}};
    ranks_command(block, c, all);
    free(all);
    return out;
}

struct device_buffer *sequencers_each(struct machine *m, int set, struct machine_type type,
                                      struct machine_value *const *values, int count,
                                      sequencers_work *work, const void *of,
                                      const struct sequencers_told *told)
{
    struct device_buffer *in[SEQUENCERS_ARRAYS], *got;
    const bool far = m->sequencers->far;
    const int blocks = m->sequencers->count;
    INVARIANT(count <= SEQUENCERS_ARRAYS && (!far || told));
    const int valid = sequencers_divide_all(m, set, values, count);
    struct device_buffer *out = valid < 0 ? NULL : sequencers_array(m, set, type);
    if (!out)
        return NULL;
    out->blocks->valid = valid;
    for (int n = 0; n < blocks; n++) {
        const int block = far ? blocks - 1 - n : n; /* that of this process last */
        for (int i = 0; i < count; i++)
            in[i] = values[i] ? values[i]->buffer->blocks->of[block] : NULL;
        if (far && !block)
            ranks_flush();
        got = far && block ? each_far(m, set, type, in, count, block, told)
                           : work(m, sequencers_set(m, set), in, of);
        if (!got) {
            device_buffer_unref(m, out);
            return NULL;
        }
        sequencers_array_gets(out, block, got);
    }
    m->sequencers->run++;
    return out;
}
