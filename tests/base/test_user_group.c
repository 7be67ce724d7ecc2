/* test_user_group.c - a folder that a group may write to is this user's own
 * only if the group has nobody else, neither as a member nor as somebody's
 * first group. The lists of users and groups are the test's own. (security.md
 * 15) */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <user_folder.h>

#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { OTHER_USER = 1717, OTHER_GROUP = 1718, NOBODY = 65534 };

static char my_name[] = "wren", others_name[] = "robin";
static struct passwd users[2];
static char *members[2];
static size_t next_user;

/* ---- in the place of the C library's ---- */

int getpwuid_r(uid_t uid, struct passwd *out, char *room, size_t count, struct passwd **found)
{
    (void)room, (void)count;
    *out = users[0];
    *found = uid == users[0].pw_uid ? out : NULL;
    return 0;
}

int getgrgid_r(gid_t gid, struct group *out, char *room, size_t count, struct group **found)
{
    (void)room, (void)count;
    *out = (struct group){.gr_name = my_name, .gr_gid = gid, .gr_mem = members};
    *found = gid == users[0].pw_gid ? out : NULL;
    return 0;
}

void setpwent(void)
{
    next_user = 0;
}

struct passwd *getpwent(void)
{
    return next_user < 2 ? &users[next_user++] : NULL;
}

void endpwent(void)
{
}

/* ---- the test ---- */

/* 0, or the line that was not so. As root it becomes another user, for root's
 * folders are root's decision. */
static int looked(void)
{
    char path[] = "/tmp/lutetia-group-XXXXXX";
    if (getuid() == 0 && (setgid(NOBODY) != 0 || setuid(NOBODY) != 0))
        return __LINE__;
    users[0] = (struct passwd){.pw_name = my_name, .pw_uid = geteuid(), .pw_gid = getegid()};
    users[1] =
        (struct passwd){.pw_name = others_name, .pw_uid = OTHER_USER, .pw_gid = OTHER_GROUP};
    if (!mkdtemp(path) || chmod(path, 0770) != 0)
        return __LINE__;
    int line = user_folder_wrong(path) == NULL ? 0 : __LINE__;
    users[1].pw_gid = getegid(); /* his first group */
    const char *wrong = user_folder_wrong(path);
    if (!line && (!wrong || !strstr(wrong, "others may write")))
        line = __LINE__;
    users[1].pw_gid = OTHER_GROUP;
    members[0] = others_name; /* a member */
    if (!line && !user_folder_wrong(path))
        line = __LINE__;
    members[0] = my_name;
    if (!line && user_folder_wrong(path))
        line = __LINE__;
    if (!line && (chmod(path, 0707) != 0 || !user_folder_wrong(path)))
        line = __LINE__;
    rmdir(path);
    return line;
}

static void a_group_of_ones_own_has_nobody_else(void **state)
{
    (void)state;
    int status;
    const pid_t child = fork();
    if (child == 0)
        _exit(looked());
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_group_of_ones_own_has_nobody_else),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
