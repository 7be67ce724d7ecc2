/* test_growing_file.c - files that grow under their name, what signals leave of files that are
 * being written, and exit statuses that tell. (security.md 11, 12, 13, 18, 25, 26) */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <exit_status.h>
#include <growing_file.h>
#include <part_files.h>

#include "own_folder.h"

static void text_make(const char *name, const char *text)
{
    FILE *f = fopen(name, "wb");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
}

static void content_is(const char *name, const char *content)
{
    char buffer[4096] = "";
    FILE *f = fopen(name, "rb");
    assert_non_null(f);
    buffer[fread(buffer, 1, sizeof buffer - 1, f)] = '\0';
    fclose(f);
    assert_string_equal(buffer, content);
}

static void pieces_are_read_meanwhile(void **state)
{
    struct growing_file f;
    (void)state;
    text_make("log", "before");
    assert_true(growing_file_open(&f, "log"));
    content_is("log", "before");
    assert_true(growing_file_append(&f, "[1", 2, "]\n", 2));
    content_is("log", "[1]\n");
    assert_true(growing_file_append(&f, ", 22", 4, "]\n", 2));
    content_is("log", "[1, 22]\n");
    assert_true(growing_file_close(&f));
    assert_true(growing_file_close(&f)); /* does nothing */
    content_is("log", "[1, 22]\n");
    assert_int_equal(names_count(), 1);
}

static void without_a_piece_nothing_appears(void **state)
{
    struct growing_file f;
    (void)state;
    text_make("log", "before");
    for (int i = 0; i < 2; i++) {
        assert_true(growing_file_open(&f, i ? "new" : "log"));
        assert_true(growing_file_close(&f));
    }
    content_is("log", "before");
    assert_int_equal(names_count(), 1);
}

/* The limit counts as a full disk: EFBIG in place of ENOSPC. */
static void full_disk_brings_back_what_was_there(void **state)
{
    struct rlimit usual;
    struct growing_file f;
    (void)state;
    text_make("log", "before");
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &usual), 0);
    signal(SIGXFSZ, SIG_IGN);
    for (int i = 0; i < 4; i++) {
        const char *name = i % 2 ? "new" : "log";
        setrlimit(RLIMIT_FSIZE, &(struct rlimit){i < 2 ? 6 : 10, usual.rlim_max});
        assert_true(growing_file_open(&f, name));
        bool first = growing_file_append(&f, "12345678", 8, NULL, 0);
        assert_int_equal(first, i >= 2);
        bool second = first && growing_file_append(&f, "12345678", 8, NULL, 0);
        setrlimit(RLIMIT_FSIZE, &usual);
        assert_false(second);
        assert_int_equal(f.error, EFBIG);
        assert_non_null(strstr(f.why, "too large"));
        assert_false(f.is_open);
        assert_false(growing_file_append(&f, "more", 4, NULL, 0));
        assert_true(growing_file_close(&f));
        content_is("log", "before");
        assert_int_equal(names_count(), 1);
    }
    signal(SIGXFSZ, SIG_DFL);
}

static void what_another_put_there_stays(void **state)
{
    struct growing_file f, other;
    struct rlimit usual;
    (void)state;
    getrlimit(RLIMIT_FSIZE, &usual);
    signal(SIGXFSZ, SIG_IGN);
    text_make("log", "before");
    assert_true(growing_file_open(&f, "log"));
    assert_true(growing_file_append(&f, "one", 3, NULL, 0));
    assert_true(growing_file_open(&other, "log"));
    assert_true(growing_file_append(&other, "two", 3, NULL, 0));
    setrlimit(RLIMIT_FSIZE, &(struct rlimit){3, usual.rlim_max});
    assert_false(growing_file_append(&f, "more", 4, NULL, 0));
    setrlimit(RLIMIT_FSIZE, &usual);
    content_is("log", "two");
    assert_true(growing_file_close(&other));
    content_is("log", "two");
    assert_int_equal(names_count(), 1);
    signal(SIGXFSZ, SIG_DFL);
}

static void refused(const char *path, int error)
{
    struct growing_file f;
    alarm(10); /* opening must not wait */
    assert_false(growing_file_open(&f, path));
    alarm(0);
    assert_int_equal(f.error, error);
    assert_non_null(f.why);
}

static void links_folders_and_strangers_pipes_are_refused(void **state)
{
    char shared[64];
    (void)state;
    text_make("precious", "precious");
    assert_int_equal(symlink("precious", "link"), 0);
    assert_int_equal(symlink("nowhere", "dangling"), 0);
    assert_int_equal(symlink("/dev/null", "device"), 0);
    refused("link", ELOOP);
    refused("dangling", ELOOP);
    refused("device", ELOOP);
    refused(".", EISDIR);
    refused("", ENOENT);
    refused("/no/such/file", ENOENT);
    content_is("precious", "precious");
    /* what lies in /dev is not all the system's */
    snprintf(shared, sizeof shared, "/dev/shm/test-growing-%d", (int)getpid());
    if (symlink("/tmp/nowhere", shared) == 0) {
        refused(shared, ELOOP);
        unlink(shared);
    }
    if (geteuid() == 0) {
        assert_int_equal(mkfifo("pipe", 0666), 0);
        assert_int_equal(chown("pipe", 65534, 65534), 0);
        refused("pipe", EACCES);
    }
}

static void pipes_devices_and_open_files_are_written_to(void **state)
{
    struct growing_file f;
    char name[64], got[8] = "";
    int ends[2];
    (void)state;
    assert_true(growing_file_open(&f, "/dev/null"));
    assert_true(growing_file_append(&f, "x", 1, "tail", 4));
    assert_true(growing_file_close(&f));
    assert_true(growing_file_open(&f, "/dev/full"));
    assert_false(growing_file_append(&f, "x", 1, NULL, 0));
    assert_int_equal(f.error, ENOSPC);

    assert_int_equal(pipe(ends), 0);
    snprintf(name, sizeof name, "/dev/fd/%d", ends[1]);
    assert_true(growing_file_open(&f, name));
    assert_true(growing_file_append(&f, "abc", 3, "tail", 4));
    assert_true(growing_file_close(&f));
    close(ends[1]);
    assert_int_equal(read(ends[0], got, sizeof got), 3);
    close(ends[0]);

    text_make("errors",
              "said before\n"); /* as the standard error may be a file that others write, too */
    int file = open("errors", O_WRONLY | O_APPEND);
    snprintf(name, sizeof name, "/proc/self/fd/%d", file);
    assert_true(growing_file_open(&f, name));
    assert_true(growing_file_append(&f, "report\n", 7, NULL, 0));
    assert_true(growing_file_close(&f));
    close(file);
    content_is("errors", "said before\nreport\n");
}

/* Runs it in a child; returns how that ended. */
static int of_child(void (*run)(int), int argument)
{
    int status;
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
        run(argument);
        _exit(99);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    return status;
}

static void files_begin(struct output_file *page, struct growing_file *log)
{
    if (!output_file_open(page, "page") || fputs("half a page", page->stream) < 0 ||
        fflush(page->stream) != 0 || !growing_file_open(log, "log") ||
        !growing_file_append(log, "one piece", 9, NULL, 0))
        _exit(98);
}

static void ended_by(int number)
{
    struct output_file page;
    struct growing_file log;
    files_begin(&page, &log);
    if (number == SIGKILL && names_count() != 4)
        _exit(97);
    raise(number);
}

static void signals_leave_no_part_files(void **state)
{
    static const int numbers[] = {SIGINT,  SIGTERM, SIGHUP,  SIGQUIT, SIGPIPE,
                                  SIGALRM, SIGABRT, SIGSEGV, SIGKILL};
    (void)state;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        struct sigaction now;
        text_make("page", "before");
        text_make("log", "before");
        if (sigaction(numbers[i], NULL, &now) == 0 && now.sa_handler != SIG_DFL)
            continue; /* a sanitizer's */
        int status = of_child(ended_by, numbers[i]);
        assert_true(WIFSIGNALED(status));
        assert_int_equal(WTERMSIG(status), numbers[i]);
        content_is("page", "before");
        content_is("log", "one piece");
        assert_int_equal(names_count(), numbers[i] == SIGKILL ? 4 : 2);
    }
    of_child(ended_by, SIGTERM); /* the next start has swept what SIGKILL left */
    assert_int_equal(names_count(), 2);
}

static volatile sig_atomic_t handled;

static void handle(int number)
{
    (void)number;
    handled = 1;
}

static void handling(int number)
{
    struct output_file page;
    struct growing_file log;
    struct sigaction now;
    signal(number, handle);
    signal(SIGHUP, SIG_IGN);
    files_begin(&page, &log);
    raise(number);
    raise(SIGHUP);
    if (!handled || !growing_file_close(&log) || !output_file_commit(&page) ||
        sigaction(SIGINT, NULL, &now) != 0 || now.sa_handler != SIG_DFL)
        _exit(96);
    _exit(0);
}

static void signals_that_a_program_handles_are_its_own(void **state)
{
    (void)state;
    assert_int_equal(of_child(handling, SIGTERM), 0);
    content_is("page", "half a page");
    assert_int_equal(names_count(), 2);
}

static void parent(int number)
{
    struct output_file page;
    struct growing_file log;
    files_begin(&page, &log);
    pid_t child = fork();
    if (child == 0) {
        struct output_file own;
        if (!output_file_open(&own, "own") || !growing_file_close(&log))
            _exit(1);
        raise(number);
    }
    int status;
    if (waitpid(child, &status, 0) != child || !WIFSIGNALED(status) ||
        !output_file_commit(&page) || !growing_file_append(&log, ", two", 5, NULL, 0) ||
        !growing_file_close(&log))
        _exit(95);
    _exit(0);
}

static void children_leave_their_parents_files_alone(void **state)
{
    (void)state;
    assert_int_equal(of_child(parent, SIGTERM), 0);
    content_is("page", "half a page");
    content_is("log", "one piece, two");
    assert_int_equal(names_count(), 2);
}

static void last(void)
{
    text_make("last", "ran");
}

static void failing_at_exit(void)
{
    exit_status_fail();
}

static void exits(int status)
{
    atexit(last);
    if (status & 16)
        atexit(failing_at_exit);
    else
        exit_status_fail();
    if (status & 32) {
        pid_t child = fork();
        int ended = 0;
        if (child == 0)
            exit(0);
        if (waitpid(child, &ended, 0) != child || (!(status & 16) && ended != 0))
            _exit(94); /* a child's status is its own */
    }
    exit(status & 15);
}

static void a_failure_shows_in_the_exit_status(void **state)
{
    (void)state;
    for (int late = 0; late <= 48; late += 16) {
        unlink("last");
        assert_int_equal(of_child(exits, late), 1 << 8);
        content_is("last", "ran");
        assert_int_equal(of_child(exits, late | 3), 3 << 8);
    }
}

#define CASE(f) cmocka_unit_test_setup_teardown(f, folder_enter, folder_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(pieces_are_read_meanwhile),
        CASE(without_a_piece_nothing_appears),
        CASE(full_disk_brings_back_what_was_there),
        CASE(what_another_put_there_stays),
        CASE(links_folders_and_strangers_pipes_are_refused),
        CASE(pipes_devices_and_open_files_are_written_to),
        CASE(signals_leave_no_part_files),
        CASE(signals_that_a_program_handles_are_its_own),
        CASE(children_leave_their_parents_files_alone),
        CASE(a_failure_shows_in_the_exit_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
