/* `lutetia cc` with C++. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "../skip.h"
#include "child.h"

static const char *lutetia;

/* The program of README.md, between its lines of ```c. */
static void readme_program_write(const char *to)
{
    char line[400];
    FILE *readme = fopen(README, "r"), *file = fopen(to, "w");
    bool inside = false, found = false;
    assert_non_null(readme);
    assert_non_null(file);
    while (fgets(line, sizeof line, readme)) {
        if (strncmp(line, "```", 3) == 0)
            inside = !found && strcmp(line, "```c\n") == 0;
        else if (inside)
            fputs(line, file);
        found = found || inside;
    }
    fclose(readme);
    fclose(file);
    assert_true(found);
}

/* The program of README.md under all names of C++, and C beside it. */
static void cc_compiles_cpp(void **unused)
{
    static const char *const names[] = {"heat.cc", "heat.cpp", "heat.cxx", "heat.C"};
    static char program[] = "cc-cpp-heat", c[] = "cc-cpp-part.c", source[64];
    (void)unused;
    if (system("c++ --version >/dev/null 2>&1") != 0)
        skip_because("there is no C++ compiler");
    FILE *file = fopen(c, "w");
    assert_non_null(file);
    fputs("int class = 3; int part (void) { return class; }\n", file); /* no C++ */
    fclose(file);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(source, sizeof source, "cc-cpp-%s", names[i]);
        readme_program_write(source);
        struct child compiler = {
            .arguments = {lutetia, "cc", source, "-Wall", "-Werror", "-o", program}};
        if (i == 1) {
            compiler.arguments[7] = c;
        }
        child_run(&compiler);
        if (compiler.status)
            fail_msg("%s: status %d and \"%s\"", names[i], compiler.status, compiler.errors);
#ifndef __SANITIZE_ADDRESS__ /* the linker warns of functions in the sanitizer's own library */
        assert_string_equal(compiler.errors, "");
#endif
        unlink(source);
    }
    struct child heat = {.arguments = {program}};
    child_run(&heat);
    assert_int_equal(heat.status, 0);
    assert_non_null(strstr(heat.output, "hottest: "));
    unlink(program);
    unlink(c);
}

int main(void)
{
    lutetia = getenv("LUTETIA");
    if (!lutetia) {
        fputs("LUTETIA must name the command to test\n", stderr);
        return 1;
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(cc_compiles_cpp)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
