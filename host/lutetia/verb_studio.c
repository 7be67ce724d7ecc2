/* verb_studio.c - `lutetia studio`: checks the words, and runs the window, which is a program
 * of its own (desk/desk_main.c): so no other verb loads GTK. */
#include "help.h"
#include "lutetia.h"
#include "options.h"

#include <input_file.h>
#include <program.h>
#include <sheet.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { STUDIO_SIDE_MIN = 64, STUDIO_SIDE_MAX = 4096, WORDS_MAX = 16 + PAPER_PIGMENTS_MAX };

static void here(void)
{
}

struct studio {
    const char *stock, *theme, *play;
    struct option_texts pigments;
    int size[2], seed;
    bool fresh; /* a new sheet is described */
};

/* The words of the window's program. */
struct line {
    char text[WORDS_MAX][4200];
    char *words[WORDS_MAX + 2];
    int count;
};

static void word_add(struct line *line, const char *name, const char *value)
{
    char *word = line->text[line->count];
    snprintf(word, sizeof line->text[0], "%s=%s", name, value);
    line->words[++line->count] = word;
}

static void number_add(struct line *line, const char *name, int value)
{
    char text[16];
    snprintf(text, sizeof text, "%d", value);
    word_add(line, name, text);
}

static int names_check(const struct studio *s)
{
    char known[PAPER_PIGMENT_NAMES_ROOM];
    if (!paper_stock_find(s->stock)) {
        paper_stock_names(known, sizeof known);
        return fail_usage("studio", "there is no paper '%.40s'; there are %s", s->stock, known);
    }
    if (s->pigments.count > PAPER_PIGMENTS_MAX)
        return fail_usage("studio", "a sheet has up to %d pigments (got %d)",
                          PAPER_PIGMENTS_MAX, s->pigments.count);
    for (int i = 0; i < s->pigments.count; i++)
        if (!paper_pigment_find(s->pigments.texts[i])) {
            paper_pigment_names(known, sizeof known);
            return fail_usage("studio", "there is no pigment '%.40s'; there are %s",
                              s->pigments.texts[i], known);
        }
    if (s->theme && strcmp(s->theme, "light") != 0 && strcmp(s->theme, "dark") != 0)
        return fail_usage("studio", "--theme must be light or dark (got '%.40s')", s->theme);
    return EXIT_SUCCESS;
}

/* What cannot be read is said before a window opens. */
static int file_check(const char *path)
{
    const char *why;
    if (strlen(path) > 4096)
        return fail("studio", "%.60s...: a name of more than 4096 bytes", path);
    FILE *file = input_file_open(path, &why);
    if (!file)
        return fail("studio", "%s: cannot read: %s", path, why);
    fclose(file);
    return EXIT_SUCCESS;
}

static void line_fill(struct line *line, const struct studio *s, const char *path)
{
    static const char *const usual[] = {PAPER_PIGMENT_USUAL, "quinacridone rose",
                                        "hansa yellow"};
    if (path)
        word_add(line, "file", path);
    if (s->play)
        word_add(line, "play", s->play);
    number_add(line, "width", s->size[0]);
    number_add(line, "height", s->size[1]);
    number_add(line, "seed", s->seed);
    word_add(line, "stock", s->stock);
    for (int i = 0; i < s->pigments.count; i++)
        word_add(line, "pigment", s->pigments.texts[i]);
    for (size_t i = 0; i < sizeof usual / sizeof *usual && s->pigments.count == 0; i++)
        word_add(line, "pigment", usual[i]);
    if (s->theme)
        word_add(line, "theme", s->theme);
    if (s->fresh)
        word_add(line, "fresh", "1");
}

static int window_run(struct line *line)
{
    char path[PATH_MAX];
    if (!program_find(path, here, LUTETIA_LIBEXECDIR "/lutetia/lutetia-studio",
                      "desk/lutetia-studio"))
        return fail(
            "studio",
            "the window's program, which needs GTK 4, is not here; it is in the package "
            "lutetia-studio, and `./run studio` builds and starts it");
    line->words[0] = path;
    execv(path, line->words);
    return fail("studio", "%s cannot be run: %s", path, strerror(errno));
}

int verb_studio(int argc, char **argv)
{
    struct studio s = {.stock = "cold press", .size = {768, 576}, .seed = 1};
    const struct option_row rows[] = {
        {"paper", 0, OPTION_SIZE, "WxH", "size of a new sheet in fibers (768x576)", s.size,
         STUDIO_SIDE_MIN, STUDIO_SIDE_MAX, 0},
        {"stock", 0, OPTION_TEXT, "NAME", "its paper (cold press)", &s.stock, 0, 0, 0},
        {"pigment", 0, OPTION_TEXTS, "NAME",
         "a pigment that the sheet has, up to 16; each makes its steps take longer (french "
         "ultramarine, quinacridone rose, hansa yellow)",
         &s.pigments, 0, 0, 0},
        {"seed", 0, OPTION_INTEGER, "N", "another sheet of the same paper (1)", &s.seed, 0,
         2147483647, 0},
        {"theme", 0, OPTION_TEXT, "NAME", "light or dark (as the desktop is)", &s.theme, 0, 0,
         0},
        {"play", 0, OPTION_TEXT, "FILE",
         "recorded input in place of a hand: lines of docs/studio.md", &s.play, 0, 0, 0},
        {0}};
    struct option_words words;
    if (!options_parse("studio", rows, argc, argv, &words))
        return EXIT_USAGE;
    if (words.help)
        return help_print("studio", rows, NULL);
    if (words.count > 1)
        return fail_usage("studio", "one sheet at a time (after it came '%.60s')",
                          words.words[1]);
    for (size_t i = 0; i < 4; i++) /* --paper, --stock, --pigment, --seed */
        s.fresh = s.fresh || words.given[i];
    int status = names_check(&s);
    if (status == EXIT_SUCCESS && words.count)
        status = file_check(words.words[0]);
    if (status == EXIT_SUCCESS && s.play)
        status = file_check(s.play);
    if (status != EXIT_SUCCESS)
        return status;
    struct line *line = calloc(1, sizeof *line);
    if (!line)
        return fail("studio", "no memory");
    line_fill(line, &s, words.count ? words.words[0] : NULL);
    status = window_run(line);
    free(line);
    return status;
}
