/* own_folder.h - a new folder for each test, which is left empty: cmocka's set-up and
 * tear-down. Include after cmocka's headers. */
#ifndef LUTETIA_TESTS_BASE_OWN_FOLDER_H
#define LUTETIA_TESTS_BASE_OWN_FOLDER_H

#include <dirent.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Makes a new folder and changes into it. */
static int folder_enter(void **state)
{
    char *folder = strdup("/tmp/lutetia-test-base-XXXXXX");
    if (!folder || !mkdtemp(folder) || chdir(folder))
        return -1;
    *state = folder;
    return 0;
}

static int folder_leave(void **state)
{
    char *folder = *state;
    DIR *names = opendir(folder);
    for (struct dirent *e; names && (e = readdir(names));)
        unlinkat(dirfd(names), e->d_name, 0);
    if (names)
        closedir(names);
    int status = chdir("/") || rmdir(folder);
    free(folder);
    return status;
}

/* How many files the folder has. */
static int names_count(void)
{
    int count = -2; /* . and .. */
    DIR *names = opendir(".");
    assert_non_null(names);
    while (readdir(names))
        count++;
    closedir(names);
    return count;
}

#endif
