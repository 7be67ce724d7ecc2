/* template_grid.c - where a template's columns are in a window, and how they are dragged: see
 * reader_template.h. */
#include "reader_template.h"

#include <math.h>
#include <string.h>

static const double edge_em = 1.2, noted_edge_em = 1; /* blank at the window's edges */
static const double least_em = 2;                     /* of a column in the narrowest window */
static const double alone_em = 34; /* the widest column of several that is left alone */
static const double text_em = 10, notes_em = 5; /* narrower ones hold no words */

/* ---- which columns there are ---- */

static void mark(bool *used, struct reader_place_span span)
{
    for (int i = span.first; i <= span.last; i++)
        used[i] = true;
}

/* Without notes, those that only they have are none. */
static void columns_used(const struct reader_template *t, bool notes, bool *used)
{
    bool noted[READER_GRID_COLUMNS_MAX] = {false}, others[READER_GRID_COLUMNS_MAX] = {false};
    for (int i = 0; i < t->texts_count; i++)
        mark(others, t->text[i]);
    for (int i = 0; i < t->notes_count; i++)
        mark(noted, t->notes[i]);
    for (int i = 0; i < READER_WIDES; i++)
        for (int k = t->wide[i].first; k <= t->wide[i].last; k++)
            others[k] = others[k] || !noted[k];
    for (int i = 0; i < t->columns_count; i++)
        used[i] = notes || others[i] || !noted[i];
}

static double needed_em(const struct reader_template *t, const bool *used, double edge)
{
    double all = 2 * edge;
    int count = 0;
    for (int i = 0; i < t->columns_count; i++)
        if (used[i]) {
            all += t->columns[i].least_em;
            count++;
        }
    return all + fmax(0, count - 1) * t->gutter_em;
}

/* ---- how wide they are ---- */

struct fitted {
    double x[READER_GRID_COLUMNS_MAX], width[READER_GRID_COLUMNS_MAX]; /* pixels */
};

/* Ranges take of what is left, in proportion, then shares; then what is left is blank. */
static double widths_fit(const struct reader_template *t, const bool *used, double left_px,
                         double em, struct fitted *f)
{
    double range = 0, shares = 0;
    for (int i = 0; i < t->columns_count; i++)
        if (used[i]) {
            range += t->columns[i].most_em - t->columns[i].least_em;
            shares += t->columns[i].share;
        }
    const double part = range > 0 ? fmin(1, left_px / (range * em)) : 0;
    left_px -= part * range * em;
    for (int i = 0; i < t->columns_count; i++) {
        const struct reader_template_column *c = &t->columns[i];
        f->width[i] = em * (c->least_em + part * (c->most_em - c->least_em));
        if (shares > 0)
            f->width[i] += left_px * c->share / shares;
    }
    return shares > 0 ? 0 : left_px;
}

static void columns_fit(const struct reader_template *t, const bool *used, double width_px,
                        double em, double edge, struct fitted *f)
{
    const double left =
        widths_fit(t, used, fmax(0, width_px - em * needed_em(t, used, edge)), em, f);
    const double begin = edge * em + left / 2;
    double x = floor(begin);
    /* what is lost to whole pixels is the text's */
    f->width[t->text[0].first] += 2 * (begin - x);
    for (int i = 0; i < t->columns_count; i++) {
        f->x[i] = x;
        if (used[i])
            x += f->width[i] + t->gutter_em * em;
        else
            f->width[i] = 0;
    }
}

/* From its first column that is seen to its last. */
static bool span_box(const bool *used, const struct fitted *f, struct reader_place_span span,
                     double *x, double *width)
{
    bool any = false;
    for (int i = span.first; i <= span.last; i++) {
        if (!used[i])
            continue;
        *x = any ? *x : f->x[i];
        *width = f->x[i] + f->width[i] - *x;
        any = true;
    }
    return any;
}

/* ---- the grid ---- */

/* One column, as wide as it may be. */
static void grid_narrow(const struct reader_template *t, double width_px, double em,
                        struct reader_grid *out)
{
    const double widest = t->texts_count > 1 ? fmax(alone_em, reader_template_text_em(t))
                                             : reader_template_text_em(t);
    const double most = width_px - 2 * edge_em * em,
                 width = fmax(fmin(widest > 0 ? widest * em : most, most), least_em * em);
    struct reader_region one = {.x = fmax(0, floor((width_px - width) / 2))};
    one.width = fmax(width_px - 2 * one.x, least_em * em);
    out->texts = 1;
    out->text[0] = one;
    for (int i = 0; i < READER_WIDES; i++)
        out->wide[i] = one;
    out->columns[0] = (struct reader_grid_column){t->text[0].first, one.x, one.width};
    out->columns_count = 1;
}

static bool beside(const struct reader_region *r, double x, double width)
{
    return x >= r->x + r->width || x + width <= r->x;
}

void reader_template_grid(const struct reader_template *t, double width_px, double em,
                          bool notes, struct reader_grid *out)
{
    bool used[READER_GRID_COLUMNS_MAX];
    struct fitted f;
    *out = (struct reader_grid){0};
    width_px = fmax(width_px, 4 * em);
    notes = notes && t->notes_count > 0;
    columns_used(t, notes, used);
    if (notes && needed_em(t, used, noted_edge_em) * em > width_px)
        columns_used(t, notes = false, used);
    const double edge = notes ? noted_edge_em : edge_em;
    if (needed_em(t, used, edge) * em > width_px) {
        grid_narrow(t, width_px, em, out);
        return;
    }
    columns_fit(t, used, width_px, em, edge, &f);
    out->texts = t->texts_count;
    for (int i = 0; i < t->texts_count; i++) {
        struct reader_region *r = &out->text[i];
        span_box(used, &f, t->text[i], &r->x, &r->width);
        if (notes)
            span_box(used, &f, t->notes[i], &r->notes_x, &r->notes_width);
        if (r->width < text_em * em) {
            grid_narrow(t, width_px, em, out);
            return;
        }
        if (r->notes_width < notes_em * em)
            r->notes_width = 0;
    }
    for (int i = 0; i < READER_WIDES; i++) {
        struct reader_region *r = &out->wide[i];
        if (!span_box(used, &f, t->wide[i], &r->x, &r->width) || r->width < text_em * em) {
            *r = out->text[0];
            continue;
        }
        for (int k = 0; k < t->texts_count && !(r->notes_width > 0); k++)
            if (beside(r, out->text[k].notes_x, out->text[k].notes_width)) {
                r->notes_x = out->text[k].notes_x;
                r->notes_width = out->text[k].notes_width;
            }
    }
    for (int i = 0; i < t->columns_count; i++)
        if (used[i])
            out->columns[out->columns_count++] =
                (struct reader_grid_column){i, f.x[i], f.width[i]};
}

/* ---- changing ---- */

double reader_template_text_em(const struct reader_template *t)
{
    double all = (t->text[0].last - t->text[0].first) * t->gutter_em;
    for (int i = t->text[0].first; i <= t->text[0].last; i++) {
        if (t->columns[i].share > 0)
            return 0;
        all += t->columns[i].most_em;
    }
    return all;
}

static double within(double value)
{
    return fmin(fmax(round(100 * value) / 100, 1), 200);
}

void reader_template_text_set(struct reader_template *t, double em)
{
    const double now = reader_template_text_em(t),
                 gutters = (t->text[0].last - t->text[0].first) * t->gutter_em;
    if (!(now > gutters) || !(em > gutters))
        return;
    const double scale = (em - gutters) / (now - gutters);
    for (int k = 0; k < t->texts_count; k++)
        for (int i = t->text[k].first; i <= t->text[k].last; i++) {
            struct reader_template_column *c = &t->columns[i];
            if (c->share > 0)
                continue;
            c->most_em = within(c->most_em * scale);
            c->least_em = fmin(within(c->least_em * scale), c->most_em);
        }
}

/* A range keeps its least, as far as it goes. */
static void column_grow(struct reader_template_column *c, double em)
{
    const bool fixed = c->least_em == c->most_em;
    c->most_em = within(c->most_em + em);
    c->least_em = fixed ? c->most_em : fmin(c->least_em, c->most_em);
}

void reader_template_settle(struct reader_template *t, const struct reader_grid *grid,
                            double em_px)
{
    for (int i = 0; i < grid->columns_count; i++) {
        struct reader_template_column *c = &t->columns[grid->columns[i].number];
        if (c->most_em > c->least_em)
            c->most_em = fmax(c->least_em, within(grid->columns[i].width / em_px));
    }
}

void reader_template_drag(struct reader_template *t, int column, int other, double by_em)
{
    if (column < 0 || column >= t->columns_count || other >= t->columns_count ||
        !(fabs(by_em) <= 1000))
        return;
    struct reader_template_column *own = &t->columns[column],
                                  *next = other >= 0 ? &t->columns[other] : NULL;
    own = own->share > 0 ? NULL : own;
    next = next && next->share > 0 ? NULL : next;
    if (own)
        by_em = fmax(by_em, 1 - own->most_em);
    if (next)
        by_em = fmin(by_em, next->most_em - 1);
    if (own)
        column_grow(own, by_em);
    if (next)
        column_grow(next, -by_em);
}
