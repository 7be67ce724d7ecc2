/* start.c - `lutetia bench start`: the time from starting the command to its first picture, and
 * of a first program in C/Paris, with warm caches and with empty ones.
 *
 * Each run is a process, in a temporary folder. One run of each kind warms the caches of
 * kernels, fonts and files. Then the kinds run alternately. Each row
 * gives the elapsed time, and the processor time of all threads, which depends less on other
 * load. Caches of kernels that are empty are folders of their own, made for the run.
 *
 * --thorough also measures the longest pause of a program that looks after each step, with
 * empty caches, with and without compiling better kernels in the background. The first two
 * steps, which need kernels at once, do not count. And the longest call of a program of other
 * kinds of calls (start_calls.h).
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
#include "input_file.h"
#include "listing.h"
#include "of_machine.h"
#include "output_file.h"
#include "paris_internal.h"
#include "program.h"
#include "programs.h"
#include "scene.h"
#include "start_calls.h"
#include "user_folder.h"

enum { REPEAT_MIN = 3, COMMAND_WORDS = 12, STEPS = 400, STEPS_FIRST = 2, SIDE = 512, RUNS = 5 };
static const char STEPS_INTO[] =
    "--steps-into"; /* argument for a run of the steps, followed by a file */
static const char CALLS_INTO[] = "--calls-into"; /* and of the calls */

extern char **environ;

#define PICTURE "@picture" /* a name in the folder */
#define SCRIPT "@script"
#define FOLDER "@folder"
#define LIFE "@life" /* examples/paris/life.c, compiled; else the command is lutetia */

static const char script[] =
    "local p = paper{width = 600, height = 400, "
    "pigments = {\"quinacridone rose\", \"phthalo green\"}}\n"
    "p:put(ellipse(300, 200, 120), {water = 0.7, [\"quinacridone rose\"] = 0.5})\n"
    "p:step(1)\n"
    "p:frame(\"picture.png\")\n";

static const struct start_command {
    const char *what, *of_case;
    const char *words[COMMAND_WORDS];
    bool kernels; /* it makes some: with empty caches, too */
} commands[] = {
    {"a process", "--version", {"--version"}, false},
    {"a machine", "info", {"info"}, false},
    {"type, no machine", "type", {"type", "Paris", "-o", PICTURE}, false},
    {"first picture",
     "paint 300x200",
     {"paint", "Paris", "--model=thesis", "--paper", "300x200", "--steps", "1", "-o", PICTURE},
     true},
    {"first picture",
     "paint 1024x640",
     {"paint", "Paris", "--model=thesis", "--paper", "1024x640", "--steps", "1", "-o", PICTURE},
     true},
    {"first picture", "script 600x400", {"run", SCRIPT, "-q", "-o", FOLDER}, true},
    {"in C/Paris", "life 200", {LIFE, "200"}, true},
};

enum { COMMANDS_COUNT = sizeof commands / sizeof *commands };

enum { PLACE_BYTES = 512 };

struct place {
    char folder[PLACE_BYTES], picture[PLACE_BYTES + 32], script[PLACE_BYTES + 32],
        life[PLACE_BYTES + 32];
};

static bool file_make(const char *folder, const char *name, const char *text)
{
    char path[PLACE_BYTES + 64];
    struct output_file out;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (!output_file_open(&out, path))
        return bench_fail("%s: cannot write: %s", path, out.why);
    fputs(text, out.stream);
    return output_file_commit(&out) || bench_fail("%s: cannot write: %s", path, out.why);
}

static bool place_make(struct place *place)
{
    if (!user_folder_temporary("start", place->folder, sizeof place->folder))
        return bench_fail("%s: no folder can be made", place->folder);
    snprintf(place->picture, sizeof place->picture, "%s/picture.png", place->folder);
    snprintf(place->script, sizeof place->script, "%s/start.lua", place->folder);
    snprintf(place->life, sizeof place->life, "%s/life", place->folder);
    return file_make(place->folder, "start.lua", script) &&
           file_make(place->folder, "life.c", program_life_c) &&
           file_make(place->folder, "picture.h", program_picture_h);
}

static double seconds_of(struct timeval t)
{
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

/* Runs a program in the folder, which it may leave pictures in. */
static bool program_run(struct place *place, const char *program, char *const *arguments,
                        double *passed_s, double *processor_s)
{
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addchdir_np(&quiet, place->folder);
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
           bench_fail("%s %s did not succeed", program, arguments[1]);
}

static bool command_run(const char *const words[COMMAND_WORDS], struct place *place,
                        double *passed_s, double *processor_s)
{
    char program[PATH_MAX], name[] = "lutetia";
    char *arguments[COMMAND_WORDS + 2] = {name};
    bool life = strcmp(words[0], LIFE) == 0;
    if (!program_find(program, (program_code *)bench_start_main, LUTETIA_BINDIR "/lutetia",
                      "host/lutetia/lutetia"))
        return bench_fail("the program lutetia is not beside lutetia-bench; install or build "
                          "it with the rest");
    for (int i = life, at = 1; i < COMMAND_WORDS && words[i]; i++, at++) {
        const char *word = words[i];
        arguments[at] = strcmp(word, PICTURE) == 0  ? place->picture
                        : strcmp(word, SCRIPT) == 0 ? place->script
                        : strcmp(word, FOLDER) == 0 ? place->folder
                                                    : (char *)(uintptr_t)word;
    }
    return program_run(place, life ? place->life : program, arguments, passed_s, processor_s);
}

/* ---- empty caches ---- */

enum { CACHE_NAMES = 2 };
static const char *const cache_names[CACHE_NAMES] = {"XDG_CACHE_HOME", "POCL_CACHE_DIR"};

/* Caches as they were, and the folder of those that are used instead. */
struct caches {
    char *kept[CACHE_NAMES];
    char folder[PLACE_BYTES + 32];
};

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

static bool caches_empty(struct caches *c, const struct place *place)
{
    char driver[PLACE_BYTES + 64];
    snprintf(c->folder, sizeof c->folder, "%s/cache", place->folder);
    snprintf(driver, sizeof driver, "%s/pocl", c->folder);
    for (int i = 0; i < CACHE_NAMES; i++)
        c->kept[i] = variable_kept(cache_names[i]);
    setenv(cache_names[0], c->folder, 1);
    setenv(cache_names[1], driver, 1);
    return (mkdir(c->folder, 0700) == 0 && mkdir(driver, 0700) == 0) ||
           bench_fail("%s: cannot be made", driver);
}

static void caches_back(struct caches *c)
{
    for (int i = 0; i < CACHE_NAMES; i++)
        variable_put(cache_names[i], c->kept[i]);
    cold_folder_remove(c->folder);
}

/* ---- first pictures ---- */

/* Times of a command: passed and processor time with warm caches, then with empty ones. */
enum { WARM, WARM_CPU, COLD, COLD_CPU, TIMES };
static const char *const times_named[TIMES] = {"", ", CPU", ", cold", ", cold, CPU"};

static bool command_measure(const struct start_command *c, struct place *place,
                            double times[TIMES])
{
    struct caches caches;
    if (!command_run(c->words, place, &times[WARM], &times[WARM_CPU]))
        return false;
    if (!c->kernels || bench_quick)
        return true;
    bool ok = caches_empty(&caches, place) &&
              command_run(c->words, place, &times[COLD], &times[COLD_CPU]);
    caches_back(&caches);
    return ok;
}

static bool all_measure(struct bench_report *r, struct place *place, int repeat_count)
{
    static const char *const compile[COMMAND_WORDS] = {"cc", "life.c", "-o", "life"};
    double(*times)[TIMES] = calloc((size_t)(COMMANDS_COUNT * repeat_count), sizeof *times);
    double *one = calloc((size_t)repeat_count, sizeof *one), ignored;
    bool ok = (times && one) || bench_fail("no memory for %d times", repeat_count);
    ok = ok && command_run(compile, place, &ignored, &ignored);
    for (int i = 0; ok && i < COMMANDS_COUNT; i++)
        ok = command_run(commands[i].words, place, &ignored, &ignored);
    for (int turn = 0; ok && turn < repeat_count; turn++)
        for (int i = 0; ok && i < COMMANDS_COUNT; i++)
            ok = command_measure(&commands[i], place, times[i * repeat_count + turn]);
    for (int i = 0; ok && i < COMMANDS_COUNT; i++)
        for (int t = 0; t < (commands[i].kernels && !bench_quick ? TIMES : COLD); t++) {
            char what[32];
            snprintf(what, sizeof what, "%s%s", commands[i].what, times_named[t]);
            for (int turn = 0; turn < repeat_count; turn++)
                one[turn] = times[i * repeat_count + turn][t];
            bench_report_add(r, what, commands[i].of_case, bench_sample_of(one, repeat_count),
                             1e3, "ms");
        }
    free(times);
    free(one);
    return ok;
}

/* ---- pauses ---- */

static bool times_write(const char *path, double longest_s, double all_s)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return false;
    fprintf(out.stream, "%.6f %.6f", longest_s, all_s);
    return output_file_commit(&out);
}

static bool calls_run(const char *path)
{
    double longest, all;
    return start_calls_run(&longest, &all) && times_write(path, longest, all);
}

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
    return ok && times_write(path, longest, before - start);
}

/* Runs the steps, or the calls, in a process with empty caches of its own. */
static bool steps_of(struct place *place, const char *what, const char *background,
                     double out[2])
{
    const char *const words[COMMAND_WORDS] = {"bench", "start", what, PICTURE};
    char *kept = variable_kept("LUTETIA_BACKGROUND");
    struct caches caches;
    double ignored;
    setenv("LUTETIA_BACKGROUND", background, 1);
    bool ok = caches_empty(&caches, place) && command_run(words, place, &ignored, &ignored);
    caches_back(&caches);
    variable_put("LUTETIA_BACKGROUND", kept);
    FILE *file = ok ? input_file_open(place->picture, NULL) : NULL;
    if (ok && !(file && fscanf(file, "%lf %lf", &out[0], &out[1]) == 2))
        ok = bench_fail("%s: no times are in it", place->picture);
    if (file)
        fclose(file);
    return ok;
}

static bool pauses_measure(struct bench_report *r, struct place *place)
{
    static const char *const cases[2] = {"cold, waits", "cold, background"};
    double times[2][2][RUNS], calls[2][RUNS];
    char whats[2][32] = {"longest pause"};
    bool ok = true;
    snprintf(whats[1], sizeof whats[1], "%d steps", STEPS);
    for (int run = 0; ok && run < RUNS; run++)
        for (int background = 0; ok && background < 2; background++) {
            double two[2];
            ok = steps_of(place, STEPS_INTO, background ? "1" : "0", two);
            for (int i = 0; ok && i < 2; i++)
                times[background][i][run] = two[i];
            if (!background)
                continue;
            ok = ok && steps_of(place, CALLS_INTO, "1", two);
            for (int i = 0; ok && i < 2; i++)
                calls[i][run] = two[i];
        }
    for (int i = 0; ok && i < 2; i++)
        for (int background = 0; background < 2; background++)
            bench_report_add(r, whats[i], cases[background],
                             bench_sample_of(times[background][i], RUNS), 1e3, "ms");
    for (int i = 0; ok && i < 2; i++)
        bench_report_add(r, i ? "all calls" : "longest call", cases[1],
                         bench_sample_of(calls[i], RUNS), 1e3, "ms");
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
    if (argc == 3 && !strcmp(argv[1], CALLS_INTO))
        return calls_run(argv[2]) ? EXIT_SUCCESS : EXIT_FAILURE;
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
    cold_folder_remove(place.folder);
    return bench_options_finish(&options, &report, "first picture", ok);
}
