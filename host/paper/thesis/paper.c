/* paper.c - a sheet's life: its fields, its contexts. */
#include "base/page.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* The fields of a paper. bits: the length, or which of the two lengths that the paper's size
 * decides. */
enum { BITS_X = -1, BITS_Y = -2 };
#define PAPER_FIELDS(F)                                                                        \
    F("image", image, PAPER_IMAGE_BITS)                                                        \
    F("absorbency", absorbency, KIT_FLOAT_BITS)                                                \
    F("water", water, KIT_FLOAT_BITS)                                                          \
    F("cyan", pigment[0], KIT_FLOAT_BITS)                                                      \
    F("magenta", pigment[1], KIT_FLOAT_BITS)                                                   \
    F("yellow", pigment[2], KIT_FLOAT_BITS)                                                    \
    F("fiber colour", fiber_color, PAPER_IMAGE_BITS)                                           \
    F("x coordinate", grid.x_coord, BITS_X)                                                    \
    F("y coordinate", grid.y_coord, BITS_Y)                                                    \
    F("context", grid.context, 1)                                                              \
    F("inner context", inner_context, 1)                                                       \
    F("inflow", inflow, KIT_FLOAT_BITS)                                                        \
    F("inward gradient", inward, KIT_FLOAT_BITS)                                               \
    F("outward gradient", outward, KIT_FLOAT_BITS)                                             \
    F("scratch", scratch, KIT_FLOAT_BITS)

static const struct {
    const char *name;
    size_t member; /* offset of the field's id in struct paper */
    int bits;
} fields[] = {
#define PAPER_FIELD_ROW(name, member, bits) {name, offsetof(struct paper, member), bits},
    PAPER_FIELDS(PAPER_FIELD_ROW)};

enum { FIELDS_COUNT = sizeof fields / sizeof *fields };

bool paper_field_describe(int width, int height, int number, const char **name, int *bits)
{
    if (number < 0 || number >= FIELDS_COUNT)
        return false;
    *name = fields[number].name;
    *bits = fields[number].bits == BITS_X   ? kit_coordinate_bits(width)
            : fields[number].bits == BITS_Y ? kit_coordinate_bits(height)
                                            : fields[number].bits;
    return true;
}

int paper_bits_per_fiber(int width, int height)
{
    const char *name;
    int bits, sum = 0;
    for (int i = 0; paper_field_describe(width, height, i, &name, &bits); i++)
        sum += bits;
    return sum;
}

struct paper_config paper_config_default(void)
{
    return (struct paper_config){
        .width = 1024,
        .height = 1024,
        .color = {0.97, 0.955, 0.92},
        .color_variation = 0.25,
        .absorbency = 0.18,
        .absorbency_variation = 0.6,
        .fiber_length = 8,
        .seed = 1990,
    };
}

static enum paper_status config_check(const struct paper_config *c)
{
    if (c->width < PAPER_SIDE_MIN || c->width > PAPER_SIDE_MAX || c->height < PAPER_SIDE_MIN ||
        c->height > PAPER_SIDE_MAX)
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "paper must be %d..%d fibers wide and high (got %dx%d)",
                          PAPER_SIDE_MIN, PAPER_SIDE_MAX, c->width, c->height);
    if (!paper_within(c->absorbency, 0, PAPER_ABSORBENCY_MAX))
        return paper_fail(PAPER_BAD_ARGUMENT, "absorbency must be 0..%g (got %g)",
                          PAPER_ABSORBENCY_MAX, c->absorbency);
    for (int i = 0; i < 3; i++)
        if (!paper_within(c->color[i], 0, 1))
            return paper_fail(PAPER_BAD_ARGUMENT, "the paper's colour must be 0..1 (got %g)",
                              c->color[i]);
    if (!paper_within(c->color_variation, 0, 1) || !paper_within(c->absorbency_variation, 0, 1))
        return paper_fail(PAPER_BAD_ARGUMENT,
                          "fibers may differ by 0..1 (got %g in colour, %g in "
                          "absorbency)",
                          c->color_variation, c->absorbency_variation);
    if (c->fiber_length < 1 || c->fiber_length > 64)
        return paper_fail(PAPER_BAD_ARGUMENT, "fibers must be 1..64 pixels long (got %d)",
                          c->fiber_length);
    return PAPER_OK;
}

enum paper_status paper_create(const struct paper_config *config, struct paper **out)
{
    *out = NULL;
    enum paper_status status = config_check(config);
    if (status != PAPER_OK)
        return status;
    struct paper *p = calloc(1, sizeof *p);
    if (!p)
        return paper_fail(PAPER_NO_MEMORY, "no memory for a sheet");
    status = paper_attach();
    if (status != PAPER_OK) {
        free(p);
        return status;
    }
    kit_grid_make(&p->grid, config->width, config->height);
    for (int i = 0; i < FIELDS_COUNT; i++) {
        const char *name;
        int bits;
        CM_field_id_t field;
        memcpy(&field, (char *)p + fields[i].member, sizeof field);
        if (field != CM_no_field)
            continue; /* the grid's own */
        paper_field_describe(p->grid.width, p->grid.height, i, &name, &bits);
        field = CM_allocate_heap_field((unsigned)bits);
        memcpy((char *)p + fields[i].member, &field, sizeof field);
    }
    paper_fibers_make(p, config);
    status = paper_finish(p); /* sheets begin alike, so the machine meets the same work again */
    if (status != PAPER_OK) {
        paper_destroy(p);
        return status;
    }
    *out = p;
    return PAPER_OK;
}

void paper_destroy(struct paper *p)
{
    if (!p)
        return;
    kit_grid_free(&p->grid);
    free(p);
}

int paper_width(const struct paper *p)
{
    return p->grid.width;
}

int paper_height(const struct paper *p)
{
    return p->grid.height;
}
