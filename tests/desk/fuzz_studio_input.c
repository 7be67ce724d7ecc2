/* fuzz_studio_input.c - lines of recorded input, good ones and what becomes of them: none is
 * read past its end, and what is read is in its ranges. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <studio_input.h>
#include <studio_settings.h>

enum { TRIES = 60000 };

static uint64_t chance(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return *seed >> 33;
}

static void line_try(const char *line)
{
    struct studio_input in;
    char why[80] = "";
    const int good = studio_input_parse(line, &in, why, sizeof why);
    assert_true(good >= -1 && good <= 1);
    if (good < 0)
        assert_true(why[0] && strlen(why) < sizeof why);
    if (good < 1)
        return;
    assert_true(in.time_s >= 0 && isfinite(in.time_s));
    assert_true(isfinite(in.event.x_px) && isfinite(in.event.y_px));
    assert_true(in.event.pressure >= 0 && in.event.pressure <= 1);
    assert_true(fabs(in.event.tilt_x) <= 1 && fabs(in.event.tilt_y) <= 1);
    assert_true(strlen(in.text) < sizeof in.text && strlen(in.name) < sizeof in.name);
    if (in.kind == STUDIO_INPUT_SET)
        assert_true(in.setting >= 0 && in.setting < STUDIO_SETTINGS &&
                    in.value >= studio_controls[in.setting].least &&
                    in.value <= studio_controls[in.setting].most);
}

static void lines(void **state)
{
    (void)state;
    static const char *const seeds[] = {"0.25 down -12.5 40 0.5 0.1 -0.2",
                                        "1 set tool wash",
                                        "1 type 20 30 two\\nlines",
                                        "1 view 2 100 50 30 1",
                                        "2.5 action tool salt",
                                        "3 step 60",
                                        "4 save a.h5",
                                        "4 palette a.palette",
                                        "4 stamp a.png",
                                        "5 undo",
                                        "6 set width 30"};
    uint64_t seed = 1;
    for (int i = 0; i < TRIES; i++) {
        const char *from = seeds[chance(&seed) % (sizeof seeds / sizeof *seeds)];
        const size_t length = strlen(from) + chance(&seed) % 8;
        char *line =
            calloc(length + 1, 1); /* of its own size, so that a sanitizer sees its end */
        assert_non_null(line);
        memcpy(line, from, strlen(from));
        for (uint64_t k = chance(&seed) % 5; k > 0; k--) {
            const size_t at = chance(&seed) % (length + 1);
            line[at] = (char)(at < length ? " 0159.-+eExnaif\\\t\377"[chance(&seed) % 18] : 0);
        }
        line_try(line);
        free(line);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lines)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
