/* fuzz_themes.c - themes from damaged text. Each is refused in one line, and the theme is as it
 * was; or it is read, and a stage can draw with it. */
#include <theme.h>

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

static void color_look(struct stage_color c)
{
    const float parts[] = {c.r, c.g, c.b, c.a};
    for (int i = 0; i < 4; i++)
        if (!(parts[i] >= 0 && parts[i] <= 1))
            abort();
}

static void theme_look(const struct stage_theme *theme)
{
    for (int i = 0; i < STAGE_COLORS_COUNT; i++) {
        color_look(theme->colors[i]);
        color_look(stage_color_mix(theme->colors[i], theme->colors[0], 0.25));
        color_look(stage_color_fade(theme->colors[i], 0.5));
    }
    for (int i = 0; i < STAGE_SIZES_COUNT; i++)
        if (!isfinite(theme->sizes[i]))
            abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    struct stage_theme theme, before;
    char *text = malloc(count ? count : 1); /* its end is where a sanitizer sees it */
    if (!text || stage_theme_open(count % 2 ? "dark" : "light", &theme) != STAGE_OK)
        abort();
    memcpy(text, bytes, count);
    before = theme;
    enum stage_status status = stage_theme_read(text, count, "fuzz", &theme);
    free(text);
    if (status == STAGE_OK)
        theme_look(&theme);
    else if (status != STAGE_BAD_FILE || !*stage_error() || strchr(stage_error(), '\n') ||
             memcmp(&theme, &before, sizeof theme) != 0)
        abort();
    return 0;
}

#ifndef LUTETIA_FUZZ_LIBFUZZER
#include "damage.h"

int main(void)
{
    static const char *const seeds[] = {
        "# a theme\nbackground = #f5f4ef\n  letter=#15161aff\nskin = #00000080\n\nmass_radius "
        "= 3.5\n"
        "panel_width=240\r\n",
        "shadow = #0000\nfloor_width = 1e1\nspring_stretched = #c0392b\nhand_width = 2",
    };
    enum { ROUNDS = 40000 };
    int read = 0;
    for (uint64_t i = 0; i < ROUNDS; i++) {
        char text[DAMAGE_MOST];
        struct stage_theme theme;
        size_t count = damage(seeds[i % 2], i, text);
        LLVMFuzzerTestOneInput((const uint8_t *)text, count);
        if (stage_theme_open("light", &theme) != STAGE_OK)
            return 1;
        read += stage_theme_read(text, count, "fuzz", &theme) == STAGE_OK;
    }
    return read > ROUNDS / 50 && read < ROUNDS ? 0 : 1; /* enough of them are read, too */
}
#endif
