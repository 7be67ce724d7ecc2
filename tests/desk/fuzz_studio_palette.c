/* fuzz_studio_palette.c - palettes from damaged text. Each is refused in one line that says
 * where; or its amounts are in their range. */
#include <studio_palette.h>

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static long good_ones;

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    struct studio_palette palette;
    char why[120] = "", *text = malloc(size + 1);
    if (!text)
        abort();
    memcpy(text, data, size);
    text[size] = '\0';
    config.pigments[config.pigments_count++] = *paper_pigment_find("french ultramarine");
    config.pigments[config.pigments_count++] = *paper_pigment_find("quinacridone rose");
    /* the first byte only counts (fuzz_pieces.h) */
    const bool good =
        studio_palette_parse(size > 0 ? text + 1 : text, &config, &palette, why, sizeof why);
    free(text);
    good_ones += good;
    if (!good && (!why[0] || strchr(why, '\n')))
        abort();
    if (strlen(palette.missing) >= sizeof palette.missing)
        abort();
    for (int i = 0; i < STUDIO_WELLS; i++)
        for (int k = 0; k <= PAPER_PIGMENTS_MAX; k++)
            if (!(palette.amount[i][k] >= 0 && palette.amount[i][k] <= 2) ||
                (k > config.pigments_count && palette.amount[i][k] != 0))
                abort();
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
#include "../fuzz_pieces.h"

int main(void)
{
    static const char *const pieces[] = {"1: water 0.8", "2: indian red 1, water 0.5",
                                         "8:",           "9: ",
                                         "\n3: ",        "\n4: french ultramarine 0.6",
                                         "\n",           ", ",
                                         "water 0.8",    "quinacridone rose 2",
                                         " 0.5",         "#",
                                         "nan",          "1e400",
                                         "-1",           "\t",
                                         "\r\n"};
    fuzz_pieces(pieces, sizeof pieces / sizeof *pieces, 30000, 9);
    return good_ones > 1000 && good_ones < 30000 ? 0 : 1; /* enough of them are read, too */
}
#endif
