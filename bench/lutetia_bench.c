/* lutetia_bench.c - the benchmarks, a program of its own that `lutetia bench NAME` runs: the
 * peers' libraries would make each start of the command slower. */
#include "bench.h"
#include "harness.h"

#include <errno.h>
#include <part_files.h>
#include <stdio.h>
#include <stdlib.h>
#include <streams.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include <visible_text.h>

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *help;
} benches[] = {
    {"diffusion", bench_diffusion_main,
     "the thesis's cycle through the machine, beside its limits"},
    {"calls", bench_calls_main, "what a C/Paris call costs the front end"},
    {"scan", bench_scan_main, "scans along a line, beside plain C"},
    {"rank", bench_rank_main, "ranks along a line, beside a radix sort in plain C"},
    {"life", bench_life_main, "Conway's Life in Paris, beside C with OpenMP"},
    {"heat", bench_heat_main, "a heat equation of nine points in Paris, beside C with OpenMP"},
    {"paper", bench_paper_main, "sheets of paper in Paris, beside C with OpenMP"},
    {"paris", bench_paris_main, "one instruction of each family, beside the copy bandwidth"},
    {"interpreter", bench_interpreter_main,
     "programs of vector operations that do not repeat, beside plain C"},
    {"families", bench_families_main,
     "histogram, transposition, sort, lists, scans, wide numbers, byte code, linear algebra, "
     "beside plain C"},
    {"memory", bench_memory_main, "the most bytes that those programs' arrays take at once"},
    {"fonts", bench_fonts_main, "glyphs in gray, beside FreeType and stb_truetype"},
    {"text", bench_text_main, "justified lines, beside Pango"},
    {"springs", bench_springs_main, "masses and springs, beside plain C, Chipmunk and Box2D"},
    {"model", bench_model_main,
     "what the engine's cost model prefers, beside what it could have had"},
    {"midi", bench_midi_main, "a note from an instrument to sixteen programs"},
    {"start", bench_start_main,
     "the first picture, from the command, with warm caches and empty ones"},
    {"display", bench_display_main,
     "60 pictures a second on the frame buffer, beside the same program without"},
    {"reader", bench_reader_main, "documents in the reader's window, beside Pango"},
    {"studio", bench_studio_main,
     "what a hand waits for in the studio, beside the empty window"},
};

enum { BENCHES_COUNT = sizeof benches / sizeof *benches, EXIT_USAGE = 2 };

static int place_of(const char *name)
{
    for (int i = 0; i < BENCHES_COUNT; i++)
        if (strcmp(name, benches[i].name) == 0)
            return i;
    char visible[400];
    visible_text(visible, sizeof visible, name);
    visible_say(
        "lutetia bench: there is no benchmark '%.60s'; `lutetia bench --help` lists them",
        visible);
    return -1;
}

/* In a process of its own, as it would be alone. */
static bool tried(int i)
{
    char name[32], quick[] = "--quick";
    char *argv[] = {name, quick, NULL};
    int status = -1;
    snprintf(name, sizeof name, "%s", benches[i].name);
    printf("== %s\n", name);
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        bench_quick = true;
        /* fonts has small sizes of its own */
        status = benches[i].run(strcmp(name, "fonts") == 0 ? 2 : 1, argv);
        exit(fflush(stdout) == 0 ? status : EXIT_FAILURE);
    }
    if (child < 0)
        visible_say("lutetia bench: no process for %s: %s", name, strerror(errno));
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR)
        ;
    bool good = child > 0 && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS;
    if (!good)
        visible_say("lutetia bench: %s failed", name);
    return good;
}

/* --quick [NAME...]: those, or all. */
static int all_tried(int argc, char **argv)
{
    int failed = 0;
    for (int k = 0; k < argc; k++)
        if (place_of(argv[k]) < 0)
            return EXIT_USAGE;
    for (int k = 0; k < (argc ? argc : BENCHES_COUNT); k++)
        failed += !tried(argc ? place_of(argv[k]) : k);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}

static int bench(int argc, char **argv)
{
    if (argc < 2 || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        FILE *out = argc < 2 ? stderr : stdout;
        fputs("usage: lutetia bench NAME [options]\n"
              "       lutetia bench --quick [NAME...]   tries those, or all; the numbers mean "
              "nothing\n\n",
              out);
        for (int i = 0; i < BENCHES_COUNT; i++)
            fprintf(out, "  %-12s %s\n", benches[i].name, benches[i].help);
        return argc < 2 ? EXIT_USAGE : EXIT_SUCCESS;
    }
    if (strcmp(argv[1], "--quick") == 0)
        return all_tried(argc - 2, argv + 2);
    int i = place_of(argv[1]);
    return i < 0 ? EXIT_USAGE : benches[i].run(argc - 1, argv + 1);
}

int main(int argc, char **argv)
{
    streams_fill();
    part_files_catch();
    int status = bench(argc, argv);
    if (streams_end() || status != EXIT_SUCCESS)
        return status;
    visible_say("lutetia bench: cannot write to the standard output");
    return EXIT_FAILURE;
}
