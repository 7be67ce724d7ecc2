/* fonts.c - `lutetia bench fonts`: parses its options, and runs one of its three
 * measurements. */
#include "bench.h"
#include "fonts_filters.h"
#include "fonts_thorough.h"
#include "fonts_ways.h"
#include <visible_text.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { EXIT_WRONG = 2 };

static const char usage[] =
    "usage: lutetia bench fonts [--ways | --thorough] [--json FILE] [--font FONT] [--filter "
    "FILTER] [--quick]\n"
    "\n"
    "Glyphs a second of every filter at four sizes, five faces together, beside FreeType's "
    "loading and\n"
    "rendering and stb_truetype, on one thread; how far from exact they are; how long a glyph "
    "takes that is\n"
    "used for the first time. Then like beside like, of three filters at eight sizes: "
    "FreeType's rasteriser\n"
    "alone, of scaled outlines in memory, and both from the font's bytes.\n"
    "--ways: the ways to one filter's glyphs (gaussian-fast, of DejaVuSans): kept edges, "
    "outlines, files, rectangles, OpenCL.\n"
    "--thorough: how exact, over all places, angles and distortions (minutes); no times.\n"
    "--font, --filter: that one alone.\n"
    "--quick: only 12.25 px.\n";

int bench_fonts_main(int argc, char **argv)
{
    const char *json = NULL, *font = NULL, *filter = NULL;
    bool quick = false, thorough = false, ways = false;
    for (int i = 1; i < argc; i++) {
        const char **target = strcmp(argv[i], "--json") == 0     ? &json
                              : strcmp(argv[i], "--font") == 0   ? &font
                              : strcmp(argv[i], "--filter") == 0 ? &filter
                                                                 : NULL;
        bool *choice = strcmp(argv[i], "--quick") == 0      ? &quick
                       : strcmp(argv[i], "--thorough") == 0 ? &thorough
                       : strcmp(argv[i], "--ways") == 0     ? &ways
                                                            : NULL;
        if (choice) {
            *choice = true;
        } else if (target && i + 1 < argc) {
            *target = argv[++i];
        } else {
            bool help = strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0;
            fputs(usage, help ? stdout : stderr);
            return help ? EXIT_SUCCESS : EXIT_WRONG;
        }
    }
    static struct bench_report report;
    bool ok = !json || bench_can_write(json);
    if (ok && thorough) {
        bench_report_init(&report, "fonts", 1, "one thread");
        ok = fonts_thorough_run(&report);
        bench_report_print(&report, "freetype", stdout);
    } else if (ok && ways) {
        ok = fonts_ways_run(font ? font : "DejaVuSans", filter ? filter : "gaussian-fast",
                            quick, &report);
    } else if (ok) {
        ok = fonts_filters_run(font, filter, quick, &report);
    }
    if (!ok || (json && !bench_report_write(&report, json))) {
        visible_say("lutetia bench fonts: %s", bench_error());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
