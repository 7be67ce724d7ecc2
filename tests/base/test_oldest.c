/* Tests oldest.h: of a folder's entries the oldest go, folders with all that is in them, links
 * without what they lead to; those that were used lately stay, and so does what was never
 * added. */
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "oldest.h"

enum { FILES = 40 };

static char folder[] = "/tmp/lutetia-oldest-XXXXXX";
static int at;

static int begin(void **state)
{
    (void)state;
    strcpy(strchr(folder, '-') + 1, "oldest-XXXXXX");
    at = mkdtemp(folder) ? open(folder, O_RDONLY | O_DIRECTORY) : -1;
    return at < 0;
}

static int end(void **state)
{
    char command[100];
    (void)state;
    close(at);
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command) != 0;
}

static void aged(const char *name, long seconds)
{
    struct timespec now, times[2];
    clock_gettime(CLOCK_REALTIME, &now);
    now.tv_sec -= seconds;
    times[0] = times[1] = now;
    assert_int_equal(utimensat(at, name, times, AT_SYMLINK_NOFOLLOW), 0);
}

static void file_make(const char *name, long seconds)
{
    int file = openat(at, name, O_WRONLY | O_CREAT, 0600);
    assert_true(file >= 0);
    close(file);
    aged(name, seconds);
}

static bool is_there(const char *name)
{
    return faccessat(at, name, F_OK, AT_SYMLINK_NOFOLLOW) == 0;
}

static void the_oldest_go(void **state)
{
    char name[20];
    (void)state;
    struct oldest o = {.folder = at};
    for (int i = 0; i < FILES; i++) { /* ages in another order than names */
        snprintf(name, sizeof name, "file%d", i);
        file_make(name, i * 7 % FILES * 100);
        oldest_add(&o, name, NULL);
    }
    file_make("other", 100000);
    oldest_add(&o, "none", NULL);
    assert_int_equal(o.count, FILES);
    assert_int_equal(oldest_remove(&o, 15, 0), FILES - 15);
    assert_int_equal(o.count, 0);
    for (int i = 0; i < FILES; i++) {
        snprintf(name, sizeof name, "file%d", i);
        assert_int_equal(is_there(name), i * 7 % FILES < 15);
        if (is_there(name))
            oldest_add(&o, name, NULL);
    }
    assert_true(is_there("other"));
    assert_int_equal(oldest_remove(&o, 0, 1000 - 50),
                     5); /* of ages 0 to 1400, those of 1000 and more */
}

static void folders_go_with_what_is_in_them(void **state)
{
    (void)state;
    struct oldest o = {.folder = at};
    assert_int_equal(mkdirat(at, "old", 0700) | mkdirat(at, "old/inner", 0700) |
                         mkdirat(at, "new", 0700) | mkdirat(at, "bare", 0700) |
                         mkdirat(at, "kept", 0700),
                     0);
    file_make("kept/file", 5000);
    file_make("old/inner/file", 10);
    file_make("old/stamp", 2000);
    file_make("new/stamp", 10);
    assert_int_equal(symlinkat("../../kept", at, "old/inner/link"), 0);
    assert_int_equal(symlinkat("kept", at, "link"), 0);
    aged("link", 3000);
    oldest_add(&o, "old", "stamp");
    oldest_add(&o, "new", "stamp");
    oldest_add(&o, "bare", "stamp");
    oldest_add(&o, "link", NULL);
    assert_int_equal(o.count, 3);
    assert_int_equal(oldest_remove(&o, 1, 0), 2);
    assert_true(is_there("new/stamp") && is_there("bare") && is_there("kept/file"));
    assert_false(is_there("old") || is_there("link"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_oldest_go, begin, end),
        cmocka_unit_test_setup_teardown(folders_go_with_what_is_in_them, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
