/* verb_tune.c - `lutetia tune`: measures which knobs are fastest on this device, and stores
 * them.
 *
 * The knobs are tuned one after the other, with the best values so far of those before.
 * Machines with each of a knob's values run in rounds, so that other load on the computer
 * affects all of them alike. The measure is the median over the rounds of the ratio to the
 * usual value. Another value is chosen if it is clearly better, and its best time is better,
 * too.
 */
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "tune_work.h"

#include <output_file.h>
#include <visible_text.h>

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { VALUES_MOST = 5, WARM_RUNS = 5, ROUNDS = 11, TRIED_MOST = 64 };

/* The ratio from which another value is chosen: smaller gains may be noise. */
#define CLEARLY 0.97

/* What a knob is about: it says when the knob does nothing. */
enum about {
    ABOUT_ITEMS,  /* work-items */
    ABOUT_LANES,  /* ... that have vectors */
    ABOUT_TURNS,  /* several turns in one evaluation; in strips, which need vectors */
    ABOUT_STRIPS, /* strips, which need several turns, too */
};

/* The works that are timed for each knob. The usual value is tried first. */
static const struct step {
    enum machine_knob knob;
    enum about about;
    int values_count, values[VALUES_MOST];
    bool works[TUNE_KINDS];
} steps[] = {
    {MACHINE_VECTOR, ABOUT_ITEMS, 3, {16, 8, 4}, {true, true, true}},
    {MACHINE_RUN, ABOUT_ITEMS, 3, {4096, 1024, 256}, {false, true, true}},
    {MACHINE_STREAMS, ABOUT_LANES, 2, {1, 0}, {[TUNE_TRAFFIC] = true}},
    {MACHINE_TURNS, ABOUT_TURNS, 4, {8, 4, 2, 1}, {[TUNE_STENCIL] = true}},
    {MACHINE_COLUMNS, ABOUT_STRIPS, 4, {4096, 1024, 512, 256}, {[TUNE_STENCIL] = true}},
    {MACHINE_STRIPS_EACH, ABOUT_STRIPS, 5, {3, 1, 2, 4, 6}, {[TUNE_STENCIL] = true}},
};

enum { STEPS_COUNT = sizeof steps / sizeof *steps };

struct tried {
    enum machine_knob knob;
    int value;
    double ns[TUNE_KINDS]; /* medians; 0: not measured */
    double ratio;          /* geometric mean over all works of the ratios to the usual value */
    double best_ratio;     /* ... of the best times */
    bool usual, chosen;
};

struct tune {
    struct machine_tuning best;
    struct machine_tuning usual;
    struct tried tried[TRIED_MOST];
    int tried_count;
    struct progress progress;
    int done;
};

static int by_size(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static double median(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, by_size);
    return values[count / 2];
}

/* ---- one knob, one work ---- */

struct contest {
    int count;
    struct tune_work *works[VALUES_MOST];
    double ns[VALUES_MOST][ROUNDS];
};

static bool contest_open(struct contest *c, struct tune *t, const struct step *s,
                         enum tune_kind kind, const int *values, int count)
{
    *c = (struct contest){.count = count};
    for (int i = 0; i < count; i++) {
        struct machine_tuning tuning = t->best;
        tuning.of[s->knob] = values[i];
        if (s->about == ABOUT_ITEMS || s->about == ABOUT_LANES) /* they do not affect strips */
            tuning.of[MACHINE_TURNS] = 1;
        c->works[i] = tune_work_create(kind, 0, &tuning);
        if (!c->works[i])
            return false;
    }
    return true;
}

static void contest_close(struct contest *c)
{
    for (int i = 0; i < c->count; i++)
        tune_work_destroy(c->works[i]);
}

/* False: failed, or interrupted. */
static bool contest_run(struct contest *c, struct tune *t)
{
    for (int round = -WARM_RUNS; round < ROUNDS; round++)
        for (int i = 0; i < c->count; i++) {
            double ns = interrupted() ? -1 : tune_work_run(c->works[i]);
            if (ns < 0)
                return false;
            if (round >= 0)
                c->ns[i][round] = ns;
            progress_show(&t->progress, ++t->done);
        }
    return true;
}

/* Whether all machines give the same bits. *read: whether the results could be read. */
static bool contest_agrees(const struct contest *c, bool *read)
{
    size_t count = tune_work_count(c->works[0]);
    float *first = malloc(count * sizeof *first), *other = malloc(count * sizeof *other);
    *read = first && other && tune_work_read(c->works[0], first);
    bool agrees = *read;
    for (int i = 1; i < c->count && agrees; i++) {
        *read = tune_work_read(c->works[i], other);
        agrees = *read && !memcmp(first, other, count * sizeof *first);
    }
    free(first);
    free(other);
    return agrees;
}

static double best_ns(const struct contest *c, int which)
{
    double best = c->ns[which][0];
    for (int r = 1; r < ROUNDS; r++)
        best = c->ns[which][r] < best ? c->ns[which][r] : best;
    return best;
}

/* Multiplies the ratios to the first machine with those of the works before. */
static void contest_judge(const struct contest *c, enum tune_kind kind, struct tried *tried)
{
    for (int i = 0; i < c->count; i++) {
        double ratios[ROUNDS], ns[ROUNDS];
        for (int r = 0; r < ROUNDS; r++) {
            ratios[r] = c->ns[i][r] / c->ns[0][r];
            ns[r] = c->ns[i][r];
        }
        tried[i].ns[kind] = median(ns, ROUNDS);
        tried[i].ratio *= median(ratios, ROUNDS);
        tried[i].best_ratio *= best_ns(c, i) / best_ns(c, 0);
    }
}

static int contest(struct tune *t, const struct step *s, enum tune_kind kind, const int *values,
                   int count, struct tried *tried)
{
    struct contest c;
    bool good = contest_open(&c, t, s, kind, values, count) && contest_run(&c, t);
    bool read = true, agrees = !good || contest_agrees(&c, &read);
    int status = EXIT_SUCCESS;
    if (interrupted())
        status = EXIT_INTERRUPTED;
    else if (!good || !read)
        status = fail("tune", "%s", tune_work_error());
    else if (!agrees)
        status = fail("tune",
                      "%s gives other results with other values of %s: this device or its "
                      "compiler is at fault; nothing is kept",
                      tune_kind_name(kind), machine_knob_name(s->knob));
    else
        contest_judge(&c, kind, tried);
    contest_close(&c);
    return status;
}

/* ---- one knob ---- */

/* The usual value, then the table's other values. */
static int values_of(const struct step *s, int usual, int *values)
{
    int count = 0;
    values[count++] = usual;
    for (int i = 0; i < s->values_count && count < VALUES_MOST; i++)
        if (s->values[i] != usual)
            values[count++] = s->values[i];
    return count;
}

/* A GPU has scalar work-items of one column, so these knobs do not apply; the strips' knobs
 * need vectors and several turns. */
static bool step_applies(const struct tune *t, const struct step *s)
{
    bool lanes = t->best.of[MACHINE_VECTOR] > 1, turns = t->best.of[MACHINE_TURNS] > 1;
    if (t->usual.of[MACHINE_VECTOR] == 1)
        return false;
    return s->about == ABOUT_ITEMS || (lanes && (s->about != ABOUT_STRIPS || turns));
}

static int step_tune(struct tune *t, const struct step *s)
{
    int values[VALUES_MOST], count = values_of(s, t->usual.of[s->knob], values), works = 0;
    struct tried *tried = &t->tried[t->tried_count];
    if (!step_applies(t, s))
        return EXIT_SUCCESS;
    for (int i = 0; i < count; i++)
        tried[i] = (struct tried){
            .knob = s->knob, .value = values[i], .usual = i == 0, .ratio = 1, .best_ratio = 1};
    for (int kind = 0; kind < TUNE_KINDS; kind++) {
        if (!s->works[kind])
            continue;
        int status = contest(t, s, (enum tune_kind)kind, values, count, tried);
        if (status != EXIT_SUCCESS)
            return status;
        works++;
    }
    int best = 0;
    for (int i = 0; i < count; i++) {
        tried[i].ratio = pow(tried[i].ratio, 1.0 / works);
        if (tried[i].ratio < tried[best].ratio && tried[i].ratio < CLEARLY &&
            tried[i].best_ratio < 1)
            best = i;
    }
    tried[best].chosen = true;
    t->best.of[s->knob] = values[best];
    t->tried_count += count;
    return EXIT_SUCCESS;
}

/* ---- all of them ---- */

static int runs_in_all(const struct tune *t)
{
    int runs = 0, values[VALUES_MOST];
    for (int i = 0; i < STEPS_COUNT; i++)
        for (int kind = 0; kind < TUNE_KINDS; kind++)
            if (steps[i].works[kind])
                runs += (WARM_RUNS + ROUNDS) *
                        values_of(&steps[i], t->usual.of[steps[i].knob], values);
    return runs;
}

static bool costs_differ(double a, double b)
{
    return a < b || a > b;
}

/* The cost model's numbers, with the chosen knobs. */
static int costs_tune(struct tune *t)
{
    struct machine_config config = machine_config_default();
    struct machine *m;
    double ns[MACHINE_COSTS];
    config.tuning = &t->best;
    config.eager = 0;
    enum machine_status status = machine_create(&config, &m);
    if (!status)
        status = machine_costs_measure(m, ns);
    int end =
        !status ? EXIT_SUCCESS : fail("tune", "%s", m ? machine_error(m) : "not enough memory");
    for (int i = 0; i < MACHINE_COSTS && !status; i++)
        if (ns[i] > 0)
            t->best.cost_ns[i] = ns[i];
    machine_destroy(m);
    return interrupted() ? EXIT_INTERRUPTED : end;
}

static void costs_print(const struct tune *t)
{
    printf("%-12s %12s  %12s  (ns; what plans follow from)\n", "", "usual", "measured");
    for (int i = 0; i < MACHINE_COSTS; i++) {
        printf("%-12s %12.4g  ", machine_cost_name((enum machine_cost)i), t->usual.cost_ns[i]);
        if (costs_differ(t->best.cost_ns[i], t->usual.cost_ns[i]))
            printf("%12.4g  %.2fx\n", t->best.cost_ns[i],
                   t->best.cost_ns[i] / t->usual.cost_ns[i]);
        else
            printf("%12s\n", "-");
    }
}

static void table_print(const struct tune *t)
{
    if (!t->tried_count)
        return;
    printf("%-12s %6s  ", "", "");
    for (int kind = 0; kind < TUNE_KINDS; kind++)
        printf("  %10s", tune_kind_name((enum tune_kind)kind));
    printf("   all  (ns for each turn and processor; the ratio to the usual)\n");
    for (int i = 0; i < t->tried_count; i++) {
        const struct tried *r = &t->tried[i];
        printf("%-12s %6d%s", r->usual ? machine_knob_name(r->knob) : "", r->value,
               r->chosen ? " *" : "  ");
        for (int kind = 0; kind < TUNE_KINDS; kind++)
            if (r->ns[kind] > 0)
                printf("  %10.3f", r->ns[kind]);
            else
                printf("  %10s", "");
        printf("  %.2fx%s\n", r->ratio, r->usual ? "  usual" : "");
    }
}

static int json_write(const char *path, const struct tune *t, struct machine *m)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return fail("tune", "%s: cannot write: %s", path, out.why);
    FILE *f = out.stream;
    fputs("{\"device\": \"", f);
    for (const char *c = machine_device_name(m); *c; c++)
        if (*c == '"' || *c == '\\')
            fprintf(f, "\\%c", *c);
        else if ((unsigned char)*c >= ' ')
            fputc(*c, f);
    fputs("\",\n \"tuning\": {", f);
    for (int k = 0; k < MACHINE_KNOBS; k++)
        fprintf(f, "%s\"%s\": %d", k ? ", " : "", machine_knob_name((enum machine_knob)k),
                t->best.of[k]);
    fputs("},\n \"costs\": {", f);
    for (int i = 0; i < MACHINE_COSTS; i++)
        fprintf(f, "%s\"%s_ns\": {\"usual\": %.9g, \"is\": %.9g}", i ? ", " : "",
                machine_cost_name((enum machine_cost)i), t->usual.cost_ns[i],
                t->best.cost_ns[i]);
    fputs("},\n \"tried\": [", f);
    for (int i = 0; i < t->tried_count; i++) {
        const struct tried *r = &t->tried[i];
        fprintf(f, "%s\n  {\"knob\": \"%s\", \"value\": %d, \"ratio\": %.4f, \"chosen\": %s",
                i ? "," : "", machine_knob_name(r->knob), r->value, r->ratio,
                r->chosen ? "true" : "false");
        for (int kind = 0; kind < TUNE_KINDS; kind++)
            if (r->ns[kind] > 0)
                fprintf(f, ", \"%s_ns\": %.4f", tune_kind_name((enum tune_kind)kind),
                        r->ns[kind]);
        fputs("}", f);
    }
    fputs("\n ]}\n", f);
    return output_file_commit(&out) ? EXIT_SUCCESS
                                    : fail("tune", "%s: cannot write: %s", path, out.why);
}

/* A knob forced by the environment cannot be measured at other values. */
static int forced_check(void)
{
    static const char *const forcing[] = {
        "LUTETIA_VECTOR",      "LUTETIA_RUN",    "LUTETIA_STREAMS", "LUTETIA_TURNS",
        "LUTETIA_COLUMNS",     "LUTETIA_STRIPS", "LUTETIA_REPLAY",  "LUTETIA_FLUSH_AFTER",
        "LUTETIA_STRIPS_EACH", "LUTETIA_EAGER"};
    for (size_t i = 0; i < sizeof forcing / sizeof *forcing; i++)
        if (getenv(forcing[i]) && *getenv(forcing[i]))
            return fail_usage("tune", "%s is set; unset it, for what it forces is measured",
                              forcing[i]);
    return EXIT_SUCCESS;
}

static int tune(struct machine *m, bool dry, const char *json_path)
{
    struct tune t = {.usual = machine_tuning_get(m)};
    t.best = t.usual;
    visible_print("%s, driver %s\n", machine_device_name(m), machine_device_driver(m));
    fflush(stdout);
    bool knobs = t.usual.of[MACHINE_VECTOR] > 1;
    if (!knobs)
        puts("the knobs have values that suit any such device; its costs are measured");
    t.progress = progress_begin("tune", runs_in_all(&t));
    int status = EXIT_SUCCESS;
    for (int i = 0; i < STEPS_COUNT && status == EXIT_SUCCESS; i++)
        status = step_tune(&t, &steps[i]);
    progress_end(&t.progress);
    if (status == EXIT_SUCCESS)
        status = costs_tune(&t);
    if (status != EXIT_SUCCESS)
        return status;
    table_print(&t);
    costs_print(&t);
    if (json_path)
        status = json_write(json_path, &t, m);
    if (dry || status != EXIT_SUCCESS)
        return status;
    if (machine_tuning_keep(m, &t.best) != MACHINE_OK)
        return fail("tune", "%s", machine_error(m));
    char text[800];
    machine_tuning_describe(m, text, sizeof text);
    visible_print("%s\n", text);
    return EXIT_SUCCESS;
}

int verb_tune(int argc, char **argv)
{
    bool dry = false;
    const char *json_path = NULL;
    const struct option_row rows[] = {
        {"dry-run", 0, OPTION_FLAG, NULL, "measure, and keep nothing", &dry, 0, 0, 0},
        {"json", 0, OPTION_TEXT, "FILE", "also write what was tried there", &json_path, 0, 0,
         0},
        {0}};
    struct option_words words;
    if (!options_parse("tune", rows, argc, argv, &words))
        return EXIT_USAGE;
    if (words.help)
        return help_print("tune", rows, NULL);
    if (words.count)
        return fail_usage("tune", "there is nothing to do with '%.60s'", words.words[0]);
    if (forced_check() != EXIT_SUCCESS)
        return EXIT_USAGE;
    const char *wrong = json_path ? output_file_wrong(json_path) : NULL;
    if (wrong)
        return fail("tune", "%s: cannot write: %s", json_path, wrong);
    interrupt_catch();
    setenv("LUTETIA_BOX_AFTER", "0", 1); /* use the final kernels, as in a long run, from the
                                          * start */
    struct machine_tuning usual = machine_tuning_usual();
    struct machine_config config = machine_config_default();
    struct machine *m;
    config.tuning = &usual;
    if (machine_create(&config, &m) != MACHINE_OK) {
        int status = fail("tune", "%s", m ? machine_error(m) : "not enough memory");
        machine_destroy(m);
        return status;
    }
    int status = interrupt_report("tune", tune(m, dry, json_path), "what was kept before is");
    machine_destroy(m);
    return status;
}
