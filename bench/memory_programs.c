/* memory_programs.c - see memory_programs.h. */
#include "memory_programs.h"

#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "listing.h"
#include "of_machine.h"
#include "paper_scene.h"
#include <cm/paris.h>

enum { WORD = 32, S = 23, E = 8, PIGMENTS = 6, STEPS = 10 };

/* dest: from 0 to 1, other numbers in each place. */
static void part_fill(const struct listing *l, CM_field_id_t dest, unsigned int seed)
{
    CM_field_id_t bits = CM_allocate_heap_field(WORD);
    CM_u_move_2L(bits, l->y, WORD, l->coordinate_bits);
    CM_u_multiply_constant_2_1L(bits, 40503 + 2 * seed, WORD);
    CM_u_move_2L(dest, l->x, WORD, l->coordinate_bits);
    CM_logxor_2_1L(bits, dest, WORD);
    CM_u_multiply_constant_2_1L(bits, 0x9e3779b1u, WORD);
    CM_f_u_float_2_2L(dest, bits + 20, 12, S, E);
    CM_f_multiply_constant_2_1L(dest, 1.0 / 4096, S, E);
    CM_deallocate_heap_field(bits);
}

bool memory_listing_run(int side, uint32_t *result)
{
    struct listing l = {
        .width = side, .height = side, .gravity = 1.02, .molecular_weight = {0.25, 0.5, 0.75}};
    const CM_field_id_t *const amounts[] = {&l.water, &l.pigment[0], &l.pigment[1],
                                            &l.pigment[2]};
    listing_allocate(&l);
    CM_set_context();
    CM_f_move_constant_1L(l.absorbency, 0.125, S, E);
    for (unsigned int i = 0; i < 4; i++)
        part_fill(&l, *amounts[i], i);
    for (int i = 0; i < STEPS; i++)
        listing_step(&l);
    *result = 0;
    for (int i = 0; i < 4; i++)
        *result = *result * 31 + (uint32_t)CM_global_u_add_1L(*amounts[i], WORD);
    return bench_machine_finished();
}

static bool layer_add(const struct paper_scene *s, enum paper_layer layer, int pigment,
                      float *values, uint32_t *result)
{
    const size_t count = (size_t)s->width * (size_t)s->height;
    if (paper_sheet_layer_read(s->sheet, layer, pigment, values) != PAPER_OK)
        return bench_fail("the paper: %s", paper_error());
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        *result = *result * 31 + bits;
    }
    return true;
}

bool memory_paper_run(int side, uint32_t *result)
{
    struct paper_scene scene;
    float *values = malloc((size_t)side * (size_t)side * sizeof *values);
    bool ok = values && paper_scene_init(&scene, side, side, PIGMENTS, false, NULL);
    if (!values)
        return bench_fail("no memory for a sheet of %dx%d", side, side);
    for (int i = 0; ok && i < STEPS; i++)
        ok = paper_sheet_step(scene.sheet) == PAPER_OK ||
             bench_fail("the paper: %s", paper_error());
    *result = 0;
    ok = ok && layer_add(&scene, PAPER_LAYER_INFUSED_WATER, 0, values, result);
    for (int k = 0; ok && k < PIGMENTS; k++)
        ok = layer_add(&scene, PAPER_LAYER_INFUSED_PIGMENT, k, values, result);
    free(values);
    paper_scene_finish(&scene);
    return ok;
}

bool memory_mean_run(int side, uint32_t *result)
{
    unsigned int sides[2] = {(unsigned int)side, (unsigned int)side};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sides, 2)));
    CM_set_context();
    CM_field_id_t f = CM_allocate_heap_field(WORD), g = CM_allocate_heap_field(WORD);
    CM_my_news_coordinate_1L(f, 0, WORD);
    CM_f_u_float_2_2L(f, f, WORD, S, E);
    for (int i = 0; i < STEPS; i++) {
        CM_get_from_news_1L(g, f, 0, CM_upward, WORD);
        CM_f_add_2_1L(f, g, S, E);
        CM_f_multiply_constant_2_1L(f, 0.5, S, E);
    }
    *result =
        (uint32_t)CM_global_u_add_1L(f, WORD) * 31 + (uint32_t)CM_global_u_add_1L(g, WORD);
    return bench_machine_finished();
}
