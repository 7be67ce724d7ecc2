/* test_leading.c - letters that another face lends have the room that their own face asks for,
 * in lines of type and on pages. What is compared are the faces' boxes, from ascent to descent,
 * of lines that follow each other. */
#include "support.h"

#include <page.h>

#include <math.h>
#include <string.h>

/* a leading of an em, without Hebrew; DejaVu, which lends it, asks for 1.16 */
#define FIRST "EBGaramond12-Regular"
enum { SIZE = 40 };

static const char hebrew[] = "\xd7\x9c\xd7\xa7\xd7\xa9";
static const char tibetan[] =
    "\xe0\xbd\x96\xe0\xbd\xa6\xe0\xbe\x92\xe0\xbe\xb2\xe0\xbd\xb4\xe0\xbd\x96";
static const char khmer[] =
    "\xe1\x9e\x9f\xe1\x9f\x92\xe1\x9e\x9a\xe1\x9f\x92\xe1\x9e\x8f\xe1\x9e\xb8";

/* How far up and down a line's faces reach from its baseline, and where that is. */
struct reach {
    double y, up, down;
    bool others; /* a face that is not the first */
};

static int reaches_find(const struct font_layout *l, struct reach *out, int most)
{
    int count = 0;
    for (int i = 0; i < l->glyphs_count; i++) {
        const struct font_placed *g = &l->glyphs[i];
        struct font_face_info info;
        if (i == 0 || g->line != g[-1].line) {
            assert_true(count < most);
            out[count++] = (struct reach){.y = g->y_px};
        }
        font_face_describe(g->face, &info);
        struct reach *r = &out[count - 1];
        r->up = fmax(r->up, info.ascender * SIZE / info.units_per_em);
        r->down = fmax(r->down, -info.descender * SIZE / info.units_per_em);
        r->others = r->others || strncmp(info.family, "EB Garamond", 11) != 0;
    }
    return count;
}

/* Lines never reach into each other, and at least one pair is farther apart than is usual.
 * by_line: those of the first face alone are not. */
static void reaches_check(const struct reach *r, int count, double usual, bool by_line)
{
    int farther = 0;
    for (int i = 1; i < count; i++) {
        double apart = r[i].y - r[i - 1].y;
        if (apart < r[i - 1].down + r[i].up - 1e-3)
            fail_msg("line %d is %.2f below the last, which reaches %.2f down, it %.2f up", i,
                     apart, r[i - 1].down, r[i].up);
        assert_true(apart > usual - 1e-3);
        if (by_line && !r[i].others && !r[i - 1].others)
            assert_true(fabs(apart - usual) < 1e-3);
        farther += apart > usual + 0.5;
    }
    assert_true(farther > 0);
}

static void lines_of_type_have_their_faces_room(void **state)
{
    (void)state;
    struct font_face *face = face_open(FIRST);
    struct font_shaper *shaper = shaper_make(face);
    const char *const lent[] = {hebrew, tibetan, khmer};
    for (int i = 0; i < 3; i++) {
        char text[200];
        struct font_layout l;
        struct reach r[8];
        snprintf(text, sizeof text, "paper\nand ink\n%s\n%s\nwater\nbrush", lent[i], lent[i]);
        assert_font(font_shaper_layout(shaper, text, strlen(text), SIZE, NULL, &l));
        int count = reaches_find(&l, r, 8);
        if (l.missing_count) {
            print_message("no font has line %d's letters: skipped\n", i);
            assert_true(i > 0); /* Hebrew is in what ./run installs */
        } else {
            assert_int_equal(count, 6);
            reaches_check(r, count, l.line_height_px, true);
            assert_true(fabs(l.height_px - r[5].y) < 1e-3 &&
                        fabs(l.lines[5].y_px - r[5].y) < 1e-3);
        }
        font_layout_finish(&l);
        /* What is asked for is what there is. */
        struct font_text_options asked = {.line_height = 0.9};
        assert_font(font_shaper_layout(shaper, text, strlen(text), SIZE, &asked, &l));
        for (int k = 0; k < l.lines_count; k++)
            assert_true(fabs(l.lines[k].y_px - 0.9 * SIZE * k) < 1e-9);
        font_layout_finish(&l);
    }
    font_shaper_destroy(shaper);
    font_face_close(face);
}

/* A page of three paragraphs, the middle one with lent letters, which a later edit takes
 * out. */
static void paragraphs_have_their_faces_room(void **state)
{
    (void)state;
    struct page_template page = {.width_px = 500, .height_px = 900, .frames_count = 1};
    struct page_style style = page_style_default();
    struct page_text *text;
    struct font_layout l = {0};
    struct reach r[16];
    char middle[300];
    int id, style_id, ids[3];
    page.frames[0] = (struct page_frame){.x = 20, .y = 20, .width = 300, .height = 860};
    snprintf(middle, sizeof middle,
             "The word %s stands in a line of its own or within one, and %s", hebrew, hebrew);
    const char *const texts[] = {"One line and another one, and one more than those.", middle,
                                 "The last of the paragraphs, which has two lines, or three."};
    assert_font(page_text_create(&text));
    style.font = FIRST;
    style.size_px = SIZE;
    assert_font(page_style_add(text, &style, &style_id));
    assert_font(page_templates_set(text, &page, 1));
    struct page_manner manner = page_manner_default();
    manner.leading_px = 0;
    for (int i = 0; i < 3; i++)
        assert_font(page_paragraph_add(text, 0, -1, texts[i], strlen(texts[i]), style_id,
                                       &manner, &ids[i]));
    assert_font(page_layout(text, 0, &l));
    int count = reaches_find(&l, r, 16);
    assert_true(count >= 7);
    reaches_check(r, count, SIZE, false);
    double last = r[count - 1].y;
    font_layout_finish(&l);
    /* Without them all lines are an em apart again. */
    assert_font(page_paragraph_remove(text, ids[1]));
    assert_font(page_paragraph_add(text, 0, 1, "The word stands in a line of its own, or two.",
                                   45, style_id, &manner, &id));
    assert_font(page_layout(text, 0, &l));
    count = reaches_find(&l, r, 16);
    for (int i = 1; i < count; i++)
        assert_true(!r[i].others && fabs(r[i].y - r[i - 1].y - SIZE) < 1e-3);
    assert_true(r[count - 1].y < last);
    font_layout_finish(&l);
    page_text_destroy(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_of_type_have_their_faces_room),
        cmocka_unit_test(paragraphs_have_their_faces_room),
    };
    return cmocka_run_group_tests_name("leading", tests, NULL, NULL);
}
