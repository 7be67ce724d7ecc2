/* test_paper.c - a demonstration whose picture is a sheet of paper: it is wetted where the
 * pointer is, and dries. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "shown.h"

enum { WIDTH = 96, HEIGHT = 64 };

static int light_at(const struct demonstration *d, int x, int y)
{
    const uint8_t *p = shown_pixel(d, WIDTH, x, y);
    return p[0] + p[1] + p[2];
}

static void a_sheet_is_wetted(void **state)
{
    (void)state;
    static const char script[] =
        "local p = paper{width = stage.width, height = stage.height,\n"
        "                pigments = {'french ultramarine'}, history = false}\n"
        "function step() p:step(1) end\n"
        "function draw() return p end\n"
        "function pointer(what, x, y)\n"
        "  if what == 'down' then\n"
        "    p:put(circle(x, y, 10), {water = 0.3, ['french ultramarine'] = 1})\n"
        "  end\n"
        "end\n";
    struct demonstration_def def =
        demonstration_def_default(script, strlen(script), WIDTH, HEIGHT);
    struct demonstration *d;
    def.answer_s = def.patience_s = 200; /* kernels may have to be compiled */
    if (!demonstration_start(&def, &d))
        fail_msg("%s", demonstration_error());
    if (!shown_wait(d, 2))
        fail_msg("%s", demonstration_ended(d));
    const int paper = light_at(d, 30, 30), corner = light_at(d, 90, 5);
    assert_true(paper > 500 && corner > 500); /* white paper */
    demonstration_pointer(d, DEMONSTRATION_DOWN, 30, 30, 1);
    if (!shown_wait(d, 3))
        fail_msg("%s", demonstration_ended(d));
    assert_true(light_at(d, 30, 30) < paper - 100);
    assert_true(light_at(d, 90, 5) > corner - 20);
    demonstration_stop(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_sheet_is_wetted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
