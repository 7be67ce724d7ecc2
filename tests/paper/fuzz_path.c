/* fuzz_path.c - reads SVG paths, SVG files and recorded samples from damaged bytes. Each is
 * read, within its bounds, or refused with one line. The first byte of input chooses the
 * kind. */
#include <path.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static void refused(enum paper_status status, const void *left)
{
    if (status != PAPER_BAD_ARGUMENT || left || !*paper_error() || strchr(paper_error(), '\n'))
        abort();
}

static void lines_look(enum paper_status status, struct paper_lines *lines)
{
    if (status != PAPER_OK) {
        refused(status, lines->line);
        return;
    }
    for (int i = 0; i < lines->count; i++) {
        if (lines->line[i].points_count < 1)
            abort();
        for (int j = 0; j < 2 * lines->line[i].points_count; j++)
            if (!(fabs(lines->line[i].points[j]) <= 1e6))
                abort();
    }
    paper_lines_destroy(lines);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    if (count < 1)
        return 0;
    char *text = malloc(count); /* all but the first byte, and a 0 */
    if (!text)
        abort();
    memcpy(text, bytes + 1, count - 1);
    text[count - 1] = '\0';
    struct paper_lines lines;
    struct paper_stroke_sample *samples;
    int samples_count;
    enum paper_status status;
    switch (bytes[0] % 3) {
    case 0:
        lines_look(paper_path_parse(text, 0.25, &lines), &lines);
        break;
    case 1:
        lines_look(paper_svg_parse(text, count - 1, "fuzz", 0.25, &lines), &lines);
        break;
    default:
        status = paper_samples_parse(text, count - 1, "fuzz", &samples, &samples_count);
        if (status != PAPER_OK)
            refused(status, samples);
        else if (paper_stroke_check(&(struct paper_stroke){.samples_count = samples_count,
                                                           .samples = samples}) != PAPER_OK)
            abort();
        free(samples);
    }
    free(text);
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
#include "../sample.h"

/* Without libFuzzer: good inputs, each damaged in many ways, the same in every run. */
int main(void)
{
    static const char *const seeds[] = {
        "0M10 80C40 10 65 10 95 80S150 150 180 80zm5 5 l-1-1.5.5e1,2H3v-4Q1 2 3 4t5 6A7 8 9 0 "
        "1 2 3",
        "0M0 0a25,25 -30 0,1 50,-25l 50,-25 A1e3.5 1 0 110 0z",
        "1<svg><g transform='translate(1,2) rotate(3 4 5)'><path d='M1 2 3 "
        "4z'/></g><defs/></svg>",
        "1<?xml version='1.0'?><!DOCTYPE svg [<!ENTITY a 'M1 1'>]><svg><path d='&a;L2 2' "
        "transform='matrix(1 2 3 4 5 6)skewY(7)'/></svg>",
        "2time,x,y\n0,1,2\n0.5,2,3,0.5\n1 3 4 1 0.1 -0.1\n# end\n"};
    enum { ROUNDS = 20000, MOST = 400 };
    uint8_t bytes[MOST];
    uint64_t state = 18;
    for (int i = 0; i < ROUNDS; i++) {
        const char *seed = seeds[i % (int)(sizeof seeds / sizeof *seeds)];
        size_t count = strlen(seed);
        memcpy(bytes, seed, count);
        bytes[0] = (uint8_t)(seed[0] - '0');
        for (uint64_t changes = sample_word(&state) % 6; changes > 0; changes--) {
            size_t at = 1 + sample_word(&state) % (count - 1);
            switch (sample_word(&state) % 4) {
            case 0:
                bytes[at] = (uint8_t)sample_word(&state);
                break;
            case 1: /* one from elsewhere */
                bytes[at] = bytes[1 + sample_word(&state) % (count - 1)];
                break;
            case 2: /* cut out */
                memmove(bytes + at, bytes + at + 1, count - at - 1);
                count -= count > 4;
                break;
            default: /* doubled */
                if (count < MOST) {
                    memmove(bytes + at + 1, bytes + at, count - at);
                    count++;
                }
            }
        }
        LLVMFuzzerTestOneInput(bytes, count);
    }
    return 0;
}
#endif
