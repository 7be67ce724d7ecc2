/* pdf_page.c - a layout as a page of PDF: see pdf_internal.h. */
#include "pdf_internal.h"
#include "text_internal.h"

#include <fribidi.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A glyph that is a picture, where it is. */
static enum font_status picture_show(struct pdf_making *m, int i)
{
    struct font_tile tile;
    enum font_status status =
        drawn_tile(&m->drawn, m->d, m->layout, i, m->map, m->x, m->y, &tile);
    if (status != FONT_OK || !tile.width_px)
        return status;
    bool good = array_reserve(&m->pictures, &m->pictures_capacity, m->pictures_count + 1,
                              sizeof *m->pictures) &&
                pdf_picture_pack(&tile, &m->pictures[m->pictures_count++]);
    const double part = pdf_point_px / DRAWN_FINER;
    m->covers[255] = true;
    pdf_run_end(m);
    fprintf(m->f, "q /A255 gs %.7g 0 0 %.7g %.7g %.7g cm /I%d Do Q\n", tile.width_px * part,
            tile.height_px * part, tile.left_px * part,
            m->d->height_px * pdf_point_px - (tile.top_px + tile.height_px) * part,
            m->pictures_count - 1);
    free(tile.rgba);
    return good ? FONT_OK : pdf_no_memory();
}

/* An em under the map around the glyph's origin, in points. */
static void em_find(const struct pdf_making *m, const struct font_placed *g,
                    const struct font_map *whole, double em[6])
{
    struct font_face_info info;
    struct font_point at = {0, 0}, to = {0, 0};
    double jacobian[4] = {0, 0, 0, 0};
    font_face_describe(g->face, &info);
    (void)font_map_point(whole, at, &to, jacobian);
    double units = info.units_per_em * pdf_point_px;
    em[0] = jacobian[0] * units;
    em[1] = -jacobian[2] * units;
    em[2] = jacobian[1] * units;
    em[3] = -jacobian[3] * units;
    em[4] = to.x * pdf_point_px;
    em[5] = (m->d->height_px - to.y) * pdf_point_px;
}

/* A letter, so much of its em along from the glyph's origin. */
static bool letter_show(struct pdf_making *m, int i, const char *text, size_t bytes, int parts,
                        const double em[6], double along, bool hidden)
{
    const struct font_placed *g = &m->layout->glyphs[i];
    bool picture = m->drawn.glyphs[m->drawn.of[i]].picture;
    int letter = pdf_letter_find(m->p, g->face, g->glyph, picture, text, bytes, parts);
    if (letter < 0)
        return false;
    double at[6];
    memcpy(at, em, sizeof at);
    at[4] += em[0] * along;
    at[5] += em[1] * along;
    pdf_run_letter(m, letter, at, hidden);
    return true;
}

static size_t letter_begin(const char *text, size_t end)
{
    do
        end--;
    while (((unsigned char)text[end] & 0xc0) == 0x80);
    return end;
}

/* The last sign that a glyph shows. */
static uint32_t sign_of(const struct pdf_making *m, int i)
{
    const struct drawn_text *t = &m->drawn.texts[i];
    const char *at = m->d->text + t->begin, *end = m->d->text + t->end;
    uint32_t c = 0;
    while (at < end)
        font_utf8_next(&at, end, &c);
    return c;
}

/* In a line that goes to the left programs take signs and spaces behind a number or a word that
 * goes to the right, up to the next letter, for a part of it. A mark of direction (U+200F)
 * with the sign that is farthest to the left of it ends that. Of letters beyond U+FFFF programs
 * do not know that they go to the left. */
static bool mark_needed(const struct pdf_making *m, int i)
{
    const struct font_placed *g = m->layout->glyphs;
    if (i == 0 || g[i - 1].line != g[i].line || g[i - 1].cluster < g[i].cluster)
        return false;
    const uint32_t beside = sign_of(m, i - 1);
    const FriBidiCharType own = fribidi_get_bidi_type(sign_of(m, i)),
                          left = fribidi_get_bidi_type(beside);
    const bool goes_right = i + 1 < m->layout->glyphs_count && g[i + 1].line == g[i].line &&
                            g[i + 1].cluster > g[i].cluster;
    const bool begins = FRIBIDI_IS_LETTER(own) || FRIBIDI_IS_NUMBER(own) ||
                        FRIBIDI_IS_ES_OR_CS(own) ||
                        FRIBIDI_IS_NUMBER_SEPARATOR_OR_TERMINATOR(own);
    return (begins || goes_right) && !FRIBIDI_IS_RTL(own) &&
           (beside > 0xffff || (!FRIBIDI_IS_RTL(left) && left != FRIBIDI_TYPE_NSM));
}

static bool marked_show(struct pdf_making *m, int i, const double em[6], bool hidden)
{
    const struct drawn_text *t = &m->drawn.texts[i];
    char room[3 + FONT_UTF8_BYTES] = "\xe2\x80\x8f";
    size_t bytes = t->end - t->begin;
    if (bytes > FONT_UTF8_BYTES)
        bytes = FONT_UTF8_BYTES;
    memcpy(room + 3, m->d->text + t->begin, bytes);
    return letter_show(m, i, room, 3 + bytes, 1, em, 0, hidden);
}

/* A glyph with the text that it shows: the first of its cluster has all of that. Letters that
 * go to the left are parts of its width, the last of them at the left, since programs put what
 * they find in that order. */
static enum font_status text_show(struct pdf_making *m, int i, const double em[6], bool hidden)
{
    const struct font_placed *g = &m->layout->glyphs[i];
    const struct drawn_text *t = &m->drawn.texts[i];
    const char *text = m->d->text;
    int leftward = text ? pdf_leftward(m->d, t) : 0, letters = 0;
    size_t end = t->begins ? t->end : t->begin;
    if (text && t->begins && t->ends && mark_needed(m, i))
        return marked_show(m, i, em, hidden) ? FONT_OK : pdf_no_memory();
    if (text && t->begins && t->ends && pdf_is_unseen(m->d, t, g))
        return letter_show(m, i, text + t->begin, t->end - t->begin, 0, em, 0, true)
                   ? FONT_OK
                   : pdf_no_memory();
    if (leftward)
        pdf_share(m->d, t, &end, &letters);
    int parts = letters > 1 ? letters : 1;
    double advance = 0;
    struct font_face_info info;
    font_face_describe(g->face, &info);
    if (parts > 1)
        (void)font_face_advance(g->face, g->glyph, &advance);
    for (int k = 0; k < parts; k++) {
        size_t begin = !leftward ? t->begin : letters ? letter_begin(text, end) : end;
        if (!letter_show(m, i, text ? text + begin : NULL, end - begin, parts, em,
                         advance / info.units_per_em * k / parts, hidden || k > 0))
            return pdf_no_memory();
        end = begin;
    }
    return FONT_OK;
}

/* A space that ends a line is not seen, but parts words for who reads on. It stands where the
 * line goes on to. */
static enum font_status space_show(struct pdf_making *m, int i, const double em[6])
{
    const struct font_placed *g = &m->layout->glyphs[i];
    const struct drawn_text *t = &m->drawn.texts[i];
    const struct font_drawing *d = m->d;
    if (!d->text || !m->ends[i] || t->begin == t->end || t->end >= d->bytes ||
        d->text[t->end] != ' ')
        return FONT_OK;
    uint32_t space = font_face_glyph(g->face, ' ');
    struct font_face_info info;
    double along = 0, at[6];
    font_face_describe(g->face, &info);
    (void)font_face_advance(g->face, pdf_is_leftward(d, t) ? space : g->glyph, &along);
    along *= (pdf_is_leftward(d, t) ? -1 : 1) / info.units_per_em;
    int letter = space ? pdf_letter_find(m->p, g->face, space, false, " ", 1, 1) : -1;
    if (letter < 0)
        return space ? pdf_no_memory() : FONT_OK;
    memcpy(at, em, sizeof at);
    at[4] += em[0] * along;
    at[5] += em[1] * along;
    pdf_run_letter(m, letter, at, false);
    return FONT_OK;
}

static enum font_status path_show(struct pdf_making *m, int i, const struct font_map *whole)
{
    const struct font_placed *g = &m->layout->glyphs[i];
    struct font_outline outline;
    pdf_run_end(m);
    enum font_status status = font_face_outline_or_none(g->face, g->glyph, false, &outline);
    if (status != FONT_OK)
        return status;
    fprintf(m->f, "q %g 0 0 %g 0 %.7g cm\n", pdf_point_px, -pdf_point_px,
            m->d->height_px * pdf_point_px);
    status = drawn_path(&outline, whole, true, m->f);
    fputs("f Q\n", m->f);
    font_outline_finish(&outline);
    return status;
}

static enum font_status glyph_show(struct pdf_making *m, int i)
{
    const struct font_placed *g = &m->layout->glyphs[i];
    bool picture = m->drawn.glyphs[m->drawn.of[i]].picture;
    struct font_map whole;
    struct font_ink own;
    double flat[4], em[6];
    enum font_status status = drawn_map(m->layout, i, m->map, m->x, m->y, &whole);
    if (status != FONT_OK)
        return status;
    if (m->ink != g->ink) {
        pdf_run_end(m);
        pdf_ink_use(m, i);
        m->ink = g->ink;
    }
    /* Distorted letters are paths; so are those in gradients, which programs clip to outlines
     * more exactly than to letters. */
    bool path = !picture && !(whole.kind == FONT_AFFINE &&
                              drawn_flat(drawn_ink(m->d, m->layout, i, &own), flat));
    if (picture)
        status = picture_show(m, i);
    else if (path)
        status = path_show(m, i, &whole);
    if (status != FONT_OK || (path && !m->d->text))
        return status;
    em_find(m, g, &whole, em);
    status = text_show(m, i, em, path);
    return status == FONT_OK && !path && !picture ? space_show(m, i, em) : status;
}

/* ---- what it belongs to ---- */

static void mark_end(struct pdf_making *m)
{
    if (m->passage == -1)
        return;
    pdf_run_end(m);
    fputs("EMC\n", m->f);
    m->passage = -1;
}

/* The passage that a byte is in; -2: none. */
static int passage_of(const struct font_drawing *d, size_t byte)
{
    int low = 0, high = d->passages_count;
    while (low < high) {
        int half = (low + high) / 2;
        if (d->passages[half].begin <= byte)
            low = half + 1;
        else
            high = half;
    }
    return low > 0 && byte < d->passages[low - 1].end &&
                   d->passages[low - 1].role != FONT_ROLE_ARTIFACT
               ? low - 1
               : -2;
}

/* Before glyph i: the mark of the passage that it is in. */
static bool mark_see(struct pdf_making *m, int i, int mark_begin)
{
    const struct font_placed *g = &m->layout->glyphs[i];
    const struct font_passage all = {.end = m->d->bytes, .paragraph = -1};
    int passage = !m->d->text ? -2 : m->d->passages ? passage_of(m->d, (size_t)g->cluster) : 0;
    if (passage == m->passage)
        return true;
    mark_end(m);
    pdf_run_end(m);
    m->passage = passage;
    if (passage == -2) {
        fputs("/Artifact BMC\n", m->f);
        return true;
    }
    double top =
        (m->d->height_px - m->y - g->y_px + font_placed_size(m->layout, g)) * pdf_point_px;
    int mark =
        pdf_mark_begin(m->p, m->d, m->d->passages ? &m->d->passages[passage] : &all, top);
    if (mark < 0)
        return false;
    char room[8];
    fprintf(m->f, "/%s << /MCID %d >> BDC\n",
            pdf_tag(&m->p->elements[m->p->marks[mark].element], room), mark - mark_begin);
    return true;
}

/* Glyphs of a line as its text has them: those that go to the left are else the other way
 * around. */
static int order_compare(const void *a, const void *b, void *layout)
{
    const struct font_placed *glyphs = ((const struct font_layout *)layout)->glyphs;
    int i = *(const int *)a, k = *(const int *)b, p = glyphs[i].cluster, q = glyphs[k].cluster;
    return p != q ? (p > q) - (p < q) : (i > k) - (i < k);
}

static bool order_make(struct pdf_making *m)
{
    const struct font_placed *g = m->layout->glyphs;
    int n = m->layout->glyphs_count;
    struct font_layout layout = *m->layout;
    m->order = malloc(((size_t)n + 1) * sizeof *m->order);
    m->ends = calloc((size_t)n + 1, sizeof *m->ends);
    m->advances = malloc(((size_t)m->drawn.count + 1) * sizeof *m->advances);
    if (!m->order || !m->ends || !m->advances)
        return false;
    for (int k = 0; k < m->drawn.count; k++)
        m->advances[k] = NAN;
    for (int i = 0; i < n; i++)
        m->order[i] = i;
    for (int i = 0, begin = 0; i < n; i++) {
        if (i + 1 < n && g[i + 1].line == g[begin].line)
            continue;
        if (m->d->text)
            qsort_r(m->order + begin, (size_t)(i + 1 - begin), sizeof *m->order, order_compare,
                    &layout);
        m->ends[m->order[i]] = i + 1 < n;
        begin = i + 1;
    }
    return true;
}

/* Where a glyph ends along its line, in the layout's pixels. */
static double right_of(const struct pdf_making *m, int i)
{
    const struct font_placed *g = &m->layout->glyphs[i];
    double *advance = &m->advances[m->drawn.of[i]];
    if (isnan(*advance)) {
        struct font_face_info info;
        font_face_describe(g->face, &info);
        *advance = 0;
        (void)font_face_advance(g->face, g->glyph, advance);
        *advance /= info.units_per_em;
    }
    return g->x_px + *advance * font_placed_size(m->layout, g);
}

/* Where a cluster of LTR text ends, of glyphs first..last of the order: where the next one on
 * its line begins, else where the farthest of its glyphs does. */
static double cluster_end(const struct pdf_making *m, int first, int last)
{
    const struct font_placed *g = m->layout->glyphs;
    const int next = m->order[last] + 1, count = m->layout->glyphs_count;
    double far = right_of(m, m->order[first]), begin = INFINITY;
    for (int k = first + 1; k <= last; k++)
        far = fmax(far, right_of(m, m->order[k]));
    for (int k = next;
         k < count && g[k].line == g[next].line && g[k].cluster == g[next].cluster; k++)
        begin = fmin(begin, g[k].x_px);
    bool follows = next < count && g[next].line == g[next - 1].line &&
                   g[next].y_px == g[m->order[first]].y_px;
    return follows && begin > g[m->order[first]].x_px ? begin : far;
}

/* Programs take a cluster that is told as a whole to end where its last glyph does, a gap
 * behind it for a space, and none for none. Where the cluster ends elsewhere (a mark stands
 * behind its letter, or the font puts the next one farther away), its last glyph is written
 * once more, unseen, so that it ends there. */
static enum font_status cluster_close(struct pdf_making *m, int first, int last)
{
    const double gap_ems = 0.02;
    const int i = m->order[last];
    const struct font_placed *g = &m->layout->glyphs[i];
    const double size = font_placed_size(m->layout, g);
    double lacks = cluster_end(m, first, last) - right_of(m, i), em[6];
    struct font_map whole;
    if (fabs(lacks) < gap_ems * size)
        return FONT_OK;
    enum font_status status = drawn_map(m->layout, i, m->map, m->x, m->y, &whole);
    if (status != FONT_OK)
        return status;
    em_find(m, g, &whole, em);
    return letter_show(m, i, NULL, 0, 1, em, lacks / size, true) ? FONT_OK : pdf_no_memory();
}

/* Whether there is more room to the right of a glyph than it has of its own, and no space in
 * the text: programs would read one. Its cluster is then told as a whole, too. */
static bool stands_apart(const struct pdf_making *m, int k)
{
    const double gap_ems = 0.08;
    const int i = m->order[k];
    const struct font_placed *g = m->layout->glyphs;
    const struct drawn_text *t = &m->drawn.texts[i];
    if (!m->d->text || !t->begins || !t->ends || i + 1 >= m->layout->glyphs_count ||
        g[i + 1].line != g[i].line || (t[1].begin != t->end && t[1].end != t->begin) ||
        g[i + 1].x_px - right_of(m, i) <= gap_ems * font_placed_size(m->layout, &g[i]))
        return false;
    return !pdf_leftward(m->d, t) && !font_text_white(sign_of(m, i)) &&
           !font_text_white(sign_of(m, i + 1)) &&
           cluster_end(m, k, k) - right_of(m, i) > gap_ems * font_placed_size(m->layout, &g[i]);
}

static enum font_status content_make(struct pdf_making *m, int marks_begin)
{
    enum font_status status = drawn_find(m->d, m->layout, &m->drawn);
    if (status == FONT_OK)
        pdf_marks_tell_nothing(m->d, m->layout, &m->drawn);
    if (status == FONT_OK && !order_make(m))
        status = pdf_no_memory();
    pdf_boxes_show(m);
    for (int k = 0, first = 0; k < m->layout->glyphs_count && status == FONT_OK; k++) {
        int i = m->order[k];
        const struct drawn_text *t = &m->drawn.texts[i];
        if (!mark_see(m, i, marks_begin))
            return pdf_no_memory();
        const bool apart = stands_apart(m, k);
        if (apart || pdf_said_begins(m->d, t)) {
            first = k;
            pdf_run_end(m);
            pdf_said_begin(m->d, t, m->f);
        }
        status = glyph_show(m, i);
        if (apart || pdf_said_ends(m->d, t)) {
            if (status == FONT_OK)
                status = cluster_close(m, first, k);
            pdf_run_end(m);
            fputs("EMC\n", m->f);
        }
    }
    pdf_run_end(m);
    mark_end(m);
    pdf_strokes_show(m);
    return status;
}

/* The page's objects: what is on it, its pictures and inks, itself. */
static enum font_status objects_put(struct pdf_making *m, const char *content, size_t count,
                                    int marks_begin)
{
    struct font_document *p = m->p;
    int *inks = calloc((size_t)m->layout->inks_count + 1, sizeof *inks),
        *strokes = calloc((size_t)m->d->strokes_count + 1, sizeof *strokes), contents = 0;
    if (!inks || !strokes ||
        !array_reserve(&p->pages, &p->pages_capacity, p->pages_count + 1, sizeof *p->pages)) {
        free(inks);
        free(strokes);
        return pdf_no_memory();
    }
    pdf_stream(p, &contents, "", content, count);
    enum font_status status = pdf_inks_make(m, inks);
    if (status == FONT_OK)
        status = pdf_strokes_make(m, strokes);
    for (int i = 0; i < m->pictures_count; i++)
        pdf_picture_put(p, &m->pictures[i]);
    int number = pdf_object(p);
    pdf_object_begin(p, number);
    fprintf(p->f,
            "<< /Type /Page /Parent %d 0 R /MediaBox [0 0 %.7g %.7g] /Contents %d 0 R "
            "/StructParents %d /Tabs /S\n/Resources << /Font %d 0 R /XObject <<",
            p->list_number, m->d->width_px * pdf_point_px, m->d->height_px * pdf_point_px,
            contents, p->pages_count, p->fonts_number);
    for (int i = 0; i < m->pictures_count; i++)
        fprintf(p->f, " /I%d %d 0 R", i, m->pictures[i].number);
    for (int i = 0; i < m->d->strokes_count; i++)
        fprintf(p->f, " /S%d %d 0 R", i, strokes[i]);
    fputs(" >>", p->f);
    pdf_inks_put(m, inks);
    fputs(" >> >>\nendobj\n", p->f);
    p->pages[p->pages_count++] = (struct pdf_page){.number = number,
                                                   .marks_begin = marks_begin,
                                                   .marks_count = p->marks_count - marks_begin};
    free(inks);
    free(strokes);
    return status;
}

enum font_status pdf_page_put(struct font_document *p, const struct font_drawing *d,
                              const struct font_layout *layout, const struct font_map *map,
                              double x, double y)
{
    struct pdf_making m = {
        .p = p, .d = d, .layout = layout, .map = map, .x = x, .y = y, .passage = -1, .ink = -1};
    char *content = NULL;
    size_t count = 0;
    int marks_begin = p->marks_count;
    m.f = open_memstream(&content, &count);
    if (!m.f)
        return pdf_no_memory();
    enum font_status status = content_make(&m, marks_begin);
    if (fclose(m.f) != 0 && status == FONT_OK)
        status = pdf_no_memory();
    if (status == FONT_OK)
        status = objects_put(&m, content, count, marks_begin);
    for (int i = 0; i < m.pictures_count; i++)
        pdf_picture_finish(&m.pictures[i]);
    free(m.pictures);
    free(m.order);
    free(m.ends);
    free(m.advances);
    free(content);
    drawn_finish(&m.drawn);
    return status;
}
