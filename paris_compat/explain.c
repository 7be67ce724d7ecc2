/* explain.c - collects the reports of machine_explain() for each machine, and writes them when
 * the program ends.
 *
 * When explanations are on, Ctrl-C ends the program between two instructions by exit(130),
 * so that the report is written; a second Ctrl-C ends it at once. A handler of the program's
 * own is not replaced.
 */
#include "explain.h"

#include <growing_file.h>

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct output {
    const char *variable;
    void (*print)(FILE *out, const struct machine_explained *x);
    const char *before, *between, *after;
    int file; /* -1: none */
    char *text;
    size_t length;
} outputs[] = {
    {.variable = "LUTETIA_EXPLAIN",
     .print = explain_text,
     .before = "",
     .between = "\n",
     .after = ""},
    {.variable = "LUTETIA_EXPLAIN_JSON",
     .print = explain_json,
     .before = "{\"machines\": [",
     .between = ",\n",
     .after = "]}\n"},
};
enum { OUTPUTS_COUNT = sizeof outputs / sizeof *outputs };

static pid_t owner; /* 0: not known yet. Forked children write nothing */
static volatile sig_atomic_t interrupts;

static void complain(const struct output *o, const char *what)
{
    fprintf(stderr, "%s: cannot %s %s: %s; name a file that can be written\n", o->variable,
            what, getenv(o->variable), strerror(errno));
}

static void interrupt(int number)
{
    (void)number;
    interrupts = 1;
}

static void between(void)
{
    if (interrupts)
        exit(130);
}

/* Called before there is a machine: the driver's compiler installs a handler of its own,
 * which passes the signal on to the one before it. */
static void interrupt_catch(void)
{
    struct sigaction now,
        ours = {.sa_handler = interrupt, .sa_flags = (int)(SA_RESETHAND | SA_RESTART)};
    if (sigaction(SIGINT, NULL, &now) == 0 && now.sa_handler == SIG_DFL)
        sigaction(SIGINT, &ours, NULL);
}

bool paris_explain_wanted(void)
{
    bool wanted = false, first = !owner;
    for (int i = 0; i < OUTPUTS_COUNT && first; i++) {
        struct output *o = &outputs[i];
        const char *path = getenv(o->variable);
        o->file = -1;
        if (!path || !*path)
            continue;
        o->file = growing_file_open(path);
        if (o->file < 0)
            complain(o, "open");
    }
    if (first)
        owner = getpid();
    for (int i = 0; i < OUTPUTS_COUNT; i++)
        wanted = wanted || outputs[i].file >= 0;
    if (first && wanted)
        interrupt_catch();
    return wanted && owner == getpid();
}

void paris_explain_begin(struct machine *m)
{
    if (paris_explain_wanted())
        machine_explain_between(m, between);
}

void paris_explain_end(struct machine *m)
{
    if (!m || !paris_explain_wanted())
        return;
    const struct machine_explained *x = machine_explain(m, true);
    if (!x || (!x->stores && !x->kernels_count))
        return; /* the machine was replaced before it did anything */
    for (int i = 0; i < OUTPUTS_COUNT; i++) {
        struct output *o = &outputs[i];
        char *text = NULL;
        size_t length = 0;
        FILE *f = o->file >= 0 ? open_memstream(&text, &length) : NULL;
        if (!f)
            continue;
        fputs(o->text ? o->between : o->before, f);
        o->print(f, x);
        char *all = fclose(f) == 0 ? realloc(o->text, o->length + length + 1) : NULL;
        if (all) {
            memcpy(all + o->length, text, length + 1);
            o->text = all;
            o->length += length;
        }
        free(text);
    }
}

static bool bytes_write(int file, const char *bytes, size_t count)
{
    while (count > 0) {
        ssize_t done = write(file, bytes, count);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return false;
        bytes += done;
        count -= (size_t)done;
    }
    return true;
}

void paris_explain_write(void)
{
    if (owner != getpid())
        return;
    for (int i = 0; i < OUTPUTS_COUNT; i++) {
        struct output *o = &outputs[i];
        if (o->file >= 0 && o->text &&
            !(bytes_write(o->file, o->text, o->length) &&
              bytes_write(o->file, o->after, strlen(o->after))))
            complain(o, "write to");
        if (o->file >= 0)
            close(o->file);
        free(o->text);
        o->file = -1;
        o->text = NULL;
        o->length = 0;
    }
}
