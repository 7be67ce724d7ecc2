/* test_program.c - demonstrations that are programs in C/Paris: their lights and displays are
 * seen, what they print is told, and what becomes of those that are not compiled, never end,
 * fork, print without end, take memory, want files, crash. (security.md 39, 40) */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <jail.h>

#include "../skip.h"
#include "shown.h"

enum { WIDTH = 96, HEIGHT = 96 };

static char folder[] = "/tmp/lutetia-test-program-XXXXXX";

static struct demonstration *start_within(const char *program, double answer_s, int memory_mb)
{
    struct demonstration_def def =
        demonstration_def_default(program, strlen(program), WIDTH, HEIGHT);
    struct demonstration *d;
    def.program = true;
    def.answer_s = answer_s;
    def.memory_mb = memory_mb;
    if (!demonstration_start(&def, &d))
        fail_msg("%s", demonstration_error());
    return d;
}

static struct demonstration *start(const char *program)
{
    return start_within(program, 60, 512);
}

/* Asks for pictures until it has printed so many lines. */
static void prints(struct demonstration *d, long lines)
{
    while (demonstration_lines(d) < lines)
        if (!shown_wait(d, 1) && demonstration_lines(d) < lines)
            fail_msg("it has ended: %s", demonstration_ended(d));
}

static void line_is(struct demonstration *d, int line, const char *says)
{
    assert_non_null(demonstration_line(d, line));
    assert_string_equal(demonstration_line(d, line), says);
}

static long red(const struct demonstration *d)
{
    long sum = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        sum += demonstration_picture(d)[3 * i];
    return sum;
}

/* Names below the test's folder: what demonstrations have left. */
static int left(void)
{
    DIR *names = opendir(folder);
    int count = 0;
    for (struct dirent *e; (e = readdir(names));)
        count += e->d_name[0] != '.';
    closedir(names);
    return count;
}

static void ends_with(const char *program, const char *says)
{
    struct demonstration *d = start(program);
    shown_ends(d, says);
    demonstration_frame(d, 1); /* it does not run again */
    assert_false(demonstration_take(d));
    demonstration_stop(d);
    assert_int_equal(left(), 0);
}

/* ---- seen and told ---- */

#define MACHINE                                                                                \
    "#include <cm/paris.h>\n#include <stdio.h>\n#include <unistd.h>\n"                         \
    "static unsigned sides[2] = {64, 64};\n"                                                   \
    "static void machine (void)\n{\n    CM_init ();\n"                                         \
    "    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (sides, 2)));\n"                \
    "    CM_set_context ();\n}\n"

/* Each latch is a picture, in order, however long the window takes. */
static void lights_are_seen(void **state)
{
    (void)state;
    struct demonstration *d =
        start(MACHINE "int main (void)\n{\n    int i;\n    CM_field_id_t on;\n    machine ();\n"
                      "    on = CM_allocate_stack_field (1);\n"
                      "    for (i = 0; i < 40; i++) {\n"
                      "        CM_u_move_constant_1L (on, i % 2, 1);\n"
                      "        CM_latch_leds (on);\n    }\n"
                      "    printf (\"that was all\\n\");\n    return 0;\n}\n");
    long dark = 0, bright = 0, changes = 0, was = -1;
    while (shown_wait(d, 1)) {
        const long now = red(d);
        changes += was >= 0 && now != was;
        was = now;
        dark = dark && dark < now ? dark : now;
        bright = bright > now ? bright : now;
    }
    assert_string_equal(demonstration_ended(d), "the program has come to its end");
    assert_true(bright > 2 * dark);
    assert_true(changes >= 39); /* the first may be as dark as before */
    line_is(d, 0, "that was all");
    demonstration_stop(d);
    assert_int_equal(left(), 0);
}

static void displays_are_seen(void **state)
{
    (void)state;
    struct demonstration *d =
        start("#include <cm/cmfb.h>\n" MACHINE "int main (void)\n{\n    CM_field_id_t x;\n"
              "    CMFB_display_id_t screen;\n    machine ();\n"
              "    screen = CMFB_attach_display (\"\");\n"
              "    CMFB_initialize_display (screen, 8, 64, 64);\n"
              "    x = CM_allocate_stack_field (8);\n"
              "    CM_my_news_coordinate_1L (x, 1, 8);\n"
              "    CMFB_write_news_always (screen, 0, x, 0, 0);\n    return 0;\n}\n");
    shown_ends(d, "come to its end");
    shown_is(d, WIDTH, 0, 0, 0, 0, 0); /* 64 pixels in the middle of 96 */
    shown_is(d, WIDTH, 16 + 20, 16 + 50, 20, 20, 20);
    shown_is(d, WIDTH, 16 + 63, 16 + 3, 63, 63, 63);
    demonstration_stop(d);
}

static void lines_come_as_they_are_printed(void **state)
{
    (void)state;
    struct demonstration *d =
        start("#include <stdio.h>\n#include <unistd.h>\nint main (void)\n{\n    int i;\n"
              "    for (i = 0; ; i++) {\n        printf (\"line %d \\033[2J\\n\", i);\n"
              "        usleep (20000);\n    }\n}\n");
    prints(d, 12);
    assert_null(demonstration_line(d, DEMONSTRATION_LINES));
    char last[40], shown[80];
    snprintf(last, sizeof last, "line %ld ", demonstration_lines(d) - 1);
    snprintf(shown, sizeof shown, "%s", demonstration_line(d, DEMONSTRATION_LINES - 1));
    assert_memory_equal(shown, last, strlen(last));
    assert_null(strchr(shown, '\033'));
    demonstration_stop(d);
    assert_int_equal(left(), 0);
}

/* ---- not compiled ---- */

static void mistakes_are_told_with_their_lines(void **state)
{
    (void)state;
    struct demonstration *d = start("int main (void)\n{\n    return nothing;\n}\n");
    shown_ends(d, "it was not compiled: program.c:3:");
    assert_non_null(strstr(demonstration_line(d, 0), "program.c:3:"));
    demonstration_stop(d);
    ends_with("int main (void) { return missing (); }", "undefined reference");
    ends_with("", "it was not compiled");
    ends_with("#error no \033[2J escape\n", "no \\x1b[2J escape");
    ends_with("#include \"program.c\"\n", "nested");
}

/* Files of the user's are not there for a compiler either. */
static void compilers_read_what_is_installed(void **state)
{
    char program[300], path[100];
    (void)state;
    snprintf(path, sizeof path, "%s/../lutetia-test-secret.h", folder);
    FILE *secret = fopen(path, "w");
    assert_non_null(secret);
    fputs("secret of the user\n", secret);
    fclose(secret);
    snprintf(program, sizeof program, "#include \"%s\"\n", path);
    ends_with(program, "Permission denied");
    snprintf(program, sizeof program,
             "asm (\".incbin \\\"%s\\\"\");\nint main (void) { return 0; }\n", path);
    struct demonstration *d = start(program);
    shown_ends(d, "it was not compiled");
    demonstration_stop(d);
    unlink(path);
    ends_with("#include \"/etc/passwd\"\n", "Permission denied");
    ends_with("#include \"/proc/self/environ\"\n", "it was not compiled");
    ends_with("#include \"/dev/zero\"\n", "it was not compiled");
}

/* Macros of which each is ten of the one before, and an array that would fill the disk. */
static void compilers_end(void **state)
{
    char program[4000];
    int at = snprintf(program, sizeof program, "#define A0 1,1,1,1,1,1,1,1,1,1\n");
    (void)state;
    for (int i = 1; i < 12; i++)
        at += snprintf(program + at, sizeof program - (size_t)at,
                       "#define A%d A%d,A%d,A%d,A%d,A%d,A%d,A%d,A%d,A%d,A%d\n", i, i - 1, i - 1,
                       i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1, i - 1);
    snprintf(program + at, sizeof program - (size_t)at,
             "int all[] = {A11};\nint main (void) { return 0; }\n");
    struct demonstration *d = start_within(program, 0.5, 512);
    shown_ends(d, "it was not compiled");
    demonstration_stop(d);
    assert_int_equal(left(), 0);
    d = start("char all[2000000000] = {1};\nint main (void) { return all[7]; }\n");
    shown_ends(d, "it was not compiled");
    demonstration_stop(d);
    assert_int_equal(left(), 0);
}

static void no_compiler_is_told(void **state)
{
    (void)state;
    setenv("CC", "/nowhere/cc", 1);
    ends_with("int main (void) { return 0; }", "install a C compiler");
    unsetenv("CC");
}

/* ---- hostile ---- */

#define WITH                                                                                   \
    "#define _GNU_SOURCE\n#include <errno.h>\n#include <fcntl.h>\n#include <pthread.h>\n"      \
    "#include <signal.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n"      \
    "#include <sys/socket.h>\n#include <sys/stat.h>\n#include <unistd.h>\n"

static void crashes_are_told(void **state)
{
    (void)state;
    ends_with("int main (void) { return *(volatile int *) 0; }",
              "ended by a signal: Segmentation fault");
    ends_with(WITH "int main (void) { abort (); }", "ended by a signal: Aborted");
    ends_with("int main (void) { return 7; }", "ended with status 7");
    ends_with(MACHINE "int main (void) { machine (); CM_u_move_zero_1L (12345, 8); return 0; }",
              "ended with status");
}

static void programs_reach_nothing(void **state)
{
    (void)state;
    struct demonstration *d = start(
        WITH
        "#define T(x) if ((x) >= 0) { printf (\"it did \" #x \"\\n\"); return 1; }\n"
        "int main (void)\n{\n"
        "T (open (\"/etc/passwd\", O_RDONLY));\nT (open (\"/proc/1/status\", 0));\n"
        "T (open (\"/root\", O_RDONLY));\nT (open (\"/home\", O_RDONLY));\n"
        "T (open (\"/tmp\", O_RDONLY));\nT (open (\"/var\", O_RDONLY));\n"
        "T (open (\"program.c\", O_WRONLY));\nT (open (\"x\", O_CREAT | O_RDWR, 384));\n"
        "T (open (\"program.c\", O_RDONLY | O_TRUNC));\n"
        "T (truncate (\"program.c\", 0));\nT (unlink (\"program.c\"));\n"
        "T (rename (\"program.c\", \"other.c\"));\nT (symlink (\"/\", \"root\"));\n"
        "T (mkdir (\"x\", 448));\nT (chmod (\"program.c\", 0));\n"
        "T (chown (\"program.c\", 0, 0));\nT (utimensat (AT_FDCWD, \"program.c\", 0, 0));\n"
        "T (socket (AF_UNIX, SOCK_STREAM, 0));\nT (socket (AF_INET, SOCK_STREAM, 0));\n"
        "T (fork ());\nT (vfork ());\nT (setsid ());\nT (setpgid (0, 0));\n"
        "T (kill (getppid (), 0));\nT (kill (1, 0));\nT (kill (-1, 0));\n"
        "T (kill (0, 0));\nT (open (\"/dev/tty\", O_RDWR));\n"
        "T (fcntl (0, F_SETOWN, 1));\n"
        "if (getenv (\"LUTETIA_TEST_SECRET\")) return 1;\n"
        "{ FILE *p = popen (\"echo it did run\", \"r\"); if (p) return 1; }\n"
        "printf (\"nothing\\n\");\nreturn 0;\n}\n");
    shown_ends(d, "");
    if (!demonstration_line(d, 0))
        fail_msg("it ended with '%s'", demonstration_ended(d));
    line_is(d, 0, "nothing");
    assert_string_equal(demonstration_ended(d), "the program has come to its end");
    demonstration_stop(d);
}

static void bombs_do_nothing(void **state)
{
    (void)state;
    struct demonstration *d = start_within(
        WITH "int main (void) { for (;;) if (fork () >= 0) printf (\"forked\\n\"); }", 0.5,
        512);
    shown_ends(d, "shown and printed nothing for too long");
    assert_int_equal(demonstration_lines(d), 0);
    demonstration_stop(d);
    ends_with(WITH "static void *sleeps (void *p) { for (;;) pause (); }\n"
                   "int main (void) { pthread_t t; pthread_attr_t a; pthread_attr_init (&a);\n"
                   "pthread_attr_setstacksize (&a, 65536);\n"
                   "for (;;) pthread_create (&t, &a, sleeps, 0); }",
              "more threads than it may");
    ends_with(WITH "int main (void) { for (;;) { char *p = malloc (1 << 20);\n"
                   "if (p) memset (p, 1, 1 << 20); } }",
              "more memory than its limit");
}

/* A milliard bytes of lines, and one line of as many: the window has eight, and stops it at
 * once. */
static void printing_has_bounds(void **state)
{
    static const char *const programs[] = {
        "#include <stdio.h>\nint main (void)\n{\n    long i;\n"
        "    for (i = 0; i < 100000000; i++)\n        printf (\"line %ld\\n\", i);\n"
        "    return 0;\n}\n",
        "#include <stdio.h>\nint main (void)\n{\n    long i;\n    printf (\"begins\\n\");\n"
        "    for (i = 0; i < 1000000000; i++)\n        putchar ('x');\n    return 0;\n}\n"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct demonstration *d = start(programs[i]);
        prints(d, 1);
        assert_true(shown_wait(d, 20));
        assert_null(demonstration_line(d, DEMONSTRATION_LINES));
        demonstration_stop(d);
        assert_int_equal(left(), 0);
    }
}

static void silence_ends(void **state)
{
    (void)state;
    struct demonstration *d =
        start_within("int main (void) { volatile int i = 0; for (;;) i++; }", 0.5, 512);
    shown_ends(d, "shown and printed nothing for too long");
    demonstration_stop(d);
    assert_int_equal(left(), 0);
}

/* What it says of its lights is read as bytes from outside are. */
static void forged_recordings_are_told(void **state)
{
    (void)state;
    ends_with(WITH
              "int main (void) { write (3, \"no lights at all, and more\", 26); pause (); }",
              "what it shows is damaged");
    ends_with(WITH "int main (void) { write (4, \"lutetia display 2\\n\", 18); pause (); }",
              "what it shows is damaged");
}

/* ---- resting, and the end ---- */

/* The state of the process that is called `program`; 0: there is none. */
static char program_state(void)
{
    DIR *processes = opendir("/proc");
    char state = 0;
    for (struct dirent *e; processes && (e = readdir(processes));) {
        char path[300], name[32], in[300];
        snprintf(path, sizeof path, "/proc/%s/cwd", e->d_name);
        const ssize_t length = readlink(path, in, sizeof in - 1);
        if (length < 0 || strncmp(in, folder, strlen(folder)) != 0)
            continue;
        snprintf(path, sizeof path, "/proc/%s/stat", e->d_name);
        FILE *file = fopen(path, "r");
        if (file && fscanf(file, "%*d (%31[^)]) %c", name, &state) != 2)
            state = 0;
        if (file)
            fclose(file);
        if (strcmp(name, "program") == 0)
            break;
        state = 0;
    }
    closedir(processes);
    return state;
}

static void state_becomes(char state)
{
    const struct timespec short_while = {0, 10000000};
    for (int i = 0; i < 2000; i++) {
        if (program_state() == state)
            return;
        nanosleep(&short_while, NULL);
    }
    fail_msg("its state is '%c', and not '%c'", program_state(), state);
}

static void rests_while_it_is_not_seen(void **state)
{
    (void)state;
    struct demonstration *d =
        start("#include <stdio.h>\nint main (void)\n{\n    volatile int i = 0;\n"
              "    printf (\"begun\\n\");\n    fflush (stdout);\n"
              "    for (;;)\n        i++;\n}\n");
    prints(d, 1);
    assert_int_equal(program_state(), 'R');
    state_becomes('T'); /* nobody asks */
    demonstration_frame(d, 0.01);
    state_becomes('R');
    state_becomes('T');
    demonstration_stop(d);
    assert_int_equal(program_state(), 0);
    assert_int_equal(left(), 0);
}

static void ends_with_the_window(void **state)
{
    int status;
    (void)state;
    const pid_t window = fork();
    if (window == 0) {
        struct demonstration *d = start("#include <stdio.h>\nint main (void)\n{\n    for (;;)\n"
                                        "        puts (\"alive\");\n}\n");
        prints(d, 1);
        _exit(EXIT_SUCCESS);
    }
    assert_int_equal(waitpid(window, &status, 0), window);
    assert_int_equal(status, 0);
    state_becomes(0);
    const struct timespec short_while = {0, 10000000};
    for (int i = 0; i < 2000 && left(); i++)
        nanosleep(&short_while, NULL);
    assert_int_equal(left(), 0);
}

static int begin(void **state)
{
    (void)state;
    setenv("LUTETIA_TEST_SECRET", "secret", 1);
    return mkdtemp(folder) && setenv("TMPDIR", folder, 1) == 0 ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_are_seen),
        cmocka_unit_test(displays_are_seen),
        cmocka_unit_test(lines_come_as_they_are_printed),
        cmocka_unit_test(mistakes_are_told_with_their_lines),
        cmocka_unit_test(compilers_read_what_is_installed),
        cmocka_unit_test(compilers_end),
        cmocka_unit_test(no_compiler_is_told),
        cmocka_unit_test(crashes_are_told),
        cmocka_unit_test(programs_reach_nothing),
        cmocka_unit_test(bombs_do_nothing),
        cmocka_unit_test(printing_has_bounds),
        cmocka_unit_test(silence_ends),
        cmocka_unit_test(forged_recordings_are_told),
        cmocka_unit_test(rests_while_it_is_not_seen),
        cmocka_unit_test(ends_with_the_window),
    };
    if (!jail_possible()) {
        print_message("this kernel has no Landlock\n");
        return 77;
    }
    return cmocka_run_group_tests(tests, begin, end);
}
