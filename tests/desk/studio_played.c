/* studio_played.c - see studio_played.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "studio_played.h"

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/lutetia-studio-XXXXXX";
struct child played;

int played_folder_make(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    setenv("XDG_DATA_HOME", folder, 1); /* where sheets are kept that were not saved */
    return 0;
}

int played_folder_remove(void **state)
{
    char command[160];
    (void)state;
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

const char *played_path(const char *name)
{
    static char paths[8][128];
    static int next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

FILE *played_begin(void)
{
    FILE *file = fopen(played_path("hand.events"), "w");
    assert_non_null(file);
    return file;
}

static void run(const char *variable)
{
    played.variables[0] = "GTK_A11Y=none"; /* no bus is needed for this */
    played.variables[1] = variable;
    child_run(&played);
    if (played.status != 0)
        print_message("%s", played.errors);
}

void played_run(const char *variable)
{
    memset(&played, 0, sizeof played);
    const char *const arguments[] = {getenv("LUTETIA"), "studio",
                                     "--paper",         "96x72",
                                     "--pigment",       "french ultramarine",
                                     "--pigment",       "quinacridone rose",
                                     "--play",          played_path("hand.events")};
    memcpy(played.arguments, arguments, sizeof arguments);
    run(variable);
}

void played_again(void)
{
    memset(&played, 0, sizeof played);
    const char *const arguments[] = {getenv("LUTETIA"), "studio", "--play",
                                     played_path("hand.events")};
    memcpy(played.arguments, arguments, sizeof arguments);
    run(NULL);
}

pid_t played_start(void)
{
    const pid_t studio = fork();
    if (studio == 0) {
        setenv("GTK_A11Y", "none", 1);
        signal(SIGXFSZ, SIG_IGN); /* files that may not grow are a full disk */
        execl(getenv("LUTETIA"), "lutetia", "studio", "--paper", "96x72", "--pigment",
              "french ultramarine", "--pigment", "quinacridone rose", "--play",
              played_path("hand.events"), NULL);
        _exit(127);
    }
    return studio;
}

size_t played_file(const char *path, char **bytes)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    const size_t count = (size_t)ftell(file);
    rewind(file);
    *bytes = malloc(count + 1);
    assert_non_null(*bytes);
    assert_int_equal(fread(*bytes, 1, count, file), count);
    fclose(file);
    return count;
}

void played_files_same(const char *path, const char *other)
{
    char *seen, *expected;
    const size_t count = played_file(path, &seen), wanted = played_file(other, &expected);
    assert_int_equal(count, wanted);
    assert_memory_equal(seen, expected, count);
    free(seen);
    free(expected);
}

void played_script_is(const char *script, const char *made, const char *picture)
{
    memset(&played, 0, sizeof played);
    const char *const arguments[] = {getenv("LUTETIA"),  "run", played_path(script), "-q", "-o",
                                     played_path("made")};
    memcpy(played.arguments, arguments, sizeof arguments);
    child_run(&played);
    if (played.status != 0)
        print_message("%s", played.errors);
    assert_int_equal(played.status, 0);
    played_files_same(played_path(made), played_path(picture));
}

bool played_journal(char *path, size_t room)
{
    char folder_of[160];
    snprintf(folder_of, sizeof folder_of, "%s/lutetia/studio", folder);
    DIR *names = opendir(folder_of);
    bool found = false;
    for (struct dirent *entry; names && (entry = readdir(names));)
        if (strstr(entry->d_name, ".journal") && !strstr(entry->d_name, ".part")) {
            snprintf(path, room, "%s/%.80s", folder_of, entry->d_name);
            found = true;
        }
    if (names)
        closedir(names);
    return found;
}
