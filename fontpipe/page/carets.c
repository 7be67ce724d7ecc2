/* carets.c - between which letters a caret may stand: between clusters of UAX 29, with its rule
 * for conjuncts (GB9c, since Unicode 15.1). */
#include "page_internal.h"

/* A regional indicator: two make a flag. */
static bool flag_half(uint32_t c)
{
    return c >= 0x1f1e6 && c <= 0x1f1ff;
}

/* Of the six scripts whose consonants a virama joins (InCB): the block, of 128 characters; 0:
 * it is none of theirs. */
static uint32_t indic_block(uint32_t c)
{
    uint32_t block = c & ~0x7fu;
    return block == 0x900 || block == 0x980 || block == 0xa80 || block == 0xb00 ||
                   block == 0xc00 || block == 0xd00
               ? block
               : 0;
}

/* Their blocks are of one plan: consonants from KA to HA, and some behind, are at the same
 * places in all of them. */
static bool indic_consonant(uint32_t c)
{
    uint32_t at = c & 0x7f;
    switch (indic_block(c)) {
    case 0x900:
        return (at >= 0x15 && at <= 0x39) || (at >= 0x58 && at <= 0x5f) || at >= 0x78;
    case 0x980:
        return (at >= 0x15 && at <= 0x39) || (at >= 0x5c && at <= 0x5f && at != 0x5e) ||
               at == 0x70 || at == 0x71;
    case 0xa80:
        return (at >= 0x15 && at <= 0x39) || at == 0x79;
    case 0xb00:
        return (at >= 0x15 && at <= 0x39) || (at >= 0x5c && at <= 0x5f && at != 0x5e) ||
               at == 0x71;
    case 0xc00:
        return (at >= 0x15 && at <= 0x39) || (at >= 0x58 && at <= 0x5a);
    case 0xd00:
        return at >= 0x15 && at <= 0x3a;
    default:
        return false;
    }
}

static bool indic_virama(uint32_t c)
{
    return indic_block(c) && (c & 0x7f) == 0x4d;
}

/* A consonant that a virama joins to one before it, with marks and joiners between them. */
static bool conjunct(const struct paragraph *p, int i)
{
    bool joined = false;
    if (!indic_consonant(p->characters[i]))
        return false;
    for (int k = i - 1; k >= 0; k--) {
        uint32_t c = p->characters[k];
        joined = joined || indic_virama(c);
        if (indic_consonant(c))
            return joined;
        if (!font_text_mark(c) && c != 0x200d)
            return false;
    }
    return false;
}

/* Whether a caret may stand before letter i, which stands behind so many halves of flags. */
static bool caret_before(const struct paragraph *p, int i, int flags)
{
    uint32_t c = p->characters[i], b = i ? p->characters[i - 1] : 0;
    if (!i)
        return true;
    if (font_text_mark(c) || c == 0x200d || c == 0x200c || (b == 0x200d && c >= 0x203c) ||
        (c == '\n' && b == '\r') || (c >= 0x1f3fb && c <= 0x1f3ff) ||
        (c >= 0x1160 && c <= 0x11ff && b >= 0x1100) || (c >= 0xe0020 && c <= 0xe007f))
        return false;
    /* SARA AM of Thai and Lao, which is drawn over the letter before it. */
    if (c == 0xe33 || c == 0xeb3 || conjunct(p, i))
        return false;
    return !(flag_half(c) && flags % 2);
}

void carets_find(const struct page_text *t, struct paragraph *p, int begin, int end)
{
    int flags = 0;
    while (flags < begin && flag_half(p->characters[begin - 1 - flags]))
        flags++;
    for (int i = begin; i < end; i++) {
        struct letter *l = &p->letters[i];
        l->grapheme = caret_before(p, i, flags) &&
                      !(i && t->styles[l->style]->is_inset && l->style == l[-1].style);
        flags = flag_half(p->characters[i]) ? flags + 1 : 0;
    }
}

bool carets_apart(uint32_t c)
{
    return !font_text_mark(c) && c != 0x200d && c != 0x200c && !flag_half(c);
}
