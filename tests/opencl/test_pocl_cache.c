/* Tests pocl_cache.h on a folder that is laid out as PoCL does: the programs that were used
 * last longest ago go, and nothing that is no program does. */
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "pocl_cache.h"

enum { PROGRAMS = 60 };

static char folder[] = "/tmp/lutetia-kept-XXXXXX";

static void make(const char *path, int kind)
{
    char all[300];
    snprintf(all, sizeof all, "%s/%s", folder, path);
    int file = kind == S_IFDIR ? mkdir(all, 0700) : open(all, O_WRONLY | O_CREAT, 0600);
    assert_true(file >= 0);
    if (kind != S_IFDIR)
        close(file);
}

static bool is_there(const char *path)
{
    char all[300];
    snprintf(all, sizeof all, "%s/%s", folder, path);
    return access(all, F_OK) == 0;
}

/* The name of program i, and of a file in it. */
static const char *name_of(int i, const char *file)
{
    static char name[200];
    snprintf(name, sizeof name, "%c%c/PONMLKJIHGFEDCBAPONMLKJIHGFEDCBAPOP%c%c%s%s", 'A' + i % 4,
             'B', 'A' + i / 16, 'A' + i % 16, *file ? "/" : "", file);
    return name;
}

/* Program i was used so many hours ago. */
static int hours_of(int i)
{
    return i * 7 % PROGRAMS;
}

static void programs_make(void)
{
    const char *const letters[] = {"AB", "BB", "CB", "DB"};
    for (int i = 0; i < 4; i++)
        make(letters[i], S_IFDIR);
    for (int i = 0; i < PROGRAMS; i++) {
        char path[300];
        struct timespec times[2];
        make(name_of(i, ""), S_IFDIR);
        make(name_of(i, "program.bc"), S_IFREG);
        make(name_of(i, "k"), S_IFDIR);
        make(name_of(i, "k/k.so"), S_IFREG);
        make(name_of(i, "last_accessed"), S_IFREG);
        clock_gettime(CLOCK_REALTIME, times);
        times[0].tv_sec -= 3600L * hours_of(i);
        times[1] = times[0];
        snprintf(path, sizeof path, "%s/%s", folder, name_of(i, "last_accessed"));
        assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
    }
}

static void the_oldest_programs_go(void **state)
{
    char command[100];
    (void)state;
    assert_non_null(mkdtemp(folder));
    programs_make();
    make("AB/short", S_IFDIR);
    make("AB/short/last_accessed", S_IFREG);
    make("AB/PONMLKJIHGFEDCBAPONMLKJIHGFEDCBAPOPXX", S_IFDIR);
    make("tempfile", S_IFREG);
    assert_int_equal(pocl_cache_trim(folder, PROGRAMS, 0), 0);
    assert_int_equal(pocl_cache_trim(folder, 40, 0), PROGRAMS - 40);
    for (int i = 0; i < PROGRAMS; i++)
        assert_int_equal(is_there(name_of(i, "")), hours_of(i) < 40);
    /* one that may be in use is kept, however many there are */
    assert_int_equal(pocl_cache_trim(folder, 0, 3600 * 29.5), 10);
    assert_true(is_there("AB/short/last_accessed") && is_there("tempfile") &&
                is_there("AB/PONMLKJIHGFEDCBAPONMLKJIHGFEDCBAPOPXX"));
    assert_int_equal(pocl_cache_trim("/tmp/lutetia-nothing-is-here", 0, 0), 0);
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    assert_int_equal(system(command), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_oldest_programs_go)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
