/* verb_run.c - `lutetia run script.lua`: a script of papers, once or for each value of a
 * sweep. */
#include "help.h"
#include "lutetia.h"
#include "options.h"
#include "run.h"
#include "run_sweep.h"

#include <input_file.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { JOBS_MOST = 256 };

struct options {
    const char *in, *out, *sweep, *save, *resume, *video, *frames;
    double timeout_s, camera[4];
    int memory_mb, seed, jobs, fps, every;
    bool trusted, quiet;
};

static int options_read(struct options *o, int argc, char **argv, struct option_words *words)
{
    const struct option_row rows[] = {
        {"out", 'o', OPTION_TEXT, "DIR", "folder that pictures and papers are written to (.)",
         &o->out, 0, 0, 0},
        {"in", 0, OPTION_TEXT, "DIR",
         "folder that pictures are read from (the script's folder)", &o->in, 0, 0, 0},
        {"seed", 0, OPTION_INTEGER, "S", "seed of papers and of math.random (1990)", &o->seed,
         0, 2147483647, 0},
        {"sweep", 0, OPTION_TEXT, "KEY=LIST",
         "run once for each value of a parameter, each in a folder of its own", &o->sweep, 0, 0,
         0},
        {"jobs", 'j', OPTION_INTEGER, "N", "runs of a sweep at a time (1)", &o->jobs, 1,
         JOBS_MOST, 0},
        {"save", 0, OPTION_TEXT, "FILE",
         "save all papers, with what was done to them, at the end", &o->save, 0, 0, 0},
        {"resume", 0, OPTION_TEXT, "FILE", "go on where a run was saved", &o->resume, 0, 0, 0},
        {"video", 0, OPTION_TEXT, "FILE", "film the first paper: .mp4 (with ffmpeg), .y4m",
         &o->video, 0, 0, 0},
        {"frames", 0, OPTION_TEXT, "DIR",
         "film the first paper as numbered pictures of 16 bits: colour, water, masking fluid",
         &o->frames, 0, 0, 0},
        {"fps", 0, OPTION_INTEGER, "N", "frames a second of the film (30)", &o->fps, 1, 240, 0},
        {"every", 0, OPTION_INTEGER, "N", "steps from frame to frame (4)", &o->every, 1,
         1000000, 0},
        {"camera", 0, OPTION_NUMBERS, "X,Y,W,H",
         "the part of the paper that the film shows, in fibers (all)", &o->camera, 0, 16384, 4},
        {"timeout", 0, OPTION_NUMBER, "S", "seconds that a run may take; 0: any (600)",
         &o->timeout_s, 0, 1e6, 0},
        {"memory", 0, OPTION_INTEGER, "MB",
         "megabytes that papers, masks and Lua may take (4096)", &o->memory_mb, 1, 1 << 20, 0},
        {"quiet", 'q', OPTION_FLAG, "", "show no progress line", &o->quiet, 0, 0, 0},
        {"trust", 0, OPTION_FLAG, "",
         "run without the sandbox: files, processes, all of Lua's library", &o->trusted, 0, 0,
         0},
        {0}};
    if (!options_parse("run", rows, argc, argv, words))
        return EXIT_USAGE;
    if (words->help)
        return help_print("run", rows, NULL);
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
        .config = script_config_default(words.words[0]),
        .quiet = o.quiet,
        .save = o.save,
        .alone = !o.sweep,
        .film = {
            .video = o.video, .folder = o.frames, .fps = o.fps, .every = o.every, .paper = 1}};
    struct script_config *config = &run.config;
    config->out_folder = o.out;
    config->trusted = o.trusted;
    config->papers_max = o.save ? PAPER_STATE_SHEETS_MAX : 0;
    config->timeout_s = o.timeout_s;
    config->memory_bytes = (size_t)o.memory_mb << 20;
    config->seed = (uint64_t)o.seed;
    memcpy(run.film.camera, o.camera, sizeof run.film.camera);
    for (int i = 1; i < words.count; i++)
        run.words[config->words_count++] = words.words[i];
    const char *why = "";
    int found = input_file_descriptor(config->path, &why);
    if (found < 0)
        return fail("run", "%s: cannot read: %s", config->path, why);
    close(found);
    char *folder = strdup(config->path), *slash = folder ? strrchr(folder, '/') : NULL;
    if (slash)
        *slash = '\0';
    config->in_folder = o.in ? o.in : slash ? (*folder ? folder : "/") : ".";
    status = folder_make("run", o.out);
    if (status == EXIT_SUCCESS && o.frames && !o.sweep)
        status = folder_make("run", o.frames);
    if (status == EXIT_SUCCESS && o.resume &&
        paper_state_open(o.resume, &config->resumed) != PAPER_OK)
        status = fail("run", "%s", paper_error());
    if (status == EXIT_SUCCESS) {
        interrupt_catch();
        status = o.sweep ? sweep_all(&run, o.sweep, o.jobs) : run_script(&run);
    }
    paper_state_close(config->resumed);
    free(folder);
    return status;
}
