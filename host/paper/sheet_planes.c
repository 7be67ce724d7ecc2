/* sheet_planes.c - all that changes in a sheet, in and out, to the bit. */
#include "history_internal.h"
#include "sheet_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct row {
    struct paper_plane plane;
    CM_field_id_t field;
};

static void row_add(struct row *rows, int *count, const char *name, int number,
                    CM_field_id_t field)
{
    struct row *row = &rows[(*count)++];
    *row = (struct row){.field = field};
    if (number)
        snprintf(row->plane.name, sizeof row->plane.name, "%s %d", name, number);
    else
        snprintf(row->plane.name, sizeof row->plane.name, "%s", name);
}

static int rows_make(const struct paper_sheet *p, struct row rows[PAPER_PLANES_MAX])
{
    static const char *const channels[3] = {"red", "green", "blue"};
    int count = 0;
    row_add(rows, &count, "height", 0, p->height);
    row_add(rows, &count, "absorbency", 0, p->page.absorbency);
    row_add(rows, &count, "capacity", 0, p->capacity);
    row_add(rows, &count, "resist", 0, p->resist);
    for (int i = 0; i < 3; i++)
        row_add(rows, &count, channels[i], 0, p->substrate[i]);
    row_add(rows, &count, "infused water", 0, p->page.water);
    row_add(rows, &count, "surface water", 0, p->surface_water);
    row_add(rows, &count, "wet around", 0, p->wet_around);
    row_add(rows, &count, "dried water", 0, p->dried);
    rows[count - 1].plane.whole = true;
    for (int i = 0; i < p->config.pigments_count; i++) {
        if (sheet_has(p, PAPER_PART_SURFACE))
            row_add(rows, &count, "surface pigment", i + 1, p->surface[i]);
        row_add(rows, &count, "infused pigment", i + 1, p->infused[i]);
        if (sheet_has(p, PAPER_PART_FIXING))
            row_add(rows, &count, "fixed pigment", i + 1, p->fixed[i]);
    }
    return count;
}

int paper_sheet_planes(const struct paper_sheet *p, struct paper_plane planes[PAPER_PLANES_MAX])
{
    struct row rows[PAPER_PLANES_MAX];
    int count = rows_make(p, rows);
    for (int i = 0; i < count; i++)
        planes[i] = rows[i].plane;
    return count;
}

enum paper_status paper_sheet_plane_read(struct paper_sheet *p, int number, void *words)
{
    struct row rows[PAPER_PLANES_MAX];
    int count = rows_make(p, rows);
    if (number < 0 || number >= count)
        return paper_fail(PAPER_BAD_ARGUMENT, "the sheet has %d planes (asked for number %d)",
                          count, number);
    enum paper_status status = sheet_ready(p);
    return status == PAPER_OK ? sheet_plane_fetch(p, number, words) : status;
}

enum paper_status sheet_plane_fetch(struct paper_sheet *p, int number, void *words)
{
    struct row rows[PAPER_PLANES_MAX];
    int offset[2] = {0, 0}, start[2] = {0, 0}, axes[2] = {PAPER_AXIS_Y, PAPER_AXIS_X};
    int size[2] = {p->page.height, p->page.width};
    rows_make(p, rows);
    paper_enter(&p->page);
    CM_set_context();
    if (rows[number].plane.whole)
        CM_u_read_from_news_array_1L(words, offset, start, size, axes, rows[number].field,
                                     SHEET_DRIED_BITS, 2, size, CM_32_bit);
    else
        CM_f_read_from_news_array_1L(words, offset, start, size, axes, rows[number].field,
                                     SHEET_F, 2, size, CM_float_single);
    return paper_leave(&p->page);
}

void sheet_plane_write(struct paper_sheet *p, int number, const void *words)
{
    struct row rows[PAPER_PLANES_MAX];
    int offset[2] = {0, 0}, start[2] = {0, 0}, axes[2] = {PAPER_AXIS_Y, PAPER_AXIS_X};
    int size[2] = {p->page.height, p->page.width};
    rows_make(p, rows);
    CM_set_context();
    if (rows[number].plane.whole)
        CM_u_write_to_news_array_1L(words, offset, start, size, axes, rows[number].field,
                                    SHEET_DRIED_BITS, 2, size, CM_32_bit);
    else
        CM_f_write_to_news_array_1L(words, offset, start, size, axes, rows[number].field,
                                    SHEET_F, 2, size, CM_float_single);
}

void sheet_planes_written(struct paper_sheet *p)
{
    CM_set_context();
    sheet_faces_make(p);
}

enum paper_status sheet_reset(struct paper_sheet *p)
{
    paper_enter(&p->page);
    CM_set_context();
    f_set(p->resist, 0.0);
    f_set(p->wet_around, 0.0);
    f_set(p->surface_water, 0.0);
    CM_u_move_constant_1L(p->dried, 0, SHEET_DRIED_BITS);
    p->air = paper_air_default();
    enum paper_status status = sheet_fresh_make(p), left = paper_leave(&p->page);
    if (status == PAPER_OK)
        status = left;
    return status == PAPER_OK ? paper_sheet_finish(p) : status;
}
