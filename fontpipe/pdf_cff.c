/* pdf_cff.c - CFF made of outlines, for fonts that HarfBuzz does not cut: see pdf_internal.h.
 *
 * Adobe's Technical Notes 5176 (the format) and 5177 (glyphs). A header, then lists: the font's
 * name, its dictionary, the glyphs' names, no subroutines; the order of names, the glyphs, the
 * private dictionary. Coordinates are thousandths of an em, not rounded where they are no whole
 * numbers. Curves of degree 2 are written as those of degree 3 that they are. */
#include "pdf_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STANDARD_STRINGS = 391, FAR = 16000 };
enum { RLINETO = 5, RRCURVETO = 8, ENDCHAR = 14, RMOVETO = 21 };

static void big_put(FILE *f, unsigned long value, int bytes)
{
    for (int k = bytes - 1; k >= 0; k--)
        fputc((int)(value >> (8 * k) & 0xff), f);
}

/* A list's head: how many, and where each begins. The bytes follow. */
static void index_put(FILE *f, int count, const size_t *ends)
{
    big_put(f, (unsigned long)count, 2);
    if (!count)
        return;
    fputc(4, f);
    big_put(f, 1, 4);
    for (int i = 0; i < count; i++)
        big_put(f, ends[i] + 1, 4);
}

/* ---- glyphs ---- */

struct pen {
    FILE *f;
    double em;   /* thousandths to one of the font's units */
    long x, y;   /* where it is, in 65536ths of a thousandth */
    bool inside; /* a contour has begun */
};

static void number_put(FILE *f, long fixed)
{
    long v = fixed / 65536;
    if (fixed % 65536) {
        fputc(255, f);
        big_put(f, (unsigned long)fixed, 4);
    } else if (v >= -107 && v <= 107) {
        fputc((int)(v + 139), f);
    } else if (v >= 108 && v <= 1131) {
        fputc((int)((v - 108) / 256 + 247), f);
        fputc((int)((v - 108) % 256), f);
    } else if (v <= -108 && v >= -1131) {
        fputc((int)((-v - 108) / 256 + 251), f);
        fputc((int)((-v - 108) % 256), f);
    } else {
        fputc(28, f);
        big_put(f, (unsigned long)v, 2);
    }
}

static long fixed_of(double value)
{
    return lrint(65536 * fmax(-FAR, fmin(FAR, value)));
}

/* From where the pen is to a point, to which it goes. */
static void point_put(struct pen *p, struct font_point to)
{
    long x = fixed_of(to.x * p->em), y = fixed_of(to.y * p->em);
    number_put(p->f, x - p->x);
    number_put(p->f, y - p->y);
    p->x = x;
    p->y = y;
}

static struct font_point toward(struct font_point a, struct font_point b)
{
    return (struct font_point){a.x + (b.x - a.x) * 2 / 3, a.y + (b.y - a.y) * 2 / 3};
}

static void segment_put(struct pen *pen, const struct font_segment *s)
{
    if (s->degree == 1) {
        point_put(pen, s->p[1]);
        fputc(RLINETO, pen->f);
        return;
    }
    point_put(pen, s->degree == 2 ? toward(s->p[0], s->p[1]) : s->p[1]);
    point_put(pen, s->degree == 2 ? toward(s->p[2], s->p[1]) : s->p[2]);
    point_put(pen, s->p[s->degree]);
    fputc(RRCURVETO, pen->f);
}

/* A glyph that cannot be read is blank. */
static void glyph_put(const struct pdf_letter *letter, FILE *f)
{
    struct font_face_info info;
    struct font_outline outline;
    font_face_describe(letter->face, &info);
    struct pen pen = {.f = f, .em = 1000 / info.units_per_em};
    number_put(f, fixed_of(letter->width * 1000));
    if (font_face_outline_or_none(letter->face, letter->glyph, false, &outline) == FONT_OK) {
        for (int i = 0; i < outline.segments_count; i++) {
            const struct font_segment *s = &outline.segments[i];
            if (i == 0 || s[-1].contour != s->contour) {
                point_put(&pen, s->p[0]);
                fputc(RMOVETO, f);
            }
            segment_put(&pen, s);
        }
        font_outline_finish(&outline);
    }
    fputc(ENDCHAR, f);
}

/* ---- the table ---- */

struct parts {
    char *names, *glyphs;
    size_t names_bytes, glyphs_bytes;
    size_t *name_ends, *glyph_ends;
};

static bool parts_make(const struct font_document *p, const struct pdf_font *font,
                       struct parts *out)
{
    int n = font->count;
    out->name_ends = calloc((size_t)n + 1, sizeof *out->name_ends);
    out->glyph_ends = calloc((size_t)n + 2, sizeof *out->glyph_ends);
    FILE *names = open_memstream(&out->names, &out->names_bytes);
    FILE *glyphs = open_memstream(&out->glyphs, &out->glyphs_bytes);
    bool good = out->name_ends && out->glyph_ends && names && glyphs;
    if (good)
        fputc(ENDCHAR, glyphs); /* glyph 0 */
    for (int i = 0; good && i <= n; i++) {
        out->glyph_ends[i] = (size_t)ftell(glyphs);
        if (i == n)
            break;
        fprintf(names, "c%d", i + 1);
        out->name_ends[i] = (size_t)ftell(names);
        glyph_put(&p->letters[font->letters[i]], glyphs);
    }
    if (names)
        good = fclose(names) == 0 && good;
    if (glyphs)
        good = fclose(glyphs) == 0 && good;
    return good;
}

static void offset_put(FILE *f, size_t value)
{
    fputc(29, f);
    big_put(f, value, 4);
}

static void table_put(FILE *f, int n, const struct parts *of)
{
    enum { HEAD = 4, NAME = 1 + 7, DICT = 3 * 5 + 5 + 3, CHARSET = 5, PRIVATE = 4 };
    const size_t one = 2 + 1 + 2 * 4; /* a list's head of one entry */
    const size_t count = (size_t)n;
    const size_t strings = 2 + 1 + 4 * (count + 1) + of->names_bytes;
    const size_t charset = HEAD + (one + NAME) + (one + DICT) + strings + 2;
    const size_t glyphs = charset + CHARSET;
    const size_t private = glyphs + 2 + 1 + 4 * (count + 2) + of->glyphs_bytes;
    size_t end = NAME;
    fwrite("\x01\x00\x04\x04", 1, HEAD, f);
    index_put(f, 1, &end);
    fwrite("Lutetia", 1, NAME, f); /* with its zero: any byte */
    end = DICT;
    index_put(f, 1, &end);
    offset_put(f, charset);
    fputc(15, f);
    offset_put(f, glyphs);
    fputc(17, f);
    offset_put(f, PRIVATE);
    offset_put(f, private);
    fputc(18, f);
    index_put(f, n, of->name_ends);
    fwrite(of->names, 1, of->names_bytes, f);
    index_put(f, 0, NULL);
    fputc(2, f); /* names in their order */
    big_put(f, STANDARD_STRINGS, 2);
    big_put(f, (unsigned long)(n - 1), 2);
    index_put(f, n + 1, of->glyph_ends);
    fwrite(of->glyphs, 1, of->glyphs_bytes, f);
    fwrite("\x8b\x14\x8b\x15", 1, PRIVATE, f); /* usual and nominal width: 0 */
}

void pdf_program_finish(struct pdf_program *program)
{
    free(program->bytes);
    free(program->glyphs);
    *program = (struct pdf_program){0};
}

enum font_status pdf_program_draw(const struct font_document *p, const struct pdf_font *font,
                                  struct pdf_program *out)
{
    struct parts parts = {0};
    char *bytes = NULL;
    size_t count = 0;
    *out = (struct pdf_program){0};
    FILE *f = parts_make(p, font, &parts) ? open_memstream(&bytes, &count) : NULL;
    if (f) {
        table_put(f, font->count, &parts);
        if (fclose(f) == 0)
            *out = (struct pdf_program){.bytes = (uint8_t *)bytes, .count = count};
        else
            free(bytes);
    }
    free(parts.names);
    free(parts.glyphs);
    free(parts.name_ends);
    free(parts.glyph_ends);
    return out->bytes ? FONT_OK : pdf_no_memory();
}

/* ---- reading ---- */

static size_t big_read(const uint8_t *at, int bytes)
{
    size_t value = 0;
    for (int k = 0; k < bytes; k++)
        value = value << 8 | at[k];
    return value;
}

/* Where the first entry of the list at *at begins and ends; *at: where the list does. False:
 * there is none. */
static bool index_read(const uint8_t *bytes, size_t count, size_t *at, size_t *begin,
                       size_t *end)
{
    if (*at > count || count - *at < 3)
        return false;
    size_t n = big_read(bytes + *at, 2);
    int size = bytes[*at + 2];
    if (!n || size < 1 || size > 4 || (count - *at - 3) / (size_t)size < n + 1)
        return false;
    const uint8_t *offsets = bytes + *at + 3;
    size_t data = *at + 3 + (n + 1) * (size_t)size - 1, left = count - data;
    *begin = big_read(offsets, size);
    *end = big_read(offsets + size, size);
    size_t last = big_read(offsets + n * (size_t)size, size);
    if (*begin > *end || *end > last || last > left)
        return false;
    *begin += data;
    *end += data;
    *at = data + last;
    return true;
}

bool pdf_cff_keyed(const uint8_t *bytes, size_t count)
{
    enum { ESCAPE = 12, ROS = 30, REAL = 30, LONG = 29, SHORT = 28 };
    size_t at = count > 4 ? bytes[2] : count, begin, end;
    if (!index_read(bytes, count, &at, &begin, &end) ||
        !index_read(bytes, count, &at, &begin, &end))
        return true;
    for (size_t i = begin; i < end; i++) {
        if (bytes[i] == ESCAPE && i + 1 < end && bytes[++i] == ROS)
            return true;
        if (bytes[i] == LONG)
            i += 4;
        else if (bytes[i] == SHORT)
            i += 2;
        else if (bytes[i] >= 247 && bytes[i] <= 254)
            i++;
        else if (bytes[i] == REAL)
            while (++i < end && (bytes[i] & 0xf) != 0xf && bytes[i] >> 4 != 0xf)
                ;
    }
    return false;
}
