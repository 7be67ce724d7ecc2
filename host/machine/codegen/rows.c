/* rows.c - the text of one kernel, of rows.
 *
 * The text depends only on the graph: constants and lengths of axes are arguments. The shape is
 *
 *     row = the work-group's, see claims.h; rows at other offsets; a pointer for each array and row
 *     for (x in this run of columns, VECTOR at a time)   the last vector overlaps the one
 *                                                        before it
 *         variables, stores
 *
 * which PoCL compiles to straight vector code (it does not vectorise scalar work-items of
 * this kind); with VECTOR 1 and runs of 1 it is the scalar kernel that a GPU wants.
 */
#include <stdlib.h>
#include <string.h>

#include "base/types.h"
#include "codegen/body.h"
#include "codegen/claims.h"
#include "codegen/numbers.h"
#include "kernels.h"
#include "plan/lanes.h"

/* Of all columns from `begin` to `end`; the last vector may overlap the one before it.
 * boxes: whole vectors from `from` to `to` are inside all boxes. Columns inside are
 * contiguous: their ends are searched from both ends of the row, where most boxes end. */
static void emit_loop(const struct emitter *e, struct text *t, bool boxes)
{
    const char *body = e->body.data ? e->body.data : "",
               *tests = e->column_tests.data ? e->column_tests.data : "";
    if (boxes)
        text_put(
            t,
            "    int from = end, to = end;\n"
            "    if (1%s) {\n"
            "        for (from = begin; from < end; from += VECTOR) {\n"
            "            const int x = from;\n"
            "            if (x + VECTOR <= W%s)\n                break;\n        }\n"
            "        to = begin + (end - begin) / VECTOR * VECTOR;\n"
            "        for (; to > from; to -= VECTOR) {\n"
            "            const int x = to - VECTOR;\n"
            "            if (x + VECTOR <= W%s)\n                break;\n        }\n    }\n",
            e->row_tests.data ? e->row_tests.data : "", tests, tests);
    text_put(t, "    for (int at = begin; at < end; at += VECTOR) {\n");
    if (boxes)
        text_put(t,
                 "        for (; at >= from && at < to; at += VECTOR) {\n"
                 "            const int x = at;\n"
                 "#define BOX(e) ((VI)(-1))\n%s#undef BOX\n        }\n"
                 "        if (at >= end)\n            break;\n",
                 body);
    text_put(t,
             "        const int x = min(at, W - VECTOR);\n"
             "#define BOX(e) (e)\n%s#undef BOX\n    }\n",
             body);
}

static void header(struct emitter *e, struct text *t)
{
    text_put(t,
             "__kernel WHOLE_VECTORS void k(int W, int PITCH, int RUN, int PLOG2, int RATIO");
    for (int a = 0; a < e->set->rank - 1; a++)
        text_put(t, ", int D%d", a);
    int input = 0, output = 0, constant = 0;
    for (int i = 0; i < e->arguments.count; i++) {
        const struct kernel_argument *arg = &e->arguments.list[i];
        struct machine_type type = e->g->nodes[arg->node].type;
        if (arg->kind == ARGUMENT_INPUT)
            text_put(t, ",\n    const __global %s *restrict b%d", memory_type(type), input++);
        else if (arg->kind == ARGUMENT_OUTPUT)
            text_put(t, ",\n    __global %s *restrict o%d", memory_type(type), output++);
        else if (!claims_declare(t, arg))
            emit_number(t, e->g, arg, &constant);
    }
    text_put(t, NUMBER_PARAMETERS ")\n{\n");
}

void kernel_text_finish(struct kernel_text *k)
{
    free(k->text);
    free(k->arguments);
    free(k->in_place.pairs);
    memset(k, 0, sizeof *k);
}

static double bytes_touched(const struct emitter *e)
{
    double bytes = 0;
    for (int i = 0; i < e->arguments.count; i++)
        if (e->arguments.list[i].kind == ARGUMENT_INPUT ||
            e->arguments.list[i].kind == ARGUMENT_OUTPUT)
            bytes += (double)(e->set->pitch * e->set->rows) *
                     (double)type_bytes(e->g->nodes[e->arguments.list[i].node].type);
    return bytes;
}

static bool rows_kernel(const struct plan_graph *g, const int *stores, int stores_count,
                        const struct vpset *set, const struct device_shape *shape, int lane,
                        struct kernel_text *out)
{
    struct emitter *e = calloc(1, sizeof *e);
    memset(out, 0, sizeof *out);
    if (!e)
        return false;
    emitter_init(e, g, set, g->nodes[stores[0]].stage);
    e->lane = lane;
    for (int i = 0; i < stores_count && !e->failed; i++) {
        struct operand v = emit_value(e, stores[i], 0, 0, true);
        struct machine_type type = g->nodes[stores[i]].type;
        emit_argument(&e->arguments, ARGUMENT_OUTPUT, stores[i], 0, &e->failed);
        text_put(&e->pointers, "    __global %s *q%d = o%d + ((size_t)row * PITCH + HALO)%s;\n",
                 memory_type(type), i, i, type.width > 64 ? " * 2" : "");
        text_put(&e->body, "        STORE(%s, q%d, %s);\n", memory_kind(type), i, v.text);
    }
    bool wraps = set->halo == 0 || e->reach > set->halo;
    /* Integers over 64 bits, one lane at a time: sixteen lanes would compile for seconds. */
    bool one =
        wraps || e->wide || e->soft || set->width < shape->vector || set->halo < shape->vector;
    out->vector = one ? 1 : shape->vector * LANE_WIDE / lane;
    out->wraps = wraps;
    out->wide = e->wide;
    out->soft = e->soft;
    out->formats = e->formats;
    out->math = e->math;
    out->claims = shape->claims && out->vector > 1;
    if (out->claims)
        claims_add(&e->arguments, &e->failed);
    struct text t = {0};
    if (e->integers)
        text_put(&t, "%s", kernel_integers_cl);
    if (out->claims)
        text_put(&t, "%s", kernel_claims_cl);
    header(e, &t);
    text_put(&t, "%s    const int row = down;\n    const int r0 = row;\n",
             claims_place(out->claims));
    emit_axes(e, &t);
    text_put(&t, "%s%s%s", e->rows.data ? e->rows.data : "",
             e->pointers.data ? e->pointers.data : "",
             e->constants.data ? e->constants.data : "");
    text_put(&t, "    const int begin = across * RUN, end = min(begin + RUN, W);\n");
    out->has_boxes = (e->row_tests.data || e->column_tests.data) && out->vector > 1;
    emit_loop(e, &t, out->has_boxes && g->boxes);
    text_put(&t, "}\n");
    out->text = t.data;
    out->arguments = e->arguments.list;
    out->arguments_count = e->arguments.count;
    out->ops = e->ops;
    out->cost = e->cost;
    out->loads = e->loads;
    emit_options(out, set->halo, wraps, emit_streams(shape, set, out->vector, bytes_touched(e)),
                 lane);
    bool good = !e->failed && !t.failed && !e->body.failed && !e->rows.failed &&
                !e->pointers.failed && !e->constants.failed && !e->row_tests.failed &&
                !e->column_tests.failed;
    emitter_finish(e);
    free(e);
    if (!good)
        kernel_text_finish(out);
    return good;
}

bool rows_emit(const struct plan_graph *g, const int *stores, int stores_count,
               const struct vpset *set, const struct device_shape *shape,
               struct kernel_text *out)
{
    int lane = shape->narrow && set->halo
                   ? lanes_of_kernel(g, stores, stores_count, g->nodes[stores[0]].stage)
                   : LANE_WIDE;
    if (lane < LANE_WIDE && set->width >= shape->vector * LANE_WIDE / lane) {
        if (!rows_kernel(g, stores, stores_count, set, shape, lane, out))
            return false;
        if (out->vector > 1)
            return true;
        kernel_text_finish(out);
    }
    return rows_kernel(g, stores, stores_count, set, shape, LANE_WIDE, out);
}
