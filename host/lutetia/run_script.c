/* run_script.c - the command as a script's host: prints its lines, writes its film, saves
 * its papers. */
#include "run.h"

#include <history.h>
#include <resident.h>
#include <visible_text.h>

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void run_print(const struct run *run, const char *text, size_t length)
{
    if (run->config.trusted || !isatty(STDOUT_FILENO)) {
        fwrite(text, 1, length, stdout);
    } else { /* control characters of an untrusted script are made visible; a byte takes 4 at
              * most */
        char shown[2048];
        for (size_t at = 0; at < length; at += sizeof shown / 8) {
            size_t rest = length - at, most = sizeof shown / 8;
            fwrite(
                shown, 1,
                visible_text_lines(shown, sizeof shown, text + at, rest < most ? rest : most),
                stdout);
        }
    }
    fflush(stdout);
}

static void print(void *context, const char *text, size_t length)
{
    run_print(context, text, length);
}

/* The script's error was told: if it then does not come to its end, that is no second error. */
static atomic_bool complained;

static void complain(void *context, const char *text)
{
    (void)context;
    tell_line(text);
    complained = true;
}

static void note(void *context, const char *text)
{
    (void)context;
    tell("run", "%s", text);
}

static bool stop(void *context)
{
    (void)context;
    return interrupted();
}

static void progress(void *context, const struct script_progress *p)
{
    struct run *run = context;
    if (p && !p->again && run->report)
        run->report(run, p->done, p->total);
    if (run->quiet || run->report)
        return;
    if (run->line_begun && (!p || p->again != run->line_again)) {
        progress_end(&run->line);
        run->line_begun = false;
    }
    if (!p)
        return;
    if (!run->line_begun) {
        run->line = progress_begin(p->again ? "computing again" : run->config.path, 0);
        run->line.began_s = p->began_s;
        run->line_begun = true;
        run->line_again = p->again;
    }
    run->line.total = (int)p->total;
    progress_show(&run->line, (int)p->done);
}

static const char *step(void *context, int paper, struct paper_sheet *sheet)
{
    struct run *run = context;
    return film_step(&run->film, paper, sheet) ? NULL : run->film.error;
}

static void camera(void *context, const struct script_camera *camera)
{
    struct film *film = &((struct run *)context)->film;
    film->paper = camera->paper;
    film->show = camera->show;
    film->camera[0] = camera->x;
    film->camera[1] = camera->y;
    film->camera[2] = camera->width;
    film->camera[3] = camera->height;
}

static void wrote(void *context, const char *path)
{
    struct written *w = &((struct run *)context)->written;
    for (int i = 0; i < w->named; i++)
        if (strcmp(w->first[i], path) == 0)
            return;
    w->more = w->named == WRITTEN_NAMED;
    char *to = w->more ? w->last : w->first[w->named++];
    snprintf(to, PATH_MAX, "%s", path);
}

/* On a terminal, which files there are now. */
static void written_tell(const struct run *run)
{
    const struct written *w = &run->written;
    if (!run->alone || run->quiet || w->named == 0 || !isatty(STDERR_FILENO))
        return;
    tell("run", "wrote %s%s%s%s%s%s%s", w->first[0], w->named > 1 ? ", " : "", w->first[1],
         w->named > 2 ? ", " : "", w->first[2], w->more ? " and others, the last one " : "",
         w->last);
}

static void divergence_report(const struct run *run, const struct paper_state_sheet *papers,
                              int count)
{
    for (int i = 0; i < count; i++)
        if (paper_history_diverged(papers[i].sheet) && !run->quiet)
            tell("run",
                 "paper %d goes another way than the one that was saved; it was computed again "
                 "from there",
                 papers[i].number);
}

/* Saves the papers as they are, however the run ended. */
static enum script_status save(struct run *run, const struct paper_state_sheet *papers,
                               int count, enum script_status status)
{
    struct paper_state_sheet
        kept[PAPER_STATE_SHEETS_MAX]; /* with --save, papers_max limits the number */
    int kept_count = 0;
    for (int i = 0; i < count && kept_count < PAPER_STATE_SHEETS_MAX; i++)
        if (paper_history_has(papers[i].sheet))
            kept[kept_count++] = papers[i];
    if (kept_count == 0 && status != SCRIPT_OK) /* do not overwrite the state that an earlier
                                                 * run saved */
        return status;
    if (paper_state_save(run->save, kept, kept_count) != PAPER_OK) {
        fail("run", "%s", paper_error());
        return SCRIPT_FAILED;
    }
    if (!run->quiet && status != SCRIPT_OK)
        tell("run", "saved; `lutetia run %s --resume %s` goes on", run->config.path, run->save);
    return status;
}

/* The file for the papers of a run that nobody asked to save: beside its pictures, named after
 * the script. */
static void kept_name(const struct run *run, char path[PATH_MAX])
{
    const char *slash = strrchr(run->config.path, '/'),
               *name = slash ? slash + 1 : run->config.path;
    name += strspn(name, ".-"); /* it is neither hidden nor like an option */
    const char *ending = strrchr(name, '.');
    const int length = (int)(ending ? (size_t)(ending - name) : strlen(name));
    snprintf(path, PATH_MAX, "%s/%.*s-interrupted.h5", run->config.out_folder,
             length > 0 ? length : 6, length > 0 ? name : "script");
}

#define LONG_BYTES 3e8 /* of papers: it takes seconds */

/* After Ctrl-C without --save: keeps the papers to which something was done. A run that was
 * resumed and has not come to all of its papers again keeps the state that it was resumed
 * from. */
static void keep(const struct run *run, const struct paper_state_sheet *papers, int count)
{
    struct paper_state_sheet kept[PAPER_STATE_SHEETS_MAX];
    char path[PATH_MAX];
    int kept_count = 0, left_out = 0;
    double bytes = 0;
    for (int i = 0; i < count; i++) {
        if (!paper_history_has(papers[i].sheet) || paper_history_done(papers[i].sheet) == 0)
            continue;
        const struct paper_sheet_config *config = paper_sheet_get_config(papers[i].sheet);
        bytes += paper_sheet_bytes(config->width, config->height, config->pigments_count);
        if (kept_count < PAPER_STATE_SHEETS_MAX)
            kept[kept_count++] = papers[i];
        else
            left_out++;
    }
    if (kept_count == 0 ||
        (run->config.resumed && paper_state_count(run->config.resumed) > kept_count))
        return;
    kept_name(run, path);
    if (bytes > LONG_BYTES)
        tell("run", "keeping what there was; Ctrl-C again ends at once");
    if (paper_state_save(path, kept, kept_count) != PAPER_OK) {
        fail("run", "what there was is not kept: %s", paper_error());
        return;
    }
    if (left_out > 0)
        tell("run", "a state has up to %d papers; the last %d are not kept",
             PAPER_STATE_SHEETS_MAX, left_out);
    tell("run", "what there was is kept in %s; the same command with --resume %s goes on", path,
         path);
}

static enum script_status finish(void *context, const struct paper_state_sheet *papers,
                                 int count, enum script_status status)
{
    struct run *run = context;
    bool film_failed = run->film.failed; /* and the reason was printed */
    if (!film_end(&run->film) && !film_failed) {
        fail("run", "%s", run->film.error);
        status = SCRIPT_FAILED;
    }
    divergence_report(run, papers, count);
    if (run->save)
        status = save(run, papers, count, status);
    else if (status == SCRIPT_INTERRUPTED && run->alone)
        keep(run, papers, count);
    return status;
}

static void overdue(void *context)
{
    static const char late[] = "lutetia run: the script did not stop at its --timeout; ended\n",
                      pressed[] = "lutetia run: the script did not stop; ended\n";
    (void)context;
    bool stopped = interrupted();
    ssize_t written = complained ? 0
                      : stopped  ? write(STDERR_FILENO, pressed, sizeof pressed - 1)
                                 : write(STDERR_FILENO, late, sizeof late - 1);
    (void)written;
    _exit(stopped ? EXIT_INTERRUPTED : EXIT_FAILED);
}

static void overfull(void *context)
{
    static const char text[] =
        "lutetia run: the script took more memory than --memory allows (papers take 100 to 160 "
        "MB more than their own); ended\n";
    (void)context;
    ssize_t written = complained ? 0 : write(STDERR_FILENO, text, sizeof text - 1);
    (void)written;
    _exit(EXIT_FAILED);
}

/* What the compiler of kernels, its threads and PoCL's may take besides: more ends in an error
 * of memory, wherever it is asked for. */
#define SYSTEM_MORE_BYTES 2e9

int run_script(struct run *run)
{
    const struct script_host host = {.context = run,
                                     .print = print,
                                     .error = complain,
                                     .note = note,
                                     .interrupted = stop,
                                     .progress = progress,
                                     .step = step,
                                     .film = camera,
                                     .wrote = wrote,
                                     .finish = finish,
                                     .overdue = overdue,
                                     .overfull = overfull};
    run->config.words = run->words;
    run->config.patient = run->save || run->film.video || run->film.folder;
    run->config.keeps = run->alone;
    resident_limit((double)run->config.memory_bytes + SYSTEM_MORE_BYTES);
    enum script_status status = script_run(&run->config, &host);
    written_tell(run);
    return status == SCRIPT_OK       ? EXIT_SUCCESS
           : status == SCRIPT_FAILED ? EXIT_FAILED
                                     : EXIT_INTERRUPTED;
}
