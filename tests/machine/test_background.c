/* test_background.c - a background process compiles optimised kernels while others run.
 * Whenever they arrive, the bits are those of a machine that waits for its kernels. Where there
 * is no such process, the machine waits. Machines and programs may end while it compiles. */
#include "machine_explained.h"
#include "support.h"

#include "background_loops.h"
#include "base/clock.h"
#include "base/parts.h"
#include "plans/background.h"
#include "plans/compiler.h"
#include "plans/plans.h"

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { TURNS = 150, WAIT_EVERY = 25, CELLS_MOST = 8192 };

static bool keeps; /* compiled kernels are recorded on disk and looked up there */

static void forced(const char *background, const struct looped *p)
{
    setenv("LUTETIA_BACKGROUND", background, 1);
    if (keeps)
        unsetenv("LUTETIA_KEEP");
    else
        setenv("LUTETIA_KEEP", "0", 1);
    setenv("LUTETIA_OPTIMISE_AFTER", "1000000", 1); /* kernels are first built quickly */
    setenv("LUTETIA_BOX_AFTER", "1", 1);            /* and optimised as soon as possible */
    setenv("LUTETIA_FLUSH_AFTER", "48", 1);
    setenv("LUTETIA_TURNS", p->looks ? "1" : "3", 1);
    setenv("LUTETIA_STRIPS", p->looks ? "0" : "1", 1);
    setenv("LUTETIA_VECTOR", p->tiles ? "1" : "", 1);
}

static void begin(struct sheet *s, const struct looped *p, const char *background)
{
    static uint32_t words[CELLS_MOST];
    static float floats[CELLS_MOST];
    struct machine_config config = machine_config_default();
    const int dimensions[2] = {p->height, p->width};
    config.processors_count = 16;
    config.eager = 0;
    config.explain = 1;
    forced(background, p);
    *s = (struct sheet){.loop = p};
    assert_ok(machine_create(&config, &s->m), s->m);
    s->m->device->shape.load_aside_bytes =
        keeps ? 64 << 10 : 0; /* by a thread, or by the caller */
    if (!keeps && !p->looks)
        s->m->device->shape.choose_aside = 0;
    int set = machine_vpset_create(s->m, dimensions, 2);
    machine_vpset_select(s->m, set);
    for (uint32_t i = 0; i < (uint32_t)(p->height * p->width); i++) {
        words[i] = i * 2654435761u >> 7;
        floats[i] = (float)(words[i] % 1000) / 997;
    }
    const void *start = p->type.kind == MACHINE_FLOAT ? (void *)floats : (void *)words;
    s->a = machine_field_allocate(s->m, set, p->type.width, MACHINE_HEAP);
    s->b = machine_field_allocate(s->m, set, p->type.width, MACHINE_HEAP);
    assert_ok(machine_field_upload(s->m, s->a, p->type, start), s->m);
    assert_ok(machine_field_upload(s->m, s->b, p->type, start), s->m);
}

static struct machine_stats stats(const struct sheet *s)
{
    struct machine_stats now;
    machine_stats_get(s->m, &now);
    return now;
}

static void look(const struct sheet *s, void *out)
{
    memset(out, 0, CELLS_MOST * sizeof(uint32_t));
    machine_begin(s->m);
    assert_ok(machine_field_download(s->m, s->a, s->loop->type, out), s->m);
}

/* Runs count turns, and waits for the background's kernels after every WAIT_EVERY of them. */
static void run(struct sheet *s, int count)
{
    for (int done = 0; done < count; done += WAIT_EVERY) {
        turns(s, WAIT_EVERY);
        wait_for(s);
    }
}

/* The number of kernels that ran and were made in this way. */
static int kernels_made(const struct sheet *s, const char *made)
{
    const struct machine_explained *x = machine_explain(s->m, false);
    int count = 0;
    assert_non_null(x);
    for (int i = 0; i < x->kernels_count; i++)
        count += x->kernels[i].generated && !strcmp(x->kernels[i].made, made);
    return count;
}

static void no_children(void)
{
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    assert_int_equal(errno, ECHILD);
}

static void bits_are_the_same_whenever_kernels_come(void **state)
{
    static uint32_t with[CELLS_MOST], without[CELLS_MOST];
    (void)state;
    for (size_t i = 0; i < sizeof loops / sizeof *loops; i++) {
        struct sheet s;
        begin(&s, &loops[i], "1");
        run(&s, TURNS);
        look(&s, with);
        struct machine_stats on = stats(&s);
        assert_true(on.kernels_built_background > 0);
        assert_true(on.kernels_built_background < on.kernels_built);
        assert_true(kernels_made(&s, "quick") > 0);
        assert_true(loops[i].tiles ? on.kernels_in_tiles > 0 : kernels_made(&s, "boxed") > 0);
        no_children(); /* the process is there */
        machine_destroy(s.m);

        begin(&s, &loops[i], "0");
        run(&s, TURNS);
        look(&s, without);
        struct machine_stats off = stats(&s);
        assert_int_equal(off.kernels_built_background, 0);
        machine_destroy(s.m);
        if (memcmp(with, without, sizeof with) != 0)
            fail_msg("%s: other bits", loops[i].what);
        assert_int_equal(on.stores, off.stores);
    }
}

/* The kernel of many turns is compiled in the background; single turns run until it is there.
 * What it stores is chosen by a thread. */
static void many_turns_at_once_do_not_wait(void **state)
{
    struct sheet s;
    (void)state;
    begin(&s, &loops[1], "1");
    run(&s, TURNS);
    assert_true(s.m->plans->rehearsals_chosen > 0);
    assert_ok(machine_finish(s.m), s.m);
    struct machine_stats before = stats(&s);
    turns(&s, 60);
    assert_ok(machine_finish(s.m), s.m);
    struct machine_stats after = stats(&s);
    assert_true(after.kernels_run - before.kernels_run <= 60 / 2);
    assert_int_equal(after.stores - before.stores, 60);
    assert_int_equal(after.kernels_built, before.kernels_built);
    machine_destroy(s.m);
}

/* ---- compilers that fail ---- */

static char pretender[64], log_path[64];

static int folder_make(void **state)
{
    int status = support_cache_make(state);
    snprintf(pretender, sizeof pretender, "%s/compiler", support_cache);
    snprintf(log_path, sizeof log_path, "%s/log", support_cache);
    return status;
}

/* Makes a compiler of this shell script. It writes the id of each process that starts it, a
 * session leader, to the log. */
static void compiler_is(const char *does)
{
    unlink(log_path);
    FILE *f = fopen(pretender, "w");
    assert_non_null(f);
    fprintf(f, "#!/bin/sh\necho $$ >>%s\n%s\n", log_path, does);
    assert_int_equal(fclose(f), 0);
    assert_int_equal(chmod(pretender, 0700), 0);
    setenv("LUTETIA_COMPILER", pretender, 1);
}

static void compiler_path(char path[1024])
{
    ssize_t length = readlink("/proc/self/exe", path, 900);
    assert_true(length > 0);
    path[length] = '\0';
    for (int up = 0; up < 3; up++)
        *strrchr(path, '/') = '\0';
    strcat(path, "/host/machine/lutetia-compiler");
}

/* Makes the compiler a script that logs its start and runs the real compiler. */
static void compiler_is_noted(void)
{
    char does[1100] = "exec ";
    compiler_path(does + strlen(does));
    strcat(does, " $1");
    compiler_is(does);
}

static int starts(void)
{
    int count = 0;
    FILE *f = fopen(log_path, "r");
    for (int c; f && (c = getc(f)) != EOF;)
        count += c == '\n';
    if (f)
        fclose(f);
    return count;
}

/* The number of processes in the session of the first compiler that was started. */
static int processes(void)
{
    int count = 0, leader = 0;
    FILE *f = fopen(log_path, "r");
    assert_non_null(f);
    assert_int_equal(fscanf(f, "%d", &leader), 1);
    fclose(f);
    DIR *all = opendir("/proc");
    assert_non_null(all);
    for (struct dirent *d; (d = readdir(all));) {
        char path[300], state;
        int session = 0;
        snprintf(path, sizeof path, "/proc/%s/stat", d->d_name);
        if (*d->d_name < '1' || *d->d_name > '9' || !(f = fopen(path, "r")))
            continue;
        if (fscanf(f, "%*d (%*[^)]) %c %*d %*d %d", &state, &session) == 2)
            count += session == leader && state != 'Z';
        fclose(f);
    }
    closedir(all);
    return count;
}

/* Waits until the compiler's processes have ended; only a slow disk delays them. */
static void all_end(void)
{
    double start = clock_s();
    while (processes()) {
        assert_true(clock_s() - start < 30);
        usleep(1000);
    }
}

/* Checks that with this compiler the bits and the kernels are those of a machine that waits,
 * and that no kernel came from the background. */
static void done_without(const char *compiler, int started)
{
    static uint32_t with[CELLS_MOST], without[CELLS_MOST];
    static bool known;
    struct sheet s;
    compiler_is(compiler);
    begin(&s, &loops[0], "1");
    run(&s, TURNS);
    look(&s, with);
    assert_int_equal(stats(&s).kernels_built_background, 0);
    assert_true(kernels_made(&s, "boxed") > 0);
    assert_int_equal(machine_status_last(s.m), MACHINE_OK);
    no_children();
    machine_destroy(s.m);
    assert_int_equal(starts(), started);
    if (!known) {
        begin(&s, &loops[0], "0");
        run(&s, TURNS);
        look(&s, without);
        machine_destroy(s.m);
    }
    known = true;
    assert_memory_equal(with, without, sizeof with);
    if (started)
        all_end();
    no_children();
}

static void one_that_does_not_is_done_without(void **state)
{
    (void)state;
    done_without("exit 1", 1);                          /* and is not tried again */
    done_without("printf Z >&0; exec sleep 100", 1);    /* of another version */
    done_without("printf A >&0; head -c 1; exit 1", 1); /* as if the kernel had crashed it */
    done_without("printf A >&0; head -c 1; printf n >&0; exec sleep 100", 1);
    setenv("POCL_KERNEL_CACHE", "0", 1); /* nobody could use its results */
    done_without("printf A >&0; exec sleep 100", 0);
    unsetenv("POCL_KERNEL_CACHE");
}

static void one_that_hangs_is_not_waited_for(void **state)
{
    struct sheet s;
    (void)state;
    compiler_is("printf A >&0; exec sleep 100");
    begin(&s, &loops[0], "1");
    for (int i = 0; i < 5000 && !starts(); i++) {
        turns(&s, 1);
        usleep(1000);
    }
    turns(&s, 50);
    assert_non_null(s.m->plans->improving);
    assert_int_equal(stats(&s).kernels_built_background, 0);
    machine_destroy(s.m);
    no_children();
    all_end();
}

/* The disk's records tell which kernels the driver's cache holds: a second program starts no
 * compiler for them. */
static void what_was_compiled_is_loaded_at_once(void **state)
{
    struct sheet s;
    (void)state;
    keeps = true;
    for (int i = 0; i < 2; i++) {
        compiler_is_noted();
        begin(&s, &loops[0], "1");
        run(&s, TURNS);
        assert_int_equal(starts(), i == 0);
        assert_true(stats(&s).kernels_built_background > 0);
        machine_destroy(s.m);
    }
    keeps = false;
}

/* ---- ends ---- */

static void program_that_ends_soon_starts_none(void **state)
{
    struct sheet s;
    (void)state;
    compiler_is_noted();
    begin(&s, &loops[0], "1");
    for (int i = 0; i < 100 && !s.m->plans->improving; i++)
        turns(&s, 1);
    assert_non_null(s.m->plans->improving);
    machine_destroy(s.m);
    assert_int_equal(starts(), 0);
}

static void begin_new(struct sheet *s, const char *background)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    begin(s, &new_loop, background);
    s->variant = ((uint64_t)now.tv_nsec / 64 & 0xffff) | 1 << 16;
}

static void until_started(struct sheet *s)
{
    for (int i = 0; i < 10000 && !starts(); i++) {
        turns(s, 1);
        usleep(1000);
    }
    assert_int_equal(starts(), 1);
}

static void machine_ends_while_one_is_compiled(void **state)
{
    struct sheet s;
    (void)state;
    compiler_is_noted();
    begin_new(&s, "1");
    until_started(&s);
    usleep(100000);
    plans_see_to(s.m); /* asks */
    machine_destroy(s.m);
    no_children();
    all_end();
}

/* Runs as a child program, which ends in the given way. */
static int program(const char *how)
{
    struct sheet s;
    snprintf(log_path, sizeof log_path, "%s", getenv("LOG"));
    if (!strcmp(how, "killed"))
        begin_new(&s, "1");
    else
        begin(&s, &loops[0], "1");
    until_started(&s);
    usleep(100000);
    turns(&s, 1);
    if (!strcmp(how, "killed"))
        raise(SIGKILL);
    if (fork() == 0) { /* the child keeps all open files until the test is over */
        fclose(stdout);
        fclose(stderr);
        for (int i = 0; i < 1000 && access(log_path, F_OK) == 0; i++)
            usleep(100000);
        _exit(0);
    }
    exit(0);
}

static void process_ends_with_the_program(void **state)
{
    static const char *const ways[] = {"killed", "forked"};
    (void)state;
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        int status;
        compiler_is_noted();
        setenv("LOG", log_path, 1);
        pid_t process = fork();
        assert_true(process >= 0);
        if (!process) {
            execl("/proc/self/exe", "test_background", ways[i], (char *)NULL);
            _exit(99);
        }
        assert_int_equal(waitpid(process, &status, 0), process);
        assert_true(i == 0 ? WIFSIGNALED(status) : WIFEXITED(status) && !WEXITSTATUS(status));
        assert_int_equal(starts(), 1);
        all_end();
    }
}

/* ---- batches ---- */

static void kernel_that_does_not_compile_is_no_error(void **state)
{
    const char *parts[DEVICE_PARTS];
    struct machine *m = support_machine(0);
    (void)state;
    compiler_is_noted();
    for (int i = 0; i < DEVICE_PARTS; i++)
        parts[i] = "";
    parts[DEVICE_PARTS - 1] = "kernel void k(global int *a) { a[0] = no_such; }";
    struct background_wish wish = {.parts = parts,
                                   .options = "",
                                   .name = "k",
                                   .arguments = "m",
                                   .dimensions = 2,
                                   .widest = 1};
    enum background_state is = BACKGROUND_WAITS;
    assert_int_equal(background_want(m, &wish), 0);
    assert_false(background_busy(m));
    assert_true(background_begin(m));
    assert_true(background_busy(m));
    for (int i = 0; i < 60000 && is == BACKGROUND_WAITS; i++) {
        usleep(1000);
        is = background_take(m);
    }
    assert_int_equal(is, BACKGROUND_LOST);
    assert_int_equal(starts(), 1);
    background_drop(m);
    assert_false(background_busy(m));
    assert_false(background_on(m));
    assert_int_equal(machine_status_last(m), MACHINE_OK);
    assert_string_equal(machine_error(m), "");
    machine_destroy(m);
}

/* ---- the compiler by itself ---- */

/* The compiler's answer to a request that announces strings of these lengths, of whose bytes
 * only `given` are sent; 0: no answer. */
static char answer_to(int to, const uint32_t bytes[COMPILER_STRINGS], size_t given, char fill)
{
    struct compiler_request request = {.dimensions = 2, .widest = 1};
    char text[256], answer = 0;
    memcpy(request.bytes, bytes, sizeof request.bytes);
    memset(text, fill, sizeof text);
    for (size_t i = 0, at = 0; i < COMPILER_STRINGS && (at += bytes[i]) <= sizeof text; i++)
        if (bytes[i])
            text[at - 1] = fill == 'x' ? '\0' : fill;
    if (send(to, &request, sizeof request, MSG_NOSIGNAL) != sizeof request ||
        (given && send(to, text, given, MSG_NOSIGNAL) != (ssize_t)given))
        return 0;
    if (given < bytes[0])
        shutdown(to, SHUT_WR);
    return recv(to, &answer, 1, MSG_WAITALL) == 1 ? answer : 0;
}

static int compiler_run(void)
{
    char path[1024], machine[24], ready = 0;
    int ends[2];
    compiler_path(path);
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends), 0);
    snprintf(machine, sizeof machine, "%d", (int)getpid());
    pid_t process = fork();
    assert_true(process >= 0);
    if (!process) {
        dup2(ends[1], STDIN_FILENO);
        execl(path, path, machine, (char *)NULL);
        _exit(99);
    }
    close(ends[1]);
    assert_int_equal(recv(ends[0], &ready, 1, MSG_WAITALL), 1);
    assert_int_equal(ready, COMPILER_READY);
    assert_int_equal(waitpid(process, NULL, 0), process); /* it has started another */
    return ends[0];
}

static void compiler_gives_up_on_nonsense(void **state)
{
    static const struct {
        uint32_t bytes[COMPILER_STRINGS];
        size_t given;
        char fill, answer;
    } cases[] = {
        {{5, 5, 5, 5, 5, 5}, 30, 'x', COMPILER_FAILED}, /* no such device */
        {{5, 5, 5, 5, 5, 5}, 30, 'y', 0},               /* strings without an end */
        {{0, 5, 5, 5, 5, 5}, 0, 'x', 0},
        {{UINT32_MAX, 5, 5, 5, 5, 5}, 200, 'x', 0},
        {{100, 5, 5, 5, 5, 5}, 20, 'x', 0}, /* and no more comes */
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int to = compiler_run();
        char more;
        assert_int_equal(answer_to(to, cases[i].bytes, cases[i].given, cases[i].fill),
                         cases[i].answer);
        shutdown(to, SHUT_WR);
        assert_int_equal(recv(to, &more, 1, 0), 0);
        close(to);
    }
}

static void trace_has_them_on_a_track_of_their_own(void **state)
{
    struct sheet s;
    char path[] = "/tmp/lutetia-trace-XXXXXX", text[200];
    int file = mkstemp(path), builds = 0, titles = 0;
    (void)state;
    assert_true(file >= 0);
    close(file);
    setenv("LUTETIA_TRACE", path, 1);
    begin(&s, &loops[0], "1");
    run(&s, TURNS);
    uint64_t built = stats(&s).kernels_built_background;
    machine_destroy(s.m);
    unsetenv("LUTETIA_TRACE");
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    while (fgets(text, sizeof text, f)) {
        builds += strstr(text, "\"tid\":3,\"name\":\"build\"") != NULL;
        titles += strstr(text, "\"tid\":3,\"name\":\"thread_name\"") != NULL;
    }
    fclose(f);
    unlink(path);
    assert_true(built > 0);
    assert_int_equal(builds, built);
    assert_int_equal(titles, 1);
}

/* Sets PoCL's cache folder to its present place, so that later changes of XDG_CACHE_HOME do not
 * move it. */
static void driver_cache_said(void)
{
    const char *base = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    char path[500];
    if (base)
        snprintf(path, sizeof path, "%s/pocl/kcache", base);
    else
        snprintf(path, sizeof path, "%s/.cache/pocl/kcache", home ? home : "/tmp");
    setenv("POCL_CACHE_DIR", path, 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bits_are_the_same_whenever_kernels_come),
        cmocka_unit_test(many_turns_at_once_do_not_wait),
        cmocka_unit_test(one_that_does_not_is_done_without),
        cmocka_unit_test(one_that_hangs_is_not_waited_for),
        cmocka_unit_test(what_was_compiled_is_loaded_at_once),
        cmocka_unit_test(program_that_ends_soon_starts_none),
        cmocka_unit_test(machine_ends_while_one_is_compiled),
        cmocka_unit_test(process_ends_with_the_program),
        cmocka_unit_test(kernel_that_does_not_compile_is_no_error),
        cmocka_unit_test(trace_has_them_on_a_track_of_their_own),
        cmocka_unit_test(compiler_gives_up_on_nonsense),
    };
    if (argc > 1)
        return program(argv[1]);
    driver_cache_said();
    struct machine *m = support_machine(0);
    bool pocl = m->device->is_pocl;
    machine_destroy(m);
    if (!pocl) {
        puts("skipped: the device is not PoCL's");
        return 77;
    }
    return cmocka_run_group_tests(tests, folder_make, support_cache_remove);
}
