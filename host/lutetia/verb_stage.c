/* verb_stage.c - `lutetia stage`: short pieces for a stage of springs, each a script in Lua
 * that says how it begins and leads it. */
#include "help.h"
#include "lutetia.h"
#include "options.h"

#include <input_file.h>
#include <visible_text.h>

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LINE_BYTES = 1000, WORDS_MAX = 64, PIECES_MAX = 64, NAME_BYTES = 64 };
static const char begins[] = "-- stage: ", loops[] = "-- loop: ";

/* What a piece may say of its beginning: nothing that names a file. */
static const char *const allowed[] = {"--preset", "--set",     "--at",    "--turn",
                                      "--column", "--circle",  "--view",  "--size",
                                      "--param",  "--seconds", "--theme", "--font"};

struct piece {
    char path[PATH_MAX];
    char about[LINE_BYTES]; /* its first line */
    char line[LINE_BYTES];  /* how it begins; its words are separated by zeros */
    char *words[WORDS_MAX];
    int count;
    double settle_s, loop_s; /* what --loop takes of it, and after how long; 0: not said */
};

/* ---- a piece ---- */

/* \n within a word is a line's end. */
static void line_ends_put(char *word)
{
    char *to = word;
    for (const char *at = word; *at; at++) {
        const bool end = at[0] == '\\' && at[1] == 'n';
        *to++ = end ? '\n' : *at;
        at += end;
    }
    *to = '\0';
}

/* Divides a line into words between blanks; a word in "quotes" may have some. False: a quote is
 * open, or there are too many. */
static bool words_split(struct piece *p, char *text)
{
    for (;;) {
        text += strspn(text, " \t\r\n");
        if (!*text)
            return true;
        const bool quoted = *text == '"';
        text += quoted;
        if (p->count == WORDS_MAX)
            return false;
        p->words[p->count++] = text;
        text += strcspn(text, quoted ? "\"" : " \t\r\n");
        if (!*text)
            return !quoted;
        *text++ = '\0';
        line_ends_put(p->words[p->count - 1]);
    }
}

static bool is_allowed(const char *word)
{
    for (size_t i = 0; i < sizeof allowed / sizeof *allowed; i++)
        if (strcmp(allowed[i], word) == 0)
            return true;
    return false;
}

/* `spring WORDS OPTION VALUE ...`; a theme or a font is a name, no path. */
static int beginning_check(const struct piece *p)
{
    if (p->count < 2 || strcmp(p->words[0], "spring") != 0 || p->words[1][0] == '-')
        return fail("stage", "%s: must begin as `%sspring \"WORDS\" [OPTION VALUE]...`",
                    p->path, begins);
    for (int i = 2; i < p->count; i += 2) {
        if (!is_allowed(p->words[i]) || i + 1 == p->count) {
            char known[200] = "";
            for (size_t k = 0; k < sizeof allowed / sizeof *allowed; k++)
                snprintf(known + strlen(known), sizeof known - strlen(known), " %s",
                         allowed[k]);
            return fail("stage", "%s: a piece begins with%s, each with a value (got '%.40s')",
                        p->path, known, p->words[i]);
        }
        if (strchr(p->words[i + 1], '/'))
            return fail("stage", "%s: %s names no file here (got '%.60s')", p->path,
                        p->words[i], p->words[i + 1]);
    }
    return EXIT_SUCCESS;
}

/* `--settle S --seconds S`: from when on, and in how long, its motion comes back. */
static int loop_read(struct piece *p, const char *line)
{
    char more;
    return sscanf(line, "--settle %lf --seconds %lf %c", &p->settle_s, &p->loop_s, &more) ==
                       2 &&
                   p->settle_s >= 0 && p->settle_s <= 3600 && p->loop_s > 0 && p->loop_s <= 3600
               ? EXIT_SUCCESS
               : fail("stage",
                      "%s: must be `%s--settle 0..3600 --seconds 0..3600` (got '%.60s')",
                      p->path, loops, line);
}

/* Reads the comment lines that a piece begins with. */
static int piece_read(struct piece *p)
{
    char line[LINE_BYTES];
    const char *why;
    FILE *file = input_file_open(p->path, &why);
    int status = EXIT_SUCCESS;
    if (!file)
        return fail("stage", "%s: cannot read: %s", p->path, why);
    while (status == EXIT_SUCCESS && fgets(line, sizeof line, file) &&
           strncmp(line, "--", 2) == 0) {
        line[strcspn(line, "\r\n")] = '\0';
        if (strncmp(line, begins, sizeof begins - 1) == 0)
            memcpy(p->line, line + sizeof begins - 1, strlen(line + sizeof begins - 1) + 1);
        else if (strncmp(line, loops, sizeof loops - 1) == 0)
            status = loop_read(p, line + sizeof loops - 1);
        else if (!p->about[0])
            snprintf(p->about, sizeof p->about, "%s", line + 2 + (line[2] == ' '));
    }
    fclose(file);
    if (status != EXIT_SUCCESS)
        return status;
    p->count = 0;
    if (!words_split(p, p->line))
        return fail("stage", "%s: its line `%s` has an open quote, or too many words", p->path,
                    begins);
    return beginning_check(p);
}

/* ---- the gallery ---- */

static int by_name(const void *a, const void *b)
{
    return strcmp(a, b);
}

/* The names of the pieces, in their order. -1: it has been said why there are none. */
static int names_find(char folder[PATH_MAX], char names[PIECES_MAX][NAME_BYTES])
{
    int count = 0;
    DIR *dir = data_find(folder, "../../examples/stage", "stage") ? opendir(folder) : NULL;
    if (!dir) {
        fail("stage", "its pieces are not where this command is; install Lutetia, or run it "
                      "from its build folder");
        return -1;
    }
    for (struct dirent *e; (e = readdir(dir)) && count < PIECES_MAX;) {
        const size_t length = strlen(e->d_name);
        if (length <= 4 || length >= NAME_BYTES || strcmp(e->d_name + length - 4, ".lua") != 0)
            continue;
        memcpy(names[count], e->d_name, length - 4);
        names[count++][length - 4] = '\0';
    }
    closedir(dir);
    qsort(names, (size_t)count, sizeof *names, by_name);
    return count;
}

static int list(void)
{
    char folder[PATH_MAX], names[PIECES_MAX][NAME_BYTES];
    const int count = names_find(folder, names);
    for (int i = 0; i < count; i++) {
        static struct piece p;
        p = (struct piece){0};
        if (snprintf(p.path, sizeof p.path, "%s/%s.lua", folder, names[i]) >= PATH_MAX ||
            piece_read(&p) != EXIT_SUCCESS)
            return EXIT_FAILED;
        printf("%-12s %s\n", names[i], p.about);
    }
    return count < 0 ? EXIT_FAILED : EXIT_SUCCESS;
}

/* A file, or the name of one of the gallery's. */
static int piece_find(const char *name, struct piece *p)
{
    char folder[PATH_MAX], names[PIECES_MAX][NAME_BYTES], known[600] = "";
    const size_t length = strlen(name);
    if (length > 4 && strcmp(name + length - 4, ".lua") == 0) {
        snprintf(p->path, sizeof p->path, "%s", name);
        return piece_read(p);
    }
    const int count = names_find(folder, names);
    for (int i = 0; i < count; i++) {
        if (strcmp(names[i], name) == 0)
            return snprintf(p->path, sizeof p->path, "%s/%s.lua", folder, name) < PATH_MAX
                       ? piece_read(p)
                       : fail("stage", "the path of %.60s is too long", name);
        snprintf(known + strlen(known), sizeof known - strlen(known), "%s%.50s", i ? ", " : "",
                 names[i]);
    }
    return count < 0
               ? EXIT_FAILED
               : fail_usage("stage", "there is no piece '%.60s'; there are %s, or FILE.lua",
                            name, known);
}

static int print(const struct piece *p)
{
    char line[LINE_BYTES];
    const char *why;
    FILE *file = input_file_open(p->path, &why);
    if (!file)
        return fail("stage", "%s: cannot read: %s", p->path, why);
    while (fgets(line, sizeof line, file))
        fputs(line, stdout);
    fclose(file);
    return EXIT_SUCCESS;
}

static bool has_option(int argc, char **argv, const char *name)
{
    const size_t length = strlen(name);
    for (int i = 0; i < argc; i++)
        if (!strncmp(argv[i], name, length) && (!argv[i][length] || argv[i][length] == '='))
            return true;
    return false;
}

/* As `lutetia spring WORDS ... --map PIECE` with what else the command line has. How long the
 * piece lasts is for films alone: a window has no end. */
static int play(struct piece *p, int argc, char **argv)
{
    static char map[] = "--map", settle[] = "--settle", settle_s[32];
    char **line = calloc((size_t)p->count + (size_t)argc + 5, sizeof *line);
    int count = 0;
    double seconds = 5;
    if (!line)
        return fail("stage", "no memory");
    for (int i = 0; i < p->count; i++) {
        if (i < 2 || i % 2 || strcmp(p->words[i], "--seconds") != 0) {
            line[count++] = p->words[i];
            continue;
        }
        char *end;
        seconds = strtod(p->words[++i], &end);
        if (*end || !(seconds >= 0 && seconds <= 3600)) {
            free(line);
            return fail("stage", "%s: --seconds must be 0..3600 (got '%.60s')", p->path,
                        p->words[i]);
        }
    }
    line[count++] = map;
    line[count++] = p->path;
    if (p->loop_s > 0 && has_option(argc, argv, "--loop")) {
        seconds = p->loop_s;
        snprintf(settle_s, sizeof settle_s, "%g", p->settle_s);
        line[count++] = settle; /* one in the command line comes after it, and counts */
        line[count++] = settle_s;
    }
    for (int i = 0; i < argc; i++)
        line[count++] = argv[i];
    const int status = verb_spring_lasting(count, line, seconds);
    free(line);
    return status;
}

int verb_stage(int argc, char **argv)
{
    static struct piece p;
    bool lists = false, prints = false;
    const struct option_row rows[] = {
        {"list", 'l', OPTION_FLAG, NULL, "print the names of the pieces, and end", &lists, 0, 0,
         0},
        {"print", 0, OPTION_FLAG, NULL, "print the piece's script: the start of one's own",
         &prints, 0, 0, 0},
        {0}};
    struct option_words words;
    const int own = options_own(rows, argc, argv);
    if (!options_parse("stage", rows, own, argv, &words))
        return EXIT_USAGE;
    if (words.help)
        return help_print("stage", rows, NULL);
    if (lists)
        return own == argc ? list()
                           : fail_usage("stage", "--list goes alone (got '%.40s')", argv[own]);
    if (own == argc)
        return fail_usage("stage", "a piece, please: `lutetia stage --list` has their names");
    p = (struct piece){0};
    const int status = piece_find(argv[own], &p);
    if (status != EXIT_SUCCESS)
        return status;
    if (prints && own + 1 < argc)
        return fail_usage("stage", "--print goes with a piece alone (got '%.40s')",
                          argv[own + 1]);
    return prints ? print(&p) : play(&p, argc - own - 1, argv + own + 1);
}
