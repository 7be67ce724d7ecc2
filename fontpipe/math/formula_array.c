/* formula_array.c - matrices and lines of equations: columns as wide as their widest cell, rows
 * at least a line apart, all of it centred on the axis. */
#include "formula_internal.h"

#include <math.h>

/* Of a line: what it has over its baseline and under it, in ems, as LaTeX's \strut. */
static const double strut_height = 0.84, strut_depth = 0.36;

/* l, c or r; the last one that is told is for all columns after it, but in pairs they go on in
 * turns. */
static char column_kind(int column, const struct formula_table *table, const char *kinds,
                        int kinds_bytes)
{
    int seen = 0;
    char last = 'c';
    if (table->pairs)
        return column % 2 ? 'l' : 'r';
    for (int i = 0; i < kinds_bytes; i++) {
        if (kinds[i] != 'l' && kinds[i] != 'c' && kinds[i] != 'r')
            continue;
        last = kinds[i];
        if (seen++ == column)
            break;
    }
    return last;
}

static double gap_before(int column, const struct formula_table *table)
{
    return column == 0 || (table->pairs && column % 2) ? 0 : table->gap_em;
}

struct formula_box formula_array(struct font_math *m, struct formula_box *cells, int rows,
                                 int columns, const struct formula_table *table,
                                 const char *kinds, int kinds_bytes, struct formula_style style)
{
    const struct formula_style inner = {table->style, style.cramped};
    const double size = formula_size(m, inner);
    double widths[FORMULA_COLUMNS_MAX] = {0}, y = 0, x = 0, top = 0;
    struct formula_box box = formula_box_empty(m);
    if (rows > 0 && columns > 0)
        box.begin = cells[0].begin;
    for (int r = 0; r < rows; r++)
        for (int c = 0; c < columns; c++)
            widths[c] = fmax(widths[c], cells[r * columns + c].width);
    for (int r = 0; r < rows; r++) {
        double height = strut_height * size, depth = strut_depth * size;
        for (int c = 0; c < columns; c++) {
            height = fmax(height, cells[r * columns + c].height);
            depth = fmax(depth, cells[r * columns + c].depth);
        }
        if (r == 0)
            top = height;
        else
            y += height + table->row_em * size;
        x = 0;
        for (int c = 0; c < columns; c++) {
            const struct formula_box *cell = &cells[r * columns + c];
            char kind = column_kind(c, table, kinds, kinds_bytes);
            double left = widths[c] - cell->width;
            x += gap_before(c, table) * size;
            formula_box_move(m, cell, x + (kind == 'l' ? 0 : kind == 'r' ? left : left / 2), y);
            x += widths[c];
        }
        y += depth; /* the lower edge of the row */
    }
    box.width = x;
    box.height = top;
    box.depth = y;
    box.end = m->items_count;
    formula_box_centre(m, &box, style);
    return box;
}
