/* test_paper.c - the sheet in Paris and the same rule in plain C give the same bits, on tori
 * and other sheets, with all forces. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "harness.h"
#include "paper_scene.h"

/* Washes are squares of 48 fibers, every third dry: there are several of each. */
enum { WIDTH = 162, HEIGHT = 101, PIGMENTS = 2 };

static void check(bool ok)
{
    if (!ok)
        fail_msg("%s", bench_error());
}

static void run(struct paper_scene *s, int steps_count)
{
    for (int i = 0; i < steps_count; i++) {
        assert_int_equal(paper_sheet_step(s->sheet), PAPER_OK);
        assert_int_equal(paper_sheet_finish(s->sheet), PAPER_OK);
    }
}

static struct paper_air air_that_pulls(void)
{
    struct paper_air air = paper_air_default();
    air.gravity[0] = 0.3;
    air.gravity[1] = -0.2;
    air.seep[0] = -0.1;
    air.seep[1] = 0.25;
    air.humidity = 0.003;
    return air;
}

/* Torus or not is a matter of the faces' values, so both have the same kernels. */
static void steps_agree_with_openmp(void **state)
{
    (void)state;
    struct paper_air air = air_that_pulls();
    for (int torus = 0; torus < 2; torus++) {
        struct paper_scene s;
        check(paper_scene_init(&s, WIDTH, HEIGHT, PIGMENTS, torus, &air));
        run(&s, 21);
        paper_openmp_steps(s.peer, 10);
        paper_openmp_steps(s.peer, 11);
        check(paper_scene_agrees(&s, torus ? "torus" : "sheet"));
        paper_scene_finish(&s);
    }
}

static void thesis_agrees_with_openmp(void **state)
{
    (void)state;
    struct paper_scene s;
    check(paper_scene_init_thesis(&s, WIDTH, HEIGHT));
    run(&s, 20);
    diffusion_openmp_steps(s.thesis, 20);
    check(paper_scene_agrees(&s, "thesis"));
    /* checks that the comparison finds a difference */
    run(&s, 1);
    assert_false(paper_scene_agrees(&s, "thesis"));
    paper_scene_finish(&s);
}

static void peer_takes_no_narrow_sheet(void **state)
{
    (void)state;
    struct paper_peer_config config = {.width = 32, .height = 16, .air = paper_air_default()};
    config.width = 15;
    assert_null(paper_openmp_create(&config));
    assert_non_null(strstr(bench_error(), "16x3 and more (got 15x16)"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steps_agree_with_openmp),
        cmocka_unit_test(thesis_agrees_with_openmp),
        cmocka_unit_test(peer_takes_no_narrow_sheet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
