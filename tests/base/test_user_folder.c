/* test_user_folder.c - caches are in folders where no other user can put a file, or private to
 * the process. (security.md 15) */
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <user_folder.h>

static char home[PATH_MAX];

/* Runs a shell command, always a literal of this test, in the test's home. */
static void shell(const char *command)
{
    assert_int_equal(chdir(home), 0);
    assert_int_equal(system(command), 0);
}

static int home_make(void **state)
{
    (void)state;
    snprintf(home, sizeof home, "/tmp/test-user-folder-XXXXXX");
    if (!mkdtemp(home))
        return -1;
    return setenv("HOME", home, 1) || unsetenv("XDG_CACHE_HOME");
}

static int home_remove(void **state)
{
    (void)state;
    char command[PATH_MAX + 16];
    snprintf(command, sizeof command, "rm -rf '%s'", home);
    return chdir("/") || system(command);
}

static bool is_in(const char *path, const char *folder)
{
    return strncmp(path, folder, strlen(folder)) == 0;
}

static void cache_is_in_home_and_for_its_user_alone(void **state)
{
    (void)state;
    char folder[USER_FOLDER_MAX], wanted[PATH_MAX];
    const char *why = "unset";
    struct stat status;
    assert_true(user_cache_folder("lutetia/deep", folder, &why));
    assert_null(why);
    snprintf(wanted, sizeof wanted, "%.400s/.cache/lutetia/deep", home);
    assert_string_equal(folder, wanted);
    assert_int_equal(stat(folder, &status), 0);
    assert_int_equal(status.st_mode & 0777, 0700);
    snprintf(wanted, sizeof wanted, "%.400s/xdg", home);
    setenv("XDG_CACHE_HOME", wanted, 1);
    assert_true(user_cache_folder("lutetia", folder, NULL));
    assert_true(is_in(folder, wanted));
}

/* Checks that the folder is refused with this reason and that a temporary one replaces it. */
static void is_refused(const char *expected)
{
    char folder[USER_FOLDER_MAX];
    const char *why = NULL;
    assert_true(user_cache_folder("lutetia", folder, &why));
    assert_non_null(why);
    assert_non_null(strstr(why, expected));
    assert_false(is_in(folder, home));
    assert_null(user_folder_wrong(folder));
}

static void folders_of_others_are_refused(void **state)
{
    (void)state;
    shell("mkdir -p .cache/lutetia && chmod 777 .cache/lutetia");
    is_refused("others may write to it");
    shell("rmdir .cache/lutetia && mkdir elsewhere && ln -s ../elsewhere .cache/lutetia");
    is_refused("it is a link");
    shell("rm .cache/lutetia && touch .cache/lutetia");
    is_refused("it is no folder");
    shell("rm .cache/lutetia && chmod 777 .cache");
    is_refused("others may write to a folder above it");
    shell("rm -rf .cache && chmod 1777 .");
    char folder[USER_FOLDER_MAX];
    const char *why;
    assert_true(user_cache_folder("lutetia", folder,
                                  &why)); /* as in /tmp, others cannot replace our files */
    assert_null(why);
    if (geteuid() == 0) {
        shell("chown 65534 .cache/lutetia");
        is_refused("it belongs to another user");
        shell("chown 0 .cache/lutetia && chown 65534 .cache");
        is_refused("a folder above it belongs to another user");
    }
}

static void home_behind_a_link_is_checked_where_it_leads(void **state)
{
    (void)state;
    char folder[USER_FOLDER_MAX], link[PATH_MAX];
    const char *why;
    shell("mkdir -p disk/me && ln -s disk/me link");
    snprintf(link, sizeof link, "%.400s/link", home);
    setenv("HOME", link, 1);
    assert_true(user_cache_folder("lutetia", folder, &why));
    assert_null(why);
    shell("rm -rf disk/me/.cache && chmod 777 disk");
    is_refused("others may write to a folder above it");
}

/* Starts a process without HOME and reads its cache's path. */
static pid_t homeless_start(char path[static USER_FOLDER_MAX], bool killed)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    if (child == 0) {
        char folder[USER_FOLDER_MAX] = "";
        unsetenv("HOME");
        unsetenv("XDG_CACHE_HOME");
        if (!user_cache_folder("lutetia", folder, NULL))
            _exit(1);
        FILE *f =
            fopen(strcat(strcpy(path, folder), "/kept"), "wb"); /* it is not empty at the end */
        if (f)
            fclose(f);
        (void)!write(ends[1], folder, sizeof folder);
        if (killed)
            pause();
        exit(0);
    }
    close(ends[1]);
    assert_int_equal(read(ends[0], path, USER_FOLDER_MAX), USER_FOLDER_MAX);
    close(ends[0]);
    return child;
}

static void temporary_folder_goes_with_its_process(void **state)
{
    (void)state;
    char ended[USER_FOLDER_MAX], killed[USER_FOLDER_MAX], next[USER_FOLDER_MAX];
    setenv("TMPDIR", home, 1);
    assert_int_equal(waitpid(homeless_start(ended, false), NULL, 0) > 0, 1);
    assert_int_not_equal(access(ended, F_OK), 0);
    pid_t child = homeless_start(killed, true);
    assert_int_equal(access(killed, F_OK), 0);
    kill(child, SIGKILL);
    assert_int_equal(waitpid(child, NULL, 0), child);
    assert_int_equal(access(killed, F_OK), 0);
    assert_int_equal(waitpid(homeless_start(next, false), NULL, 0) > 0, 1);
    assert_int_not_equal(access(killed, F_OK), 0); /* swept by the next */
    unsetenv("TMPDIR");
}

#define CASE(f) cmocka_unit_test_setup_teardown(f, home_make, home_remove)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(temporary_folder_goes_with_its_process), /* first: children inherit the folder */
        CASE(cache_is_in_home_and_for_its_user_alone),
        CASE(home_behind_a_link_is_checked_where_it_leads),
        CASE(folders_of_others_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
