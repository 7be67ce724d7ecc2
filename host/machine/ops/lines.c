/* lines.c - lines of elements: scanned, and filled, by the front end or by kernels/scan.cl.
 * Long lines are divided into runs. For floats machine_scan() specifies the length of a run;
 * else the device does. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/errors.h"
#include "kernels.h"
#include "memory/memory.h"
#include "ops/near.h"
#include "ops/near_lines.h"
#include "ops/near_links.h"
#include "ops/near_loops.h"
#include "ops/scan.h"

enum { RUN_FLOATS = 512, LANES = 16 };
enum { JOINS, FINISHES, FILLS };

const struct element lines_elements[] = {
    [LINES_UINT32] = {"uint", "int", 0, 4},      [LINES_UINT64] = {"ulong", "long", 0, 8},
    [LINES_UINT128] = {"ulong2", "long", 2, 16}, [LINES_FLOAT32] = {"float", "int", 1, 4},
    [LINES_FLOAT64] = {"double", "long", 1, 8},
};

struct lines lines_of(const struct vpset *s, int axis, bool downward)
{
    struct lines l = {.base = (cl_ulong)s->halo,
                      .inner_stride = s->pitch,
                      .inner = (size_t)s->rows,
                      .outer = 1,
                      .length = s->dimensions[axis],
                      .columns = 1,
                      .width = s->width,
                      .halo = s->halo,
                      .along = axis == s->rank - 1};
    size_t step = 1;
    if (!l.along) {
        l.columns = s->width;
        l.inner = 1;
        for (int a = axis + 1; a < s->rank - 1; a++)
            l.inner *= (size_t)s->dimensions[a];
        l.outer = s->rows / l.inner / (size_t)l.length;
        step = l.inner * s->pitch;
        l.outer_stride = step * (size_t)l.length;
    }
    l.step = (cl_long)step;
    if (downward) {
        l.base += step * (size_t)(l.length - 1);
        l.step = -l.step;
    }
    return l;
}

static struct kernel_call part(struct machine *m, int number, const struct element *e,
                               int lanes)
{
    char options[96];
    snprintf(options, sizeof options, "-DPART=%d -DTYPE=%s -DMASK=%s -DKIND=%d -DLANES=%d",
             number, e->name, e->mask, e->kind, lanes);
    return call_begin(m, kernel_scan_cl, options, "scan");
}

/* How many neighbouring lines a work-item handles. */
static int lanes_of(const struct lines *l, const struct element *e)
{
    return !l->along && l->columns >= LANES && e->kind != 2 ? LANES : 1;
}

static size_t rows_of(const struct lines *l, int lanes)
{
    return l->inner * (((size_t)l->columns + (size_t)lanes - 1) / (size_t)lanes);
}

static int run_of(const struct machine *m, const struct lines *l, const struct element *e)
{
    if (e->kind == 1)
        return RUN_FLOATS;
    if (m->device->shape.scan_run)
        return m->device->shape.scan_run;
    int runs = 4 * m->device->units, run = (l->length - 1) / runs + 1,
        least = m->device->shape.scan_run_least;
    return run < least ? least : run;
}

static enum machine_status scan_runs(struct machine *m, const struct lines *l,
                                     const struct line_scan *j, int run, int runs,
                                     struct device_buffer *totals, struct device_buffer *firsts)
{
    const struct element *e = j->element;
    int lanes = lanes_of(l, e);
    struct kernel_call c = part(m, 0, e, lanes);
    call_lines(&c, l, run);
    call_lines_rows(&c, l);
    const int numbers[] = {(int)j->op, j->exclusive, j->context != NULL, j->bits != NULL,
                           j->starts,  j->backward,  totals != NULL};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        call_int(&c, numbers[i]);
    call_argument(&c, e->bytes, &j->identity);
    call_argument(&c, e->bytes, &j->flip);
    call_argument(&c, e->bytes, &j->cut);
    call_buffer(&c, j->in);
    call_buffer(&c, j->context ? j->context : j->in);
    call_buffer(&c, j->bits ? j->bits : j->in);
    call_buffer(&c, j->out);
    call_buffer(&c, totals ? totals : j->out);
    call_buffer(&c, totals ? firsts : j->out);
    return call_start_3d(&c, m, (size_t)runs, rows_of(l, lanes), l->outer, "scanning");
}

/* Runs a stage: JOINS, FINISHES or FILLS. The last takes what is in sums. */
static enum machine_status scan_stage(struct machine *m, const struct lines *l,
                                      const struct line_scan *j, int stage, int run, int runs,
                                      struct origin from, struct device_buffer *totals,
                                      struct device_buffer *firsts)
{
    const struct element *e = j->element;
    int lanes = stage == FILLS && e->kind == 0 ? lanes_of(l, e) : 1;
    struct kernel_call c = part(m, 1, e, 1);
    call_lines(&c, l, run);
    call_lines_rows(&c, l);
    const int numbers[] = {lanes, stage, runs, (int)j->op, j->sums != NULL};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        call_int(&c, numbers[i]);
    call_argument(&c, e->bytes, &j->identity);
    call_argument(&c, e->bytes, &j->flip);
    call_argument(&c, e->bytes, &j->cut);
    call_ulong(&c, from.base);
    call_ulong(&c, from.inner);
    call_ulong(&c, from.outer);
    call_buffer(&c, j->out);
    call_buffer(&c, totals ? totals : j->out);
    call_buffer(&c, firsts ? firsts : j->out);
    call_buffer(&c, j->sums ? j->sums : j->out);
    if (stage == JOINS)
        return call_start_3d(&c, m, (size_t)l->columns, l->inner * l->outer, 1, "scanning");
    return call_start_3d(&c, m, (size_t)runs, rows_of(l, lanes), l->outer, "scanning");
}

static double elements_of(const struct lines *l)
{
    return (double)lines_count(l) * (double)l->length;
}

/* How many parts to make of lines. Those that are fewer than the threads are cut, and then read
 * twice (near_lines.c): that pays where the threads are at work anyway, and have parts of the
 * line in their caches; else in long loops, or for more threads than two. */
static int parts_of(const struct machine *m, const struct lines *l, const struct line_scan *j)
{
    const struct device_shape *shape = &m->device->shape;
    const size_t threads = (size_t)crew_size(m->device->crew);
    const bool vectors = near_loops_by_vectors(j, (ptrdiff_t)l->step);
    const double ns = vectors ? shape->scan_vector_ns : shape->scan_ns;
    struct crew_costs costs = shape->share;
    if (lines_count(l) < threads)
        costs.asleep = vectors && threads < 3 ? INFINITY : shape->scan_cut_ns;
    return device_parts_at(m, 1e-9 * ns * elements_of(l), &costs);
}

enum machine_status lines_scan(struct machine *m, const struct lines *l,
                               const struct line_scan *j)
{
    const struct element *e = j->element;
    int run = run_of(m, l, e), runs = (l->length - 1) / run + 1;
    double start;
    if (near_begin(m, j->out, &start)) {
        near_lines_scan(m->device->crew, parts_of(m, l, j), l, j, run);
        near_end(m, "scanning", start);
        return MACHINE_OK;
    }
    bool joins = runs > 1 || j->sums;
    size_t count = (size_t)runs * lines_count(l);
    const struct origin none = {0, 0, 0};
    struct device_buffer *totals = joins ? device_buffer_get(m, count * e->bytes) : NULL;
    struct device_buffer *firsts =
        totals ? device_buffer_get(m, count * sizeof(cl_uint)) : NULL;
    enum machine_status status = joins && !firsts ? m->status : MACHINE_OK;
    if (!status)
        status = scan_runs(m, l, j, run, runs, totals, firsts);
    if (!status && joins)
        status = scan_stage(m, l, j, JOINS, run, runs, none, totals, firsts);
    if (!status && runs > 1 && !j->sums)
        status = scan_stage(m, l, j, FINISHES, run, runs, none, totals, firsts);
    if (totals)
        device_buffer_unref(m, totals);
    if (firsts)
        device_buffer_unref(m, firsts);
    device_flush(m);
    return status;
}

enum machine_status lines_sum_up(struct machine *m, struct device_buffer *b, size_t lines,
                                 size_t length)
{
    struct lines l = {.step = 1,
                      .inner_stride = length,
                      .inner = lines,
                      .outer = 1,
                      .length = (cl_int)length,
                      .columns = 1,
                      .width = (cl_int)length,
                      .along = 1};
    struct line_scan j = {.element = &lines_elements[LINES_UINT32],
                          .op = LINES_ADD,
                          .exclusive = true,
                          .cut = {UINT32_MAX, 0},
                          .in = b,
                          .out = b};
    return lines_scan(m, &l, &j);
}

enum machine_status lines_fill(struct machine *m, const struct lines *l,
                               const struct element *e, struct device_buffer *from,
                               struct origin origin, struct device_buffer *out)
{
    /* floats are copied as integers */
    const struct element *same = &lines_elements[e->bytes == 4   ? LINES_UINT32
                                                 : e->bytes == 8 ? LINES_UINT64
                                                                 : LINES_UINT128];
    double start;
    if (near_begin(m, out, &start)) {
        int parts = device_parts(m, 1e-9 * m->device->shape.fill_ns * elements_of(l));
        near_lines_fill(m->device->crew, parts, l, e->bytes, from, origin, out);
        near_end(m, "scanning", start);
        return MACHINE_OK;
    }
    struct line_scan j = {.element = same, .out = out, .sums = from};
    int run = m->device->shape.fill_run, runs = (l->length - 1) / run + 1;
    return scan_stage(m, l, &j, FILLS, run, runs, origin, NULL, NULL);
}

void lines_element_out(void *bytes)
{
    const struct element *e;
    uintptr_t number;
    memcpy(&e, bytes, sizeof e);
    number = (uintptr_t)(e - lines_elements);
    memcpy(bytes, &number, sizeof number);
}

bool lines_element_in(void *bytes)
{
    uintptr_t number;
    memcpy(&number, bytes, sizeof number);
    const struct element *e = &lines_elements[number <= LINES_FLOAT64 ? number : 0];
    memcpy(bytes, &e, sizeof e);
    return number <= LINES_FLOAT64;
}

/* Each block's, by the rank that has it. NULL: error set. */
static struct device_buffer *worked_in_blocks(struct machine *m, struct machine_type type,
                                              struct machine_value *const *values, int count,
                                              const struct lines_job *job)
{
    const int set = m->values->set_current;
    if (sequencers_are_near(m))
        return sequencers_each(m, set, type, values, count, job->work, job->of, NULL);
    void *copy = malloc(job->bytes);
    NEEDS_MEMORY(copy);
    memcpy(copy, job->of, job->bytes);
    if (job->kind != LINES_RANKS)
        lines_element_out(copy);
    const struct sequencers_told told = {(int)job->kind, job->bytes, copy};
    struct device_buffer *out =
        sequencers_each(m, set, type, values, count, job->work, job->of, &told);
    free(copy);
    return out;
}

struct device_buffer *lines_worked(struct machine *m, struct machine_type type,
                                   struct machine_value *const *values, int count, bool across,
                                   const struct lines_job *job)
{
    const int set = m->values->set_current;
    struct device_buffer *arrays[SEQUENCERS_ARRAYS];
    const bool in_blocks = sequencers_have(m, values, count);
    if (in_blocks && !across)
        return worked_in_blocks(m, type, values, count, job);
    if (in_blocks && sequencers_can_across(m, set))
        return sequencers_across(m, set, type, values, count, job->work, job->of);
    INVARIANT(count <= SEQUENCERS_ARRAYS);
    for (int i = 0; i < count; i++) {
        arrays[i] = values[i] ? values[i]->buffer : NULL;
        if (in_blocks && sequencers_whole(m, arrays[i]))
            return NULL;
    }
    return job->work(m, &m->values->sets[set], arrays, job->of);
}

/* ---- the only line of a set in blocks ---- */

/* Blocks begin where runs of floats do, and there are several of these. */
static bool runs_are_whole(const struct cut *c, int count, bool downward)
{
    bool whole = c->length > RUN_FLOATS;
    for (int i = 0; i < count && whole; i++) {
        const uint64_t begin = downward ? c->length - c->first[i + 1] : c->first[i];
        whole = begin % RUN_FLOATS == 0 || begin == c->length;
    }
    return whole;
}

bool lines_can_chain(struct machine *m, const struct line_scan *j, bool downward)
{
    const struct cut *c = sequencers_cut(m, m->values->set_current);
    return m->values->sets[m->values->set_current].rank == 1 && m->settings.near &&
           m->device->is_pocl && sequencers_are_near(m) && c->ghosts > 0 &&
           (j->element->kind != 1 || runs_are_whole(c, m->sequencers->count, downward));
}

/* What each block has of the line, in the order of the scan; returns how many have some. */
static int links_make(struct machine *m, const struct line_scan *j, bool downward,
                      struct machine_value *const in[3], const struct device_buffer *out,
                      struct link *links)
{
    const int set = m->values->set_current, all = m->sequencers->count;
    const uint64_t length = m->values->sets[set].count;
    int count = 0;
    for (int i = 0; i < all; i++) {
        const int block = downward ? all - 1 - i : i;
        const struct band band = sequencers_band(m, set, block);
        if (!band.set.count)
            continue;
        struct link *to = &links[count++];
        *to = (struct link){.scan = *j, .at = band.at};
        to->begin = (int)(downward ? length - band.index - band.set.count : band.index);
        to->end = to->begin + (int)band.set.count;
        to->at += downward ? band.set.count - 1 : 0;
        to->scan.in = in[0]->buffer->blocks->of[block];
        to->scan.context = in[1] ? in[1]->buffer->blocks->of[block] : NULL;
        to->scan.bits = in[2] ? in[2]->buffer->blocks->of[block] : NULL;
        to->scan.out = out->blocks->of[block];
    }
    return count;
}

struct device_buffer *lines_chain(struct machine *m, struct machine_type type,
                                  const struct line_scan *j, bool downward,
                                  struct machine_value *const in[3])
{
    const int set = m->values->set_current;
    struct link links[BLOCKS_MOST];
    if (sequencers_divide_all(m, set, in, 3) < 0 ||
        (in[2] && sequencers_divide(m, in[2]->buffer, set, in[2]->type, 1)))
        return NULL;
    struct device_buffer *out = sequencers_array_full(m, set, type);
    double start;
    if (!out)
        return NULL;
    const struct lines l = lines_of(&m->values->sets[set], 0, downward);
    const int parts = parts_of(m, &l, j), count = links_make(m, j, downward, in, out, links);
    out->blocks->valid = 0;
    bool good = near_begin(m, out->blocks->of[0], &start);
    if (good) {
        good = near_links_scan(m->device->crew, parts, links, count, (ptrdiff_t)l.step,
                               j->element->kind == 1 ? RUN_FLOATS : (l.length - 1) / parts + 1);
        near_end(m, "scanning", start);
    }
    if (!good) {
        device_buffer_unref(m, out);
        if (!m->status)
            machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to scan");
        return NULL;
    }
    m->sequencers->run++;
    return out;
}
