/* explain.c - adds up what watch.c is told, for machine_explain().
 *
 * What became of each value that a program made is told once: it was computed, in the first evaluation that reached
 * it, or it was let go of before any did. Calls that are foreseen make no values; the kernels that they run are
 * counted like all others.
 *
 * A kernel's bound is the time in which the device copies as many bytes as it reads and writes, measured by the
 * same clock on arrays of that size when the explanation is asked for (small arrays stay in the caches, and starting
 * takes its time, for a copy too), or the cost model's time for its operations, whichever is longer. */
#include "watch/watch.h"

#include <stdlib.h>
#include <string.h>

#include "kernels.h"

enum { MEASURED_MOST = 16, COPIES_LEAST = 5, COPIES_MOST = 25, COPY_RUN = 1024 };
#define COPIES_S 0.004
#define COPY_BYTES_MOST (UINT64_C(1) << 30)

struct explain *explain_create(void)
{
    return calloc(1, sizeof(struct explain));
}

void explain_destroy(struct explain *e)
{
    if (!e)
        return;
    for (struct kernel_note *n = e->notes, *next; n; n = next) {
        next = n->next;
        free((void *)(uintptr_t)n->facts.stores);
        free(n->name);
        free(n);
    }
    free(e->kernels);
    free(e);
}

/* ---- calls ---- */

void explain_call(struct explain *e, const char *name, int foreseen, double time_s)
{
    uint32_t h = 2166136261u;
    for (const char *c = name; *c; c++)
        h = (h ^ (unsigned char)*c) * 16777619u;
    int16_t *place;
    for (h %= CALL_NAMES_SIZE;; h = (h + 1) % CALL_NAMES_SIZE) {
        place = &e->calls_hashed[h];
        if (!*place || strcmp(e->calls[*place - 1].name, name) == 0)
            break;
    }
    struct machine_explained *f = &e->facts;
    f->calls_recorded += !foreseen;
    f->calls_foreseen += (uint64_t)foreseen;
    if (!*place) {
        if (f->calls_count == CALL_NAMES_MOST)
            return;
        e->calls[f->calls_count].name = name;
        *place = (int16_t)++f->calls_count;
    }
    struct machine_explained_row *row = &e->calls[*place - 1];
    row->count += !foreseen;
    row->bytes += (uint64_t)foreseen;
    row->time_s += time_s;
}

/* ---- values ---- */

void watch_released(struct machine *m, const struct machine_value *v)
{
    struct explain *e = watch_sums(m);
    if (m->plans->silent || v->told || v->buffer || v->op == NODE_CONSTANT ||
        v->op == NODE_SLICE)
        return;
    e->facts.values_vanished++;
    e->vanished[v->op]++;
}

void watch_overwritten(struct machine *m, const struct machine_value *old,
                       const struct machine_value *new)
{
    if (!m->plans->silent && old != new && !node_is_leaf(old) && !node_is_cheap(old))
        watch_sums(m)->overwritten++;
}

void watch_reached(struct machine *m, struct machine_value *const *nodes, int count, int stored)
{
    struct machine_explained *f = &watch_sums(m)->facts;
    for (int i = 0; i < count; i++)
        if (!nodes[i]->told && !node_is_leaf(nodes[i])) {
            nodes[i]->told = true;
            f->values_computed++;
        }
    f->values_stored += (uint64_t)stored;
}

/* ---- kernels ---- */

struct kernel_note *explain_note(struct explain *e, cl_kernel kernel, const char *name,
                                 int vpset, uint64_t processors)
{
    for (struct kernel_note *n = e->notes; n; n = n->next)
        if (n->kernel == kernel && n->facts.vpset == vpset &&
            n->facts.processors == processors && (!name || strcmp(n->name, name) == 0))
            return n;
    struct kernel_note *n = calloc(1, sizeof *n);
    if (!n || !(n->name = strdup(name ? name : ""))) {
        free(n);
        return NULL;
    }
    n->kernel = kernel;
    n->facts.name = n->name;
    n->facts.vpset = vpset;
    n->facts.processors = processors;
    n->facts.made = "by hand";
    n->next = e->notes;
    e->notes = n;
    return n;
}

void watch_nodes(struct machine *m, struct machine_value *const *nodes,
                 struct machine_value *const *wanted, int wanted_count)
{
    struct explain *e = watch_sums(m);
    e->nodes = nodes;
    e->wanted = wanted;
    e->wanted_count = wanted_count;
    e->parts = 0;
}

void watch_split(struct machine *m)
{
    struct explain *e = watch_sums(m);
    e->parts += e->parts ? 1 : 2;
}

void watch_improved(struct machine *m)
{
    watch_sums(m)->facts.plans_improved++;
}

/* The field or flag that holds the value; "" if none does. */
static void where_of(const struct machine *m, const struct machine_value *v, char *out,
                     size_t size)
{
    static const char *const flags[] = {"context", "test", "overflow"};
    *out = '\0';
    for (int i = 1; i < m->values->sets_count; i++)
        for (int flag = 0; m->values->sets[i].used && flag < 3; flag++)
            if (m->memory->flags[i].of[flag].value == v)
                snprintf(out, size, "%s of VP set %d", flags[flag], i);
    for (int i = 0; i < m->memory->fields_count && !*out; i++)
        for (int k = 0; k < m->memory->fields[i]->slots_count && !*out; k++)
            if (m->memory->fields[i]->slots[k].value == v)
                snprintf(out, size, "field %u",
                         m->memory->fields[i]->base + m->memory->fields[i]->slots[k].offset);
}

/* What was done last, under whatever context. */
static const char *operation_of(const struct plan_graph *g, int node)
{
    const struct plan_node *n = &g->nodes[node];
    while (!n->leaf && !n->constant &&
           (n->op == NODE_SELECT || n->op == NODE_REINTERPRET || n->op == NODE_PACK))
        n = &g->nodes[n->in[n->op == NODE_SELECT ? 1 : 0]];
    return n->leaf ? "copy" : n->constant ? "number" : node_ops[n->op].name;
}

static enum machine_cut why_of(const struct explain *e, const struct plan_graph *g, int node)
{
    for (int i = 0; i < e->wanted_count; i++)
        if (e->wanted[i] == e->nodes[node])
            return MACHINE_CUT_LOOKED_AT;
    if (g->nodes[node].target)
        return MACHINE_CUT_LIVE;
    for (int i = 0; i < g->count; i++) {
        const struct plan_node *n = &g->nodes[i];
        if (n->op == NODE_SHIFT && !n->leaf && n->in[0] == node &&
            n->stage > g->nodes[node].stage)
            return MACHINE_CUT_NEIGHBOURS;
    }
    return MACHINE_CUT_LATER;
}

/* Neighbours' values that a stage computes, which has another for itself or none. */
static int shifts_computed(const struct plan_graph *g, const int *stores, int stores_count,
                           int stage)
{
    int count = 0;
    bool *needed = calloc((size_t)g->count, sizeof *needed);
    for (int i = 0; needed && i < stores_count; i++)
        needed[stores[i]] = g->nodes[stores[i]].stage == stage;
    for (int i = g->count - 1; needed && i >= 0; i--) {
        const struct plan_node *n = &g->nodes[i];
        if (!needed[i] || n->constant || plan_loads(n, stage))
            continue;
        for (int k = 0; k < node_ops[n->op].inputs; k++) {
            int in = plan_input(g, n, k, stage);
            needed[in] = true;
            count += n->op == NODE_SHIFT && !g->nodes[in].constant &&
                     !plan_loads(&g->nodes[in], stage) &&
                     g->nodes[in].generator > GENERATOR_CHEAP;
        }
    }
    free(needed);
    return count;
}

/* "field 64 = FADD, FMUL for neighbours, 3 more" */
static char *name_of(const struct machine_explained_store *stores, int count)
{
    enum { SHOWN = 3 };
    char text[SHOWN * 100 + 20] = "";
    size_t length = 0;
    int shown = 0, all = 0;
    for (int i = 0; i < count; i++) {
        const struct machine_explained_store *s = &stores[i];
        all += !s->in_ring;
        if (s->in_ring || shown == SHOWN)
            continue;
        const char *of = s->why == MACHINE_CUT_NEIGHBOURS ? " for neighbours"
                         : s->why == MACHINE_CUT_LATER    ? " for a later kernel"
                         : *s->where                      ? ""
                                                          : " to look at";
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%s%s%s%s",
                                   shown++ ? ", " : "", s->where, *s->where ? " = " : "",
                                   s->operation, of);
    }
    if (all > SHOWN)
        snprintf(text + length, sizeof text - length, ", %d more", all - SHOWN);
    return strdup(text);
}

static void take_arguments(struct machine_explained_kernel *f, const struct plan_graph *g,
                           const struct kernel_text *k)
{
    for (int i = 0; i < k->arguments_count; i++) {
        const struct kernel_argument *a = &k->arguments[i];
        int bytes = (int)type_bytes(g->nodes[a->node].type);
        if (a->kind == ARGUMENT_INPUT) {
            f->arrays_read++;
            f->bytes_read += bytes;
        } else if (a->kind == ARGUMENT_OUTPUT) {
            f->arrays_written++;
            f->bytes_written += bytes;
        }
    }
}

struct kernel_note *watch_kernel(struct machine *m, cl_kernel kernel,
                                 const struct plan_graph *g, const int *stores,
                                 int stores_count, const struct kernel_text *k,
                                 const char *made)
{
    struct explain *e = watch_sums(m);
    int set = g->nodes[stores[0]].set;
    struct kernel_note *n = /* one that is not there yet is like no other */
        explain_note(e, kernel, kernel ? NULL : "", set, m->values->sets[set].count);
    bool split = e->parts > 0;
    e->parts -= split;
    if (!n || n->facts.generated)
        return n;
    struct machine_explained_store *list = calloc((size_t)stores_count, sizeof *list);
    if (!list)
        return n;
    for (int i = 0; i < stores_count; i++) {
        list[i] = (struct machine_explained_store){.why = why_of(e, g, stores[i]),
                                                   .in_ring =
                                                       g->strips && !g->nodes[stores[i]].target,
                                                   .type = g->nodes[stores[i]].type,
                                                   .operation = operation_of(g, stores[i])};
        where_of(m, e->nodes[stores[i]], list[i].where, sizeof list[i].where);
    }
    char *name = name_of(list, stores_count);
    if (name) {
        free(n->name);
        n->name = name;
    }
    struct machine_explained_kernel *f = &n->facts;
    f->name = n->name;
    f->generated = true;
    f->made = made;
    f->stores = list;
    f->stores_count = stores_count;
    f->operations = k->ops;
    f->operations_cost = k->cost;
    for (int i = 0; i < stores_count; i++) {
        int stage = g->nodes[stores[i]].stage;
        f->stages = stage >= f->stages ? stage + 1 : f->stages;
        f->rings += list[i].in_ring;
    }
    for (int stage = g->strips ? 0 : f->stages - 1; stage < f->stages; stage++)
        f->shifts_computed += shifts_computed(g, stores, stores_count, stage);
    f->stages = g->strips ? f->stages : 1;
    f->tile_width = k->tile_width;
    f->tile_height = k->tile_height;
    f->split = split;
    /* A lane by itself takes the time of a whole vector, and so do many narrow ones. */
    double lanes = (double)m->device->shape.vector / k->vector;
    f->operations_s =
        1e-9 * m->device->shape.op_ns * k->cost * lanes * (double)m->values->sets[set].count;
    take_arguments(f, g, k);
    return n;
}

struct kernel_note *watch_kernel_built(struct machine *m, struct kernel_note *note,
                                       cl_kernel kernel)
{
    struct kernel_note *known = NULL;
    if (!note)
        return NULL;
    for (struct kernel_note *n = watch_sums(m)->notes; n && kernel && !known; n = n->next)
        if (n->kernel == kernel && n->facts.vpset == note->facts.vpset &&
            n->facts.processors == note->facts.processors)
            known = n;
    note->kernel = known ? NULL : kernel;
    return known ? known : note;
}

/* ---- how fast the device copies ---- */

/* Both ways to store, built and started once while the program begins: at its end, when they are wanted, parts of the
 * driver's compiler may have gone already. */
void explain_ready(struct machine *m, struct explain *e)
{
    struct watch *watch = m->watch;
    m->watch = NULL; /* none of this is the program's */
    m->device->inside++;
    for (int streams = 0; streams < 2; streams++) {
        char options[64];
        size_t one = 1;
        cl_ulong count = 0;
        cl_uint run = 1;
        struct device_buffer *b = device_buffer_get(m, 64);
        snprintf(options, sizeof options, "-DELEMENT=float%d -DSTREAMS=%d",
                 m->device->is_cpu ? 16 : 4, streams);
        cl_kernel k = b ? device_library_kernel(m, kernel_copy_cl, options, "copy") : NULL;
        if (k && !clSetKernelArg(k, 0, sizeof count, &count) &&
            !clSetKernelArg(k, 1, sizeof run, &run) &&
            !clSetKernelArg(k, 2, sizeof b->mem, &b->mem) &&
            !clSetKernelArg(k, 3, sizeof b->mem, &b->mem) &&
            !clEnqueueNDRangeKernel(m->device->queue, k, 1, NULL, &one,
                                    m->device->is_cpu ? &one : NULL, 0, NULL, NULL) &&
            !clFinish(m->device->queue))
            e->copies[streams] = k;
        if (b)
            device_buffer_unref(m, b);
    }
    m->device->inside--;
    m->watch = watch;
    machine_error_clear(m); /* then there is nothing to compare with */
}

static double event_s(cl_event done)
{
    cl_ulong started, ended;
    if (clGetEventProfilingInfo(done, CL_PROFILING_COMMAND_START, sizeof started, &started,
                                NULL) ||
        clGetEventProfilingInfo(done, CL_PROFILING_COMMAND_END, sizeof ended, &ended, NULL) ||
        ended <= started)
        return 0;
    return 1e-9 * (double)(ended - started);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median of some runs; 0: the device does not tell. */
static double copies_s(struct machine *m, cl_kernel kernel, size_t elements, size_t run)
{
    double times[COPIES_MOST], sum = 0;
    size_t global = (elements + run - 1) / run, one = 1;
    int count = 0;
    for (int i = 0;
         i <= COPIES_MOST && count < COPIES_MOST && (count < COPIES_LEAST || sum < COPIES_S);
         i++) {
        cl_event done = NULL;
        if (clEnqueueNDRangeKernel(m->device->queue, kernel, 1, NULL, &global,
                                   m->device->is_cpu ? &one : NULL, 0, NULL, &done))
            return 0;
        cl_int error = clWaitForEvents(1, &done);
        double t = error ? 0 : event_s(done);
        clReleaseEvent(done);
        if (t <= 0)
            return 0;
        if (i == 0) /* the compiler, and new memory */
            continue;
        sum += times[count++] = t;
    }
    qsort(times, (size_t)count, sizeof *times, by_value);
    return times[count / 2];
}

/* The time to read half of so many bytes and write the other half; 0: it cannot be told. */
static double copy_s(struct machine *m, const cl_kernel *kernels, uint64_t bytes)
{
    bool cpu = m->device->is_cpu;
    size_t element = cpu ? 64 : 16, elements = (size_t)(bytes / 2 + element - 1) / element;
    size_t run = cpu ? COPY_RUN : 1;
    struct device_buffer *from = device_buffer_get(m, elements * element),
                         *to = from ? device_buffer_get(m, elements * element) : NULL;
    double best = 0;
    for (int streams = 0; to && streams < 2; streams++) {
        cl_kernel kernel = kernels[streams];
        cl_ulong count = elements;
        cl_uint columns = (cl_uint)run;
        if (!kernel || clSetKernelArg(kernel, 0, sizeof count, &count) ||
            clSetKernelArg(kernel, 1, sizeof columns, &columns) ||
            clSetKernelArg(kernel, 2, sizeof from->mem, &from->mem) ||
            clSetKernelArg(kernel, 3, sizeof to->mem, &to->mem))
            break;
        double t = copies_s(m, kernel, elements, run);
        best = t > 0 && (best <= 0 || t < best) ? t : best;
    }
    if (from)
        device_buffer_unref(m, from);
    if (to)
        device_buffer_unref(m, to);
    return best;
}

static void measure(struct machine *m, struct explain *e)
{
    struct machine_explained *f = &e->facts;
    enum machine_status status = m->status;
    f->copy_bytes = 0;
    f->copy_bytes_per_s = 0;
    m->device->inside++;
    for (int i = 0; i < f->kernels_count && i < MEASURED_MOST; i++) {
        struct machine_explained_kernel *k = &e->kernels[i];
        uint64_t bytes = k->runs ? k->bytes / k->runs : 0;
        if (!bytes || bytes > COPY_BYTES_MOST)
            continue;
        for (int j = 0; j < i && k->copy_s <= 0; j++)
            if (e->kernels[j].runs && e->kernels[j].bytes / e->kernels[j].runs == bytes)
                k->copy_s = e->kernels[j].copy_s;
        if (k->copy_s <= 0)
            k->copy_s = copy_s(m, e->copies, bytes);
        if (k->copy_s > 0 && bytes > f->copy_bytes) {
            f->copy_bytes = bytes;
            f->copy_bytes_per_s = (double)bytes / k->copy_s;
        }
    }
    m->device->inside--;
    if (!status) /* no memory for a copy is nobody's failure */
        machine_error_clear(m);
}

/* ---- the whole ---- */

static int by_time(const void *a, const void *b)
{
    const struct machine_explained_kernel *x = a, *y = b;
    if (x->time_s > y->time_s || x->time_s < y->time_s)
        return x->time_s > y->time_s ? -1 : 1;
    if (x->runs != y->runs)
        return x->runs > y->runs ? -1 : 1;
    return strcmp(x->name, y->name);
}

static int by_count(const void *a, const void *b)
{
    const struct machine_explained_row *x = a, *y = b;
    return x->count > y->count ? -1 : x->count < y->count ? 1 : strcmp(x->name, y->name);
}

static void add(struct machine_explained_row *rows, int *count, const char *name,
                uint64_t number)
{
    rows[(*count)++] = (struct machine_explained_row){.name = name, .count = number};
}

static bool gather_kernels(struct explain *e)
{
    int count = 0;
    for (struct kernel_note *n = e->notes; n; n = n->next)
        count += n->facts.runs > 0;
    free(e->kernels);
    e->kernels = calloc((size_t)count + 1, sizeof *e->kernels);
    if (!e->kernels)
        return false;
    count = 0;
    for (struct kernel_note *n = e->notes; n; n = n->next)
        if (n->facts.runs > 0)
            e->kernels[count++] = n->facts;
    qsort(e->kernels, (size_t)count, sizeof *e->kernels, by_time);
    e->facts.kernels = e->kernels;
    e->facts.kernels_count = count;
    return true;
}

static void gather_rows(const struct machine *m, struct explain *e)
{
    struct machine_explained *f = &e->facts;
    f->vanished_count = f->reasons_count = f->evaluations_count = f->phases_count = 0;
    for (int i = 0; i < NODE_OP_COUNT; i++)
        if (e->vanished[i])
            add(f->vanished, &f->vanished_count, node_ops[i].name, e->vanished[i]);
    qsort(f->vanished, (size_t)f->vanished_count, sizeof *f->vanished, by_count);
    const struct vanished *v = &m->values->vanished;
    add(f->reasons, &f->reasons_count, "field or flag overwritten before it was in memory",
        e->overwritten);
    add(f->reasons, &f->reasons_count, "overwritten where the same context holds",
        v->overwritten);
    add(f->reasons, &f->reasons_count, "stored in a context within the one before", v->nested);
    add(f->reasons, &f->reasons_count, "looked at only where the context holds",
        v->under_context);
    add(f->reasons, &f->reasons_count, "known as a number", v->numbers);
    add(f->reasons, &f->reasons_count, "made before, of the same operands", v->known);
    add(f->reasons, &f->reasons_count, "overflow that nobody looked at", v->overflows);
    add(f->reasons, &f->reasons_count, "temporary left an expression at an evaluation",
        v->expressions);
    add(f->evaluations, &f->evaluations_count, "somebody looked", e->looked);
    add(f->evaluations, &f->evaluations_count, "much was waiting", e->alone);
    add(f->evaluations, &f->evaluations_count, "asked to, by a flush", e->flushed);
    add(f->evaluations, &f->evaluations_count, "each store at once", e->eager);
    for (int i = 0; i < WATCH_PHASES_COUNT; i++)
        if (e->phases[i].count) {
            f->phases[f->phases_count] = e->phases[i];
            f->phases[f->phases_count++].name = watch_phase_names[i];
        }
}

const struct machine_explained *machine_explain(struct machine *m, bool wish_measured)
{
    struct explain *e = watch_explain(m);
    if (!e || !m->device->queue || m->device->inside ||
        !pthread_equal(m->owner, pthread_self()))
        return NULL;
    watch_settle(m);
    struct machine_explained *f = &e->facts;
    if (!gather_kernels(e))
        return NULL;
    f->device = m->device->name;
    f->processors_count = m->values->processors_count;
    f->calls = e->calls;
    f->stores = m->run->stores;
    f->plans_built = m->plans->built;
    gather_rows(m, e);
    if (wish_measured)
        measure(m, e);
    return f;
}
