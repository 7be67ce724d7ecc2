/* signs.c - signs with a way of their own in a line: those that stand in the margin, hyphens,
 * tabs. See page_internal.h. */
#include "page_internal.h"

#include <math.h>
#include <string.h>

double signs_protrusion(uint32_t c, bool at_end)
{
    static const struct {
        const char *signs;
        double begin, end;
    } table[] = {{".,", 0, 0.7},    {"-", 0, 0.5}, {";:", 0, 0.4}, {"!?", 0, 0.2},
                 {"'\"", 0.5, 0.5}, {"(", 0.1, 0}, {")", 0, 0.1},  {"AVWYT", 0.05, 0.05}};
    if (c == 0x2018 || c == 0x201c || c == 0x201e || c == 0x201a || c == 0xab)
        return at_end ? 0.3 : 0.6;
    if (c == 0x2019 || c == 0x201d || c == 0xbb)
        return at_end ? 0.6 : 0.3;
    if (c == 0x2010 || c == 0x2013 || c == 0x3001 || c == 0x3002)
        return at_end ? 0.4 : 0;
    for (size_t i = 0; c && c < 0x80 && i < sizeof table / sizeof *table; i++)
        if (strchr(table[i].signs, (int)c))
            return at_end ? table[i].end : table[i].begin;
    return 0;
}

double signs_hyphen(const struct page_text *t, const struct letter *l, uint32_t *glyph)
{
    const struct style *style = t->styles[l->style];
    const struct font_shaped_face *face = &style->shaper->faces[l->face];
    hb_codepoint_t found = font_face_glyph(face->face, 0x2010);
    if (!found)
        found = font_face_glyph(face->face, '-');
    *glyph = found;
    return found ? hb_font_get_glyph_h_advance(face->hb, found) * style->look.size_px /
                       face->units_per_em
                 : 0;
}

/* The width of what a tab goes before: up to the next one or the line's end; for a decimal tab
 * up to the point. */
static double tabbed_width(const struct paragraph *p, int begin, int end,
                           enum page_tab_align align)
{
    double px = 0;
    for (int i = begin;
         i < end && p->characters[i] != '\t' && !font_text_ends_line(p->characters[i]); i++) {
        if (align == PAGE_TAB_DECIMAL && (p->characters[i] == '.' || p->characters[i] == ','))
            break;
        px += (double)p->letters[i].advance_px;
    }
    return px;
}

double signs_tab(const struct page_text *t, const struct paragraph *p, int tab, int end,
                 double pen)
{
    double every = 4 * t->styles[p->letters[tab].style]->look.size_px;
    for (int i = 0; i < p->manner.tabs_count; i++) {
        const struct page_tab *stop = &p->manner.tabs[i];
        if (stop->x_px <= pen + 1e-6)
            continue;
        double width = tabbed_width(p, tab + 1, end, stop->align);
        double back = stop->align == PAGE_TAB_LEFT     ? 0
                      : stop->align == PAGE_TAB_CENTER ? width / 2
                                                       : width;
        return fmax(pen, stop->x_px - back);
    }
    return (floor(pen / every + 1e-6) + 1) * every;
}
