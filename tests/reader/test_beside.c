/* test_beside.c - figures that text flows around, in documents made by chance, at widths, sizes
 * and templates by chance: each word has its place within its columns, none stands on another
 * or on a figure; and what is scrolled, set anew and edited is as it is from scratch.
 *
 *     READER_TEST_BESIDE=1000 test_reader_beside
 */
#include <reader_document.h>
#include <reader_edit.h>
#include <reader_template.h>
#include <reader_view.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../sample.h"
#include "without_library.h"

enum { WORD = 8, SEEN_MAX = 3000, PICTURES_MAX = 100 };

struct made {
    uint64_t state;
    FILE *out;
    int number;
    bool shaped; /* some figures are no boxes: words may stand in theirs */
};

static unsigned long long seed_now;

static int chance(struct made *m, int below)
{
    return (int)(sample_word(&m->state) % (unsigned)below);
}

/* Words of eight letters, each another one, that begin with q as no others do. */
static void words(struct made *m, int count)
{
    for (int i = 0; i < count; i++) {
        char word[WORD + 1] = {'q'};
        int n = ++m->number;
        for (int k = WORD - 1; k > 0; k--, n /= 20)
            word[k] = "bcdfghjklmnpqrstvwxz"[n % 20];
        fprintf(m->out, "%s%s", i ? " " : "", word);
    }
}

static void figure(struct made *m)
{
    static const char *const titles[] = {
        "left", "right",   "right 25%", "left 60%",   "left 90%",
        "full", "a title", "right 40%", "left round", "shape right 30%"};
    fputs("![", m->out);
    words(m, chance(m, 6));
    fprintf(m->out, "](p%dx%d.png \"%s\")\n\n", 8 + chance(m, 600), 8 + chance(m, 600),
            titles[chance(m, 10)]);
}

/* A script that lives, whose stage may stand beside lines. */
static void live(struct made *m)
{
    static const char *const sides[] = {"left", "right 30%", "", "60% right"};
    fprintf(m->out, "```lua live %dx%d %s\n", 16 + chance(m, 500), 16 + chance(m, 300),
            sides[chance(m, 4)]);
    for (int i = chance(m, 5); i >= 0; i--) {
        words(m, 1 + chance(m, 4));
        fputs("\n", m->out);
    }
    fputs("```\n\n", m->out);
}

static void block(struct made *m)
{
    const int kind = chance(m, 22);
    if (kind >= 20) {
        live(m);
        return;
    }
    if (kind < 6) {
        figure(m);
        return;
    }
    if (kind == 6)
        fprintf(m->out, "%.*s ", 1 + chance(m, 4), "####");
    else if (kind == 7)
        fputs("> ", m->out);
    else if (kind == 8)
        fputs("- ", m->out);
    else if (kind == 9)
        fputs("    ", m->out);
    words(m, kind == 6 || kind == 9 ? 1 + chance(m, 3) : 1 + chance(m, 90));
    fputs("\n\n", m->out);
}

static char *document_text(struct made *m)
{
    char *text = NULL;
    size_t bytes;
    m->out = open_memstream(&text, &bytes);
    for (int n = 4 + chance(m, 26); n > 0; n--)
        block(m);
    fclose(m->out);
    return text;
}

/* A gray triangle of the size that its name says. */
static bool picture(void *user, int source, const char *target, struct reader_picture *out)
{
    (void)user;
    (void)source;
    int width, height;
    if (sscanf(target, "p%dx%d.png", &width, &height) != 2)
        return false;
    const size_t all = (size_t)width * (size_t)height;
    *out = (struct reader_picture){width, height, malloc(3 * all), calloc(all, 1)};
    assert_true(out->rgb && out->alpha);
    memset(out->rgb, 128, 3 * all);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            out->alpha[(size_t)y * (size_t)width + (size_t)x] =
                x * height <= y * width ? 255 : 0;
    return true;
}

/* ---- what is seen ---- */

struct seen {
    size_t byte;
    int box; /* of the word's */
    struct reader_box at;
};
struct window {
    struct seen words[SEEN_MAX];
    struct page_box pictures[PICTURES_MAX];
    int words_count, pictures_count;
};

enum { STRIP_PX = 30 };

static void window_see(const struct reader_document *d, struct reader_view *view,
                       struct window *w)
{
    const struct reader_shown *shown;
    int count;
    w->words_count = w->pictures_count = 0;
    if (reader_view_look(view, &shown, &count) != READER_OK)
        fail_msg("seed %llu: %s", seed_now, reader_error());
    for (const char *at = d->plain; (at = strchr(at, 'q')); at += WORD) {
        struct reader_box boxes[4];
        const size_t byte = (size_t)(at - d->plain);
        const int n = reader_view_boxes(view, byte, byte + WORD, boxes, 4);
        for (int i = 0; i < n && i < 4 && w->words_count < SEEN_MAX; i++)
            w->words[w->words_count++] = (struct seen){byte, i, boxes[i]};
    }
    for (int i = 0; i < count; i++) {
        struct font_layout layout;
        assert_int_equal(reader_view_layout(view, shown[i].passage, &layout), READER_OK);
        for (int k = 0; k < layout.glyphs_count && w->pictures_count < PICTURES_MAX; k++) {
            const struct font_placed *g = &layout.glyphs[k];
            if (g->ink <= 0 || layout.inks[g->ink - 1].kind != FONT_INK_PICTURE)
                continue;
            const struct font_ink *ink = &layout.inks[g->ink - 1];
            w->pictures[w->pictures_count++] =
                (struct page_box){ink->x0, ink->y0 + shown[i].y_px + shown[i].text_px,
                                  ink->width_px, ink->height_px};
        }
        font_layout_finish(&layout);
        struct reader_stage stage;
        for (int k = 0;
             reader_view_stage(view, &shown[i], k, &stage) && w->pictures_count < PICTURES_MAX;
             k++) {
            assert_true(stage.right >= stage.x + stage.width - 1);
            w->pictures[w->pictures_count++] =
                (struct page_box){stage.x, stage.y, stage.width, stage.height + STRIP_PX};
        }
    }
}

static bool apart(double ax, double ay, double aw, double ah, const struct page_box *b)
{
    const double near = 0.51; /* pictures stand at whole pixels, more or less */
    return ax + aw <= b->x + near || ax >= b->x + b->width - near || ay + ah <= b->y + near ||
           ay >= b->y + b->height - near;
}

/* Lines may be set closer than their letters' boxes are high: middles tell. */
static void window_is_apart(const struct window *w, double width, bool shaped)
{
    for (int a = 0; a < w->words_count; a++) {
        const struct reader_box *box = &w->words[a].at;
        if (box->x < -0.5 || box->x + box->width > width + 0.5)
            fail_msg("seed %llu: a word at %g..%g in a window %g wide", seed_now, box->x,
                     box->x + box->width, width);
        for (int b = 0; b < w->pictures_count && !shaped; b++)
            if (!apart(box->x, box->y + box->height / 4, box->width, box->height / 2,
                       &w->pictures[b]))
                fail_msg("seed %llu: a word at %g, %g, %gx%g is on a picture at %g, %g, %gx%g",
                         seed_now, box->x, box->y, box->width, box->height, w->pictures[b].x,
                         w->pictures[b].y, w->pictures[b].width, w->pictures[b].height);
        for (int b = 0; b < a; b++) {
            const struct reader_box *o = &w->words[b].at;
            const struct page_box other = {o->x, o->y + o->height / 4, o->width, o->height / 2};
            if (w->words[b].byte != w->words[a].byte &&
                !apart(box->x, box->y + box->height / 4, box->width, box->height / 2, &other))
                fail_msg("seed %llu: words at %g, %g and %g, %g stand on each other", seed_now,
                         box->x, box->y, o->x, o->y);
        }
    }
    for (int a = 0; a < w->pictures_count; a++)
        for (int b = 0; b < a; b++) {
            const struct page_box *p = &w->pictures[a];
            if (!apart(p->x, p->y, p->width, p->height, &w->pictures[b]))
                fail_msg("seed %llu: pictures stand on each other at %g, %g", seed_now, p->x,
                         p->y);
        }
}

/* What is seen by both is where it is in the other one, but for the place of the first word. */
static void windows_compare(const struct window *a, const struct window *b, const char *when)
{
    int k = 0, same = 0;
    double x = 0, y = 0;
    for (int i = 0; i < a->words_count; i++) {
        const struct seen *own = &a->words[i];
        while (k < b->words_count &&
               (b->words[k].byte < own->byte ||
                (b->words[k].byte == own->byte && b->words[k].box < own->box)))
            k++;
        if (k == b->words_count || b->words[k].byte != own->byte || b->words[k].box != own->box)
            continue;
        const double dx = own->at.x - b->words[k].at.x, dy = own->at.y - b->words[k].at.y;
        if (!same++) {
            x = dx;
            y = dy;
        }
        if (fabs(dx - x) > 1e-6 || fabs(dy - y) > 1e-6)
            fail_msg("seed %llu: %s, the word of byte %zu is %g, %g away from where it is from "
                     "scratch",
                     seed_now, when, own->byte, dx - x, dy - y);
    }
    if (same && fabs(x) > 1e-6)
        fail_msg("seed %llu: %s, all is moved by %g", seed_now, when, x);
    if (!same && a->words_count)
        fail_msg("seed %llu: %s, nothing of the window is there from scratch", seed_now, when);
}

/* ---- obstacles ---- */

enum { OBSTACLES = 2 };
struct around {
    struct reader_obstacle own[OBSTACLES];
    int count;
};

/* Diamonds, within the column of the paragraph that a word in the window is of. */
static void around_chance(struct made *m, const struct reader_document *d,
                          struct reader_view *view, const struct reader_pages_setup *setup,
                          struct around *around)
{
    static struct window w;
    window_see(d, view, &w);
    around->count = 0;
    for (int i = 0; i < OBSTACLES && w.words_count; i++) {
        const struct reader_block *b =
            reader_document_block(d, w.words[chance(m, w.words_count)].byte);
        double left, right, y;
        if (b < d->blocks || b >= d->blocks + d->blocks_count || !reader_around_has(b) ||
            !reader_view_begins(view, (int)(b - d->blocks), READER_AROUND_LEFT, &left, &y) ||
            !reader_view_begins(view, (int)(b - d->blocks), READER_AROUND_RIGHT, &right, &y))
            continue;
        const double column = (right - left) / setup->size_px, width = fmin(6, column / 2);
        struct reader_obstacle *o = &around->own[around->count++];
        *o = (struct reader_obstacle){.block = (int)(b - d->blocks),
                                      .side = READER_AROUND_LEFT,
                                      .x = chance(m, 100) * 0.01 * (column - width),
                                      .y = chance(m, 50) * 0.1,
                                      .width = width,
                                      .height = 0.5 + chance(m, 120) * 0.1,
                                      .rows_count = 1 + chance(m, 60)};
        for (int k = 0; k < o->rows_count; k++) {
            const double off = fabs(2 * (k + 0.5) / o->rows_count - 1) * width / 2;
            o->rows[k] = (struct page_row){off, width - off};
        }
        if (chance(m, 2)) { /* the same, from the other edge */
            o->side = READER_AROUND_RIGHT;
            o->x -= column;
        }
    }
    assert_int_equal(reader_view_around(view, around->own, around->count), READER_OK);
}

/* No word stands in one. */
static void around_is_apart(const struct reader_document *d, const struct window *w,
                            struct reader_view *view, const struct reader_pages_setup *setup,
                            const struct around *around)
{
    const double em = setup->size_px, near = 0.1;
    for (int i = 0; i < around->count; i++) {
        const struct reader_obstacle *o = &around->own[i];
        const double row = em * o->height / o->rows_count;
        double x, y;
        if (!reader_view_begins(view, o->block, o->side, &x, &y))
            continue;
        for (int k = 0; k < o->rows_count * w->words_count; k++) {
            const struct reader_box *b = &w->words[k / o->rows_count].at;
            const int r = k % o->rows_count;
            if (reader_document_block(d, w->words[k / o->rows_count].byte)->kind ==
                READER_PICTURE) /* ink is drawn over figures, too */
                continue;
            const double top = y + em * o->y + r * row;
            if (top + row > b->y + near && top < b->y + b->height - near &&
                x + em * (o->x + o->rows[r].to_px) > b->x + near &&
                x + em * (o->x + o->rows[r].from_px) < b->x + b->width - near)
                fail_msg("seed %llu: a word at %g, %g, %gx%g is in an obstacle at %g, %g",
                         seed_now, b->x, b->y, b->width, b->height, x + em * o->x,
                         y + em * o->y);
        }
    }
}

static void as_from_scratch(const struct reader_document *d,
                            const struct reader_pages_setup *setup, struct reader_view *view,
                            bool shaped, const struct around *around, const char *when)
{
    static struct window own, other;
    struct reader_view *fresh;
    window_see(d, view, &own);
    window_is_apart(&own, setup->width_px < 15 * setup->size_px ? 1e4 : setup->width_px,
                    shaped);
    around_is_apart(d, &own, view, setup, around);
    if (!own.words_count)
        return;
    const struct seen *middle = &own.words[own.words_count / 2];
    assert_int_equal(reader_view_create(d, setup, &fresh), READER_OK);
    assert_int_equal(reader_view_around(fresh, around->own, around->count), READER_OK);
    assert_int_equal(reader_view_go(fresh, middle->byte, middle->at.y), READER_OK);
    window_see(d, fresh, &other);
    windows_compare(&own, &other, when);
    reader_view_destroy(fresh);
}

/* ---- by chance ---- */

static void setup_chance(struct made *m, struct reader_pages_setup *setup)
{
    static const char *const fonts[] = {"DejaVuSerif", "DejaVuSans"};
    struct reader_template t;
    setup->font = fonts[chance(m, 2)];
    setup->size_px = 9 + chance(m, 12);
    setup->width_px = 200 + chance(m, chance(m, 2) ? 900 : 3800);
    setup->height_px = 200 + chance(m, 1000);
    setup->align = chance(m, 2) ? FONT_ALIGN_JUSTIFY : FONT_ALIGN_START;
    setup->beside = (struct reader_beside){0};
    setup->stage_strip_px = chance(m, 3) ? STRIP_PX : 0;
    if (chance(m, 2))
        setup->beside =
            (struct reader_beside){chance(m, 2) ? READER_SIDE_LEFT : READER_SIDE_RIGHT,
                                   20 + chance(m, 40), false, false};
    assert_int_equal(reader_template_named(reader_template_names[chance(m, 3)], &t), READER_OK);
    reader_template_grid(&t, setup->width_px, setup->size_px, false, &setup->grid);
    if (chance(m, 3) == 0)
        setup->grid = (struct reader_grid){0};
}

static size_t word_by_chance(struct made *m, const struct reader_document *d)
{
    const size_t at = sample_word(&m->state) % (d->plain_bytes + 1);
    const char *word = strchr(d->plain + at, 'q');
    return word ? (size_t)(word - d->plain) : 0;
}

/* A few letters are typed before a word, or the word goes, where that can be told. */
static void edit_by_chance(struct made *m, struct reader_edit *edit, struct reader_document **d,
                           struct reader_view **view, const struct reader_pages_setup *setup,
                           struct around *around)
{
    struct reader_edit_change change;
    const size_t at = word_by_chance(m, *d);
    const char *typed = chance(m, 2) ? "and more of the same " : "a";
    const enum reader_status status =
        chance(m, 3) ? reader_edit_insert(edit, at, at, typed, strlen(typed), &change)
                     : reader_edit_delete(edit, at, at + WORD, &change);
    if (status != READER_OK)
        return;
    if (change.before) {
        around->count = 0;
        reader_view_destroy(*view);
        assert_int_equal(reader_view_create(*d, setup, view), READER_OK);
        assert_int_equal(reader_view_go(*view, at, 50), READER_OK);
    } else {
        for (int i = 0; i < change.moves_count; i++)
            assert_int_equal(reader_view_edited(*view, change.block, change.moves[i].at,
                                                change.moves[i].removed,
                                                change.moves[i].inserted),
                             READER_OK);
    }
    reader_edit_change_finish(&change);
}

static void turns(struct made *m, struct reader_document **d, struct reader_edit *edit)
{
    struct reader_pages_setup setup = reader_pages_setup_default();
    struct reader_view *view;
    struct around around = {.count = 0};
    setup.picture = picture;
    setup_chance(m, &setup);
    assert_int_equal(reader_view_create(*d, &setup, &view), READER_OK);
    for (int turn = 0; turn < 12; turn++) {
        size_t before, after;
        const char *when = "scrolled";
        const int what = chance(m, 5);
        if (what == 0) {
            assert_int_equal(reader_view_top(view, &before), READER_OK);
            around.count = 0; /* columns may be narrower */
            assert_int_equal(reader_view_around(view, NULL, 0), READER_OK);
            setup_chance(m, &setup);
            assert_int_equal(reader_view_set(view, &setup), READER_OK);
            assert_int_equal(reader_view_top(view, &after), READER_OK);
            assert_int_equal(before, after); /* the line that is read stays */
            when = "set anew";
        } else if (what == 1) {
            reader_view_scroll(view, chance(m, 2000) - 1000);
        } else if (what == 2) {
            assert_int_equal(reader_view_go(view, word_by_chance(m, *d), chance(m, 200)),
                             READER_OK);
            when = "led to a word";
        } else if (what == 3) {
            around_chance(m, *d, view, &setup, &around);
            when = "around ink";
        } else {
            edit_by_chance(m, edit, d, &view, &setup, &around);
            when = "edited";
        }
        as_from_scratch(*d, &setup, view, m->shaped, &around, when);
    }
    reader_view_destroy(view);
}

static void text_flows_around_figures(void **state)
{
    (void)state;
    const char *asked = getenv("READER_TEST_BESIDE");
    const int documents = asked ? atoi(asked) : 24;
    for (int i = 1; i <= documents; i++) {
        struct made m = {.shaped = i % 3 == 0};
        m.state = seed_now = (unsigned long long)i * 0x9e3779b97f4a7c15u;
        struct reader_files files = {.keep = true};
        struct reader_document *d;
        struct reader_edit *edit;
        char *text = document_text(&m);
        assert_int_equal(reader_document_create(&d), READER_OK);
        assert_int_equal(reader_files_add(&files, d, "one.md", text, strlen(text)), READER_OK);
        assert_int_equal(reader_document_refer(d), READER_OK);
        assert_int_equal(reader_document_plain(d), READER_OK);
        assert_int_equal(reader_edit_create(&d, &files, NULL, &edit), READER_OK);
        turns(&m, &d, edit);
        reader_edit_destroy(edit);
        reader_document_destroy(d);
        reader_files_finish(&files);
        free(text);
    }
}

/* ---- one of each ---- */

static struct reader_document *read_text(const char *text)
{
    struct reader_document *d;
    assert_int_equal(reader_document_create(&d), READER_OK);
    assert_int_equal(reader_document_add(d, text, strlen(text)), READER_OK);
    assert_int_equal(reader_document_refer(d), READER_OK);
    assert_int_equal(reader_document_plain(d), READER_OK);
    return d;
}

/* What a title says, and what says something else. */
static void titles_are_read(void **state)
{
    (void)state;
    static const struct {
        const char *title;
        struct reader_beside wanted;
    } cases[] = {{"left", {READER_SIDE_LEFT, 0, false, false}},
                 {" right  35% ", {READER_SIDE_RIGHT, 35, false, false}},
                 {"round left 20%", {READER_SIDE_LEFT, 20, true, false}},
                 {"right shape", {READER_SIDE_RIGHT, 0, false, true}},
                 {"full", {READER_SIDE_NONE, 0, false, false}},
                 {"", {0}},
                 {"40%", {0}},
                 {"left right", {0}},
                 {"left 5%", {0}},
                 {"left 40% 50%", {0}},
                 {"full 40%", {0}},
                 {"left round shape", {0}},
                 {"leftish", {0}},
                 {"The left bank", {0}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reader_beside read;
        reader_beside_read(cases[i].title, &read);
        if (read.side != cases[i].wanted.side || read.percent != cases[i].wanted.percent ||
            read.round != cases[i].wanted.round || read.shape != cases[i].wanted.shape)
            fail_msg("'%s' is read as %d %d%%", cases[i].title, read.side, read.percent);
    }
}

static void words_put(char *text, const char *before, int count)
{
    strcat(text, before);
    for (int i = 0; i < count; i++)
        strcat(text, "qbcdfghj ");
    strcat(text, "\n\n");
}

/* At the left, at the right, and where a line beside it has no room, over its text. */
static void a_figure_takes_its_side(void **state)
{
    (void)state;
    static struct window w;
    for (int side = 0; side < 3; side++) {
        char text[4000] = "";
        struct reader_pages_setup setup = reader_pages_setup_default();
        struct reader_view *view;
        strcat(text, side ? "![](p200x200.png \"right 50%\")\n\n"
                          : "![](p200x200.png \"left 50%\")\n\n");
        words_put(text, "", 90);
        struct reader_document *d = read_text(text);
        setup.picture = picture;
        setup.width_px = side == 2 ? 240 : 700;
        setup.margin_px = 20;
        assert_int_equal(reader_view_create(d, &setup, &view), READER_OK);
        window_see(d, view, &w);
        assert_int_equal(w.pictures_count, 1);
        const struct page_box *p = &w.pictures[0];
        int beside = 0;
        for (int i = 0; i < w.words_count; i++) {
            const struct reader_box *b = &w.words[i].at;
            beside += b->y > p->y && b->y + b->height < p->y + p->height;
        }
        assert_true(side == 2 ? beside == 0 : beside > 10);
        if (side < 2)
            assert_true(fabs(p->x - (side ? 480 : 20)) < 1);
        reader_view_destroy(view);
        reader_document_destroy(d);
    }
}

/* Lines beside a triangle become shorter downwards, those beside its box do not. */
static void lines_follow_a_shape(void **state)
{
    (void)state;
    static struct window w;
    for (int shaped = 0; shaped < 2; shaped++) {
        char text[4000] = "";
        struct reader_pages_setup setup = reader_pages_setup_default();
        struct reader_view *view;
        strcat(text, shaped ? "![](p300x300.png \"left shape\")\n\n"
                            : "![](p300x300.png \"left\")\n\n");
        words_put(text, "", 120);
        struct reader_document *d = read_text(text);
        setup.picture = picture;
        setup.width_px = 800;
        setup.align = FONT_ALIGN_START;
        assert_int_equal(reader_view_create(d, &setup, &view), READER_OK);
        window_see(d, view, &w);
        double first = 1e9, last = 0, low = w.pictures[0].y + w.pictures[0].height - 30;
        for (int i = 0; i < w.words_count; i++) {
            const struct reader_box *b = &w.words[i].at;
            if (b->y < w.pictures[0].y + 30)
                first = fmin(first, b->x);
            if (b->y < low && b->y > low - 30)
                last = last > 0 ? fmin(last, b->x) : b->x;
        }
        assert_true(shaped ? last > first + 100 : fabs(last - first) < 2);
        reader_view_destroy(view);
        reader_document_destroy(d);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(titles_are_read),
        cmocka_unit_test(a_figure_takes_its_side),
        cmocka_unit_test(lines_follow_a_shape),
        cmocka_unit_test(text_flows_around_figures),
    };
    if (without_library())
        return 77;
    setlocale(LC_CTYPE, "C.UTF-8");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
