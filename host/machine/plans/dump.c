/* dump.c - writes graphs and kernels to files (LUTETIA_DUMP). */
#include <exit_status.h>
#include <output_file.h>
#include <visible_text.h>

#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "plans/plans.h"

enum { PATH_BYTES = 600 };

/* A file that cannot be written is reported once; the program goes on without dumps, and does
 * not end with 0. */
static void dump_fail(struct machine *m, const char *path, const char *why)
{
    visible_say("LUTETIA_DUMP: cannot write %s: %s", path, why);
    exit_status_fail();
    free(m->plans->dump_dir);
    m->plans->dump_dir = NULL;
}

static void path_make(char path[static PATH_BYTES], const struct machine *m, int number,
                      const char *suffix)
{
    snprintf(path, PATH_BYTES, "%s/%04d%s", m->plans->dump_dir, number, suffix);
}

static bool dump_open(struct machine *m, int number, const char *suffix,
                      struct output_file *out)
{
    char path[PATH_BYTES];
    mkdir(m->plans->dump_dir, 0777);
    path_make(path, m, number, suffix);
    if (output_file_open(out, path))
        return true;
    dump_fail(m, path, out->why);
    return false;
}

static void dump_close(struct machine *m, int number, const char *suffix,
                       struct output_file *out)
{
    char path[PATH_BYTES];
    path_make(path, m, number, suffix);
    if (!output_file_commit(out))
        dump_fail(m, path, out->why);
}

void dump_text(struct machine *m, int number, const char *suffix, const char *options,
               const char *text)
{
    struct output_file out;
    if (!dump_open(m, number, suffix, &out))
        return;
    if (options)
        fprintf(out.stream, "/* %s */\n", options);
    fputs(text, out.stream);
    dump_close(m, number, suffix, &out);
}

void dump_graph(struct machine *m, int number, const struct plan_graph *g)
{
    struct output_file out;
    if (!dump_open(m, number, ".graph", &out))
        return;
    FILE *f = out.stream;
    for (int i = 0; i < g->count; i++) {
        const struct plan_node *n = &g->nodes[i];
        fprintf(f, "%4d %-14s %s%d", i, n->leaf ? "buffer" : node_ops[n->op].name,
                n->type.kind == MACHINE_FLOAT ? "f" : "u", n->type.width);
        if (n->op == NODE_SHIFT && !n->leaf)
            fprintf(f, " axis %d by %d", n->axis, n->detail);
        if (n->op == NODE_CROSS && !n->leaf)
            fprintf(f, " kind %d", n->detail);
        for (int k = 0; !n->leaf && k < node_ops[n->op].inputs; k++)
            fprintf(f, " %d", n->in[k]);
        if (!n->leaf && !n->constant)
            fprintf(f, "   stage %d%s%s", n->stage, n->stored ? ", stored" : "",
                    n->target ? ", asked for" : "");
        fprintf(f, "\n");
    }
    dump_close(m, number, ".graph", &out);
}
