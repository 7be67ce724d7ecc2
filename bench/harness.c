/* harness.c - see harness.h. */
#include "harness.h"

#include <output_file.h>

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#ifndef LUTETIA_COMMIT
#define LUTETIA_COMMIT "unknown"
#endif

_Thread_local struct error_text bench_last_error;

const char *bench_error(void)
{
    return bench_last_error.text;
}

bool bench_quick;

int bench_many(int usual, int enough)
{
    return bench_quick && enough < usual ? enough : usual;
}

/* ---- timing ---- */

static double clock_s(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double bench_now_s(void)
{
    return clock_s(CLOCK_MONOTONIC);
}

double bench_thread_s(void)
{
    return clock_s(CLOCK_THREAD_CPUTIME_ID);
}

double bench_process_s(void)
{
    return clock_s(CLOCK_PROCESS_CPUTIME_ID);
}

static int doubles_compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

struct bench_sample bench_sample_of(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, doubles_compare);
    return (struct bench_sample){(values[(count - 1) / 2] + values[count / 2]) / 2, values[0]};
}

/* OpenMP's threads spin for some milliseconds after their work, and would take processors
 * from the next contender. So this waits until the process is idle. The system updates the
 * processor times of running threads only every few milliseconds. */
static void wait_for_rest(void)
{
    enum { TRIES = 20 };
    const struct timespec pause = {.tv_nsec = 12000000};
    for (int i = 0; i < TRIES; i++) {
        double start = bench_now_s(), used = bench_process_s();
        nanosleep(&pause, NULL);
        if (bench_process_s() - used < 0.1 * (bench_now_s() - start))
            return;
    }
}

bool bench_measure_in_turns(struct bench_contender *contenders, int count, int repeat_count)
{
    repeat_count = bench_many(repeat_count, 1);
    double *seconds = malloc((size_t)repeat_count * (size_t)count * sizeof *seconds);
    bool ok = true;
    if (!seconds)
        return bench_fail("no memory for %d timings", repeat_count * count);
    for (int i = -1; i < repeat_count; i++) /* -1 warms up */
        for (int k = 0; ok && k < count; k++) {
            struct bench_contender *c = &contenders[k];
            if (count > 1 && !bench_quick)
                wait_for_rest();
            ok = !c->ready || c->ready(c->context);
            double start = bench_now_s();
            ok = ok && c->work(c->context);
            if (i >= 0)
                seconds[k * repeat_count + i] = bench_now_s() - start;
        }
    for (int k = 0; ok && k < count; k++)
        contenders[k].seconds = bench_sample_of(seconds + k * repeat_count, repeat_count);
    free(seconds);
    return ok;
}

bool bench_measure(bench_work *work, void *context, int repeat_count, struct bench_sample *out)
{
    struct bench_contender alone = {.work = work, .context = context};
    bool ok = bench_measure_in_turns(&alone, 1, repeat_count);
    *out = alone.seconds;
    return ok;
}

int bench_threads_count(void)
{
#ifdef _OPENMP
    return omp_get_max_threads();
#else
    return 1;
#endif
}

/* ---- rows ---- */

void bench_report_init(struct bench_report *r, const char *name, int threads_count,
                       const char *device)
{
    r->name = name;
    r->device = device;
    r->threads_count = threads_count;
    r->rows_count = 0;
}

void bench_report_add(struct bench_report *r, const char *what, const char *of_case,
                      struct bench_sample seconds, double scale, const char *unit)
{
    if (r->rows_count == BENCH_ROWS_MAX)
        abort();
    struct bench_row *row = &r->rows[r->rows_count++];
    snprintf(row->what, sizeof row->what, "%s", what);
    snprintf(row->of_case, sizeof row->of_case, "%s", of_case);
    snprintf(row->unit, sizeof row->unit, "%s", unit);
    row->value = seconds.median * scale;
    row->min = seconds.min * scale;
}

const struct bench_row *bench_report_find(const struct bench_report *r, const char *what,
                                          const char *of_case)
{
    for (int i = 0; i < r->rows_count; i++)
        if (!strcmp(r->rows[i].what, what) && !strcmp(r->rows[i].of_case, of_case))
            return &r->rows[i];
    return NULL;
}

void bench_report_print(const struct bench_report *r, const char *yardstick, FILE *out)
{
    fprintf(out, "%s on %s, %d threads\n", r->name, r->device, r->threads_count);
    int width = 16; /* of the cases */
    for (int i = 0; i < r->rows_count; i++)
        if ((int)strlen(r->rows[i].of_case) > width)
            width = (int)strlen(r->rows[i].of_case);
    fprintf(out, "%-26s %-*s %10s %10s  %-14s %s\n", "", width, "", "median", "best", "unit",
            yardstick);
    for (int i = 0; i < r->rows_count; i++) {
        const struct bench_row *row = &r->rows[i];
        const struct bench_row *peer = bench_report_find(r, yardstick, row->of_case);
        fprintf(out, "%-26s %-*s %10.3f %10.3f  %-14s", row->what, width, row->of_case,
                row->value, row->min, row->unit);
        if (peer && peer->value > 0 && !strcmp(peer->unit, row->unit))
            fprintf(out, " %.2fx", row->value / peer->value);
        putc('\n', out);
    }
}

/* ---- JSON ---- */

static void json_string(FILE *f, const char *s)
{
    putc('"', f);
    for (; *s; s++) {
        unsigned char c = (unsigned char)*s;
        if (c == '"' || c == '\\')
            putc('\\', f);
        if (c < 0x20)
            fprintf(f, "\\u%04x", c);
        else
            putc(c, f);
    }
    putc('"', f);
}

static void json_number(FILE *f, double x)
{
    if (isfinite(x))
        fprintf(f, "%.6g", x);
    else
        fputs("null", f);
}

static void json_report(FILE *f, const struct bench_report *r)
{
    fputs("{\"bench\": ", f);
    json_string(f, r->name);
    fputs(", \"commit\": ", f);
    json_string(f, LUTETIA_COMMIT);
    fputs(", \"compiler\": ", f);
#ifdef __clang__
    json_string(f, __VERSION__);
#else
    json_string(f, "gcc " __VERSION__);
#endif
    fputs(", \"device\": ", f);
    json_string(f, r->device);
    fprintf(f, ", \"threads\": %d,\n \"rows\": [", r->threads_count);
    for (int i = 0; i < r->rows_count; i++) {
        const struct bench_row *row = &r->rows[i];
        fputs(i ? ",\n  {\"what\": " : "\n  {\"what\": ", f);
        json_string(f, row->what);
        fputs(", \"case\": ", f);
        json_string(f, row->of_case);
        fputs(", \"value\": ", f);
        json_number(f, row->value);
        fputs(", \"min\": ", f);
        json_number(f, row->min);
        fputs(", \"unit\": ", f);
        json_string(f, row->unit);
        putc('}', f);
    }
    fputs("]}\n", f);
}

bool bench_can_write(const char *path)
{
    const char *wrong = output_file_wrong(path);
    return !wrong || bench_fail("%s: cannot write: %s", path, wrong);
}

bool bench_report_write(const struct bench_report *r, const char *path)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return bench_fail("%s cannot be written: %s", path, out.why);
    json_report(out.stream, r);
    return output_file_commit(&out) || bench_fail("%s cannot be written: %s", path, out.why);
}
