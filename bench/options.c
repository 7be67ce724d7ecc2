/* options.c - see options.h. */
#include "options.h"
#include <visible_text.h>

#include <stdlib.h>
#include <string.h>

enum { REPEAT_MAX = 10000 };

static void usage_print(const struct bench_options *o, FILE *out)
{
    const char *shape = o->lines ? "N,..." : "N,WxH,...";
    fprintf(out, "usage: lutetia bench %s", o->name);
    if (o->sizes_count)
        fprintf(out, " [--sizes %s]", shape);
    if (o->thorough_does)
        fputs(" [--thorough]", out);
    fputs(" [--repeat N] [--json FILE] [--plot FILE]\n\n", out);
    if (o->sizes_count) {
        char option[32];
        snprintf(option, sizeof option, "--sizes %s", shape);
        fprintf(out, "  %-18s %s (", option, o->lines ? "processors" : "sides of sheets");
        for (int i = 0; i < o->sizes_count; i++)
            fprintf(out, i ? ",%d" : "%d", o->sizes[i][0]);
        fputs(")\n", out);
    }
    if (o->thorough_does)
        fprintf(out, "  --thorough         %s\n", o->thorough_does);
    fprintf(out,
            "  --repeat N         counted runs of each, %d or more (%d)\n"
            "  --json FILE        write the rows there, too\n"
            "  --plot FILE        draw the rows there, as a PNG\n",
            o->repeat_least, o->repeat_count);
}

static bool number_parse(const char *text, char **end, int least, int most, int *out)
{
    long n = strtol(text, end, 10);
    *out = (int)n;
    return *end != text && n >= least && n <= most;
}

static bool sizes_parse(struct bench_options *o, const char *text)
{
    const char *at = text;
    for (o->sizes_count = 0; o->sizes_count < BENCH_SIZES_MAX; at++) {
        int *size = o->sizes[o->sizes_count++];
        char *end;
        if (!number_parse(at, &end, o->size_least, o->size_most, &size[0]))
            break;
        size[1] = o->lines ? 1 : size[0];
        if (!o->lines && *end == 'x' &&
            !number_parse(end + 1, &end, o->size_least, o->size_most, &size[1]))
            break;
        at = end;
        if (!*at)
            return true;
        if (*at != ',')
            break;
    }
    return bench_fail("--sizes must be like %s: at most %d, each %d..%d (got \"%s\")",
                      o->lines ? "65536,1048576" : "1024,640x480", BENCH_SIZES_MAX,
                      o->size_least, o->size_most, text);
}

static bool options_parse(struct bench_options *o, int argc, char **argv)
{
    for (int i = 1; i < argc; i += 2) {
        if (o->thorough_does && !strcmp(argv[i], "--thorough")) {
            o->thorough = true;
            i--;
            continue;
        }
        const char *name = argv[i], *value = i + 1 < argc ? argv[i + 1] : NULL;
        bool sizes = o->sizes_count && !strcmp(name, "--sizes");
        bool repeat = !strcmp(name, "--repeat"), json = !strcmp(name, "--json");
        char *end;
        if (!sizes && !repeat && !json && strcmp(name, "--plot"))
            return bench_fail("there is no option \"%s\"", name);
        if (!value)
            return bench_fail("%s needs a value", name);
        if (sizes) {
            if (!sizes_parse(o, value))
                return false;
        } else if (repeat) {
            if (!number_parse(value, &end, o->repeat_least, REPEAT_MAX, &o->repeat_count) ||
                *end)
                return bench_fail("--repeat must be %d..%d (got \"%s\")", o->repeat_least,
                                  REPEAT_MAX, value);
        } else {
            if (!bench_can_write(value))
                return false;
            *(json ? &o->json_path : &o->plot_path) = value;
        }
    }
    return true;
}

/* Of `lutetia bench --quick`: one small size, once. */
static void quicken(struct bench_options *o)
{
    const int side = o->lines ? 4096 : 64;
    o->repeat_count = 1;
    if (o->sizes_count) {
        o->sizes_count = 1;
        o->sizes[0][0] = side > o->size_least ? side : o->size_least;
        o->sizes[0][1] = o->lines ? 1 : o->sizes[0][0];
    }
}

int bench_options_parse(struct bench_options *o, int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        if (!strcmp(argv[i], "--help") || !strcmp(argv[i], "-h")) {
            usage_print(o, stdout);
            return 0;
        }
    if (bench_quick)
        quicken(o);
    if (options_parse(o, argc, argv))
        return -1;
    visible_say("lutetia bench %s: %s; --help lists the options", o->name, bench_error());
    return 2;
}

int bench_options_finish(const struct bench_options *o, const struct bench_report *r,
                         const char *yardstick, bool ok)
{
    if (ok)
        bench_report_print(r, yardstick, stdout);
    if (ok && o->json_path)
        ok = bench_report_write(r, o->json_path);
    if (ok && o->plot_path)
        ok = bench_plot(r, o->plot_path);
    if (!ok)
        visible_say("lutetia bench %s: %s", o->name, bench_error());
    return ok ? 0 : 1;
}
