/* typed_words.c - see typed_words.h. */
#include "typed_words.h"

#include <stdio.h>
#include <string.h>
#include <text.h>

void typed_words_begin(struct typed_words *w, bool can)
{
    w->typing = can;
    w->text[0] = '\0';
}

/* A character as UTF-8, where there is room. */
static void character_add(struct typed_words *w, uint32_t c)
{
    char bytes[FONT_UTF8_BYTES + 1] = "";
    font_utf8_put(c, bytes);
    if (strlen(w->text) + strlen(bytes) < sizeof w->text)
        strcat(w->text, bytes);
}

static void character_drop(struct typed_words *w)
{
    size_t length = strlen(w->text);
    while (length && ((unsigned char)w->text[length - 1] & 0xc0) == 0x80)
        length--;
    w->text[length ? length - 1 : 0] = '\0';
}

static enum stage_status enter(struct typed_words *w, struct stage *stage, bool shift)
{
    if (shift) {
        character_add(w, '\n');
        return STAGE_OK;
    }
    w->typing = false;
    return w->text[0] ? stage_text(stage, w->text) : STAGE_OK;
}

bool typed_words_input(struct typed_words *w, struct stage *stage, const struct input_event *e,
                       enum stage_status *status)
{
    *status = STAGE_OK;
    if (!w->typing)
        return false;
    if (e->kind == INPUT_TEXT) {
        if (e->character >= ' ' && e->character != 0x7f && e->character < 0x110000)
            character_add(w, (uint32_t)e->character);
        return true;
    }
    if (e->kind != INPUT_KEY_DOWN && e->kind != INPUT_KEY_REPEAT)
        return false; /* keys that were held come up for who took them */
    if (e->key == INPUT_KEY_BACKSPACE)
        character_drop(w);
    else if (e->key == INPUT_KEY_ENTER)
        *status = enter(w, stage, (e->modifiers & INPUT_SHIFT) != 0);
    else if (e->key == INPUT_KEY_ESCAPE)
        w->typing = false;
    return true;
}

bool typed_words_draw(const struct typed_words *w, struct stage_panel *panel,
                      const struct stage *stage, int height_px, double px,
                      struct stage_draw_list *list)
{
    const struct stage_theme *theme = stage_theme(stage);
    const double text_px = 1.6 * px * theme->sizes[STAGE_SIZE_PANEL_TEXT_SIZE];
    char line[sizeof w->text + 8];
    const char *last = strrchr(w->text, '\n');
    if (!w->typing)
        return false;
    snprintf(line, sizeof line, "%s|", last ? last + 1 : w->text);
    stage_panel_text(panel, list, line, text_px, height_px - text_px, text_px, false,
                     theme->colors[STAGE_COLOR_SLIDER_KNOB]);
    return true;
}
