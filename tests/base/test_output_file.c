/* test_output_file.c - files appear whole under their name or not at all. A name that is no
 * regular file is refused. (security.md 11, 12, 13) */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
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

#include <output_file.h>

#include "own_folder.h"

static void content_is(const char *name, const char *content)
{
    char buffer[4096];
    FILE *f = fopen(name, "rb");
    assert_non_null(f);
    size_t count = fread(buffer, 1, sizeof buffer, f);
    fclose(f);
    assert_int_equal(count, strlen(content));
    assert_memory_equal(buffer, content, count);
}

static void text_write(const char *name, const char *text)
{
    struct output_file out;
    assert_true(output_file_open(&out, name));
    assert_true(fputs(text, out.stream) >= 0);
    assert_true(output_file_commit(&out));
}

static void commit_gives_the_name(void **state)
{
    struct output_file out;
    char path[PATH_MAX];
    text_write("a.png", "first");
    content_is("a.png", "first");
    assert_true(output_file_open(&out, "a.png"));
    fputs("second", out.stream);
    fflush(out.stream);
    content_is("a.png", "first"); /* until it is whole */
    assert_int_equal(names_count(), 2);
    assert_true(output_file_commit(&out));
    content_is("a.png", "second");
    assert_int_equal(names_count(), 1);
    snprintf(path, sizeof path, "%s/b.png", (char *)*state); /* a path with folders */
    text_write(path, "third");
    content_is("b.png", "third");
    output_file_abandon(&out); /* does nothing after a commit */
}

static void abandon_leaves_what_was_there(void **state)
{
    (void)state;
    struct output_file out, never = {0};
    text_write("a.png", "first");
    assert_true(output_file_open(&out, "a.png"));
    fputs("second", out.stream);
    output_file_abandon(&out);
    output_file_abandon(&out);
    output_file_abandon(&never);
    content_is("a.png", "first");
    assert_int_equal(names_count(), 1);
}

static void part_can_be_opened_by_path(void **state)
{
    (void)state;
    struct output_file out;
    assert_true(output_file_open(&out, "./a.h5"));
    FILE *other = fopen(out.part, "wb");
    assert_non_null(other);
    fputs("by path", other);
    fclose(other);
    assert_true(output_file_commit(&out));
    content_is("a.h5", "by path");
}

static void refused(const char *path, int error)
{
    struct output_file out;
    assert_false(output_file_open(&out, path));
    assert_int_equal(out.error, error);
    assert_string_equal(out.why, output_file_explain(error));
}

static void what_is_no_regular_file_is_refused(void **state)
{
    (void)state;
    assert_int_equal(mkfifo("pipe.png", 0600), 0);
    assert_int_equal(mkdir("folder.png", 0700), 0);
    assert_int_equal(symlink("target", "link.png"), 0);
    refused("pipe.png", ENOTSUP);
    refused("folder.png", EISDIR);
    refused("folder.png/", EISDIR);
    refused(".", EISDIR);
    refused("", ENOENT);
    refused("link.png", ELOOP);
    refused("/dev/null", ENOTSUP);
    refused("/dev/full", ENOTSUP);
    refused("missing/a.png", ENOENT);
    text_write("target", "x");
    refused("link.png", ELOOP); /* though it leads to a file */
    refused("target/a.png", ENOTDIR);
    struct stat status;
    assert_int_equal(lstat("pipe.png", &status), 0);
    assert_true(S_ISFIFO(status.st_mode));
    assert_int_equal(rmdir("folder.png"), 0); /* nothing was left in it */
}

static void what_comes_to_have_the_name_meanwhile_is_refused(void **state)
{
    (void)state;
    struct output_file out;
    assert_true(output_file_open(&out, "a.png"));
    assert_int_equal(mkfifo("a.png", 0600), 0);
    assert_false(output_file_commit(&out));
    assert_int_equal(out.error, ENOTSUP);
    assert_int_equal(names_count(), 1);
}

static void long_names_are_refused(void **state)
{
    (void)state;
    char name[256];
    memset(name, 'n', 255);
    name[255] = '\0';
    refused(name, ENAMETOOLONG);
    name[230] = '\0';
    text_write(name, "x");
}

/* A limit on the file's size stands for a full disk. The reported error is that of the write,
 * long before the commit. */
static void failed_write_is_reported(void **state)
{
    (void)state;
    struct output_file out;
    text_write("a.png", "first");
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit before, small = {1000, 0};
    getrlimit(RLIMIT_FSIZE, &before);
    small.rlim_max = before.rlim_max;
    assert_true(output_file_open(&out, "a.png"));
    setvbuf(out.stream, NULL, _IONBF, 0);
    setrlimit(RLIMIT_FSIZE, &small);
    for (int i = 0; i < 2000; i++)
        fputc('x', out.stream);
    assert_false(output_file_commit(&out));
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(out.error, EFBIG);
    content_is("a.png", "first");
    assert_int_equal(names_count(), 1);
}

/* Forks a child that begins a file, writes, reports, and is killed. */
static void die_while_writing(const char *name)
{
    int ends[2];
    char byte;
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        struct output_file out;
        if (output_file_open(&out, name) && fputs("half", out.stream) >= 0 &&
            !fflush(out.stream))
            (void)!write(ends[1], "x", 1);
        pause();
    }
    close(ends[1]);
    assert_int_equal(read(ends[0], &byte, 1), 1);
    close(ends[0]);
    kill(child, SIGKILL);
    assert_int_equal(waitpid(child, NULL, 0), child);
}

static void part_files_of_the_dead_are_swept(void **state)
{
    (void)state;
    struct output_file living;
    text_write("a.png", "first"); /* this process has swept here once already */
    assert_true(output_file_open(&living, "living.png"));
    die_while_writing("a.png");
    FILE *other = fopen(".a.png.tooshort.part", "wb"); /* not of our kind */
    fclose(other);
    assert_int_equal(names_count(), 4);
    int folder = open(".", O_RDONLY | O_DIRECTORY);
    output_file_sweep(folder);
    close(folder);
    assert_int_equal(names_count(), 3);
    assert_true(output_file_commit(&living)); /* one that somebody is writing stays */
    content_is("a.png", "first");
}

/* The first file that a process opens in a folder sweeps the folder. */
static void next_process_sweeps(void **state)
{
    (void)state;
    die_while_writing("a.png");
    assert_int_equal(names_count(), 1);
    pid_t child = fork();
    if (child == 0) {
        struct output_file out;
        _exit(output_file_open(&out, "b.png") && output_file_commit(&out) ? 0 : 1);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    assert_int_equal(names_count(), 1);
    content_is("b.png", "");
}

/* Several processes write the same two names and sweep all the time. Each file is always the
 * whole file of one of them. */
static void writers_do_not_disturb_each_other(void **state)
{
    (void)state;
    enum { WRITERS = 4, ROUNDS = 200 };
    for (int w = 0; w < WRITERS; w++)
        if (fork() == 0) {
            int folder = open(".", O_RDONLY | O_DIRECTORY);
            for (int i = 0; i < ROUNDS; i++) {
                struct output_file out;
                output_file_sweep(folder);
                if (!output_file_open(&out, i % 2 ? "a.png" : "b.png"))
                    _exit(1);
                for (int k = 0; k < 1000; k++)
                    fputc('a' + w, out.stream);
                if (i % 7 == 0)
                    output_file_abandon(&out);
                else if (!output_file_commit(&out))
                    _exit(2);
            }
            _exit(0);
        }
    for (int w = 0; w < WRITERS; w++) {
        int status;
        assert_true(wait(&status) > 0);
        assert_int_equal(status, 0);
    }
    assert_int_equal(names_count(), 2);
    for (const char *name = "a.png"; name; name = *name == 'a' ? "b.png" : NULL) {
        char whole[1001];
        FILE *f = fopen(name, "rb");
        assert_int_equal(fread(whole, 1, sizeof whole, f), 1000);
        fclose(f);
        for (int k = 1; k < 1000; k++)
            assert_int_equal(whole[k], whole[0]);
    }
}

#define CASE(f) cmocka_unit_test_setup_teardown(f, folder_enter, folder_leave)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(commit_gives_the_name),
        CASE(abandon_leaves_what_was_there),
        CASE(part_can_be_opened_by_path),
        CASE(what_is_no_regular_file_is_refused),
        CASE(what_comes_to_have_the_name_meanwhile_is_refused),
        CASE(long_names_are_refused),
        CASE(failed_write_is_reported),
        CASE(part_files_of_the_dead_are_swept),
        CASE(next_process_sweeps),
        CASE(writers_do_not_disturb_each_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
