/* options.h - the command line of every benchmark, and the output of its rows.
 *
 *     struct bench_options o = {.name = "life", .size_least = 16, .size_most = 8192,
 *                               .sizes = {{1024, 1024}}, .sizes_count = 1,
 *                               .repeat_least = 10, .repeat_count = 11};
 *     int status = bench_options_parse(&o, argc, argv);
 *     if (status >= 0)
 *         return status;
 *     bool ok = ...add rows to the report...;
 *     return bench_options_finish(&o, &report, "openmp", ok);
 */
#ifndef LUTETIA_BENCH_OPTIONS_H
#define LUTETIA_BENCH_OPTIONS_H

#include "harness.h"

enum { BENCH_SIZES_MAX = 16 };

struct bench_options {
    const char *name;                           /* of the benchmark */
    int sizes[BENCH_SIZES_MAX][2], sizes_count; /* width, height; count 0: no --sizes */
    bool lines;                                 /* sizes are one number, not two */
    int size_least, size_most;                  /* of a side, or of a line */
    int repeat_least, repeat_count;
    const char *thorough_does; /* --thorough, in a line; NULL: no such option */
    bool thorough;
    const char *json_path, *plot_path; /* NULL: none */
};

/* `o` holds the defaults. Returns -1 to go on; else the exit status, and the error has been
 * printed. */
int bench_options_parse(struct bench_options *o, int argc, char **argv);
/* Prints the rows beside the row `yardstick` of their case, writes and draws them where asked
 * to. ok: whether the measurement came to its end; if not, prints bench_error(). The exit
 * status. */
int bench_options_finish(const struct bench_options *o, const struct bench_report *r,
                         const char *yardstick, bool ok);

/* Draws the rows as bars, those of a case and unit together (plot.c). Errors: false. */
bool bench_plot(const struct bench_report *r, const char *path);

#endif
