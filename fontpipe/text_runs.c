/* text_runs.c - what characters are to those who set lines of them: white, invisible, of a
 * script, of a level. */
#include "text_internal.h"

#include <stdlib.h>

#include <fribidi.h>

bool font_text_invisible(uint32_t c)
{
    hb_unicode_general_category_t category =
        hb_unicode_general_category(hb_unicode_funcs_get_default(), c);
    return category == HB_UNICODE_GENERAL_CATEGORY_CONTROL ||
           category == HB_UNICODE_GENERAL_CATEGORY_FORMAT || (c >= 0xfe00 && c <= 0xfe0f) ||
           c == 0x34f;
}

bool font_text_mark(uint32_t c)
{
    hb_unicode_general_category_t category =
        hb_unicode_general_category(hb_unicode_funcs_get_default(), c);
    return category == HB_UNICODE_GENERAL_CATEGORY_NON_SPACING_MARK ||
           category == HB_UNICODE_GENERAL_CATEGORY_ENCLOSING_MARK ||
           category == HB_UNICODE_GENERAL_CATEGORY_SPACING_MARK;
}

bool font_text_white(uint32_t c)
{
    return c == ' ' || c == '\t' || c == 0x1680 ||
           (c >= 0x2000 && c <= 0x200a && c != 0x2007) || c == 0x205f || c == 0x3000;
}

bool font_text_joins(hb_script_t script)
{
    static const hb_script_t joined[] = {HB_SCRIPT_ARABIC,         HB_SCRIPT_SYRIAC,
                                         HB_SCRIPT_MONGOLIAN,      HB_SCRIPT_NKO,
                                         HB_SCRIPT_ADLAM,          HB_SCRIPT_MANDAIC,
                                         HB_SCRIPT_MANICHAEAN,     HB_SCRIPT_PHAGS_PA,
                                         HB_SCRIPT_SOGDIAN,        HB_SCRIPT_HANIFI_ROHINGYA,
                                         HB_SCRIPT_PSALTER_PAHLAVI};
    for (size_t i = 0; i < sizeof joined / sizeof *joined; i++)
        if (script == joined[i])
            return true;
    return false;
}

void font_features_apart(hb_feature_t *features, unsigned *count)
{
    static const char names[FONT_APART][5] = {"liga", "clig", "dlig", "hlig"};
    for (unsigned i = *count; i > 0; i--)
        features[i - 1 + FONT_APART] = features[i - 1];
    for (int i = 0; i < FONT_APART; i++)
        features[i] =
            (hb_feature_t){.tag = HB_TAG(names[i][0], names[i][1], names[i][2], names[i][3]),
                           .end = HB_FEATURE_GLOBAL_END};
    *count += FONT_APART;
}

/* ---- pictures of several characters ---- */

enum { JOINER = 0x200d, PICTURED = 0xfe0f, KEYCAP = 0x20e3 };

static bool is_region(uint32_t c)
{
    return c >= 0x1f1e6 && c <= 0x1f1ff;
}

static bool is_skin(uint32_t c)
{
    return c >= 0x1f3fb && c <= 0x1f3ff;
}

/* What may be a picture: Unicode's Extended_Pictographic, and a few signs in its blocks that
 * nothing joins. */
static bool is_pictographic(uint32_t c)
{
    return c == 0xa9 || c == 0xae || c == 0x203c || c == 0x2049 || c == 0x2122 || c == 0x2139 ||
           (c >= 0x2190 && c <= 0x2bff) || c == 0x3030 || c == 0x303d || c == 0x3297 ||
           c == 0x3299 || (c >= 0x1f000 && c <= 0x1faff && !is_region(c));
}

/* One picture's characters: itself, that it is one, its skin, a flag's letters. *told: there is
 * one of these. */
static int picture_length(const uint32_t *c, int count, bool *told)
{
    int n = 1;
    for (; n < count; n++) {
        bool more = c[n] == PICTURED || is_skin(c[n]) || c[n] == KEYCAP ||
                    (c[n] >= 0xe0020 && c[n] <= 0xe007f);
        if (!more)
            break;
        *told = true;
    }
    return n;
}

int font_text_picture(const uint32_t *c, int count)
{
    if (count < 2)
        return 0;
    if (is_region(c[0]))
        return is_region(c[1]) ? 2 : 0;
    if ((c[0] >= '0' && c[0] <= '9') || c[0] == '#' || c[0] == '*') {
        int n = c[1] == PICTURED ? 2 : 1;
        return n < count && c[n] == KEYCAP ? n + 1 : 0;
    }
    if (!is_pictographic(c[0]))
        return 0;
    bool told = false;
    int n = picture_length(c, count, &told);
    while (n + 1 < count && c[n] == JOINER && is_pictographic(c[n + 1])) {
        told = true;
        n += 1 + picture_length(c + n + 1, count - n - 1, &told);
    }
    return told ? n : 0;
}

/* A new line, and what Unicode has beside it. */
bool font_text_ends_line(uint32_t c)
{
    return c == '\n' || c == 0x0b || c == 0x0c || c == 0x85 || c == 0x2028 || c == 0x2029;
}

void font_scripts_choose(const uint32_t *characters, int count, hb_script_t *scripts)
{
    hb_unicode_funcs_t *unicode = hb_unicode_funcs_get_default();
    hb_script_t known = HB_SCRIPT_INVALID;
    for (int i = 0; i < count; i++) {
        hb_script_t script = hb_unicode_script(unicode, characters[i]);
        bool shared = script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED;
        if (!shared && known == HB_SCRIPT_INVALID)
            for (int k = 0; k < i; k++)
                scripts[k] = script;
        known = shared ? known : script;
        scripts[i] = !shared                      ? script
                     : known != HB_SCRIPT_INVALID ? known
                                                  : HB_SCRIPT_COMMON; /* a joiner, too */
    }
}

bool font_levels_find(const uint32_t *characters, int count, int direction, int8_t *levels,
                      int *base)
{
    FriBidiCharType *types = calloc((size_t)count + 1, sizeof *types);
    FriBidiBracketType *brackets = calloc((size_t)count + 1, sizeof *brackets);
    FriBidiParType paragraph = direction > 0   ? FRIBIDI_PAR_RTL
                               : direction < 0 ? FRIBIDI_PAR_LTR
                                               : FRIBIDI_PAR_ON;
    bool good = types && brackets;
    if (good) {
        fribidi_get_bidi_types(characters, count, types);
        fribidi_get_bracket_types(characters, count, types, brackets);
        good = fribidi_get_par_embedding_levels_ex(types, brackets, count, &paragraph, levels);
    }
    *base = FRIBIDI_IS_RTL(paragraph) ? 1 : 0;
    free(types);
    free(brackets);
    return good;
}

enum font_direction font_direction_of(uint32_t c)
{
    const FriBidiCharType type = fribidi_get_bidi_type(c);
    if (FRIBIDI_IS_EXPLICIT(type) || FRIBIDI_IS_ISOLATE(type))
        return FONT_EMBEDS;
    if (type == FRIBIDI_TYPE_RTL || type == FRIBIDI_TYPE_AL)
        return FONT_RUNS_LEFT;
    return type == FRIBIDI_TYPE_LTR  ? FONT_RUNS_RIGHT
           : type == FRIBIDI_TYPE_AN ? FONT_NUMBERS
                                     : FONT_RUNS_NOWHERE;
}

bool font_bracket(uint32_t c)
{
    return fribidi_get_bracket(c) != FRIBIDI_NO_BRACKET;
}

void font_runs_order(struct font_run *runs, int count)
{
    int highest = 0, lowest = 127;
    for (int i = 0; i < count; i++) {
        highest = runs[i].level > highest ? runs[i].level : highest;
        if (runs[i].level & 1)
            lowest = runs[i].level < lowest ? runs[i].level : lowest;
    }
    for (int level = highest; level >= lowest; level--)
        for (int i = 0; i < count; i++) {
            int end = i;
            while (end < count && runs[end].level >= level)
                end++;
            for (int a = i, b = end - 1; a < b; a++, b--) {
                struct font_run swap = runs[a];
                runs[a] = runs[b];
                runs[b] = swap;
            }
            i = end > i ? end : i;
        }
}
