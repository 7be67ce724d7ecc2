/* text_runs.c - what characters are to those who set lines of them: white, invisible, of a script, of a level. */
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
        scripts[i] = shared && known != HB_SCRIPT_INVALID ? known : script;
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
