/* build.c - compiles a program in C/Paris and starts it, in a folder of its own: see keeper.h.
 *
 * Both run in jails. The compiler reads what the system has installed, and writes into the
 * folder; the program reads the same, and writes nothing. Neither gets the user's environment:
 * what is in it may be a secret. Kernels are not compiled: the program's plans stay byte code,
 * so that no driver has to write its cache. */
#include "keeper.h"

#include <jail.h>
#include <output_file.h>
#include <program.h>
#include <streams.h>
#include <user_folder.h>

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

/* Where a system keeps what programs need, and nobody's own files. */
static const char *const system_reads[] = {"/usr",
                                           "/bin",
                                           "/lib",
                                           "/lib32",
                                           "/lib64",
                                           "/opt",
                                           "/nix/store",
                                           "/gnu/store",
                                           "/etc/ld.so.cache",
                                           "/etc/ld.so.conf",
                                           "/etc/ld.so.conf.d",
                                           "/etc/OpenCL",
                                           "/etc/alternatives",
                                           "/sys/devices",
                                           "/sys/bus",
                                           "/sys/kernel/mm",
                                           "/sys/fs/cgroup",
                                           "/proc/cpuinfo",
                                           "/proc/meminfo",
                                           "/proc/self",
                                           "/dev/zero",
                                           "/dev/urandom"};
enum {
    SYSTEM_READS = sizeof system_reads / sizeof *system_reads,
    LIGHTS = 3, /* where a program has its pipes */
    DISPLAYS = 4,
    PLACES = 4,
    ENVIRONMENT = 20,
    WORD = PATH_MAX + 40
};

static bool fail(char *why, size_t room, const char *what)
{
    snprintf(why, room, "%s: %s", what, strerror(errno));
    return false;
}

static void here(void)
{
}

/* ---- the folder ---- */

bool build_folder(struct build *b, const char *text, size_t bytes, char *why, size_t room)
{
    char path[PATH_MAX + 16];
    struct output_file out;
    if (!user_folder_temporary("demonstration", b->folder, sizeof b->folder)) {
        b->folder[0] = '\0';
        return fail(why, room, "there is no folder for it");
    }
    snprintf(path, sizeof path, "%s/program.c", b->folder);
    if (output_file_open(&out, path)) {
        fwrite(text, 1, bytes, out.stream);
        if (bytes && text[bytes - 1] != '\n')
            fputc('\n', out.stream);
        if (output_file_commit(&out))
            return true;
    }
    snprintf(why, room, "it cannot be written: %s", out.why);
    return false;
}

void build_remove(struct build *b)
{
    DIR *names = b->folder[0] ? opendir(b->folder) : NULL;
    for (struct dirent *e; names && (e = readdir(names));)
        unlinkat(dirfd(names), e->d_name, 0);
    if (names)
        closedir(names);
    if (b->folder[0])
        rmdir(b->folder);
    b->folder[0] = '\0';
}

/* ---- processes ---- */

/* What one is given. */
struct given {
    char words[ENVIRONMENT][WORD];
    char *environment[ENVIRONMENT + 1];
    int count;
    const char *reads[SYSTEM_READS + PLACES + 2];
    char program[PATH_MAX], places[PLACES][WORD];
};

__attribute__((format(printf, 2, 3))) static void give(struct given *g, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(g->words[g->count], WORD, format, list);
    va_end(list);
    g->environment[g->count] = g->words[g->count];
    g->count++;
}

static void give_if(struct given *g, const char *name)
{
    const char *value = getenv(name);
    if (value && *value && strlen(value) < PATH_MAX)
        give(g, "%s=%s", name, value);
}

/* Where the command has its headers and its library, which may be anywhere: a build's folder,
 * or these folders of a prefix alone, since there is more in a user's. False: it is nowhere. */
static bool places_find(struct given *g)
{
    static const char *const of_prefix[PLACES] = {"bin", "include", "lib", LUTETIA_LIBDIR};
    char *slash[3], root[PATH_MAX];
    if (!program_find(g->program, here, LUTETIA_BINDIR "/lutetia", "host/lutetia/lutetia"))
        return false;
    snprintf(root, sizeof root, "%s", g->program);
    for (int up = 0; up < 3; up++) { /* BUILD/host/lutetia/lutetia, PREFIX/bin/lutetia */
        slash[up] = strrchr(root, '/');
        if (!slash[up] || slash[up] == root)
            return false;
        *slash[up] = '\0';
    }
    if (strcmp(slash[1] + 1, "bin") != 0) {
        snprintf(g->places[0], WORD, "%s", root);
        return true;
    }
    *slash[2] = '/';
    for (int i = 0; i < PLACES; i++)
        snprintf(g->places[i], WORD, "%s/%s", root, of_prefix[i]);
    return true;
}

static bool given_begin(struct given *g, const struct build *b)
{
    int count = 0;
    *g = (struct given){.count = 0};
    if (!places_find(g))
        return false;
    for (int i = 0; i < SYSTEM_READS; i++)
        g->reads[count++] = system_reads[i];
    for (int i = 0; i < PLACES && g->places[i][0]; i++)
        g->reads[count++] = g->places[i];
    g->reads[count] = b->folder;
    give(g, "HOME=%s", b->folder);
    give(g, "TMPDIR=%s", b->folder);
    give(g, "LC_ALL=C.UTF-8");
    give_if(g, "PATH");
    return true;
}

/* In the child, for good. */
_Noreturn static void become(const struct given *g, const struct jail *jail,
                             const struct build *b, const char *program, char **arguments)
{
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    if (setpgid(0, 0) != 0 || prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || chdir(b->folder) != 0 ||
        !jail_enter(jail))
        _exit(126);
    execve(program, arguments, g->environment);
    _exit(127);
}

/* The standard streams; what is beyond them closes by itself. */
static bool streams_set(int printed)
{
    const int nowhere = streams_nowhere(O_RDONLY);
    return nowhere >= 0 && dup2(nowhere, STDIN_FILENO) >= 0 &&
           dup2(printed, STDOUT_FILENO) >= 0 && dup2(printed, STDERR_FILENO) >= 0;
}

int build_end(struct build *b, bool kill_it)
{
    int status = 0;
    if (!b->process)
        return 0;
    if (kill_it) {
        kill(-b->process, SIGKILL);
        kill(b->process, SIGKILL);
    }
    while (waitpid(b->process, &status, 0) < 0 && errno == EINTR)
        ;
    kill(-b->process, SIGKILL); /* what the compiler has left */
    while (kill_it && waitpid(-1, NULL, 0) > 0)
        ;
    b->process = 0;
    return status;
}

bool build_compile(struct build *b, unsigned seconds, char *why, size_t room)
{
    static struct given g;
    int ends[2];
    char *arguments[] = {g.program,           (char[]){"cc"},        (char[]){"-o"},
                         (char[]){"program"}, (char[]){"program.c"}, NULL};
    if (!given_begin(&g, b)) {
        snprintf(why, room, "lutetia is not installed beside this program");
        return false;
    }
    give_if(&g, "CC");
    if (pipe2(ends, O_CLOEXEC) != 0)
        return fail(why, room, "no pipe");
    const struct jail jail = {.reads = g.reads,
                              .writes = b->folder,
                              .starts = true,
                              .cpu_seconds = seconds,
                              .memory_bytes = 2ULL << 30,
                              .file_bytes = 32 << 20,
                              .files = 256};
    b->process = fork();
    if (b->process == 0) {
        if (streams_set(ends[1]))
            become(&g, &jail, b, g.program, arguments);
        _exit(126);
    }
    close(ends[1]);
    b->printed = ends[0];
    fcntl(b->printed, F_SETFL, O_NONBLOCK);
    if (b->process < 0)
        b->process = 0;
    return b->process > 0 || fail(why, room, "no process for the compiler");
}

/* Two ends of a terminal, so that lines come as they are printed; else of a pipe. */
static bool terminal_make(int ends[2])
{
    struct termios raw;
    char name[64];
    ends[1] = -1;
    ends[0] = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (ends[0] >= 0 && grantpt(ends[0]) == 0 && unlockpt(ends[0]) == 0 &&
        ptsname_r(ends[0], name, sizeof name) == 0)
        ends[1] = open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (ends[1] >= 0 && tcgetattr(ends[1], &raw) == 0) {
        cfmakeraw(&raw);
        if (tcsetattr(ends[1], TCSANOW, &raw) == 0)
            return true;
    }
    for (int i = 0; i < 2; i++)
        if (ends[i] >= 0)
            close(ends[i]);
    return pipe2(ends, O_CLOEXEC) == 0;
}

/* The pipes' writing ends take their places. */
static bool pipes_set(int lights, int displays)
{
    const int far[2] = {fcntl(lights, F_DUPFD_CLOEXEC, 20),
                        fcntl(displays, F_DUPFD_CLOEXEC, 20)};
    return far[0] >= 0 && far[1] >= 0 && dup2(far[0], LIGHTS) >= 0 &&
           dup2(far[1], DISPLAYS) >= 0;
}

static void program_give(struct given *g, const struct build *b, int memory_mb)
{
    give(g, "LUTETIA_LEDS=/dev/fd/%d", LIGHTS);
    give(g, "LUTETIA_DISPLAY=/dev/fd/%d", DISPLAYS);
    give(g, "LUTETIA_INTERPRET=2");
    give(g, "LUTETIA_COMPILER=");
    give(g, "LUTETIA_DEVICE=Portable");
    give(g, "LUTETIA_MEMORY=%lld", (long long)memory_mb << 19);
    give(g, "POCL_CACHE_DIR=%s", b->folder);
    give(g, "POCL_KERNEL_CACHE=0");
    give(g, "POCL_AFFINITY=0");
    give(g, "POCL_MAX_PTHREAD_COUNT=4");
    give(g, "MALLOC_ARENA_MAX=2");
    give_if(g, "OCL_ICD_VENDORS");
}

bool build_run(struct build *b, int memory_mb, char *why, size_t room)
{
    enum { PIPE_BYTES = 4096 };
    static struct given g;
    static char program[PATH_MAX + 16];
    char *arguments[] = {(char[]){"program"}, NULL};
    int printed[2], lights[2], displays[2];
    snprintf(program, sizeof program, "%s/program", b->folder);
    if (!given_begin(&g, b) || !terminal_make(printed) || pipe2(lights, O_CLOEXEC) != 0 ||
        pipe2(displays, O_CLOEXEC) != 0)
        return fail(why, room, "no pipe");
    program_give(&g, b, memory_mb);
    const struct jail jail = {.reads = g.reads,
                              .memory_bytes =
                                  ((unsigned long long)memory_mb << 20) + (2ULL << 30),
                              .file_bytes = 1 << 20,
                              .files = 64};
    fcntl(lights[0], F_SETPIPE_SZ, PIPE_BYTES); /* a program is a few pictures ahead */
    b->process = fork();
    if (b->process == 0) {
        if (streams_set(printed[1]) && pipes_set(lights[1], displays[1]))
            become(&g, &jail, b, program, arguments);
        _exit(126);
    }
    close(printed[1]);
    close(lights[1]);
    close(displays[1]);
    b->printed = printed[0];
    b->lights = lights[0];
    b->displays = displays[0];
    const int ours[3] = {b->printed, b->lights, b->displays};
    for (int i = 0; i < 3; i++)
        fcntl(ours[i], F_SETFL, O_NONBLOCK);
    if (b->process < 0)
        b->process = 0;
    return b->process > 0 || fail(why, room, "no process for the program");
}
