/* plan_run.c - runs plans: gets buffers for the results, and launches the kernels. */
#include <math.h>

#include "base/errors.h"
#include "device/call.h"
#include "kernels.h"
#include "plans/background.h"
#include "plans/plans.h"

size_t plan_run_columns(const struct machine *m, int vector)
{
    size_t run = (size_t)m->device->shape.run_columns, lanes = (size_t)vector;
    return (run + lanes - 1) / lanes * lanes;
}

static size_t shared_by(size_t all, size_t parts)
{
    return (all + parts - 1) / parts;
}

size_t plan_tiles_across(const struct vpset *set, int tile_width)
{
    return shared_by((size_t)set->width, (size_t)tile_width);
}

bool plan_in_place_wanted(const struct machine *m, const struct plan *p)
{
    const struct launch *l = &p->launches[0];
    return p->launches_count == 1 && l->in_place.pairs_count &&
           (m->settings.in_place == SETTING_FREE ? l->in_place.pays : m->settings.in_place);
}

static cl_int set_number(cl_kernel kernel, cl_uint at, uint64_t bits, uint8_t size)
{
    uint32_t low = (uint32_t)bits;
    return size == 8 ? clSetKernelArg(kernel, at, 8, &bits)
                     : clSetKernelArg(kernel, at, 4, &low);
}

static cl_int set_constant(cl_kernel kernel, cl_uint at, const struct machine_value *v,
                           const struct kernel_argument *a)
{
    uint64_t bits = a->kind == ARGUMENT_SECOND ? v->imm.hi : v->imm.lo;
    if (a->size == 4 && v->type.kind == MACHINE_BITS && v->type.width == 1)
        bits = bits ? UINT32_MAX : 0;
    return set_number(kernel, at, bits, a->size);
}

/* Chooses the number of strips and their rows for the shortest time. The time is that of the
 * unit with most strips: the rows of these strips, with half of the margin on average, and a
 * tenth of a strip until the last unit begins. */
static void strips_count(const struct machine *m, const struct launch *l, const struct vpset *s,
                         size_t global[2], size_t *rows)
{
    size_t units = (size_t)m->device->units,
           most = (size_t)m->device->shape.strips_each * units, height = (size_t)s->rows;
    double soonest = HUGE_VAL;
    global[0] = (size_t)(s->width / l->strip_columns);
    global[0] = global[0] ? global[0] : 1;
    for (size_t down = 1; down <= shared_by(most, global[0]) && down <= height; down++) {
        size_t each = shared_by(height, down);
        double strips = (double)shared_by(global[0] * shared_by(height, each), units);
        double time = (strips + 0.1) * ((double)each + 0.5 * l->strip_margin);
        if (time < soonest) {
            soonest = time;
            *rows = each;
        }
    }
    global[1] = shared_by(height, *rows);
}

/* Uses the buffers that are no longer needed for values written in place. Returns a bit for
 * each border to copy. */
static uint32_t take_places(const struct machine *m, const struct plan *p,
                            struct device_buffer **buffers, const bool *dies)
{
    const struct launch *l = &p->launches[0];
    size_t global[2], rows;
    uint32_t which = 0;
    if (!dies || !plan_in_place_wanted(m, p))
        return 0;
    strips_count(m, l, &m->values->sets[l->set], global, &rows);
    for (int i = 0; i < l->in_place.pairs_count && global[0] == 1; i++) {
        int output = l->in_place.pairs[i].output, leaf = l->in_place.pairs[i].leaf;
        uint32_t bit = UINT32_C(1) << l->in_place.pairs[i].border;
        if (buffers[output] || which & bit || !dies[leaf] || buffers[leaf]->refs != 1 ||
            buffers[leaf]->blocks)
            continue;
        buffers[output] = buffers[leaf];
        device_buffer_ref(buffers[output]);
        which |= bit;
    }
    return which;
}

static enum machine_status copy_borders(struct machine *m, const struct launch *l,
                                        uint32_t which, const size_t global[2], size_t rows,
                                        const struct device_buffer *to,
                                        struct device_buffer *const *buffers)
{
    const struct vpset *s = &m->values->sets[l->set];
    const struct in_place *in = &l->in_place;
    struct kernel_call c = call_begin(m, kernel_borders_cl, "", "borders");
    uint64_t bytes = 0;
    for (int i = 0; i < in->leaves_count; i++)
        bytes |= (uint64_t)(buffers[in->leaves[i]]->bytes / (s->pitch * (size_t)s->rows))
                 << 4 * i;
    call_uint(&c, s->pitch);
    call_int(&c, (int)s->rows);
    call_int(&c, (int)rows);
    call_int(&c, in->above);
    call_int(&c, in->below);
    call_uint(&c, which);
    call_ulong(&c, bytes);
    call_ulong(&c, global[0] * global[1] * l->strip_bytes);
    call_buffer(&c, to);
    for (int i = 0; i < BORDERS_MOST; i++)
        call_buffer(&c, buffers[in->leaves[i < in->leaves_count ? i : 0]]);
    c.bytes = 0;
    for (int i = 0; i < in->leaves_count; i++)
        if (which >> i & 1)
            c.bytes += 2 * s->pitch * global[1] * (size_t)(in->above + in->below) *
                       (size_t)(bytes >> 4 * i & 15);
    return call_start_3d(&c, m, (size_t)(in->above + in->below), global[1],
                         (size_t)in->leaves_count, "what strips read of each other");
}

/* in_place: which borders are needed: see take_places(). */
static enum machine_status launch(struct machine *m, const struct launch *l,
                                  struct device_buffer *const *buffers,
                                  struct machine_value *const *nodes, uint32_t in_place)
{
    const struct vpset *s = &m->values->sets[l->set];
    struct device_buffer *scratch = NULL;
    size_t run = plan_run_columns(m, l->vector);
    if (l->claims && !device_claims_ready(m))
        return m->status;
    size_t global[2] = {((size_t)s->width + run - 1) / run, (size_t)s->rows},
           local[2] = {(size_t)l->group, 1};
    if (l->group) {
        run = (size_t)l->tile_height;
        global[0] = plan_tiles_across(s, l->tile_width) * local[0];
        global[1] = shared_by(s->rows, run);
    }
    if (l->strip_bytes) {
        strips_count(m, l, s, global, &run);
        size_t borders = (size_t)(l->in_place.above + l->in_place.below) * s->pitch *
                         (size_t)l->in_place.bytes;
        scratch = device_buffer_get(m, global[0] * global[1] *
                                           (l->strip_bytes + (in_place ? borders : 0)));
        if (!scratch)
            return m->status;
        enum machine_status status =
            in_place ? copy_borders(m, l, in_place, global, run, scratch, buffers) : MACHINE_OK;
        if (status) {
            device_buffer_unref(m, scratch);
            return status;
        }
    }
    const int claim = l->claims ? device_claim(m->device, global[0] * global[1]) : 0;
    cl_kernel kernel = l->kernel->cl;
    cl_int fixed[5] = {s->width, (cl_int)s->pitch, (cl_int)run, m->values->processors_log2,
                       (cl_int)s->ratio};
    cl_uint at = 0;
    cl_int error = CL_SUCCESS;
    for (int i = 0; i < 5; i++)
        error |= clSetKernelArg(kernel, at++, sizeof(cl_int), &fixed[i]);
    for (int a = 0; a < s->rank - 1; a++)
        error |= clSetKernelArg(kernel, at++, sizeof(cl_int), &s->dimensions[a]);
    if (l->strip_bytes)
        error |= clSetKernelArg(kernel, at++, sizeof(cl_int), &l->strip_columns);
    for (int i = 0; i < l->arguments_count; i++, at++) {
        const struct kernel_argument *a = &l->arguments[i];
        if (a->kind == ARGUMENT_SCRATCH)
            error |= device_argument(kernel, at, scratch);
        else if (a->kind == ARGUMENT_CLAIMS)
            error |= clSetKernelArg(kernel, at, sizeof(cl_mem), &m->device->claims.memory);
        else if (a->kind == ARGUMENT_CLAIM)
            error |= clSetKernelArg(kernel, at, sizeof claim, &claim);
        else if (a->kind == ARGUMENT_BORDERS)
            error |= clSetKernelArg(kernel, at, sizeof(cl_uint), &in_place);
        else if (a->kind == ARGUMENT_NUMBER)
            error |= set_number(kernel, at, a->number, a->size);
        else if (a->kind == ARGUMENT_INPUT || a->kind == ARGUMENT_OUTPUT)
            error |= device_argument(kernel, at, buffers[a->node]);
        else
            error |= set_constant(kernel, at, nodes[a->node], a);
    }
    if (m->watch)
        watch_launch(m, l->note);
    enum machine_status status = device_launch(
        m, l->kernel, error, 2, global, l->group ? local : NULL, "a kernel cannot be started");
    if (claim && !status)
        device_claimed(m->device);
    if (scratch)
        device_buffer_unref(m, scratch); /* the queue is in order */
    return status;
}

/* By the device's own interpreter. What it costs is known from the cost model alone, since
 * nobody waits for it. */
static enum machine_status interpret_on_device(struct machine *m, struct plan *p,
                                               const struct launch *l,
                                               struct device_buffer *const *buffers,
                                               struct machine_value *const *nodes)
{
    const struct vpset *set = &m->values->sets[l->set];
    p->spent_s += device_code_time_s(m, l->code, set);
    m->plans->interpreted++;
    if (m->watch)
        watch_launch(m, l->note);
    return device_code_run(m, l->code, set, buffers, nodes);
}

/* On the front end's own thread, when the device has done what came before. */
static enum machine_status interpret(struct machine *m, struct plan *p, const struct launch *l,
                                     struct device_buffer *const *buffers,
                                     struct machine_value *const *nodes)
{
    enum machine_status status = device_settle(m);
    if (status)
        return status;
    const struct vpset *set = &m->values->sets[l->set];
    const double lane_s =
        l->program->lane_s + 1e-9 * m->device->shape.near_byte_ns * l->program->lane_bytes;
    int parts = device_parts(m, lane_s * (double)set->count);
    if (parts > 1)
        device_stays_awake(m);
    double start = clock_s();
    m->inside++;
    bool good =
        blocks_run(&m->plans->room, m->device->crew, parts, l->program, set, buffers, nodes);
    m->inside--;
    double spent = clock_s() - start;
    m->device->busy_s += spent;
    p->spent_s += spent;
    if (p->family) {
        p->family->spent_s += spent;
        p->family->started++;
    }
    m->plans->interpreted++;
    if (m->watch)
        watch_interpreted(m, l->note, start);
    return good ? MACHINE_OK
                : machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to interpret a plan");
}

/* Returns a spare buffer for a plan's only kernel to write over, so that the caches hold one
 * array less. With several kernels, one could fail after another has overwritten the buffer,
 * and the calls could no longer be performed one by one. NULL: none. */
static struct device_buffer *spare_get(const struct plan *p, struct rows rows,
                                       const struct fates *fates)
{
    for (int i = 0; fates && p->launches_count == 1 && i < fates->spare_count; i++) {
        struct device_buffer *b = fates->spare[i];
        if (b->refs == 1 && !b->blocks && device_rows_fit(b, rows)) {
            device_buffer_ref(b);
            return b;
        }
    }
    return NULL;
}

/* Gets the arrays that the launch stores. */
static enum machine_status arrays_get(struct machine *m, const struct plan *p, int launch,
                                      struct device_buffer **buffers, const struct fates *fates)
{
    for (int i = 0; i < p->stored_count; i++) {
        struct device_buffer **b = &buffers[p->stored[i]];
        if (p->arrays[i].first != launch || *b)
            continue;
        *b = spare_get(p, p->arrays[i].rows, fates);
        if (!*b && !(*b = device_rows_get(m, p->arrays[i].rows)))
            return m->status;
    }
    return MACHINE_OK;
}

/* Releases arrays that no later launch reads and nobody keeps. A later launch may write
 * there, since the queue is in order. */
static void arrays_let_go(struct machine *m, const struct plan *p, int launch,
                          struct device_buffer **buffers, const bool *kept)
{
    for (int i = 0; i < p->stored_count; i++) {
        struct device_buffer **b = &buffers[p->stored[i]];
        if (p->arrays[i].last == launch && !kept[p->stored[i]] && *b) {
            device_buffer_unref(m, *b);
            *b = NULL;
        }
    }
}

enum machine_status plan_run(struct machine *m, struct plan *p, struct device_buffer **buffers,
                             struct machine_value *const *nodes, const struct fates *fates)
{
    enum machine_status status = MACHINE_OK;
    double start = watch_clock(m);
    for (int i = 0; i < p->stored_count; i++)
        buffers[p->stored[i]] = NULL;
    uint32_t in_place = take_places(m, p, buffers, fates ? fates->dies : NULL);
    for (int i = 0; i < p->launches_count && !status; i++) {
        status = arrays_get(m, p, i, buffers, fates);
        if (!status && p->launches[i].code)
            status = interpret_on_device(m, p, &p->launches[i], buffers, nodes);
        else if (!status && p->launches[i].program)
            status = interpret(m, p, &p->launches[i], buffers, nodes);
        else if (!status)
            status = launch(m, &p->launches[i], buffers, nodes, in_place);
        if (!status && fates)
            arrays_let_go(m, p, i, buffers, fates->kept);
    }
    m->plans->kernels_in_place += in_place && !status;
    m->plans->kernels_in_strips += !status && p->launches_count && p->launches[0].strip_bytes;
    m->plans->kernels_in_tiles += !status && p->launches_count && p->launches[0].group;
    m->plans->predicted_s += status ? 0 : p->predicted_s;
    p->worked += p->work;
    p->runs++;
    if (p->family)
        p->family->said.runs[p->quality]++;
    if (!p->launches_count || !p->launches[0].program || p->launches[0].code)
        device_flush(m);
    if (m->watch)
        watch_span(m, WATCH_LAUNCH, start, "\"kernels\":%d", p->launches_count);
    /* While better kernels are built, the queue has only as many as keep the device busy: all
     * would be old ones. */
    const struct device_shape *shape = &m->device->shape;
    const int ahead = background_busy(m) ? shape->kernels_ahead_building : shape->kernels_ahead;
    status = status ? status : device_pace(m, (uint64_t)ahead);
    for (int i = 0; i < p->stored_count && status; i++) {
        struct device_buffer **b = &buffers[p->stored[i]];
        if (*b)
            device_buffer_unref(m, *b);
        *b = NULL;
    }
    return status;
}
