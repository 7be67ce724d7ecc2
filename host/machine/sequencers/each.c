/* each.c - the same work for each block, with its arrays: see sequencers.h. */
#include "base/errors.h"
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

struct device_buffer *sequencers_each(struct machine *m, int set, struct machine_type type,
                                      struct machine_value *const *values, int count,
                                      sequencers_work *work, const void *of)
{
    struct device_buffer *in[SEQUENCERS_ARRAYS], *got;
    INVARIANT(count <= SEQUENCERS_ARRAYS);
    const int valid = sequencers_divide_all(m, set, values, count);
    struct device_buffer *out = valid < 0 ? NULL : sequencers_array(m, set, type);
    if (!out)
        return NULL;
    out->blocks->valid = valid;
    for (int block = 0; block < m->sequencers->count; block++) {
        for (int i = 0; i < count; i++)
            in[i] = values[i] ? values[i]->buffer->blocks->of[block] : NULL;
        got = work(m, sequencers_set(m, set), in, of);
        if (!got) {
            device_buffer_unref(m, out);
            return NULL;
        }
        sequencers_array_gets(out, block, got);
    }
    m->sequencers->run++;
    return out;
}
