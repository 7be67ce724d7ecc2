/* test_page_rules.c - the rules of pages: lines fill their column, hyphenation, keeps, notes,
 * shapes, tabs, vertical lines. */
#include "support.h"

#include "made_font.h"

#include <edges.h>

#include <page.h>
#include <setup.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char marsh[] =
    "The water of a marsh carries pigment through the fibers of a sheet; what it leaves at its "
    "rim dries "
    "dark, and extraordinary hyphenation demonstrates itself wherever a representative of "
    "communication "
    "finds no satisfactory arrangement within the measurement of a newspaper's column.";

struct fixture {
    struct page_text *text;
    struct font_layout layout;
};

static void begin(struct fixture *f, const struct page_frame *frames, int count,
                  const struct page_shape *shape)
{
    struct page_template page = {.width_px = 500, .height_px = 500, .frames_count = count};
    struct page_style style = page_style_default();
    int id;
    *f = (struct fixture){0};
    memcpy(page.frames, frames, (size_t)count * sizeof *frames);
    if (shape) {
        page.shapes[0] = *shape;
        page.shapes_count = 1;
    }
    assert_font(page_text_create(&f->text));
    style.font = "DejaVuSerif";
    style.size_px = 14;
    style.language = "en";
    assert_font(page_style_add(f->text, &style, &id));
    assert_font(page_templates_set(f->text, &page, 1));
}

static int add(struct fixture *f, const char *text, const struct page_manner *manner)
{
    int id;
    assert_font(page_paragraph_add(f->text, 0, -1, text, strlen(text), 0, manner, &id));
    return id;
}

static const struct font_layout *look(struct fixture *f, int page)
{
    font_layout_finish(&f->layout);
    assert_font(page_layout(f->text, page, &f->layout));
    return &f->layout;
}

static void end(struct fixture *f)
{
    font_layout_finish(&f->layout);
    page_text_destroy(f->text);
}

static struct page_manner manner_of(enum font_align align)
{
    struct page_manner m = page_manner_default();
    m.align = align;
    m.leading_px = 20;
    return m;
}

static const struct page_frame column = {.x = 30, .y = 40, .width = 190, .height = 420};

static void justified_lines_fill_the_column(void **state)
{
    (void)state;
    for (int hang = 0; hang < 2; hang++) {
        struct fixture f;
        struct page_manner m = manner_of(FONT_ALIGN_JUSTIFY);
        begin(&f, &column, 1, NULL);
        m.hyphenate = true;
        m.protrude = hang;
        add(&f, marsh, &m);
        const struct font_layout *l = look(&f, 0);
        int lines = l->glyphs[l->glyphs_count - 1].line, hung = 0;
        assert_true(lines > 8);
        for (int i = 0; i + 1 < l->glyphs_count; i++) {
            const struct font_placed *g = &l->glyphs[i];
            if (i == 0 || g[-1].line != g->line)
                assert_true(fabs(g->x_px - 30) <
                            (hang ? 1.0 : 0.01)); /* T stands out a little */
            if (g->line < lines && g[1].line != g->line) {
                double over = glyph_end(g) - 220;
                hung += over > 0.5;
                if (!hang)
                    assert_true(fabs(over) < 0.02);
                else
                    assert_true(over > -0.02 && over < 4);
            }
        }
        assert_int_equal(hung > 0, hang);
        end(&f);
    }
}

/* The patterns allow each hyphen that stands at a line's end. */
static void words_are_divided_by_patterns(void **state)
{
    (void)state;
    struct fixture f;
    struct page_manner m = manner_of(FONT_ALIGN_JUSTIFY);
    struct page_frame narrow = column;
    struct page_stats stats;
    int hyphens = 0;
    narrow.width = 120;
    begin(&f, &narrow, 1, NULL);
    m.hyphenate = true;
    add(&f, marsh, &m);
    const struct font_layout *l = look(&f, 0);
    static const char *const parts[] = {"ex\001traor\001di\001nary",
                                        "hy\001phen\001ation",
                                        "demon\001strates",
                                        "rep\001re\001sen\001ta\001tive",
                                        "com\001mu\001ni\001ca\001tion",
                                        "sat\001is\001fac\001tory",
                                        "arrange\001ment",
                                        "mea\001sure\001ment",
                                        "pig\001ment",
                                        "car\001ries",
                                        "fibers",
                                        "wher\001ever",
                                        "news\001pa\001per",
                                        "col\001umn",
                                        "wa\001ter",
                                        "it\001self"};
    for (int i = 1; i + 1 < l->glyphs_count; i++) {
        if (l->glyphs[i].line == l->glyphs[i + 1].line ||
            l->glyphs[i].glyph != font_face_glyph(l->glyphs[i].face, 0x2010))
            continue;
        int at = l->glyphs[i + 1].cluster, from = at;
        while (from > 0 && marsh[from - 1] != ' ')
            from--;
        bool known = false;
        for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
            char word[40];
            int n = 0, allowed = 0;
            for (const char *c = parts[k]; *c; c++) {
                if (*c == '\001')
                    allowed |= n == at - from;
                else
                    word[n++] = *c;
            }
            if (strncmp(marsh + from, word, (size_t)n) == 0) {
                known = true;
                if (!allowed)
                    fail_msg("%s is divided behind %d letters", word, at - from);
            }
        }
        assert_true(known);
        hyphens++;
    }
    page_stats_get(f.text, &stats);
    assert_true(hyphens >= 2);
    assert_int_equal(stats.lines_overfull, 0);
    end(&f);
}

static void letters_widen_a_little(void **state)
{
    (void)state;
    struct fixture f;
    struct page_manner m = manner_of(FONT_ALIGN_JUSTIFY);
    begin(&f, &column, 1, NULL);
    m.expand = 0.03;
    add(&f, marsh, &m);
    const struct font_layout *l = look(&f, 0);
    int scaled = 0;
    for (int i = 0; i < l->glyphs_count; i++)
        if (l->glyphs[i].map) {
            const struct font_map *map = &l->maps[l->glyphs[i].map - 1];
            assert_true(fabs(map->m[0] - 1) <= 0.03 + 1e-6 && map->m[4] == 1);
            scaled++;
        }
    assert_true(scaled > l->glyphs_count / 2);
    end(&f);
}

/* Writes a font with an axis of widths to a file; path is a template that gets the file's
 * name. */
static void wide_write(char path[], double *em)
{
    struct font_face *plain;
    struct font_face_info info;
    size_t count, made_count;
    assert_font(font_face_open("DejaVuSerif", 0, &plain));
    font_face_describe(plain, &info);
    *em = info.units_per_em;
    const uint8_t *bytes = font_face_bytes(plain, &count);
    uint8_t *made = made_wide(bytes, count, &made_count);
    int file = mkstemps(path, 4);
    assert_true(file >= 0 && write(file, made, made_count) == (ssize_t)made_count);
    close(file);
    free(made);
    font_face_close(plain);
}

/* With an axis of widths lines are as wide as without it. Letters are expanded along the axis,
 * so their maps expand them hardly at all. */
static void letters_are_expanded_by_the_fonts_axis(void **state)
{
    (void)state;
    char path[] = "/tmp/wide-XXXXXX.ttf", named[sizeof path];
    double em;
    wide_write(path, &em);
    struct fixture f;
    struct page_template page = {.width_px = 500, .height_px = 500, .frames_count = 1};
    struct page_style style = page_style_default();
    struct page_manner m = manner_of(FONT_ALIGN_JUSTIFY);
    int id, varied = 0, mapped = 0, letters = 0;
    f = (struct fixture){0};
    page.frames[0] = column;
    m.expand = 0.05;
    assert_font(page_text_create(&f.text));
    style.font = strcpy(named, path);
    style.size_px = 14;
    assert_font(page_style_add(f.text, &style, &id));
    memset(named, 'x', sizeof named - 1); /* a style keeps the name */
    assert_font(page_templates_set(f.text, &page, 1));
    add(&f, marsh, &m);
    const struct font_layout *l = look(&f, 0);
    for (int i = 0; i + 1 < l->glyphs_count; i++) {
        const struct font_placed *g = &l->glyphs[i];
        const struct font_map *map = g->map ? &l->maps[g->map - 1] : NULL;
        struct font_axis axis;
        assert_font(font_face_axis(g->face, 0, &axis));
        assert_string_equal(axis.tag, "wdth");
        assert_true(axis.value >= 95 && axis.value <= 105);
        varied += axis.value != 100;
        mapped += map && fabs(map->m[0] - 1) > 0.0075; /* such as are put together of others */
        letters++;
        if (g[1].line == g->line || l->glyphs[l->glyphs_count - 1].line == g->line)
            continue;
        double map_part = map ? map->m[0] : 1, end_px;
        end_px = g->x_px + (glyph_end(g) - g->x_px) * map_part;
        if (fabs(end_px - (column.x + column.width)) > 0.05)
            fail_msg("line %d ends at %g", g->line, end_px);
    }
    assert_true(varied > letters / 2 && mapped < letters / 10);
    end(&f);
    unlink(path);
}

/* The number of the paragraph's lines on a page. */
static int lines_on(struct fixture *f, int id, int page)
{
    struct page_box boxes[100];
    size_t bytes;
    int count;
    page_paragraph_text(f->text, id, &bytes);
    assert_font(page_select(f->text, (struct page_place){id, 0},
                            (struct page_place){id, (int)bytes}, page, boxes, 100, &count));
    return count;
}

static void keeps_are_kept(void **state)
{
    (void)state;
    /* At no height of the column does a paragraph leave a single line alone. */
    for (int height = 100; height < 420; height += 20) {
        struct fixture f;
        struct page_frame frame = column;
        struct page_manner m = manner_of(FONT_ALIGN_LEFT), head = m, whole = m;
        frame.height = height;
        head.keep_with_next = true;
        whole.keep_together = true;
        begin(&f, &frame, 1, NULL);
        int first = add(&f, marsh, &m), heading = add(&f, "A heading", &head);
        int second = add(&f, marsh, &m),
            third = add(&f,
                        "Three lines of text that are kept together, "
                        "whatever the column's height may be.",
                        &whole);
        int pages, page, behind;
        assert_font(page_count(f.text, &pages));
        assert_true(pages > 1);
        for (int k = 0; k < pages; k++) {
            int a = lines_on(&f, first, k), b = lines_on(&f, second, k);
            assert_true(a != 1 && b != 1);
        }
        assert_font(page_find(f.text, (struct page_place){heading, 0}, &page));
        assert_font(page_find(f.text, (struct page_place){second, 0}, &behind));
        assert_int_equal(page, behind);
        assert_font(page_find(f.text, (struct page_place){third, 0}, &page));
        assert_font(page_find(f.text, (struct page_place){third, 70}, &behind));
        assert_int_equal(page, behind);
        end(&f);
    }
}

static void notes_go_with_their_lines(void **state)
{
    (void)state;
    for (int at = 10; at < 250; at += 12) {
        struct fixture f;
        struct page_frame frame = column;
        struct page_manner m = manner_of(FONT_ALIGN_JUSTIFY);
        int foot, margin, page, with;
        struct page_caret a, b;
        frame.height = 150;
        frame.margin_x = 260;
        frame.margin_width = 120;
        frame.foot_gap_px = 6;
        begin(&f, &frame, 1, NULL);
        int id = add(&f, marsh, &m);
        assert_font(page_note_add(f.text, id, at, PAGE_NOTE_FOOT, "A note at the foot of it.",
                                  25, 0, &m, &foot));
        assert_font(
            page_note_add(f.text, id, at, PAGE_NOTE_MARGIN, "Beside it.", 10, 0, &m, &margin));
        assert_font(page_caret_get(f.text, (struct page_place){id, at}, true, &a));
        page = a.page;
        assert_font(page_caret_get(f.text, (struct page_place){foot, 0}, false, &b));
        assert_int_equal(b.page, page);
        assert_true(b.y0 >= a.y1 &&
                    b.y1 <= 40 + 150 + 1e-6); /* under its line, within the frame */
        assert_font(page_caret_get(f.text, (struct page_place){margin, 0}, false, &b));
        assert_int_equal(b.page, page);
        assert_true(b.x0 >= 260 && b.y0 == a.y0);
        assert_font(page_find(f.text, (struct page_place){id, 0}, &with));
        assert_int_equal(with, 0);
        end(&f);
    }
}

/* Under the line that goes down, in lines that go down. */
static void notes_stand_under_vertical_lines(void **state)
{
    (void)state;
    struct fixture f;
    struct page_frame frame = {.x = 30,
                               .y = 40,
                               .width = 300,
                               .height = 190,
                               .vertical = true,
                               .margin_x = 250,
                               .margin_width = 120,
                               .foot_gap_px = 6};
    struct page_manner m = manner_of(FONT_ALIGN_JUSTIFY);
    struct page_caret a, b;
    int foot, margin;
    begin(&f, &frame, 1, NULL);
    int id = add(&f, marsh, &m);
    assert_font(
        page_note_add(f.text, id, 120, PAGE_NOTE_FOOT, "At the left.", 12, 0, &m, &foot));
    assert_font(page_note_add(f.text, id, 120, PAGE_NOTE_MARGIN, "Under its line.", 15, 0, &m,
                              &margin));
    assert_font(page_caret_get(f.text, (struct page_place){id, 120}, true, &a));
    assert_font(page_caret_get(f.text, (struct page_place){margin, 0}, false, &b));
    assert_true(b.page == a.page && b.y0 >= 250 && fabs(b.x0 - a.x0) < 1e-6);
    assert_font(page_caret_get(f.text, (struct page_place){foot, 0}, false, &b));
    assert_true(b.page == a.page && fmax(b.x0, b.x1) <= fmin(a.x0, a.x1) + 1e-6 &&
                fmin(b.x0, b.x1) >= 30 - 1e-6);
    end(&f);
}

static void text_keeps_off_shapes(void **state)
{
    (void)state;
    static const double disc[] = {200, 150, 270, 180, 300, 250, 270, 320,
                                  200, 350, 130, 320, 100, 250, 130, 180};
    for (int inside = 0; inside < 2; inside++) {
        struct fixture f;
        const struct page_frame wide = {.x = 20, .y = 20, .width = 440, .height = 440};
        const struct page_shape shape = {.points = disc,
                                         .points_count = 8,
                                         .inside = inside,
                                         .distance_px = inside ? 0 : 6,
                                         .least_px = 30};
        struct page_manner m = manner_of(FONT_ALIGN_JUSTIFY);
        int in = 0, out = 0;
        begin(&f, &wide, 1, &shape);
        for (int i = 0; i < 4; i++)
            add(&f, marsh, &m);
        const struct font_layout *l = look(&f, 0);
        for (int i = 0; i < l->glyphs_count; i++) {
            const struct font_placed *g = &l->glyphs[i];
            double x = g->x_px, y = g->y_px - 5; /* in the middle of the letters */
            bool within = false;
            for (int a = 0, b = 7; a < 8; b = a++)
                if ((disc[2 * a + 1] > y) != (disc[2 * b + 1] > y) &&
                    x < disc[2 * a] + (disc[2 * b] - disc[2 * a]) * (y - disc[2 * a + 1]) /
                                          (disc[2 * b + 1] - disc[2 * a + 1]))
                    within = !within;
            in += within;
            out += !within;
        }
        assert_true(inside ? in > 60 && out == 0 : out > 300 && in == 0);
        end(&f);
    }
}

/* How far the page's glyphs stand out of the column, or into the box that lines go around. */
static double stands_out(const struct font_layout *l, const struct page_frame *frame,
                         const double *box, double leading)
{
    double most = 0;
    for (int i = 0; i < l->glyphs_count; i++) {
        const struct font_placed *g = &l->glyphs[i];
        struct font_face_info info;
        font_face_describe(g->face, &info);
        double scale = (double)g->size_px / info.units_per_em, end = glyph_end(g);
        double top = g->y_px - leading / 2 - (info.ascender + info.descender) * scale / 2;
        most = fmax(most, fmax(frame->x - g->x_px, end - frame->x - frame->width));
        if (g->size_px > 12 && top < box[3] - 0.01 && top + leading > box[1] + 0.01 &&
            end - g->x_px > 0)
            most = fmax(most, fmin(end - box[0], box[2] - g->x_px));
    }
    return most;
}

/* Notes shorten the column while it is filled, keeps send lines on: what then goes around a box
 * must be broken for what it gets. */
static void notes_and_keeps_beside_shapes(void **state)
{
    (void)state;
    static const char *const some[] = {"the ", "of ",     "human ",  "family ",
                                       "a ",   "rights ", "paper, ", "extraordinary "};
    uint32_t seed = 3;
    for (int turn = 0; turn < 25; turn++) {
        struct fixture f;
        struct page_frame frames[2] = {{.x = 20, .y = 20, .width = 210, .height = 380},
                                       {.x = 250, .y = 20, .width = 210, .height = 380}};
        double x = 20 + 20 * (turn % 4), y = 30 + 17 * (turn % 17), w = 240;
        const double box[4] = {x, y, x + w, y + 60 + 7 * (turn % 9)};
        const double corners[8] = {box[0], box[1], box[2], box[1],
                                   box[2], box[3], box[0], box[3]};
        const struct page_shape shape = {.points = corners, .points_count = 4, .least_px = 60};
        begin(&f, frames, 2, &shape);
        struct page_style small = page_style_default();
        int fine, note;
        small.font = "DejaVuSerif";
        small.size_px = 10;
        assert_font(page_style_add(f.text, &small, &fine));
        struct page_manner m = manner_of(FONT_ALIGN_JUSTIFY), foot = m;
        foot.leading_px = 13;
        m.hyphenate = true;
        for (int i = 0; i < 4; i++) {
            char text[4000] = "";
            for (int k = 20 + (int)(random_next(&seed) % 150); k > 0; k--)
                strcat(text, some[random_next(&seed) % 8]);
            m.orphans = m.widows = 1 + (int)(random_next(&seed) % 3);
            m.keep_together = random_next(&seed) % 4 == 0;
            m.keep_with_next = random_next(&seed) % 4 == 0;
            int id = add(&f, text, &m);
            for (int k = 0; k < 2; k++) {
                int byte = (int)(random_next(&seed) % strlen(text));
                assert_font(page_note_add(f.text, id, byte, PAGE_NOTE_FOOT, some[k],
                                          strlen(some[k]), fine, &foot, &note));
            }
        }
        int pages;
        assert_font(page_count(f.text, &pages));
        for (int k = 0; k < pages; k++) {
            const struct font_layout *l = look(&f, k);
            for (int c = 0; c < 2; c++) {
                struct font_layout part = *l;
                struct font_placed *glyphs =
                    calloc((size_t)l->glyphs_count + 1, sizeof *glyphs);
                part.glyphs = glyphs;
                part.glyphs_count = 0;
                for (int i = 0; i < l->glyphs_count; i++)
                    if ((l->glyphs[i].x_px > 240) == c)
                        glyphs[part.glyphs_count++] = l->glyphs[i];
                double most = stands_out(&part, &frames[c], box, m.leading_px);
                if (most > 3) /* an overfull line may be a little */
                    fail_msg("turn %d, page %d, column %d: a glyph stands out by %g px", turn,
                             k, c, most);
                free(glyphs);
            }
        }
        end(&f);
    }
}

static void tabs_are_stops(void **state)
{
    (void)state;
    struct fixture f;
    struct page_frame wide = column;
    struct page_manner m = manner_of(FONT_ALIGN_LEFT);
    wide.width = 420;
    m.tabs[0] = (struct page_tab){100, PAGE_TAB_LEFT};
    m.tabs[1] = (struct page_tab){250, PAGE_TAB_RIGHT};
    m.tabs[2] = (struct page_tab){330, PAGE_TAB_DECIMAL};
    m.tabs_count = 3;
    begin(&f, &wide, 1, NULL);
    add(&f, "ink\twater\t12\t3.75", &m);
    const struct font_layout *l = look(&f, 0);
    int seen = 0;
    for (int i = 0; i < l->glyphs_count; i++) {
        const struct font_placed *g = &l->glyphs[i];
        if (g->cluster == 4)
            seen += fabs(g->x_px - 130) < 0.01;
        if (g->cluster == 11)
            seen += fabs(glyph_end(g) - 280) < 0.01;
        if (g->cluster == 14) /* the point */
            seen += fabs(g->x_px - 360) < 0.01;
    }
    assert_int_equal(seen, 3);
    end(&f);
}

static void lines_go_down(void **state)
{
    (void)state;
    struct fixture f;
    struct page_frame frame = column;
    struct page_manner m = manner_of(FONT_ALIGN_LEFT);
    frame.vertical = true;
    frame.height = 120;
    begin(&f, &frame, 1, NULL);
    int id = add(&f, "abc def ghi jkl mno pqr stu vwx", &m);
    const struct font_layout *l = look(&f, 0);
    for (int i = 1; i < l->glyphs_count; i++) {
        const struct font_placed *g = &l->glyphs[i];
        const double *map = l->maps[g->map - 1].m;
        assert_true(map[1] == -1 && map[3] == 1); /* Latin lies, its top to the right */
        if (g->line == g[-1].line)
            assert_true(g->y_px > g[-1].y_px && g->x_px == g[-1].x_px);
        else
            assert_true(fabs(g[-1].x_px - g->x_px - 20) < 1e-4 && g->y_px < 45);
    }
    assert_true(l->glyphs[l->glyphs_count - 1].line >= 1);
    struct page_caret caret;
    struct page_place place;
    bool edge;
    assert_font(page_caret_get(f.text, (struct page_place){id, 5}, false, &caret));
    assert_true(caret.y0 == caret.y1 && caret.x0 - caret.x1 == 20);
    assert_font(page_hit(f.text, 0, (caret.x0 + caret.x1) / 2, caret.y0, &place, &edge));
    assert_int_equal(place.byte, 5);
    end(&f);
}

static void thai_words_are_broken(void **state)
{
    (void)state;
    /* "the Thai language is beautiful", written without spaces. */
    static const char thai[] =
        "\xe0\xb8\xa0\xe0\xb8\xb2\xe0\xb8\xa9\xe0\xb8\xb2\xe0\xb9\x84\xe0\xb8\x97\xe0\xb8\xa2"
        "\xe0\xb9\x80\xe0\xb8\x9b\xe0\xb9\x87\xe0\xb8\x99\xe0\xb8\xa0\xe0\xb8\xb2\xe0\xb8\xa9"
        "\xe0\xb8\xb2\xe0\xb8\x97\xe0\xb8\xb5\xe0\xb9\x88\xe0\xb8\xaa\xe0\xb8\xa7\xe0\xb8\xa2";
    struct fixture f;
    struct page_frame narrow = column;
    struct page_manner m = manner_of(FONT_ALIGN_LEFT);
    bool word[80] = {[12] = true, [21] = true, [33] = true, [45] = true, [54] = true};
    narrow.width = 70;
    begin(&f, &narrow, 1, NULL);
    add(&f, thai, &m);
    const struct font_layout *l = look(&f, 0);
    int breaks = 0;
    for (int i = 1; i < l->glyphs_count; i++)
        if (l->glyphs[i].line != l->glyphs[i - 1].line) {
            assert_true(word[l->glyphs[i].cluster]);
            breaks++;
        }
    assert_true(breaks >= 2);
    end(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(justified_lines_fill_the_column),
        cmocka_unit_test(words_are_divided_by_patterns),
        cmocka_unit_test(letters_widen_a_little),
        cmocka_unit_test(letters_are_expanded_by_the_fonts_axis),
        cmocka_unit_test(keeps_are_kept),
        cmocka_unit_test(notes_go_with_their_lines),
        cmocka_unit_test(notes_stand_under_vertical_lines),
        cmocka_unit_test(text_keeps_off_shapes),
        cmocka_unit_test(notes_and_keeps_beside_shapes),
        cmocka_unit_test(tabs_are_stops),
        cmocka_unit_test(lines_go_down),
        cmocka_unit_test(thai_words_are_broken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
