/* explain.c - collects the reports of machine_explain() for each machine, and writes them when
 * the program ends.
 *
 * When explanations are on, Ctrl-C ends the program between two instructions by exit(130),
 * so that the report is written; a second Ctrl-C ends it at once. A handler of the program's
 * own is not replaced.
 */
#include "explain.h"
#include <visible_text.h>

#include <exit_status.h>
#include <growing_file.h>
#include <part_files.h>

#include <dlfcn.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct output {
    const char *variable;
    void (*print)(FILE *out, const struct machine_explained *x);
    const char *before, *between, *after;
    struct growing_file file;
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
     .after = "]"},
};
enum { OUTPUTS_COUNT = sizeof outputs / sizeof *outputs };

/* What was complained of; what is more than these is counted alone. */
enum { COMPLAINTS_MOST = 32 };
static struct {
    char *text;
    uint64_t count;
} complaints[COMPLAINTS_MOST];
static uint64_t complaints_more;

static pid_t owner; /* 0: not known yet. Forked children write nothing */
static volatile sig_atomic_t interrupts;

static void complain(const struct output *o, const char *what)
{
    visible_say("%s: cannot %s %s: %s", o->variable, what, getenv(o->variable), o->file.why);
    exit_status_fail();
}

static void interrupt(int number)
{
    if (interrupts)
        part_files_die(number);
    interrupts = 1;
}

/* The driver's compiler installs a handler of its own with its first kernel. That one removes
 * what is being compiled, whose compilation then fails with a line of the compiler's on the
 * standard error, before it passes the signal on. */
static bool is_compilers(const struct sigaction *action)
{
    Dl_info of;
    return action->sa_handler != SIG_DFL && action->sa_handler != SIG_IGN &&
           dladdr((const void *)(uintptr_t)action->sa_handler, &of) && of.dli_fname &&
           strstr(of.dli_fname, "libLLVM");
}

static bool catches; /* the handler is ours, or the compiler's on top of it */

static bool interrupt_take(void)
{
    const struct sigaction ours = {.sa_handler = interrupt, .sa_flags = SA_RESTART};
    return sigaction(SIGINT, &ours, NULL) == 0;
}

static void interrupt_catch(void)
{
    struct sigaction now;
    if (sigaction(SIGINT, NULL, &now) == 0 &&
        (now.sa_handler == SIG_DFL || now.sa_handler == part_files_die))
        catches = interrupt_take();
}

/* Takes the compiler's handler away again; one of the program's stays, and ends this. */
static void interrupt_keep(void)
{
    struct sigaction now;
    if (!catches || sigaction(SIGINT, NULL, &now) != 0 || now.sa_handler == interrupt)
        return;
    catches = is_compilers(&now) && interrupt_take();
}

static void between(void)
{
    if (interrupts)
        exit(130);
    interrupt_keep();
}

bool paris_explain_wanted(void)
{
    bool wanted = false, first = !owner;
    for (int i = 0; i < OUTPUTS_COUNT && first; i++) {
        struct output *o = &outputs[i];
        const char *path = getenv(o->variable);
        if (path && *path && !growing_file_open(&o->file, path))
            complain(o, "open");
    }
    if (first)
        owner = getpid();
    for (int i = 0; i < OUTPUTS_COUNT; i++)
        wanted = wanted || outputs[i].file.is_open;
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
        FILE *f = o->file.is_open ? open_memstream(&text, &length) : NULL;
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

void paris_explain_complaint(const char *text)
{
    bool open = false;
    for (int i = 0; i < OUTPUTS_COUNT; i++)
        open = open || outputs[i].file.is_open;
    for (int i = 0; i < COMPLAINTS_MOST && open; i++) {
        if (!complaints[i].text)
            complaints[i].text = strdup(text);
        if (complaints[i].text && strcmp(complaints[i].text, text) == 0) {
            complaints[i].count++;
            return;
        }
    }
    complaints_more += open;
}

static void complaints_print(FILE *f, bool json)
{
    char line[2000];
    fputs(json ? ", \"complaints\": [" : complaints[0].text ? "\ncomplaints\n" : "", f);
    for (int i = 0; i < COMPLAINTS_MOST && complaints[i].text; i++) {
        visible_text(line, sizeof line, complaints[i].text);
        if (json) {
            fprintf(f, "%s{\"count\": %llu, \"text\": ", i ? ", " : "",
                    (unsigned long long)complaints[i].count);
            explain_json_text(f, line);
            fputc('}', f);
        } else {
            fprintf(f, "  %llu x  %s\n", (unsigned long long)complaints[i].count, line);
        }
    }
    if (complaints_more && !json)
        fprintf(f, "  %llu others\n", (unsigned long long)complaints_more);
    fputs(json ? "]}\n" : "", f);
}

/* The end of a report: what was complained of. NULL: no memory. */
static char *report_end(const struct output *o)
{
    char *text = NULL;
    size_t length = 0;
    FILE *f = open_memstream(&text, &length);
    if (!f)
        return NULL;
    fprintf(f, "%s%s", o->text ? "" : o->before, o->after);
    complaints_print(f, o->print == explain_json);
    return fclose(f) == 0 ? text : NULL;
}

void paris_explain_write(void)
{
    if (owner != getpid())
        return;
    for (int i = 0; i < OUTPUTS_COUNT; i++) {
        struct output *o = &outputs[i];
        bool good = true;
        char *end = o->text || complaints[0].text ? report_end(o) : NULL;
        const size_t after = end ? strlen(end) : 0;
        char *all = end ? realloc(o->text, o->length + after + 1) : NULL;
        if (all) {
            memcpy(all + o->length, end, after + 1);
            o->text = all;
            good = growing_file_append(&o->file, all, o->length + after, NULL, 0);
        }
        free(end);
        if (!good || !growing_file_close(&o->file))
            complain(o, "write to");
        free(o->text);
        o->text = NULL;
        o->length = 0;
    }
}
