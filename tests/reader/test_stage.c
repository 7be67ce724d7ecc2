/* test_stage.c - stages of scripts that text flows around. */
#include <reader_view.h>

/* clang-format off */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
/* clang-format on */

#include <math.h>
#include <string.h>

#include "without_library.h"

/* Text flows around a stage that says so, its own text too, where both have room; in a narrow
 * column it has the column. */
static void stages_stand_beside_text(void **state)
{
    (void)state;
    char text[3000] = "```lua live 240x100 right 45%\nshort\n```\n\nThe first ";
    for (int i = 0; i < 60; i++)
        strcat(text, "words that follow ");
    strcat(text,
           "last.\n\n```lua live 200x80 left\na line of code that is too long to have room "
           "beside its own stage in here\n```\n\nAnother one.\n");
    struct reader_document *d;
    struct reader_pages_setup setup = reader_pages_setup_default();
    assert_int_equal(reader_document_create(&d), READER_OK);
    assert_int_equal(reader_document_add(d, text, strlen(text)), READER_OK);
    assert_int_equal(reader_document_plain(d), READER_OK);
    setup.font = "DejaVuSerif";
    setup.size_px = 12;
    setup.stage_strip_px = 30;
    setup.height_px = 3000;
    setup.margin_px = 20;
    for (int wide = 0; wide < 2; wide++) {
        struct reader_stage stage[2];
        struct reader_box code, first, long_code;
        int stages = 0, count;
        setup.width_px = wide ? 700 : 200;
        struct reader_view *view;
        const struct reader_shown *shown;
        assert_int_equal(reader_view_create(d, &setup, &view), READER_OK);
        assert_int_equal(reader_view_look(view, &shown, &count), READER_OK);
        for (int i = 0; i < count; i++)
            for (int k = 0; stages < 2 && reader_view_stage(view, &shown[i], k, &stage[stages]);
                 k++)
                stages++;
        assert_int_equal(stages, 2);
        const size_t begin = d->blocks[1].at;
        assert_true(
            reader_view_boxes(view, d->blocks[0].at, d->blocks[0].at + 5, &code, 1) &&
            reader_view_boxes(view, begin, begin + 9, &first, 1) &&
            reader_view_boxes(view, d->blocks[2].at, d->blocks[2].at + 5, &long_code, 1));
        const double end = stage[0].y + stage[0].height + 30;
        if (wide) {
            assert_true(fabs(stage[0].x + stage[0].width - 680) <= 1 && stage[0].width == 240);
            assert_true(fabs(stage[0].right - 680) <= 1);
            assert_true(code.y < end && first.y < end && code.x + code.width < stage[0].x);
            assert_true(stage[1].x <= 21 && long_code.y < stage[1].y);
        } else {
            assert_true(code.y >= end - 1 && stage[0].x <= 21);
        }
        reader_view_destroy(view);
    }
    reader_document_destroy(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(stages_stand_beside_text)};
    return without_library() ? 77 : cmocka_run_group_tests(tests, NULL, NULL);
}
