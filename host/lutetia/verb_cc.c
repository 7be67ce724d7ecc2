/* verb_cc.c - `lutetia cc`: calls the C compiler, or the C++ compiler, with the paths of
 * C/Paris.
 *
 * A program of 1990 was compiled by `cc prog.c -lparis`; this adds the two folders, the
 * library, and -std=gnu89 unless a -std is given.  A command in the build tree uses the library
 * there; an installed one uses the library installed with it. All other arguments are passed to
 * the compiler.
 *
 * -g1 is taken unless the arguments choose debug information: the library's complaints then
 * begin with the source's line (paris_compat/call_line.c). In gnu89 a function without
 * declaration returns an int, so a program without <cm/paris.h> would read 0 where the machine
 * returns a double; the compiler warns of each.
 *
 * If a source is C++, which its name's end or an -x says, the C++ compiler is called, without
 * -std=gnu89. It takes all sources for C++, so sources of C beside it are told to be C.
 *
 * A program is linked into a part file, which is renamed when it is complete, because
 * linkers overwrite an existing file. The linker's output is the part file's descriptor,
 * /proc/self/fd/N: the linker obeys its last -o. The compiler still knows the program's name,
 * from which it derives the names of other files (dependencies, profiles, ...). If the
 * compiler does not link, or its arguments are in a file, it runs without a part file.
 */
#include "help.h"
#include "lutetia.h"

#include <input_file.h>
#include <output_file.h>

#include <elf.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

struct compiler_line {
    char **arguments;
    int count;
    bool cpp;    /* of the C++ compiler */
    char *words; /* its name, in which the first arguments are */
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

/* Finds the folders of <cm/paris.h> and of libparis, for a command in the folder `home`. */
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

/* ---- C or C++ ---- */

static bool ends_in(const char *name, const char *const ends[])
{
    const char *dot = strrchr(name, '.');
    for (int i = 0; dot && ends[i]; i++)
        if (strcmp(dot, ends[i]) == 0)
            return true;
    return false;
}

static bool is_cpp(const char *argument)
{
    static const char *const ends[] = {".cc",  ".cp", ".cxx", ".cpp", ".CPP",
                                       ".c++", ".C",  ".ii",  NULL};
    return argument[0] != '-' && ends_in(argument, ends);
}

/* Whether the option before says what this argument is: it is no source. */
static bool is_operand(char **argv, int i)
{
    static const char *const takes[] = {"-o",       "--output", "-x",      "-I",       "-L",
                                        "-include", "-isystem", "-MF",     "-MT",      "-MQ",
                                        "-Xlinker", "-T",       "-iquote", "-imacros", NULL};
    for (int k = 0; i > 1 && takes[k]; k++)
        if (strcmp(argv[i - 1], takes[k]) == 0)
            return true;
    return false;
}

static bool any_cpp(int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        if ((is_cpp(argv[i]) && !is_operand(argv, i)) || strcmp(argv[i], "-xc++") == 0 ||
            (strcmp(argv[i], "c++") == 0 && i > 1 && strcmp(argv[i - 1], "-x") == 0))
            return true;
    return false;
}

/* What the variables name, or the usual compiler. */
static const char *compiler_of(bool cpp)
{
    const char *named = getenv(cpp ? "CXX" : "CC");
    return named && named[strspn(named, " ")] ? named : cpp ? "c++" : "cc";
}

/* Adds the compiler: the program of that name, or words as make takes them ("ccache gcc").
 * False: no memory. */
static bool compiler_add(struct compiler_line *line, const char *named)
{
    char *rest;
    line->words = strdup(named);
    if (!line->words)
        return false;
    if (access(named, X_OK) == 0) {
        line_add(line, line->words);
        return true;
    }
    for (char *word = strtok_r(line->words, " ", &rest); word;
         word = strtok_r(NULL, " ", &rest))
        line_add(line, word);
    return true;
}

/* Adds the program's arguments. Sources of C beside C++ stay C, unless an -x says what all are;
 * the files behind them are by their names again. */
static void sources_add(struct compiler_line *line, int argc, char **argv, bool cpp)
{
    static const char *const ends[] = {".c", NULL};
    static char language[] = "-xc", by_name[] = "-xnone";
    const bool marks = cpp && !any_starts_with(argc, argv, "-x");
    bool marked = false;
    for (int i = 1; i < argc; i++) {
        const bool file = argv[i][0] != '-' && !is_operand(argv, i);
        const bool c = file && ends_in(argv[i], ends);
        if (marks && file && c != marked) {
            line_add(line, c ? language : by_name);
            marked = c;
        }
        line_add(line, argv[i]);
    }
}

/* ---- the program, whole under its name ---- */

/* The program's name: behind "-o" or "--output", or in one word with it, as "-oNAME" and
 * "--output=NAME"; the last one counts. NULL: none. */
static const char *output_find(const struct compiler_line *line)
{
    static const char word[] = "--output";
    const char *found = NULL;
    for (int i = 1; i < line->count; i++) {
        const char *one = line->arguments[i];
        const bool alone = strcmp(one, "-o") == 0 || strcmp(one, word) == 0;
        if (alone && i + 1 < line->count)
            found = line->arguments[++i];
        else if (strncmp(one, word, sizeof word - 1) == 0 && one[sizeof word - 1] == '=')
            found = one + sizeof word;
        else if (strncmp(one, "-o", 2) == 0 && one[2])
            found = one + 2;
    }
    return found;
}

_Noreturn static void compiler_become(const struct compiler_line *line)
{
    execvp(line->arguments[0], line->arguments);
    fail("cc", "%s: %s; install a %s compiler or name one in %s", line->arguments[0],
         strerror(errno), line->cpp ? "C++" : "C", line->cpp ? "CXX" : "CC");
    _exit(EXIT_FAILED);
}

/* Runs the compiler and returns its exit status. Ctrl-C interrupts the compiler; this
 * process waits for it. */
static int compiler_run(const struct compiler_line *line)
{
    int status = 0;
    struct sigaction ignore = {.sa_handler = SIG_IGN}, before[2];
    sigaction(SIGINT, &ignore, &before[0]);
    sigaction(SIGQUIT, &ignore, &before[1]);
    pid_t pid = fork();
    if (pid == 0) {
        sigaction(SIGINT, &before[0], NULL);
        sigaction(SIGQUIT, &before[1], NULL);
        compiler_become(line);
    }
    if (pid < 0)
        return fail("cc", "cannot start %s: %s", line->arguments[0], strerror(errno));
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR)
        ;
    sigaction(SIGINT, &before[0], NULL);
    sigaction(SIGQUIT, &before[1], NULL);
    if (WIFSIGNALED(status))
        return fail("cc", "%s: ended by signal %d (%s)", line->arguments[0], WTERMSIG(status),
                    strsignal(WTERMSIG(status)));
    return WEXITSTATUS(status);
}

/* Linkers do not always notice a full disk. Checks that the file contains all that its ELF
 * header lists. */
static bool program_whole(int program)
{
    struct stat made;
    Elf64_Ehdr head;
    if (fstat(program, &made) != 0 || made.st_size == 0)
        return false;
    if (pread(program, &head, sizeof head, 0) != (ssize_t)sizeof head ||
        memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_ident[EI_CLASS] != ELFCLASS64)
        return true; /* of an unknown kind */
    uint64_t size = (uint64_t)made.st_size;
    if (head.e_shoff > size ||
        (uint64_t)head.e_shnum * sizeof(Elf64_Shdr) > size - head.e_shoff)
        return false;
    for (int i = 0; i < head.e_shnum; i++) {
        Elf64_Shdr section;
        off_t at = (off_t)(head.e_shoff + (uint64_t)i * sizeof section);
        if (pread(program, &section, sizeof section, at) != (ssize_t)sizeof section ||
            (section.sh_type != SHT_NOBITS &&
             (section.sh_offset > size || section.sh_size > size - section.sh_offset)))
            return false;
    }
    return true;
}

/* clang removes the program's name when the linker fails. So a copy of the program that is
 * there is kept meanwhile, in a part file too. Returns false if the copy cannot be made. */
static bool former_keep(struct output_file *former, const char *name)
{
    char buffer[1 << 16];
    struct stat status;
    *former = (struct output_file){0};
    FILE *program = input_file_open(name, NULL);
    if (!program)
        return true; /* nothing is there, or nothing that this user can read */
    bool kept = output_file_open(former, name);
    for (size_t n; kept && (n = fread(buffer, 1, sizeof buffer, program)) > 0;)
        kept = fwrite(buffer, 1, n, former->stream) == n;
    kept = kept && !ferror(program) && fflush(former->stream) == 0 &&
           fstat(fileno(program), &status) == 0 &&
           fchmod(fileno(former->stream), status.st_mode & 0777) == 0;
    fclose(program);
    if (!kept)
        output_file_abandon(former);
    return kept;
}

/* The program's name after a failure: what had the name before has it again. */
static void former_return(struct output_file *former, const char *name)
{
    if (former->stream && access(name, F_OK) != 0)
        output_file_commit(former);
    else
        output_file_abandon(former);
}

/* Runs the line with the linker's output in the descriptor. Returns the exit status. */
static int program_make(struct compiler_line *line, int program, const char *name)
{
    char output[60];
    if (program < 0)
        return fail("cc", "%s: cannot write: %s", name, strerror(errno));
    snprintf(output, sizeof output, "-Wl,-o,/proc/self/fd/%d", program);
    line_add(line, output);
    int status = compiler_run(line);
    if (status == EXIT_SUCCESS && !program_whole(program))
        return fail("cc", "%s: %s has not written it whole; see that there is room on the disk",
                    name, line->arguments[0]);
    return status;
}

static int program_link(struct compiler_line *line)
{
    const char *asked = output_find(line), *name = asked ? asked : "a.out";
    struct output_file out, former;
    if (!output_file_open(&out, name))
        return fail("cc", "%s: cannot write: %s", name, out.why);
    if (!former_keep(&former, name)) {
        output_file_abandon(&out);
        return fail("cc", "%s: cannot keep the program that is there: %s", name,
                    former.why ? former.why : "it cannot be copied; see that there is room");
    }
    int program = dup(fileno(out.stream)); /* a descriptor that the compiler inherits */
    fflush(NULL);
    int status = program_make(line, program, name);
    mode_t mask = umask(0);
    umask(mask);
    if (program >= 0)
        close(program);
    if (status == EXIT_SUCCESS) {
        fchmod(fileno(out.stream), 0777 & ~mask);
        if (output_file_commit(&out)) {
            output_file_abandon(&former);
            return EXIT_SUCCESS;
        }
        status = fail("cc", "%s: cannot write: %s", name, out.why);
    }
    output_file_abandon(&out);
    former_return(&former, name);
    return status;
}

/* Do the arguments make a program? */
static bool line_links(int argc, char **argv)
{
    return !any_is(argc, argv, "-c") && !any_is(argc, argv, "-S") &&
           !any_is(argc, argv, "-E") && !any_is(argc, argv, "-fsyntax-only") &&
           !any_is(argc, argv, "-M") && !any_is(argc, argv, "-MM") &&
           !any_is(argc, argv, "-###") && !any_is(argc, argv, "-v") &&
           !any_starts_with(argc, argv, "--version") &&
           !any_starts_with(argc, argv, "-print") && !any_starts_with(argc, argv, "-dump");
}

/* Refuses options that no program on libparis can be linked with. */
static int impossible_refuse(int argc, char **argv)
{
    static const char shared[] = "libparis is a shared library, since OpenCL loads its driver "
                                 "while the program runs",
                      wide[] = "libparis and the OpenCL driver are made for 64 bits";
    static const struct {
        const char *option, *why;
    } refused[] = {
        {"-static", shared}, {"--static", shared}, {"-static-pie", shared},
        {"-m32", wide},      {"-mx32", wide},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++)
        if (any_is(argc, argv, refused[i].option))
            return fail("cc", "%s cannot be done: %s; leave it out", refused[i].option,
                        refused[i].why);
    return EXIT_SUCCESS;
}

/* Refuses sources and objects that are pipes, devices or folders: compilers wait for them. What
 * is missing they tell themselves. */
static int others_refuse(int argc, char **argv)
{
    static const char *const ends[] = {".c",   ".i", ".s", ".S", ".cc",
                                       ".cpp", ".o", ".a", ".so"};
    for (int i = 1; i < argc; i++) {
        struct stat status;
        const char *end = strrchr(argv[i], '.');
        bool file = false;
        for (size_t k = 0; end && k < sizeof ends / sizeof *ends; k++)
            file = file || strcmp(end, ends[k]) == 0;
        if (file && argv[i][0] != '-' && strcmp(argv[i - 1], "-o") != 0 &&
            stat(argv[i], &status) == 0 && !S_ISREG(status.st_mode))
            return fail("cc", "%s: cannot read: Is not a regular file; name a file", argv[i]);
    }
    return EXIT_SUCCESS;
}

int verb_cc(int argc, char **argv)
{
    if (argc < 2) {
        help_usage(stderr, "cc", NULL);
        return EXIT_USAGE;
    }
    if (any_is(argc, argv, "--help") || any_is(argc, argv, "-h"))
        return help_print("cc", NULL, NULL);
    int status = impossible_refuse(argc, argv);
    if (status == EXIT_SUCCESS)
        status = others_refuse(argc, argv);
    if (status != EXIT_SUCCESS)
        return status;
    char home[4096];
    ssize_t length = readlink("/proc/self/exe", home, sizeof home - 1);
    home[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(home, '/');
    if (slash)
        *slash = '\0';
    char *include = NULL, *library = NULL;
    if (!slash || !folders_find(home, &include, &library))
        return fail("cc",
                    "<cm/paris.h> and libparis.so are not where this command is (%s); "
                    "install Lutetia, or run it from its build folder",
                    home);

    char *include_flag, *library_flag, *runtime_flag;
    const bool cpp = any_cpp(argc, argv);
    const char *compiler = compiler_of(cpp);
    struct compiler_line line = {
        calloc(3 * (size_t)argc + strlen(compiler) / 2 + 14, sizeof(char *)), 0, cpp, NULL};
    if (!line.arguments || !compiler_add(&line, compiler) ||
        asprintf(&include_flag, "-I%s", include) < 0 ||
        asprintf(&library_flag, "-L%s", library) < 0 ||
        asprintf(&runtime_flag, "-Wl,-rpath,%s", library) < 0)
        return fail("cc", "no memory");
    static char gnu89[] = "-std=gnu89", paris[] = "-lparis", math[] = "-lm";
    static char lines[] = "-g1", undeclared[] = "-Wimplicit-function-declaration";
    if (!cpp && !any_starts_with(argc, argv, "-std=")) {
        line_add(&line, gnu89);
        line_add(&line, undeclared);
    }
    if (!any_starts_with(argc, argv, "-g"))
        line_add(&line, lines);
    line_add(&line, include_flag);
    sources_add(&line, argc, argv, cpp);
    bool links = line_links(argc, argv);
    if (links) {
        line_add(&line, library_flag);
        line_add(&line, runtime_flag);
        line_add(&line, paris);
        line_add(&line, math);
    }
    fflush(NULL);
    if (!links || any_starts_with(argc, argv, "@"))
        compiler_become(&line);
    status = program_link(&line);
    free(include_flag);
    free(library_flag);
    free(runtime_flag);
    free(include);
    free(library);
    free(line.arguments);
    free(line.words);
    return status;
}
