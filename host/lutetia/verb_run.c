/* verb_run.c - `lutetia run script.lua`: a script of papers, once or for each value of a sweep. */
#include "lua_run.h"
#include "lutetia.h"
#include "options.h"
#include "run_sweep.h"

#include <history.h>
#include <state.h>

#include <errno.h>
#include <paris_internal.h>

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { GRACE_S = 3, PATIENCE = 30, JOBS_MOST = 256 };

struct options {
    const char *in, *out, *sweep, *save, *resume, *video, *frames;
    double timeout_s, camera[4];
    int memory_mb, seed, jobs, fps, every;
    bool trusted, quiet;
};

static int options_read(struct options *o, int argc, char **argv, struct option_words *words)
{
    const struct option_row rows[] = {
        {"out", 'o', OPTION_TEXT, "DIR", "where pictures go (.)", &o->out, 0, 0, 0},
        {"in", 0, OPTION_TEXT, "DIR", "where pictures come from (the script's folder)", &o->in,
         0, 0, 0},
        {"seed", 0, OPTION_INTEGER, "S", "of papers and of math.random (1990)", &o->seed, 0,
         2147483647, 0},
        {"sweep", 0, OPTION_TEXT, "KEY=LIST",
         "run once for each value: a,b,c or 1..5; several, after ';'; each in a folder of its "
         "own",
         &o->sweep, 0, 0, 0},
        {"jobs", 'j', OPTION_INTEGER, "N", "runs of a sweep at a time (1)", &o->jobs, 1,
         JOBS_MOST, 0},
        {"save", 0, OPTION_TEXT, "FILE",
         "save all papers with what was done to them at the end", &o->save, 0, 0, 0},
        {"resume", 0, OPTION_TEXT, "FILE", "go on where a run was saved", &o->resume, 0, 0, 0},
        {"video", 0, OPTION_TEXT, "FILE", "film the first paper: .mp4 (with ffmpeg), .y4m",
         &o->video, 0, 0, 0},
        {"frames", 0, OPTION_TEXT, "DIR",
         "the same as pictures of 16 bits: colour, water, masking fluid", &o->frames, 0, 0, 0},
        {"fps", 0, OPTION_INTEGER, "N", "frames in a second of the film (30)", &o->fps, 1, 240,
         0},
        {"every", 0, OPTION_INTEGER, "N", "steps from frame to frame (4)", &o->every, 1,
         1000000, 0},
        {"camera", 0, OPTION_NUMBERS, "X,Y,W,H", "what the film shows, in fibers (all)",
         &o->camera, 0, 16384, 4},
        {"timeout", 0, OPTION_NUMBER, "S", "seconds that a run may take; 0: any (600)",
         &o->timeout_s, 0, 1e6, 0},
        {"memory", 0, OPTION_INTEGER, "MB", "that papers, masks and Lua may take (4096)",
         &o->memory_mb, 1, 1 << 20, 0},
        {"quiet", 'q', OPTION_FLAG, "", "no progress line", &o->quiet, 0, 0, 0},
        {"trust", 0, OPTION_FLAG, "", "no sandbox: files, processes, all of Lua's library",
         &o->trusted, 0, 0, 0},
        {0}};
    if (!options_parse("run", rows, argc, argv, words))
        return EXIT_USAGE;
    if (words->help) {
        puts("usage: lutetia run SCRIPT.lua [key=value...] [options]\n");
        options_help(rows);
        puts("\nA script reads key=value by param(\"key\", default). docs/scripts.md says what "
             "it can "
             "do.");
        return EXIT_SUCCESS;
    }
    if (words->count < 1)
        return fail_usage("run", "name a script: lutetia run SCRIPT.lua [key=value...]");
    for (int i = 1; i < words->count; i++)
        if (!strchr(words->words[i], '=') || words->words[i][0] == '=')
            return fail_usage("run", "'%.60s' must be key=value", words->words[i]);
    if (o->sweep && (o->save || o->resume))
        return fail_usage("run", "--save and --resume are of one run, not of a sweep");
    if (o->jobs > 1 && !o->sweep)
        return fail_usage("run", "--jobs is for a --sweep");
    return EXIT_SUCCESS;
}

/* ---- one run ---- */

/* Lua's memory is counted with the rest. */
static void *allocate(void *context, void *block, size_t old, size_t new)
{
    struct run *run = context;
    old = block ? old : 0;
    if (new == 0) {
        free(block);
        run->memory_bytes -= old;
        return NULL;
    }
    if (new > old &&new - old > run->memory_most_bytes - run->memory_bytes &&
        run->memory_bytes <= run->memory_most_bytes) {
        run->memory_short = true;
        return NULL;
    }
    void *made = realloc(block, new);
    if (made)
        run->memory_bytes += new - old;
    return made;
}

static volatile sig_atomic_t at_work, patience;

void run_at_work(bool now)
{
    at_work = now;
}

/* What Lua's own loops in C do (a pattern that backtracks for years) no hook stops. */
static void alarm_take(int signal_number)
{
    static const char said[] = "lutetia run: the script did not stop at its --timeout; ended\n";
    (void)signal_number;
    if (at_work && patience > 0) {
        patience--;
        alarm(GRACE_S);
        return;
    }
    ssize_t written = write(STDERR_FILENO, said, sizeof said - 1);
    (void)written;
    _exit(EXIT_FAILED);
}

static int open_all(lua_State *L)
{
    lua_sandbox_open(L);
    lua_mask_open(L);
    lua_paper_open(L);
    lua_brush_open(L);
    lua_time_open(L);
    lua_technique_open(L);
    return 0;
}

/* Errors that are no text, and where they came from when Lua was short of memory. */
static int message(lua_State *L)
{
    if (lua_type(L, 1) != LUA_TSTRING)
        lua_pushfstring(L, "error: (a %s)", luaL_typename(L, 1));
    return 1;
}

static void complain(const char *text)
{
    char line[1200];
    snprintf(line, sizeof line, "%s", text);
    for (char *c = line; *c; c++)
        if (*c == '\n' || *c == '\r')
            *c = ' ';
    fprintf(stderr, "%s\n", line);
}

/* ---- saving and resuming ---- */

/* What was done until now, however the run ended. */
static int run_save(struct run *run, int result)
{
    for (int i = 0; i < run->kept_count;
         i++) /* what is to be computed for it must not be stopped */
        paper_history_set_watch(run->kept[i].sheet, NULL, NULL);
    struct paper_state_sheet kept[RUN_PAPERS_MAX];
    int count = 0;
    for (int i = 0; i < run->kept_count; i++)
        if (paper_history_has(run->kept[i].sheet))
            kept[count++] = run->kept[i];
    if (paper_state_save(run->save, kept, count) != PAPER_OK)
        return fail("run", "%s", paper_error());
    if (!run->quiet && result != EXIT_SUCCESS)
        fprintf(stderr, "lutetia run: saved; `lutetia run %s --resume %s` goes on\n",
                run->script, run->save);
    return result;
}

static void divergence_report(const struct run *run)
{
    for (int i = 0; i < run->kept_count; i++)
        if (paper_history_diverged(run->kept[i].sheet) && !run->quiet)
            fprintf(
                stderr,
                "lutetia run: paper %d goes another way than the one that was saved; it was "
                "computed again from there\n",
                run->kept[i].number);
}

/* ---- the script ---- */

int script_run(struct run *run)
{
    run->began_s = clock_s();
    run->deadline_s = run->timeout_s > 0 ? clock_s() + run->timeout_s : 0;
    lua_State *L = lua_newstate(allocate, run);
    if (!L)
        return fail("run", "no memory for Lua; --memory must be more than %zu bytes",
                    run->memory_most_bytes);
    memcpy(lua_getextraspace(L), &run, sizeof run);
    if (run->deadline_s > 0) {
        patience = PATIENCE;
        signal(SIGALRM, alarm_take);
        alarm((unsigned)run->timeout_s + GRACE_S);
    }
    lua_pushcfunction(L, message);
    lua_pushcfunction(L, open_all);
    int status = lua_pcall(L, 0, 0, 1);
    if (status == LUA_OK)
        status = luaL_loadfilex(L, run->script, "t");
    if (status == LUA_OK)
        status = lua_pcall(L, 0, 0, 1);
    int result = EXIT_SUCCESS;
    if (status != LUA_OK) {
        const char *text = lua_tostring(L, -1);
        if (status == LUA_ERRMEM ||
            (run->memory_short && text && strcmp(text, "not enough memory") == 0))
            fail("run", "%s: not enough memory; --memory allows %.0f MB", run->script,
                 (double)run->memory_most_bytes * 1e-6);
        else
            complain(text ? text : "error");
        result = interrupted() ? EXIT_INTERRUPTED : EXIT_FAILED;
    }
    alarm(0);
    lua_sethook(L, NULL, 0, 0);
    bool film_failed = run->film.failed; /* and has been said */
    if (!film_end(&run->film) && !film_failed)
        result = fail("run", "%s", run->film.error);
    divergence_report(run);
    if (run->save)
        result = run_save(run, result);
    lua_close(L);
    for (int i = 0; i < run->words_count && result == EXIT_SUCCESS; i++)
        if (!run->asked[i])
            result = fail("run", "%s asked for no '%.*s'", run->script,
                          (int)strcspn(run->words[i], "="), run->words[i]);
    return result;
}

int verb_run(int argc, char **argv)
{
    struct options o = {.out = ".",
                        .timeout_s = 600,
                        .memory_mb = 4096,
                        .seed = 1990,
                        .jobs = 1,
                        .fps = 30,
                        .every = 4};
    struct option_words words;
    int status = options_read(&o, argc, argv, &words);
    if (status != EXIT_SUCCESS || words.help)
        return status;
    struct run run = {
        .script = words.words[0],
        .out_folder = o.out,
        .trusted = o.trusted,
        .quiet = o.quiet,
        .timeout_s = o.timeout_s,
        .memory_most_bytes = (size_t)o.memory_mb << 20,
        .seed = (uint64_t)o.seed,
        .save = o.save,
        .film = {
            .video = o.video, .folder = o.frames, .fps = o.fps, .every = o.every, .paper = 1}};
    memcpy(run.film.camera, o.camera, sizeof run.film.camera);
    for (int i = 1; i < words.count; i++)
        run.words[run.words_count++] = words.words[i];
    struct stat found;
    if (access(run.script, R_OK) != 0)
        return fail("run", "%s: cannot read: %s", run.script, strerror(errno));
    if (stat(run.script, &found) == 0 && S_ISDIR(found.st_mode))
        return fail("run", "%s: cannot read: %s", run.script, strerror(EISDIR));
    char *folder = strdup(run.script), *slash = folder ? strrchr(folder, '/') : NULL;
    if (slash)
        *slash = '\0';
    run.in_folder = o.in ? o.in : slash ? (*folder ? folder : "/") : ".";
    status = folder_make("run", o.out);
    if (status == EXIT_SUCCESS && o.frames && !o.sweep)
        status = folder_make("run", o.frames);
    if (status == EXIT_SUCCESS && o.resume &&
        paper_state_open(o.resume, &run.resumed) != PAPER_OK)
        status = fail("run", "%s", paper_error());
    if (status == EXIT_SUCCESS) {
        interrupt_catch();
        status = o.sweep ? sweep_all(&run, o.sweep, o.jobs) : script_run(&run);
    }
    paper_state_close(run.resumed);
    free(folder);
    return status;
}
