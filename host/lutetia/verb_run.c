/* verb_run.c - `lutetia run script.lua`: a script of papers, once or for each value of a sweep. */
#include "lua_run.h"
#include "lutetia.h"
#include "options.h"

#include <errno.h>
#include <paris_internal.h>

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { GRACE_S = 3, SWEEPS_MAX = 8, VALUES_MAX = 4096, WORD_MAX = 256 };

struct options {
    const char *in, *out, *sweep;
    double timeout_s;
    int memory_mb, seed;
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

/* What Lua's own loops in C do (a pattern that backtracks for years) no hook stops. */
static void alarm_take(int signal_number)
{
    static const char said[] = "lutetia run: the script did not stop at its --timeout; ended\n";
    (void)signal_number;
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

static int script_run(struct run *run)
{
    run->deadline_s = run->timeout_s > 0 ? clock_s() + run->timeout_s : 0;
    lua_State *L = lua_newstate(allocate, run);
    if (!L)
        return fail("run", "no memory for Lua; --memory must be more than %zu bytes",
                    run->memory_most_bytes);
    memcpy(lua_getextraspace(L), &run, sizeof run);
    if (run->deadline_s > 0) {
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
    lua_sethook(L, NULL, 0, 0);
    lua_close(L);
    alarm(0);
    for (int i = 0; i < run->words_count && result == EXIT_SUCCESS; i++)
        if (!run->asked[i])
            result = fail("run", "%s asked for no '%.*s'", run->script,
                          (int)strcspn(run->words[i], "="), run->words[i]);
    return result;
}

/* ---- sweeps ---- */

struct sweep {
    char *key;
    char *values[VALUES_MAX];
    int count;
};

/* "a=1,2;b=1..3"; the text is cut up. */
static bool sweep_parse(char *text, struct sweep *sweeps, int *count)
{
    char *next_one, *next_value;
    *count = 0;
    for (char *one = strtok_r(text, ";", &next_one); one;
         one = strtok_r(NULL, ";", &next_one)) {
        char *values = strchr(one, '=');
        if (!values || values == one || *count == SWEEPS_MAX)
            return false;
        *values++ = '\0';
        struct sweep *sweep = &sweeps[(*count)++];
        sweep->key = one;
        sweep->count = 0;
        int from, to;
        char end;
        if (sscanf(values, "%d..%d%c", &from, &to, &end) == 2) {
            if (from > to || to - from >= VALUES_MAX)
                return false;
            for (int i = from; i <= to; i++)
                if (asprintf(&sweep->values[sweep->count++], "%d", i) < 0)
                    return false;
            continue;
        }
        for (char *value = strtok_r(values, ",", &next_value); value;
             value = strtok_r(NULL, ",", &next_value)) {
            if (sweep->count == VALUES_MAX || strchr(value, '/') || strlen(value) > WORD_MAX)
                return false;
            sweep->values[sweep->count++] = strdup(value);
        }
        if (sweep->count == 0)
            return false;
    }
    return *count > 0;
}

/* Runs for every combination of values from number `depth` on; folder is what the values before it made. */
static int sweep_run(struct run *run, const struct sweep *sweeps, int count, int depth,
                     const char *folder)
{
    if (depth == count) {
        run->out_folder = folder;
        memset(run->asked, 0, sizeof run->asked);
        if (!run->quiet)
            fprintf(stderr, "lutetia run: %s\n", folder);
        return script_run(run);
    }
    const struct sweep *sweep = &sweeps[depth];
    int status = EXIT_SUCCESS;
    for (int i = 0; i < sweep->count && status == EXIT_SUCCESS; i++) {
        char *word = NULL, *path = NULL;
        if (asprintf(&word, "%s=%s", sweep->key, sweep->values[i]) < 0 ||
            asprintf(&path, "%s/%s-%s", folder, sweep->key, sweep->values[i]) < 0)
            return fail("run", "no memory for a sweep");
        status = folder_make("run", path);
        if (status == EXIT_SUCCESS) {
            run->words[run->words_count++] = word;
            status = sweep_run(run, sweeps, count, depth + 1, path);
            run->words_count--;
        }
        free(word);
        free(path);
    }
    return status;
}

static int sweep_all(struct run *run, const char *text)
{
    static struct sweep sweeps[SWEEPS_MAX];
    int count = 0, status;
    char *copy = strdup(text), *folder = strdup(run->out_folder);
    if (!copy || !folder || !sweep_parse(copy, sweeps, &count))
        status = fail_usage(
            "run", "--sweep must be KEY=a,b,c or KEY=1..5, several after ';' (got '%.60s')",
            text);
    else if (run->words_count + count > RUN_WORDS_MAX)
        status = fail_usage("run", "a script takes up to %d key=value", RUN_WORDS_MAX);
    else
        status = sweep_run(run, sweeps, count, 0, folder);
    for (int i = 0; i < count; i++)
        for (int j = 0; j < sweeps[i].count; j++)
            free(sweeps[i].values[j]);
    free(copy);
    free(folder);
    return status;
}

int verb_run(int argc, char **argv)
{
    struct options o = {.out = ".", .timeout_s = 600, .memory_mb = 4096, .seed = 1990};
    struct option_words words;
    int status = options_read(&o, argc, argv, &words);
    if (status != EXIT_SUCCESS || words.help)
        return status;
    struct run run = {.script = words.words[0],
                      .out_folder = o.out,
                      .trusted = o.trusted,
                      .quiet = o.quiet,
                      .timeout_s = o.timeout_s,
                      .memory_most_bytes = (size_t)o.memory_mb << 20,
                      .seed = (uint64_t)o.seed};
    for (int i = 1; i < words.count; i++)
        run.words[run.words_count++] = words.words[i];
    if (access(run.script, R_OK) != 0)
        return fail("run", "%s: cannot read: %s", run.script, strerror(errno));
    char *folder = strdup(run.script), *slash = folder ? strrchr(folder, '/') : NULL;
    if (slash)
        *slash = '\0';
    run.in_folder = o.in ? o.in : slash ? (*folder ? folder : "/") : ".";
    status = folder_make("run", o.out);
    if (status == EXIT_SUCCESS) {
        interrupt_catch();
        status = o.sweep ? sweep_all(&run, o.sweep) : script_run(&run);
    }
    free(folder);
    return status;
}
