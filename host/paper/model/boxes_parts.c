/* boxes_parts.c - boxes of a sheet as VP sets of their own: which fields they have, and how
 * these come and go. model/boxes.c says when. */
#include "model/boxes_parts.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* ---- which fields ---- */

struct copied {
    CM_field_id_t sheet, part;
    unsigned bits; /* 0: a float */
    bool changes;
};
enum { COPIED_MOST = 21 + 3 * PAPER_PIGMENTS_MAX };

static int copied_fields(const struct paper_sheet *p, const struct paper_sheet *part,
                         struct copied all[COPIED_MOST])
{
    const bool surface = sheet_has(p, PAPER_PART_SURFACE);
    const struct {
        size_t member;
        bool there, changes;
    } rows[] = {
#define ROW(member, there, changes) {offsetof(struct paper_sheet, member), there, changes}
        ROW(height, true, false),          ROW(page.absorbency, true, false),
        ROW(capacity, true, false),        ROW(face[0], true, false),
        ROW(face[1], true, false),         ROW(sizing, surface, false),
        ROW(ease[0], surface, false),      ROW(ease[1], surface, false),
        ROW(swirl, surface, false),        ROW(page.water, true, true),
        ROW(surface_water, surface, true), ROW(wet_around, surface, true),
        ROW(wet_part, surface, true),      ROW(stained, surface, true),
        ROW(speed[0], surface, true),      ROW(speed[1], surface, true),
        ROW(salt, p->salted, true),        ROW(brine, p->salted, true),
        ROW(barred, true, false),          ROW(grip, true, false),
#undef ROW
    };
    int count = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct copied *c = &all[count];
        memcpy(&c->sheet, (const char *)p + rows[i].member, sizeof c->sheet);
        memcpy(&c->part, (const char *)part + rows[i].member, sizeof c->part);
        c->bits = 0;
        c->changes = rows[i].changes;
        count += rows[i].there;
    }
    all[count++] = (struct copied){p->dried, part->dried, SHEET_DRIED_BITS, true};
    for (int i = 0; i < p->config.pigments_count; i++) {
        CM_field_id_t of_sheet[3], of_part[3];
        const int fields = sheet_pigment_fields(p, i, of_sheet);
        sheet_pigment_fields(part, i, of_part);
        for (int k = 0; k < fields; k++)
            all[count++] = (struct copied){of_sheet[k], of_part[k], 0, true};
    }
    return count;
}

/* Calls block_do() for each of the up to four blocks of the sheet that a box is made of: it may
 * go over the sheet's edge. */
static void blocks_each(const struct paper_sheet *p, const struct box *box, CM_field_id_t field,
                        unsigned bits, void *words, bool read)
{
    const int width = p->page.grid.width, height = p->page.grid.height;
    for (int row = 0; row < box->height;) {
        const int y = (box->y + row) % height,
                  rows = box->height - row < height - y ? box->height - row : height - y;
        for (int column = 0; column < box->width;) {
            const int x = (box->x + column) % width, left = box->width - column,
                      columns = left < width - x ? left : width - x;
            const struct kit_block block = {x,      y,   columns,    rows,
                                            column, row, box->width, box->height};
            if (read)
                kit_grid_block_read(&block, words, field, bits);
            else
                kit_grid_block_write(&block, field, bits, words);
            column += columns;
        }
        row += rows;
    }
}

static void field_fill(struct paper_sheet *p, struct part *part, const struct copied *c,
                       void *words)
{
    const struct kit_grid *grid = &part->sheet.page.grid;
    CM_set_vp_set(p->page.grid.vp_set);
    blocks_each(p, &part->box, c->sheet, c->bits, words, true);
    CM_set_vp_set(grid->vp_set);
    if (c->bits)
        kit_grid_u_write(grid, c->part, c->bits, words, CM_32_bit);
    else
        kit_grid_f_write(grid, c->part, words);
}

void part_fill(struct paper_sheet *p, struct part *part, void *words)
{
    struct copied all[COPIED_MOST];
    const int count = copied_fields(p, &part->sheet, all);
    for (int i = 0; i < count; i++)
        field_fill(p, part, &all[i], words);
    part->dressed = part->lit = false;
}

void part_look(struct paper_sheet *p, struct part *part)
{
    struct paper_sheet *s = &part->sheet;
    if (p->relief_made && !part->lit)
        field_fill(p, part, &(struct copied){p->relief, s->relief, 0, false}, p->boxes->words);
    part->lit = p->relief_made;
    if (part->dressed)
        return;
    const struct copied all[] = {{p->substrate[0], s->substrate[0], 0, false},
                                 {p->substrate[1], s->substrate[1], 0, false},
                                 {p->substrate[2], s->substrate[2], 0, false},
                                 {p->varnish, s->varnish, 0, false}};
    for (int i = 0; i < (p->varnished ? 4 : 3); i++)
        field_fill(p, part, &all[i], p->boxes->words);
    s->varnished = p->varnished;
    part->dressed = true;
}

void part_inside(const struct part *part, struct box *inside)
{
    const struct box *box = &part->box;
    *inside = (struct box){box->x + part->rim[0], box->y + part->rim[1],
                           box->width - 2 * part->rim[0], box->height - 2 * part->rim[1]};
}

/* ---- what is wet in them ---- */

/* Fibers from..from + length - 1 of an axis, joined with `at`, which may be none. */
static void range_join(int *from, int *length, int at, int at_length)
{
    const int end = *from + *length, at_end = at + at_length;
    if (at_length < 1)
        return;
    *from = *length < 1 || at < *from ? at : *from;
    *length = (*length < 1 || at_end > end ? at_end : end) - *from;
}

/* The wet fibers of a stretch of a row of the sheet, which begins at that column of the box. */
static void stretch_join(int *from, int *length, const uint8_t *row, int column, int count)
{
    const uint8_t *first = memchr(row, SHEET_ACTIVE_WET, (size_t)count),
                  *last = first ? memrchr(row, SHEET_ACTIVE_WET, (size_t)count) : NULL;
    if (first)
        range_join(from, length, column + (int)(first - row), (int)(last - first) + 1);
}

void part_wet_find(const struct paper_sheet *p, struct part *part, const uint8_t *active)
{
    const struct box *box = &part->box;
    const int width = p->page.grid.width, height = p->page.grid.height,
              before_edge = box->x + box->width < width ? box->width : width - box->x;
    struct box wet = {0, 0, 0, 0};
    for (int y = 0; y < box->height; y++) {
        const uint8_t *row = active + (size_t)((box->y + y) % height) * (size_t)width;
        int x = 0, length = 0;
        stretch_join(&x, &length, row + box->x, 0, before_edge);
        stretch_join(&x, &length, row, before_edge, box->width - before_edge);
        range_join(&wet.x, &wet.width, x, length);
        range_join(&wet.y, &wet.height, y, length > 0);
    }
    part->wet = wet;
    part->wet_steps = 0;
}

void part_wet_add(const struct paper_sheet *p, struct part *part, const struct box *at)
{
    const int width = p->page.grid.width, height = p->page.grid.height;
    struct box *wet = &part->wet;
    range_join(&wet->x, &wet->width, ((at->x - part->box.x) % width + width) % width,
               at->width);
    range_join(&wet->y, &wet->height, ((at->y - part->box.y) % height + height) % height,
               at->height);
}

/* from..from + length - 1 without what is on the rim. An axis without a rim is a ring: what
 * goes over its end is somewhere on all of it. */
static void range_inside(int *from, int *length, int all, int rim)
{
    if (rim == 0 && (*from < 0 || *from + *length > all)) {
        *from = 0;
        *length = all;
        return;
    }
    const int end = *from + *length < all - rim ? *from + *length : all - rim;
    *from = *from > rim ? *from : rim;
    *length = end - *from;
}

void part_changed(struct part *part, struct box *changed)
{
    const int far = ++part->wet_steps * sheet_capillary_passes(&part->sheet) + SHEET_LOOK_REACH;
    struct box *c = changed;
    *c = part->wet;
    if (c->width < 1)
        return;
    *c = (struct box){c->x - far, c->y - far, c->width + 2 * far, c->height + 2 * far};
    range_inside(&c->x, &c->width, part->box.width, part->rim[0]);
    range_inside(&c->y, &c->height, part->box.height, part->rim[1]);
    c->x += part->box.x;
    c->y += part->box.y;
}

static void part_give(struct paper_sheet *p, const struct part *part, void *words)
{
    struct copied all[COPIED_MOST];
    const int count = copied_fields(p, &part->sheet, all);
    const struct kit_grid *grid = &part->sheet.page.grid;
    for (int i = 0; i < count; i++) {
        if (!all[i].changes)
            continue;
        CM_set_vp_set(grid->vp_set);
        if (all[i].bits)
            kit_grid_u_read(grid, words, all[i].part, all[i].bits, CM_32_bit);
        else
            kit_grid_f_read(grid, words, all[i].part);
        CM_set_vp_set(p->page.grid.vp_set);
        blocks_each(p, &part->box, all[i].sheet, all[i].bits, words, false);
    }
}

/* ---- parts ---- */

static void part_destroy(struct part *part)
{
    kit_grid_free(&part->sheet.page.grid);
    free(part);
}

void sheet_boxes_destroy(struct paper_sheet *p)
{
    struct sheet_boxes *b = p->boxes;
    if (!b)
        return;
    for (int i = 0; i < PARTS_MOST; i++)
        if (b->parts[i])
            part_destroy(b->parts[i]);
    free(b->words);
    free(b);
    p->boxes = NULL;
}

/* Coordinates of the sheet's first and last fibers on an axis in a box that begins at
 * `from`. */
static void ends_find(int from, int length, int all, int ends[2])
{
    const int first = (all - from) % all, last = all - 1 - from;
    ends[0] = first < length ? first : 0;
    ends[1] = last < length ? last : 0;
}

static void part_place(const struct paper_sheet *p, struct part *part, const struct box *box)
{
    const int width = p->page.grid.width, height = p->page.grid.height;
    part->box = *box;
    part->rim[0] = box->width == width ? 0 : SHEET_LOOK_REACH;
    part->rim[1] = box->height == height ? 0 : SHEET_LOOK_REACH;
    ends_find(box->x, box->width, width, part->sheet.ends[KIT_AXIS_X]);
    ends_find(box->y, box->height, height, part->sheet.ends[KIT_AXIS_Y]);
    part->open = true;
}

enum paper_status part_get(struct paper_sheet *p, const struct box *box, struct part **out)
{
    struct sheet_boxes *b = p->boxes;
    int free_place = -1, closed = -1;
    for (int i = 0; i < PARTS_MOST; i++) {
        struct part *part = b->parts[i];
        if (!part)
            free_place = i;
        else if (!part->open && part->box.width == box->width &&
                 part->box.height == box->height) {
            *out = part;
            part_place(p, part, box);
            return PAPER_OK;
        } else if (!part->open)
            closed = i;
    }
    if (free_place < 0) { /* more than are open at once */
        part_destroy(b->parts[closed]);
        b->parts[closed] = NULL;
        free_place = closed;
    }
    struct part *part = calloc(1, sizeof *part);
    if (!part)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a part of a sheet");
    struct paper_sheet *s = &part->sheet;
    s->config = p->config;
    s->config.width = box->width;
    s->config.height = box->height;
    s->unit = p->unit;
    s->finer = p->finer;
    kit_grid_make(&s->page.grid, box->width, box->height);
    sheet_fields_make(s);
    part_place(p, part, box);
    b->parts[free_place] = *out = part;
    return paper_leave(&s->page);
}

void parts_closed_few(struct paper_sheet *p)
{
    struct sheet_boxes *b = p->boxes;
    double room = SHARE_MOST * p->page.grid.width * p->page.grid.height;
    for (int i = 0; i < PARTS_MOST; i++)
        if (b->parts[i] && b->parts[i]->open)
            room -= (double)b->parts[i]->box.width * b->parts[i]->box.height;
    for (int i = 0; i < PARTS_MOST; i++) {
        if (!b->parts[i] || b->parts[i]->open)
            continue;
        room -= (double)b->parts[i]->box.width * b->parts[i]->box.height;
        if (room < 0) {
            part_destroy(b->parts[i]);
            b->parts[i] = NULL;
        }
    }
}

void parts_close(struct sheet_boxes *b)
{
    for (int i = 0; i < PARTS_MOST; i++)
        if (b->parts[i])
            b->parts[i]->open = false;
    b->confined = b->ahead = false;
    b->wait = 0;
    b->wait_next = WAIT_LEAST;
}

/* ---- whoever looks ---- */

void parts_give(struct paper_sheet *p)
{
    struct sheet_boxes *b = p->boxes;
    for (int i = 0; b->ahead && i < PARTS_MOST; i++)
        if (b->parts[i] && b->parts[i]->open)
            part_give(p, b->parts[i], b->words);
    b->ahead = false;
}

void sheet_look(struct paper_sheet *p)
{
    paper_enter(&p->page);
    if (p->boxes)
        parts_give(p);
}

void parts_leave(struct paper_sheet *p)
{
    sheet_look(p);
    if (p->boxes)
        parts_close(p->boxes);
}

void sheet_change(struct paper_sheet *p)
{
    sheet_area_mark_all(p);
    parts_leave(p);
}

void sheet_change_area(struct paper_sheet *p, int x, int y, int width, int height)
{
    sheet_area_change(p, x, y, width, height);
    parts_leave(p);
}

void sheet_change_place(struct paper_sheet *p, const struct paper_place *place)
{
    if (place->screen)
        sheet_change_area(p, place->x, place->y, place->screen->width_px,
                          place->screen->height_px);
    else
        sheet_change(p);
}

void sheet_parts_forget(struct paper_sheet *p)
{
    if (p->boxes)
        parts_close(p->boxes);
    paper_enter(&p->page);
}

void sheet_change_all(struct paper_sheet *p)
{
    sheet_area_mark_all(p);
    sheet_parts_forget(p);
}

double parts_area(const struct sheet_boxes *b)
{
    double area = 0;
    for (int i = 0; i < PARTS_MOST; i++)
        if (b->parts[i] && b->parts[i]->open)
            area += (double)b->parts[i]->box.width * b->parts[i]->box.height;
    return area;
}
