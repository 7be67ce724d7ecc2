/* reader_played.c - see reader_played.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "reader_played.h"

static char folder[] = "/tmp/lutetia-reader-XXXXXX";
struct child played;

const char *played_path(const char *name)
{
    static char paths[8][128];
    static int next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

void played_write(const char *name, const char *text)
{
    FILE *file = fopen(played_path(name), "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* The latest time of these lines. */
static double last_s(const char *lines)
{
    double last = 0;
    for (const char *at = lines; *at; at += *at == '\n') {
        const double time = atof(at);
        last = time > last ? time : last;
        at += strcspn(at, "\n");
    }
    return last;
}

void played_run(const char *lines, const char *document)
{
    char all[4096];
    snprintf(all, sizeof all, "%s\n%g close\n", lines, last_s(lines) + 0.3);
    played_write("hand.events", all);
    memset(&played, 0, sizeof played);
    const char *const arguments[] = {
        getenv("LUTETIA"),         "read", document, "--theme", "light", "--play",
        played_path("hand.events")};
    memcpy(played.arguments, arguments, sizeof arguments);
    played.variables[0] = "GTK_A11Y=none"; /* no bus is needed for this */
    child_run(&played);
}

const char *played_told(const char *name, const char *what)
{
    static char lines[4][512];
    static int next;
    char *line = lines[next++ % 4];
    FILE *file = fopen(played_path(name), "r");
    const size_t length = strlen(what);
    if (!file)
        fail_msg("%s was not told: %s", name, played.errors);
    while (fgets(line, sizeof lines[0], file))
        if (strncmp(line, what, length) == 0 && line[length] == ' ') {
            fclose(file);
            line[strcspn(line, "\n")] = '\0';
            return line + length + 1;
        }
    fail_msg("%s says nothing of %s", name, what);
    return "";
}

void played_well(void)
{
    if (played.status != 0 || played.errors[0])
        print_message("%s", played.errors);
    assert_int_equal(played.status, 0);
    assert_string_equal(played.errors, "");
}

void played_window(void)
{
    played.variables[0] = "GTK_A11Y=none"; /* no bus is needed for this */
    child_run(&played);
    played_well();
}

void played_says(int status, const char *what)
{
    if (played.status != status || !strstr(played.errors, what))
        print_message("%d: %s", played.status, played.errors);
    assert_int_equal(played.status, status);
    const char *line = strstr(played.errors, "lutetia read: ");
    assert_non_null(line);
    assert_non_null(strstr(line, what));
    assert_null(strstr(line + 1, "lutetia read: "));
}

int played_begin(void **state)
{
    (void)state;
    return mkdtemp(folder) ? setenv("XDG_DATA_HOME", folder, 1) : -1;
}

int played_end(void **state)
{
    char command[160];
    (void)state;
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}
