/* test_path.c - paths from outside: SVG paths against known shapes, SVG files, recorded
 * samples. */
#include <path.h>

#include <malloc.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define PI 3.14159265358979323846
#define TOLERANCE 0.01

static struct paper_lines lines;

static void parse(const char *path)
{
    paper_lines_destroy(&lines);
    if (paper_path_parse(path, TOLERANCE, &lines) != PAPER_OK)
        fail_msg("'%s': %s", path, paper_error());
}

static double area(const struct paper_way *way)
{
    double sum = 0;
    for (int i = 0; i < way->points_count; i++) {
        const double *a = way->points + 2 * i,
                     *b = way->points + 2 * ((i + 1) % way->points_count);
        sum += a[0] * b[1] - a[1] * b[0];
    }
    return sum / 2;
}

static double length(const struct paper_way *way)
{
    double sum = 0;
    for (int i = 1; i < way->points_count; i++)
        sum += hypot(way->points[2 * i] - way->points[2 * i - 2],
                     way->points[2 * i + 1] - way->points[2 * i - 1]);
    return sum;
}

static void straight_lines_are_their_corners(void **state)
{
    (void)state;
    static const struct {
        const char *path;
        double corners[12];
        int count;
    } rows[] = {
        {"M1 2L3 4", {1, 2, 3, 4}, 2},
        {"m1,2 3,4 5,6", {1, 2, 4, 6, 9, 12}, 3},
        {"M1-2.5.5 3e1", {1, -2.5, .5, 30}, 2},
        {" M 0 0 H 5 v 5 h-5 z ", {0, 0, 5, 0, 5, 5, 0, 5, 0, 0}, 5},
        {"M0,0 1,0 L1,1\n0,1Z", {0, 0, 1, 0, 1, 1, 0, 1, 0, 0}, 5},
        {"M10 10 l 1 1 L 5 5 V 7 8 H 1", {10, 10, 11, 11, 5, 5, 5, 7, 5, 8, 1, 8}, 6},
        {"M0 0A0 5 0 0 1 9 9", {0, 0, 9, 9}, 2}, /* no radius: a line */
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        parse(rows[i].path);
        assert_int_equal(lines.count, 1);
        if (lines.line[0].points_count != rows[i].count)
            fail_msg("'%s' has %d points", rows[i].path, lines.line[0].points_count);
        for (int j = 0; j < 2 * rows[i].count; j++)
            assert_true(fabs(lines.line[0].points[j] - rows[i].corners[j]) < 1e-12);
    }
    parse("M0 0L1 1M5 5L6 6zL9 9"); /* after z it goes on at the sub-path's start */
    assert_int_equal(lines.count, 3);
    assert_true(lines.line[2].points[0] == 5 && lines.line[2].points[2] == 9);
    parse("M 3 3 M 4 4");
    assert_int_equal(lines.count, 0);
    parse("");
    assert_int_equal(lines.count, 0);
}

static void curves_are_near_what_they_are(void **state)
{
    (void)state;
    /* a parabola, 100 times as large: y = x (1 - x) * 2 from 0,0 to 1,0 through .5,.5 */
    static const char *const parabolas[] = {
        "M0 0Q50 100 100 0", "M0 0C33.333333333 66.666666667 66.666666667 66.666666667 100 0",
        "m0 0q50 100 100 0", "M-100 0Q-50 -100 0 0T100 0"};
    for (size_t i = 0; i < sizeof parabolas / sizeof *parabolas; i++) {
        parse(parabolas[i]);
        const struct paper_way *way = &lines.line[0];
        assert_true(way->points_count > 8 && way->points_count < 200);
        for (int j = 0; j < way->points_count; j++) {
            double x = way->points[2 * j] / 100, y = way->points[2 * j + 1] / 100;
            if (x >= 0)
                assert_true(fabs(y - 2 * x * (1 - x)) < 1e-6);
        }
        if (i < 3) /* chords lie inside, by less than the tolerance */
            assert_true(fabs(area(way) + 1e4 / 3) < 100 * TOLERANCE);
    }
    /* S continues the cubic before it smoothly */
    parse("M0 0C0 10 10 10 10 0S20 -10 20 0");
    struct paper_lines one = lines;
    lines = (struct paper_lines){0};
    parse("M0 0C0 10 10 10 10 0C10 -10 20 -10 20 0");
    assert_int_equal(one.line[0].points_count, lines.line[0].points_count);
    assert_memory_equal(one.line[0].points, lines.line[0].points,
                        2 * sizeof(double) * (size_t)lines.line[0].points_count);
    paper_lines_destroy(&one);
}

static void arcs_are_arcs(void **state)
{
    (void)state;
    /* four arcs of radius 10 from 10,0 to 0,10: about 0,0 and about 10,10 */
    for (int large = 0; large < 2; large++)
        for (int sweep = 0; sweep < 2; sweep++) {
            char path[64];
            snprintf(path, sizeof path, "M10 0A10 10 0 %d%d0 10", large, sweep);
            parse(path);
            const struct paper_way *way = &lines.line[0];
            double middle = large == sweep ? 10 : 0;
            for (int i = 0; i < way->points_count; i++)
                assert_true(
                    fabs(hypot(way->points[2 * i] - middle, way->points[2 * i + 1] - middle) -
                         10) < 1e-9);
            double want = (large ? 1.5 : 0.5) * PI * 10;
            assert_true(fabs(length(way) - want) < 0.01 * want);
            double turned = 0; /* y grows downwards, so sweep 1 is the positive turn */
            for (int i = 1; i < way->points_count; i++)
                turned +=
                    (way->points[2 * i - 2] - middle) * (way->points[2 * i + 1] - middle) -
                    (way->points[2 * i - 1] - middle) * (way->points[2 * i] - middle);
            assert_true(sweep ? turned > 0 : turned < 0);
        }
    /* a whole ellipse in two arcs, turned by 30 degrees */
    double c = cos(PI / 6), s = sin(PI / 6);
    char path[200];
    snprintf(path, sizeof path,
             "M%.12g %.12gA40 20 30 1 1 %.12g %.12gA40 20 30 1 1 %.12g %.12gz", 40 * c, 40 * s,
             -40 * c, -40 * s, 40 * c, 40 * s);
    parse(path);
    for (int i = 0; i < lines.line[0].points_count; i++) {
        double x = lines.line[0].points[2 * i], y = lines.line[0].points[2 * i + 1];
        double u = (c * x + s * y) / 40, v = (c * y - s * x) / 20;
        assert_true(fabs(u * u + v * v - 1) < 1e-6);
    }
    assert_true(fabs(fabs(area(&lines.line[0])) - PI * 800) < 2);
    /* radii too small are enlarged: the arc is a half circle */
    parse("M0 0A1 1 0 0 1 20 0");
    for (int i = 0; i < lines.line[0].points_count; i++)
        assert_true(
            fabs(hypot(lines.line[0].points[2 * i] - 10, lines.line[0].points[2 * i + 1]) -
                 10) < 1e-9);
}

static void wrong_paths_are_told_where(void **state)
{
    (void)state;
    static const char *const rows[][2] = {
        {"L1 1", "character 1: a path begins with M"},
        {"M1", "character 3: a number"},
        {"M1 x", "character 4: a number"},
        {"M1 1 A1 1 0 2 0 5 5", "character 13: a flag"},
        {"M1 1 W", "character 6: a number"},
        {"M0 0 z 5", "character 8: a command"},
        {"M1e400 0", "a number"},
        {"M0 0L2000000 0", "further than"},
        {"M0 0Lnan 1", "a number"},
        {"M0 0L0x10 1", "a number"},
        {"5 5", "a command"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct paper_lines none;
        assert_int_equal(paper_path_parse(rows[i][0], 0.1, &none), PAPER_BAD_ARGUMENT);
        if (!strstr(paper_error(), rows[i][1]))
            fail_msg("'%s': %s", rows[i][0], paper_error());
        assert_null(none.line);
    }
}

static enum paper_status svg(const char *text)
{
    paper_lines_destroy(&lines);
    return paper_svg_parse(text, strlen(text), "a.svg", TOLERANCE, &lines);
}

/* Expat keeps each name and each attribute: what it takes is bounded by the file's length,
 * before it goes on. (security.md 32) */
static void svg_attributes_are_bounded(void **state)
{
    (void)state;
    enum { COUNT = 400000, ROOM = COUNT * 12 + 100 };
    char *text = malloc(ROOM);
    assert_non_null(text);
    size_t at = (size_t)snprintf(text, ROOM, "<svg><path d='M0 0L1 1'");
    for (int i = 0; i < 1200; i++)
        at += (size_t)snprintf(text + at, ROOM - at, " a%x=''", (unsigned)i);
    snprintf(text + at, ROOM - at, "/></svg>");
    assert_int_equal(svg(text), PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(paper_error(), "more than 1000 attributes"));
    const struct mallinfo2 before = mallinfo2();
    at = (size_t)snprintf(text, ROOM, "<svg><path d='M0 0L1 1'");
    for (int i = 0; i < COUNT; i++)
        at += (size_t)snprintf(text + at, ROOM - at, " %x=''", (unsigned)i + 0xa00000u);
    snprintf(text + at, ROOM - at, "/></svg>");
    assert_int_equal(svg(text), PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(paper_error(), "more elements, names or attributes"));
    assert_true(mallinfo2().uordblks <= before.uordblks + 4096);
    /* and a long path is none of that */
    at = (size_t)snprintf(text, ROOM, "<svg><path d='M0 0");
    for (int i = 0; i < 150000; i++)
        at += (size_t)snprintf(text + at, ROOM - at, "L%d %d", i % 100, i % 99);
    snprintf(text + at, ROOM - at, "'/></svg>");
    assert_int_equal(svg(text), PAPER_OK);
    free(text);
}

static void svg_files_give_their_paths(void **state)
{
    (void)state;
    assert_int_equal(svg("<?xml version='1.0'?><svg xmlns='http://www.w3.org/2000/svg'>"
                         "<defs><path d='M0 0L9 9'/></defs>"
                         "<g transform='translate(10,20) scale(2)'><g transform='rotate(90)'>"
                         "<path d='M0 0L1 0M0 0L0 1'/></g></g>"
                         "<path transform='matrix(1 0 0 -1 5 5),skewX(45)' d='M1 1L2 3'/>"
                         "<rect width='5' height='5'/></svg>"),
                     PAPER_OK);
    assert_int_equal(lines.count, 3);
    const double ends[3][2] = {{10, 22}, {8, 20}, {10, 2}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 2; j++)
            assert_true(fabs(lines.line[i].points[2 + j] - ends[i][j]) < 1e-9);
    static const char *const wrong[][2] = {
        {"<html/>", "a.svg:1: it is XML, but not SVG"},
        {"<svg>\n<path d='M0 0'>", "a.svg:2: "},
        {"<svg>\n<path d='M0 0L5'/></svg>", "a.svg:2: path, character"},
        {"<svg><g transform='twist(5)'/></svg>", "a.svg:1: a transform"},
        {"<svg><g transform='rotate(5'/></svg>", "a.svg:1: a transform"},
        {"", "a.svg:1: "},
        {"M0 0", "a.svg:1: "},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(svg(wrong[i][0]), PAPER_BAD_ARGUMENT);
        if (strncmp(paper_error(), wrong[i][1], strlen(wrong[i][1])) != 0)
            fail_msg("'%s': %s", wrong[i][0], paper_error());
    }
    paper_lines_destroy(&lines);
    assert_int_equal(paper_svg_read("/no/such.svg", 1, &lines), PAPER_BAD_ARGUMENT);
    assert_non_null(strstr(paper_error(), "/no/such.svg: cannot read"));
    assert_int_equal(paper_svg_read("/", 1, &lines), PAPER_BAD_ARGUMENT); /* a folder */
}

static void samples_are_read(void **state)
{
    (void)state;
    struct paper_stroke_sample *samples;
    int count;
    static const char good[] = "time,x,y,pressure,tilt x,tilt y\r\n# recorded\n\n"
                               "0, 1.5, 2, 0.25, 0.1, -0.2\r\n0.5;3;4\n 1\t-5 6 1 ";
    assert_int_equal(paper_samples_parse(good, sizeof good - 1, "a.csv", &samples, &count),
                     PAPER_OK);
    assert_int_equal(count, 3);
    const struct paper_stroke_sample want[3] = {
        {0, 1.5, 2, 0.25, 0.1, -0.2}, {0.5, 3, 4, 0.5, 0, 0}, {1, -5, 6, 1, 0, 0}};
    assert_memory_equal(samples, want, sizeof want);
    free(samples);
    static const char *const wrong[][2] = {
        {"", "no samples"},
        {"# none\n", "no samples"},
        {"0,1,1\n0,2,2\n", "a.csv:2: times"},
        {"0,1\n", "a.csv:1: a line has"},
        {"0,1,2,3,4,5,6\n", "a.csv:1: a line has"},
        {"0,1,2,0.5,1\n", "a.csv:1: a line has"},
        {"t,x,y\nx,y,z\n", "a.csv:2: a line has"},
        {"0,1,2\n1,1,1,2\n", "a.csv:2: a number is out"},
        {"0,nan,2\n", "a.csv:1"},
        {"0,1,2,,\n", "a.csv:1"},
        {"0,1,1e9\n", "a.csv:1: a number is out"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(
            paper_samples_parse(wrong[i][0], strlen(wrong[i][0]), "a.csv", &samples, &count),
            PAPER_BAD_ARGUMENT);
        if (!strstr(paper_error(), wrong[i][1]))
            fail_msg("'%s': %s", wrong[i][0], paper_error());
        assert_null(samples);
    }
}

static void strokes_pass_through_their_samples(void **state)
{
    (void)state;
    const struct paper_stroke_sample samples[] = {{0, 0, 0, 0, 0, 0},
                                                  {1, 10, 5, 1, 0, 0},
                                                  {1.5, 20, -5, 0.5, 1, 0},
                                                  {3, 21, 0, 0.25, 0, 1}};
    struct paper_stroke stroke = {.pace = 60, .samples_count = 4, .samples = samples};
    int cursor = 0;
    for (int i = 3; i >= 0; i--) {
        struct paper_stroke_sample at = paper_stroke_at(&stroke, samples[i].time_s, &cursor);
        assert_true(fabs(at.x - samples[i].x) < 1e-12 && fabs(at.y - samples[i].y) < 1e-12);
        assert_true(fabs(at.pressure - samples[i].pressure) < 1e-12);
    }
    /* no corners: the direction is the same just before and just after a sample */
    for (int i = 1; i < 3; i++) {
        double t = samples[i].time_s, h = 1e-6;
        struct paper_stroke_sample a = paper_stroke_at(&stroke, t - h, &cursor),
                                   b = paper_stroke_at(&stroke, t, &cursor),
                                   c = paper_stroke_at(&stroke, t + h, &cursor);
        assert_true(fabs((b.x - a.x) - (c.x - b.x)) < 1e-4 * h * 1e3);
        assert_true(fabs((b.y - a.y) - (c.y - b.y)) < 1e-4 * h * 1e3);
    }
    /* equally spaced samples on a line give a constant speed */
    const struct paper_stroke_sample even[] = {
        {.x = 2}, {.time_s = 1, .x = 4}, {.time_s = 2, .x = 6}};
    stroke = (struct paper_stroke){.samples_count = 3, .samples = even};
    for (double t = 0; t <= 2; t += 0.125)
        assert_true(fabs(paper_stroke_at(&stroke, t, &cursor).x - (2 + 2 * t)) < 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(straight_lines_are_their_corners),
        cmocka_unit_test(curves_are_near_what_they_are),
        cmocka_unit_test(arcs_are_arcs),
        cmocka_unit_test(wrong_paths_are_told_where),
        cmocka_unit_test(svg_files_give_their_paths),
        cmocka_unit_test(svg_attributes_are_bounded),
        cmocka_unit_test(samples_are_read),
        cmocka_unit_test(strokes_pass_through_their_samples),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    paper_lines_destroy(&lines);
    return failed;
}
