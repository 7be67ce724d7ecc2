/* lutetia_bench.c - the benchmarks, a program of its own that `lutetia bench NAME` runs: the peers' libraries would make
 * each start of the command slower. */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <streams.h>
#include <string.h>
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
     "histogram, transposition, sort, lists, scans, wide numbers, byte code, beside plain C"},
    {"fonts", bench_fonts_main, "glyphs in gray, beside FreeType and stb_truetype"},
    {"text", bench_text_main, "justified lines, beside Pango"},
    {"springs", bench_springs_main, "masses and springs, beside plain C, Chipmunk and Box2D"},
    {"model", bench_model_main,
     "what the engine's cost model prefers, beside what it could have had"},
    {"midi", bench_midi_main, "a note from an instrument to sixteen programs"},
    {"start", bench_start_main,
     "the first picture, from the command, with warm caches and empty ones"},
};

enum { BENCHES_COUNT = sizeof benches / sizeof *benches, EXIT_USAGE = 2 };

static int bench(int argc, char **argv)
{
    if (argc < 2 || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        FILE *out = argc < 2 ? stderr : stdout;
        fputs("usage: lutetia bench NAME [options]\n\n", out);
        for (int i = 0; i < BENCHES_COUNT; i++)
            fprintf(out, "  %-12s %s\n", benches[i].name, benches[i].help);
        return argc < 2 ? EXIT_USAGE : EXIT_SUCCESS;
    }
    for (int i = 0; i < BENCHES_COUNT; i++)
        if (strcmp(argv[1], benches[i].name) == 0)
            return benches[i].run(argc - 1, argv + 1);
    char name[400];
    visible_text(name, sizeof name, argv[1]);
    fprintf(stderr,
            "lutetia bench: there is no benchmark '%.60s'; `lutetia bench --help` lists them\n",
            name);
    return EXIT_USAGE;
}

int main(int argc, char **argv)
{
    streams_fill();
    int status = bench(argc, argv);
    if (streams_end() || status != EXIT_SUCCESS)
        return status;
    fputs("lutetia bench: cannot write to the standard output\n", stderr);
    return EXIT_FAILURE;
}
