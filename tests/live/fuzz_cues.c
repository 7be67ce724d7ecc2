/* fuzz_cues.c - lists of cues from damaged text. Each is refused in one line; or what was read
 * keeps the rules of cues_file.h. */
#include <cues_file.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static void rules_hold(const struct cues_text *text)
{
    bool gone = false;
    double at_s = 0;
    for (int i = 0; i < text->count; i++) {
        const struct cue *c = &text->cues[i];
        gone = gone || c->when == CUE_GO;
        if ((c->when == CUE_AT && (gone || c->time_s < at_s)) || !(c->time_s >= 0) ||
            !(c->fade_s >= 0) || c->line < 1)
            abort();
        at_s = c->when == CUE_AT ? c->time_s : at_s + c->time_s;
        if (c->what == CUE_SCENE ? c->scene < 1 || c->scene > 128 : !c->text)
            abort();
        if (c->what == CUE_TEXT && strlen(c->text) > STAGE_TEXT_BYTES)
            abort();
        if (c->what == CUE_SET && (!c->name[0] || strlen(c->name) >= CUE_NAME_BYTES))
            abort();
    }
    if (text->count < 1 || text->count > CUES_MAX || cues_text_seconds(text) < at_s)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    struct cues_text text;
    char *copy = malloc(count + 1); /* its end is where a sanitizer sees it */
    if (!copy)
        abort();
    memcpy(copy, bytes, count);
    copy[count] = '\0';
    const enum stage_status status = cues_text_read(copy, count, "fuzz", &text);
    free(copy);
    if (status == STAGE_OK)
        rules_hold(&text);
    else if (status != STAGE_BAD_FILE || !*stage_error() || strchr(stage_error(), '\n'))
        abort();
    cues_text_finish(&text);
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
#include "../stage/damage.h"

int main(void)
{
    static const char *const seeds[] = {
        "# an evening\n0 text \"Breath\"\n 2.5\tscene 2\r\n+1 set gravity=0 fade 3\n"
        "go text \"Out\\nagain \\\"so\\\" \\\\\"\n+0 set skin_of=letters\n",
        "go text \"\"\ngo scene 128\n+36000 set a=1e9 fade 600\n",
    };
    enum { ROUNDS = 60000 };
    int read = 0;
    for (uint64_t i = 0; i < ROUNDS; i++) {
        char damaged[DAMAGE_MOST];
        struct cues_text text;
        const size_t count = damage(seeds[i % (sizeof seeds / sizeof *seeds)], i, damaged);
        LLVMFuzzerTestOneInput((const uint8_t *)damaged, count);
        char *copy = malloc(count + 1);
        if (!copy)
            abort();
        memcpy(copy, damaged, count);
        copy[count] = '\0';
        read += cues_text_read(copy, count, "fuzz", &text) == STAGE_OK;
        cues_text_finish(&text);
        free(copy);
    }
    printf("%d lists of cues, %d read\n", ROUNDS, read);
    return read < 100;
}
#endif
