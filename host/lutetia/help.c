/* help.c - prints pages as text for readers, and as a table for the manual's generator. */
#include "help.h"
#include "environment.h"
#include "lutetia.h"
#include "pages.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 96, LEFT = 29, NAMES_ROOM = 4000 };

static bool as_table;

void help_as_table(void)
{
    as_table = true;
}

bool help_is_table(void)
{
    return as_table;
}

/* ---- text ---- */

/* Prints words, broken into lines of at most WIDTH; the cursor is in column `at`, and lines
 * begin in column `left`. A newline in the text ends a paragraph. */
static void words_print(FILE *out, const char *text, int at, int left)
{
    while (*text) {
        if (*text == '\n') {
            fprintf(out, "\n%*s", left, "");
            at = left;
            text++;
            continue;
        }
        int length = (int)strcspn(text, " \n");
        if (at > left && at + 1 + length > WIDTH) {
            fprintf(out, "\n%*s", left, "");
            at = left;
        } else if (at > left) {
            fputc(' ', out);
            at++;
        }
        fprintf(out, "%.*s", length, text);
        at += length;
        text += length;
        text += *text == ' ';
    }
    fputc('\n', out);
}

static void row_print(FILE *out, int room, const char *left, const char *help)
{
    int used = fprintf(out, "  %-*s ", room, left); /* a long left part pushes the text on */
    words_print(out, help, used > room + 3 ? used : room + 3, room + 3);
}

static void commands_print(FILE *out, const struct help_command *commands)
{
    for (const struct help_command *c = commands; c && c->name; c++) {
        char left[64];
        snprintf(left, sizeof left, "%s %s", c->name, c->arguments);
        row_print(out, 34, left, c->help);
    }
}

void help_usage(FILE *out, const char *verb, const struct help_command *commands)
{
    const struct page *page = page_of(verb);
    const char *before = "usage:";
    for (const char *at = page->usages; *at; before = "      ") {
        int length = (int)strcspn(at, "\n");
        fprintf(out, "%s lutetia %s%s%.*s\n", before, verb, length ? " " : "", length, at);
        at += length + (at[length] == '\n');
    }
    if (!*page->usages)
        fprintf(out, "usage: lutetia %s\n", verb);
    fputc('\n', out);
    commands_print(out, commands);
}

static void options_print(const struct option_row *rows)
{
    for (const struct option_row *row = rows; row && row->name; row++) {
        char left[64];
        snprintf(left, sizeof left, row->letter ? "-%c, --%s %s" : "%c--%s %s",
                 row->letter ? row->letter : ' ', row->name, row->value ? row->value : "");
        row_print(stdout, 26, left + (row->letter ? 0 : 1), row->help);
    }
    row_print(stdout, 26, "-h, --help", "this text");
}

/* ---- values that an option takes ---- */

/* The words as "one, two"; NAMES_ROOM bytes. */
static const char *values_text(const struct page_value *value, char *text)
{
    text[0] = '\0';
    if (value->fill)
        value->fill(text, NAMES_ROOM);
    else if (value->list)
        for (const char *const *name = value->list(); *name; name++) {
            size_t used = strlen(text);
            snprintf(text + used, NAMES_ROOM - used, "%s%s", used ? ", " : "", *name);
        }
    else
        snprintf(text, NAMES_ROOM, "%s", value->words);
    return text;
}

static void values_print(const struct page *page)
{
    char text[NAMES_ROOM];
    for (const struct page_value *value = page->values; value->option; value++) {
        if (!value->fill && !value->list) /* the option's own help says them */
            continue;
        printf("\n--%s:", value->option);
        words_print(stdout, values_text(value, text), (int)strlen(value->option) + 3, 0);
    }
}

/* ---- the table ---- */

static void fact(const char *kind, const char *text)
{
    for (const char *at = text; *at;) {
        int length = (int)strcspn(at, "\n");
        if (length)
            printf("%s\t%.*s\n", kind, length, at);
        at += length + (at[length] == '\n');
    }
}

static const char *kind_name(enum option_kind kind)
{
    switch (kind) {
    case OPTION_FLAG:
        return "flag";
    case OPTION_TEXT:
        return "text";
    case OPTION_PNG:
        return "png";
    case OPTION_INTEGER:
        return "integer";
    case OPTION_NUMBER:
        return "number";
    case OPTION_NUMBERS:
        return "numbers";
    case OPTION_SIZE:
        return "size";
    case OPTION_LIST:
        return "list";
    case OPTION_TEXTS:
        return "texts";
    }
    return "";
}

static void page_table(const struct page *page, const struct option_row *rows,
                       const struct help_command *commands)
{
    char text[NAMES_ROOM];
    if (!*page->usages)
        puts("usage\t");
    fact("usage", page->usages);
    fact("about", page->about);
    for (const struct help_command *c = commands; c && c->name; c++)
        printf("command\t%s\t%s\t%s\n", c->name, c->arguments, c->help);
    for (const struct option_row *row = rows; row && row->name; row++)
        printf("option\t%s\t%.1s\t%s\t%s\t%.10g\t%.10g\t%s\n", row->name,
               row->letter ? &row->letter : "", kind_name(row->kind),
               row->value ? row->value : "", row->least, row->most, row->help);
    for (const struct page_value *value = page->values; value->option; value++)
        printf("values\t%s\t%s\t%s\n", value->option, value->suffix ? value->suffix : "",
               values_text(value, text));
    fact("notes", page->notes ? page->notes : "");
    for (const struct page_example *e = page->examples; e->command; e++)
        printf("example\t%s\t%s\n", e->command, e->does);
    fact("file", page->files ? page->files : "");
    fact("see", page->see);
}

/* ---- a page ---- */

int help_print(const char *verb, const struct option_row *rows,
               const struct help_command *commands)
{
    const struct page *page = page_of(verb);
    if (as_table) {
        page_table(page, rows, commands);
        return EXIT_SUCCESS;
    }
    help_usage(stdout, verb, NULL);
    words_print(stdout, page->about, 0, 0);
    putchar('\n');
    commands_print(stdout, commands);
    if (commands)
        putchar('\n');
    if (rows)
        options_print(rows);
    values_print(page);
    if (page->notes) {
        putchar('\n');
        words_print(stdout, page->notes, 0, 0);
    }
    puts("\nExamples:");
    for (const struct page_example *e = page->examples; e->command; e++)
        printf("  %s\n", e->command);
    printf("\nMore: `man lutetia-%s`.\n", verb);
    return EXIT_SUCCESS;
}

void help_environment(void)
{
    static const struct {
        int status;
        const char *means;
    } exits[] = {{0, "All went well."},
                 {EXIT_FAILED,
                  "Something failed; one line on the standard error says what, "
                  "with what, and what to do. Files that were there are as they were."},
                 {EXIT_USAGE, "The command line is wrong; nothing was done."},
                 {EXIT_INTERRUPTED, "Ctrl-C or SIGTERM ended it."}};
    for (size_t i = 0; as_table && i < sizeof exits / sizeof *exits; i++)
        printf("exit\t%d\t%s\n", exits[i].status, exits[i].means);
    for (const struct environment_row *row = environment_rows; row->name; row++)
        if (as_table)
            printf("environment\t%s\t%s\t%s\t%s\n", row->name, row->value,
                   environment_group_name(row->group), row->does);
        else {
            char left[64];
            snprintf(left, sizeof left, "%s=%s", row->name, row->value);
            row_print(stdout, 30, left, row->does);
        }
}
