/* strips_text.c - the text of kernels in strips. See strips.h. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/types.h"
#include "codegen/claims.h"
#include "codegen/strips.h"
#include "kernels.h"
#include "plan/lanes.h"

/* ---- the kernel ---- */

static void collect_arguments(struct strips *s)
{
    for (int k = 0; k < s->passes_count; k++)
        emit_collect(&s->arguments, &s->passes[k].e, s->number, &s->constants_count,
                     &s->failed);
    for (int i = 0; i < s->stores_count; i++)
        if (s->g->nodes[s->stores[i]].target)
            emit_argument(&s->arguments, ARGUMENT_OUTPUT, s->stores[i], 0, &s->failed);
    if (s->in_place.pairs_count)
        emit_argument(&s->arguments, ARGUMENT_BORDERS, 0, 4, &s->failed);
    emit_argument(&s->arguments, ARGUMENT_SCRATCH, 0, 0, &s->failed);
    if (s->shape->claims)
        claims_add(&s->arguments, &s->failed);
}

static void kernel_head(struct strips *s, struct text *t)
{
    text_put(t, "__kernel WHOLE_VECTORS void k(int W, int PITCH, int RUN, int PLOG2, int "
                "RATIO, int D0, int "
                "COLUMNS");
    int constant = 0;
    for (int i = 0; i < s->arguments.count; i++) {
        const struct kernel_argument *a = &s->arguments.list[i];
        struct machine_type type = s->g->nodes[a->node].type;
        if (a->kind == ARGUMENT_INPUT)
            text_put(t, ",\n    const __global %s *%s b%d", memory_type(type),
                     strips_border_of(s, a->node) < 0 ? "restrict" : "", a->node);
        else if (a->kind == ARGUMENT_OUTPUT)
            text_put(t, ",\n    __global %s *%s o%d", memory_type(type),
                     strips_in_places(s, a->node) ? "" : "restrict", a->node);
        else if (a->kind == ARGUMENT_BORDERS)
            text_put(t, ",\n    uint borders");
        else if (a->kind == ARGUMENT_SCRATCH)
            text_put(t, ",\n    __global uchar *scratch");
        else if (claims_declare(t, a))
            continue;
        else
            emit_number(t, s->g, a, &constant);
    }
    text_put(
        t,
        ")\n{\n%s"
        "    const int top = down * RUN, bottom = min(top + RUN, D0);\n"
        "    const int first = across * COLUMNS;\n"
        "    const int last = across + 1 == get_global_size(0) ? W : first + COLUMNS;\n"
        "    __global uchar *const near = scratch + (down * get_global_size(0) + across) *\n"
        "        (size_t)(NEAR * %d);\n",
        claims_place(s->shape->claims), s->memory + 8);
    if (s->in_place.pairs_count)
        text_put(t,
                 "    const __global uchar *const around = scratch + get_global_size(1) * "
                 "get_global_size(0) *\n        (size_t)(NEAR * %d);\n",
                 s->memory + 8);
    for (int k = 0; k < s->passes_count; k++) {
        text_put(t, "    const int2 inside%d = ", k);
        if (strips_has_boxes(s, &s->passes[k].e)) {
            text_put(t, "s%d_inside(W, first, last", s->passes[k].same);
            emit_numbers_passed(t, &s->passes[k].e, s->number);
            text_put(t, ");\n");
        } else {
            text_put(t, "(int2)(0, 0);\n");
        }
    }
}

static void ring_row(const struct strips *s, struct text *t, const struct ring_row *row)
{
    const struct rings *rings = &s->rings[row->rings];
    text_put(t, ",\n                near + NEAR * %d + ring(y + (%d), %d) * (NEAR * %d)",
             rings->at + row->first, row->down, rings->rows, rings->bytes);
}

/* The lowest row of arrays from `from` on, so far below its own, that the pass looks at or
 * stores; INT_MAX: there is none. */
static int row_from(const struct strips *s, const struct pass *pass, int from)
{
    const struct emitter *e = &pass->e;
    int lowest = INT_MAX;
    for (int i = 0; i < e->pointers_count + pass->outputs_count; i++) {
        bool reads = i < e->pointers_count;
        const struct output *o = reads ? NULL : &pass->outputs[i - e->pointers_count];
        if (reads ? !s->g->nodes[e->seen_pointers[i].node].leaf : !o->array)
            continue;
        int down = reads ? emit_rows_down(e, &e->seen_pointers[i]) : s->down[o->node];
        lowest = down >= from && down < lowest ? down : lowest;
    }
    return lowest;
}

/* Where a pass's rows are in arrays, and in what has been copied of such as are written in
 * place: once for all arrays, for in each one's own address compilers would make questions of
 * it again. Returns the lowest of them. */
static int row_places(const struct strips *s, const struct pass *pass, struct text *t)
{
    int lowest = row_from(s, pass, INT_MIN);
    for (int down = lowest; down < INT_MAX; down = row_from(s, pass, down + 1)) {
        int row = down - lowest;
        text_put(t,
                 "                const size_t row%d = (size_t)wrap(y + (%d), D0) * PITCH;\n",
                 row, down);
        if (s->in_place.pairs_count)
            text_put(
                t,
                "                const bool out%d = y + (%d) < top || y + (%d) >= bottom;\n"
                "                const size_t copy%d = border_row(y + (%d), top, bottom, "
                "down) * PITCH;\n",
                row, down, down, row, down);
    }
    return lowest;
}

static void array_row(struct text *t, char letter, int node, int row)
{
    text_put(t, ",\n                    %c%d + row%d + HALO", letter, node, row);
}

/* One that may be written in place. */
static void bordered_row(const struct strips *s, struct text *t, int border, int row)
{
    const struct in_place *in = &s->in_place;
    int node = in->leaves[border], before = 0;
    for (int i = 0; i < border; i++)
        before += (int)type_bytes(s->g->nodes[in->leaves[i]].type);
    text_put(t,
             ",\n                    (out%d && borders >> %d & 1\n"
             "                        ? (const __global %s *)(around + (size_t)PITCH * %d * "
             "BORDERS) + copy%d\n                        : b%d + row%d) + HALO",
             row, border, memory_type(s->g->nodes[node].type), before, row, node, row);
}

static void pass_call(struct strips *s, struct text *t, int k)
{
    const struct pass *pass = &s->passes[k];
    const struct emitter *e = &pass->e;
    text_put(t,
             "        {\n            const int y = i %c %d;\n"
             "            if (y >= top - %d && y < bottom + %d) {\n",
             s->downward > 0 ? '-' : '+', pass->delay, pass->above, pass->below);
    int lowest = row_places(s, pass, t);
    text_put(t,
             "                s%d(W, PITCH, PLOG2, RATIO, D0, y, top, bottom, first, last, "
             "inside%d",
             pass->same, k);
    for (int i = 0; i < e->pointers_count; i++) {
        const struct access *p = &e->seen_pointers[i];
        int row = emit_rows_down(e, p) - lowest, border = strips_border_of(s, p->node);
        if (border >= 0)
            bordered_row(s, t, border, row);
        else if (s->g->nodes[p->node].leaf)
            array_row(t, 'b', p->node, row);
    }
    for (int i = 0; i < pass->outputs_count; i++) {
        int node = pass->outputs[i].node;
        if (pass->outputs[i].array)
            array_row(t, 'o', node, s->down[node] - lowest);
    }
    for (int i = 0; i < pass->ring_rows_count; i++)
        ring_row(s, t, &pass->ring_rows[i]);
    emit_numbers_passed(t, e, s->number);
    text_put(t, ");\n            }\n        }\n");
}

/* What has lanes beyond a row's ends: each kind that is stored. */
static void edges_text(const struct strips *s, struct text *t)
{
    static const char *const kinds[] = {"bit", "u8", "u16", "u32", "u64", "f32", "f64"};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        bool used = false;
        for (int k = 0; k < s->arguments.count && !used; k++)
            used = s->arguments.list[k].kind == ARGUMENT_OUTPUT &&
                   !strcmp(memory_kind(s->g->nodes[s->arguments.list[k].node].type), kinds[i]);
        if (used)
            text_put(t, "EDGES(%s)\n", kinds[i]);
    }
}

static void kernel_text(struct strips *s, struct text *t)
{
    bool integers = false;
    int above = 0, below = 0; /* rows, of i */
    for (int k = 0; k < s->passes_count; k++) {
        const struct pass *pass = &s->passes[k];
        integers = integers || pass->e.integers;
        widen(&above, pass->above - pass->delay * s->downward);
        widen(&below, pass->below + pass->delay * s->downward);
    }
    if (integers)
        text_put(t, "%s", kernel_integers_cl);
    if (s->in_place.pairs_count)
        text_put(t, "#define ABOVE %d\n#define BELOW %d\n", s->in_place.above,
                 s->in_place.below);
    text_put(t, "%s%s", s->shape->claims ? kernel_claims_cl : "", kernel_strips_cl);
    text_put(t, "enum { NEAR = %d, MARGIN = %d }; /* columns of a ring's row, and beyond */\n",
             strips_near_columns(s, strips_columns(s)), s->margin);
    edges_text(s, t);
    for (int k = 0; k < s->passes_count; k++) {
        if (s->passes[k].same == k && strips_has_boxes(s, &s->passes[k].e))
            text_put(t, "__attribute__((noinline)) int2 s%d_inside%s\n", k,
                     s->passes[k].span.data);
        if (s->passes[k].same == k)
            text_put(t, "__attribute__((noinline)) WHOLE_VECTORS void s%d%s\n", k,
                     s->passes[k].text.data);
    }
    kernel_head(s, t);
    text_put(t,
             s->downward > 0 ? "    for (int i = top - %d; i < bottom + %d; i++) {\n"
                             : "    for (int i = bottom + %2$d - 1; i >= top - %1$d; i--) {\n",
             above, below);
    for (int k = 0; k < s->passes_count; k++)
        pass_call(s, t, k);
    text_put(t, "    }\n}\n");
}

static void describe(const struct strips *s, const struct device_shape *shape,
                     struct kernel_text *out)
{
    double bytes = 0;
    for (int k = 0; k < s->passes_count; k++) {
        const struct emitter *e = &s->passes[k].e;
        out->formats = out->formats || e->formats;
        out->math = out->math || e->math;
        out->has_boxes = out->has_boxes || e->row_tests.data || e->column_tests.data;
        out->ops += e->ops;
        out->cost += e->cost;
        out->loads += e->loads;
        widen(&out->strip_margin, s->passes[k].above + s->passes[k].below);
    }
    for (int i = 0; i < s->arguments.count; i++)
        if (s->arguments.list[i].kind == ARGUMENT_INPUT ||
            s->arguments.list[i].kind == ARGUMENT_OUTPUT)
            bytes += (double)(s->set->pitch * s->set->rows) *
                     (double)type_bytes(s->g->nodes[s->arguments.list[i].node].type);
    out->vector = s->vector;
    out->claims = s->shape->claims;
    out->strip_columns = strips_columns(s);
    out->in_place = s->in_place;
    out->in_place.pays = bytes > shape->in_place_bytes;
    out->strip_bytes =
        (size_t)(s->memory + 8) * (size_t)strips_near_columns(s, out->strip_columns);
    emit_options(out, s->set->halo, false, emit_streams(shape, s->set, out->vector, bytes),
                 s->lane);
}

static bool strips_kernel(const struct plan_graph *g, const int *stores, int count,
                          const struct vpset *set, const struct device_shape *shape, int lane,
                          struct kernel_text *out)
{
    struct strips s;
    struct text t = {0};
    memset(out, 0, sizeof *out);
    strips_init(&s, g, stores, count, set, shape, shape->vector * LANE_WIDE / lane);
    s.lane = lane;
    bool good = !s.failed && strips_schedule(&s);
    for (int k = 0; k < s.passes_count && good; k++) {
        strips_pass_make(&s, k);
        good = !s.failed;
    }
    good = good && strips_find_margin(&s);
    if (good) {
        collect_arguments(&s);
        kernel_text(&s, &t);
        describe(&s, shape, out);
        good = !s.failed && !t.failed;
    }
    emit_hand_over(good, &t, &s.arguments, out);
    if (!good) {
        free(s.in_place.pairs);
        out->in_place.pairs = NULL;
    }
    strips_finish(&s);
    return good;
}

bool strips_emit(const struct plan_graph *g, const int *stores, int count,
                 const struct vpset *set, const struct device_shape *shape,
                 struct kernel_text *out)
{
    int lane = shape->narrow ? lanes_of_kernel(g, stores, count, -1) : LANE_WIDE;
    return (lane < LANE_WIDE && strips_kernel(g, stores, count, set, shape, lane, out)) ||
           strips_kernel(g, stores, count, set, shape, LANE_WIDE, out);
}
