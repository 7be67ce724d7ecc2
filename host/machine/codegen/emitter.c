/* emitter.c - what the shapes of kernels share: see body.h. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/node_ops.h"
#include "codegen/body.h"
#include "codegen/numbers.h"
#include "codegen/spell.h"

void emit_argument(struct arguments *to, int kind, int node, int size, bool *failed)
{
    if (to->count == to->capacity)
        to->list = array_more(to->list, &to->capacity, sizeof *to->list, failed);
    if (!*failed)
        to->list[to->count++] = (struct kernel_argument){
            .kind = (uint8_t)kind, .size = (uint8_t)size, .node = node};
}

bool emitter_init(struct emitter *e, const struct plan_graph *g, const struct vpset *set,
                  int stage)
{
    *e = (struct emitter){.g = g, .set = set, .stage = stage, .lane = 32};
    e->input_number = calloc((size_t)g->count, sizeof *e->input_number);
    e->constant_number = calloc((size_t)g->count, sizeof *e->constant_number);
    e->row_offsets = calloc(64, sizeof *e->row_offsets);
    e->rows_capacity = 64;
    e->rows_count = 1; /* row 0: where we are */
    e->failed = !e->input_number || !e->constant_number || !e->row_offsets;
    return !e->failed;
}

void emitter_finish(struct emitter *e)
{
    free(e->body.data);
    free(e->rows.data);
    free(e->pointers.data);
    free(e->constants.data);
    free(e->row_tests.data);
    free(e->column_tests.data);
    free(e->variables);
    free(e->row_offsets);
    free(e->seen_pointers);
    free(e->input_number);
    free(e->constant_number);
}

void emit_axes(const struct emitter *e, struct text *t)
{
    const struct vpset *set = e->set;
    if (!e->axes_used || set->rank < 2)
        return;
    text_put(t, "    const int S%d = 1;\n", set->rank - 2);
    for (int a = set->rank - 3; a >= 0; a--)
        text_put(t, "    const int S%d = S%d * D%d;\n", a, a + 1, a + 1);
    text_put(t, "    const int c0 = row / S0;\n");
    for (int a = 1; a < set->rank - 1; a++)
        text_put(t, "    const int c%d = row / S%d %% D%d;\n", a, a, a);
}

void emit_number(struct text *t, const struct plan_graph *g, const struct kernel_argument *a,
                 int *count)
{
    static const char letters[] = "IUFDLQ";
    static const char *const names[] = {"int", "uint", "float", "double", "ulong", "ulong"};
    const struct plan_node *n = &g->nodes[a->node];
    if (a->kind == ARGUMENT_SECOND)
        text_put(t, ", ulong h%d", *count - 1);
    else if (n->op == NODE_RANDOM)
        text_put(t, ", ulong a%d", (*count)++);
    else
        text_put(t, ", %s a%d", names[strchr(letters, spell_letter(n->type)) - letters],
                 (*count)++);
}

int emit_rows_down(const struct emitter *e, const struct access *p)
{
    return row_down(e->set, &e->row_offsets[p->row]);
}

void emit_collect(struct arguments *to, const struct emitter *e, int *number, int *count,
                  bool *failed)
{
    for (int i = 0; i < e->pointers_count; i++) {
        int node = e->seen_pointers[i].node;
        if (e->g->nodes[node].leaf && !number[node]) {
            emit_argument(to, ARGUMENT_INPUT, node, 0, failed);
            number[node] = node + 1;
        }
    }
    bool fresh = false;
    for (int i = 0; i < e->arguments.count; i++) {
        const struct kernel_argument *a = &e->arguments.list[i];
        if (a->kind == ARGUMENT_CONSTANT) {
            fresh = !number[a->node];
            number[a->node] = fresh ? ++*count : number[a->node];
        }
        if (fresh)
            emit_argument(to, a->kind, a->node, a->size, failed);
    }
}

void emit_numbers(struct text *t, const struct emitter *e)
{
    int count = 0;
    for (int i = 0; i < e->arguments.count; i++)
        emit_number(t, e->g, &e->arguments.list[i], &count);
}

void emit_numbers_passed(struct text *t, const struct emitter *e, const int *number)
{
    for (int i = 0; i < e->arguments.count; i++)
        text_put(t, ", %c%d", e->arguments.list[i].kind == ARGUMENT_CONSTANT ? 'a' : 'h',
                 number[e->arguments.list[i].node] - 1);
}

void emit_options(struct kernel_text *k, int halo, bool wraps, bool streams, int lane)
{
    int n =
        snprintf(k->options, sizeof k->options, "-DVECTOR=%d -DHALO=%d -DWRAPS=%d -DSTREAMS=%d",
                 k->vector, halo, wraps, streams);
    if (lane < 32)
        snprintf(k->options + n, sizeof k->options - (size_t)n, " -DLANE=%d", lane);
}

void emit_hand_over(bool good, struct text *t, struct arguments *a, struct kernel_text *out)
{
    if (good) {
        numbers_write(t->data);
        out->text = t->data;
        out->arguments = a->list;
        out->arguments_count = a->count;
    } else {
        free(t->data);
        free(a->list);
    }
}

bool emit_streams(const struct device_shape *shape, const struct vpset *set, int vector,
                  double bytes)
{
    return shape->streams && vector > 1 && set->width % vector == 0 &&
           bytes > shape->stream_bytes;
}
