/* test_atlas.c - glyphs packed into pages: their pictures are right, do not overlap and stay
 * within bounds. The glyph that was used longest ago is evicted first. */
#include "support.h"

#include <atlas.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 256 };

struct fixture {
    struct font_face *face;
    struct font_filter *filter;
    struct font_atlas *atlas;
    double units;
};

static void begin(struct fixture *f, int pages_max)
{
    struct font_atlas_def def = font_atlas_def_default();
    struct font_face_info info;
    def.width_px = def.height_px = SIDE;
    def.pages_max = pages_max;
    def.places_x = 4;
    def.places_y = 2;
    f->face = face_open("DejaVuSans");
    f->filter = filter_make("gaussian-fast");
    font_face_describe(f->face, &info);
    f->units = info.units_per_em;
    assert_font(font_atlas_create(&def, &f->atlas));
}

static void end(struct fixture *f)
{
    font_atlas_destroy(f->atlas);
    font_filter_destroy(f->filter);
    font_face_close(f->face);
}

/* The page holds the same picture of the glyph as drawing it alone gives, with blank pixels on
 * its right and below it. */
static void slot_check(const struct fixture *f, const struct font_atlas_slot *slot,
                       uint32_t glyph, double size, double x, double y)
{
    struct font_outline outline;
    struct font_edges edges = {0};
    struct font_gray gray = {0};
    struct font_map map = font_map_size(size, f->units);
    double px = floor(x * 4 + 0.5) / 4, py = floor(y * 2 + 0.5) / 2;
    assert_font(font_face_outline(f->face, glyph, &outline));
    assert_font(font_edges_build(&edges, &outline, &map, f->filter));
    assert_font(font_gray_draw(&gray, &edges, f->filter, px - floor(px), py - floor(py)));
    assert_int_equal(slot->width_px, gray.width_px);
    assert_int_equal(slot->height_px, gray.height_px);
    if (gray.width_px) {
        assert_int_equal(slot->left_px, gray.left_px + (int)floor(px));
        assert_int_equal(slot->top_px, gray.top_px + (int)floor(py));
        assert_true(slot->x >= 0 && slot->x + slot->width_px <= SIDE && slot->y >= 0 &&
                    slot->y + slot->height_px < SIDE + 1);
    }
    const uint8_t *pixels = font_atlas_pixels(f->atlas, slot->page);
    for (int r = 0; r <= gray.height_px && gray.width_px; r++)
        for (int c = 0; c <= gray.width_px; c++) {
            int at_x = slot->x + c, at_y = slot->y + r;
            if (at_x >= SIDE || at_y >= SIDE)
                continue;
            int want =
                c < gray.width_px && r < gray.height_px ? gray.pixels[r * gray.pitch + c] : 0;
            if (pixels[at_y * SIDE + at_x] != want)
                fail_msg("glyph %u at %g: (%d, %d) is %d for %d", glyph, size, c, r,
                         pixels[at_y * SIDE + at_x], want);
        }
    font_gray_finish(&gray);
    font_edges_finish(&edges);
    font_outline_finish(&outline);
}

static void glyphs_are_kept_by_place(void **state)
{
    (void)state;
    struct fixture f;
    struct font_atlas_slot a, b, c, d;
    struct font_atlas_stats stats;
    begin(&f, 1);
    uint32_t glyph = font_face_glyph(f.face, 'g');
    font_atlas_begin(f.atlas);
    assert_font(font_atlas_get(f.atlas, f.face, glyph, 20.5, NULL, 10.3, 7.1, &a));
    assert_font(font_atlas_get(f.atlas, f.face, glyph, 20.5, NULL, -3.7, 12.2, &b));
    assert_font(font_atlas_get(f.atlas, f.face, glyph, 20.5, NULL, 10.5, 7, &c));
    assert_font(font_atlas_get(f.atlas, f.face, glyph, 20.25, NULL, 10.3, 7, &d));
    assert_true(a.x == b.x && a.y == b.y && a.left_px - b.left_px == 14 &&
                b.top_px - a.top_px == 5);
    assert_true(c.x != a.x && d.x != a.x && d.x != c.x);
    slot_check(&f, &a, glyph, 20.5, 10.3, 7.1);
    slot_check(&f, &b, glyph, 20.5, -3.7, 12.2);
    slot_check(&f, &c, glyph, 20.5, 10.5, 7);
    slot_check(&f, &d, glyph, 20.25, 10.3, 7);
    font_atlas_stats_get(f.atlas, &stats);
    assert_true(stats.hits == 1 && stats.drawn == 3 && stats.glyphs_count == 3);
    /* A space has no ink, and takes no room. */
    assert_font(
        font_atlas_get(f.atlas, f.face, font_face_glyph(f.face, ' '), 20, NULL, 0, 0, &d));
    assert_int_equal(d.width_px, 0);
    assert_font(
        font_atlas_get(f.atlas, f.face, font_face_glyph(f.face, ' '), 20, NULL, 0, 0, &d));
    font_atlas_stats_get(f.atlas, &stats);
    assert_int_equal(stats.hits, 2);
    end(&f);
}

static void what_is_new_is_said(void **state)
{
    (void)state;
    struct fixture f;
    struct font_atlas_slot slot;
    struct font_atlas_box box;
    begin(&f, 1);
    assert_false(font_atlas_dirty(f.atlas, 0, &box));
    for (uint32_t c = 'a'; c <= 'c'; c++) {
        assert_font(
            font_atlas_get(f.atlas, f.face, font_face_glyph(f.face, c), 30, NULL, 0, 0, &slot));
        assert_true(font_atlas_dirty(f.atlas, slot.page, &box));
        assert_true(box.x <= slot.x && box.y <= slot.y &&
                    box.x + box.width >= slot.x + slot.width_px &&
                    box.y + box.height >= slot.y + slot.height_px && box.width < 60);
        assert_false(font_atlas_dirty(f.atlas, slot.page, &box));
    }
    assert_font(
        font_atlas_get(f.atlas, f.face, font_face_glyph(f.face, 'a'), 30, NULL, 0, 0, &slot));
    assert_false(font_atlas_dirty(f.atlas, slot.page, &box));
    assert_false(font_atlas_dirty(f.atlas, 7, &box));
    end(&f);
}

/* Draws far more glyphs than there is room for, of many sizes, a few in each frame. At a
 * frame's end all its glyphs are in the pages, correct and without overlaps, and there are not
 * too many pages. */
static void frames_keep_what_they_asked_for(void **state)
{
    (void)state;
    enum { FRAMES = 150, ASKED_MAX = 24 };
    struct fixture f;
    struct font_atlas_stats stats;
    uint32_t seed = 77;
    long full = 0;
    begin(&f, 2);
    for (int frame = 0; frame < FRAMES; frame++) {
        struct {
            struct font_atlas_slot slot;
            uint32_t glyph;
            double size, x, y;
        } asked[ASKED_MAX];
        int count = 0;
        static uint8_t owner[2][SIDE][SIDE];
        memset(owner, 0, sizeof owner);
        font_atlas_begin(f.atlas);
        while (count < ASKED_MAX) {
            uint32_t letter = 33 + (uint32_t)(random_unit(&seed) * 94);
            asked[count].glyph = font_face_glyph(f.face, letter);
            asked[count].size = floor(8 + 60 * random_unit(&seed) * random_unit(&seed));
            asked[count].x = 50 * random_unit(&seed);
            asked[count].y = 50 * random_unit(&seed);
            enum font_status status =
                font_atlas_get(f.atlas, f.face, asked[count].glyph, asked[count].size, NULL,
                               asked[count].x, asked[count].y, &asked[count].slot);
            if (status == FONT_FULL) {
                full++;
                break;
            }
            assert_font(status);
            count++;
        }
        assert_true(count > 5);
        assert_true(font_atlas_pages(f.atlas) <= 2);
        for (int i = 0; i < count; i++) {
            const struct font_atlas_slot *s = &asked[i].slot;
            slot_check(&f, s, asked[i].glyph, asked[i].size, asked[i].x, asked[i].y);
            for (int k = 0; k < i; k++) /* the same glyph twice is one slot */
                if (asked[k].slot.page == s->page && asked[k].slot.x == s->x &&
                    asked[k].slot.y == s->y)
                    goto next;
            for (int r = s->y; r < s->y + s->height_px; r++)
                for (int c = s->x; c < s->x + s->width_px; c++) {
                    assert_int_equal(owner[s->page][r][c], 0);
                    owner[s->page][r][c] = 1;
                }
        next:;
        }
    }
    font_atlas_stats_get(f.atlas, &stats);
    assert_true(stats.shelves_emptied > 20 && stats.bytes == 2 * SIDE * SIDE);
    print_message("%ld drawn, %ld found; %ld shelves emptied; %ld times full\n", stats.drawn,
                  stats.hits, stats.shelves_emptied, full);
    end(&f);
}

static void what_is_used_stays(void **state)
{
    (void)state;
    struct fixture f;
    struct font_atlas_slot slot, first;
    begin(&f, 1);
    uint32_t kept = font_face_glyph(f.face, '@');
    font_atlas_begin(f.atlas);
    assert_font(font_atlas_get(f.atlas, f.face, kept, 24, NULL, 0, 0, &first));
    /* A glyph that is used in each frame is never drawn again, whichever other glyphs come and
     * go. */
    for (int frame = 0; frame < 60; frame++) {
        font_atlas_begin(f.atlas);
        assert_font(font_atlas_get(f.atlas, f.face, kept, 24, NULL, 0, 0, &slot));
        assert_true(slot.x == first.x && slot.y == first.y);
        for (int i = 0; i < 20; i++)
            assert_font(font_atlas_get(f.atlas, f.face,
                                       font_face_glyph(f.face, 33 + (uint32_t)(frame + i)),
                                       20 + frame % 7, NULL, 0.25 * (frame % 4), 0, &slot));
    }
    slot_check(&f, &first, kept, 24, 0, 0);
    /* When the frame uses all room, the atlas returns an error and keeps the frame's glyphs. */
    font_atlas_begin(f.atlas);
    enum font_status status = FONT_OK;
    for (int i = 0; i < 200 && status == FONT_OK; i++)
        status = font_atlas_get(f.atlas, f.face, font_face_glyph(f.face, 'W'), 40 + i * 0.25,
                                NULL, 0, 0, &slot);
    assert_int_equal(status, FONT_FULL);
    font_atlas_begin(f.atlas);
    assert_font(
        font_atlas_get(f.atlas, f.face, font_face_glyph(f.face, 'W'), 90, NULL, 0, 0, &slot));
    slot_check(&f, &slot, font_face_glyph(f.face, 'W'), 90, 0, 0);
    end(&f);
}

/* The quads with the pages' pictures give the same coverage as drawing the layout. */
static void layouts_become_quads(void **state)
{
    (void)state;
    enum { WIDTH = 200, HEIGHT = 60, QUADS = 5 };
    static const char text[] = "Quads, by fives";
    struct fixture f;
    struct font_shaper *shaper;
    struct font_layout layout;
    struct font_painter *painter;
    static uint8_t cover[WIDTH * HEIGHT], made[WIDTH * HEIGHT];
    begin(&f, 1);
    assert_font(font_shaper_create(f.face, &shaper));
    assert_font(font_shaper_layout(shaper, text, strlen(text), 21, NULL, &layout));
    for (int i = 0; i < layout.glyphs_count; i++) /* on the atlas's places */
        layout.glyphs[i].x_px = floor(layout.glyphs[i].x_px * 4) / 4;
    struct font_painter_def def = font_painter_def_default();
    assert_font(font_painter_create(&def, &painter));
    struct font_cover to = {WIDTH, HEIGHT, WIDTH, cover};
    assert_font(font_painter_cover(painter, &layout, NULL, 8.25, 35.5, &to));
    int first = 0, total = 0, count;
    font_atlas_begin(f.atlas);
    while (first < layout.glyphs_count) {
        struct font_quad quads[QUADS];
        assert_font(font_atlas_layout(f.atlas, &layout, NULL, 8.25, 35.5, quads, QUADS, &first,
                                      &count));
        for (int i = 0; i < count; i++) {
            const struct font_quad *q = &quads[i];
            const uint8_t *page = font_atlas_pixels(f.atlas, q->page);
            int u = (int)lrintf(q->u0 * SIDE), v = (int)lrintf(q->v0 * SIDE);
            assert_true(lrintf((q->u1 - q->u0) * SIDE) == lrintf(q->x1 - q->x0));
            for (int y = (int)q->y0; y < (int)q->y1; y++)
                for (int x = (int)q->x0; x < (int)q->x1; x++) {
                    int here = page[(v + y - (int)q->y0) * SIDE + u + x - (int)q->x0];
                    uint8_t *at = &made[y * WIDTH + x];
                    *at = (uint8_t)(*at + ((255 - *at) * here + 127) / 255);
                }
        }
        total += count;
    }
    assert_int_equal(total,
                     12); /* the letters (fi is one) and the comma; spaces have no quad */
    assert_memory_equal(cover, made, sizeof cover);
    font_painter_destroy(painter);
    font_layout_finish(&layout);
    font_shaper_destroy(shaper);
    end(&f);
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    struct fixture f;
    struct font_atlas_slot slot;
    struct font_atlas *none;
    begin(&f, 1);
    uint32_t glyph = font_face_glyph(f.face, 'M');
    assert_int_equal(font_atlas_get(f.atlas, f.face, glyph, 2000, NULL, 0, 0, &slot),
                     FONT_TOO_LARGE);
    static const double sizes[] = {0, -1, NAN, INFINITY};
    for (int i = 0; i < 4; i++)
        assert_int_equal(font_atlas_get(f.atlas, f.face, glyph, sizes[i], NULL, 0, 0, &slot),
                         FONT_BAD_ARGUMENT);
    assert_int_equal(font_atlas_get(f.atlas, f.face, glyph, 20, NULL, NAN, 0, &slot),
                     FONT_BAD_ARGUMENT);
    assert_int_equal(font_atlas_get(f.atlas, f.face, 1 << 20, 20, NULL, 0, 0, &slot),
                     FONT_NO_GLYPH);
    struct font_map map = {.kind = FONT_PROJECTIVE};
    assert_int_equal(font_atlas_get(f.atlas, f.face, glyph, 20, &map, 0, 0, &slot),
                     FONT_BAD_ARGUMENT);
    static const struct font_atlas_def wrong[] = {{.width_px = 10},  {.height_px = 1 << 20},
                                                  {.pages_max = -1}, {.places_x = 257},
                                                  {.places_y = -2},  {.filter = "soft"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct font_atlas_def def = font_atlas_def_default();
        def.width_px = wrong[i].width_px ? wrong[i].width_px : def.width_px;
        def.height_px = wrong[i].height_px ? wrong[i].height_px : def.height_px;
        def.pages_max = wrong[i].pages_max ? wrong[i].pages_max : def.pages_max;
        def.places_x = wrong[i].places_x ? wrong[i].places_x : def.places_x;
        def.places_y = wrong[i].places_y ? wrong[i].places_y : def.places_y;
        def.filter = wrong[i].filter ? wrong[i].filter : def.filter;
        assert_int_equal(font_atlas_create(&def, &none), FONT_BAD_ARGUMENT);
        assert_null(none);
    }
    /* A turned glyph has its own slot. */
    struct font_map turned = font_map_rotation(30);
    struct font_atlas_slot upright;
    assert_font(font_atlas_get(f.atlas, f.face, glyph, 20, NULL, 0, 0, &upright));
    assert_font(font_atlas_get(f.atlas, f.face, glyph, 20, &turned, 0, 0, &slot));
    assert_true((slot.x != upright.x || slot.y != upright.y) &&
                slot.height_px > upright.height_px);
    end(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(glyphs_are_kept_by_place),
        cmocka_unit_test(what_is_new_is_said),
        cmocka_unit_test(frames_keep_what_they_asked_for),
        cmocka_unit_test(what_is_used_stays),
        cmocka_unit_test(layouts_become_quads),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
