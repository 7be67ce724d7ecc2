/* pdf_letters.c - which glyph with which text is which code of which font: see
 * pdf_internal.h. */
#include "pdf_internal.h"

#include <string.h>

/* The font of that face that has room; -1: no memory. */
static int font_find(struct font_document *p, struct font_face *face, bool pictures)
{
    int most = pictures ? PDF_PICTURES_MAX : PDF_CODES_MAX;
    uint64_t version = font_face_version(face);
    for (int i = p->fonts_count - 1; i >= 0; i--)
        if (p->fonts[i].face == face && p->fonts[i].version == version &&
            p->fonts[i].pictures == pictures && p->fonts[i].count < most)
            return i;
    if (!array_reserve(&p->fonts, &p->fonts_capacity, p->fonts_count + 1, sizeof *p->fonts))
        return -1;
    p->fonts[p->fonts_count] = (struct pdf_font){
        .face = face, .version = version, .pictures = pictures, .number = pdf_object(p)};
    return p->fonts_count++;
}

static bool letter_place(struct font_document *p, int letter, bool picture)
{
    struct pdf_letter *l = &p->letters[letter];
    l->font = font_find(p, l->face, picture);
    if (l->font < 0)
        return false;
    struct pdf_font *font = &p->fonts[l->font];
    if (!array_reserve(&font->letters, &font->capacity, font->count + 1, sizeof *font->letters))
        return false;
    font->letters[font->count++] = letter;
    l->code = font->count;
    return true;
}

static double width_of(struct font_face *face, uint32_t glyph)
{
    struct font_face_info info;
    double advance = 0;
    font_face_describe(face, &info);
    (void)font_face_advance(face, glyph, &advance);
    return advance / info.units_per_em;
}

int pdf_letter_find(struct font_document *p, struct font_face *face, uint32_t glyph,
                    bool picture, const char *text, size_t bytes, int parts)
{
    enum { TEXT_MAX = 64 };
    if (bytes > TEXT_MAX || !text)
        bytes = 0;
    const uint64_t key[2] = {font_face_version(face),
                             (uint64_t)glyph << 32 | (bytes ? font_hash(text, bytes) : 0)};
    uint32_t bucket = font_hash(key, sizeof key) % PDF_BUCKETS;
    for (int k = p->heads[bucket] - 1; k >= 0; k = p->letters[k].next) {
        const struct pdf_letter *l = &p->letters[k];
        const struct pdf_font *font = &p->fonts[l->font];
        if (l->face == face && font->version == key[0] && font->pictures == picture &&
            l->glyph == glyph && l->parts == parts && l->bytes == bytes &&
            (!bytes || memcmp(p->said + l->said, text, bytes) == 0))
            return k;
    }
    int k = p->letters_count;
    if (!array_reserve(&p->letters, &p->letters_capacity, k + 1, sizeof *p->letters))
        return -1;
    p->letters[k] = (struct pdf_letter){.face = face,
                                        .glyph = glyph,
                                        .said = pdf_say(p, text, bytes),
                                        .bytes = bytes,
                                        .parts = parts,
                                        .width = parts ? width_of(face, glyph) / parts : 0,
                                        .next = p->heads[bucket] - 1};
    if (p->failed || !letter_place(p, k, picture))
        return -1;
    p->letters_count++;
    p->heads[bucket] = k + 1;
    return k;
}
