/* child.h - runs a command as a user would, and keeps its outputs.
 *
 *     struct child child = {.arguments = {lutetia, "paint", "x", "-o", "/proc/x.png"}};
 *     child_run(&child);
 *     assert_int_equal(child.status, 1);
 *     assert_non_null(strstr(child.errors, "/proc/x.png"));
 */
#ifndef LUTETIA_TEST_CHILD_H
#define LUTETIA_TEST_CHILD_H

#include <stdbool.h>

enum { CHILD_ARGUMENTS_MAX = 48, CHILD_TEXT_MAX = 1 << 16 };

struct child {
    const char *arguments[CHILD_ARGUMENTS_MAX]; /* NULL ends them */
    const char *variables[4]; /* NAME=value, added to the environment; NULL ends the list */
    long file_bytes_max;      /* 0: no limit; stands for a full disk */
    int interrupt_after_ms;   /* 0: never */
    bool output_full;         /* the standard output is /dev/full */

    int status; /* exit status, or 1000 + the signal that ended it */
    char output[CHILD_TEXT_MAX], errors[CHILD_TEXT_MAX];
};

void child_run(struct child *child);
/* Runs it. Whether it ended with that status, and its errors say that in so many lines. */
bool child_says(struct child *child, int status, const char *says, int lines);

#endif
