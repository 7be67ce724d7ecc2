/* pdf_font.c - fonts as objects: see pdf_internal.h.
 *
 * An embedded font's codes have two bytes. Those of TrueType are mapped to its glyphs by a
 * table (CIDToGIDMap), those of a CFF that HarfBuzz cut by the font's encoding; where we made
 * the CFF, its glyphs are in the order of the codes. What each code says is a table of its own
 * (ToUnicode). Glyphs that are pictures are drawn by the page; their fonts (Type 3) have only
 * their text. */
#include "face_internal.h"
#include "pdf_internal.h"

#include <hb-ot.h>

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_MAX_BYTES = 64, BLOCK_MAX = 100 };

/* What all of these tables begin and end with. */
static void cmap_begin(FILE *f, const char *name, const char *more, bool two_bytes)
{
    fprintf(f,
            "/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n"
            "/CIDSystemInfo << /Registry (Adobe) /Ordering (%s) /Supplement 0 >> def\n"
            "/CMapName /Lutetia-%s def\n%s1 begincodespacerange\n%s\nendcodespacerange\n",
            name, name, more, two_bytes ? "<0000> <FFFF>" : "<00> <FF>");
}

static void cmap_end(FILE *f)
{
    fputs("endcmap\nCMapName currentdict /CMap defineresource pop\nend\nend\n", f);
}

/* Writes a stream whose bytes `put` writes. */
struct stream {
    char *bytes;
    size_t count;
    FILE *f;
};

static bool stream_open(struct font_document *p, struct stream *s)
{
    *s = (struct stream){0};
    s->f = open_memstream(&s->bytes, &s->count);
    p->failed = p->failed || !s->f;
    return s->f != NULL;
}

static int stream_close(struct font_document *p, struct stream *s, const char *more)
{
    int number = 0;
    if (fclose(s->f) != 0)
        p->failed = true;
    else
        pdf_stream(p, &number, more, s->bytes, s->count);
    free(s->bytes);
    return number;
}

/* Which text each code shows. A glyph beside a cluster's first shows nothing: a word joiner,
 * since programs take the code itself for a letter where there is none. */
static int texts_put(struct font_document *p, const struct pdf_font *font)
{
    struct stream s;
    if (!stream_open(p, &s))
        return 0;
    cmap_begin(s.f, "UCS", "/CMapType 2 def\n", !font->pictures);
    for (int i = 0; i < font->count; i++) {
        const struct pdf_letter *l = &p->letters[font->letters[i]];
        int left = font->count - i;
        if (i % BLOCK_MAX == 0)
            fprintf(s.f, "%d beginbfchar\n", left < BLOCK_MAX ? left : BLOCK_MAX);
        fprintf(s.f, "<%0*X> <", font->pictures ? 2 : 4, (unsigned)l->code);
        if (l->bytes)
            pdf_utf16_put(p->said, l->said, l->said + l->bytes, s.f);
        else
            fputs("2060", s.f);
        fputs(">\n", s.f);
        if ((i + 1) % BLOCK_MAX == 0 || left == 1)
            fputs("endbfchar\n", s.f);
    }
    cmap_end(s.f);
    return stream_close(p, &s, "");
}

/* ---- fonts of pictures ---- */

static void pictures_put(struct font_document *p, const struct pdf_font *font)
{
    struct font_face_info info;
    int texts = texts_put(p, font), *glyphs = calloc((size_t)font->count, sizeof *glyphs);
    p->failed = p->failed || !glyphs;
    font_face_describe(font->face, &info);
    for (int i = 0; glyphs && i < font->count; i++) {
        char blank[64];
        int bytes = snprintf(blank, sizeof blank, "%.7g 0 0 0 0 0 d1\n",
                             p->letters[font->letters[i]].width * 1000);
        pdf_stream(p, &glyphs[i], "", blank, (size_t)bytes);
    }
    pdf_object_begin(p, font->number);
    fprintf(p->f,
            "<< /Type /Font /Subtype /Type3 /FontBBox [0 0 0 0] /FontMatrix [0.001 0 0 0.001 0 "
            "0]\n/FirstChar 1 /LastChar %d /ToUnicode %d 0 R /Resources << >>\n/CharProcs <<",
            font->count, texts);
    for (int i = 0; glyphs && i < font->count; i++)
        fprintf(p->f, " /g%d %d 0 R", i, glyphs[i]);
    fputs(" >>\n/Encoding << /Type /Encoding /Differences [1", p->f);
    for (int i = 0; i < font->count; i++)
        fprintf(p->f, " /g%d", i);
    fputs("] >>\n/Widths [", p->f);
    for (int i = 0; i < font->count; i++)
        fprintf(p->f, " %.6g", p->letters[font->letters[i]].width * 1000);
    fputs(" ] >>\nendobj\n", p->f);
    free(glyphs);
}

/* ---- embedded fonts ---- */

/* ABCDEF+Name: six letters that tell this set of glyphs from others of the font. */
static void name_make(const struct font_document *p, const struct pdf_font *font,
                      char room[NAME_MAX_BYTES])
{
    struct font_face_info info;
    const char *name = FT_Get_Postscript_Name(font->face->ft);
    uint32_t hash = (uint32_t)font->number;
    font_face_describe(font->face, &info);
    if (!name || !*name)
        name = *info.family ? info.family : "Font";
    for (int i = 0; i < font->count; i++) {
        const uint32_t of[2] = {hash, p->letters[font->letters[i]].glyph};
        hash = font_hash(of, sizeof of);
    }
    int n = 0;
    for (; n < 6; n++, hash /= 26)
        room[n] = (char)('A' + hash % 26);
    room[n++] = '+';
    int begin = n;
    for (; *name && n < NAME_MAX_BYTES - 1; name++)
        if (isalnum((unsigned char)*name) || *name == '-' || *name == '_')
            room[n++] = *name;
    if (n == begin)
        room[n++] = 'F';
    room[n] = '\0';
}

static int program_put(struct font_document *p, const struct pdf_program *program)
{
    char more[64] = "/Subtype /CIDFontType0C";
    int number = 0;
    if (program->truetype)
        snprintf(more, sizeof more, "/Length1 %zu", program->count);
    pdf_stream(p, &number, more, program->bytes, program->count);
    return number;
}

static int descriptor_put(struct font_document *p, const struct pdf_font *font,
                          const struct pdf_program *program, const char *name)
{
    struct font_face_info info;
    FT_Face ft = font->face->ft;
    int file = program_put(p, program), number = pdf_object(p);
    font_face_describe(font->face, &info);
    double em = 1000 / info.units_per_em;
    double slant = font_face_manner(font->face).slant ? -12 : 0;
    pdf_object_begin(p, number);
    fprintf(p->f,
            "<< /Type /FontDescriptor /FontName /%s /Flags %d /FontBBox [%.5g %.5g %.5g %.5g]\n"
            "/ItalicAngle %g /Ascent %.5g /Descent %.5g /CapHeight %.5g /StemV %.4g "
            "/FontFile%d %d 0 R >>\nendobj\n",
            name, 4 | (FT_IS_FIXED_WIDTH(ft) ? 1 : 0) | (slant != 0 ? 64 : 0),
            (double)ft->bbox.xMin * em, (double)ft->bbox.yMin * em, (double)ft->bbox.xMax * em,
            (double)ft->bbox.yMax * em, slant, info.ascender * em, info.descender * em,
            0.9 * info.ascender * em, font_face_stem(font->face) * 1000,
            program->truetype ? 2 : 3, file);
    return number;
}

/* The glyph of each code, for TrueType: two bytes each, from code 0 on. */
static int glyphs_table_put(struct font_document *p, const struct pdf_font *font,
                            const struct pdf_program *program)
{
    struct stream s;
    if (!stream_open(p, &s))
        return 0;
    for (int i = -1; i < font->count; i++) {
        unsigned glyph = i < 0 ? 0 : program->glyphs[i];
        fputc((int)(glyph >> 8 & 0xff), s.f);
        fputc((int)(glyph & 0xff), s.f);
    }
    return stream_close(p, &s, "");
}

/* The same for CFF: the font's encoding. */
static int encoding_put(struct font_document *p, const struct pdf_font *font,
                        const struct pdf_program *program)
{
    struct stream s;
    if (!stream_open(p, &s))
        return 0;
    cmap_begin(s.f, "Identity", "/CMapType 1 def\n/WMode 0 def\n", true);
    for (int i = 0; i < font->count; i++) {
        int left = font->count - i;
        if (i % BLOCK_MAX == 0)
            fprintf(s.f, "%d begincidchar\n", left < BLOCK_MAX ? left : BLOCK_MAX);
        fprintf(s.f, "<%04X> %u\n", (unsigned)(i + 1), (unsigned)program->glyphs[i]);
        if ((i + 1) % BLOCK_MAX == 0 || left == 1)
            fputs("endcidchar\n", s.f);
    }
    cmap_end(s.f);
    return stream_close(p, &s,
                        "/Type /CMap /CMapName /Lutetia-Identity /CIDSystemInfo << /Registry "
                        "(Adobe) /Ordering (Identity) /Supplement 0 >> /WMode 0");
}

/* Widths by the numbers that the program's glyphs have in PDF: of CFF that was cut its own,
 * else the codes. */
static void widths_put(struct font_document *p, const struct pdf_font *font,
                       const struct pdf_program *program)
{
    bool by_glyph = !program->truetype && program->glyphs;
    fputs(" /DW 0 /W [", p->f);
    if (!by_glyph)
        fputs("1 [", p->f);
    for (int i = 0; i < font->count; i++) {
        double width = p->letters[font->letters[i]].width * 1000;
        if (by_glyph)
            fprintf(p->f, "%u [%.6g] ", (unsigned)program->glyphs[i], width);
        else
            fprintf(p->f, "%s%.6g", i ? " " : "", width);
    }
    fputs(by_glyph ? "]" : "]]", p->f);
}

static void embedded_put(struct font_document *p, const struct pdf_font *font,
                         const struct pdf_program *program)
{
    char name[NAME_MAX_BYTES];
    name_make(p, font, name);
    int texts = texts_put(p, font), descriptor = descriptor_put(p, font, program, name);
    int glyphs = !program->glyphs    ? 0
                 : program->truetype ? glyphs_table_put(p, font, program)
                                     : encoding_put(p, font, program);
    int descendant = pdf_object(p);
    pdf_object_begin(p, descendant);
    fprintf(p->f,
            "<< /Type /Font /Subtype /CIDFontType%d /BaseFont /%s /CIDSystemInfo << /Registry "
            "(Adobe) /Ordering (Identity) /Supplement 0 >>\n/FontDescriptor %d 0 R",
            program->truetype ? 2 : 0, name, descriptor);
    if (program->truetype)
        fprintf(p->f, " /CIDToGIDMap %d 0 R", glyphs);
    widths_put(p, font, program);
    fputs(" >>\nendobj\n", p->f);
    pdf_object_begin(p, font->number);
    fprintf(p->f, "<< /Type /Font /Subtype /Type0 /BaseFont /%s", name);
    if (!program->truetype && program->glyphs)
        fprintf(p->f, " /Encoding %d 0 R", glyphs);
    else
        fputs(" /Encoding /Identity-H", p->f);
    fprintf(p->f, " /DescendantFonts [%d 0 R] /ToUnicode %d 0 R >>\nendobj\n", descendant,
            texts);
}

enum font_status pdf_fonts_put(struct font_document *p)
{
    enum font_status status = FONT_OK;
    for (int i = 0; i < p->fonts_count && status == FONT_OK; i++) {
        const struct pdf_font *font = &p->fonts[i];
        struct pdf_program program = {0};
        if (font->pictures) {
            pictures_put(p, font);
            continue;
        }
        if (!pdf_program_subset(p, font, &program))
            status = pdf_program_draw(p, font, &program);
        if (status == FONT_OK)
            embedded_put(p, font, &program);
        pdf_program_finish(&program);
    }
    pdf_object_begin(p, p->fonts_number);
    fputs("<<", p->f);
    for (int i = 0; i < p->fonts_count; i++)
        fprintf(p->f, " /F%d %d 0 R", i, p->fonts[i].number);
    fputs(" >>\nendobj\n", p->f);
    return status;
}
