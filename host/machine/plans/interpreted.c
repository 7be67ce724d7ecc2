/* interpreted.c - plans that are run as byte code, and when they get kernels instead.
 *
 * A compiler wins a factor of two on arithmetic, and takes 0.04 to 1.6 s to win it. So a plan
 * that is seen for the first time is interpreted (interpret/), and goes on so until
 *  - its runs have cost more than looking whether an earlier program had its kernels compiled:
 *    those are used at once;
 *  - what kernels would have saved is more than compiling takes: they are compiled, in the
 *    background where there is one.
 * What is likely to come is as much as there has been. A small set's plan, which is done before
 * a kernel has begun, stays. */
#include <stdlib.h>

#include "base/errors.h"
#include "plans/background.h"
#include "plans/known.h"
#include "plans/plans.h"

static double compile_time(const struct machine *m, const struct plan *p)
{
    const struct device_shape *shape = &m->device->shape;
    double s = 0;
    for (int i = 0; i < p->launches_count; i++)
        s += 1e-9 * (shape->compile_ns + shape->compile_op_ns * p->launches[i].program->ops);
    return s;
}

/* Byte code has a step for it. */
static bool is_a_step(const struct machine_value *v)
{
    if (v->op == NODE_GATHER)
        return v->in[1]->buffer != NULL;
    return v->op == NODE_SHIFT || v->op == NODE_CROSS || !node_ops[v->op].inputs ||
           op_has(v->op, OP_ALONE);
}

/* Whether the device performs byte code, not the front end, which cannot look into its
 * memory. */
static bool on_device(const struct machine *m)
{
    return (m->settings.interpret == 3 && device_is_ours(m->device)) ||
           (!m->device->is_pocl && m->device->has_double);
}

static bool could_be(const struct machine *m, const struct plan_request *q)
{
    const bool must = !device_takes_kernels(m);
    if ((!m->settings.interpret && !must) || !plan_use_runs(q->use) ||
        !(m->device->is_pocl || on_device(m)))
        return false;
    for (int i = 0; i < q->reach->count; i++) {
        const struct machine_value *v = q->reach->nodes[i];
        if (v->buffer ? !v->buffer->host && !on_device(m) : !is_a_step(v))
            return false;
    }
    return m->settings.interpret > 1 || must ||
           (q->use == PLAN_TO_RUN && m->settings.optimise_after && m->settings.box_after);
}

static bool launch_add(struct machine *m, struct plan *p, const struct plan_graph *g,
                       const int *stores, int count)
{
    int set_id = g->nodes[stores[0]].set;
    const struct vpset *set = &m->values->sets[set_id];
    struct byte_code *program = plan_launches_grow(p)
                                    ? byte_code_make(&m->device->shape, g, stores, count, set,
                                                     m->values->processors_log2, !on_device(m))
                                    : NULL;
    struct device_code *code =
        program && on_device(m) ? device_code_make(m, &m->plans->device_kernels, program, set)
                                : NULL;
    if (!program || (on_device(m) && !code)) {
        byte_code_free(program);
        return false;
    }
    struct kernel_text said = {.arguments = program->arguments,
                               .arguments_count = program->arguments_count,
                               .vector = m->device->shape.vector,
                               .ops = program->ops,
                               .cost = program->cost};
    struct kernel_note *note = m->watch
                                   ? explained_kernel(m, code ? device_code_kernel(code) : NULL,
                                                      g, stores, count, &said, "interpreted")
                                   : NULL;
    p->launches[p->launches_count++] =
        (struct launch){.number = -1,
                        .note = note,
                        .set = set_id,
                        .program = program,
                        .code = code,
                        .arguments = program->arguments,
                        .arguments_count = program->arguments_count};
    p->work += shape_work(&m->device->shape, set->count);
    p->bytes += set->count * (uint64_t)program->lane_bytes;
    p->looks_around = p->looks_around || program->moves;
    p->predicted_s +=
        code ? device_code_time_s(m, code, set) : program->lane_s * (double)set->count;
    return true;
}

static bool programs_make(struct machine *m, struct plan *p, struct plan_graph *g, int *stores)
{
    int last = 0;
    byte_code_stages(g);
    if (m->plans->dump_dir)
        dump_graph(m, m->plans->dump_count++, g);
    for (int i = 0; i < g->count; i++)
        if (g->nodes[i].stored && g->nodes[i].stage > last)
            last = g->nodes[i].stage;
    for (int stage = 0; stage <= last; stage++)
        for (int set = 1; set < m->values->sets_count; set++) {
            int count = plan_stores(g, stage, set, stores);
            plan_arrays(m, p, g, stores, count);
            if (count && !launch_add(m, p, g, stores, count))
                return false;
        }
    plan_last_launches(p);
    return true;
}

static struct plan *plan_interpreted(struct machine *m, const struct plan_request *q)
{
    struct plan_graph g;
    size_t count = (size_t)q->reach->count;
    struct plan *p = calloc(1, sizeof *p);
    int *stores = calloc(count, sizeof *stores);
    bool good = plan_graph_init(&g, q) && p && stores;
    if (good) {
        p->quality = INTERPRETED;
        p->turns_most = 1;
        p->stored = calloc(count, sizeof *p->stored);
        p->arrays = calloc(count, sizeof *p->arrays);
        good = p->stored && p->arrays && programs_make(m, p, &g, stores);
    }
    free(g.nodes);
    free(stores);
    if (!good) {
        plan_free(m, p);
        return NULL;
    }
    return p;
}

/* The part of a run's time that may be memory's. */
static const double TRAFFIC_PART = 0.15;

double plan_waits_for_memory(const struct machine *m, const struct plan *p)
{
    const struct device_shape *shape = &m->device->shape;
    if (p->division || p->quality != INTERPRETED || p->looks_around || !p->launches_count ||
        p->launches[0].code || (double)p->bytes < shape->in_place_bytes)
        return 0;
    double compute_ns = 1e9 * p->predicted_s / crew_size(m->device->crew);
    return shape->byte_ns * (double)p->bytes / (TRAFFIC_PART * compute_ns);
}

/* Kernels would store what is crossed in a block, and load it again; they do not see which gets
 * are of lines that are spread. That gains nothing, where byte code has loops. */
static bool is_best(const struct plan *p)
{
    bool crosses = false, each = false;
    for (int i = 0; i < p->launches_count; i++) {
        crosses = crosses || p->launches[i].program->crosses || p->launches[i].program->lines;
        each = each || p->launches[i].program->each;
    }
    return crosses && !each;
}

/* Whether the plan's kernels were compiled before, and nothing is left to be searched for long
 * so that they can be written again. */
static bool is_known(struct machine *m, const struct plan_request *q, struct plan_form *form)
{
    return known_find(m, q, form) && (form->quality != BOXED || !choice_takes_long(m, q) ||
                                      (q->choice && q->choice->strips.nodes));
}

struct plan *interpreted_at_hand(struct machine *m, const struct plan_request *q)
{
    struct plan_request asked = *q;
    struct plan_form form = {OPTIMISED, false};
    asked.use = PLAN_TO_RUN_AT_HAND;
    if (is_known(m, q, &form))
        asked.form = &form;
    struct plan *made = plan_make(m, &asked, form.quality, false);
    machine_error_clear(m);
    return made;
}

struct plan *interpreted_make(struct machine *m, const struct plan_request *q)
{
    double start = watch_clock(m);
    struct plan *p = could_be(m, q) ? plan_interpreted(m, q) : NULL;
    if (!p || m->settings.interpret > 1 || !device_takes_kernels(m) ||
        p->predicted_s < 1e-9 * m->device->shape.text_ns || is_best(p))
        return p;
    const bool slow = choice_takes_long(m, q) && p->predicted_s <= compile_time(m, p);
    struct plan *better = slow ? NULL : interpreted_at_hand(m, q);
    p->asked = !slow;
    if (better || p->predicted_s > compile_time(m, p)) {
        plan_free(m, p);
        return better;
    }
    if (m->watch)
        watch_span(m, WATCH_PLAN, start, "\"interpreted\":true");
    return p;
}

bool interpreted_asks(const struct plan *p)
{
    return !p->asked || (p->family && p->family->lifted > p->asked_of);
}

/* What kernels for any numbers would have saved all of its family. */
static bool pays_family(const struct machine *m, const struct plan *p)
{
    const struct device_shape *shape = &m->device->shape;
    const struct plan_family *f = p->family;
    return f && f->differ >= FAMILY_FROM && !f->lifted &&
           f->spent_s * (1 - shape->kernel_part) - 1e-9 * shape->wait_ns * (double)f->started >
               compile_time(m, p);
}

double interpreted_saves_s(const struct machine *m, const struct plan *p)
{
    const struct device_shape *shape = &m->device->shape;
    const double mean_s = p->spent_s / (double)p->runs;
    return mean_s - shape->kernel_part * mean_s - 1e-9 * shape->wait_ns * p->launches_count;
}

bool interpreted_is_due(const struct machine *m, const struct plan *p)
{
    const struct device_shape *shape = &m->device->shape;
    if (m->settings.interpret != 1 || !p->runs || is_best(p))
        return false;
    if (interpreted_asks(p) && p->spent_s > 1e-9 * shape->text_ns)
        return true;
    const double mean = p->spent_s / (double)p->runs, saved = interpreted_saves_s(m, p);
    if (p->looks_around && p->worked >= m->settings.box_after &&
        mean > 1e-9 * shape->turns_from_ns)
        return true;
    return saved * (double)p->runs > compile_time(m, p) ||
           (saved > 0 && p->asked && pays_family(m, p));
}

bool interpreted_seeks(struct machine *m, const struct plan *p)
{
    return p->quality == INTERPRETED && !p->sought && p->runs > 0 &&
           p->spent_s > 1e-9 * m->device->shape.text_ns && m->settings.interpret == 1 &&
           m->settings.keep && !interpreted_asks(p) && interpreted_saves_s(m, p) > 0 &&
           background_on(m);
}
