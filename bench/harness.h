/* harness.h - timing, rows, the table and the JSON of every benchmark.
 *
 *     struct bench_report report;
 *     bench_report_init(&report, "diffusion", threads_count, device_name);
 *     struct bench_sample t = bench_measure(step, context, 10);
 *     bench_report_add(&report, "listing", "1024x1024", t, 1e9 / fibers, "ns/fiber-step");
 *     bench_report_print(&report, "hand per axis", stdout);
 *     status = bench_report_write(&report, "diffusion.json");
 *     bench_report_finish(&report);
 *
 * Errors. Functions that can fail return false, and bench_error() says why in one line. */
#ifndef LUTETIA_BENCH_HARNESS_H
#define LUTETIA_BENCH_HARNESS_H

#include <error_text.h>

#include <stdbool.h>
#include <stdio.h>

/* A measurement in seconds (or in the rows' unit, with a scale of 1). */
struct bench_sample {
    double median, min;
};

double bench_now_s(void);     /* monotonic */
double bench_thread_s(void);  /* processor time of the calling thread */
double bench_process_s(void); /* of all of them */

/* Does the work once and waits until it is done. False stops the measurement: bench_error() is
 * set. */
typedef bool bench_work(void *context);

/* One run to warm up, then repeat_count counted ones. Errors: false. */
bool bench_measure(bench_work *work, void *context, int repeat_count, struct bench_sample *out);
/* Contenders run alternately, so that other load on the machine affects all of them alike. */
struct bench_contender {
    const char *what;
    bench_work *ready; /* run before each counted run, and not counted: fills the caches; may be
                 * NULL */
    bench_work *work;
    void *context;
    struct bench_sample seconds; /* the result */
};
bool bench_measure_in_turns(struct bench_contender *contenders, int count, int repeat_count);
/* The sample of counted values; reorders them. Shape: count is 1 or more. */
struct bench_sample bench_sample_of(double *values, int count);

struct bench_row {
    char what[32];     /* "listing" */
    char of_case[32];  /* "1024x1024" */
    double value, min; /* median and minimum (for rates, maximum), in `unit` */
    char unit[24];
};

enum { BENCH_ROWS_MAX = 256 };

struct bench_report {
    const char *name;
    const char *device; /* borrowed */
    int threads_count;
    int rows_count;
    struct bench_row rows[BENCH_ROWS_MAX];
};

void bench_report_init(struct bench_report *r, const char *name, int threads_count,
                       const char *device);
/* Values are seconds * scale. */
void bench_report_add(struct bench_report *r, const char *what, const char *of_case,
                      struct bench_sample seconds, double scale, const char *unit);
/* NULL if there is no such row. */
const struct bench_row *bench_report_find(const struct bench_report *r, const char *what,
                                          const char *of_case);
/* Prints a table with a column of ratios: each row's value divided by that of the row
 * `yardstick` of the same case and unit. */
void bench_report_print(const struct bench_report *r, const char *yardstick, FILE *out);
/* One JSON object; the file appears under its name only when it is complete. Errors: false. */
bool bench_report_write(const struct bench_report *r, const char *path);

/* Set by `lutetia bench --quick`, before anything runs: what would be measured is only tried,
 * and the numbers mean nothing. */
extern bool bench_quick;
/* How many, or how large: as usual, or enough to try it. */
int bench_many(int usual, int enough);

/* Whether the file can be made or overwritten: checked before a long measurement. Errors:
 * false. */
bool bench_can_write(const char *path);

int bench_threads_count(void); /* that OpenMP uses; 1 without it */

/* ---- errors ---- */

/* Keeps the text for bench_error() and returns false. */
extern _Thread_local struct error_text bench_last_error;
#define bench_fail(...) error_text_false(&bench_last_error, __VA_ARGS__)

const char *bench_error(void);

#endif
