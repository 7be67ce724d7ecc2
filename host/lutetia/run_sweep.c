/* run_sweep.c - sweeps: every combination of values is a run with its own folder, and with
 * --jobs its own process.
 *
 * Processes are forked before the machine is attached, so each has its own. A run's output
 * goes to unnamed files, and is printed after that of all runs before it. Its steps come
 * through a pipe, for the progress line.
 */
#include "run_sweep.h"

#include <visible_text.h>

#include "lutetia.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SWEEPS_MAX = 8, VALUES_MAX = 4096, RUNS_MAX = 100000, WORD_MAX = 256, JOBS_MAX = 256 };

struct sweep {
    char *key;
    char *values[VALUES_MAX];
    int count;
};

struct one {
    char *folder;
    char *words[SWEEPS_MAX]; /* key=value */
    FILE *output, *errors;   /* of a job that has ended */
    int status;              /* -1: not yet */
};

struct all {
    struct run *run;
    int keys_count;
    struct one *runs;
    int runs_count;
    int failed;
};

struct report {
    long done, total;
};

struct job {
    pid_t pid; /* 0: none */
    int run;
    int pipe;
    struct report report;
};

/* ---- the list of values ---- */

static bool value_add(struct sweep *sweep, char *value)
{
    if (!value || sweep->count == VALUES_MAX) {
        free(value);
        return false;
    }
    sweep->values[sweep->count++] = value;
    return true;
}

static char *text_of(double number)
{
    char *text;
    return asprintf(&text, "%.10g", number) < 0 ? NULL : text;
}

/* Parses "1..5", or "0..1/5": five numbers from 0 to 1. False: it is no range, or, if *bad,
 * a wrong one. */
static bool range_parse(struct sweep *sweep, const char *values, bool *bad)
{
    int from, to, steps;
    double low, high;
    char end;
    if (sscanf(values, "%d..%d%c", &from, &to, &end) == 2) {
        *bad = from > to || (long)to - from >= VALUES_MAX;
        for (int i = from; i <= to && !*bad; i++)
            *bad = !value_add(sweep, text_of(i));
        return true;
    }
    const char *dots = strstr(values, "..");
    if (!dots)
        return false;
    if (sscanf(dots + 2, "%lf/%d%c", &high, &steps, &end) != 2) {
        *bad = strspn(values, "+-.0123456789eE/") == strlen(values); /* only characters of
                                                                      * numbers: an incomplete
                                                                      * range, not a word */
        return *bad;
    }
    char first[32] = "";
    snprintf(first, sizeof first, "%.*s", (int)(dots - values), values);
    char *stop;
    low = strtod(first, &stop);
    *bad = *first == '\0' || *stop != '\0' || steps < 2 || steps > VALUES_MAX || !(high > low);
    for (int i = 0; i < steps && !*bad; i++)
        *bad = !value_add(sweep, text_of(low + (high - low) * i / (steps - 1)));
    return true;
}

/* Parses the sweep; modifies the text. */
static bool sweeps_parse(char *text, struct sweep *sweeps, int *count)
{
    char *next_one, *next_value;
    *count = 0;
    for (char *one = strtok_r(text, ";", &next_one); one;
         one = strtok_r(NULL, ";", &next_one)) {
        char *values = strchr(one, '=');
        bool bad = false;
        if (!values || values == one || *count == SWEEPS_MAX)
            return false;
        *values++ = '\0';
        struct sweep *sweep = &sweeps[(*count)++];
        sweep->key = one;
        sweep->count = 0;
        if (range_parse(sweep, values, &bad)) {
            if (bad)
                return false;
            continue;
        }
        for (char *value = strtok_r(values, ",", &next_value); value;
             value = strtok_r(NULL, ",", &next_value))
            if (strchr(value, '/') || strlen(value) > WORD_MAX ||
                !value_add(sweep, strdup(value)))
                return false;
        if (sweep->count == 0)
            return false;
    }
    return *count > 0;
}

/* ---- the list of runs ---- */

/* Makes the folders and words of all combinations. */
static int runs_make(struct all *all, const struct sweep *sweeps, int count)
{
    long total = 1;
    for (int i = 0; i < count; i++) {
        total *= sweeps[i].count;
        if (total > RUNS_MAX)
            return fail_usage("run", "--sweep makes more than %d runs", RUNS_MAX);
    }
    all->runs = calloc((size_t)total, sizeof *all->runs);
    if (!all->runs)
        return fail("run", "no memory for a sweep");
    all->keys_count = count;
    for (; all->runs_count < total; all->runs_count++) {
        struct one *one = &all->runs[all->runs_count];
        long left = total, number = all->runs_count;
        one->status = -1;
        one->folder = strdup(all->run->config.out_folder);
        for (int i = 0; i < count; i++) { /* the last key varies fastest */
            left /= sweeps[i].count;
            const char *value = sweeps[i].values[number / left % sweeps[i].count];
            char *folder = NULL;
            if (asprintf(&one->words[i], "%s=%s", sweeps[i].key, value) < 0 || !one->folder ||
                asprintf(&folder, "%s/%s-%s", one->folder, sweeps[i].key, value) < 0)
                return fail("run", "no memory for a sweep");
            free(one->folder);
            one->folder = folder;
            int status = folder_make("run", one->folder);
            if (status != EXIT_SUCCESS)
                return status;
        }
    }
    return EXIT_SUCCESS;
}

static void runs_free(struct all *all)
{
    for (int i = 0; all->runs && i < all->runs_count; i++) {
        for (int j = 0; j < SWEEPS_MAX; j++)
            free(all->runs[i].words[j]);
        free(all->runs[i].folder);
        if (all->runs[i].output)
            fclose(all->runs[i].output);
        if (all->runs[i].errors)
            fclose(all->runs[i].errors);
    }
    free(all->runs);
}

/* The path of an output file, given on the command line, within the folder of one run. */
static char *path_within(const char *folder, const char *path)
{
    const char *slash = path ? strrchr(path, '/') : NULL;
    char *within;
    if (!path || asprintf(&within, "%s/%s", folder, slash ? slash + 1 : path) < 0)
        return NULL;
    return within;
}

static int one_run(struct all *all, const struct one *one)
{
    struct run run = *all->run;
    run.config.out_folder = one->folder;
    for (int i = 0; i < all->keys_count; i++)
        run.words[run.config.words_count++] = one->words[i];
    char *video = path_within(one->folder, run.film.video),
         *frames = path_within(one->folder, run.film.folder);
    run.film.video = video;
    run.film.folder = frames;
    int status = frames ? folder_make("run", frames) : EXIT_SUCCESS;
    if (status == EXIT_SUCCESS)
        status = run_script(&run);
    free(video);
    free(frames);
    return status;
}

/* ---- one after the other ---- */

static void runs_in_turn(struct all *all)
{
    for (int i = 0; i < all->runs_count && !interrupted(); i++) {
        struct one *one = &all->runs[i];
        if (!all->run->quiet)
            tell("run", "%s", one->folder);
        one->status = one_run(all, one);
        all->failed += one->status == EXIT_FAILED;
    }
}

/* ---- several at a time ---- */

static void report(const struct run *run, long done, long total)
{
    struct report steps = {done, total};
    ssize_t written = write(run->report_to, &steps, sizeof steps);
    (void)written; /* a lost progress report does not matter */
}

_Noreturn static void job_become(struct all *all, const struct one *one, int reports,
                                 int threads)
{
    char number[16];
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    snprintf(number, sizeof number, "%d", threads);
    setenv("POCL_MAX_PTHREAD_COUNT", number, 0);
    dup2(fileno(one->output), STDOUT_FILENO);
    dup2(fileno(one->errors), STDERR_FILENO);
    all->run->report = report;
    all->run->report_to = reports;
    int status = one_run(all, one);
    fflush(NULL);
    exit(status);
}

static bool job_start(struct all *all, struct job *job, int number, int threads)
{
    struct one *one = &all->runs[number];
    int ends[2];
    one->output = tmpfile();
    one->errors = tmpfile();
    if (!one->output || !one->errors || pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
        return false;
    fflush(NULL);
    pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        job_become(all, one, ends[1], threads);
    }
    close(ends[1]);
    if (pid < 0) {
        close(ends[0]);
        return false;
    }
    *job = (struct job){.pid = pid, .run = number, .pipe = ends[0]};
    return true;
}

/* Copies a run's output; before each line of its errors stands the run's name. */
static void one_print(const struct all *all, struct one *one)
{
    char line[4096], text[4096 + PATH_MAX];
    size_t count;
    rewind(one->output);
    while ((count = fread(line, 1, sizeof line, one->output)) > 0)
        run_print(all->run, line, count);
    rewind(one->errors);
    while (fgets(line, sizeof line, one->errors)) {
        line[strcspn(line, "\n")] = '\0';
        snprintf(text, sizeof text, "%s: %s", one->folder, line);
        tell_line(text);
    }
    fclose(one->output);
    fclose(one->errors);
    one->output = one->errors = NULL;
}

static void job_end(struct all *all, struct job *job, int status)
{
    struct one *one = &all->runs[job->run];
    one->status = WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILED;
    if (WIFSIGNALED(status) && one->errors)
        fprintf(one->errors, "ended by signal %d (%s)\n", WTERMSIG(status),
                strsignal(WTERMSIG(status)));
    all->failed += one->status != EXIT_SUCCESS && one->status != EXIT_INTERRUPTED;
    close(job->pipe);
    job->pid = 0;
}

static void jobs_show(const struct all *all, const struct job *jobs, int jobs_count, int ended,
                      double began_s)
{
    char text[400];
    double passed = seconds_now() - began_s, parts = ended;
    int length = snprintf(text, sizeof text, "\r%d of %d runs", ended, all->runs_count);
    if (all->failed)
        length +=
            snprintf(text + length, sizeof text - (size_t)length, ", %d failed", all->failed);
    for (int i = 0; i < jobs_count; i++) {
        const struct job *job = &jobs[i];
        if (!job->pid || job->report.total < 1)
            continue;
        parts += (double)job->report.done / (double)job->report.total;
        char name[160];
        visible_text(name, sizeof name, strrchr(all->runs[job->run].folder, '/') + 1);
        if (length < 200)
            length += snprintf(text + length, sizeof text - (size_t)length, "  %.40s %ld/%ld",
                               name, job->report.done, job->report.total);
    }
    char left[40] = "";
    if (parts > 0.02)
        time_left_text(left, sizeof left, passed / parts * (all->runs_count - parts));
    fprintf(stderr, "%s  %s\033[K", text, left);
    fflush(stderr);
}

static void reports_read(struct job *jobs, int jobs_count)
{
    struct pollfd ready[JOBS_MAX];
    struct report report;
    int count = 0;
    for (int i = 0; i < jobs_count; i++)
        if (jobs[i].pid)
            ready[count++] = (struct pollfd){.fd = jobs[i].pipe, .events = POLLIN};
    poll(ready, (nfds_t)count, 100);
    for (int i = 0; i < jobs_count; i++)
        while (jobs[i].pid &&
               read(jobs[i].pipe, &report, sizeof report) == (ssize_t)sizeof report)
            jobs[i].report = report;
}

static void runs_at_once(struct all *all, int jobs_count)
{
    static struct job jobs[JOBS_MAX];
    int next = 0, ended = 0, printed = 0, running = 0, status;
    bool shown = isatty(STDERR_FILENO) && !all->run->quiet, told = false, short_of = false;
    double began_s = seconds_now();
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    int threads = cores > jobs_count ? (int)(cores / jobs_count) : 1;
    while (running > 0 || (next < all->runs_count && !interrupted() && !short_of)) {
        for (int i = 0; i < jobs_count && next < all->runs_count && !interrupted(); i++) {
            if (jobs[i].pid)
                continue;
            short_of = !job_start(all, &jobs[i], next, threads);
            if (short_of)
                break;
            next++;
            running++;
        }
        if (interrupted() &&
            !told) { /* a second signal does no harm to jobs that received the terminal's */
            for (int i = 0; i < jobs_count; i++)
                if (jobs[i].pid)
                    kill(jobs[i].pid, SIGTERM);
            told = true;
        }
        reports_read(jobs, jobs_count);
        for (int i = 0; i < jobs_count; i++)
            if (jobs[i].pid && waitpid(jobs[i].pid, &status, WNOHANG) == jobs[i].pid) {
                job_end(all, &jobs[i], status);
                running--;
                ended++;
            }
        bool any = printed < all->runs_count && all->runs[printed].status >= 0;
        if (any && shown)
            fputs("\r\033[K", stderr);
        while (printed < all->runs_count && all->runs[printed].status >= 0)
            one_print(all, &all->runs[printed++]);
        if (shown)
            jobs_show(all, jobs, jobs_count, ended, began_s);
    }
    if (shown)
        fputs("\r\033[K", stderr);
    for (; printed < all->runs_count; printed++)
        if (all->runs[printed].status >= 0)
            one_print(all, &all->runs[printed]);
    if (short_of) {
        fail("run", "cannot start more runs: %s; fewer --jobs take less", strerror(errno));
        all->failed++;
    }
}

int sweep_all(struct run *run, const char *text, int jobs)
{
    static struct sweep sweeps[SWEEPS_MAX];
    struct all all = {.run = run};
    int count = 0, status;
    char *copy = strdup(text);
    if (!copy || !sweeps_parse(copy, sweeps, &count))
        status =
            fail_usage("run",
                       "--sweep must be KEY=a,b,c or KEY=1..5 or KEY=0..1/5, several after "
                       "';' (got '%.60s')",
                       text);
    else if (run->config.words_count + count > SCRIPT_WORDS_MAX)
        status = fail_usage("run", "a script takes up to %d key=value", SCRIPT_WORDS_MAX);
    else
        status = runs_make(&all, sweeps, count);
    if (status == EXIT_SUCCESS) {
        if (jobs > 1)
            runs_at_once(&all, jobs < JOBS_MAX ? jobs : JOBS_MAX);
        else
            runs_in_turn(&all);
        if (interrupted()) {
            status = EXIT_INTERRUPTED;
        } else if (all.failed) {
            status = EXIT_FAILED;
            if (all.runs_count > 1)
                fail("run", "%d of %d runs failed", all.failed, all.runs_count);
        }
    }
    for (int i = 0; i < count; i++)
        for (int j = 0; j < sweeps[i].count; j++)
            free(sweeps[i].values[j]);
    runs_free(&all);
    free(copy);
    return status;
}
