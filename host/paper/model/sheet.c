/* sheet.c - a sheet's life: what it is checked for, made, made anew, and given back. */
#include "arguments/rows.h"
#include "model/felt.h"
#include "model/model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct paper_sheet_config paper_sheet_config_default(void)
{
    struct paper_sheet_config config = {.width = 512,
                                        .height = 512,
                                        .parts = PAPER_PARTS_ALL,
                                        .rule = PAPER_RULE_KUBELKA_MUNK,
                                        .stock = *paper_stock_number(0),
                                        .seed = 1990,
                                        .deckle = paper_deckle_default()};
    return config;
}

double paper_sheet_bytes(double width, double height, int pigments)
{
    return ((double)sizeof(float) * (42 + 8.5 * pigments) + PAPER_BRUSHES_BYTES) * width *
           height;
}

/* ---- checking ---- */

/* Of what kind it is, and its name, go before what is wrong. */
static enum paper_status named_check(const struct members *members, const void *of,
                                     const char *what, const char *name)
{
    char whose[PAPER_NAME_MAX + 16];
    snprintf(whose, sizeof whose, "%s%s%.*s's ", what, *name ? " " : "", PAPER_NAME_MAX, name);
    return paper_members_check(members, of, whose, "");
}

static enum paper_status deckle_check(const struct paper_sheet_config *c)
{
    const double least = 2 * (c->deckle.margin + c->deckle.thin);
    const int side = c->width < c->height ? c->width : c->height;
    enum paper_status status =
        paper_members_check(&paper_deckle_members, &c->deckle, "a deckle's ", "");
    if (status != PAPER_OK)
        return status;
    if (!c->parts)
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "the thesis's paper has no deckle; choose a paper with parts");
    if (c->torus)
        return paper_fail(PAPER_BAD_ARGUMENT, "a torus has no edges, and so no deckle");
    if (!felt_has_fibers(&c->stock))
        return paper_fail(PAPER_BAD_ARGUMENT, "%.*s has no fibers, and so no deckle",
                          PAPER_NAME_MAX, c->stock.name);
    if (!(side > least))
        return paper_fail(
            PAPER_BAD_ARGUMENT,
            "paper with this deckle must be more than %g wide and high, twice its "
            "margin and thin edge (got %dx%d)",
            least, c->width, c->height);
    return PAPER_OK;
}

static enum paper_status config_check(const struct paper_sheet_config *c)
{
    if (c->width < PAPER_SIDE_MIN || c->width > PAPER_SIDE_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "paper width must be %d..%d (got %d)",
                          PAPER_SIDE_MIN, PAPER_SIDE_MAX, c->width);
    if (c->height < PAPER_SIDE_MIN || c->height > PAPER_SIDE_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "paper height must be %d..%d (got %d)",
                          PAPER_SIDE_MIN, PAPER_SIDE_MAX, c->height);
    if (c->parts > PAPER_PARTS_ALL)
        return paper_fail(PAPER_BAD_ARGUMENT, "paper has no parts 0x%x", c->parts);
    if (c->pigments_count < 0 || c->pigments_count > PAPER_PIGMENTS_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT, "paper takes 0..%d pigments (got %d)",
                          PAPER_PIGMENTS_MAX, c->pigments_count);
    if (c->rule > PAPER_RULE_LUMINOUS)
        return paper_fail(PAPER_BAD_ARGUMENT, "there is no rule %d", (int)c->rule);
    enum paper_status status =
        named_check(&paper_stock_members, &c->stock, "paper", c->stock.name);
    for (int i = 0; i < c->pigments_count && status == PAPER_OK; i++)
        if ((status = named_check(&paper_pigment_members, &c->pigments[i], "pigment",
                                  c->pigments[i].name)) == PAPER_OK)
            status = named_check(&paper_bands_members, &c->pigments[i], "pigment",
                                 c->pigments[i].name);
    return status == PAPER_OK && c->deckled ? deckle_check(c) : status;
}

/* ---- life ---- */

/* A fresh sheet: its stock from the seed, nothing on it. Between paper_enter() and
 * paper_leave(). */
static enum paper_status fresh_make(struct paper_sheet *p)
{
    enum paper_status status = PAPER_OK;
    if (sheet_has(p, PAPER_PART_SURFACE))
        status = sheet_sizing_make(p);
    if (status == PAPER_OK)
        status = sheet_stock_make(p);
    if (status == PAPER_OK && p->config.parts)
        status = sheet_grip_make(p);
    return status == PAPER_OK ? sheet_amounts_clear(p) : status;
}

enum paper_status sheet_create(const struct paper_sheet_config *config,
                               struct paper_sheet **out)
{
    *out = NULL;
    enum paper_status status = config_check(config);
    if (status != PAPER_OK)
        return status;
    struct paper_sheet *p = calloc(1, sizeof *p);
    if (!p)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a sheet");
    p->config = *config;
    p->config.parts = sheet_parts_whole(config->parts);
    p->finer = p->config.parts ? fmax(1, felt_scale(&p->config)) : 1;
    p->unit = p->config.parts ? PAPER_GRAINS : 1;
    p->air = paper_air_default();
    p->salt_reach = 10;
    p->salt_strength = 1;
    p->parted_from = PAPER_PARTED_USUAL;
    sheet_boxes_init(p);
    status = paper_attach();
    if (status != PAPER_OK) {
        free(p);
        return status;
    }
    kit_grid_make(&p->page.grid, config->width, config->height);
    sheet_fields_make(p);
    p->ends[KIT_AXIS_X][1] = config->width - 1;
    p->ends[KIT_AXIS_Y][1] = config->height - 1;
    sheet_area_mark_all(p);
    status = fresh_make(p);
    if (status == PAPER_OK)
        status = sheet_leave(p);
    if (status == PAPER_OK)
        status = sheet_finish(p);
    if (status != PAPER_OK) {
        sheet_destroy(p);
        return status;
    }
    *out = p;
    return PAPER_OK;
}

void sheet_destroy(struct paper_sheet *p)
{
    sheet_boxes_destroy(p);
    sheet_brushes_destroy(p);
    kit_grid_free(&p->page.grid);
    free(p->covers);
    free(p->tooth);
    free(p);
}

enum paper_status sheet_finish(struct paper_sheet *p)
{
    const enum paper_status status = paper_finish(&p->page);
    return status == PAPER_OK ? sheet_boxes_finish(p) : status;
}

void sheet_extras_reset(struct paper_sheet *p)
{
    sheet_brushes_destroy(p);
    p->varnished = p->salted = false;
    p->salt_reach = 10;
    p->salt_strength = 1;
}

enum paper_status sheet_reset(struct paper_sheet *p)
{
    sheet_change_all(p);
    CM_set_context();
    kit_f_set(p->resist, 0.0);
    kit_f_set(p->wet_around, 0.0);
    kit_f_set(p->wet_part, 0.0);
    kit_f_set(p->stained, 0.0);
    kit_f_set(p->speed[0], 0.0);
    kit_f_set(p->speed[1], 0.0);
    kit_f_set(p->surface_water, 0.0);
    kit_f_set(p->varnish, 0.0);
    kit_f_set(p->salt, 0.0);
    kit_f_set(p->brine, 0.0);
    sheet_extras_reset(p);
    CM_u_move_constant_1L(p->dried, 0, SHEET_DRIED_BITS);
    p->air = paper_air_default();
    enum paper_status status = fresh_make(p), left = sheet_leave(p);
    if (status == PAPER_OK)
        status = left;
    return status == PAPER_OK ? sheet_finish(p) : status;
}
