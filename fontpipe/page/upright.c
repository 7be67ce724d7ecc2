/* upright.c - letters in lines that go down: which of them stand, by UTR 50 (Unicode's property
 * Vertical_Orientation, as ICU has it), and few digits beside each other in one place, as dates
 * and numbers have them (tate-chu-yoko). Where there is no ICU, scripts say which stand. */
#include "page_internal.h"

#include <hb-ot.h>

#include <math.h>

enum { ACROSS_MOST = 2 }; /* digits that fit one place */

bool upright_script(hb_script_t script)
{
    return script == HB_SCRIPT_HAN || script == HB_SCRIPT_HIRAGANA ||
           script == HB_SCRIPT_KATAKANA || script == HB_SCRIPT_HANGUL ||
           script == HB_SCRIPT_BOPOMOFO || script == HB_SCRIPT_YI;
}

/* Whether a font has forms for lines that go down. */
static bool has_vertical_forms(hb_font_t *font)
{
    enum { AT_ONCE = 32 };
    hb_face_t *face = hb_font_get_face(font);
    hb_tag_t tags[AT_ONCE];
    for (unsigned from = 0, n = AT_ONCE; n == AT_ONCE; from += n) {
        hb_ot_layout_table_get_feature_tags(face, HB_OT_TAG_GSUB, from, &n, tags);
        for (unsigned i = 0; i < n; i++)
            if (tags[i] == HB_TAG('v', 'e', 'r', 't') || tags[i] == HB_TAG('v', 'r', 't', '2'))
                return true;
    }
    return false;
}

static bool letter_stands(struct page_text *t, const struct letter *l)
{
    struct font_shaped_face *face = &t->styles[l->style]->shaper->faces[l->face];
    switch (font_stand_of(l->character)) {
    case FONT_STANDS:
        return true;
    case FONT_STANDS_IF_DRAWN:
        font_shaped_refresh(face);
        return has_vertical_forms(face->hb);
    case FONT_STAND_UNKNOWN:
        return upright_script(l->script);
    case FONT_LIES:
        break;
    }
    return false;
}

static bool is_digit(const struct letter *l)
{
    return l->character >= '0' && l->character <= '9';
}

/* Letters begin..end are digits, and what is beside them stands on one side at least and lies
 * on none. */
static bool digits_stand(const struct paragraph *p, int begin, int end)
{
    const struct letter *l = p->letters;
    bool before = begin > 0 && !font_text_white(l[begin - 1].character);
    bool behind = end < p->count && !font_text_white(l[end].character);
    if ((before && !l[begin - 1].stands) || (behind && !l[end].stands) || !(before || behind))
        return false;
    for (int i = begin + 1; i < end; i++)
        if (l[i].style != l[begin].style || l[i].face != l[begin].face ||
            l[i].level != l[begin].level)
            return false;
    return true;
}

void upright_find(struct page_text *t, struct paragraph *p)
{
    for (int i = 0; i < p->count; i++) {
        struct letter *l = &p->letters[i];
        /* What belongs to a letter does as it does. */
        l->stands = i > 0 && !l->grapheme ? l[-1].stands : letter_stands(t, l);
    }
    for (int begin = 0, end; begin < p->count; begin = end) {
        for (end = begin; end < p->count && is_digit(&p->letters[end]);)
            end++;
        if (end == begin)
            end++;
        else if (end - begin <= ACROSS_MOST && digits_stand(p, begin, end))
            for (int i = begin; i < end; i++) {
                p->letters[i].stands = p->letters[i].across = true;
                p->letters[i].grapheme = i == begin;
            }
    }
}

void upright_across(struct shaped *glyphs, int count, hb_font_t *font, double scale,
                    double em_px, double centre_px)
{
    double width = 0, pen = 0, low = 0, high = 0;
    for (int i = 0; i < count; i++) {
        hb_glyph_extents_t ink;
        width += (double)glyphs[i].advance_px;
        if (!hb_font_get_glyph_extents(font, glyphs[i].glyph, &ink))
            continue;
        high = fmax(high, scale * ink.y_bearing);
        low = fmin(low, scale * (ink.y_bearing + ink.height));
    }
    for (int i = 0; i < count; i++) {
        struct shaped *g = &glyphs[i];
        double advance = (double)g->advance_px;
        /* Along the line the ink's middle is that of the place, whose end the pen has passed
         * behind the first glyph. */
        g->y_px = (float)(pen + (double)g->x_px - width / 2 + centre_px);
        g->x_px = (float)(em_px / 2 + (high + low) / 2 - (i ? em_px : 0));
        g->advance_px = i ? 0 : (float)em_px;
        pen += advance;
    }
}
