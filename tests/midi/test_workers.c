/* test_workers.c - which workers of the system's go before other programs, and for how long. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include <midi_server.h>
#include <server_workers.h>

#include "../display/scratch.h"

#include <errno.h>
#include <poll.h>
#include <sched.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const uint64_t SECOND_NS = 1000000000;

static void written(const char *folder, const char *name, const char *text)
{
    char path[600];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    for (char *slash = path + strlen(folder) + 1; (slash = strchr(slash, '/')); slash++) {
        *slash = 0;
        assert_true(mkdir(path, 0700) == 0 || errno == EEXIST);
        *slash = '/';
    }
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void only_unbound_workers_of_the_kernel(void **unused)
{
    (void)unused;
    char proc[512];
    pid_t found[WORKERS_MAX];
    snprintf(proc, sizeof proc, "%s", scratch_path("proc"));
    assert_true(mkdir(proc, 0700) == 0 || errno == EEXIST);
    assert_int_equal(workers_find(proc, found), -1);
    assert_int_equal(errno, ENOENT);
    written(proc, "2/comm", "sh\n"); /* a container's second process */
    written(proc, "2/task/2/children", "12 ");
    written(proc, "12/comm", "kworker/u8:0-events_unbound\n");
    assert_int_equal(workers_find(proc, found), -1);
    written(proc, "2/comm", "kthreadd\n");
    written(proc, "2/task/2/children", "7 10 12 35 48 8542 ");
    written(proc, "7/comm", "kworker/R-slub_\n");
    written(proc, "10/comm", "kworker/0:0H-ev\n");
    written(proc, "48/comm", "ksoftirqd/1\n");
    written(proc, "8542/comm", "kworker/u8:3\n"); /* 35 has just ended */
    written(proc, "99/comm", "kworker/u8:4\n");   /* nobody's child of the kernel */
    assert_int_equal(workers_find(proc, found), 2);
    assert_int_equal(found[0], 12);
    assert_int_equal(found[1], 8542);
}

/* Until all workers that there are have real-time priority, or none has. */
static bool priority_comes(bool first)
{
    for (int i = 0; i < 200; i++) {
        pid_t found[WORKERS_MAX];
        const int count = workers_find("/proc", found);
        int as_wanted = 0;
        for (int k = 0; k < count; k++) {
            const int policy = sched_getscheduler(found[k]);
            as_wanted += policy < 0 || policy == (first ? SCHED_FIFO : SCHED_OTHER);
        }
        if (count > 0 && as_wanted == count)
            return true;
        poll(NULL, 0, 10);
    }
    return false;
}

static void first_while_messages_come(void **unused)
{
    (void)unused;
    const char *why;
    struct server_workers *w = workers_create("/proc", &why);
    if (!w || !priority_comes(false)) { /* or another server has raised them */
        print_message("workers: %s\n", w ? "others have raised them" : why);
        workers_destroy(w);
        skip();
    }
    workers_look(w, 0, 1 * SECOND_NS);
    assert_false(workers_first(w)); /* nobody has played */
    workers_look(w, 3, 2 * SECOND_NS);
    assert_true(workers_first(w));
    assert_true(priority_comes(true));
    workers_look(w, 3, 11 * SECOND_NS);
    assert_true(workers_first(w));
    workers_look(w, 3, 12 * SECOND_NS); /* ten seconds after the last one */
    assert_false(workers_first(w));
    assert_true(priority_comes(false));
    workers_look(w, 4, 20 * SECOND_NS);
    assert_true(priority_comes(true));
    workers_destroy(w);
    assert_true(priority_comes(false));
}

static void not_known(void **unused)
{
    (void)unused;
    const char *why = NULL;
    assert_null(workers_create(scratch_path("nowhere"), &why));
    assert_string_equal(why, "the system's workers are not seen from here");
    workers_look(NULL, 1, SECOND_NS);
    assert_false(workers_first(NULL));
    workers_destroy(NULL);
}

static void line_counted(void *context, const char *line)
{
    *(int *)context += strstr(line, "terminals' bytes") != NULL;
}

/* Allowed or not, the server says what came of it, and only where it was asked. */
static void server_says_it(void **unused)
{
    (void)unused;
    for (int asked = 0; asked <= 1; asked++) {
        const char *const devices[] = {"loop"};
        int told = 0;
        const struct midi_server_def def = {.path = scratch_path("socket"),
                                            .devices = devices,
                                            .devices_count = 1,
                                            .terminals_first = asked,
                                            .log = line_counted,
                                            .context = &told};
        struct midi_server *server;
        assert_int_equal(midi_server_create(&def, &server), MIDI_OK);
        midi_server_destroy(server);
        assert_int_equal(told, asked);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_unbound_workers_of_the_kernel),
        cmocka_unit_test(first_while_messages_come),
        cmocka_unit_test(not_known),
        cmocka_unit_test(server_says_it),
    };
    return cmocka_run_group_tests_name("workers", tests, NULL, NULL);
}
