/* wash.c - amounts that are not the same everywhere: graded washes, printed amounts; and
 * lifting them again. */
#include "model/model.h"
#include "techniques.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static enum paper_status amount_check(const struct paper_sheet *p, int substance, double amount)
{
    if (amount >= 0 && amount <= SHEET_PUT_MOST)
        return PAPER_OK;
    return paper_fail(PAPER_BAD_ARGUMENT, "the amount of %.*s must be 0..%g (got %g)",
                      PAPER_NAME_MAX,
                      substance == 0 ? "water" : p->config.pigments[substance - 1].name,
                      SHEET_PUT_MOST, amount);
}

/* d = how far a fiber is on the way from..to, 0..1. Uses t[5]. */
static void grade_make(struct paper_sheet *p, const struct paper_wash *w, CM_field_id_t d)
{
    double dx = w->to[0] - w->from[0], dy = w->to[1] - w->from[1], squared = dx * dx + dy * dy;
    if (!(squared > 0)) {
        kit_f_set(d, 0.0);
        return;
    }
    CM_f_u_float_2_2L(d, p->page.grid.x_coord, (unsigned)p->page.grid.x_bits, KIT_F);
    kit_f_plus(d, d, 0.5 - w->from[0]);
    kit_f_times(d, d, dx / squared);
    CM_f_u_float_2_2L(p->t[5], p->page.grid.y_coord, (unsigned)p->page.grid.y_bits, KIT_F);
    kit_f_plus(p->t[5], p->t[5], 0.5 - w->from[1]);
    kit_f_times(p->t[5], p->t[5], dy / squared);
    kit_f_add(d, d, p->t[5]);
    kit_f_least(d, d, 0.0);
    kit_f_most(d, d, 1.0);
}

enum paper_status sheet_wash_check(const struct paper_sheet *p, const void *arguments)
{
    const struct paper_wash *w = arguments;
    enum paper_status status = PAPER_OK;
    for (int i = 0; i <= p->config.pigments_count && status == PAPER_OK; i++) {
        status = amount_check(p, i, w->amount[i]);
        if (status == PAPER_OK)
            status = amount_check(p, i, w->end[i]);
    }
    return status == PAPER_OK ? sheet_place_check(&w->place) : status;
}

enum paper_status sheet_wash(struct paper_sheet *p, const void *arguments)
{
    const struct paper_wash *w = arguments;
    sheet_change_place(p, &w->place);
    CM_set_context();
    CM_field_id_t share = p->t[1], part = p->t[2], grade = p->t[4];
    enum paper_status status = sheet_share_make(p, &w->place, share);
    if (status != PAPER_OK)
        return status;
    sheet_resist_heed(p, share, part);
    grade_make(p, w, grade);
    for (int i = 0; i <= p->config.pigments_count; i++) {
        if (w->amount[i] == 0 && w->end[i] == 0)
            continue;
        kit_f_times(part, grade, (w->end[i] - w->amount[i]) * p->unit);
        kit_f_plus(part, part, w->amount[i] * p->unit);
        kit_f_mul(part, part, share);
        sheet_amount_put(p, i, part);
    }
    sheet_wet_put(p, w->amount[0] > 0 || w->end[0] > 0, share);
    return sheet_leave(p);
}

enum paper_status sheet_print_check(const struct paper_sheet *p, const void *arguments)
{
    const struct paper_print *print = arguments;
    enum paper_status status = PAPER_OK;
    if (print->width < 1 || print->height < 1 || print->width > PAPER_SIDE_MAX ||
        print->height > PAPER_SIDE_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "a print is 1..%d wide and high (got %dx%d)",
                          PAPER_SIDE_MAX, print->width, print->height);
    size_t count = (size_t)print->width * (size_t)print->height;
    for (int i = 0; i <= p->config.pigments_count; i++)
        for (size_t at = 0; print->amount[i] && at < count && status == PAPER_OK; at++)
            status = amount_check(p, i, (double)print->amount[i][at]);
    return status;
}

/* The print's numbers as an array of the whole sheet, 0 beside it. */
static void print_lay(const struct paper_sheet *p, const struct paper_print *print,
                      int substance, float *whole)
{
    size_t width = (size_t)p->page.grid.width;
    memset(whole, 0, width * (size_t)p->page.grid.height * sizeof *whole);
    for (int row = 0; row < print->height; row++)
        for (int column = 0; column < print->width; column++) {
            int64_t x = (int64_t)print->x + column, y = (int64_t)print->y + row;
            if (x >= 0 && y >= 0 && x < p->page.grid.width && y < p->page.grid.height)
                whole[(size_t)y * width + (size_t)x] =
                    print->amount[substance]
                                 [(size_t)row * (size_t)print->width + (size_t)column];
        }
}

enum paper_status sheet_print(struct paper_sheet *p, const void *arguments)
{
    const struct paper_print *print = arguments;
    enum paper_status status = PAPER_OK;
    float *whole =
        malloc((size_t)p->page.grid.width * (size_t)p->page.grid.height * sizeof *whole);
    if (!whole)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a print of %dx%d", print->width,
                          print->height);
    CM_field_id_t open = p->t[1], part = p->t[2], before = p->t[6];
    for (int i = 0; i <= p->config.pigments_count && status == PAPER_OK; i++) {
        if (!print->amount[i])
            continue;
        print_lay(p, print, i, whole);
        sheet_change_area(p, print->x, print->y, print->width, print->height);
        CM_set_context();
        kit_grid_f_write(&p->page.grid, part, whole);
        sheet_resist_heed(p, part, open);
        kit_f_times(part, part, p->unit);
        if (i == 0)
            kit_f_copy(before, sheet_amount_field(p, 0));
        sheet_amount_put(p, i, part);
        if (i == 0)
            sheet_wet_touched(p, before);
        status = sheet_leave(p);
    }
    free(whole);
    return status;
}

enum paper_status sheet_lift_check(const struct paper_sheet *p, const void *arguments)
{
    (void)p;
    return sheet_place_check(&((const struct paper_lift *)arguments)->place);
}

enum paper_status sheet_lift(struct paper_sheet *p, const void *arguments)
{
    const struct paper_lift *lift = arguments;
    sheet_change_place(p, &lift->place);
    CM_set_context();
    CM_field_id_t share = p->t[1], lost = p->t[2];
    enum paper_status status = sheet_share_make(p, &lift->place, share);
    if (status != PAPER_OK)
        return status;
    sheet_resist_heed(p, share, lost);
    sheet_amount_lose(p, p->page.water, share, lift->part, lost);
    if (sheet_has(p, PAPER_PART_SURFACE))
        sheet_amount_lose(p, p->surface_water, share, lift->part, lost);
    for (int i = 0; i < p->config.pigments_count; i++) {
        /* what stains twice as much stays twice as long */
        double held = fmax(1, p->config.pigments[i].staining);
        sheet_amount_lose(p, p->infused[i], share, lift->part, lost);
        if (sheet_has(p, PAPER_PART_SURFACE))
            sheet_amount_lose(p, p->surface[i], share, lift->part, lost);
        if (sheet_has(p, PAPER_PART_FIXING))
            sheet_amount_lose(p, p->fixed[i], share, lift->part / held, lost);
    }
    return sheet_leave(p);
}
