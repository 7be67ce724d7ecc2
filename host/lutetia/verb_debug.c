/* verb_debug.c - `lutetia debug`: gdb, which knows fields.
 *
 * The command becomes gdb, with the program and its arguments. gdb reads debug/start.py, whose
 * commands ask the program's libparis (paris_compat/debug.h).
 */
#include "help.h"
#include "lutetia.h"
#include "options.h"

#include <input_file.h>

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What gdb is called with. */
struct debugger_line {
    char **arguments;
    int count;
};

static void line_add(struct debugger_line *line, const char *argument)
{
    line->arguments[line->count++] = strdup(argument);
}

_Noreturn static void become(struct debugger_line *line)
{
    fflush(NULL);
    execvp("gdb", line->arguments);
    fail("debug", errno == ENOENT ? "gdb is not installed (on Debian: apt-get install gdb)"
                                  : "gdb cannot be run");
    exit(EXIT_FAILED);
}

/* The program's file: itself, or in a folder of PATH. Owns: the caller frees it. */
static char *program_path(const char *program)
{
    char *path = NULL, *folders = getenv("PATH"), *rest = NULL;
    if (strchr(program, '/') || access(program, F_OK) == 0)
        return asprintf(&path, "%s%s", strchr(program, '/') ? "" : "./", program) < 0 ? NULL
                                                                                      : path;
    folders = strdup(folders ? folders : "");
    for (char *f = folders ? strtok_r(folders, ":", &rest) : NULL; f;
         f = strtok_r(NULL, ":", &rest)) {
        if (asprintf(&path, "%s/%s", f, program) < 0)
            break;
        if (access(path, X_OK) == 0) {
            free(folders);
            return path;
        }
        free(path);
    }
    free(folders);
    return strdup(program);
}

/* A file that can be read, and run if it is the program. EXIT_SUCCESS, or prints why not. */
static int file_check(const char *name, bool runs)
{
    const char *why;
    const int found = input_file_descriptor(name, &why);
    if (found < 0)
        return fail("debug", "%s: cannot read: %s", name, why);
    close(found);
    if (runs && access(name, X_OK) != 0)
        return fail("debug", "%s: cannot run: %s; name a program (lutetia cc -g makes one)",
                    name, strerror(errno));
    return EXIT_SUCCESS;
}

static int debug(const struct option_texts *executed, const char *file, bool batch,
                 const char *path, char **program, int program_count)
{
    char start[PATH_MAX];
    if (!data_find(start, "debug/start.py", "debug/start.py"))
        return fail("debug",
                    "its commands for gdb (debug/start.py) are not where this command is; "
                    "install Lutetia, or run it from its build folder");
    struct debugger_line line = {
        calloc(16 + 2 * (size_t)executed->count + (size_t)program_count, sizeof(char *)), 0};
    if (!line.arguments)
        return fail("debug", "no memory");
    line_add(&line, "gdb");
    line_add(&line, "-q");
    if (batch)
        line_add(&line, "-batch");
    line_add(&line, "-x");
    line_add(&line, start);
    if (file) {
        line_add(&line, "-x");
        line_add(&line, file);
    }
    for (int i = 0; i < executed->count; i++) {
        line_add(&line, "-ex");
        line_add(&line, executed->texts[i]);
    }
    line_add(&line, "--args");
    line_add(&line, path);
    for (int i = 1; i < program_count; i++)
        line_add(&line, program[i]);
    become(&line);
}

int verb_debug(int argc, char **argv)
{
    struct option_texts executed = {.count = 0};
    const char *file = NULL;
    bool batch = false;
    const struct option_row rows[] = {
        {"execute", 'e', OPTION_TEXTS, "COMMAND", "give gdb this command; again for more",
         &executed, 0, 0, 0},
        {"commands", 'x', OPTION_TEXT, "FILE", "give gdb the commands of a file, before these",
         &file, 0, 0, 0},
        {"batch", 0, OPTION_FLAG, NULL, "end when the commands have been given", &batch, 0, 0,
         0},
        {0}};
    struct option_words words;
    int own = options_own(rows, argc, argv);
    if (own < argc && strcmp(argv[own], "--") == 0)
        own++;
    if (!options_parse("debug", rows, own, argv, &words))
        return EXIT_USAGE;
    if (words.help)
        return help_print("debug", rows, NULL);
    if (own == argc)
        return fail_usage("debug", "no program; `lutetia cc -g prog.c -o prog` makes one, and "
                                   "`lutetia debug prog` runs it in gdb");
    char *path = program_path(argv[own]);
    if (!path)
        return fail("debug", "no memory");
    int status = file ? file_check(file, false) : EXIT_SUCCESS;
    if (status == EXIT_SUCCESS)
        status = file_check(path, true);
    if (status == EXIT_SUCCESS)
        status = debug(&executed, file, batch, path, argv + own, argc - own);
    free(path);
    return status;
}
