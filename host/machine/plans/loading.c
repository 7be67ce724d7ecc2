/* loading.c - see loading.h. */
#include "plans/loading.h"

#include <stdlib.h>
#include <string.h>

static void load(void *of)
{
    struct loading *l = of;
    l->program = device_program_build(l->device, l->parts, l->options);
}

static void names_free(struct loading *l)
{
    free(l->text);
    free(l->options);
    l->text = l->options = NULL;
}

bool loading_begin(struct loading *l, const struct device *d,
                   const char *const parts[DEVICE_PARTS], const char *options)
{
    l->device = d;
    l->program = NULL;
    l->text = strdup(parts[DEVICE_PARTS - 1]);
    l->options = strdup(options);
    memcpy(l->parts, parts, sizeof l->parts);
    l->parts[DEVICE_PARTS - 1] = l->text;
    if (l->text && l->options && aside_begin(&l->aside, load, l))
        return true;
    names_free(l);
    return false;
}

bool loading_is_on(const struct loading *l)
{
    return l->text != NULL;
}

bool loading_is_done(const struct loading *l)
{
    return aside_is_done(&l->aside) || aside_is_lost(&l->aside);
}

bool loading_is_of(const struct loading *l, const char *text, const char *options)
{
    return l->text && !strcmp(l->text, text) && !strcmp(l->options, options);
}

void loading_wait(struct loading *l)
{
    aside_wait(&l->aside);
}

cl_program loading_take(struct loading *l)
{
    cl_program program = NULL;
    const bool lost = aside_is_lost(&l->aside);
    aside_end(&l->aside);
    if (!lost)
        program = l->program;
    l->program = NULL;
    names_free(l);
    return program;
}

void loading_drop(struct loading *l)
{
    cl_program program = loading_is_on(l) ? loading_take(l) : NULL;
    if (program)
        clReleaseProgram(program);
}
