/* test_random.c - random Paris programs: fused, eager and the oracle agree bit for bit.
 *
 *     test_random [--programs N] [--seed S] [--length L] [--seconds T] [--mode fused|eager|both] [--print SEED]
 *                 [--sabotage 1..3] [--shrink-seconds T] [--loops] [--sheets] [--shapes]
 *
 * Runs programs S, S+1, … of L instructions, until N are done or T seconds have passed.
 * --shapes forces each of the device shapes below in turn, for N programs or its share of the
 * seconds. A failing program is shrunk and printed as C; the exit status is then 1. Most of the
 * time goes into compiling kernels, which the disk cache keeps.
 */
#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "clock.h"
#include "program.h"

/* Each shape forces decisions that the engine otherwise makes by itself. Evaluations come
 * early, so that the engine finds loops (OFTEN). Only plans with fully optimised kernels, which
 * take long to compile, put many turns into one kernel (BEST). */
#define OFTEN "LUTETIA_FLUSH_AFTER=48"
#define BEST "LUTETIA_FLUSH_AFTER=48", "LUTETIA_BOX_AFTER=0"

enum { VARIABLES_MOST = 8 };

static const char *const shapes[][VARIABLES_MOST] = {
    {"LUTETIA_VECTOR=16", "LUTETIA_STRIPS=1", "LUTETIA_TURNS=8", "LUTETIA_IN_PLACE=1", BEST},
    {"LUTETIA_VECTOR=8", "LUTETIA_STRIPS=1", "LUTETIA_TURNS=4", "LUTETIA_COLUMNS=16", BEST},
    {"LUTETIA_VECTOR=1", "LUTETIA_STRIPS=1", "LUTETIA_TILE=5x3", "LUTETIA_TURNS=3", BEST},
    {"LUTETIA_VECTOR=1", "LUTETIA_NUMBERS=1", OFTEN},
    {"LUTETIA_VECTOR=4", "LUTETIA_STRIPS=1", "LUTETIA_COLUMNS=16", "LUTETIA_TURNS=1", OFTEN},
    {"LUTETIA_VECTOR=4", "LUTETIA_STRIPS=1", "LUTETIA_TURNS=2", "LUTETIA_IN_PLACE=1", BEST},
    {"LUTETIA_VECTOR=16", "LUTETIA_STRIPS=1", "LUTETIA_TURNS=3", "LUTETIA_COLUMNS=48", BEST},
    {"LUTETIA_VECTOR=4", "LUTETIA_CLAIMS=0", OFTEN},
    {"LUTETIA_VECTOR=8", "LUTETIA_NUMBERS=1", OFTEN},
    {"LUTETIA_VECTOR=16", OFTEN},
    {"LUTETIA_VECTOR=8", "LUTETIA_STRIPS=1", "LUTETIA_COLUMNS=16", "LUTETIA_STRIPS_EACH=16",
     OFTEN},
    {"LUTETIA_VECTOR=16", "LUTETIA_STRIPS=1", "LUTETIA_COLUMNS=32", "LUTETIA_REPLAY=0", OFTEN},
    {"LUTETIA_STRIPS=0", "LUTETIA_TURNS=1", "LUTETIA_RUN=16", "LUTETIA_NUMBERS=1", OFTEN},
    {"LUTETIA_VECTOR=1", "LUTETIA_STRIPS=1", "LUTETIA_TILE=16x8", "LUTETIA_TURNS=2", BEST},
    {"LUTETIA_VECTOR=1", "LUTETIA_STRIPS=1", "LUTETIA_TILE=1x1", "LUTETIA_TURNS=1", OFTEN},
    {"LUTETIA_VECTOR=1", "LUTETIA_STRIPS=1", "LUTETIA_TURNS=8", BEST},
};

enum { SHAPES_COUNT = sizeof shapes / sizeof *shapes };

struct options {
    long programs, seed, length;
    double seconds, shrink_seconds;
    bool fused, eager, loops, sheets, shapes;
    enum sabotage sabotage;
};

struct mode {
    bool eager;
    enum sabotage sabotage;
    double deadline_s; /* of shrinking; 0: none */
};

static bool differs(const struct program *p, const struct mode *mode, struct trace *a,
                    struct trace *b, size_t *where)
{
    oracle_run(p, a, mode->sabotage);
    paris_run(p, b, mode->eager);
    return trace_differ(a, b, where);
}

/* Past the deadline every program counts as good, so that shrinking ends with the smallest
 * program so far. */
static bool fails(void *context, const struct program *p)
{
    const struct mode *mode = context;
    struct trace a = {0}, b = {0};
    size_t where;
    bool result;

    if (mode->deadline_s > 0 && clock_now_s() > mode->deadline_s)
        return false;
    result = differs(p, mode, &a, &b, &where);
    trace_finish(&a);
    trace_finish(&b);
    return result;
}

static void print_word(const char *who, const struct trace *t, size_t where)
{
    if (where < t->count)
        printf("   %s %#llx (instruction %u)", who, (unsigned long long)t->words[where],
               t->steps[where]);
    else
        printf("   %s shows nothing more", who);
}

static void report(const struct program *found, struct mode *mode, double shrink_seconds)
{
    struct program p = *found;
    struct trace a = {0}, b = {0};
    size_t where;
    double start = clock_now_s();
    int runs;

    mode->deadline_s = start + shrink_seconds;
    runs = program_shrink(&p, fails, mode);

    printf("seed %llu, %s: differs from the oracle. %d instructions shrunk to %d in %d runs, "
           "%.0f s:\n\n",
           (unsigned long long)p.seed, mode->eager ? "eager" : "fused", found->count, p.count,
           runs, clock_now_s() - start);
    program_print(&p, stdout);
    if (differs(&p, mode, &a, &b, &where)) {
        printf("\n/* word %zu of what it shows and leaves:", where);
        print_word("the oracle", &a, where);
        print_word(mode->eager ? "eager" : "fused", &b, where);
        printf(" */\n");
    } else {
        printf("\n/* it does not fail when run once more: not the same bits each time */\n");
    }
    trace_finish(&a);
    trace_finish(&b);
}

/* Whether the fault shows in this program, by comparing the right and the wrong oracle, without
 * a device. */
static bool sabotage_shows(const struct program *p, enum sabotage sabotage)
{
    struct trace right = {0}, wrong = {0};
    size_t where;
    bool result;

    oracle_run(p, &right, SABOTAGE_NONE);
    oracle_run(p, &wrong, sabotage);
    result = trace_differ(&right, &wrong, &where);
    trace_finish(&right);
    trace_finish(&wrong);
    return result;
}

static void generate(const struct options *o, struct program *p, uint64_t seed)
{
    if (o->loops || o->sheets)
        program_generate_loop(p, seed, o->sheets);
    else
        program_generate(p, seed, (int)o->length);
    program_normalise(p);
}

static bool one(const struct options *o, uint64_t seed)
{
    struct program p;

    generate(o, &p, seed);
    if (o->sabotage && !sabotage_shows(&p, o->sabotage))
        return true;
    for (int eager = 0; eager < 2; eager++) {
        struct mode mode = {eager, o->sabotage, 0};

        if (!(eager ? o->eager : o->fused) || !fails(&mode, &p))
            continue;
        report(&p, &mode, o->shrink_seconds);
        return false;
    }
    return true;
}

static void usage(void)
{
    fputs("usage: test_random [--programs N] [--seed S] [--length L] [--seconds T]\n"
          "                   [--mode fused|eager|both] [--print SEED] [--sabotage 1..3]\n"
          "                   [--shrink-seconds T] [--loops] [--sheets] [--shapes]\n",
          stderr);
    exit(2);
}

static long number(const char *text)
{
    char *end;
    long value = strtol(text, &end, 0);

    if (*end || end == text || value < 0)
        usage();
    return value;
}

/* Runs programs for that many seconds or until one differs. Returns how many differ: 0 or 1. */
static long many(const struct options *o, double seconds, long *done)
{
    double start = clock_now_s();
    long failed = 0;

    for (*done = 0; *done < o->programs && failed == 0 && clock_now_s() - start < seconds;
         ++*done)
        failed += !one(o, (uint64_t)(o->seed + *done));
    return failed;
}

static long in_shapes(const struct options *o, long *done)
{
    long failed = 0;
    double first = clock_now_s();

    /* If compiling kernels takes longer than the given seconds, only the first shapes are
     * tried. */
    for (int i = 0; i < SHAPES_COUNT && !failed && clock_now_s() - first < 2 * o->seconds;
         i++) {
        long of_shape;
        double start = clock_now_s();
        struct paris_counts before = paris_counts();
        paris_force(shapes[i]);
        failed = many(o, o->seconds / SHAPES_COUNT, &of_shape);
        *done += of_shape;
        for (int k = 0; shapes[i][k]; k++)
            printf("%s ", shapes[i][k] + strlen("LUTETIA_"));
        struct paris_counts now = paris_counts();
        printf("\n    %ld programs, %ld kernels built, %ld of several stages run, %ld calls "
               "foreseen, %.1f s%s\n",
               of_shape, now.kernels_built - before.kernels_built,
               now.kernels_of_stages - before.kernels_of_stages,
               now.calls_foreseen - before.calls_foreseen, clock_now_s() - start,
               failed ? ": differs" : "");
        fflush(stdout);
    }
    return failed;
}

int main(int argc, char **argv)
{
    static const struct option names[] = {{"programs", required_argument, NULL, 'n'},
                                          {"seed", required_argument, NULL, 's'},
                                          {"length", required_argument, NULL, 'l'},
                                          {"seconds", required_argument, NULL, 't'},
                                          {"mode", required_argument, NULL, 'm'},
                                          {"sabotage", required_argument, NULL, 'x'},
                                          {"print", required_argument, NULL, 'p'},
                                          {"shrink-seconds", required_argument, NULL, 'k'},
                                          {"loops", no_argument, NULL, 'o'},
                                          {"sheets", no_argument, NULL, 'w'},
                                          {"shapes", no_argument, NULL, 'd'},
                                          {NULL, 0, NULL, 0}};
    struct options o = {.programs = 200,
                        .seed = 1,
                        .length = 40,
                        .seconds = 80,
                        .shrink_seconds = 600,
                        .fused = true,
                        .eager = true};
    double start = clock_now_s();
    long done = 0, failed = 0;
    int c;

    while ((c = getopt_long(argc, argv, "", names, NULL)) != -1) {
        if (c == 'n')
            o.programs = number(optarg);
        else if (c == 's')
            o.seed = number(optarg);
        else if (c == 'l')
            o.length = number(optarg);
        else if (c == 't')
            o.seconds = (double)number(optarg);
        else if (c == 'o')
            o.loops = true;
        else if (c == 'd')
            o.shapes = true;
        else if (c == 'w')
            o.sheets = true;
        else if (c == 'k')
            o.shrink_seconds = (double)number(optarg);
        else if (c == 'm') {
            o.fused = strcmp(optarg, "eager") != 0;
            o.eager = strcmp(optarg, "fused") != 0;
        } else if (c == 'x') {
            o.sabotage = (enum sabotage)(number(optarg) % SABOTAGE_COUNT);
        } else if (c == 'p') {
            struct program p;

            generate(&o, &p, (uint64_t)number(optarg));
            program_print(&p, stdout);
            return 0;
        } else {
            usage();
        }
    }
    failed = o.shapes ? in_shapes(&o, &done) : many(&o, o.seconds, &done);
    struct paris_counts counts = paris_counts();
    printf("%ld programs from seed %ld, %ld instructions each at most: %ld differ, %ld "
           "kernels built, %ld calls foreseen, %.1f s\n",
           done, o.seed, o.length, failed, counts.kernels_built, counts.calls_foreseen,
           clock_now_s() - start);
    return failed != 0;
}
