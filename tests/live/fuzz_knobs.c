/* fuzz_knobs.c - files of knobs from damaged text. Each is refused in one line; or it is read,
 * written, and read again as the same. */
#include <knobs_file.h>

#include "../display/scratch.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static bool same(const struct knobs_text *a, const struct knobs_text *b)
{
    if (strcmp(a->theme, b->theme) || a->rows_count != b->rows_count ||
        a->sets_count != b->sets_count)
        return false;
    for (int i = 0; i < a->rows_count; i++)
        if (memcmp(&a->rows[i].knob, &b->rows[i].knob, sizeof(struct knob)) ||
            strcmp(a->rows[i].control, b->rows[i].control))
            return false;
    for (int i = 0; i < a->sets_count; i++)
        if (a->sets[i].scene != b->sets[i].scene ||
            strcmp(a->sets[i].control, b->sets[i].control) ||
            strcmp(a->sets[i].value, b->sets[i].value))
            return false;
    return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static long number;
    struct knobs_text text, again;
    char *copy = malloc(count ? count : 1); /* its end is where a sanitizer sees it */
    if (!copy)
        abort();
    memcpy(copy, bytes, count);
    const enum stage_status status = knobs_text_read(copy, count, "fuzz", &text);
    free(copy);
    if (status == STAGE_OK && ++number % 256 == 1) { /* files are slow */
        const char *path = scratch_path("fuzz.knobs");
        if (knobs_file_write(&text, path) != STAGE_OK ||
            knobs_file_read(path, &again) != STAGE_OK || !same(&text, &again))
            abort();
        knobs_text_finish(&again);
    }
    if (status != STAGE_OK &&
        (status != STAGE_BAD_FILE || !*stage_error() || strchr(stage_error(), '\n')))
        abort();
    knobs_text_finish(&text);
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
#include "../stage/damage.h"

int main(void)
{
    static const char *const seeds[] = {
        "knobs 1\n# mine\ntheme dark\nknob control 1 74 gravity 0 0.5\nknob bend * side 1 0\n"
        "knob clock wind_x 0.25 0.75\nscene 1 gravity 3.7\nend\n",
        "knobs 1\nknob note 10 36 rate 0 1\nknob pressure 2 rate 0 1\nfade 2 1.5\n"
        "scene 2 grid on\nscene 2 skin_of letters\nscene 128 rate 1e-1\nend\n",
    };
    enum { ROUNDS = 40000 };
    int read = 0;
    for (uint64_t i = 0; i < ROUNDS; i++) {
        char damaged[DAMAGE_MOST];
        struct knobs_text text;
        const size_t count = damage(seeds[i % 2], i, damaged);
        LLVMFuzzerTestOneInput((const uint8_t *)damaged, count);
        read += knobs_text_read(damaged, count, "fuzz", &text) == STAGE_OK;
        knobs_text_finish(&text);
    }
    return read > ROUNDS / 50 && read < ROUNDS ? 0 : 1; /* enough of them are read, too */
}
#endif
