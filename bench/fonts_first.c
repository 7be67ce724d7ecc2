/* fonts_first.c - see fonts_first.h. */
#include "fonts_first.h"

#include <face.h>

#include <math.h>

enum { LETTERS = 94, OPENINGS = 15 };

bool fonts_first_run(const char *font, struct bench_report *report)
{
    double least_s[LETTERS], sum_s = 0, most_s = 0;
    for (int turn = 0; turn < OPENINGS; turn++) {
        struct font_face *face;
        bool ok = font_face_open(font, 0, &face) == FONT_OK;
        for (int i = 0; ok && i < LETTERS; i++) {
            struct font_outline outline;
            uint32_t glyph = font_face_glyph(face, 33 + (uint32_t)i);
            double began_s = bench_thread_s();
            ok = font_face_outline(face, glyph, &outline) == FONT_OK;
            double s = bench_thread_s() - began_s;
            least_s[i] = turn ? fmin(least_s[i], s) : s;
            font_outline_finish(&outline);
        }
        font_face_close(face);
        if (!ok)
            return bench_fail("%s", font_error());
    }
    for (int i = 0; i < LETTERS; i++) {
        sum_s += least_s[i];
        most_s = fmax(most_s, least_s[i]);
    }
    sum_s /= LETTERS;
    bench_report_add(report, "first use", font, (struct bench_sample){sum_s, sum_s}, 1e6,
                     "us/glyph");
    bench_report_add(report, "first use, slowest glyph", font,
                     (struct bench_sample){most_s, most_s}, 1e6, "us/glyph");
    return true;
}
