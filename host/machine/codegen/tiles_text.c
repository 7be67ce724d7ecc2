/* tiles_text.c - the text of kernels in tiles. See tiles.h. */
#include <stdlib.h>
#include <string.h>

#include "base/types.h"
#include "codegen/body.h"
#include "kernels.h"
#include "plan/lanes.h"
#include "plan/tiles.h"

struct stage {
    struct accesses looks;
    struct emitter e;
    struct text text; /* of its function, but for its name */
    int same;         /* the first stage with that text */
};

struct tiles {
    const struct plan_graph *g;
    const struct vpset *set;
    const struct device_shape *shape;
    const int *stores;
    int stores_count;
    struct stage *stages;
    int stages_count;
    bool *bits_matter;
    int *array;  /* of a node: in the tiling, + 1; 0: it is in no local memory */
    int *number; /* see emit_collect() */
    struct tiling tiling;
    struct arguments arguments;
    int constants_count;
    bool failed;
};

/* ---- what stages look at ---- */

static bool is_of(const struct tiles *s, int store, int stage)
{
    return s->g->nodes[s->stores[store]].stage == stage;
}

/* When it is known which stages load it: local memory has what later ones look at. */
static bool is_near(const struct tiles *s, int node)
{
    const struct tile_array *a = &s->tiling.arrays[s->array[node] - 1];
    return a->last > a->stage;
}

/* Of what there is both a canonical form and another: where the array in global memory has the
 * one, local memory may have it, too. */
static bool is_canonical(const struct tiles *s, int node)
{
    return s->g->nodes[node].target || s->bits_matter[node];
}

static void stage_accesses(struct tiles *s, int k)
{
    struct accesses *looks = &s->stages[k].looks;
    accesses_begin(looks, s->g, s->set, k);
    for (int i = 0; i < s->stores_count && !looks->failed; i++)
        if (is_of(s, i, k))
            accesses_add(looks, s->stores[i], is_canonical(s, s->stores[i]));
    accesses_end(looks);
    s->failed = s->failed || looks->failed;
}

/* All that is stored; what nobody loads is begun, and no more. */
static void find_arrays(struct tiles *s)
{
    tiling_begin(&s->tiling, s->stages_count);
    for (int i = 0; i < s->stores_count; i++) {
        const struct plan_node *n = &s->g->nodes[s->stores[i]];
        int bytes = (int)type_bytes(n->type);
        s->array[s->stores[i]] =
            1 + tiling_array(&s->tiling, (struct tile_array){.bytes = bytes,
                                                             .stage = n->stage,
                                                             .last = n->stage,
                                                             .stays = n->target});
        s->tiling.stored_ns += n->target ? bytes * s->shape->byte_ns : 0;
    }
}

static void find_extents(struct tiles *s)
{
    for (int k = 0; k < s->stages_count; k++) {
        const struct accesses *looks = &s->stages[k].looks;
        for (int i = 0; i < looks->count; i++) {
            const struct access *p = &looks->list[i];
            const struct plan_node *n = &s->g->nodes[p->node];
            int down = accesses_down(looks, p);
            tiling_look(&s->tiling, (struct tile_look){.to = k,
                                                       .from = n->leaf ? -1 : n->stage,
                                                       .left = -p->low,
                                                       .right = p->high,
                                                       .above = -down,
                                                       .below = down});
            if (!n->leaf)
                widen(&s->tiling.arrays[s->array[p->node] - 1].last, k);
        }
    }
    tiling_extents(&s->tiling);
}

/* Arrays in global memory come from there to the first stage that loads them, and to later ones
 * from a cache. In s->number, which is not in use yet: the last one so far, + 1. */
static void find_costs(struct tiles *s)
{
    const struct device_shape *shape = s->shape;
    for (int k = 0; k < s->stages_count; k++) {
        const struct accesses *looks = &s->stages[k].looks;
        struct tile_stage *stage = &s->tiling.stages[k];
        stage->ns = (looks->cost + looks->loads) * shape->op_ns;
        for (int i = 0; i < looks->count; i++) {
            int node = looks->list[i].node;
            bool leaf = s->g->nodes[node].leaf;
            double bytes = (double)type_bytes(s->g->nodes[node].type);
            if (leaf && !s->number[node])
                stage->far_ns += bytes * shape->byte_ns;
            else if (s->number[node] != k + 1)
                stage->ns += bytes * shape->near_byte_ns;
            s->number[node] = leaf ? k + 1 : 0;
        }
        for (int i = 0; i < s->stores_count; i++)
            if (is_of(s, i, k) && is_near(s, s->stores[i]))
                stage->ns +=
                    (double)type_bytes(s->g->nodes[s->stores[i]].type) * shape->near_byte_ns;
    }
    memset(s->number, 0, (size_t)s->g->count * sizeof *s->number);
}

/* ---- the text of a stage ---- */

static struct operand stored_value(struct tiles *s, int k, int node)
{
    return emit_value(&s->stages[k].e, node, 0, 0, is_canonical(s, node));
}

/* What it takes besides the numbers: the sheet, the work-item; where it begins, how large it
 * is, where in it the tile is, and how much of that is on the sheet; then a pointer for each
 * array and row that it loads, and for each that it stores. */
static void head(const struct tiles *s, int k, struct text *t)
{
    const struct emitter *e = &s->stages[k].e;
    int stored = 0;
    text_put(t,
             "(const int W, const int PITCH, const int PLOG2, const int RATIO, const int D0, "
             "const int item,\n    const int x0, const int y0, const int wide, const int "
             "high, const int left, const int above,\n    const int across, const int down");
    for (int i = 0; i < e->pointers_count; i++) {
        int node = e->seen_pointers[i].node;
        const char *type = memory_type(s->g->nodes[node].type);
        if (s->g->nodes[node].leaf)
            text_put(t, ",\n    const __global %s *restrict b%d", type, i);
        else
            text_put(t, ",\n    const __local %s *b%d, const int w%d", type, i, i);
    }
    for (int i = 0; i < s->stores_count; i++) {
        if (!is_of(s, i, k))
            continue;
        const char *type = memory_type(s->g->nodes[s->stores[i]].type);
        if (is_near(s, s->stores[i]))
            text_put(t, ",\n    __local %s *n%d", type, stored);
        if (s->g->nodes[s->stores[i]].target)
            text_put(t, ",\n    __global %s *restrict o%d", type, stored);
        stored++;
    }
    emit_numbers(t, e);
    text_put(t, ")\n{\n");
}

static void pointers(const struct tiles *s, const struct emitter *e, struct text *t)
{
    for (int i = 0; i < e->pointers_count; i++) {
        const struct access *p = &e->seen_pointers[i];
        const char *type = memory_type(s->g->nodes[p->node].type);
        if (s->g->nodes[p->node].leaf)
            text_put(t, "        const __global %s *const p%d = b%d + (size_t)r%d * PITCH;\n",
                     type, i, i, p->row);
        else
            text_put(t, "        const __local %s *const p%d = b%d + in_y * w%d;\n", type, i, i,
                     i);
    }
}

static bool has_targets(const struct tiles *s, int stage)
{
    bool any = false;
    for (int i = 0; i < s->stores_count; i++)
        any = any || (is_of(s, i, stage) && s->g->nodes[s->stores[i]].target);
    return any;
}

/* What only the tile's own processors need comes last, where they are by themselves. */
static void outputs(struct tiles *s, int k)
{
    struct emitter *e = &s->stages[k].e;
    int stored = 0;
    for (int i = 0; i < s->stores_count && !e->failed; i++) {
        int node = s->stores[i];
        if (!is_of(s, i, k))
            continue;
        if (is_near(s, node))
            text_put(&e->body, "        OUT_%s(n%d, i, %s);\n",
                     memory_kind(s->g->nodes[node].type), stored,
                     stored_value(s, k, node).text);
        stored++;
    }
    if (!has_targets(s, k))
        return;
    text_put(&e->body,
             "        if (in_x >= left && in_x < left + across && in_y >= above && in_y < "
             "above + down) {\n");
    stored = 0;
    for (int i = 0; i < s->stores_count && !e->failed; i++) {
        int node = s->stores[i];
        if (!is_of(s, i, k))
            continue;
        if (s->g->nodes[node].target)
            text_put(&e->body, "        OUT_%s(o%d, (size_t)row * PITCH + x, %s);\n",
                     memory_kind(s->g->nodes[node].type), stored,
                     stored_value(s, k, node).text);
        stored++;
    }
    text_put(&e->body, "        }\n");
}

static void stage_text(struct tiles *s, int k)
{
    struct stage *stage = &s->stages[k];
    struct emitter *e = &stage->e;
    struct text *t = &stage->text;
    emitter_init(e, s->g, s->set, k);
    e->bare = e->near = true;
    outputs(s, k);
    head(s, k, t);
    /* The only quotients: they are dear. */
    text_put(
        t, "    const int S0 = 1, all = wide * max(high, 0);\n"
           "    const int step_x = GROUP %% wide, step_y = GROUP / wide;\n"
           "    int in_x = item %% wide, in_y = item / wide;\n"
           "    for (int i = item; i < all; i += GROUP) {\n"
           "        const int x = x0 + in_x, row = wrap(y0 + in_y, D0), r0 = row, c0 = row;\n");
    text_put(t, "%s", e->rows.data ? e->rows.data : "");
    pointers(s, e, t);
    text_put(t,
             "%s%s        in_x += step_x;\n        in_y += step_y;\n"
             "        if (in_x >= wide) {\n            in_x -= wide;\n            in_y++;\n"
             "        }\n    }\n}\n",
             e->constants.data ? e->constants.data : "", e->body.data ? e->body.data : "");
    s->failed = s->failed || t->failed || e->failed || e->body.failed || e->rows.failed ||
                e->constants.failed;
    stage->same = k;
    for (int i = k - 1; i >= 0 && !s->failed; i--)
        if (text_same(&s->stages[i].text, t))
            stage->same = i;
}

/* ---- the kernel ---- */

static void kernel_head(struct tiles *s, struct text *t)
{
    int constant = 0;
    text_put(t,
             "__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1)))\nvoid k(int W, int "
             "PITCH, int RUN, int PLOG2, int RATIO, int D0");
    for (int i = 0; i < s->arguments.count; i++) {
        const struct kernel_argument *a = &s->arguments.list[i];
        const char *type = memory_type(s->g->nodes[a->node].type);
        if (a->kind == ARGUMENT_INPUT)
            text_put(t, ",\n    const __global %s *restrict b%d", type, a->node);
        else if (a->kind == ARGUMENT_OUTPUT)
            text_put(t, ",\n    __global %s *restrict o%d", type, a->node);
        else
            emit_number(t, s->g, a, &constant);
    }
    text_put(t,
             ")\n{\n    __local ulong memory[%d];\n"
             "    __local uchar *const near = (__local uchar *)memory;\n"
             "    const int item = get_local_id(0);\n"
             "    const int x0 = get_group_id(0) * %d, y0 = get_group_id(1) * RUN;\n"
             "    const int across = min(%d, W - x0), down = min(RUN, D0 - y0);\n",
             s->tiling.bytes / 8 + 1, s->tiling.width, s->tiling.width);
}

static void near_pointer(const struct tiles *s, struct text *t, int node)
{
    text_put(t, ",\n        (__local %s *)(near + %d)", memory_type(s->g->nodes[node].type),
             s->tiling.arrays[s->array[node] - 1].at);
}

/* A shift of what is shifted already may be a stage later than what it looks at, with nothing
 * in between. */
static bool is_empty(const struct tiles *s, int stage)
{
    for (int i = 0; i < s->stores_count; i++)
        if (is_of(s, i, stage))
            return false;
    return true;
}

static void stage_call(const struct tiles *s, struct text *t, int k)
{
    const struct emitter *e = &s->stages[k].e;
    const struct tile_stage *to = &s->tiling.stages[k];
    if (k)
        text_put(t, "    barrier(CLK_LOCAL_MEM_FENCE);\n");
    text_put(t,
             "    s%d(W, PITCH, PLOG2, RATIO, D0, item, x0 - %d, y0 - %d, %d, down + %d, %d, "
             "%d, across, down",
             s->stages[k].same, to->left, to->above, s->tiling.width + to->left + to->right,
             to->above + to->below, to->left, to->above);
    for (int i = 0; i < e->pointers_count; i++) {
        const struct access *p = &e->seen_pointers[i];
        if (s->g->nodes[p->node].leaf) {
            text_put(t, ", b%d", p->node);
            continue;
        }
        const struct tile_stage *from = &s->tiling.stages[s->g->nodes[p->node].stage];
        int wide = s->tiling.width + from->left + from->right;
        near_pointer(s, t, p->node);
        text_put(t, " + %d, %d",
                 (from->above - to->above + emit_rows_down(e, p)) * wide + from->left -
                     to->left,
                 wide);
    }
    for (int i = 0; i < s->stores_count; i++) {
        if (!is_of(s, i, k))
            continue;
        if (is_near(s, s->stores[i]))
            near_pointer(s, t, s->stores[i]);
        if (s->g->nodes[s->stores[i]].target)
            text_put(t, ", o%d", s->stores[i]);
    }
    emit_numbers_passed(t, e, s->number);
    text_put(t, ");\n");
}

static void kernel_text(struct tiles *s, struct text *t)
{
    bool integers = false;
    for (int k = 0; k < s->stages_count; k++)
        integers = integers || s->stages[k].e.integers;
    if (integers)
        text_put(t, "%s", kernel_integers_cl);
    text_put(t,
             "#define GROUP %d\n#define NEAR(dx) (in_x + (dx))\n#define BOX(e) (e)\n"
             "/* tiles of %d x %d */\n",
             s->shape->group, s->tiling.width, s->tiling.height);
    for (int k = 0; k < s->stages_count; k++)
        if (s->stages[k].same == k && !is_empty(s, k))
            text_put(t, "void s%d%s", k, s->stages[k].text.data);
    for (int i = 0; i < s->stages_count; i++)
        emit_collect(&s->arguments, &s->stages[i].e, s->number, &s->constants_count,
                     &s->failed);
    for (int i = 0; i < s->stores_count; i++)
        if (s->g->nodes[s->stores[i]].target)
            emit_argument(&s->arguments, ARGUMENT_OUTPUT, s->stores[i], 0, &s->failed);
    kernel_head(s, t);
    for (int k = 0; k < s->stages_count; k++)
        if (!is_empty(s, k))
            stage_call(s, t, k);
    text_put(t, "}\n");
}

static void describe(const struct tiles *s, struct kernel_text *out)
{
    for (int k = 0; k < s->stages_count; k++) {
        const struct emitter *e = &s->stages[k].e;
        out->formats = out->formats || e->formats;
        out->math = out->math || e->math;
        out->ops += e->ops;
        out->cost += e->cost;
        out->loads += e->loads;
    }
    out->vector = 1;
    out->wraps = true;
    out->group = s->shape->group;
    out->tile_width = s->tiling.width;
    out->tile_height = s->tiling.height;
    emit_options(out, s->set->halo, true, false, LANE_WIDE);
}

/* Elements of up to 64 bits, and operations that are written in vectors, as for strips. */
static bool suits(const struct tiles *s)
{
    for (int k = 0; k < s->stages_count; k++)
        if (s->stages[k].looks.wide || s->stages[k].looks.soft)
            return false;
    return !s->set->halo;
}

static void tiles_finish(struct tiles *s)
{
    for (int k = 0; s->stages && k < s->stages_count; k++) {
        accesses_finish(&s->stages[k].looks);
        emitter_finish(&s->stages[k].e);
        free(s->stages[k].e.arguments.list);
        free(s->stages[k].text.data);
    }
    free(s->stages);
    free(s->bits_matter);
    free(s->array);
    free(s->number);
    tiling_finish(&s->tiling);
}

static bool schedule(struct tiles *s)
{
    accesses_find_bits(s->g, s->bits_matter);
    for (int k = 0; k < s->stages_count && !s->failed; k++)
        stage_accesses(s, k);
    if (s->failed || !suits(s))
        return false;
    find_arrays(s);
    find_extents(s);
    find_costs(s);
    return tiles_choose(&s->tiling, s->set, s->shape, true);
}

bool tiles_emit(const struct plan_graph *g, const int *stores, int count,
                const struct vpset *set, const struct device_shape *shape,
                struct kernel_text *out)
{
    struct tiles s = {
        .g = g, .set = set, .shape = shape, .stores = stores, .stores_count = count};
    struct text t = {0};
    memset(out, 0, sizeof *out);
    for (int i = 0; i < count; i++)
        widen(&s.stages_count, g->nodes[stores[i]].stage + 1);
    s.stages = calloc((size_t)s.stages_count, sizeof *s.stages);
    s.bits_matter = calloc((size_t)g->count, sizeof *s.bits_matter);
    s.array = calloc((size_t)g->count, sizeof *s.array);
    s.number = calloc((size_t)g->count, sizeof *s.number);
    s.failed = !s.stages || !s.bits_matter || !s.array || !s.number;
    bool good = !s.failed && schedule(&s);
    for (int k = 0; k < s.stages_count && good; k++) {
        stage_text(&s, k);
        good = !s.failed;
    }
    if (good) {
        kernel_text(&s, &t);
        describe(&s, out);
        good = !s.failed && !t.failed;
    }
    emit_hand_over(good, &t, &s.arguments, out);
    tiles_finish(&s);
    return good;
}
