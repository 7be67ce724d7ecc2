/* test_documents.c DOCUMENT...: the demonstrations of these documents run: each draws, hears a
 * pointer and keys, and goes on with each of its controls at its least, its most and what is
 * usual. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>

#include <jail.h>

#include "shown.h"

enum { CHAPTER_LEAST = 2 }; /* so many has each */

static char **paths;
static int paths_count;

static char *file_text(const char *path)
{
    FILE *file = fopen(path, "r");
    char *text = NULL;
    size_t room = 0;
    if (!file || getdelim(&text, &room, '\0', file) < 0)
        fail_msg("%s cannot be read", path);
    fclose(file);
    return text;
}

static void runs(struct demonstration *d, const char *path, const char *script)
{
    if (!shown_wait(d, 1))
        fail_msg("%s: %s\n%.300s", path, demonstration_ended(d), script);
}

#ifdef __SANITIZE_ADDRESS__
static void program_pass(const char *path, const char *program, size_t bytes, int width,
                         int height)
{
    (void)path;
    (void)program;
    (void)bytes;
    (void)width;
    (void)height;
}
#else
/* A program shows more than one picture. */
static void program_try(const char *path, const char *program, size_t bytes, int width,
                        int height)
{
    struct demonstration_def def = demonstration_def_default(program, bytes, width, height);
    struct demonstration *d = NULL;
    uint8_t *first = malloc(3 * (size_t)width * (size_t)height);
    bool other = false;
    def.program = true;
    def.answer_s = def.patience_s = 200;
    if (!first || !demonstration_start(&def, &d))
        fail_msg("%s: %s", path, demonstration_error());
    runs(d, path, program);
    memcpy(first, demonstration_picture(d), 3 * (size_t)width * (size_t)height);
    for (int i = 0; i < 3000 && !other; i++) {
        runs(d, path, program);
        other = memcmp(first, demonstration_picture(d), 3 * (size_t)width * (size_t)height);
    }
    assert_true(other);
    demonstration_stop(d);
    free(first);
}
#endif

static void demonstration_try(const char *path, const char *script, size_t bytes, int width,
                              int height)
{
    struct demonstration_def def = demonstration_def_default(script, bytes, width, height);
    const struct demonstration_control *c;
    struct demonstration *d;
    def.answer_s = def.patience_s = 200; /* kernels may have to be compiled */
    if (!demonstration_start(&def, &d))
        fail_msg("%s: %s", path, demonstration_error());
    runs(d, path, script);
    for (int i = 0; (c = demonstration_control(d, i)); i++) {
        const double values[] = {c->least, c->most, c->usual};
        for (int k = 0; k < 3; k++) {
            demonstration_set(d, i, values[k]);
            demonstration_pointer(d, DEMONSTRATION_DOWN, width / 3.0, height / 2.0, 0.5);
            demonstration_pointer(d, DEMONSTRATION_MOVE, width / 2.0, height / 3.0, 1);
            runs(d, path, script);
            demonstration_pointer(d, DEMONSTRATION_UP, width / 2.0, height / 3.0, 0);
        }
    }
    demonstration_key(d, true, "a");
    demonstration_key(d, false, "a");
    runs(d, path, script);
    demonstration_stop(d);
}

/* How many there are. */
static int document_try(const char *path, const char *fence,
                        void (*one)(const char *, const char *, size_t, int, int))
{
    char *text = file_text(path);
    int count = 0;
    for (char *at = text; (at = strstr(at, fence)); count++) {
        int width = 0, height = 0;
        at += strlen(fence);
        if (sscanf(at, "%dx%d", &width, &height) != 2)
            fail_msg("%s: a fence says no sides", path);
        char *script = strchr(at, '\n') + 1, *end = strstr(script, "\n```");
        assert_non_null(end);
        end[1] = '\0';
        one(path, script, (size_t)(end + 1 - script), width, height);
        at = end + 2;
    }
    free(text);
    return count;
}

static void demonstrations_run(void **state)
{
    (void)state;
    for (int i = 0; i < paths_count; i++) {
        int count = document_try(paths[i], "\n```lua live ", demonstration_try);
#ifndef __SANITIZE_ADDRESS__ /* whose runtime must be the process's first library */
        if (jail_possible())
            count += document_try(paths[i], "\n```c paris ", program_try);
#else
        if (document_try(paths[i], "\n```c paris ", program_pass) > 0)
            continue;
#endif
        if (count < CHAPTER_LEAST && jail_possible())
            fail_msg("%s has %d demonstrations, not %d", paths[i], count, CHAPTER_LEAST);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(demonstrations_run)};
    paths = argv + 1;
    paths_count = argc - 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
