/* plan_kernels.c - chooses, writes and builds a plan's kernels, or requests them from the
 * background. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/errors.h"
#include "codegen/numbers.h"
#include "kernels.h"
#include "plans/background.h"
#include "plans/division.h"
#include "plans/explained.h"
#include "plans/known.h"
#include "plans/plans.h"

/* ---- life ---- */

void launch_takes(struct launch *l, struct device_kernel *kernel)
{
    l->kernel = kernel;
    device_kernel_hold(kernel);
}

static void launches_free(struct machine *m, struct plan *p)
{
    for (int i = 0; i < p->launches_count; i++) {
        if (!p->launches[i].program) /* else they are its */
            free(p->launches[i].arguments);
        byte_code_free(p->launches[i].program);
        device_code_free(m, p->launches[i].code);
        device_kernel_let_go(p->launches[i].kernel);
        free(p->launches[i].in_place.pairs);
    }
    free(p->launches);
    p->launches = NULL;
    p->launches_count = 0;
}

/* Kernels that were used before then. */
static bool has_old(const struct plan *p, uint64_t used_before)
{
    bool old = false;
    for (int i = 0; i < p->launches_count; i++)
        old |= p->launches[i].kernel && p->launches[i].kernel->used < used_before;
    return old;
}

void plan_let_go_of_old(struct machine *m, struct plan *p, uint64_t used_before)
{
    if (!has_old(p, used_before))
        return;
    launches_free(m, p);
    p->gone = true;
    p->version++;
}

void plan_free(struct machine *m, struct plan *p)
{
    if (!p)
        return;
    launches_free(m, p);
    choice_free(p->choice);
    division_free(p->division);
    plan_free(m, p->better);
    free(p->stored);
    free(p->arrays);
    free(p->signature);
    free(p);
}

void plan_notes_settle(struct machine *m, struct plan *p)
{
    for (int i = 0; m->watch && i < p->launches_count; i++) {
        struct launch *l = &p->launches[i];
        l->note = explained_built(m, l->note, l->kernel);
    }
}

/* ---- kernels ---- */

/* A limit that every device supports: 1024 bytes. Reserved: the fixed arguments and lengths
 * of axes.
 */
static bool too_many_arguments(const struct kernel_text *k)
{
    size_t bytes = (5 + MACHINE_AXES_MAX) * sizeof(cl_int);
    for (int i = 0; i < k->arguments_count; i++)
        bytes += k->arguments[i].size ? k->arguments[i].size : sizeof(cl_mem);
    return bytes > 1024;
}

/* Whether there are so many arrays that they must be prefetched. */
static bool many_streams(const struct machine *m, const struct vpset *set,
                         const struct kernel_text *k)
{
    const struct device_shape *shape = &m->device->shape;
    int arrays = 0;
    for (int i = 0; i < k->arguments_count; i++)
        arrays += k->arguments[i].kind == ARGUMENT_INPUT;
    return m->device->is_cpu && k->vector > 1 && !k->strip_bytes &&
           arrays > shape->arrays_foreseen &&
           (double)arrays * (double)(set->pitch * set->rows) * sizeof(float) >
               shape->fetch_bytes;
}

/* Functions like exp take hundreds of operations, each a call in unoptimised code: a
 * microsecond for each processor instead of a tenth. So fewer processors make up for the
 * time of optimising, which hardly takes longer. */
static bool much_math(const struct machine *m, const struct kernel_text *k,
                      const struct vpset *set)
{
    enum { MATH_WEIGHT = 32 };
    return k->math && set->count >= m->settings.optimise_after / 4 / MATH_WEIGHT;
}

/* Builds the kernel now, or requests it from the background (returns its number there; -1:
 * no memory). The argument string must match launch(). */
static int kernel_want(struct machine *m, const struct vpset *set, const struct kernel_text *k,
                       const char *const parts[DEVICE_PARTS], bool later)
{
    size_t numbers = 5 + (size_t)set->rank - 1 + (k->strip_bytes ? 1 : 0),
           count = numbers + (size_t)k->arguments_count,
           across = k->group ? plan_tiles_across(set, k->tile_width) * (size_t)k->group
                             : (size_t)set->width / plan_run_columns(m, k->vector) + 1,
           widest = k->strip_bytes       ? 1
                    : set->rows > across ? set->rows
                                         : across;
    int number = -1;
    char *arguments = malloc(count + 1);
    if (!arguments)
        return -1;
    memset(arguments, '4', numbers);
    for (int i = 0; i < k->arguments_count; i++) {
        const struct kernel_argument *a = &k->arguments[i];
        arguments[numbers + (size_t)i] =
            a->kind == ARGUMENT_INPUT || a->kind == ARGUMENT_OUTPUT ||
                    a->kind == ARGUMENT_SCRATCH || a->kind == ARGUMENT_CLAIMS
                ? 'm'
            : a->kind != ARGUMENT_BORDERS && a->size == 8 ? '8'
                                                          : '4';
    }
    arguments[count] = '\0';
    const struct background_wish wish = {.parts = parts,
                                         .options = k->options,
                                         .name = "k",
                                         .arguments = arguments,
                                         .dimensions = 2,
                                         .group = (uint32_t)k->group,
                                         .widest = widest};
    if (later)
        number = background_want(m, &wish);
    else
        background_foresee(m, &wish);
    free(arguments);
    return number;
}

/* Requests the kernel that copies borders, for a plan that writes in place: see
 * copy_borders(). */
static bool borders_want(struct machine *m)
{
    const char *parts[DEVICE_PARTS];
    for (int i = 0; i < DEVICE_PARTS - 1; i++)
        parts[i] = "";
    parts[DEVICE_PARTS - 1] = kernel_borders_cl;
    return background_want(m,
                           &(struct background_wish){.parts = parts,
                                                     .options = "",
                                                     .name = "borders",
                                                     .arguments = "44444488mmmmmmmmmmmmmmmmm",
                                                     .dimensions = 3,
                                                     .widest = 1}) >= 0;
}

static bool plan_text(const struct machine *m, const struct plan_graph *g, const int *stores,
                      int count, struct kernel_text *k)
{
    const struct vpset *set = &m->values->sets[g->nodes[stores[0]].set];
    const struct device_shape *shape = &m->device->shape;
    return !g->strips          ? rows_emit(g, stores, count, set, shape, k)
           : shape->vector < 2 ? tiles_emit(g, stores, count, set, shape, k)
                               : strips_emit(g, stores, count, set, shape, k);
}

static void plan_dump_text(struct machine *m, const struct kernel_text *k)
{
    char said[sizeof k->options + 40];
    int n = snprintf(said, sizeof said, "%s", k->options);
    if (k->strip_bytes)
        snprintf(said + n, sizeof said - (size_t)n, ", strips of %d columns", k->strip_columns);
    if (k->group)
        snprintf(said + n, sizeof said - (size_t)n, ", tiles of %d x %d", k->tile_width,
                 k->tile_height);
    dump_text(m, m->plans->dump_count++, ".cl", said, k->text);
}

bool plan_launches_grow(struct plan *p)
{
    struct launch *launches =
        realloc(p->launches, (size_t)(p->launches_count + 1) * sizeof *launches);
    p->launches = launches ? launches : p->launches;
    return launches != NULL;
}

/* Whether the kernel takes its numbers as arguments: where plans that differ from it in numbers
 * only have such kernels, or there are several such plans, and nobody has compiled the written
 * one. */
static bool lifts(struct machine *m, const struct plan *p, const struct kernel_text *k,
                  const char *parts[DEVICE_PARTS], const char *written, const char *lifted)
{
    if (m->settings.numbers != SETTING_FREE)
        return m->settings.numbers;
    if (p->form)
        return p->form->lifted;
    if (p->written || !m->settings.optimise_after || !m->settings.box_after)
        return false;
    parts[DEVICE_PARTS - 1] = written;
    if (device_kernel_at_hand(m, parts, k->options, "k"))
        return false;
    if (p->family && p->family->differ >= FAMILY_FROM)
        return true;
    parts[DEVICE_PARTS - 1] = lifted;
    return device_kernel_at_hand(m, parts, k->options, "k");
}

/* Makes the text one of the two that it can be (codegen/numbers.h), the last of the parts.
 * True: numbers are arguments. */
static bool text_take(struct machine *m, struct plan *p, struct kernel_text *k,
                      const char *parts[DEVICE_PARTS])
{
    struct kernel_argument *arguments;
    int count;
    char *lifted = m->settings.numbers ? numbers_lift(k, &arguments, &count) : NULL;
    struct kernel_text other = *k;
    if (lifted) {
        other.arguments = arguments;
        other.arguments_count = count;
    }
    numbers_write(k->text);
    bool takes =
        lifted && !too_many_arguments(&other) && lifts(m, p, k, parts, k->text, lifted);
    if (lifted) {
        free(takes ? k->text : lifted);
        free(takes ? k->arguments : arguments);
    }
    if (takes) {
        k->text = lifted;
        k->arguments = arguments;
        k->arguments_count = count;
    }
    p->lifted |= takes;
    parts[DEVICE_PARTS - 1] = k->text;
    return takes;
}

/* Builds the kernel of that text, or requests it from the background. The plan has room for
 * it. False: impossible; an error may be set. */
static bool plan_build(struct machine *m, struct plan *p, const struct plan_graph *g,
                       const int *stores, int stores_count, struct kernel_text *k)
{
    int set_id = g->nodes[stores[0]].set, number = -1;
    const struct vpset *set = &m->values->sets[set_id];
    const char *parts[DEVICE_PARTS] = {kernel_prelude_cl,
                                       k->wide ? kernel_wide_cl : "",
                                       k->soft ? kernel_soft_cl : "",
                                       k->formats ? kernel_formats_cl : "",
                                       k->math ? kernel_math_tables_cl : "",
                                       k->math ? kernel_math_cl : "",
                                       k->math ? kernel_math_others_cl : ""};
    if (many_streams(m, set, k))
        strcat(k->options, " -DAHEAD=128");
    bool lifted = text_take(m, p, k, parts);
    if (m->plans->dump_dir)
        plan_dump_text(m, k);
    if (p->only_at_hand && !device_kernel_at_hand(m, parts, k->options, "k"))
        return false;
    bool quick = p->quality == QUICK && !much_math(m, k, set) &&
                 !device_kernel_at_hand(m, parts, k->options, "k");
    if (quick)
        strcat(k->options, " -cl-opt-disable");
    struct device_kernel *kernel = NULL;
    if (p->later || quick)
        number = kernel_want(m, set, k, parts, p->later);
    if (!p->later)
        kernel = device_kernel(m, parts, k->options, "k");
    if (kernel && k->group && !device_takes_group(m->device, kernel, k->group))
        kernel = NULL; /* plan_make() does without */
    p->could_be_optimised |= quick;
    p->could_be_boxed |= k->has_boxes && !g->boxes;
    p->work += shape_work(&m->device->shape, set->count);
    if (!kernel && number < 0)
        return false;
    if (lifted && p->family && !p->later)
        p->family->lifted++;
    const char *made = explained_made(quick, g->boxes && k->has_boxes, lifted);
    struct kernel_note *note =
        m->watch ? explained_kernel(m, kernel, g, stores, stores_count, k, made) : NULL;
    p->launches[p->launches_count++] = (struct launch){.number = number,
                                                       .note = note,
                                                       .set = set_id,
                                                       .vector = k->vector,
                                                       .strip_bytes = k->strip_bytes,
                                                       .strip_margin = k->strip_margin,
                                                       .strip_columns = k->strip_columns,
                                                       .group = k->group,
                                                       .tile_width = k->tile_width,
                                                       .tile_height = k->tile_height,
                                                       .in_place = k->in_place,
                                                       .claims = k->claims,
                                                       .arguments = k->arguments,
                                                       .arguments_count = k->arguments_count};
    launch_takes(&p->launches[p->launches_count - 1], kernel);
    k->arguments = NULL;
    k->in_place.pairs = NULL;
    return true;
}

static bool plan_kernel(struct machine *m, struct plan *p, const struct plan_graph *g,
                        const int *stores, int stores_count)
{
    struct kernel_text k;
    double start = watch_clock(m);
    if (!plan_text(m, g, stores, stores_count, &k)) {
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory to write a kernel");
        return false;
    }
    if (g->strips && too_many_arguments(&k)) {
        kernel_text_finish(&k);
        return false; /* plan_make() does without */
    }
    if (stores_count > 1 && too_many_arguments(&k)) { /* two kernels, each with what it needs */
        int half = stores_count / 2;
        kernel_text_finish(&k);
        if (m->watch)
            explained_split(m);
        return plan_kernel(m, p, g, stores, half) &&
               plan_kernel(m, p, g, stores + half, stores_count - half);
    }
    if (m->watch)
        watch_span(m, WATCH_GENERATE, start, "\"operations\":%d,\"loads\":%d", k.ops, k.loads);
    bool good = plan_launches_grow(p) && plan_build(m, p, g, stores, stores_count, &k);
    kernel_text_finish(&k);
    return good;
}

static bool plan_kernels(struct machine *m, struct plan *p, const struct plan_graph *g,
                         int *stores)
{
    int last = 0;
    uint64_t work = 0;
    for (int i = 0; i < g->count; i++)
        if (g->nodes[i].stored) {
            last = g->nodes[i].stage > last ? g->nodes[i].stage : last;
            work = m->values->sets[g->nodes[i].set].count > work
                       ? m->values->sets[g->nodes[i].set].count
                       : work;
        }
    if (p->quality == QUICK && work >= m->settings.optimise_after / 4)
        p->quality = OPTIMISED;
    for (int stage = g->strips ? -1 : 0; stage <= (g->strips ? -1 : last); stage++)
        for (int set = 1; set < m->values->sets_count; set++) {
            int count = plan_stores(g, stage, set, stores);
            plan_arrays(m, p, g, stores, count);
            if (count && !plan_kernel(m, p, g, stores, count))
                return false;
        }
    plan_last_launches(p);
    return true;
}

static struct plan *plan_attempt(struct machine *m, const struct plan_request *q,
                                 enum quality quality, bool later, bool *strips)
{
    struct plan_graph g;
    struct plan *p = calloc(1, sizeof *p);
    size_t count = (size_t)q->reach->count;
    int *stores = calloc(count, sizeof *stores);
    bool good = plan_graph_init(&g, q) && p && stores;
    if (good) {
        p->quality = quality;
        p->later = later;
        p->family = q->family;
        p->written = q->written;
        p->form = q->form;
        p->only_at_hand = q->use == PLAN_TO_RUN_AT_HAND;
        p->stored = calloc(count, sizeof *p->stored);
        p->arrays = calloc(count, sizeof *p->arrays);
        good = p->stored && p->arrays;
    }
    if (good) {
        g.boxes = quality == BOXED;
        g.no_strips = !*strips;
        double start = watch_clock(m);
        if (!choice_take(q->choice, &g))
            plan_choose(&g, m->values->sets, &m->device->shape);
        if (m->watch)
            watch_span(m, WATCH_PLAN, start, "\"nodes\":%d", q->reach->count);
        p->could_be_strips = g.no_strips && g.turns_most > 1;
        *strips = g.strips;
        p->turns_most = g.turns_most;
        p->predicted_s = 1e-9 * g.cost_ns;
        if (m->plans->dump_dir)
            dump_graph(m, m->plans->dump_count, &g);
        good = plan_kernels(m, p, &g, stores) &&
               (!later || !plan_in_place_wanted(m, p) || borders_want(m));
    } else {
        machine_fail(m, MACHINE_NO_MEMORY, "not enough memory for a plan");
    }
    free(g.nodes);
    free(stores);
    if (p)
        p->form = NULL; /* the request's */
    if (!good) {
        if (p && later)
            plan_notes_settle(m, p);
        plan_free(m, p);
        return NULL;
    }
    return p;
}

bool plan_is_one_kernel(const struct plan *p)
{
    return p->launches_count == 1 && (p->launches[0].strip_bytes || p->launches[0].group);
}

struct plan *plan_make(struct machine *m, const struct plan_request *q, enum quality quality,
                       bool later)
{
    bool strips = quality == BOXED || m->device->shape.always_strips;
    struct plan *p = plan_attempt(m, q, quality, later, &strips);
    if (q->use == PLAN_TO_REHEARSE_TURNS) {
        if (p && !plan_is_one_kernel(p)) {
            if (later)
                plan_notes_settle(m, p);
            plan_free(m, p);
            p = NULL;
        }
        if (!p && later)
            background_drop(m);
        return p;
    }
    if (!p && strips) { /* strips are impossible */
        machine_error_clear(m);
        if (later)
            background_drop(m);
        strips = false;
        p = plan_attempt(m, q, quality, later, &strips);
    }
    if (!p && later)
        background_drop(m);
    return p;
}
