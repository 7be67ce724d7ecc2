/* verb_cc.c - `lutetia cc`: the C compiler, told where C/Paris is.
 *
 * A program of 1990 was compiled by `cc prog.c -lparis`; this adds the two folders, the library, and -std=gnu89
 * unless a -std is given.  In the build tree the library there is taken, else the one this command was installed
 * with.  All other arguments are the compiler's. */
#include "lutetia.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct compiler_line {
    char **arguments;
    int count;
};

static void line_add(struct compiler_line *line, char *argument)
{
    line->arguments[line->count++] = argument;
}

/* prefix/middle/name exists? Owns: the caller frees the folder's name, prefix/middle. */
static char *folder_with(const char *prefix, const char *middle, const char *name)
{
    char *folder, *file;
    if (asprintf(&folder, "%s/%s", prefix, middle) < 0)
        return NULL;
    if (asprintf(&file, "%s/%s", folder, name) < 0) {
        free(folder);
        return NULL;
    }
    bool found = access(file, R_OK) == 0;
    free(file);
    if (found)
        return folder;
    free(folder);
    return NULL;
}

/* The folders of <cm/paris.h> and of libparis, for a command that lies in `home`. */
static bool folders_find(const char *home, char **include, char **library)
{
    static const struct {
        const char *up, *include, *library;
    } layouts[] = {
        {"../..", "paris_compat/include", "paris_compat"}, /* the build tree */
        {"..", "include", LUTETIA_LIBDIR},
        {"..", "include", "lib"},
    };
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        char *prefix;
        if (asprintf(&prefix, "%s/%s", home, layouts[i].up) < 0)
            return false;
        *include = folder_with(prefix, layouts[i].include, "cm/paris.h");
        *library = folder_with(prefix, layouts[i].library, "libparis.so");
        free(prefix);
        if (*include && *library)
            return true;
        free(*include);
        free(*library);
    }
    return false;
}

static bool any_starts_with(int argc, char **argv, const char *start)
{
    for (int i = 1; i < argc; i++)
        if (strncmp(argv[i], start, strlen(start)) == 0)
            return true;
    return false;
}

static bool any_is(int argc, char **argv, const char *argument)
{
    for (int i = 1; i < argc; i++)
        if (strcmp(argv[i], argument) == 0)
            return true;
    return false;
}

int verb_cc(int argc, char **argv)
{
    if (argc < 2 || any_is(argc, argv, "--help") || any_is(argc, argv, "-h")) {
        fputs("usage: lutetia cc prog.c... [-o prog] [options of the C compiler]\n\n"
              "Compiles C/Paris programs and links them with libparis; CC names the compiler "
              "(cc).\n"
              "-std=gnu89 is taken unless a -std is given.\n",
              argc < 2 ? stderr : stdout);
        return argc < 2 ? EXIT_USAGE : EXIT_SUCCESS;
    }
    char home[4096];
    ssize_t length = readlink("/proc/self/exe", home, sizeof home - 1);
    home[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(home, '/');
    if (slash)
        *slash = '\0';
    char *include, *library;
    if (!slash || !folders_find(home, &include, &library))
        return fail("cc",
                    "<cm/paris.h> and libparis.so are not where this command is (%s); "
                    "install Lutetia, or run it from its build folder",
                    home);

    char *include_flag, *library_flag, *runtime_flag;
    struct compiler_line line = {calloc((size_t)argc + 8, sizeof(char *)), 0};
    if (!line.arguments || asprintf(&include_flag, "-I%s", include) < 0 ||
        asprintf(&library_flag, "-L%s", library) < 0 ||
        asprintf(&runtime_flag, "-Wl,-rpath,%s", library) < 0)
        return fail("cc", "no memory");
    char *compiler = getenv("CC");
    static char cc[] = "cc", gnu89[] = "-std=gnu89", paris[] = "-lparis", math[] = "-lm";
    line_add(&line, compiler && *compiler ? compiler : cc);
    if (!any_starts_with(argc, argv, "-std="))
        line_add(&line, gnu89);
    line_add(&line, include_flag);
    for (int i = 1; i < argc; i++)
        line_add(&line, argv[i]);
    if (!any_is(argc, argv, "-c") && !any_is(argc, argv, "-S") && !any_is(argc, argv, "-E")) {
        line_add(&line, library_flag);
        line_add(&line, runtime_flag);
        line_add(&line, paris);
        line_add(&line, math);
    }
    fflush(NULL);
    execvp(line.arguments[0], line.arguments);
    int status = fail("cc", "%s: %s; install a C compiler or name one in CC", line.arguments[0],
                      strerror(errno));
    free(include_flag);
    free(library_flag);
    free(runtime_flag);
    free(include);
    free(library);
    free(line.arguments);
    return status;
}
