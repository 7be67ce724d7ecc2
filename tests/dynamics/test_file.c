/* test_file.c - networks as text: a network that is written and read continues with the same
 * bits; bad text is refused in one line. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include <fields.h>
#include <hand.h>
#include <locale.h>
#include <math.h>
#include <network_file.h>
#include <step.h>

#include "sample.h"
#include "scenes.h"

static char *text_of(const struct dyn_network *n, size_t *bytes)
{
    char *text = NULL;
    FILE *to = open_memstream(&text, bytes);
    assert_non_null(to);
    scene_must(dyn_network_print(n, to));
    assert_int_equal(fclose(to), 0);
    return text;
}

static void network_read_again_goes_on_to_the_same_bits(void **unused)
{
    (void)unused;
    uint64_t state = 21;
    for (int round = 0; round < 300; round++) {
        struct dyn_network *n = scene_by_chance(&state), *again;
        size_t bytes, bytes_again;
        scene_must(dyn_network_step(n, 1.0 / 240, 50));
        char *text = text_of(n, &bytes);
        scene_must(dyn_network_parse(text, bytes, "text", &again));
        char *text_again = text_of(again, &bytes_again);
        assert_int_equal(bytes, bytes_again);
        assert_memory_equal(text, text_again, bytes);
        scene_must(dyn_network_step(n, 1.0 / 240, 100));
        scene_must(dyn_network_step(again, 1.0 / 240, 100));
        assert_true(dyn_network_time_s(n) == dyn_network_time_s(again));
        assert_memory_equal(dyn_network_states(n), dyn_network_states(again),
                            (size_t)dyn_masses_count(n) * sizeof(struct dyn_state));
        for (int i = 0; i < dyn_springs_count(n); i++)
            assert_int_equal(dyn_spring_get(n, i).broken, dyn_spring_get(again, i).broken);
        free(text);
        free(text_again);
        dyn_network_destroy(n);
        dyn_network_destroy(again);
    }
}

/* Every field, at values that are hard to write in decimal. */
static void fields_come_back_to_the_bit(void **unused)
{
    (void)unused;
    static const double hard[] = {0.1, 1.0 / 3, 1e-300, 5e-324, -0.0, 123456.78901234567};
    struct dyn_network *n = scene_letter(0, 1, 10, 0), *again;
    for (size_t h = 0; h < sizeof hard / sizeof *hard; h++)
        for (int of_spring = 0; of_spring < 2; of_spring++) {
            int count = of_spring ? dyn_spring_fields_count : dyn_mass_fields_count;
            for (int i = 0; i < count; i++) {
                const struct control *f =
                    of_spring ? &dyn_spring_fields[i] : &dyn_mass_fields[i];
                if ((of_spring ? dyn_spring_write : dyn_mass_write)(n, 1, f, hard[h]) != DYN_OK)
                    continue;
                size_t bytes;
                char *text = text_of(n, &bytes);
                scene_must(dyn_network_parse(text, bytes, "text", &again));
                struct dyn_mass mass = dyn_mass_get(again, 1);
                struct dyn_spring spring = dyn_spring_get(again, 1);
                double value = of_spring ? control_read(f, &spring) : control_read(f, &mass);
                assert_memory_equal(&value, &hard[h], sizeof value);
                free(text);
                dyn_network_destroy(again);
            }
        }
    dyn_network_destroy(n);
}

static void file_is_written_and_read(void **unused)
{
    (void)unused;
    char folder[] = "/tmp/lutetia-springs-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/letter.springs", folder);
    struct dyn_network *n = scene_letter(0, 1, 123.456, 0.1), *again;
    scene_must(dyn_network_write(n, path));
    scene_must(dyn_network_read(path, &again));
    assert_int_equal(dyn_springs_count(again), 6);
    assert_true(dyn_spring_get(again, 5).constant == 123.456);
    dyn_network_destroy(again);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(dyn_network_read(path, &again), DYN_BAD_FILE);
    assert_null(again);
    assert_non_null(strstr(dyn_error(), "letter.springs: cannot be read: No such file"));
    assert_int_equal(dyn_network_read(folder, &again), DYN_BAD_FILE);
    assert_non_null(strstr(dyn_error(), ": cannot be read: "));
    assert_int_equal(mkfifo(path, 0600), 0); /* nobody waits for it */
    assert_int_equal(dyn_network_read(path, &again), DYN_BAD_FILE);
    assert_non_null(strstr(dyn_error(), "letter.springs: cannot be read: "));
    assert_int_equal(unlink(path), 0);
    assert_int_equal(dyn_network_write(n, folder), DYN_BAD_FILE);
    assert_int_equal(rmdir(folder), 0);
    dyn_network_destroy(n);
}

static void bad_networks_are_refused_in_one_line(void **unused)
{
    (void)unused;
    static const struct {
        const char *text, *error;
    } bad[] = {
        {"", "bad:1: its first line must be 'springs 1'"},
        {"springs 2\nend\n", "bad:1: its first line must be 'springs 1'"},
        {"springs 1\nmass\nspring 0 0\nend\n",
         "bad:3: a spring cannot go from mass 0 to itself"},
        {"springs 1\nmass\nspring 0 1\nend\n",
         "bad:3: a spring needs two masses, and there is no mass 1 (of 1)"},
        {"springs 1\nmass\nspring 0 -1\nend\n", "bad:3: second end: '-1' is no mass's number"},
        {"springs 1\nmass\nspring 0\nend\n", "bad:3: there is no second end"},
        {"springs 1\nmass mass=0\nend\n", "bad:2: mass must be 1e-06..1e+06 kg (got 0)"},
        {"springs 1\nmass mass=-2\nend\n", "bad:2: mass must be 1e-06..1e+06 kg (got -2)"},
        {"springs 1\nmass x=nan\nend\n", "bad:2: x must be -1e+06..1e+06 units (got nan)"},
        {"springs 1\nmass x=1 x=2\nend\n", "bad:2: x twice"},
        {"springs 1\nmass x\nend\n", "bad:2: 'x' is no name=value"},
        {"springs 1\nmass x=1e\nend\n", "bad:2: x: '1e' is no number"},
        {"springs 1\nmass z=1\nend\n", "bad:2: a mass has no 'z'; it has x, y, vx, vy, mass, "
                                       "drag, gravity, restitution, friction"},
        {"springs 1\ncontrol gravity\nend\n", "bad:2: a control has a name and a value"},
        {"springs 1\ncontrol floor_on maybe\nend\n",
         "bad:2: floor_on must be on or off (got 'maybe')"},
        {"springs 1\ncontrol rest 99\nend\n", "bad:2: rest must be 0.01..10 (got 99)"},
        {"springs 1\ntime_s inf\nend\n", "bad:2: time_s must be -1e+12..1e+12 (got inf)"},
        {"springs 1\npull 0 1 2 3 4\nend\n", "bad:2: there is no mass 0 (of 0)"},
        {"springs 1\nmass\npull 0 1 2 3\nend\n", "bad:3: there is no damping"},
        {"springs 1\nmass\npull 0 1 2 3 4 5\nend\n", "bad:3: '5' is one word too many"},
        {"springs 1\nhello\nend\n",
         "bad:2: a line begins with one of: time_s control mass spring pull end (got 'hello')"},
        {"springs 1\nmass x=1\nmass y=", "bad:3: y: '' is no number"},
        {"springs 1\nmass x=1\n", "bad:2: the file is cut short: there is no 'end'"},
        {"springs 1\nend\nmass\n", "bad:3: after 'end' there can be nothing more"},
        {"springs 1\nmass x=1\x1b\nend\n", "bad:2: a byte of value 27 is no text"},
    };
    struct dyn_network *n = NULL;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        enum dyn_status status = dyn_network_parse(bad[i].text, strlen(bad[i].text), "bad", &n);
        if (status != DYN_BAD_FILE || n || strcmp(dyn_error(), bad[i].error) != 0)
            fail_msg("%zu: status %d, \"%s\", not \"%s\"", i, status, dyn_error(),
                     bad[i].error);
    }
}

/* A million springs on one mass are refused at the first one too many. */
static void hub_of_a_million_springs_is_refused(void **unused)
{
    (void)unused;
    char *text = NULL;
    size_t bytes;
    struct dyn_network *n;
    FILE *to = open_memstream(&text, &bytes);
    fputs("springs 1\nmass\nmass x=1\n", to);
    for (int i = 0; i < 1000000; i++)
        fputs("spring 0 1\n", to);
    fputs("end\n", to);
    assert_int_equal(fclose(to), 0);
    assert_int_equal(dyn_network_parse(text, bytes, "hub", &n), DYN_TOO_LARGE);
    assert_string_equal(dyn_error(),
                        "hub:4100: mass 0 has 4096 springs, and a mass has no more");
    free(text);
}

/* A file that is cut short anywhere is refused, unless only its last newline is missing. */
static void file_cut_short_is_refused_anywhere(void **unused)
{
    (void)unused;
    uint64_t state = 4;
    struct dyn_network *n = scene_by_chance(&state), *again;
    for (; dyn_masses_count(n) < 3 || dyn_masses_count(n) > 6; n = scene_by_chance(&state))
        dyn_network_destroy(n);
    size_t bytes;
    char *text = text_of(n, &bytes);
    for (size_t cut = 0; cut < bytes - 1; cut++) {
        assert_int_equal(dyn_network_parse(text, cut, "cut", &again), DYN_BAD_FILE);
        assert_null(again);
        assert_null(strchr(dyn_error(), '\n'));
    }
    scene_must(dyn_network_parse(text, bytes - 1, "cut", &again));
    dyn_network_destroy(again);
    dyn_network_destroy(n);
    free(text);
}

static void text_may_have_comments_and_ends_of_lines_of_windows(void **unused)
{
    (void)unused;
    static const char text[] =
        "springs 1\r\n# hello\r\n\r\n \t mass  x=1\tstuck \r\nmass x=3 held\r\n"
        "control integrator verlet\r\nspring 0 1\r\nend\r\n# bye";
    struct dyn_network *n;
    scene_must(dyn_network_parse(text, sizeof text - 1, "text", &n));
    assert_true(dyn_mass_get(n, 0).x == 1 && dyn_mass_get(n, 0).hold == DYN_STUCK);
    assert_true(dyn_mass_get(n, 1).hold == DYN_HELD);
    assert_true(dyn_spring_get(n, 0).rest_length == 2);
    assert_true(dyn_network_world(n)->integrator == DYN_VERLET);
    dyn_network_destroy(n);
}

static void file_without_a_place_is_not_written(void **unused)
{
    (void)unused;
    struct dyn_network *n = scene_letter(0, 1, 1e9, 0);
    struct dyn_world w = *dyn_network_world(n);
    w.integrator = DYN_THESIS;
    scene_must(dyn_network_world_set(n, &w));
    scene_must(dyn_mass_write(n, 0, dyn_mass_field_find("x"), 0.5));
    scene_must(dyn_network_step(n, 0.02, 100)); /* the thesis's step explodes */
    assert_int_equal(dyn_network_print(n, stdout), DYN_BAD_ARGUMENT);
    assert_non_null(strstr(dyn_error(), "mass 0: x must be -1e+06..1e+06 units (got "));
    dyn_network_destroy(n);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(network_read_again_goes_on_to_the_same_bits),
        cmocka_unit_test(fields_come_back_to_the_bit),
        cmocka_unit_test(file_is_written_and_read),
        cmocka_unit_test(bad_networks_are_refused_in_one_line),
        cmocka_unit_test(hub_of_a_million_springs_is_refused),
        cmocka_unit_test(file_cut_short_is_refused_anywhere),
        cmocka_unit_test(text_may_have_comments_and_ends_of_lines_of_windows),
        cmocka_unit_test(file_without_a_place_is_not_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
