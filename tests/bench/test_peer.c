/* test_peer.c - the peers in Python, where they are installed, and the message where a peer is
 * missing or fails. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "../skip.h"
#include "harness.h"
#include "peer.h"
#include "peers.h"

enum { WIDTH = 61, HEIGHT = 43, STEPS = 8, COUNT = WIDTH * HEIGHT };

static struct diffusion_scene scene;

static int scene_make(void **state)
{
    (void)state;
    return diffusion_scene_init(&scene, WIDTH, HEIGHT) ? 0 : -1;
}

static int scene_drop(void **state)
{
    (void)state;
    diffusion_scene_finish(&scene);
    return 0;
}

/* Compares a peer with openmp, which test_diffusion compares with the oracle. */
static void peer_agrees(const char *script, const char *argument)
{
    static float mine[COUNT], theirs[COUNT];
    bool missing;
    struct bench_peer *p = bench_peer_start(&scene, script, argument, &missing);

    if (!p && missing)
        skip_because("the peer is not installed");
    if (!p)
        fail_msg("%s", bench_error());
    struct diffusion_openmp *o = diffusion_openmp_create(&scene);
    assert_non_null(o);
    diffusion_openmp_steps(o, STEPS);
    assert_true(bench_peer_steps(p, STEPS));
    for (int i = 0; i < DIFFUSION_FIELDS_COUNT; i++) {
        diffusion_openmp_read(o, i, mine);
        assert_true(bench_peer_read(p, i, theirs));
        assert_memory_equal(theirs, mine, sizeof mine);
    }
    bench_peer_stop(p);
    diffusion_openmp_destroy(o);
}

static void numpy_agrees(void **state)
{
    (void)state;
    peer_agrees(kernel_numpy_peer_py, NULL);
}

static void halide_agrees(void **state)
{
    (void)state;
    peer_agrees(kernel_halide_peer_py, "1");
}

static void missing_is_no_error(void **state)
{
    bool missing = false;

    (void)state;
    assert_null(bench_peer_start(&scene, "import sys; sys.exit(3)", NULL, &missing));
    assert_true(missing);
}

static void failure_is_told(void **state)
{
    bool missing = true;

    (void)state;
    assert_null(bench_peer_start(&scene, "import sys; sys.exit(9)", NULL, &missing));
    assert_false(missing);
    assert_non_null(strstr(bench_error(), "status 9"));
}

/* A peer that reports ready and ends at the first command. */
static void end_in_between_is_told(void **state)
{
    bool missing;
    struct bench_peer *p = bench_peer_start(
        &scene, "import sys; sys.stdin.buffer.read(100); print('ready', flush=True)", NULL,
        &missing);

    (void)state;
    if (!p) /* it may have ended before the scene was sent */
        skip_because("the peer ended before the scene was sent");
    assert_false(bench_peer_steps(p, 1));
    assert_string_equal(bench_error(), "a peer in Python has ended");
    bench_peer_stop(p);
}

/* The second peer must not inherit the first one's input, or the first would never end. */
static void two_stop_in_any_order(void **state)
{
    static const char patient[] = "import sys\n"
                                  "print('ready', flush=True)\n"
                                  "sys.stdin.buffer.read()\n";
    bool missing;
    struct bench_peer *one = bench_peer_start(&scene, patient, NULL, &missing);
    struct bench_peer *two = bench_peer_start(&scene, patient, NULL, &missing);

    (void)state;
    assert_non_null(one);
    assert_non_null(two);
    bench_peer_stop(one);
    bench_peer_stop(two);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numpy_agrees),           cmocka_unit_test(halide_agrees),
        cmocka_unit_test(missing_is_no_error),    cmocka_unit_test(failure_is_told),
        cmocka_unit_test(end_in_between_is_told), cmocka_unit_test(two_stop_in_any_order),
    };

    return cmocka_run_group_tests(tests, scene_make, scene_drop);
}
