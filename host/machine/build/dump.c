/* dump.c - writes graphs and kernels to files (LUTETIA_DUMP). */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "build/plans.h"

/* NULL: the file cannot be written. This is reported once, and the program goes on without
 * dumps. */
static FILE *dump_open(struct machine *m, int number, const char *suffix)
{
    char path[600];
    mkdir(m->plans->dump_dir, 0777);
    snprintf(path, sizeof path, "%s/%04d%s", m->plans->dump_dir, number, suffix);
    FILE *f = fopen(path, "w");
    if (!f) {
        fprintf(stderr,
                "LUTETIA_DUMP: cannot write %s: %s; name a folder that can be written\n", path,
                strerror(errno));
        free(m->plans->dump_dir);
        m->plans->dump_dir = NULL;
    }
    return f;
}

void dump_text(struct machine *m, int number, const char *suffix, const char *options,
               const char *text)
{
    FILE *f = dump_open(m, number, suffix);
    if (!f)
        return;
    if (options)
        fprintf(f, "/* %s */\n", options);
    fputs(text, f);
    fclose(f);
}

void dump_graph(struct machine *m, int number, const struct plan_graph *g)
{
    FILE *f = dump_open(m, number, ".graph");
    if (!f)
        return;
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
    fclose(f);
}
