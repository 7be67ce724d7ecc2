/* start.c - `lutetia bench start`: how long the first picture takes from the command, with warm caches.
 *
 * Each run is a process of its own, this very program again, that writes into a folder which is taken away afterwards. One
 * run of each warms the caches of kernels, fonts and files. Then they take turns; each gives the time until it has ended,
 * and the processor time that it took in all its threads: that is hardly longer where others use the machine. */
#include <fcntl.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"
#include "of_machine.h"

enum { REPEAT_MIN = 3, COMMAND_WORDS = 12 };

extern char **environ;

#define PICTURE "@picture" /* a name in the folder */
#define SCRIPT "@script"
#define FOLDER "@folder"

static const char script[] =
    "local p = paper{width = 600, height = 400, pigments = {\"quinacridone rose\", \"phthalo "
    "green\"}}\n"
    "p:put(ellipse(300, 200, 120), {water = 0.7, [\"quinacridone rose\"] = 0.5})\n"
    "p:step(1)\n"
    "p:frame(\"picture.png\")\n";

static const struct {
    const char *what, *of_case;
    const char *words[COMMAND_WORDS];
} commands[] = {
    {"a process", "--version", {"--version"}},
    {"a machine", "info", {"info"}},
    {"type, no machine", "type", {"type", "Paris", "-o", PICTURE}},
    {"first picture",
     "paint 300x200",
     {"paint", "Paris", "--paper", "300x200", "--steps", "1", "-o", PICTURE}},
    {"first picture",
     "paint 1024x640",
     {"paint", "Paris", "--paper", "1024x640", "--steps", "1", "-o", PICTURE}},
    {"first picture", "script 600x400", {"run", SCRIPT, "-q", "-o", FOLDER}},
};

enum { COMMANDS_COUNT = sizeof commands / sizeof *commands };

struct place {
    char folder[64], picture[96], script[96];
};

static bool place_make(struct place *place)
{
    snprintf(place->folder, sizeof place->folder, "/tmp/lutetia-start-XXXXXX");
    if (!mkdtemp(place->folder))
        return bench_fail("no folder can be made in /tmp");
    snprintf(place->picture, sizeof place->picture, "%s/picture.png", place->folder);
    snprintf(place->script, sizeof place->script, "%s/start.lua", place->folder);
    FILE *file = fopen(place->script, "w");
    bool written = file && fputs(script, file) >= 0;
    if (file && fclose(file) != 0)
        written = false;
    return written || bench_fail("%s: cannot write", place->script);
}

static void place_remove(const struct place *place)
{
    unlink(place->picture);
    unlink(place->script);
    rmdir(place->folder);
}

static double seconds_of(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

static bool command_run(int number, struct place *place, double *passed_s, double *processor_s)
{
    char program[4096], name[] = "lutetia";
    char *arguments[COMMAND_WORDS + 2] = {name};
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length < 0)
        return bench_fail("/proc/self/exe cannot be read");
    program[length] = '\0';
    for (int i = 0; i < COMMAND_WORDS && commands[number].words[i]; i++) {
        const char *word = commands[number].words[i];
        arguments[i + 1] = strcmp(word, PICTURE) == 0  ? place->picture
                           : strcmp(word, SCRIPT) == 0 ? place->script
                           : strcmp(word, FOLDER) == 0 ? place->folder
                                                       : (char *)(uintptr_t)word;
    }
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    double start = bench_now_s();
    pid_t pid;
    int error = posix_spawn(&pid, program, &quiet, NULL, arguments, environ), status = 0;
    posix_spawn_file_actions_destroy(&quiet);
    struct rusage used;
    if (error || wait4(pid, &status, 0, &used) != pid)
        return bench_fail("%s cannot be run: %s", program, strerror(error));
    *passed_s = bench_now_s() - start;
    *processor_s = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    return (WIFEXITED(status) && WEXITSTATUS(status) == 0) ||
           bench_fail("lutetia %s did not succeed", commands[number].words[0]);
}

static bool all_measure(struct bench_report *r, struct place *place, int repeat_count)
{
    double *times = calloc((size_t)(2 * COMMANDS_COUNT * repeat_count), sizeof *times), ignored;
    bool ok = times || bench_fail("no memory for %d times", repeat_count);
    for (int i = 0; ok && i < COMMANDS_COUNT; i++)
        ok = command_run(i, place, &ignored, &ignored);
    for (int turn = 0; ok && turn < repeat_count; turn++)
        for (int i = 0; ok && i < COMMANDS_COUNT; i++)
            ok = command_run(i, place, &times[2 * i * repeat_count + turn],
                             &times[(2 * i + 1) * repeat_count + turn]);
    for (int i = 0; ok && i < COMMANDS_COUNT; i++) {
        char processor[32];
        snprintf(processor, sizeof processor, "%.20s, CPU", commands[i].what);
        bench_report_add(r, commands[i].what, commands[i].of_case,
                         bench_sample_of(times + 2 * i * repeat_count, repeat_count), 1e3,
                         "ms");
        bench_report_add(r, processor, commands[i].of_case,
                         bench_sample_of(times + (2 * i + 1) * repeat_count, repeat_count), 1e3,
                         "ms");
    }
    free(times);
    return ok;
}

int bench_start_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {
        .name = "start", .repeat_least = REPEAT_MIN, .repeat_count = 21};
    struct place place = {0};
    int status = bench_machine_start(&report, &options, false, argc, argv);
    if (status >= 0)
        return status;
    bool ok = place_make(&place) && all_measure(&report, &place, options.repeat_count);
    place_remove(&place);
    return bench_options_finish(&options, &report, "first picture", ok);
}
