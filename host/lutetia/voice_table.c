/* voice_table.c - see voice_table.h. */
#include "voice_table.h"
#include "lutetia.h"

#include <output_file.h>

#include <stdlib.h>

static void hz_print(FILE *to, double hz)
{
    if (hz > 0)
        fprintf(to, ",%.2f", hz);
    else
        fputc(',', to);
}

int voice_table_write(const char *path, const struct voice_frame *frames, int count)
{
    struct output_file out;
    if (!output_file_open(&out, path))
        return fail("voice", "%s: cannot write: %s", path, out.why);
    fputs("time_s,level,envelope,attack,pitch_hz,clarity,bright,formant_1_hz,formant_2_hz\r\n",
          out.stream);
    for (int i = 0; i < count; i++) {
        const struct voice_frame *f = &frames[i];
        fprintf(out.stream, "%.4f,%.6f,%.6f,%d", f->time_s, f->level, f->envelope, f->attack);
        hz_print(out.stream, f->pitch_hz);
        fprintf(out.stream, ",%.4f,%.4f", f->clarity, f->bright);
        hz_print(out.stream, f->formant_hz[0]);
        hz_print(out.stream, f->formant_hz[1]);
        fputs("\r\n", out.stream);
    }
    return output_file_commit(&out) ? EXIT_SUCCESS
                                    : fail("voice", "%s: cannot write: %s", path, out.why);
}
