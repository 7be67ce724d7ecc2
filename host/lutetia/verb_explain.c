/* verb_explain.c - `lutetia explain`: runs a program, and prints what its Connection Machine
 * did and why.
 *
 * The program is a process of its own. When it ends, its libparis writes the facts to the
 * files named by LUTETIA_EXPLAIN (text) and LUTETIA_EXPLAIN_JSON. The files are in a folder
 * of ours; then they are printed, or moved to their place. A C file is compiled as by
 * `lutetia cc` first, into the same folder.
 */
#include "help.h"
#include "lutetia.h"
#include "options.h"

#include <input_file.h>
#include <output_file.h>
#include <user_folder.h>
#include <visible_text.h>

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FOLDER_BYTES = 512, PATH_BYTES = FOLDER_BYTES + 32 };

struct explain {
    const char *json;
    char folder[FOLDER_BYTES], text_path[PATH_BYTES], json_path[PATH_BYTES],
        program_path[PATH_BYTES];
};

static bool folder_open(struct explain *e)
{
    if (!user_folder_temporary("explain", e->folder, sizeof e->folder)) {
        fail("explain", "%s: cannot make a folder there: %s; name another one in TMPDIR",
             e->folder, strerror(errno));
        return false;
    }
    snprintf(e->text_path, sizeof e->text_path, "%s/explain.txt", e->folder);
    snprintf(e->json_path, sizeof e->json_path, "%s/explain.json", e->folder);
    snprintf(e->program_path, sizeof e->program_path, "%s/program", e->folder);
    return true;
}

static void folder_close(const struct explain *e)
{
    unlink(e->text_path);
    unlink(e->json_path);
    unlink(e->program_path);
    rmdir(e->folder);
}

/* Waits for the child and returns its status. Ctrl-C on the terminal is for the child to
 * handle. */
static volatile sig_atomic_t ended_by, child_now;

/* SIGTERM and SIGHUP are passed on, so that the child ends, and the folder is removed. */
static void pass_on(int number)
{
    ended_by = number;
    if (child_now)
        kill((pid_t)child_now, number);
}

/* Who reads the report may end first, as `grep -q` does: nothing is left then, either. */
static const struct explain *open_now;

static void pipe_ended(int number)
{
    folder_close(open_now);
    signal(number, SIG_DFL);
    raise(number);
}

static void ends_pass_on(bool on)
{
    static const int numbers[] = {SIGTERM, SIGHUP};
    struct sigaction ours = {.sa_handler = on ? pass_on : SIG_DFL, .sa_flags = SA_RESTART}, now;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (sigaction(numbers[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN) /* nohup */
            sigaction(numbers[i], &ours, NULL);
}

static int child_wait(pid_t child)
{
    int status = 0;
    child_now = (sig_atomic_t)child;
    if (ended_by)
        kill(child, ended_by);
    while (waitpid(child, &status, 0) != child)
        ;
    child_now = 0;
    return status;
}

/* A child that was ended before it could act, as by SIGKILL or by two signals at once (the
 * driver's compiler catches only the first), leaves part files in the folder. */
static void parts_sweep(const struct explain *e)
{
    const int folder = input_folder_descriptor(AT_FDCWD, e->folder);
    if (folder < 0)
        return;
    output_file_sweep(folder);
    close(folder);
}

static bool is_source(const char *name)
{
    size_t length = strlen(name);
    return length > 2 && strcmp(name + length - 2, ".c") == 0;
}

static int compile(const struct explain *e, const char *source)
{
    const char *why;
    const int found = input_file_descriptor(source, &why);
    if (found < 0)
        return fail("explain", "%s: cannot read: %s", source, why);
    close(found);
    fflush(NULL);
    pid_t child = fork();
    if (child < 0)
        return fail("explain", "no process: %s", strerror(errno));
    if (child == 0) {
        ends_pass_on(false);
        char *line[] = {strdup("cc"), strdup(source),          strdup("-O2"),
                        strdup("-o"), strdup(e->program_path), NULL};
        _exit(verb_cc(5, line));
    }
    int status = child_wait(child);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return EXIT_SUCCESS;
    return fail("explain", "%s: does not compile (`lutetia cc %s` says the same)", source,
                source);
}

_Noreturn static void become(const struct explain *e, const char *program, char **arguments)
{
    signal(SIGINT, SIG_DFL);
    ends_pass_on(false);
    setenv("LUTETIA_EXPLAIN", e->text_path, 1);
    setenv("LUTETIA_EXPLAIN_JSON", e->json_path, 1);
    /* A program in the current folder needs no ./ before its name. */
    char *here;
    if (!strchr(program, '/') && access(program, X_OK) == 0 &&
        asprintf(&here, "./%s", program) > 0)
        execv(here, arguments);
    execvp(program, arguments);
    int error = errno;
    if (error == ENOENT && access(program, F_OK) == 0) /* it is here, and cannot be run */
        error = EACCES;
    fail("explain", "%s: cannot run: %s; name a program (lutetia cc makes one) or a .c file",
         program, strerror(error));
    _exit(126);
}

/* Appends one file to another; out NULL: to the standard output. */
static int pour(const char *from, const char *out)
{
    char bytes[1 << 14];
    size_t count;
    struct output_file file = {0};
    FILE *in = input_file_open(from, NULL), *to = stdout;
    if (out)
        to = output_file_open(&file, out) ? file.stream : NULL;
    errno = 0;
    while (in && to && (count = fread(bytes, 1, sizeof bytes, in)) > 0)
        if (fwrite(bytes, 1, count, to) != count)
            break;
    bool good = in && !ferror(in) && to && !ferror(to);
    const char *why = out && !to ? file.why : output_file_explain(errno ? errno : EIO);
    if (in)
        fclose(in);
    if (out && to && !good)
        output_file_abandon(&file);
    else if (out && to && !(good = output_file_commit(&file)))
        why = file.why;
    return good ? EXIT_SUCCESS
                : fail("explain", "%s: cannot write: %s", out ? out : "the standard output",
                       why);
}

static long bytes_of(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 ? (long)status.st_size : 0;
}

static int show(const struct explain *e, const char *name, int ended)
{
    bool explained = bytes_of(e->text_path) > 0;
    int code = WIFEXITED(ended) ? WEXITSTATUS(ended) : 0, status = EXIT_SUCCESS;
    if (code == 126 && !explained)
        return EXIT_FAILED; /* the reason was printed */
    if (WIFSIGNALED(ended))
        status = fail("explain", "%s: ended by signal %d (%s)", name, WTERMSIG(ended),
                      strsignal(WTERMSIG(ended)));
    else if (code == EXIT_INTERRUPTED)
        status = EXIT_INTERRUPTED;
    else if (code)
        status = fail("explain", "%s: ended with status %d", name, code);
    if (!explained)
        return status != EXIT_SUCCESS
                   ? status
                   : fail("explain",
                          "%s: nothing to explain: it made no Connection Machine do anything "
                          "(a program linked with libparis does, and ends by exit or return)",
                          name);
    visible_print("\n---- lutetia explain %s ----\n\n", name);
    int poured = pour(e->text_path, NULL);
    if (poured == EXIT_SUCCESS && e->json)
        poured = pour(e->json_path, e->json);
    return poured != EXIT_SUCCESS ? poured : status;
}

static int explain(struct explain *e, char **arguments)
{
    const char *name = arguments[0], *program = name;
    int status = EXIT_SUCCESS;
    if (is_source(name)) {
        status = compile(e, name);
        program = e->program_path;
    }
    if (status != EXIT_SUCCESS)
        return status;
    if (ended_by)
        return fail("explain", "ended by signal %d", (int)ended_by);
    fflush(NULL);
    pid_t child = fork();
    if (child < 0)
        return fail("explain", "no process: %s", strerror(errno));
    if (child == 0)
        become(e, program, arguments);
    const int ended = child_wait(child);
    parts_sweep(e);
    return show(e, name, ended);
}

int verb_explain(int argc, char **argv)
{
    struct explain e = {.json = NULL};
    const struct option_row rows[] = {{"json", 0, OPTION_TEXT, "FILE",
                                       "also write the report as JSON there", &e.json, 0, 0, 0},
                                      {0}};
    struct option_words words;
    int own = options_own(rows, argc, argv);
    if (own < argc && strcmp(argv[own], "--") == 0)
        own++;
    if (!options_parse("explain", rows, own, argv, &words))
        return EXIT_USAGE;
    if (words.help)
        return help_print("explain", rows, NULL);
    if (own == argc)
        return fail_usage("explain", "no program; `lutetia explain prog` or `lutetia explain "
                                     "prog.c` runs one");
    if (output_check("explain", e.json) != EXIT_SUCCESS)
        return EXIT_FAILED;
    signal(SIGINT, SIG_IGN);
    ends_pass_on(true);
    if (!folder_open(&e))
        return EXIT_FAILED;
    struct sigaction before;
    open_now = &e;
    if (sigaction(SIGPIPE, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
        sigaction(SIGPIPE, &(struct sigaction){.sa_handler = pipe_ended}, NULL);
    int status = explain(&e, argv + own);
    fflush(stdout);
    sigaction(SIGPIPE, &before, NULL);
    folder_close(&e);
    return status;
}
