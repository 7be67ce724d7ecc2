/* across.c - work that looks along the axis that is cut.
 *
 *     blocks         0 1 2 3      a strip: columns of all blocks      0 1      worked on, and put back where it was;
 *     (of two rows)  4 5 6 7                                          4 5      then the next columns
 *                    --------                                         8 9
 *                    8 9 a b                                          c d
 *                    c d e f
 *
 * A strip has as many columns as a block has a share of the set, so no more memory is needed
 * than a block's. Whatever works on it finds whole lines, and needs to know nothing of blocks:
 * of floats the order is that of one piece. */
#include <string.h>

#include "base/errors.h"
#include "sequencers/sequencers.h"

enum { COLUMNS_TOGETHER = 16 };

struct strip {
    struct vpset set;
    size_t column; /* its first */
};

bool sequencers_can_across(const struct machine *m, int set)
{
    return m->settings.near && m->device->is_pocl && sequencers_are_near(m) &&
           m->values->sets[set].rank > 1;
}

static struct strip strip_of(struct machine *m, int set, int column, int columns)
{
    const struct vpset *s = &m->values->sets[set];
    struct strip strip = {.set = *s, .column = (size_t)column};
    int dimensions[MACHINE_AXES_MAX];
    memcpy(dimensions, s->dimensions, sizeof dimensions);
    dimensions[s->rank - 1] = columns;
    geometry_make(m, &strip.set, dimensions, s->rank, &s->layout);
    return strip;
}

/* Where a row of the strip is in its array. */
static char *strip_row(const struct strip *strip, const struct device_buffer *b, uint64_t row,
                       size_t element)
{
    return (char *)b->host + (row * strip->set.pitch + (size_t)strip->set.halo) * element;
}

/* From all blocks' own rows. NULL: error set. */
static struct device_buffer *strip_get(struct machine *m, const struct strip *strip,
                                       const struct machine_value *v)
{
    const struct array_blocks *a = v->buffer->blocks;
    struct device_buffer *b = device_rows_get(m, geometry_rows(&strip->set, v->type));
    for (int i = 0; b && i < a->count; i++) {
        const struct band band = sequencers_band(m, a->set, i);
        const char *from =
            (const char *)a->of[i]->host + (band.at + strip->column) * a->element;
        for (uint64_t row = 0; row < band.set.rows; row++)
            memcpy(strip_row(strip, b, band.row + row, a->element),
                   from + row * band.set.pitch * a->element,
                   (size_t)strip->set.width * a->element);
    }
    return b;
}

/* To each block's rows and ghosts. */
static void strip_put(struct machine *m, const struct strip *strip,
                      const struct device_buffer *b, const struct array_blocks *a)
{
    const struct cut *c = sequencers_cut(m, a->set);
    const struct vpset *local = sequencers_set(m, a->set);
    const uint64_t rows = local->rows / c->height;
    for (int i = 0; i < a->count; i++)
        for (uint64_t row = 0; row < local->rows; row++) {
            const uint64_t plane = (cut_first(c, i) + row / rows) % c->length;
            memcpy((char *)a->of[i]->host +
                       (row * local->pitch + (size_t)local->halo + strip->column) * a->element,
                   strip_row(strip, b, plane * rows + row % rows, a->element),
                   (size_t)strip->set.width * a->element);
        }
}

/* The other end of each row, into its halos. */
static void halos_make(struct machine *m, const struct array_blocks *a)
{
    const struct vpset *local = sequencers_set(m, a->set);
    const size_t halo = (size_t)local->halo * a->element,
                 width = (size_t)local->width * a->element;
    for (int i = 0; i < a->count; i++)
        for (uint64_t row = 0; row < local->rows; row++) {
            char *at = (char *)a->of[i]->host + row * local->pitch * a->element + halo;
            memcpy(at - halo, at + width - halo, halo);
            memcpy(at + width, at, halo);
        }
}

/* Into `out`. */
static enum machine_status strip_work(struct machine *m, const struct strip *strip,
                                      struct machine_value *const *values, int count,
                                      sequencers_work *work, const void *of,
                                      const struct device_buffer *out)
{
    struct device_buffer *in[SEQUENCERS_ARRAYS] = {NULL}, *got = NULL;
    bool good = true;
    for (int i = 0; i < count && good; i++)
        good = !values[i] || (in[i] = strip_get(m, strip, values[i]));
    if (good)
        got = work(m, &strip->set, in, of);
    good = got && !device_settle(m);
    if (good)
        strip_put(m, strip, got, out->blocks);
    for (int i = 0; i < count; i++)
        if (in[i])
            device_buffer_unref(m, in[i]);
    if (got)
        device_buffer_unref(m, got);
    return good ? MACHINE_OK : m->status;
}

struct device_buffer *sequencers_across(struct machine *m, int set, struct machine_type type,
                                        struct machine_value *const *values, int count,
                                        sequencers_work *work, const void *of)
{
    const int width = m->values->sets[set].width,
              share = ((width - 1) / m->sequencers->count / COLUMNS_TOGETHER + 1) *
                      COLUMNS_TOGETHER;
    INVARIANT(count <= SEQUENCERS_ARRAYS && sequencers_can_across(m, set));
    enum machine_status status =
        sequencers_divide_all(m, set, values, count) < 0 ? m->status : device_settle(m);
    struct device_buffer *out = status ? NULL : sequencers_array_full(m, set, type);
    for (int x = 0; out && !status && x < width; x += share) {
        const struct strip strip = strip_of(m, set, x, width - x < share ? width - x : share);
        status = strip_work(m, &strip, values, count, work, of, out);
    }
    if (out && status) {
        device_buffer_unref(m, out);
        return NULL;
    }
    if (out) {
        halos_make(m, out->blocks);
        m->sequencers->run++;
    }
    return out;
}
