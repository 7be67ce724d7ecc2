/* fuzz_template.c - takes random bytes as a template, and templates that are built in with
 * bytes changed: each is refused with one line, or its text is read again as the same, and its
 * grid is within any window. The seeds are the same in every run, or libFuzzer's with
 * -DLUTETIA_FUZZ_TARGET. */
#include <reader_document.h>
#include <reader_template.h>

#include "../must.h"
#include "../sample.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    struct reader_template t, again;
    char *text = malloc(count + 1);
    must(text != NULL);
    if (count)
        memcpy(text, bytes, count);
    const enum reader_status status = reader_template_parse(text, count, "own", &t);
    free(text);
    if (status != READER_OK) {
        must(*reader_error() && !strchr(reader_error(), '\n'));
        return 0;
    }
    char *written = reader_template_text(&t);
    must(written != NULL);
    must(reader_template_parse(written, strlen(written), "own", &again) == READER_OK);
    must(memcmp(&t, &again, sizeof t) == 0);
    free(written);
    for (double width = 1; width < 1e5; width *= 1.7) {
        struct reader_grid g;
        const double em = 12, all = fmax(width, 4 * em) + 1e-6;
        reader_template_grid(&t, width, em, (int)width % 2, &g);
        must(g.texts >= 1 && g.texts <= READER_TEXTS_MAX);
        for (int i = 0; i < g.texts; i++)
            must(g.text[i].x >= 0 && g.text[i].width > 0 &&
                 g.text[i].x + g.text[i].width <= all &&
                 g.text[i].notes_x + g.text[i].notes_width <= all);
        for (int i = 0; i < READER_WIDES; i++)
            must(g.wide[i].x >= 0 && g.wide[i].width > 0 &&
                 g.wide[i].x + g.wide[i].width <= all);
    }
    return 0;
}

#ifndef LUTETIA_FUZZ_TARGET
int main(void)
{
    uint64_t state = 3;
    for (int turn = 0; turn < 60000; turn++) {
        static const char letters[] =
            "columns text notes 12.3*-#\n\t\r gutter size colour .. 0";
        uint8_t bytes[400];
        size_t count = 0;
        if (turn % 3) {
            struct reader_template t;
            must(reader_template_named(reader_template_names[turn % 2], &t) == READER_OK);
            char *text = reader_template_text(&t);
            count = strlen(text);
            memcpy(bytes, text, count);
            free(text);
            for (unsigned k = (unsigned)(sample_word(&state) % 4); k > 0; k--)
                bytes[sample_word(&state) % count] =
                    turn % 2 ? (uint8_t)letters[sample_word(&state) % (sizeof letters - 1)]
                             : (uint8_t)sample_word(&state);
        } else {
            count = sample_word(&state) % sizeof bytes;
            for (size_t i = 0; i < count; i++)
                bytes[i] = (uint8_t)letters[sample_word(&state) % (sizeof letters - 1)];
        }
        LLVMFuzzerTestOneInput(bytes, count);
    }
    return 0;
}
#endif
