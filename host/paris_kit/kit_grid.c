/* kit_grid.c - see kit_grid.h. */
#include "kit_grid.h"

#include "kit.h"
#include "kit_float.h"

int kit_coordinate_bits(int length)
{
    int bits = 1;
    while (bits < 31 && (1 << bits) < length)
        bits++;
    return bits;
}

void kit_grid_make(struct kit_grid *g, int width, int height)
{
    int dimensions[2] = {height, width};
    *g = (struct kit_grid){.width = width,
                           .height = height,
                           .x_bits = kit_coordinate_bits(width),
                           .y_bits = kit_coordinate_bits(height)};
    kit_begin();
    g->geometry = CM_create_geometry(dimensions, 2);
    g->vp_set = CM_allocate_vp_set(g->geometry);
    CM_set_vp_set(g->vp_set);
    g->x_coord = CM_allocate_heap_field((unsigned)g->x_bits);
    g->y_coord = CM_allocate_heap_field((unsigned)g->y_bits);
    g->context = CM_allocate_heap_field(1);
    CM_set_context();
    CM_my_news_coordinate_1L(g->x_coord, KIT_AXIS_X, (unsigned)g->x_bits);
    CM_my_news_coordinate_1L(g->y_coord, KIT_AXIS_Y, (unsigned)g->y_bits);
}

void kit_grid_free(struct kit_grid *g)
{
    if (g->vp_set)
        CM_deallocate_vp_set(g->vp_set); /* deallocates the set's fields, too */
    if (g->geometry)
        CM_deallocate_geometry(g->geometry);
    *g = (struct kit_grid){0};
}

void kit_grid_narrow(const struct kit_grid *g, int x1, int y1, int x2, int y2)
{
    unsigned x_bits = (unsigned)g->x_bits, y_bits = (unsigned)g->y_bits;
    x2 = x2 < g->width ? x2 : g->width;
    y2 = y2 < g->height ? y2 : g->height;
    CM_store_context(g->context);
    if (x1 >= x2 || y1 >= y2) {
        CM_clear_context();
        return;
    }
    if (x1 > 0) {
        CM_u_ge_constant_1L(g->x_coord, (unsigned)x1, x_bits);
        CM_logand_context_with_test();
    }
    if (y1 > 0) {
        CM_u_ge_constant_1L(g->y_coord, (unsigned)y1, y_bits);
        CM_logand_context_with_test();
    }
    if (x2 < g->width) {
        CM_u_lt_constant_1L(g->x_coord, (unsigned)x2, x_bits);
        CM_logand_context_with_test();
    }
    if (y2 < g->height) {
        CM_u_lt_constant_1L(g->y_coord, (unsigned)y2, y_bits);
        CM_logand_context_with_test();
    }
}

void kit_grid_widen(const struct kit_grid *g)
{
    CM_load_context(g->context);
}

/* ---- whole fields ---- */

static int zeros[2] = {0, 0}, axes[2] = {KIT_AXIS_Y, KIT_AXIS_X};

void kit_grid_f_write(const struct kit_grid *g, CM_field_id_t d, const void *floats)
{
    int size[2] = {g->height, g->width};
    CM_f_write_to_news_array_1L(floats, zeros, zeros, size, axes, d, KIT_F, 2, size,
                                CM_float_single);
}

void kit_grid_f_read(const struct kit_grid *g, void *floats, CM_field_id_t a)
{
    int size[2] = {g->height, g->width};
    CM_f_read_from_news_array_1L(floats, zeros, zeros, size, axes, a, KIT_F, 2, size,
                                 CM_float_single);
}

void kit_grid_u_write(const struct kit_grid *g, CM_field_id_t d, unsigned bits,
                      const void *numbers, unsigned type)
{
    int size[2] = {g->height, g->width};
    CM_u_write_to_news_array_1L(numbers, zeros, zeros, size, axes, d, bits, 2, size, type);
}

void kit_grid_u_read(const struct kit_grid *g, void *numbers, CM_field_id_t a, unsigned bits,
                     unsigned type)
{
    int size[2] = {g->height, g->width};
    CM_u_read_from_news_array_1L(numbers, zeros, zeros, size, axes, a, bits, 2, size, type);
}

/* ---- parts of fields ---- */

struct vectors {
    int offset[2], start[2], end[2], size[2];
};

static struct vectors vectors_of(const struct kit_block *b)
{
    return (struct vectors){{b->row, b->column},
                            {b->y1, b->x1},
                            {b->y1 + b->height, b->x1 + b->width},
                            {b->array_height, b->array_width}};
}

void kit_grid_block_write(const struct kit_block *block, CM_field_id_t d, unsigned bits,
                          const void *array)
{
    struct vectors v = vectors_of(block);
    if (bits == 0)
        CM_f_write_to_news_array_1L(array, v.offset, v.start, v.end, axes, d, KIT_F, 2, v.size,
                                    CM_float_single);
    else
        CM_u_write_to_news_array_1L(array, v.offset, v.start, v.end, axes, d, bits, 2, v.size,
                                    bits > 32 ? CM_64_bit : CM_32_bit);
}

void kit_grid_block_read(const struct kit_block *block, void *array, CM_field_id_t a,
                         unsigned bits)
{
    struct vectors v = vectors_of(block);
    if (bits == 0)
        CM_f_read_from_news_array_1L(array, v.offset, v.start, v.end, axes, a, KIT_F, 2, v.size,
                                     CM_float_single);
    else
        CM_u_read_from_news_array_1L(array, v.offset, v.start, v.end, axes, a, bits, 2, v.size,
                                     bits > 32 ? CM_64_bit : CM_32_bit);
}
