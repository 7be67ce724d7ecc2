/* drawing_pdf.c - a layout as PDF: see drawing.h.
 *
 * Letters are glyphs of Type 3 fonts, up to 255 in each: a glyph is its outline in the font's units, and a table says which text it
 * shows. Objects are written one after the other; the table at the end says where each begins. */
#include "colour.h"
#include "drawing_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LETTERS_MAX = 255, FIRST_CODE = 1, BUCKETS = 1024 };

static const double point_px = 0.75; /* points in a pixel */

struct pdf_font {
    struct font_face *face;
    int count, letters[LETTERS_MAX]; /* of the document's */
};

/* A glyph with a text: of which font which letter. The same glyph may show other text elsewhere. */
struct pdf_letter {
    int drawn; /* which of the drawn */
    size_t begin, end;
    int parts; /* it has so much of the glyph's width; the first of them is drawn */
    bool blank;
    int font, code, next;
};

/* Colours and cover, packed. */
struct pdf_picture {
    int width_px, height_px, number; /* number: of its object, once it is written */
    uint8_t *packed[2];
    size_t counts[2];
};

struct pdf {
    const struct font_drawing *d;
    const struct font_layout *layout;
    struct drawn drawn;
    struct pdf_letter *letters;
    int letters_count, letters_capacity;
    int heads[BUCKETS]; /* of chains of letters: plus 1 */
    struct pdf_font *fonts;
    int fonts_count, fonts_capacity;
    struct pdf_picture *pictures;
    int pictures_count, pictures_capacity;
    bool covers[256]; /* translucencies that are used */
    double x, y;      /* of the layout's origin, in pixels */
    FILE *f;
    long *offsets;
    int objects, offsets_capacity;
};

static enum font_status no_memory(void)
{
    return font_fail(FONT_NO_MEMORY, "no memory for a drawing");
}

/* Gives a letter its place in a font of its face that has room. */
static bool letter_place(struct pdf *p, int letter)
{
    struct pdf_letter *l = &p->letters[letter];
    struct font_face *face = p->drawn.glyphs[l->drawn].face;
    int i = p->fonts_count - 1;
    while (i >= 0 && (p->fonts[i].face != face || p->fonts[i].count == LETTERS_MAX))
        i--;
    if (i < 0) {
        if (!array_reserve(&p->fonts, &p->fonts_capacity, p->fonts_count + 1, sizeof *p->fonts))
            return false;
        i = p->fonts_count++;
        p->fonts[i].face = face;
        p->fonts[i].count = 0;
    }
    l->font = i;
    l->code = p->fonts[i].count;
    p->fonts[i].letters[p->fonts[i].count++] = letter;
    return true;
}

static bool letter_same(const struct pdf *p, const struct pdf_letter *a,
                        const struct pdf_letter *b)
{
    size_t bytes = a->end - a->begin;
    return a->drawn == b->drawn && a->parts == b->parts && a->blank == b->blank &&
           bytes == b->end - b->begin &&
           (!bytes || memcmp(p->d->text + a->begin, p->d->text + b->begin, bytes) == 0);
}

/* The number of such a letter, made if there is none yet; -1: no memory. */
static int letter_find(struct pdf *p, struct pdf_letter wanted)
{
    enum { TEXT_MAX = 64 };
    if (wanted.end - wanted.begin > TEXT_MAX || !p->d->text)
        wanted.end = wanted.begin;
    size_t bytes = wanted.end - wanted.begin;
    const uint32_t key[2] = {(uint32_t)wanted.drawn,
                             bytes ? font_hash(p->d->text + wanted.begin, bytes) : 0};
    uint32_t bucket = font_hash(key, sizeof key) % BUCKETS;
    int k = p->heads[bucket] - 1;
    while (k >= 0 && !letter_same(p, &p->letters[k], &wanted))
        k = p->letters[k].next;
    if (k >= 0)
        return k;
    k = p->letters_count;
    if (!array_reserve(&p->letters, &p->letters_capacity, k + 1, sizeof *p->letters))
        return -1;
    wanted.next = p->heads[bucket] - 1;
    p->letters[p->letters_count++] = wanted;
    p->heads[bucket] = k + 1;
    return letter_place(p, k) ? k : -1;
}

/* Begins the next object; they are numbered from 1 on. */
static bool object_begin(struct pdf *p)
{
    if (!array_reserve(&p->offsets, &p->offsets_capacity, p->objects + 1, sizeof *p->offsets))
        return false;
    p->offsets[p->objects++] = ftell(p->f);
    fprintf(p->f, "%d 0 obj\n", p->objects);
    return true;
}

static bool stream_put(struct pdf *p, const char *bytes, size_t count)
{
    bool good = object_begin(p);
    fprintf(p->f, "<< /Length %zu >>\nstream\n", count);
    fwrite(bytes, 1, count, p->f);
    fputs("\nendstream\nendobj\n", p->f);
    return good;
}

/* ---- what is on the page ---- */

static void picture_free(struct pdf_picture *picture)
{
    for (int k = 0; k < 2; k++)
        free(picture->packed[k]);
}

/* Without cover if all of it covers. */
static bool picture_pack(const struct font_tile *tile, struct pdf_picture *out)
{
    size_t count = (size_t)tile->width_px * (size_t)tile->height_px;
    uint8_t *apart = calloc(4, count);
    bool opaque = true;
    *out = (struct pdf_picture){.width_px = tile->width_px, .height_px = tile->height_px};
    for (size_t i = 0; apart && i < count; i++) {
        memcpy(apart + 3 * i, tile->rgba + 4 * i, 3);
        apart[3 * count + i] = tile->rgba[4 * i + 3];
        opaque = opaque && tile->rgba[4 * i + 3] == 255;
    }
    for (int k = 0; apart && k < 2 - opaque; k++)
        out->packed[k] =
            drawn_deflated(apart + (k ? 3 * count : 0), k ? count : 3 * count, &out->counts[k]);
    free(apart);
    return out->packed[0] && (out->packed[1] || opaque);
}

/* Its cover, then itself. */
static bool picture_object(struct pdf *p, struct pdf_picture *picture)
{
    bool good = true;
    for (int k = picture->packed[1] ? 1 : 0; k >= 0 && good; k--) {
        good = object_begin(p);
        fprintf(p->f,
                "<< /Type /XObject /Subtype /Image /Width %d /Height %d /ColorSpace /Device%s "
                "/BitsPerComponent 8 /Filter /FlateDecode /Length %zu",
                picture->width_px, picture->height_px, k ? "Gray" : "RGB", picture->counts[k]);
        if (!k && picture->packed[1])
            fprintf(p->f, " /SMask %d 0 R", p->objects - 1);
        fputs(" >>\nstream\n", p->f);
        fwrite(picture->packed[k], 1, picture->counts[k], p->f);
        fputs("\nendstream\nendobj\n", p->f);
    }
    picture->number = p->objects;
    return good;
}

/* From the layout's pixels to the page's points. */
static void matrix_put(const struct pdf *p, double x, double y, FILE *f)
{
    fprintf(f, "%g 0 0 %g %.7g %.7g", point_px, -point_px, (p->x + x) * point_px,
            (p->d->height_px - p->y - y) * point_px);
}

/* A picture as ink: a pattern of its own, in the object that `number` becomes. */
static bool pattern_object(struct pdf *p, int ink, int *number)
{
    const struct font_ink *of = &p->layout->inks[ink];
    char content[64];
    int count = snprintf(content, sizeof content, "%d 0 0 %d 0 %d cm /I Do", of->width_px,
                         -of->height_px, of->height_px);
    bool good = object_begin(p);
    *number = p->objects;
    fprintf(p->f,
            "<< /Type /Pattern /PatternType 1 /PaintType 1 /TilingType 1 /BBox [0 0 %d %d]\n"
            "/XStep %d /YStep %d /Matrix [",
            of->width_px, of->height_px, of->width_px, of->height_px);
    matrix_put(p, of->x0, of->y0, p->f);
    fprintf(p->f, "]\n/Resources << /XObject << /I %d 0 R >> >> /Length %d >>\nstream\n",
            *number - 1, count);
    fputs(content, p->f);
    fputs("\nendstream\nendobj\n", p->f);
    return good;
}

/* How much a gradient covers, as the light of a group of its own. */
static bool mask_object(struct pdf *p, int ink, int *number)
{
    char *content = NULL;
    size_t count = 0;
    FILE *f = open_memstream(&content, &count);
    if (!f)
        return false;
    matrix_put(p, 0, 0, f);
    fputs(" cm /S sh", f);
    bool good = fclose(f) == 0 && object_begin(p);
    *number = p->objects;
    fprintf(p->f,
            "<< /Type /XObject /Subtype /Form /BBox [0 0 %.7g %.7g] /Group << /S /Transparency "
            "/CS /DeviceGray >>\n/Resources << /Shading << /S ",
            p->d->width_px * point_px, p->d->height_px * point_px);
    drawn_pdf_shading(&p->layout->inks[ink], true, p->f);
    fprintf(p->f, " >> >> /Length %zu >>\nstream\n", count);
    fwrite(content, 1, good ? count : 0, p->f);
    fputs("\nendstream\nendobj\n", p->f);
    free(content);
    return good;
}

/* numbers[i]: of the object that is ink i's pattern or mask, or 0. */
static enum font_status inks_objects(struct pdf *p, int *numbers)
{
    enum font_status status = FONT_OK;
    for (int i = 0; i < p->layout->inks_count && status == FONT_OK; i++) {
        const struct font_ink *ink = &p->layout->inks[i];
        struct font_tile tile;
        struct pdf_picture picture;
        if (ink->kind == FONT_INK_PICTURE) {
            status = drawn_ink_tile(ink, &tile);
            if (status != FONT_OK)
                break;
            bool good = picture_pack(&tile, &picture) && picture_object(p, &picture) &&
                        pattern_object(p, i, &numbers[i]);
            picture_free(&picture);
            free(tile.rgba);
            status = good ? FONT_OK : no_memory();
        } else if (drawn_translucent(ink) && !mask_object(p, i, &numbers[i])) {
            status = no_memory();
        }
    }
    return status;
}

/* In the page's resources: what letters are filled with, and how much that covers. */
static void inks_put(const struct pdf *p, const int *numbers)
{
    bool masks = false;
    for (int i = 0; i < p->layout->inks_count; i++)
        masks = masks || drawn_translucent(&p->layout->inks[i]);
    fputs(" /ExtGState <<", p->f);
    for (int i = 0; i < 256; i++)
        if (p->covers[i])
            fprintf(p->f, " /A%d << /ca %.5g%s >>", i, i / 255.0, masks ? " /SMask /None" : "");
    for (int i = 0; i < p->layout->inks_count; i++)
        if (numbers[i] && p->layout->inks[i].kind != FONT_INK_PICTURE)
            fprintf(p->f,
                    "\n/M%d << /ca 1 /SMask << /Type /Mask /S /Luminosity /G %d 0 R >> >>",
                    i + 1, numbers[i]);
    fputs(" >> /Pattern <<", p->f);
    for (int i = 0; i < p->layout->inks_count; i++) {
        const struct font_ink *ink = &p->layout->inks[i];
        double flat[4];
        if (ink->kind == FONT_INK_PICTURE) {
            fprintf(p->f, "\n/P%d %d 0 R", i + 1, numbers[i]);
        } else if (!drawn_flat(ink, flat)) {
            fprintf(p->f, "\n/P%d << /PatternType 2 /Matrix [", i + 1);
            matrix_put(p, 0, 0, p->f);
            fputs("]\n/Shading ", p->f);
            drawn_pdf_shading(ink, false, p->f);
            fputs(" >>", p->f);
        }
    }
    fputs(" >>", p->f);
}

static void ink_put(struct pdf *p, int i, FILE *f)
{
    struct font_ink own;
    const struct font_ink *ink = drawn_ink(p->d, p->layout, i, &own);
    int number = p->layout->glyphs[i].ink;
    double c[4];
    bool flat = drawn_flat(ink, c);
    int cover = (int)lrint(255 * (flat                            ? c[3]
                                  : ink->kind == FONT_INK_PICTURE ? ink->rgba[3]
                                                                  : 1));
    p->covers[cover] = true;
    if (flat)
        fprintf(f, "%.5g %.5g %.5g rg /A%d gs\n", c[0], c[1], c[2], cover);
    else if (drawn_translucent(ink))
        fprintf(f, "/Pattern cs /P%d scn /M%d gs\n", number, number);
    else
        fprintf(f, "/Pattern cs /P%d scn /A%d gs\n", number, cover);
}

/* A glyph that is a picture, where it is. */
static enum font_status picture_put(struct pdf *p, int i, const struct font_map *map, double x,
                                    double y, FILE *f)
{
    struct font_tile tile;
    enum font_status status = drawn_tile(&p->drawn, p->d, p->layout, i, map, x, y, &tile);
    if (status != FONT_OK || !tile.width_px)
        return status;
    bool good = array_reserve(&p->pictures, &p->pictures_capacity, p->pictures_count + 1,
                              sizeof *p->pictures) &&
                picture_pack(&tile, &p->pictures[p->pictures_count++]);
    const double part = point_px / DRAWN_FINER;
    p->covers[255] = true;
    fprintf(f, "q /A255 gs %.7g 0 0 %.7g %.7g %.7g cm /I%d Do Q\n", tile.width_px * part,
            tile.height_px * part, tile.left_px * part,
            p->d->height_px * point_px - (tile.top_px + tile.height_px) * part,
            p->pictures_count - 1);
    free(tile.rgba);
    return good ? FONT_OK : no_memory();
}

/* A glyph with the text that it shows: the first of its cluster has all of that. Letters that go to the left are parts of its width, the last
 * of them at the left, since programs put what they find in that order. */
static enum font_status text_put(struct pdf *p, int i, const struct font_map *whole, FILE *f)
{
    const struct font_placed *g = &p->layout->glyphs[i];
    const struct drawn_text *t = &p->drawn.texts[i];
    struct font_face_info info;
    double advance = 0;
    font_face_describe(g->face, &info);
    int leftward = p->d->text ? drawn_pdf_leftward(p->d, t) : 0, parts = 1, letters = 0;
    size_t end = t->begins ? t->end : t->begin;
    if (leftward)
        drawn_pdf_share(p->d, t, &end, &letters);
    if (letters > 1) {
        (void)font_face_advance(g->face, g->glyph, &advance);
        parts = letters;
    }
    const double em = info.units_per_em * point_px, *m = whole->m;
    for (int k = 0; k < parts; k++) {
        size_t begin = leftward && !letters ? end : t->begin;
        if (leftward && letters)
            for (begin = end - 1; ((unsigned char)p->d->text[begin] & 0xc0) == 0x80;)
                begin--;
        int letter = letter_find(p, (struct pdf_letter){.drawn = p->drawn.of[i],
                                                        .begin = begin,
                                                        .end = end,
                                                        .parts = parts,
                                                        .blank = k > 0});
        if (letter < 0)
            return no_memory();
        double along = advance * k / parts;
        fprintf(f, "BT /F%d 1 Tf %.7g %.7g %.7g %.7g %.7g %.7g Tm <%02x> Tj ET\n",
                p->letters[letter].font, m[0] * em, -m[3] * em, m[1] * em, -m[4] * em,
                (m[2] + m[0] * along) * point_px,
                (p->d->height_px - m[5] - m[3] * along) * point_px,
                (unsigned)(p->letters[letter].code + FIRST_CODE));
        end = begin;
    }
    return FONT_OK;
}

static enum font_status letter_put(struct pdf *p, int i, const struct font_map *map, double x,
                                   double y, FILE *f)
{
    const struct font_placed *g = &p->layout->glyphs[i];
    const struct drawn_glyph *drawn = &p->drawn.glyphs[p->drawn.of[i]];
    struct font_map whole;
    double height = p->d->height_px;
    enum font_status status = drawn_map(p->layout, i, map, x, y, &whole);
    if (status != FONT_OK)
        return status;
    if (i == 0 || p->layout->glyphs[i - 1].ink != g->ink)
        ink_put(p, i, f);
    if (drawn->picture) {
        status = picture_put(p, i, map, x, y, f);
        if (status != FONT_OK || whole.kind != FONT_AFFINE)
            return status;
    }
    struct font_ink own;
    double flat[4];
    /* Programs that show PDF do not clip patterns to the letters of such fonts: those are paths. */
    if (drawn->picture ||
        (whole.kind == FONT_AFFINE && drawn_flat(drawn_ink(p->d, p->layout, i, &own), flat))) {
        return text_put(p, i, &whole, f);
    }
    struct font_outline outline;
    status = font_face_outline_raw(g->face, g->glyph, &outline);
    if (status != FONT_OK)
        return status;
    fprintf(f, "q %g 0 0 %g 0 %.7g cm\n", point_px, -point_px, height * point_px);
    status = drawn_path(&outline, &whole, true, f);
    fputs("f Q\n", f);
    font_outline_finish(&outline);
    return status;
}

/* ---- fonts ---- */

static enum font_status glyph_put(struct pdf *p, const struct pdf_letter *letter)
{
    const struct drawn_glyph *g = &p->drawn.glyphs[letter->drawn];
    char *bytes = NULL;
    size_t count = 0;
    FILE *f = open_memstream(&bytes, &count);
    struct font_outline outline;
    if (!f)
        return no_memory();
    enum font_status status = FONT_OK;
    bool nothing = g->picture || letter->blank;
    if (nothing) { /* but it has the text */
        double advance = 0;
        (void)font_face_advance(g->face, g->glyph, &advance);
        fprintf(f, "%.7g 0 0 0 0 0 d1\n", advance);
    } else {
        status = font_face_outline_raw(g->face, g->glyph, &outline);
    }
    if (status == FONT_OK && !nothing) {
        struct font_box box = font_outline_box(&outline);
        fprintf(f, "%.7g 0 %.7g %.7g %.7g %.7g d1\n", outline.advance, box.x0, box.y0, box.x1,
                box.y1);
        status = drawn_path(&outline, NULL, true, f);
        fputs("f", f);
        font_outline_finish(&outline);
    }
    bool whole = fclose(f) == 0;
    if (status == FONT_OK && (!whole || !stream_put(p, bytes, count)))
        status = no_memory();
    free(bytes);
    return status;
}

/* Which text each letter of the font shows. */
static enum font_status texts_put(struct pdf *p, const struct pdf_font *font)
{
    char *bytes = NULL;
    size_t count = 0;
    FILE *f = open_memstream(&bytes, &count);
    if (!f)
        return no_memory();
    fputs("/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n/CMapType 2 def\n"
          "/CMapName /Lutetia def\n1 begincodespacerange\n<00> <FF>\nendcodespacerange\n",
          f);
    for (int i = 0; i < font->count; i++) {
        size_t begin = p->letters[font->letters[i]].begin,
               end = p->letters[font->letters[i]].end;
        if (begin == end)
            continue;
        fprintf(f, "1 beginbfchar\n<%02X> <", (unsigned)(i + FIRST_CODE));
        drawn_pdf_utf16(p->d->text, begin, end, f);
        fputs(">\nendbfchar\n", f);
    }
    fputs("endcmap\nCMapName currentdict /CMap defineresource pop\nend\nend", f);
    bool good = fclose(f) == 0 && stream_put(p, bytes, count);
    free(bytes);
    return good ? FONT_OK : no_memory();
}

/* Objects: its letters, its texts, itself. *number: its own. */
static enum font_status font_put(struct pdf *p, const struct pdf_font *font, int *number)
{
    struct font_face_info info;
    enum font_status status = FONT_OK;
    font_face_describe(font->face, &info);
    int letters = p->objects + 1;
    for (int i = 0; i < font->count && status == FONT_OK; i++)
        status = glyph_put(p, &p->letters[font->letters[i]]);
    if (status == FONT_OK)
        status = texts_put(p, font);
    if (status == FONT_OK && !object_begin(p))
        status = no_memory();
    if (status != FONT_OK)
        return status;
    *number = p->objects;
    fprintf(
        p->f,
        "<< /Type /Font /Subtype /Type3 /FontBBox [0 0 0 0] /FontMatrix [%.9g 0 0 %.9g 0 0]\n"
        "/FirstChar %d /LastChar %d /ToUnicode %d 0 R /Resources << >>\n/CharProcs <<",
        1 / info.units_per_em, 1 / info.units_per_em, FIRST_CODE, FIRST_CODE + font->count - 1,
        letters + font->count);
    for (int i = 0; i < font->count; i++)
        fprintf(p->f, " /g%d %d 0 R", i, letters + i);
    fprintf(p->f, " >>\n/Encoding << /Type /Encoding /Differences [%d", FIRST_CODE);
    for (int i = 0; i < font->count; i++)
        fprintf(p->f, " /g%d", i);
    fputs("] >>\n/Widths [", p->f);
    for (int i = 0; i < font->count; i++) {
        const struct pdf_letter *l = &p->letters[font->letters[i]];
        double advance = 0;
        font_face_advance(font->face, p->drawn.glyphs[l->drawn].glyph, &advance);
        fprintf(p->f, " %.6g", advance / l->parts);
    }
    fputs(" ] >>\nendobj\n", p->f);
    return FONT_OK;
}

/* Object 1 is what is on the page; then the fonts; then the page, the list of pages, the document. */
static enum font_status objects_put(struct pdf *p, const char *content, size_t count)
{
    enum font_status status = FONT_OK;
    int *numbers = calloc((size_t)p->fonts_count + 1, sizeof *numbers);
    int *inks = calloc((size_t)p->layout->inks_count + 1, sizeof *inks);
    bool good = numbers && inks && stream_put(p, content, count);
    if (good)
        status = inks_objects(p, inks);
    for (int i = 0; good && i < p->fonts_count && status == FONT_OK; i++)
        status = font_put(p, &p->fonts[i], &numbers[i]);
    for (int i = 0; good && i < p->pictures_count; i++)
        good = picture_object(p, &p->pictures[i]);
    good = good && object_begin(p);
    int page = p->objects;
    fprintf(p->f,
            "<< /Type /Page /Parent %d 0 R /MediaBox [0 0 %.7g %.7g] /Contents 1 0 "
            "R\n/Resources << "
            "/Font <<",
            page + 1, p->d->width_px * point_px, p->d->height_px * point_px);
    for (int i = 0; good && i < p->fonts_count; i++)
        fprintf(p->f, " /F%d %d 0 R", i, numbers[i]);
    fputs(" >> /XObject <<", p->f);
    for (int i = 0; good && i < p->pictures_count; i++)
        fprintf(p->f, " /I%d %d 0 R", i, p->pictures[i].number);
    fputs(" >>", p->f);
    if (good)
        inks_put(p, inks);
    fputs(" >> >>\nendobj\n", p->f);
    good = good && object_begin(p);
    fprintf(p->f, "<< /Type /Pages /Kids [%d 0 R] /Count 1 >>\nendobj\n", page);
    good = good && object_begin(p);
    fprintf(p->f, "<< /Type /Catalog /Pages %d 0 R >>\nendobj\n", page + 1);
    long table = ftell(p->f);
    fprintf(p->f, "xref\n0 %d\n0000000000 65535 f \n", p->objects + 1);
    for (int i = 0; good && i < p->objects; i++)
        fprintf(p->f, "%010ld 00000 n \n", p->offsets[i]);
    fprintf(p->f, "trailer\n<< /Size %d /Root %d 0 R >>\nstartxref\n%ld\n%%%%EOF\n",
            p->objects + 1, p->objects, table);
    free(numbers);
    free(inks);
    return status == FONT_OK && !good ? no_memory() : status;
}

static enum font_status spread_put(const struct font_drawing *d,
                                   const struct font_layout *layout, const struct font_map *map,
                                   double x, double y, FILE *file)
{
    struct pdf p = {.d = d, .layout = layout, .x = x, .y = y};
    char *content = NULL, *whole = NULL;
    size_t content_bytes = 0, whole_bytes = 0;
    enum font_status status = drawn_find(d, layout, &p.drawn);
    FILE *f = status == FONT_OK ? open_memstream(&content, &content_bytes) : NULL;
    for (int i = 0; f && i < layout->glyphs_count && status == FONT_OK; i++) {
        drawn_pdf_said_begin(d, &p.drawn.texts[i], f);
        status = letter_put(&p, i, map, x, y, f);
        drawn_pdf_said_end(d, &p.drawn.texts[i], f);
    }
    if (status == FONT_OK && !f)
        status = no_memory();
    if (f && fclose(f) != 0 && status == FONT_OK)
        status = no_memory();
    p.f = status == FONT_OK ? open_memstream(&whole, &whole_bytes) : NULL;
    if (p.f) {
        fputs("%PDF-1.5\n%\xe2\xe3\xcf\xd3\n", p.f);
        status = objects_put(&p, content, content_bytes);
        if (fclose(p.f) != 0 && status == FONT_OK)
            status = no_memory();
    } else if (status == FONT_OK) {
        status = no_memory();
    }
    if (status == FONT_OK && fwrite(whole, 1, whole_bytes, file) != whole_bytes)
        status = font_fail(FONT_BAD_FILE, "the drawing cannot be written");
    free(content);
    free(whole);
    free(p.fonts);
    free(p.letters);
    for (int i = 0; i < p.pictures_count; i++)
        picture_free(&p.pictures[i]);
    free(p.pictures);
    free(p.offsets);
    drawn_finish(&p.drawn);
    return status;
}

enum font_status font_drawing_pdf(const struct font_drawing *d,
                                  const struct font_layout *layout, const struct font_map *map,
                                  double x, double y, FILE *file)
{
    return drawn_spread(d, layout, map, x, y, file, spread_put);
}
