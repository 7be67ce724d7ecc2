/* test_filter.c - filters: tables, measured properties, names, choice. */
#include "support.h"

#include <filter_internal.h>

#include <math.h>
#include <string.h>

static void integrals_are_one(void **state)
{
    (void)state;
    for (const char *const *name = font_filter_names(); *name; name++) {
        struct font_filter *f = filter_make(*name);
        enum { N = 400 };
        double r = f->radius, d = 2 * r / N, sum = 0, rows = 0;
        for (int j = 0; j < N; j++) {
            double v = -r + (j + 0.5) * d;
            rows += font_filter_row_integral(f, r + 1, v) * d;
            for (int i = 0; i < N; i++)
                sum += font_filter_at(f, -r + (i + 0.5) * d, v) * d * d;
        }
        if (fabs(sum - 1) > 2e-3 || fabs(rows - 1) > 2e-3)
            fail_msg("%s: %g, by rows %g", *name, sum, rows);
        assert_true(fabs(font_filter_edge(f, r + 1) - 1) < 1e-9);
        assert_true(fabs(font_filter_edge(f, -r - 1)) < 1e-12);
        /* The two halves of a filter are equal; low-rank filters are made so. */
        assert_true(fabs(font_filter_edge(f, 0) - 0.5) < 1e-3);
        font_filter_destroy(f);
    }
}

/* In every phase the rows add up to the whole filter, and the padding has the right values. */
static void tables_hold_the_filter(void **state)
{
    (void)state;
    for (const char *const *name = font_filter_names(); *name; name++) {
        struct font_filter *f = filter_make(*name);
        for (int t = 0; t < f->terms_count; t++) {
            double total = f->terms[t].integral[f->knots];
            for (int p = 0; p < FONT_PHASES; p++) {
                const float *x = font_filter_x(f, t) + p * 2 * FONT_X_ROW;
                const float *h = font_filter_h(f, t) + p * 2 * FONT_H_ROW;
                const float *y = font_filter_y(f, t) + p * 2 * FONT_Y_ROW;
                double rows = 0;
                for (int k = 0; k < FONT_Y_ROW; k++) {
                    rows += (double)y[k];
                    assert_true(k <= f->taps || y[k] == 0);
                }
                assert_true(fabs(rows - f->terms[t].weight * total) < 1e-5);
                for (int k = 0; k < FONT_X_ROW; k++)
                    assert_true((k >= 16 && k < 16 + f->taps) || x[k] == 0);
                for (int k = 0; k < 16; k++)
                    assert_true(h[k] == 0);
                for (int k = 16 + f->taps; k < FONT_H_ROW; k++)
                    assert_true(fabs((double)h[k] - total) < 1e-6);
                for (int k = 0; k < f->taps; k++) {
                    double at = k + 1 - (double)p / FONT_PHASES - f->radius;
                    assert_true(fabs((double)x[16 + k] - font_term_density(f, t, at)) < 1e-5);
                    assert_true(fabs((double)h[16 + k] - font_term_integral(f, t, at)) < 1e-5);
                }
            }
        }
        font_filter_destroy(f);
    }
}

static void round_filters_are_few_products(void **state)
{
    (void)state;
    static const char *const names[] = {"pillbox", "cone", "pillbox:2", "round:1.5,1,0.2,0"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        struct font_filter *f = filter_make(names[n]);
        double worst = 0;
        assert_true(f->terms_count >= 2 && f->terms_count <= FONT_TERMS_MAX);
        /* Half planes at several angles: the sum of products against the filter itself. */
        for (int angle = 0; angle < 8; angle++) {
            enum { N = 240 };
            double d = 2 * f->radius / N, c = cos(angle * M_PI / 16),
                   s = sin(angle * M_PI / 16);
            double products = 0, itself = 0;
            for (int j = 0; j < N; j++)
                for (int i = 0; i < N; i++) {
                    double u = -f->radius + (i + 0.5) * d, v = -f->radius + (j + 0.5) * d;
                    if (u * c + v * s > 0.3 * f->radius)
                        continue;
                    itself += font_filter_at(f, u, v) * d * d;
                    for (int t = 0; t < f->terms_count; t++)
                        products += f->terms[t].weight * font_term_density(f, t, u) *
                                    font_term_density(f, t, v) * d * d;
                }
            worst = fmax(worst, fabs(products - itself));
        }
        print_message("%s: %d products, %.2f of 255 (%.2f was measured)\n", names[n],
                      f->terms_count, 255 * worst, 255 * f->info.residual);
        assert_true(worst < 0.6 / 255);
        font_filter_destroy(f);
    }
}

static void what_is_measured_is_so(void **state)
{
    (void)state;
    struct font_filter_info info;
    struct font_filter *f = filter_make("box");
    font_filter_describe(f, &info);
    assert_true(fabs(info.peak - 1) < 1e-9 && info.ripple < 1e-9 && info.undershoot < 1e-9);
    assert_true(fabs(info.response_nyquist - 2 / M_PI) < 1e-3); /* sinc(1/2) */
    assert_true(fabs(info.response_pixel) < 1e-3);
    assert_true(fabs(info.half_width_px - 1) < 0.01);
    font_filter_destroy(f);
    f = filter_make("gaussian:0.5,2");
    font_filter_describe(f, &info);
    assert_true(fabs(info.response_nyquist - exp(-M_PI * M_PI / 8)) < 1e-3);
    assert_true(fabs(info.half_width_px - 0.5 * 2.3548) < 0.02);
    assert_true(info.step_px == 0 && info.terms == 1 && info.taps == 4);
    font_filter_destroy(f);
    f = filter_make("mitchell");
    font_filter_describe(f, &info);
    assert_true(info.ripple < 1e-9); /* B-spline and Catmull-Rom: both add up to one */
    assert_true(info.undershoot > 0.01 && info.undershoot < 0.05);
    font_filter_destroy(f);
}

static void wrong_names_are_said(void **state)
{
    (void)state;
    static const char *const wrong[] = {"",
                                        "boxx",
                                        "box:",
                                        "box:0",
                                        "box:5",
                                        "box:nan",
                                        "box:1,2",
                                        "gaussian",
                                        "gaussian:1",
                                        "gaussian:0,2",
                                        "gaussian:1,2,3",
                                        "samples:1",
                                        "samples:1,1",
                                        "samples:1,0,0",
                                        "samples:1,1,inf",
                                        "samples:1,1,,2",
                                        "round:1,-1,-1",
                                        "box:1x",
                                        "lanczos:-3",
                                        "round:9,1,1"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct font_filter *f;
        if (font_filter_create_named(wrong[i], &f) != FONT_BAD_ARGUMENT)
            fail_msg("'%s' was taken", wrong[i]);
        assert_null(f);
        assert_true(strlen(font_error()) > 10 && !strchr(font_error(), '\n'));
    }
}

static void filters_suit_details(void **state)
{
    (void)state;
    static const struct {
        double detail_px;
        enum font_display display;
    } cases[] = {{0.4, FONT_DISPLAY_CRT}, {1.1, FONT_DISPLAY_LCD}, {6, FONT_DISPLAY_PRINT}};
    const char *last = "";
    int changes = 0;
    for (int k = 0; k < 3; k++) {
        const char *name = font_filter_choose(cases[k].detail_px, cases[k].display);
        print_message("%g px: %s\n", cases[k].detail_px, name);
        changes += strcmp(name, last) != 0;
        last = name;
        struct font_filter *f = filter_make(name);
        font_filter_destroy(f);
    }
    assert_true(changes > 1); /* it is a choice */
    assert_non_null(font_filter_choose(NAN, FONT_DISPLAY_LCD));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(integrals_are_one),
        cmocka_unit_test(tables_hold_the_filter),
        cmocka_unit_test(round_filters_are_few_products),
        cmocka_unit_test(what_is_measured_is_so),
        cmocka_unit_test(wrong_names_are_said),
        cmocka_unit_test(filters_suit_details),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
