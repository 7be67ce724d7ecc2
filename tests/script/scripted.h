/* scripted.h - runs a script by the library in this process, and keeps the texts that its host
 * gets.
 *
 *     struct scripted s = {.config = scripted_config()};
 *     assert_int_equal(scripted_run(&s, "print(1 + 1)"), SCRIPT_OK);
 *     assert_string_equal(s.prints, "2\n");
 */
#ifndef LUTETIA_TEST_SCRIPTED_H
#define LUTETIA_TEST_SCRIPTED_H

#include <script.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../display/scratch.h"

enum { SCRIPTED_TEXT_MAX = 8192 };

struct scripted {
    struct script_config config;
    struct script_host host; /* more host functions; their context is this struct */
    char path[512];
    char prints[SCRIPTED_TEXT_MAX], errors[SCRIPTED_TEXT_MAX], notes[SCRIPTED_TEXT_MAX];
};

static inline void scripted_append(char *all, const char *text, size_t length)
{
    size_t there = strlen(all), room = SCRIPTED_TEXT_MAX - 1 - there;
    length = length < room ? length : room;
    memcpy(all + there, text, length);
    all[there + length] = '\0';
}

static inline void scripted_print(void *context, const char *text, size_t length)
{
    scripted_append(((struct scripted *)context)->prints, text, length);
}

static inline void scripted_error(void *context, const char *text)
{
    scripted_append(((struct scripted *)context)->errors, text, strlen(text));
    scripted_append(((struct scripted *)context)->errors, "\n", 1);
}

static inline void scripted_note(void *context, const char *text)
{
    scripted_append(((struct scripted *)context)->notes, text, strlen(text));
    scripted_append(((struct scripted *)context)->notes, "\n", 1);
}

/* A configuration whose scripts read and write pictures in the scratch folder. */
static inline struct script_config scripted_config(void)
{
    scratch_path("");
    struct script_config config = script_config_default(NULL);
    config.in_folder = config.out_folder = scratch_dir;
    config.timeout_s = 60;
    config.memory_bytes = (size_t)256 << 20;
    return config;
}

static inline enum script_status scripted_run(struct scripted *s, const char *text)
{
    snprintf(s->path, sizeof s->path, "%s", scratch_path("script.lua"));
    FILE *file = fopen(s->path, "wb");
    if (!file || fputs(text, file) < 0 || fclose(file) != 0)
        abort();
    s->prints[0] = s->errors[0] = s->notes[0] = '\0';
    s->config.path = s->path;
    s->host.context = s;
    s->host.print = scripted_print;
    s->host.error = scripted_error;
    s->host.note = scripted_note;
    return script_run(&s->config, &s->host);
}

#endif
