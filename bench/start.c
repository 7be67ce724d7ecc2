/* start.c - `lutetia bench start`: the time from starting the command to its first picture,
 * with warm caches.
 *
 * Each run is a process of `lutetia`, which writes into a temporary folder. One run of each
 * kind warms the caches of kernels, fonts and files. Then the kinds run alternately. Each row
 * gives the elapsed time, and the processor time of all threads, which depends less on other
 * load.
 *
 * --thorough also measures the longest pause of a program that looks after each step, with
 * empty caches, with and without compiling better kernels in the background. The first two
 * steps, which need kernels at once, do not count.
 */
#include <fcntl.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"
#include "cold.h"
#include "listing.h"
#include "of_machine.h"
#include "paris_internal.h"
#include "program.h"
#include "scene.h"

enum { REPEAT_MIN = 3, COMMAND_WORDS = 12, STEPS = 400, STEPS_FIRST = 2, SIDE = 512, RUNS = 5 };
static const char STEPS_INTO[] =
    "--steps-into"; /* argument for a run of the steps, followed by a file */

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
     {"paint", "Paris", "--model=thesis", "--paper", "300x200", "--steps", "1", "-o", PICTURE}},
    {"first picture",
     "paint 1024x640",
     {"paint", "Paris", "--model=thesis", "--paper", "1024x640", "--steps", "1", "-o",
      PICTURE}},
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

static bool command_run(const char *const words[COMMAND_WORDS], struct place *place,
                        double *passed_s, double *processor_s)
{
    char program[PATH_MAX], name[] = "lutetia";
    char *arguments[COMMAND_WORDS + 2] = {name};
    if (!program_find(program, (program_code *)bench_start_main, LUTETIA_BINDIR "/lutetia",
                      "host/lutetia/lutetia"))
        return bench_fail("the program lutetia is not beside lutetia-bench; install or build "
                          "it with the rest");
    for (int i = 0; i < COMMAND_WORDS && words[i]; i++) {
        const char *word = words[i];
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
           bench_fail("lutetia %s did not succeed", words[0]);
}

static bool all_measure(struct bench_report *r, struct place *place, int repeat_count)
{
    double *times = calloc((size_t)(2 * COMMANDS_COUNT * repeat_count), sizeof *times), ignored;
    bool ok = times || bench_fail("no memory for %d times", repeat_count);
    for (int i = 0; ok && i < COMMANDS_COUNT; i++)
        ok = command_run(commands[i].words, place, &ignored, &ignored);
    for (int turn = 0; ok && turn < repeat_count; turn++)
        for (int i = 0; ok && i < COMMANDS_COUNT; i++)
            ok = command_run(commands[i].words, place, &times[2 * i * repeat_count + turn],
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

/* ---- pauses ---- */

/* Runs the steps; writes the longest time between the ends of two steps, and the total time,
 * to a file. */
static bool steps_run(const char *path)
{
    struct diffusion_scene scene;
    double before = bench_now_s(), start = before, longest = 0;
    if (!diffusion_scene_init(&scene, SIDE, SIDE))
        return false;
    struct listing l = {.width = SIDE,
                        .height = SIDE,
                        .gravity = (double)scene.gravity,
                        .molecular_weight = {1, 1, 1}};
    CM_init();
    listing_allocate(&l);
    struct machine *m = paris_machine();
    bool ok = bench_machine_said(
                  machine_field_upload(m, l.absorbency, MACHINE_F32, scene.absorbency)) &&
              bench_machine_said(machine_field_upload(m, l.water, MACHINE_F32, scene.field[0]));
    for (int i = 0; ok && i < STEPS; i++) {
        listing_step(&l);
        ok = bench_machine_finished();
        double now = bench_now_s();
        longest = i >= STEPS_FIRST && now - before > longest ? now - before : longest;
        before = now;
    }
    diffusion_scene_finish(&scene);
    FILE *file = ok ? fopen(path, "w") : NULL;
    ok = file && fprintf(file, "%.6f %.6f", longest, before - start) > 0;
    return file && fclose(file) == 0 && ok;
}

static void variable_put(const char *name, char *value)
{
    if (value)
        setenv(name, value, 1);
    else
        unsetenv(name);
    free(value);
}

static char *variable_kept(const char *name)
{
    const char *value = getenv(name);
    return value ? strdup(value) : NULL;
}

/* Runs the steps in a process with empty caches of its own. */
static bool steps_of(struct place *place, const char *background, double out[2])
{
    static const char *const names[] = {"XDG_CACHE_HOME", "POCL_CACHE_DIR",
                                        "LUTETIA_BACKGROUND"};
    enum { NAMES = sizeof names / sizeof *names };
    const char *const words[COMMAND_WORDS] = {"bench", "start", STEPS_INTO, PICTURE};
    char folder[96], driver[128], *kept[NAMES];
    double ignored;
    snprintf(folder, sizeof folder, "%s/cache", place->folder);
    snprintf(driver, sizeof driver, "%s/pocl", folder);
    if (mkdir(folder, 0700) || mkdir(driver, 0700))
        return bench_fail("%s: cannot be made", driver);
    for (int i = 0; i < NAMES; i++)
        kept[i] = variable_kept(names[i]);
    setenv(names[0], folder, 1);
    setenv(names[1], driver, 1);
    setenv(names[2], background, 1);
    bool ok = command_run(words, place, &ignored, &ignored);
    for (int i = 0; i < NAMES; i++)
        variable_put(names[i], kept[i]);
    cold_folder_remove(folder);
    FILE *file = ok ? fopen(place->picture, "r") : NULL;
    if (ok && !(file && fscanf(file, "%lf %lf", &out[0], &out[1]) == 2))
        ok = bench_fail("%s: no times are in it", place->picture);
    if (file)
        fclose(file);
    return ok;
}

static bool pauses_measure(struct bench_report *r, struct place *place)
{
    static const char *const cases[2] = {"cold, waits", "cold, background"};
    double times[2][2][RUNS];
    char whats[2][32] = {"longest pause"};
    bool ok = true;
    snprintf(whats[1], sizeof whats[1], "%d steps", STEPS);
    for (int run = 0; ok && run < RUNS; run++)
        for (int background = 0; ok && background < 2; background++) {
            double two[2];
            ok = steps_of(place, background ? "1" : "0", two);
            for (int i = 0; ok && i < 2; i++)
                times[background][i][run] = two[i];
        }
    for (int i = 0; ok && i < 2; i++)
        for (int background = 0; background < 2; background++)
            bench_report_add(r, whats[i], cases[background],
                             bench_sample_of(times[background][i], RUNS), 1e3, "ms");
    return ok;
}

int bench_start_main(int argc, char **argv)
{
    static struct bench_report report;
    struct bench_options options = {
        .name = "start",
        .repeat_least = REPEAT_MIN,
        .repeat_count = 21,
        .thorough_does = "how long a program stands still whose kernels are in no cache"};
    if (argc == 3 && !strcmp(argv[1], STEPS_INTO))
        return steps_run(argv[2]) ? EXIT_SUCCESS : EXIT_FAILURE;
    struct place place = {0};
    char *background = variable_kept("LUTETIA_BACKGROUND"),
         *interpret = variable_kept("LUTETIA_INTERPRET");
    int status = bench_machine_start(&report, &options, false, argc, argv);
    variable_put("LUTETIA_BACKGROUND", background); /* the runs use the usual settings */
    variable_put("LUTETIA_INTERPRET", interpret);
    if (status >= 0)
        return status;
    bool ok = place_make(&place) && all_measure(&report, &place, options.repeat_count) &&
              (!options.thorough || pauses_measure(&report, &place));
    place_remove(&place);
    return bench_options_finish(&options, &report, "first picture", ok);
}
