/* main.c - the table of verbs. */
#include "help.h"
#include "lutetia.h"

#include <machine_ranks.h>
#include <part_files.h>
#include <script.h>
#include <streams.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *arguments, *help;
} verbs[] = {
    {"paint", verb_paint, "\"Text\" [-o out.png]", "set type or a bitmap in ink on wet paper"},
    {"type", verb_type, "\"Text\" [-o out.png]", "set type at any size, place and angle"},
    {"set", verb_set, "FILE [-o page.png]", "set a text as pages: columns, notes, shapes"},
    {"read", verb_read, "[FILE.md...] [-o read.pdf]",
     "read Markdown, in a window or as pages; without a file the manual"},
    {"font", verb_font, "FILE [-o out.png]", "show a font, its glyphs at each level, filters"},
    {"spring", verb_spring, "\"word\"", "a word on springs, in a window, stills and films"},
    {"stage", verb_stage, "NAME | FILE.lua | --list",
     "short pieces on springs, led by scripts"},
    {"voice", verb_voice, "SOUND \"Text\"", "letters that a voice plays: poster, frames, film"},
    {"studio", verb_studio, "[sheet.h5]", "paint and set type by hand, on paper that flows"},
    {"run", verb_run, "script.lua [key=value...]", "run a script of papers, inks and time"},
    {"demo", verb_demo, "[-o DIR]", "paint the demonstration page"},
    {"cc", verb_cc, "prog.c... [-o prog]", "compile a C/Paris program"},
    {"leds", verb_leds, "prog [args...]", "show the lights that a C/Paris program latches"},
    {"display", verb_display, "prog [args...]",
     "show what a C/Paris program writes to displays"},
    {"explain", verb_explain, "prog [args...]",
     "run a C/Paris program and say what its machine did"},
    {"debug", verb_debug, "prog [args...]", "look for a C/Paris program's faults, in gdb"},
    {"keys", verb_keys, "SONG.mid [-o out.png]", "letters that the keys of a song play"},
    {"midi", verb_midi, "serve | play | monitor | ...",
     "instruments: a server, and programs that use it"},
    {"bench", verb_bench, "NAME [options]", "measure"},
    {"tune", verb_tune, "", "measure what suits the device, and keep it"},
    {"info", verb_info, "", "versions, devices, folders, and what a fiber takes"},
};

enum { VERBS_COUNT = sizeof verbs / sizeof *verbs };

static void help(FILE *out)
{
    fputs("usage: lutetia VERB ...\n\n", out);
    for (int i = 0; i < VERBS_COUNT; i++) {
        char left[64];
        snprintf(left, sizeof left, "%s %s", verbs[i].name, verbs[i].arguments);
        fprintf(out, "  %-34s %s\n", left, verbs[i].help);
    }
    fputs("\n`lutetia VERB --help` and `man lutetia-VERB` say more.  LUTETIA_DEVICE chooses a "
          "device (part of\nits name, or its number); `lutetia info --variables` lists all "
          "variables of the environment.\n",
          out);
}

static void script_function_print(const char *type, const char *name)
{
    printf("script\t%s\t%s\n", type, name);
}

/* All that the verbs' helps say, as a table: manual pages and completions are made of it. */
static int help_table(void)
{
    static char ask[] = "--help";
    int status = EXIT_SUCCESS;
    help_as_table();
    puts("version\t" LUTETIA_VERSION);
    help_print("", NULL, NULL);
    for (int i = 0; i < VERBS_COUNT && status == EXIT_SUCCESS; i++) {
        char name[16];
        snprintf(name, sizeof name, "%s", verbs[i].name);
        printf("verb\t%s\t%s\t%s\n", name, verbs[i].arguments, verbs[i].help);
        char *argv[] = {name, ask, NULL};
        status = verbs[i].run(2, argv);
    }
    help_environment();
    script_functions_list(script_function_print);
    return status;
}

/* `lutetia help VERB` is `lutetia VERB --help`. */
static int help_of(const char *verb, const char **name)
{
    static char ask[] = "--help";
    for (int i = 0; i < VERBS_COUNT; i++)
        if (strcmp(verb, verbs[i].name) == 0) {
            char own[16];
            snprintf(own, sizeof own, "%s", verbs[i].name);
            char *argv[] = {own, ask, NULL};
            *name = verbs[i].name;
            return verbs[i].run(2, argv);
        }
    return fail_usage(NULL, "there is no verb '%.60s'; `lutetia --help` lists them", verb);
}

/* Runs the verb and returns its status; *name gets its name. */
static int verb_run_named(int argc, char **argv, const char **name)
{
    if (argc < 2) {
        help(stderr);
        return EXIT_USAGE;
    }
    if (strcmp(argv[1], "--version") == 0) {
        puts("lutetia " LUTETIA_VERSION);
        return EXIT_SUCCESS;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 ||
        strcmp(argv[1], "help") == 0) {
        if (argc > 2 && strcmp(argv[2], "--table") == 0)
            return help_table();
        if (argc > 2 && strcmp(argv[1], "help") == 0)
            return help_of(argv[2], name);
        help(stdout);
        return EXIT_SUCCESS;
    }
    for (int i = 0; i < VERBS_COUNT; i++)
        if (strcmp(argv[1], verbs[i].name) == 0) {
            *name = verbs[i].name;
            return verbs[i].run(argc - 1, argv + 1);
        }
    return fail_usage(NULL, "there is no verb '%.60s'; `lutetia --help` lists them", argv[1]);
}

/* Verbs whose sheets may be in the memory of several processes (docs/blocks.md). The others
 * make a machine that says why it cannot be, or need none. */
static bool may_be_ranks(const char *verb)
{
    return strcmp(verb, "run") == 0 || strcmp(verb, "paint") == 0;
}

int main(int argc, char **argv)
{
    const char *name = NULL;
    if (argc > 1 && may_be_ranks(argv[1]))
        machine_ranks_begin();
    streams_fill();
    part_files_catch();
    int status = verb_run_named(argc, argv, &name);
    if (!streams_end() && status == EXIT_SUCCESS)
        status = fail(name, "cannot write to the standard output");
    return status;
}
