/* strips.c - the text of one kernel for several stages: a strip of columns, line by line.
 *
 * What one stage stores for the neighbours of the next need not exist as a whole: each work-item goes down
 * a strip, and each stage handles a row as soon as the rows that it looks at have been made. Those are kept
 * in rings of a few rows as wide as the strip, which stay in the caches.
 *
 *     i = row that the strip has come to
 *
 *     stage 0  at row i          reads arrays            writes ring a
 *     stage 1  at row i - 1      reads arrays, ring a    writes ring b, and an array
 *     stage 2  at row i - 3      reads ring a, ring b    writes an array
 *
 *     delay   how many rows a stage is behind: enough for the lowest row that it looks at
 *     above   how many rows above its strip a stage begins, since later ones look at those; below,
 *             left, right: likewise
 *     ring    rows of an array that are alive at the same time
 *
 * What lies beyond a strip is computed twice, by both neighbours, and stored in rings only. The sheet is a
 * torus: rows beyond its ends are rows of it, and columns are in the halos of arrays, which must be wide
 * enough for all stages together. So many steps of a stencil can go through the caches at once; see Hegarty
 * et al., "Darkroom" (SIGGRAPH 2014), for the same among image filters.
 *
 *     first - left   first                            last   last + right
 *          [ vector ]  [ vector ][ vector ][ vector ]  [ vector ]         those at the ends overlap others
 *
 * Each stage is a function; stages with the same text (as those of one step and the next are) share one. */
#include <stdlib.h>
#include <string.h>

#include "body.h"
#include "kernels.h"

struct stage {
    struct emitter e;
    struct text text; /* of its function, but for its name */
    int same;         /* the first stage with that text */
    int delay, above, below, left, right;
    int *outputs; /* nodes, those of its rings first, then those of arrays */
    int rings_count, outputs_count;
};

struct strips {
    const struct plan_graph *g;
    const struct vpset *set;
    struct stage *stages;
    int stages_count;
    int *ring_rows; /* of a node: how many; 0: no ring */
    int *ring_at;   /* of a node: where in the strip's memory, in bytes for each column */
    int *number;    /* of a node that is a number, + 1; of an array that is read */
    int memory;     /* of a strip, bytes for each column */
    struct kernel_argument *arguments;
    int arguments_count, arguments_capacity, constants_count;
    bool failed;
};

static void add_argument(struct strips *s, int kind, int node, int size)
{
    if (s->arguments_count == s->arguments_capacity) {
        int capacity = s->arguments_capacity ? 2 * s->arguments_capacity : 64;
        void *new = realloc(s->arguments, (size_t)capacity * sizeof *s->arguments);
        if (!new) {
            s->failed = true;
            return;
        }
        s->arguments = new;
        s->arguments_capacity = capacity;
    }
    s->arguments[s->arguments_count++] =
        (struct kernel_argument){.kind = (uint8_t)kind, .size = (uint8_t)size, .node = node};
}

/* ---- which rows ---- */

static int rows_down(const struct stage *stage, const struct pointer *p)
{
    return stage->e.row_offsets[p->row].d[0];
}

/* Row offsets are modulo the height: the short way round. */
static int short_way(const struct strips *s, int offset)
{
    int height = s->set->dimensions[0];
    offset %= height;
    return offset > height / 2      ? offset - height
           : offset < -(height / 2) ? offset + height
                                    : offset;
}

static void schedule(struct strips *s)
{
    for (int k = 0; k < s->stages_count; k++) {
        struct stage *to = &s->stages[k];
        for (int i = 0; i < to->e.pointers_count; i++) {
            const struct pointer *p = &to->e.seen_pointers[i];
            const struct plan_node *n = &s->g->nodes[p->node];
            int down = short_way(s, rows_down(to, p));
            if (!n->leaf && s->stages[n->stage].delay + down > to->delay)
                to->delay = s->stages[n->stage].delay + down;
        }
    }
    for (int k = s->stages_count - 1; k >= 0; k--) {
        struct stage *to = &s->stages[k];
        for (int i = 0; i < to->e.pointers_count; i++) {
            const struct pointer *p = &to->e.seen_pointers[i];
            const struct plan_node *n = &s->g->nodes[p->node];
            if (n->leaf)
                continue;
            struct stage *from = &s->stages[n->stage];
            int down = short_way(s, rows_down(to, p));
            int rows = to->delay - from->delay - down + 1;
            from->above = to->above - down > from->above ? to->above - down : from->above;
            from->below = to->below + down > from->below ? to->below + down : from->below;
            from->left = to->left - p->low > from->left ? to->left - p->low : from->left;
            from->right = to->right + p->high > from->right ? to->right + p->high : from->right;
            s->ring_rows[p->node] = rows > s->ring_rows[p->node] ? rows : s->ring_rows[p->node];
        }
    }
}

/* Rings of wide elements first, so that all are aligned. */
static void lay_out(struct strips *s)
{
    for (int bytes = 8; bytes >= 1; bytes /= 2)
        for (int i = 0; i < s->g->count; i++)
            if (s->ring_rows[i] && (int)type_bytes(s->g->nodes[i].type) == bytes) {
                s->ring_at[i] = s->memory;
                s->memory += bytes * s->ring_rows[i];
            }
}

/* ---- a stage's function ---- */

static void stage_text(struct strips *s, struct stage *stage)
{
    struct emitter *e = &stage->e;
    struct text *t = &stage->text;
    text_put(t, "(const int W, const int PITCH, const int PLOG2, const int RATIO, const int "
                "D0, const int row,\n    const int first, const int last, const int left, "
                "const int right, const int own");
    for (int i = 0; i < e->pointers_count; i++)
        text_put(t, ",\n    const __global %s *restrict p%d",
                 memory_type(s->g->nodes[e->seen_pointers[i].node].type), i);
    for (int i = 0; i < stage->outputs_count; i++)
        text_put(t, ",\n    __global %s *restrict q%d",
                 memory_type(s->g->nodes[stage->outputs[i]].type), i);
    int number = 0;
    for (int i = 0; i < e->arguments_count; i++)
        if (e->arguments[i].kind == ARGUMENT_CONSTANT)
            emit_number(t, s->g, e->arguments[i].node, number++);
        else
            text_put(t, ", ulong h%d", number - 1);
    text_put(t, ")\n{\n    const int r0 = row;\n");
    emit_axes(e, t);
    text_put(t, "%s%s", e->rows.data ? e->rows.data : "",
             e->constants.data ? e->constants.data : "");
    emit_loop(
        e, t,
        "    const int whole = (last - first + VECTOR - 1) / VECTOR;\n"
        "    for (int n = -(left > 0); n < whole + (right > 0); n++) {\n"
        "        const bool inside = n >= 0 && n < whole && own;\n"
        "        const int x = n < 0 ? first - left : n == whole ? last + right - VECTOR\n"
        "            : min(first + n * VECTOR, last - VECTOR);\n",
        (e->row_tests.data || e->column_tests.data) && s->g->boxes);
    text_put(t, "}\n");
    s->failed = s->failed || t->failed || e->failed || e->body.failed || e->rows.failed ||
                e->constants.failed || e->row_tests.failed || e->column_tests.failed;
}

/* The values first: which rings there are follows from what all stages look at. */
static void stage_values(struct strips *s, int k, const int *stores, int count)
{
    struct stage *stage = &s->stages[k];
    emitter_init(&stage->e, s->g, s->set, k);
    stage->e.bare = true;
    for (int i = 0; i < count && !stage->e.failed; i++)
        if (s->g->nodes[stores[i]].stage == k)
            emit_value(&stage->e, stores[i], 0, 0, true);
    s->failed = s->failed || stage->e.failed;
}

static void stage_outputs(struct strips *s, int k, const int *stores, int count)
{
    struct stage *stage = &s->stages[k];
    stage->outputs = calloc(2 * (size_t)count, sizeof *stage->outputs);
    if (!stage->outputs) {
        s->failed = true;
        return;
    }
    for (int target = 0; target < 2; target++) {
        for (int i = 0; i < count; i++) {
            const struct plan_node *n = &s->g->nodes[stores[i]];
            if (n->stage != k || !(target ? n->target : s->ring_rows[stores[i]] > 0))
                continue;
            struct operand v = emit_value(&stage->e, stores[i], 0, 0, true);
            text_put(&stage->e.body,
                     target ? "        if (inside)\n            STORE(%s, q%d, %s);\n"
                            : "        OUT_%s(q%d, x, %s);\n",
                     memory_kind(n->type), stage->outputs_count, v.text);
            stage->outputs[stage->outputs_count++] = stores[i];
        }
        if (!target)
            stage->rings_count = stage->outputs_count;
    }
    stage_text(s, stage);
    stage->same = k;
    for (int i = k - 1; i >= 0 && !s->failed; i--)
        if (!strcmp(s->stages[i].text.data, stage->text.data))
            stage->same = i;
}

/* ---- the kernel ---- */

static void collect_arguments(struct strips *s, const int *stores, int count)
{
    for (int k = 0; k < s->stages_count; k++) {
        const struct emitter *e = &s->stages[k].e;
        for (int i = 0; i < e->pointers_count; i++) {
            int node = e->seen_pointers[i].node;
            if (s->g->nodes[node].leaf && !s->number[node]) {
                add_argument(s, ARGUMENT_INPUT, node, 0);
                s->number[node] = node + 1;
            }
        }
        bool fresh = false;
        for (int i = 0; i < e->arguments_count; i++) {
            const struct kernel_argument *a = &e->arguments[i];
            if (a->kind == ARGUMENT_CONSTANT) {
                fresh = !s->number[a->node];
                s->number[a->node] = fresh ? ++s->constants_count : s->number[a->node];
            }
            if (fresh)
                add_argument(s, a->kind, a->node, a->size);
        }
    }
    for (int i = 0; i < count; i++)
        if (s->g->nodes[stores[i]].target)
            add_argument(s, ARGUMENT_OUTPUT, stores[i], 0);
    add_argument(s, ARGUMENT_SCRATCH, 0, 0);
}

static void kernel_head(struct strips *s, struct text *t)
{
    text_put(t, "__kernel WHOLE_VECTORS void k(int W, int PITCH, int RUN, int PLOG2, int "
                "RATIO, int D0");
    int constant = 0;
    for (int i = 0; i < s->arguments_count; i++) {
        const struct kernel_argument *a = &s->arguments[i];
        struct machine_type type = s->g->nodes[a->node].type;
        if (a->kind == ARGUMENT_INPUT)
            text_put(t, ",\n    const __global %s *restrict b%d", memory_type(type), a->node);
        else if (a->kind == ARGUMENT_OUTPUT)
            text_put(t, ",\n    __global %s *restrict o%d", memory_type(type), a->node);
        else if (a->kind == ARGUMENT_CONSTANT)
            emit_number(t, s->g, a->node, constant++);
        else if (a->kind == ARGUMENT_SECOND)
            text_put(t, ", ulong h%d", constant - 1);
        else
            text_put(t, ",\n    __global uchar *scratch");
    }
    text_put(
        t,
        ")\n{\n"
        "    const int top = get_global_id(1) * RUN, bottom = min(top + RUN, D0);\n"
        "    const int first = get_global_id(0) * COLUMNS;\n"
        "    const int last = get_global_id(0) + 1 == get_global_size(0) ? W : first + "
        "COLUMNS;\n"
        "    __global uchar *const near = scratch + (get_global_id(1) * get_global_size(0) +\n"
        "        get_global_id(0)) * (size_t)(NEAR * %d);\n",
        s->memory + 8);
    for (int i = 0; i < s->g->count; i++)
        if (s->ring_rows[i])
            text_put(t, "    __global %s *const n%d = (__global %s *)(near + NEAR * %d);\n",
                     memory_type(s->g->nodes[i].type), i, memory_type(s->g->nodes[i].type),
                     s->ring_at[i]);
}

static void ring_row(struct strips *s, struct text *t, int node, int down)
{
    text_put(t, ",\n                n%d + (ring(y + (%d), %d) * NEAR + HALO) - first", node,
             down, s->ring_rows[node]);
}

static void stage_call(struct strips *s, struct text *t, int k)
{
    const struct stage *stage = &s->stages[k];
    const struct emitter *e = &stage->e;
    text_put(t,
             "        {\n            const int y = i - %d, row = wrap(y, D0);\n"
             "            if (y >= top - %d && y < bottom + %d)\n"
             "                s%d(W, PITCH, PLOG2, RATIO, D0, row, first, last, %d, %d, "
             "y >= top && y < bottom",
             stage->delay, stage->above, stage->below, stage->same, stage->left, stage->right);
    for (int i = 0; i < e->pointers_count; i++) {
        const struct pointer *p = &e->seen_pointers[i];
        int down = short_way(s, rows_down(stage, p));
        if (s->g->nodes[p->node].leaf)
            text_put(t, ",\n                b%d + ((size_t)wrap(y + (%d), D0) * PITCH + HALO)",
                     p->node, down);
        else
            ring_row(s, t, p->node, down);
    }
    for (int i = 0; i < stage->outputs_count; i++) {
        int node = stage->outputs[i];
        if (i < stage->rings_count)
            ring_row(s, t, node, 0);
        else
            text_put(t, ",\n                o%d + ((size_t)row * PITCH + HALO)", node);
    }
    for (int i = 0; i < e->arguments_count; i++)
        text_put(t, ", %c%d", e->arguments[i].kind == ARGUMENT_CONSTANT ? 'a' : 'h',
                 s->number[e->arguments[i].node] - 1);
    text_put(t, ");\n        }\n");
}

static void kernel_text(struct strips *s, struct text *t)
{
    bool integers = false;
    int begin = 0, end = 0;
    for (int k = 0; k < s->stages_count; k++) {
        const struct stage *stage = &s->stages[k];
        integers = integers || stage->e.integers;
        begin = stage->delay - stage->above < begin ? stage->delay - stage->above : begin;
        end = stage->delay + stage->below > end ? stage->delay + stage->below : end;
    }
    if (integers)
        text_put(t, "%s", kernel_integers_cl);
    text_put(t, "inline int ring(int y, int rows)\n{\n    y %%= rows;\n    return y < 0 ? y + "
                "rows : y;\n}\n");
    for (int k = 0; k < s->stages_count; k++)
        if (s->stages[k].same == k)
            text_put(t, "__attribute__((noinline)) WHOLE_VECTORS void s%d%s\n", k,
                     s->stages[k].text.data);
    kernel_head(s, t);
    text_put(t, "    for (int i = top + (%d); i < bottom + (%d); i++) {\n", begin, end);
    for (int k = 0; k < s->stages_count; k++)
        stage_call(s, t, k);
    text_put(t, "    }\n}\n");
}

/* Elements of up to 64 bits, and what all stages together look at lies in the halos of arrays. */
static bool suits(const struct strips *s, const struct device_shape *shape)
{
    for (int k = 0; k < s->stages_count; k++) {
        const struct stage *stage = &s->stages[k];
        if (stage->e.wide || stage->e.soft)
            return false;
        for (int i = 0; i < stage->e.pointers_count; i++) {
            const struct pointer *p = &stage->e.seen_pointers[i];
            if (stage->left - p->low > s->set->halo || stage->right + p->high > s->set->halo)
                return false;
        }
    }
    return s->set->halo >= shape->vector && s->set->width >= 2 * shape->vector;
}

/* A row of a ring: as wide as a strip, of which the last takes what is left, too, and both halos. */
static int near_columns(const struct vpset *set, const struct device_shape *shape)
{
    int columns = 2 * shape->strip_columns;
    columns = columns < set->width ? columns : set->width;
    return (columns + 2 * set->halo + 15) / 16 * 16 + 16;
}

static void describe(const struct strips *s, const struct device_shape *shape,
                     struct kernel_text *out)
{
    double bytes = 0;
    for (int k = 0; k < s->stages_count; k++) {
        const struct emitter *e = &s->stages[k].e;
        out->formats = out->formats || e->formats;
        out->math = out->math || e->math;
        out->has_boxes = out->has_boxes || e->row_tests.data || e->column_tests.data;
        out->ops += e->ops;
        out->cost += e->cost;
        out->loads += e->loads;
    }
    for (int i = 0; i < s->arguments_count; i++)
        if (s->arguments[i].kind == ARGUMENT_INPUT || s->arguments[i].kind == ARGUMENT_OUTPUT)
            bytes += (double)(s->set->pitch * s->set->rows) *
                     (double)type_bytes(s->g->nodes[s->arguments[i].node].type);
    out->vector = shape->vector;
    out->strip_columns = shape->strip_columns;
    out->strip_bytes = (size_t)(s->memory + 8) * (size_t)near_columns(s->set, shape);
    for (int k = 0; k < s->stages_count; k++) {
        int rows = s->stages[k].above + s->stages[k].below;
        out->strip_margin = rows > out->strip_margin ? rows : out->strip_margin;
    }
    snprintf(out->options, sizeof out->options,
             "-DVECTOR=%d -DHALO=%d -DWRAPS=0 -DSTREAMS=%d -DCOLUMNS=%d -DNEAR=%d", out->vector,
             s->set->halo, emit_streams(s->set, out->vector, bytes) ? 1 : 0,
             shape->strip_columns, near_columns(s->set, shape));
}

bool emit_strips(const struct plan_graph *g, const int *stores, int count,
                 const struct vpset *set, const struct device_shape *shape,
                 struct kernel_text *out)
{
    struct strips s = {.g = g, .set = set};
    struct text t = {0};
    memset(out, 0, sizeof *out);
    for (int i = 0; i < count; i++)
        if (g->nodes[stores[i]].stage >= s.stages_count)
            s.stages_count = g->nodes[stores[i]].stage + 1;
    s.stages = calloc((size_t)s.stages_count, sizeof *s.stages);
    s.ring_rows = calloc((size_t)g->count, sizeof *s.ring_rows);
    s.ring_at = calloc((size_t)g->count, sizeof *s.ring_at);
    s.number = calloc((size_t)g->count, sizeof *s.number);
    s.failed = !s.stages || !s.ring_rows || !s.ring_at || !s.number;
    for (int k = 0; k < s.stages_count && !s.failed; k++)
        stage_values(&s, k, stores, count);
    bool good = !s.failed;
    if (good) {
        schedule(&s);
        lay_out(&s);
        good = suits(&s, shape);
    }
    for (int k = 0; k < s.stages_count && good; k++) {
        stage_outputs(&s, k, stores, count);
        good = !s.failed;
    }
    if (good) {
        collect_arguments(&s, stores, count);
        kernel_text(&s, &t);
        describe(&s, shape, out);
        good = !s.failed && !t.failed;
    }
    if (good) {
        out->text = t.data;
        out->arguments = s.arguments;
        out->arguments_count = s.arguments_count;
    } else {
        free(t.data);
        free(s.arguments);
    }
    for (int k = 0; s.stages && k < s.stages_count; k++) {
        emitter_finish(&s.stages[k].e);
        free(s.stages[k].e.arguments);
        free(s.stages[k].text.data);
        free(s.stages[k].outputs);
    }
    free(s.stages);
    free(s.ring_rows);
    free(s.ring_at);
    free(s.number);
    return good;
}
