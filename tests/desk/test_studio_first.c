/* test_studio_first.c - the first stroke where no cache has a kernel: none is compiled while
 * the hand waits. Until a process has compiled them, plans run as byte code. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "paris_internal.h"
#include "studio_scene.h"

#include <picture.h>

enum { SIDE = 160, POINTS = 12, STROKES = 3, STEPS = 20 };

static char folder[] = "/tmp/lutetia-first-XXXXXX";

#define good(call) assert_int_equal(call, PAPER_OK)

static int folder_make(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    setenv("XDG_CACHE_HOME", folder, 1);
    setenv("POCL_CACHE_DIR", folder, 1);
    /* as users have it, but for kernels that are wanted sooner */
    unsetenv("LUTETIA_BACKGROUND");
    unsetenv("LUTETIA_INTERPRET");
    setenv("LUTETIA_BOX_AFTER", "400000", 1);
    return 0;
}

static int folder_remove(void **state)
{
    char command[100];
    (void)state;
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static struct machine_stats stats_now(void)
{
    struct machine_stats stats;
    machine_stats_get(paris_machine(), &stats);
    return stats;
}

/* Looks as the studio does, at what has changed; and all kernels came from beside. */
static void look(struct studio_session *s)
{
    static uint8_t rgb[3 * SIDE * SIDE];
    struct paper_area areas[PAPER_AREAS_MAX];
    const struct paper_sheet_view view = studio_session_view(s);
    const int count = paper_sheet_changed(studio_session_sheet(s), areas);
    for (int i = 0; i < count; i++)
        good(paper_sheet_view_area(studio_session_sheet(s), &view, &areas[i], rgb, 3 * SIDE));
    const struct machine_stats stats = stats_now();
    assert_int_equal(stats.kernels_built, stats.kernels_built_background);
}

static void stroke(struct studio_session *s, double time_s)
{
    good(studio_session_set(s, STUDIO_TOOL, STUDIO_TOOL_BRUSH));
    for (int i = 0; i < POINTS; i++) {
        const struct studio_point point = {.kind = i == 0           ? STUDIO_POINT_DOWN
                                                   : i < POINTS - 1 ? STUDIO_POINT_MOVE
                                                                    : STUDIO_POINT_UP,
                                           .time_s = time_s + i / 60.0,
                                           .x = 20 + 10 * i,
                                           .y = 50 + 4 * i,
                                           .pressure = 0.6};
        good(studio_session_point(s, &point));
        look(s);
    }
}

/* Enough for plans to be due: with LUTETIA_COMPILER="" this fails. Whether the process has
 * compiled one by then does not matter. */
static void no_stroke_waits_for_a_compiler(void **state)
{
    (void)state;
    struct paper_sheet_config config = scene_config();
    struct studio_session *s;
    config.width = config.height = SIDE;
    good(studio_session_create(&config, 64e6, &s));
    look(s);
    for (int i = 0; i < STROKES; i++) {
        stroke(s, 1 + i);
        for (int step = 0; step < STEPS; step++) {
            good(studio_session_steps(s, 1, NULL));
            look(s);
        }
    }
    assert_true(stats_now().interpreted > 0);
    studio_session_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_stroke_waits_for_a_compiler)};
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
